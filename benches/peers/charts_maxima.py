"""Maxima, metrics over charts: loops with `diff`, each component simplified by `trigsimp`, or by `ratsimp` where there are no
sines and cosines. Arguments: coordinates, the file of values, rows of the metric separated by semicolons, parameters, free functions."""
import re
import subprocess
import sys

coordinates, path, metric = sys.argv[1:4]
# own names have two letters, unlike coordinates and parameters
PROGRAM = """
XX:[%(coordinates)s]$ NN:length(XX)$ GG:matrix(%(metric)s)$
low(VV):=%(simplify)s(VV)$
emit(name,RR):=for CC in RR do (printf(file,"~a",name), for QQ:1 thru length(CC)-1 do printf(file," ~d",CC[QQ]), printf(file," ~a~%%",string(last(CC))))$
affinities():=block([RR:[],VV,HH:map('low,invert(GG))],
 for II thru NN do for JJ thru NN do for KK:JJ thru NN do (
  VV:low(sum(HH[II,PP]*(diff(GG[PP,JJ],XX[KK])+diff(GG[PP,KK],XX[JJ])-diff(GG[JJ,KK],XX[PP]))/2,PP,1,NN)),
  AA[II,JJ,KK]:VV, AA[II,KK,JJ]:VV,
  if VV#0 then (push([II,JJ,KK,VV],RR), if JJ#KK then push([II,KK,JJ,VV],RR))), RR)$
curvature():=block([RR:[],VV],
 for II thru NN do for JJ thru NN do for KK thru NN do for LL:KK+1 thru NN do (
  VV:low(diff(AA[II,LL,JJ],XX[KK])-diff(AA[II,KK,JJ],XX[LL])+sum(AA[II,KK,MM]*AA[MM,LL,JJ]-AA[II,LL,MM]*AA[MM,KK,JJ],MM,1,NN)),
  BB[II,JJ,KK,LL]:VV, BB[II,JJ,LL,KK]:-VV,
  if VV#0 then push([II,JJ,KK,LL,VV],RR)), RR)$
ricci():=block([RR:[],VV], for KK thru NN do for II thru NN do for JJ thru NN do BB[II,JJ,KK,KK]:0,
 for JJ thru NN do for LL thru NN do (VV:low(sum(BB[KK,JJ,KK,LL],KK,1,NN)), if VV#0 then push([JJ,LL,VV],RR)), RR)$
spent:0.0$
say(name,RR):=(print("RESULT",name,spent,length(RR)), file:opena("%(values)s"), emit(name,RR), close(file))$
start:elapsed_run_time()$ SS:affinities()$ spent:spent+elapsed_run_time()-start$ say("affinities",SS)$
start:elapsed_run_time()$ SS:curvature()$ spent:spent+elapsed_run_time()-start$ say("curvature",SS)$
start:elapsed_run_time()$ SS:ricci()$ spent:spent+elapsed_run_time()-start$ say("ricci",SS)$
"""
rows = ",".join(f"[{row}]" for row in metric.split(";"))
program = PROGRAM % {"simplify": "trigsimp" if re.search("sin|cos", metric) else "ratsimp", "coordinates": coordinates, "metric": rows, "values": path}
sys.exit(subprocess.run(["maxima", "--very-quiet"], text=True, input=program).returncode)
