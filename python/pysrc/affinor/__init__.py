"""Differential geometry of Lie groups: torsion, curvature, groups and motions, in exact, symbolic or floating-point numbers.

Conventions: ``[e_j, e_k] = c^i_jk e_i``, ``nabla_{e_j} e_k = Lambda^i_jk e_i``, ``R(e_k, e_l) e_j = R^i_jkl e_i``. Indices
count from 0 in Python and from 1 in printed output. Quaternions are ``w, x, y, z``.
"""

from importlib.metadata import version as _version

from affinor._engine import clear_caches, set_threads, threads
from affinor._geometries import Geometries
from affinor._limits import limits
from affinor._points import PointValues
from affinor._sweep import RandomSample, SimulationTask, Sweep, sweep
from affinor.algebra import Check, LieAlgebra, catalogue
from affinor.errors import (
    AffinorError,
    AntisymmetryError,
    ClosureError,
    ConstructionError,
    DependentError,
    InputError,
    IntegrationError,
    InternalError,
    JacobiError,
    LimitError,
    MathematicsError,
    MetricError,
    ShapeError,
    SymmetryError,
)
from affinor.factorization import KakFactors, TwoQubitKak, kak, two_qubit_kak
from affinor.geometry import Geodesic, Geometry, Property, check, compare, conventions
from affinor.group import SE2, SE3, SE2_3, SL2, SO2, SO3, Group, RigidMotionGroup, RotationGroup, Spline, groups
from affinor.mechanism import Joint, Mechanism
from affinor.motion import Convergence, Problem, Trajectory, convergence, methods, simulate
from affinor.representation import Representation, clebsch_gordan, wigner_3j, wigner_6j
from affinor.structure import Report
from affinor.tensor import Tensor, contract

__version__ = _version("affinor")

__all__ = [
    "SE2",
    "SE3",
    "SE2_3",
    "SL2",
    "SO2",
    "SO3",
    "AffinorError",
    "AntisymmetryError",
    "Check",
    "ClosureError",
    "ConstructionError",
    "Convergence",
    "DependentError",
    "RandomSample",
    "Geodesic",
    "Geometries",
    "Geometry",
    "Group",
    "InputError",
    "IntegrationError",
    "InternalError",
    "JacobiError",
    "Joint",
    "KakFactors",
    "LieAlgebra",
    "LimitError",
    "MathematicsError",
    "Mechanism",
    "MetricError",
    "SimulationTask",
    "PointValues",
    "Problem",
    "Property",
    "Report",
    "Representation",
    "RigidMotionGroup",
    "RotationGroup",
    "ShapeError",
    "Spline",
    "Sweep",
    "SymmetryError",
    "Tensor",
    "Trajectory",
    "TwoQubitKak",
    "catalogue",
    "check",
    "clear_caches",
    "clebsch_gordan",
    "compare",
    "contract",
    "convergence",
    "conventions",
    "groups",
    "kak",
    "limits",
    "methods",
    "set_threads",
    "simulate",
    "sweep",
    "threads",
    "two_qubit_kak",
    "wigner_3j",
    "wigner_6j",
]
