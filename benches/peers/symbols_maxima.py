"""Maxima, symbolic metrics: loops over sparse tables whose values are canonical rational expressions (`rat`,
what `ratsimp` uses inside), in lowest terms after each operation."""
import subprocess
import sys
from peer import both_orders, constants

n, c = constants(sys.argv[1])
metric = sys.argv[3]
PROGRAM = """
ratmx:true$
g:matrix(%(metric)s)$
array([B,D],n,n)$ array(sums,n)$ for i thru n do sums[i]:0$
for j thru n do for k thru n do B[j,k]:[]$
%(fill)s
emit(name,R):=for r in R do (printf(file,"~a",name), for q:1 thru length(r)-1 do printf(file," ~d",r[q]), printf(file," ~a~%%",string(ratdisrep(last(r)))))$
affinities():=block([R:[],gr,h,K],
 gr:map(rat,g), h:invert(gr),
 for j thru n do for k thru n do D[j,k]:[],
 for j thru n do for k thru n do for p thru n do (K:rat(0),
   for a in B[j,k] do K:K+a[2]*gr[p,a[1]],
   for a in B[k,p] do K:K-a[2]*gr[j,a[1]],
   for a in B[p,j] do K:K+a[2]*gr[k,a[1]],
   Kos[p,j,k]:K/2),
 for j thru n do for k thru n do for i thru n do (K:rat(0),
   for p thru n do if ratdisrep(h[i,p])#0 and ratdisrep(Kos[p,j,k])#0 then K:K+h[i,p]*Kos[p,j,k],
   if ratdisrep(K)#0 then (push([i,K],D[j,k]), push([i,j,k,K],R))),
 R)$
curvature():=block([R:[],touched],
 for k thru n do for l:k+1 thru n do for j thru n do (touched:[],
  for a in D[l,j] do for b in D[k,a[1]] do (sums[b[1]]:sums[b[1]]+a[2]*b[2], push(b[1],touched)),
  for a in D[k,j] do for b in D[l,a[1]] do (sums[b[1]]:sums[b[1]]-a[2]*b[2], push(b[1],touched)),
  for a in B[k,l] do for b in D[a[1],j] do (sums[b[1]]:sums[b[1]]-a[2]*b[2], push(b[1],touched)),
  for i in unique(touched) do (if ratdisrep(sums[i])#0 then push([i,j,k,l,sums[i]],R), sums[i]:0)),
 R)$
ricci(C):=block([R:[]], for j thru n do for l thru n do ric[j,l]:rat(0),
 for r in C do (if r[1]=r[3] then ric[r[2],r[4]]:ric[r[2],r[4]]+r[5], if r[1]=r[4] then ric[r[2],r[3]]:ric[r[2],r[3]]-r[5]),
 for j thru n do for l thru n do if ratdisrep(ric[j,l])#0 then push([j,l,ric[j,l]],R), R)$
spent:0.0$
say(name,R):=(print("RESULT",name,spent,length(R)), file:opena("%(values)s"), emit(name,R), close(file))$
start:elapsed_run_time()$ A:affinities()$ spent:spent+elapsed_run_time()-start$ say("affinities",A)$
start:elapsed_run_time()$ C:curvature()$ spent:spent+elapsed_run_time()-start$ say("curvature",C)$
start:elapsed_run_time()$ S:ricci(C)$ spent:spent+elapsed_run_time()-start$ say("ricci",S)$
"""
rows = {}
for (i, j, k), v in both_orders(c).items():
    rows.setdefault((j + 1, k + 1), []).append([i + 1, v])
fill = "\n".join(f"B[{j},{k}]:{row}$" for (j, k), row in rows.items())
program = PROGRAM % {"metric": ",".join(f"[{row}]" for row in metric.split(";")), "fill": fill, "values": sys.argv[2]}
sys.exit(subprocess.run(["maxima", "--very-quiet"], text=True, input=f"n:{n}$\n{program}").returncode)
