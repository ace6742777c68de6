"""Representations for the table `representations`: products, dominant weights, restrictions. Labels after Bourbaki."""


def fundamental(rank, *nodes):
    """The sum of fundamental weights, numbered from 1."""
    return ",".join(str(nodes.count(i + 1)) for i in range(rank))


# name: type, operation, weight, second weight or number of the node that is left out of the extended diagram
TASKS = {
    "8 x 8 of SU(3)": ("A2", "product", "1,1", "1,1"),
    "rho x rho of A4": ("A4", "product", "1,1,1,1", "1,1,1,1"),
    "rho x rho of D5": ("D5", "product", "1,1,1,1,1", "1,1,1,1,1"),
    "[2,1,1,1] x [1,1,1,2] of B4": ("B4", "product", "2,1,1,1", "1,1,1,2"),
    "rho x rho of E6": ("E6", "product", "1,1,1,1,1,1", "1,1,1,1,1,1"),
    "1728 x 1728 of E6": ("E6", "product", fundamental(6, 1, 2), fundamental(6, 1, 2)),
    "[1,0,0,0,0,0,1] x [0,1,0,0,0,0,1] of E7": ("E7", "product", fundamental(7, 1, 7), fundamental(7, 2, 7)),
    "779247 x 779247 of E8": ("E8", "product", fundamental(8, 1, 8), fundamental(8, 1, 8)),
    "[1,0,0,0,0,0,1,1] squared of E8": ("E8", "product", fundamental(8, 1, 7, 8), fundamental(8, 1, 7, 8)),
    "weights of rho of D5": ("D5", "weights", "1,1,1,1,1", ""),
    "weights of [1,1,0,0,0,1] of E6": ("E6", "weights", fundamental(6, 1, 2, 6), ""),
    "weights of [1,1,0,0,0,0,0,1] of E8": ("E8", "weights", fundamental(8, 1, 2, 8), ""),
    "3875 of E8 to D8": ("E8", "restriction", fundamental(8, 1), "1"),
    "779247 of E8 to D8": ("E8", "restriction", fundamental(8, 1, 8), "1"),
}
