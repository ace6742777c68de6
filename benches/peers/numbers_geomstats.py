"""geomstats, f64: InvariantMetric on the matrices of SO(n), curvature of every triple of basis vectors.
A value below 1e-9 is zero. Only for `soN`; its basis E_ij - E_ji is put in our order, with our signs."""
import os
import sys
os.environ.setdefault("GEOMSTATS_BACKEND", "numpy")
import numpy as np
from geomstats.geometry.invariant_metric import InvariantMetric
from geomstats.geometry.special_orthogonal import SpecialOrthogonal
from peer import constants, measure, report, values

d, c = constants(sys.argv[1])
size = next(s for s in range(2, d + 2) if s * (s - 1) // 2 == d)
space = SpecialOrthogonal(n=size, point_type="matrix", equip=False)
basis = np.array(space.lie_algebra.basis)
pairs = sorted(((i, j) for i in range(size) for j in range(i + 1, size)), reverse=True)
place, sign = np.zeros(d, dtype=int), np.zeros(d)  # of each of theirs among ours
for a, matrix in enumerate(basis):
    i, j = np.argwhere(np.triu(matrix))[0]
    place[a], sign[a] = pairs.index((i, j)), (-1) ** (i + j) * np.sign(matrix[i, j])
ours = np.zeros_like(basis)
for a in range(d):
    ours[place[a]] = sign[a] * basis[a]
for (i, j, k), v in c.items():
    bracket = ours[j] @ ours[k] - ours[k] @ ours[j]
    assert np.sum(ours[i] * bracket) / np.sum(ours[i] ** 2) == v, "not the same basis"


def metric():
    return InvariantMetric(space, metric_mat_at_identity=np.diag(place + 1.0), left=True)


def curvature(metric):
    found = []
    for k in range(d):
        for l in range(k + 1, d):
            for j in range(d):
                r = metric.curvature_at_identity(ours[k], ours[l], ours[j])
                r = -space.lie_algebra.basis_representation(r) * sign  # theirs has the opposite sign
                found += [((place[a], j, k, l), r[a]) for a in np.flatnonzero(abs(r) > 1e-9)]
    return found


seconds, found = measure(metric, curvature)
report("curvature", seconds, len(found))
values(sys.argv[2], "curvature", found)
