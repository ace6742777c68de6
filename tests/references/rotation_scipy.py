"""Rotations by SciPy: Euler angles of all 24 sequences, matrices, rotation vectors, modified Rodrigues parameters.

    python3 tests/references/rotation_scipy.py > tests/data/rotation_scipy.txt        (SciPy 1.17)

Quaternions are w, x, y, z. Sequences as in SciPy: ZYX intrinsic, zyx extrinsic.

    euler SEQ q[4] angles[3]
    turned SEQ angles[3] q[4]
    others q[4] matrix[9] rotvec[3] mrp[3]
"""
import itertools
import math
import random
import warnings
from scipy.spatial.transform import Rotation

warnings.simplefilter("ignore")  # gimbal lock
random.seed(20220927)
h, s = 0.5, math.sqrt(0.5)
LOCKED = [(1, 0, 0, 0), (0, 0, 1, 0), (s, 0, s, 0), (s, 0, -s, 0), (s, s, 0, 0), (s, 0, 0, -s), (h, h, h, h), (h, -h, h, h)]
SEQUENCES = ["".join(t) for t in itertools.product("xyz", repeat=3) if t[0] != t[1] != t[2]]
SEQUENCES += [t.upper() for t in SEQUENCES]


def line(*parts):
    print(*[repr(float(c)) if not isinstance(c, str) else c for part in parts for c in ([part] if isinstance(part, str) else part)])


def unit():
    q = [random.gauss(0, 1) for _ in range(4)]
    return tuple(c / math.hypot(*q) for c in q)


def scalar_first(r):
    return r.as_quat(canonical=True, scalar_first=True)


for q in LOCKED + [unit() for _ in range(12)]:
    r = Rotation.from_quat(q, scalar_first=True)
    for seq in SEQUENCES:
        line("euler", seq, q, r.as_euler(seq))
    line("others", q, r.as_matrix().ravel(), r.as_rotvec(), r.as_mrp())
for seq in SEQUENCES:
    for _ in range(3):
        angles = [random.uniform(-4, 4) for _ in range(3)]
        line("turned", seq, angles, scalar_first(Rotation.from_euler(seq, angles)))
