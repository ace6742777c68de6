# Random tensor products and characters, computed by GAP for tests/data/representations/:
#   gap -q tests/references/representations.g
# writes products.txt and characters.txt into the current folder. The seed is fixed. Labels are
# numbered as in Bourbaki; GAP numbers F4 in another order.

bourbaki := function(type, w)
  if type = "F" then return [w[2], w[4], w[3], w[1]]; fi;
  return w;
end;

text := w -> JoinStringsWithSeparator(List(w, String), ",");

types := [["A",1],["A",2],["A",3],["A",4],["A",5],["A",6],["A",7],["A",8],["B",2],["B",3],["B",4],
  ["B",5],["B",6],["B",7],["B",8],["C",2],["C",3],["C",4],["C",5],["C",6],["C",7],["C",8],["D",4],
  ["D",5],["D",6],["D",7],["D",8],["E",6],["E",7],["E",8],["F",4],["G",2]];
algebras := List(types, t -> SimpleLieAlgebra(t[1], t[2], Rationals));
source := RandomSource(IsMersenneTwister, 43);

# a random highest weight with few labels, of dimension at most the limit
weight := function(at, limit)
  local w, i;
  repeat
    w := List([1..types[at][2]], i -> 0);
    for i in [1..Random(source, 1, 4)] do
      w[Random(source, 1, types[at][2])] := Random(source, 0, 3);
    od;
  until DimensionOfHighestWeightModule(algebras[at], w) <= limit and Sum(w) > 0;
  return w;
end;

line := function(at, weights, result)
  local parts, i;
  parts := [];
  for i in [1..Length(result[1])] do
    Add(parts, Concatenation(text(bourbaki(types[at][1], result[1][i])), "*", String(result[2][i])));
  od;
  Sort(parts);
  return Concatenation(types[at][1], String(types[at][2]), " ",
    JoinStringsWithSeparator(List(weights, w -> text(bourbaki(types[at][1], w))), " "), " : ",
    JoinStringsWithSeparator(parts, " "), "\n");
end;

out := OutputTextFile("products.txt", false);
SetPrintFormattingStatus(out, false);
PrintTo(out, "# type, two highest weights : components of the product with multiplicities; GAP ",
  GAPInfo.Version, ", DecomposeTensorProduct\n");
for n in [1..500] do
  at := Random(source, 1, Length(types));
  limit := 1500; if types[at][1] = "E" and types[at][2] = 8 then limit := 4000; fi;
  a := weight(at, limit);
  b := weight(at, limit);
  AppendTo(out, line(at, [a, b], DecomposeTensorProduct(algebras[at], a, b)));
od;
CloseStream(out);

out := OutputTextFile("characters.txt", false);
SetPrintFormattingStatus(out, false);
PrintTo(out, "# type, highest weight : dominant weights with multiplicities; GAP ",
  GAPInfo.Version, ", DominantCharacter\n");
for n in [1..150] do
  at := Random(source, 1, Length(types));
  a := weight(at, 10000);
  AppendTo(out, line(at, [a], DominantCharacter(algebras[at], a)));
od;
CloseStream(out);
QUIT;
