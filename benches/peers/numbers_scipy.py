"""SciPy, f64: products of sparse matrices. A value below 1e-9 is zero."""
import sys
import numpy as np
import scipy.sparse as sp
from peer import both_orders, constants, measure, report, values

n, c = constants(sys.argv[1])
N = n * n
c = both_orders(c)
index = np.array(list(c), dtype=np.int64).T
value = np.array(list(c.values()), dtype=float)


def rows(matrix):
    """rows, columns and values that are not zero"""
    matrix.sum_duplicates()
    matrix = matrix.tocoo()
    keep = abs(matrix.data) > 1e-9
    return matrix.row[keep].astype(np.int64), matrix.col[keep].astype(np.int64), matrix.data[keep]


def curvature(_):
    i, j, k = index
    g = np.arange(1.0, n + 1)
    # 2 g_i Lambda^i_jk = g_i c^i_jk - g_j c^j_ki + g_k c^k_ij
    upper = np.concatenate([i, k, j])
    along = np.concatenate([j, i, k])
    lower = np.concatenate([k, j, i])
    v = np.concatenate([value / 2, -g[i] * value / (2 * g[k]), g[i] * value / (2 * g[j])])
    r, q, v = rows(sp.coo_matrix((v, (along * n + lower, upper)), shape=(N, n)).tocsr())
    along, lower, upper = r // n, r % n, q
    # Lambda^i_km Lambda^m_lj: rows (i, k), columns (l, j)
    left = sp.csr_matrix((v, (upper * n + along, lower)), shape=(N, n))
    right = sp.csr_matrix((v, (upper, along * n + lower)), shape=(n, N))
    r, q, product = rows(left @ right)
    I, K, L, J = r // n, r % n, q // n, q % n
    plus, minus = K < L, L < K
    # c^m_kl Lambda^i_mj: rows (k, l), columns (j, i)
    half = j < k
    bracket = sp.csr_matrix((value[half], (j[half] * n + k[half], i[half])), shape=(N, n))
    last = (bracket @ sp.csr_matrix((v, (along, lower * n + upper)), shape=(n, N))).tocoo()
    data = np.concatenate([product[plus], -product[minus], -last.data])
    row = np.concatenate([(K * n + L)[plus], (L * n + K)[minus], last.row.astype(np.int64)])
    column = np.concatenate([(J * n + I)[plus], (J * n + I)[minus], last.col.astype(np.int64)])
    return rows(sp.coo_matrix((data, (row, column)), shape=(N, N)).tocsr())


seconds, (r, q, v) = measure(lambda: None, curvature)
report("curvature", seconds, len(v))
if n <= 14:
    values(sys.argv[2], "curvature", (((b % n, b // n, a // n, a % n), x) for a, b, x in zip(r, q, v)))
