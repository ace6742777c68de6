"""Maxima, exact, interpreted: `plain`, loops over sparse tables of rationals, or `ctensor`, its package for
tensors, with a frame whose bracket is given (the affinities are its `lcs`, then `riemann`)."""
import subprocess
import sys
from peer import both_orders, constants

n, c = constants(sys.argv[1])
PLAIN = """
array([B,D],n,n)$ array(sums,n)$ fillarray(sums,[0])$
for j thru n do for k thru n do B[j,k]:[]$
%s
curvature():=block([R:[],touched,a,b],
 for j thru n do for k thru n do D[j,k]:[],
 for j thru n do for k thru n do (touched:[],
  for a in B[j,k] do (sums[a[1]]:sums[a[1]]+a[2]/2, push(a[1],touched)),
  for i thru n do (
   for a in B[k,i] do if a[1]=j then (sums[i]:sums[i]-j*a[2]/(2*i), push(i,touched)),
   for a in B[i,j] do if a[1]=k then (sums[i]:sums[i]+k*a[2]/(2*i), push(i,touched))),
  for i in touched do if sums[i]#0 then (push([i,sums[i]],D[j,k]), sums[i]:0)),
 for k thru n do for l:k+1 thru n do for j thru n do (touched:[],
  for a in D[l,j] do for b in D[k,a[1]] do (sums[b[1]]:sums[b[1]]+a[2]*b[2], push(b[1],touched)),
  for a in D[k,j] do for b in D[l,a[1]] do (sums[b[1]]:sums[b[1]]-a[2]*b[2], push(b[1],touched)),
  for a in B[k,l] do for b in D[a[1],j] do (sums[b[1]]:sums[b[1]]-a[2]*b[2], push(b[1],touched)),
  for i in touched do if sums[i]#0 then (push([i,j,k,l,sums[i]],R), sums[i]:0)),
 R)$
"""
CTENSOR = """
load(ctensor)$ dim:n$ ct_coords:makelist(concat(x,i),i,1,n)$ cframe_flag:true$
lfg:zeromatrix(n,n)$ ufg:zeromatrix(n,n)$ for i thru n do (lfg[i,i]:i, ufg[i,i]:1/i)$
fri:ident(n)$ fr:ident(n)$
for i thru n do for j thru n do for k thru n do (fb[i,j,k]:0, ifb[i,j,k]:0)$
%s
curvature():=block([R:[]],
 if member('lriem,arrays) then kill(lriem,riem),
 for i thru n do for j thru n do for k thru n do lcs[i,j,k]:(ifb[k,j,i]+ifb[j,i,k]-ifb[i,k,j])/2,
 riemann(false),
 for j thru n do for k thru n do for l:k+1 thru n do for i thru n do
  if riem[j,k,l,i]#0 then push([i,j,k,l,-riem[j,k,l,i]],R),
 R)$
"""
MEASURE = """
spent:0.0$ runs:0$
while spent<1 and runs<100 do (start:elapsed_run_time(), R:curvature(), spent:spent+elapsed_run_time()-start, runs:runs+1)$
print("RESULT","curvature",spent/runs,length(R))$
if n<=14 then (file:openw("%s"),
 for r in R do printf(file,"curvature ~d ~d ~d ~d ~a~%%",r[1],r[2],r[3],r[4],string(r[5])), close(file))$
"""
if sys.argv[3] == "ctensor":
    # ifb_ijk = g(e_i, [e_j, e_k])
    fill = " ".join(f"ifb[{i + 1},{j + 1},{k + 1}]:{v * (i + 1)}$" for (i, j, k), v in both_orders(c).items())
    program = CTENSOR % fill
else:
    rows = {}
    for (i, j, k), v in both_orders(c).items():
        rows.setdefault((j + 1, k + 1), []).append([i + 1, v])
    program = PLAIN % "\n".join(f"B[{j},{k}]:{row}$" for (j, k), row in rows.items())
program = f"n:{n}$\n{program}\n{MEASURE % sys.argv[2]}\n"
sys.exit(subprocess.run(["maxima", "--very-quiet"], text=True, input=program).returncode)
