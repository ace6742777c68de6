"""Mechanisms of bodies and joints: mobility, and the dynamics of trees in joint coordinates."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from affinor import _engine
from affinor._scalars import Symbols, document, text_of
from affinor.structure import Report

__all__ = ["Joint", "Mechanism"]

Floats = NDArray[np.float64]


class Joint(NamedTuple):
    """Joint of a mechanism.

    Attributes
    ----------
    name : str
        Name of the joint.
    type : str
        Type, such as ``"revolute"``.
    bodies : tuple of str
        Names of the two bodies.
    q : slice
        Columns of the joint in configurations. Empty if the file does not define a tree.
    v : slice
        Columns of the joint in rates, accelerations and joint forces.

    Examples
    --------
    >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
    >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
    >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
    >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
    >>> pendulum.joints
    [Joint(name='J1', type='revolute', bodies=('ground', 'ball'), q=slice(0, 1, None), v=slice(0, 1, None))]
    """

    name: str
    type: str
    bodies: tuple[str, str]
    q: slice
    v: slice


Joint.name.__doc__ = "Name of the joint."
Joint.type.__doc__ = "Type of the joint."
Joint.bodies.__doc__ = "Names of the two bodies."
Joint.q.__doc__ = "Columns in configurations."
Joint.v.__doc__ = "Columns in rates."


class Mechanism(_engine.Mechanism):
    """Bodies and joints of a file, of a dict with the keys of a file, or of a robot in URDF.

    The mobility needs no masses. All other methods need a tree, which is a mechanism without loops, and masses of the moving
    bodies. They act on rows of arrays and broadcast as NumPy does; the first axes are the axes of the batch. A configuration
    ``q`` has the numbers of all joints, in order: angles in radians, lengths, and unit quaternions ``w, x, y, z`` of rotations
    about a point. Rates ``v`` are their derivatives, and angular velocities of rotations about a point. All are zero, and
    quaternions are the identity, at the position of the file. Springs, dampers and forces of the file are ignored.
    ``docs/mechanisms.md`` describes the keys.

    Parameters
    ----------
    mechanism : path or dict
        TOML or JSON file, or a dict with its keys, such as ``{"urdf": "arm.urdf"}``.
    set : dict, optional
        New values of parameters, ``{"m": 2}``.
    gravity : sequence of float, optional
        Acceleration of gravity in the ground frame, instead of the key ``gravity`` of the file.

    Raises
    ------
    InputError
        A key or a formula is invalid.

    Examples
    --------
    >>> rod = {"name": "rod", "inertia": {"parts": [{"shape": "rod", "length": 1, "mass": 3, "position": [0, 0, -0.5]}]}}
    >>> hinge = {"name": "hinge", "type": "revolute", "bodies": ["ground", "rod"], "at": [0, 0, 0], "axis": [0, 1, 0]}
    >>> keys = {"bodies": [{"name": "ground", "fixed": True}, rod], "joints": [hinge]}
    >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
    >>> pendulum.mass_matrix([0.3]).round(12)
    array([[1.]])
    >>> pendulum.mobility()["mobility"]
    1
    """

    __slots__ = ("_arguments",)

    _arguments: tuple[str | None, str | None, list[str], list[float] | None]

    def __new__(
        cls,
        mechanism: str | os.PathLike[str] | Mapping[str, Any],
        *,
        set: Mapping[str, Any] | None = None,
        gravity: Sequence[float] | Floats | None = None,
    ) -> Self:
        symbols: Symbols = {}
        path = text = None
        if isinstance(mechanism, (str, os.PathLike)):
            path = os.fspath(mechanism)
        elif isinstance(mechanism, Mapping):
            text = json.dumps(document(mechanism, symbols))
        else:
            raise TypeError(f"a mechanism is a path or a dict, not {type(mechanism).__name__}")
        if not isinstance(set, (Mapping, type(None))):
            raise TypeError(f"set is a dict of parameters, not {type(set).__name__}")
        values = [f"{name}={text_of(value, symbols, floats=True)}" for name, value in (set or {}).items()]
        return cls._of(path, text, values, None if gravity is None else _vector(gravity))

    @classmethod
    def _of(cls, path: str | None, text: str | None, values: list[str], gravity: list[float] | None) -> Self:
        """Creates a mechanism from a file or a text, and stores the arguments for pickling."""
        made = super().__new__(cls, path, None if text is None else ("mechanism", text), values, gravity)
        made._arguments = (path, text, values, gravity)
        return made

    def __reduce__(self) -> Any:
        return type(self)._of, self._arguments

    def __repr__(self) -> str:
        return f"Mechanism({self.name!r}, {len(self.bodies)} bodies, {len(self._joints)} joints)"

    @property
    def joints(self) -> list[Joint]:
        """Joints, in the order of the file; those of a robot are first.

        Returns
        -------
        list of Joint

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.joints[0].bodies
        ('ground', 'ball')
        """
        bodies = self.bodies
        return [
            Joint(name, kind, (bodies[first], bodies[second]), slice(*q), slice(*v))
            for name, kind, (first, second), q, v in self._joints
        ]

    @property
    def coordinate_count(self) -> int:
        """Number of numbers of a configuration.

        Returns
        -------
        int

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.coordinate_count
        1
        """
        return self._sizes[0]

    @property
    def freedom(self) -> int:
        """Number of rates, the degrees of freedom of the tree.

        Returns
        -------
        int

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.freedom
        1
        """
        return self._sizes[1]

    def home(self) -> Floats:
        """Configuration at the position of the file.

        Returns
        -------
        array of the shape (coordinate_count,)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.home()
        array([0.])
        """
        return np.array(self._home)

    def mobility(self) -> Report:
        """Degrees of freedom with a proof, as ``affinor mobility`` prints them. Also for mechanisms with loops.

        Returns
        -------
        Report

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.mobility()["mobility"]
        1
        """
        return Report(self._mobility())

    def forward(self, q: ArrayLike, v: ArrayLike, tau: ArrayLike) -> Floats:
        """Accelerations ``v'`` for joint forces ``tau``, by the recursion of articulated bodies.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.
        v : array_like of the shape (..., freedom)
            Rates.
        tau : array_like of the shape (..., freedom)
            Joint forces: torques about axes, and forces along axes.

        Returns
        -------
        array of the shape (..., freedom)

        Raises
        ------
        MathematicsError
            The mechanism has loops, or a body beyond a joint has no mass.

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.forward([0.5], [0.0], [[0.0], [9.0]]).round(6)
        array([[-4.703165],
               [-0.203165]])
        """
        return self._forward(q, v, tau)

    def inverse(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Floats:
        """Joint forces for accelerations ``a``, by the recursion of Newton and Euler.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.
        v : array_like of the shape (..., freedom)
            Rates.
        a : array_like of the shape (..., freedom)
            Accelerations: the time derivatives of the rates.

        Returns
        -------
        array of the shape (..., freedom)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.inverse([0.5], [3.0], [0.0]).round(6)
        array([9.406329])
        """
        return self._inverse(q, v, a)

    def mass_matrix(self, q: ArrayLike) -> Floats:
        """Mass matrix ``M``: the kinetic energy is ``v.M.v/2``.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.

        Returns
        -------
        array of the shape (..., freedom, freedom)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.mass_matrix([0.5]).round(12)
        array([[2.]])
        """
        return self._mass_matrix(q)

    def kinetic_energy(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """Kinetic energy.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.
        v : array_like of the shape (..., freedom)
            Rates.

        Returns
        -------
        array of the shape (...)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> float(pendulum.kinetic_energy([0.5], [3.0]).round(12))
        9.0
        """
        return self._energies(q, v)[..., 0]

    def potential_energy(self, q: ArrayLike) -> Floats:
        """Potential energy of gravity, which is zero for a mass at the origin.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.

        Returns
        -------
        array of the shape (...)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> float(pendulum.potential_energy([0.0]).round(12))
        -19.62
        """
        return self._energies(q, np.zeros(self.freedom))[..., 1]

    def energy(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """Sum of the kinetic energy and the potential energy of gravity.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.
        v : array_like of the shape (..., freedom)
            Rates.

        Returns
        -------
        array of the shape (...)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> float(pendulum.energy([0.0], [3.0]).round(12))
        -10.62
        """
        return np.asarray(self._energies(q, v).sum(axis=-1))

    def momentum(self, q: ArrayLike, v: ArrayLike) -> Floats:
        """Momentum of all bodies in the ground frame: the angular momentum about the origin, then the linear momentum.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.
        v : array_like of the shape (..., freedom)
            Rates.

        Returns
        -------
        array of the shape (..., 6)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.momentum([0.0], [3.0]).round(12) + 0.0
        array([ 0.,  6.,  0., -6.,  0.,  0.])
        """
        return self._momentum(q, v)

    def poses(self, q: ArrayLike) -> Floats:
        """Poses of all bodies, as elements of :data:`affinor.SE3`: quaternions ``w, x, y, z``, and positions.

        The frame of each body is the ground frame at the position of the file.

        Parameters
        ----------
        q : array_like of the shape (..., coordinate_count)
            Configurations.

        Returns
        -------
        array of the shape (..., bodies, 7)

        Examples
        --------
        >>> ball = {"name": "ball", "inertia": {"parts": [{"shape": "points", "points": [[2, 0, 0, -1]]}]}}
        >>> hinge = {"type": "revolute", "bodies": ["ground", "ball"], "at": [0, 0, 0], "axis": [0, 1, 0]}
        >>> keys = {"bodies": [{"name": "ground", "fixed": True}, ball], "joints": [hinge]}
        >>> pendulum = Mechanism(keys, gravity=[0, 0, -9.81])
        >>> pendulum.poses([0.0])[1]
        array([1., 0., 0., 0., 0., 0., 0.])
        """
        return self._poses(q)


def _vector(gravity: Sequence[float] | Floats) -> list[float]:
    """Converts an acceleration to a list of three numbers."""
    array = np.asarray(gravity, dtype=float)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise ValueError(f"gravity should be 3 finite numbers, not {gravity!r}")
    return [float(value) for value in array]
