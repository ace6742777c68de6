"""GAP, exact: loops over sparse tables of rationals."""
import subprocess
import sys
from peer import constants

n, c = constants(sys.argv[1])
PROGRAM = """
n := %d;; entries := %s;;
D := []; B := [];
add := function(t, j, k, i, v) local q;
  q := Position(t[j][k][1], i);
  if q = fail then Add(t[j][k][1], i); Add(t[j][k][2], v); else t[j][k][2][q] := t[j][k][2][q] + v; fi;
end;;
prepare := function() local e;
  B := List([1..n], j -> List([1..n], k -> [[], []]));
  for e in entries do add(B, e[2], e[3], e[1], e[4]); add(B, e[3], e[2], e[1], -e[4]); od;
end;;
connection := function() local a, b, i, s, v, p, j, k;
  D := List([1..n], j -> List([1..n], k -> [[], []]));
  for a in [1..n] do for b in [1..n] do for s in [1..Length(B[a][b][1])] do
    i := B[a][b][1][s]; v := B[a][b][2][s];
    add(D, a, b, i, v/2); add(D, i, a, b, -i*v/(2*b)); add(D, b, i, a, i*v/(2*a));
  od; od; od;
  for j in [1..n] do for k in [1..n] do
    p := Filtered([1..Length(D[j][k][2])], s -> D[j][k][2][s] <> 0);
    D[j][k] := [D[j][k][1]{p}, D[j][k][2]{p}];
  od; od;
end;;
curvature := function() local R, sums, touched, walk, j, k, l, p;
  connection();
  R := []; sums := ListWithIdenticalEntries(n, 0);
  walk := function(outer, row, sign) local s, w, v, x;
    for s in [1..Length(row[1])] do
      w := outer(row[1][s]); v := sign*row[2][s];
      for x in [1..Length(w[1])] do
        sums[w[1][x]] := sums[w[1][x]] + v*w[2][x]; Add(touched, w[1][x]);
      od;
    od;
  end;
  for k in [1..n] do for l in [k+1..n] do for j in [1..n] do
    touched := [];
    walk(m -> D[k][m], D[l][j], 1); walk(m -> D[l][m], D[k][j], -1); walk(m -> D[m][j], B[k][l], -1);
    for p in touched do if sums[p] <> 0 then Add(R, [p, j, k, l, sums[p]]); sums[p] := 0; fi; od;
  od; od; od;
  return R;
end;;
spent := 0;; runs := 0;;
while spent < 1000 and runs < 100 do
  prepare(); start := Runtime(); R := curvature(); spent := spent + Runtime() - start; runs := runs + 1;
od;
Print("RESULT curvature ", Float(spent)/1000/runs, " ", Length(R), "\\n");
if n <= 14 then for r in R do AppendTo("%s", "curvature ", r[1], " ", r[2], " ", r[3], " ", r[4], " ", r[5], "\\n"); od; fi;
QUIT;
"""
entries = ",".join(f"[{i + 1},{j + 1},{k + 1},{v}]" for (i, j, k), v in c.items())
sys.exit(subprocess.run(["gap", "-q", "--quitonbreak", "-o", "8g"], text=True,
                        input=PROGRAM % (n, f"[{entries}]", sys.argv[2])).returncode)
