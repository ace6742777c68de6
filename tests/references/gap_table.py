"""A function of GAP that makes a table of structure constants from rows [i, j, k, v], each pair of i, j in one order."""

READ = """
read := function(n, rows) local T, r, at, both;
  T := EmptySCTable(n, 0, "antisymmetric"); at := rec();
  for r in rows do
    both := Concatenation(String(r[1]), ",", String(r[2]));
    if not IsBound(at.(both)) then at.(both) := [r[1], r[2], []]; fi;
    Append(at.(both)[3], [r[4], r[3]]);
  od;
  for both in RecNames(at) do SetEntrySCTable(T, at.(both)[1], at.(both)[2], at.(both)[3]); od;
  return T;
end;;
"""
