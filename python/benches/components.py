"""Ricci components as SageManifolds computes them, written with SymPy: SageManifolds does not install beside this package.

Arrays of components over a vector frame, with structure coefficients ``[e_i, e_j] = C^k_ij e_k``, connection coefficients
``nabla_{e_k} e_j = Gamma^i_jk e_i`` (the direction last), the curvature by contractions of whole arrays, and its trace.
Every sum is simplified when it is formed, as scalar fields of SageManifolds are; ``cancel`` is enough for rational
functions and faster than the chain of simplifications there.
"""

from __future__ import annotations

import itertools
from typing import Any

import sympy as sp

Components = dict[tuple[int, ...], Any]


def contracted(first: Components, slot: int, second: Components, other: int) -> Components:
    """The sum over a slot of each factor."""
    found: Components = {}
    for left, a in first.items():
        for right, b in second.items():
            if left[slot] == right[other]:
                key = left[:slot] + left[slot + 1 :] + right[:other] + right[other + 1 :]
                found[key] = sp.cancel(found.get(key, 0) + a * b)
    return {key: value for key, value in found.items() if value != 0}


def connection(metric: Any, structure: Components) -> Components:
    """The coefficients of the Levi-Civita connection over the frame, where the metric is constant."""
    span, inverse = range(metric.rows), metric.inv()
    found: Components = {}
    for i, j, k in itertools.product(span, repeat=3):
        total = sp.Integer(0)
        for s in span:
            terms = (
                metric[m, s] * structure.get((m, k, j), 0)
                + metric[m, j] * structure.get((m, s, k), 0)
                + metric[m, k] * structure.get((m, s, j), 0)
                for m in span
            )
            total = sp.cancel(total + inverse[i, s] * sum(terms) / 2)
        if total != 0:
            found[i, j, k] = total
    return found


def ricci(metric: Any, structure: Components) -> Any:
    """``R_jl = R^i_jil`` with ``R^i_jkl = Gamma^i_mk Gamma^m_jl - Gamma^i_ml Gamma^m_jk - C^m_kl Gamma^i_jm``."""
    span, gamma = range(metric.rows), connection(metric, structure)
    pairs, brackets = contracted(gamma, 1, gamma, 0), contracted(gamma, 2, structure, 0)
    riemann: Components = {}
    for i, j, k in itertools.product(span, repeat=3):
        # antisymmetric in the last two indices
        for l in range(k):
            products = pairs.get((i, k, j, l), 0) - pairs.get((i, l, j, k), 0)
            value = sp.cancel(products - brackets.get((i, j, k, l), 0))
            riemann[i, j, k, l], riemann[i, j, l, k] = value, -value
    return sp.Matrix(metric.rows, metric.rows, lambda j, l: sp.cancel(sum(riemann.get((i, j, i, l), 0) for i in span)))
