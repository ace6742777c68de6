"""Many geometries at once: every quantity is an array of floats, whose first axes are the axes of the batch."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor._engine import Family
from affinor._scalars import floats

Floats = NDArray[np.float64]


class Bulk:
    """The quantities of many geometries. The geometries share their recorded programs."""

    __slots__ = ("_arrays", "_family", "batch_shape", "dimension")

    def __init__(self, family: Family, arrays: list[Floats], shape: tuple[int, ...]) -> None:
        self._family = family
        # arrays of the shape (..., k); their columns are the inputs of the family
        self._arrays = arrays
        self.batch_shape: tuple[int, ...] = shape
        """The shape of the batch, to which all arguments are broadcast."""
        self.dimension: int = family.dimension
        """The dimension of the geometries."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of dimension {self.dimension}, batch of the shape {self.batch_shape}>"

    def quantity(self, key: str) -> Floats:
        """Quantity by its name in tables.

        Parameters
        ----------
        key : str
            Name of a quantity, such as ``"ricci"``, ``"weyl"`` or ``"kretschmann"``.

        Returns
        -------
        array of the shape (..., n, ...)
            The first axes are the axes of the batch; then the indices follow, in the order of :class:`Geometry`.

        Raises
        ------
        ValueError
            The name is unknown.

        Examples
        --------
        >>> import numpy as np
        >>> Geometries("so3", np.eye(3)).quantity("kretschmann")
        array(0.75)
        """
        self._check_key(key)
        return self._evaluate(key, self.batch_shape)

    @property
    def metric(self) -> Floats:
        """Metrics ``g_ij``, an array of the shape (..., n, n)."""
        return self.quantity("metric")

    @property
    def affinities(self) -> Floats:
        """Affinities ``Lambda^i_jk`` with ``nabla_{e_j} e_k = Lambda^i_jk e_i``, an array of the shape (..., n, n, n)."""
        return self.quantity("affinities")

    @property
    def torsion(self) -> Floats:
        """Torsion ``tau^i_jk``, an array of the shape (..., n, n, n)."""
        return self.quantity("torsion")

    @property
    def curvature(self) -> Floats:
        """Curvature ``R^i_jkl`` with ``R(e_k, e_l) e_j = R^i_jkl e_i``, an array of the shape (..., n, n, n, n)."""
        return self.quantity("curvature")

    @property
    def ricci(self) -> Floats:
        """Ricci tensors ``Ric_jl = R^i_jil``, an array of the shape (..., n, n).

        Examples
        --------
        >>> import numpy as np
        >>> Geometries("so3", [np.eye(3), 2 * np.eye(3)]).ricci[:, 0, 0]
        array([0.5, 0.5])
        """
        return self.quantity("ricci")

    @property
    def scalar_curvature(self) -> Floats:
        """Scalar curvatures ``S = g^jl Ric_jl``, an array of the shape (...)."""
        return self.quantity("scalar_curvature")

    @property
    def ricci_eigenvalues(self) -> NDArray[Any]:
        """Eigenvalues of the symmetric part of ``Ric`` with respect to the metric, an array of the shape (..., n).

        If all metrics are positive definite, the eigenvalues are floats in ascending order; otherwise they are complex numbers.

        Examples
        --------
        >>> import numpy as np
        >>> Geometries("so3", [np.eye(3), 2 * np.eye(3)]).ricci_eigenvalues
        array([[0.5 , 0.5 , 0.5 ],
               [0.25, 0.25, 0.25]])
        """
        n, ricci, metric = self.dimension, self.ricci, self.metric
        ricci = (ricci + np.swapaxes(ricci, -1, -2)) / 2
        count = ricci.size // (n * n)
        found = self._family.eigenvalues(metric.reshape(count, n * n), ricci.reshape(count, n * n))
        if found is None:
            return np.linalg.eigvals(np.linalg.solve(metric, ricci)).astype(np.complex128)
        return found.reshape((*self.batch_shape, n))

    def sectional_curvature(self, x: ArrayLike, y: ArrayLike) -> Floats:
        """Sectional curvatures ``g(R(x,y)y, x)/(g(x,x) g(y,y) - g(x,y)^2)`` of planes.

        Parameters
        ----------
        x, y : array of the shape (..., n)
            Vectors that span the planes, broadcast with the batch.

        Returns
        -------
        array of the shape (...)

        Raises
        ------
        MathematicsError
            A plane is degenerate.

        Examples
        --------
        >>> import numpy as np
        >>> Geometries("so3", np.diag([1, 1, 2])).sectional_curvature([[1, 0, 0], [0, 1, 0]], [0, 0, 1])
        array([0.5, 0.5])
        """
        vectors = [floats(v) for v in (x, y)]
        for name, v in zip("xy", vectors, strict=True):
            if v.ndim == 0 or v.shape[-1] != self.dimension:
                raise ValueError(f"{name} should be an array of the shape (..., {self.dimension}), not of the shape {v.shape}")
            if not np.isfinite(v).all():
                raise ValueError(f"{name} should be finite, not {v[~np.isfinite(v)][0]}")
        planes = common(*(v.shape[:-1] for v in vectors))
        both = np.concatenate([np.broadcast_to(v, (*planes, self.dimension)) for v in vectors], axis=-1)
        return self._evaluate("sectional_curvature", common(self.batch_shape, planes), vectors=both)

    def _check_key(self, key: str) -> None:
        """Rejects the sectional curvature, which the engine evaluates only for two vectors."""
        if key == "sectional_curvature":
            try:
                self._family.shape("")
            except ValueError as error:
                listed = str(error).removeprefix('""')
                raise ValueError(f'"{key}"{listed}; the method sectional_curvature(x, y) takes the vectors of a plane') from None

    def _evaluate(
        self, key: str, shape: tuple[int, ...], *, vectors: Floats | None = None, rates: Floats | None = None
    ) -> Floats:
        """Evaluates a quantity for a batch of this shape; if ``rates`` are given, its derivative along them."""
        n = self.dimension
        planes = np.zeros((1, 2 * n)) if vectors is None else vectors
        arrays = [self._rows(array, shape) for array in (*self._arrays, planes)]
        moving = None if rates is None else self._rows(rates.reshape((*rates.shape[:-2], n * n)), shape)
        found = self._family.evaluate(key, shape, arrays, moving)
        return found.reshape((*shape, *found.shape[1:]))

    @staticmethod
    def _rows(array: Floats, shape: tuple[int, ...]) -> Floats:
        """Converts an array to rows (count, k) of the batch. A single row serves all elements of the batch."""
        width = array.shape[-1]
        if array.size == width:
            return np.ascontiguousarray(array.reshape(1, width))
        if array.shape[:-1] != shape:
            array = np.broadcast_to(array, (*shape, width))
        return np.ascontiguousarray(array.reshape(-1, width))


def common(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """The shape to which the shapes of several batches are broadcast."""
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        written = " and ".join(map(str, shapes))
        raise ValueError(f"the batches {written} cannot be broadcast together") from None
