"""Homogeneous spaces G/H with a letter for each isotropy summand.

For each space: the algebra of G in the catalogue, the indices of a basis of the complement and of the isotropy algebra, from 1,
and the diagonal of the metric.
"""
SPACES = {
    "SU(3)/T": ("su(3)", range(1, 7), range(7, 9), "a,a,b,b,c,c"),
    "SO(5)/SO(3)": ("so(5)", range(4, 11), range(1, 4), "a,a,a,b,b,b,c"),
    "SU(4)/T": ("su(4)", range(1, 13), range(13, 16), "a,a,b,b,c,c,d,d,f,f,k,k"),
}


def definition(algebra, tangent, isotropy, diagonal):
    """The definition file of a space."""
    listed = lambda indices: "[" + ", ".join(f"'e{i}'" for i in indices) + "]"
    letters = sorted(set(diagonal.split(",")))
    return (f"parameters = {letters}\nhomogeneous = {{ of = '{algebra}', by = {listed(isotropy)}, complement = {listed(tangent)} }}\n"
            f"metric = 'diag({diagonal})'\n")
