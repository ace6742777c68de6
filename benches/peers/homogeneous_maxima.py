"""Maxima, Levi-Civita of an invariant metric on a homogeneous space by Nomizu's formulas, each component simplified by `ratsimp`.
Arguments: the file of constants, the file of values, indices of the complement and of the isotropy algebra, the diagonal of the metric."""
import subprocess
import sys
from peer import both_orders, constants

n, c = constants(sys.argv[1])
order = [int(i) - 1 for part in sys.argv[3:5] for i in part.split(",")]
place = {i: at + 1 for at, i in enumerate(order)}
r = len(sys.argv[3].split(","))
given = "$\n".join(f"CC[{place[i]},{place[j]},{place[k]}]:{v}" for (i, j, k), v in both_orders(c).items())
program = f"""
NN:{n}$ MM:{r}$ GG:[{sys.argv[5]}]$
array(CC,NN,NN,NN)$ fillarray(CC,[0])$ {given}$
array(AA,MM,MM,MM)$
curvature():=block([RR:[],VV],
 for II thru MM do for JJ thru MM do for KK thru MM do
  AA[II,JJ,KK]:(CC[II,JJ,KK]+GG[KK]/GG[II]*CC[KK,II,JJ]+GG[JJ]/GG[II]*CC[JJ,II,KK])/2,
 for II thru MM do for JJ thru MM do for KK thru MM do for LL:KK+1 thru MM do (
  VV:ratsimp(sum(AA[II,KK,PP]*AA[PP,LL,JJ]-AA[II,LL,PP]*AA[PP,KK,JJ]-CC[PP,KK,LL]*AA[II,PP,JJ],PP,1,MM)
   -sum(CC[PP,KK,LL]*CC[II,PP,JJ],PP,MM+1,NN)),
  if VV#0 then push([II,JJ,KK,LL,VV],RR)), RR)$
start:elapsed_run_time()$ SS:curvature()$ spent:elapsed_run_time()-start$
print("RESULT","curvature",spent,length(SS))$
file:opena("{sys.argv[2]}")$
for RR in SS do (printf(file,"curvature"), for QQ:1 thru 4 do printf(file," ~d",RR[QQ]), printf(file," ~a~%",string(last(RR))))$
close(file)$
"""
sys.exit(subprocess.run(["maxima", "--very-quiet"], text=True, input=program).returncode)
