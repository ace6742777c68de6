"""Checks of affinor.jax or affinor.torch, run as a program of its own: these libraries have threads, and other tests fork.

    python differentials.py jax|torch

Derivatives are compared with central differences of 60 digits. It prints the derivatives as JSON.
"""

import functools
import importlib
import json
import sys
import time

import mpmath as mp
import numpy as np

import affinor as af

mp.mp.dps = 60
STEP = mp.mpf(10) ** -20


def unit(q):
    size = mp.sqrt(sum(c * c for c in q))
    return [c / size for c in q]


def product(p, q):
    a, b, c, d = p
    e, f, g, h = q
    return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e]


def turned(q, p):
    w, x, y, z = q
    return product(product(q, [mp.mpf(0), *p]), [w, -x, -y, -z])[1:]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def exp3(x):
    size = mp.sqrt(sum(c * c for c in x))
    ratio = mp.mpf(1) / 2 if size == 0 else mp.sin(size / 2) / size
    return [mp.cos(size / 2), *(ratio * c for c in x)]


def log3(q):
    w, *v = unit(q)
    if w < -mp.mpf(10) ** -15:
        w, v = -w, [-c for c in v]
    size = mp.sqrt(sum(c * c for c in v))
    ratio = mp.mpf(2) / w if size == 0 else 2 * mp.atan2(size, w) / size
    return [ratio * c for c in v]


def tangent(w, u, inverse):
    """The matrix sum of ad^k/(k + 1)!, or its inverse, times a vector."""
    z = sum(c * c for c in w)
    size = mp.sqrt(z)
    if size == 0:
        return u
    once, twice = cross(w, u), cross(w, cross(w, u))
    if inverse:
        d = (1 - size / 2 * mp.cot(size / 2)) / z
        return [u[i] - once[i] / 2 + d * twice[i] for i in range(3)]
    return [u[i] + (1 - mp.cos(size)) / z * once[i] + (size - mp.sin(size)) / (z * size) * twice[i] for i in range(3)]


def exp6(x):
    return [*exp3(x[:3]), *tangent(x[:3], x[3:], False)]


def log6(g):
    w = log3(g[:4])
    return [*w, *tangent(w, g[4:], True)]


def compose6(x):
    g, h = [*unit(x[:4]), *x[4:7]], [*unit(x[7:11]), *x[11:]]
    moved = turned(g[:4], h[4:])
    return [*product(g[:4], h[:4]), *(a + b for a, b in zip(g[4:], moved, strict=True))]


def inverse6(g):
    w, x, y, z = unit(g[:4])
    back = [w, -x, -y, -z]
    return [*back, *(-c for c in turned(back, g[4:]))]


def act6(x):
    moved = turned(unit(x[:4]), x[7:])
    return [a + b for a, b in zip(x[4:7], moved, strict=True)]


def compose3(x):
    return product(unit(x[:4]), unit(x[4:]))


def inverse3(q):
    w, x, y, z = unit(q)
    return [w, -x, -y, -z]


def act3(x):
    return turned(unit(x[:4]), x[4:])


EXACT = {
    "SO3": {"exp": exp3, "log": log3, "compose": compose3, "inverse": inverse3, "act": act3},
    "SE3": {"exp": exp6, "log": log6, "compose": compose6, "inverse": inverse6, "act": act6},
}


def differences(function, x):
    """The matrix of central differences."""
    x = [mp.mpf(float(c)) for c in x]
    columns = []
    for at in range(len(x)):
        ends = [function([c + sign * STEP * (k == at) for k, c in enumerate(x)]) for sign in (1, -1)]
        columns.append([float((a - b) / (2 * STEP)) for a, b in zip(*ends, strict=True)])
    return np.array(columns).T


class Jax:
    def __init__(self):
        import jax

        jax.config.update("jax_enable_x64", True)
        self.jax, self.float32 = jax, jax.numpy.float32
        self.groups = importlib.import_module("affinor.jax")

    def array(self, x, dtype=None):
        return self.jax.numpy.asarray(x, dtype=dtype)

    @functools.cache  # noqa: B019
    def compiled(self, transform, f, count):
        return self.jax.jit(transform(f, argnums=tuple(range(count))))

    def forward(self, f, *x):
        return [np.asarray(m) for m in self.compiled(self.jax.jacfwd, f, len(x))(*x)]

    def reverse(self, f, *x):
        return [np.asarray(m) for m in self.compiled(self.jax.jacrev, f, len(x))(*x)]

    def vmap(self, f, axes):
        return self.jax.jit(self.jax.vmap(f, in_axes=axes))

    def gradient_of_sum(self, f, x):
        return self.jax.grad(lambda y: f(y).sum())(x)


class Torch:
    def __init__(self):
        import torch

        self.torch, self.float32 = torch, torch.float32
        self.groups = importlib.import_module("affinor.torch")

    def array(self, x, dtype=None):
        return self.torch.as_tensor(np.asarray(x, dtype=float), dtype=dtype or self.torch.float64)

    def forward(self, f, *x):
        return [m.numpy() for m in self.torch.func.jacfwd(f, argnums=tuple(range(len(x))))(*x)]

    def reverse(self, f, *x):
        found = self.torch.autograd.functional.jacobian(f, x)
        return [m.numpy() for m in found]

    def vmap(self, f, axes):
        return self.torch.vmap(f, in_dims=axes)

    def gradient_of_sum(self, f, x):
        x = x.clone().requires_grad_()
        f(x).sum().backward()
        return x.grad


def points(name):
    """Vectors at all angles up to half a turn and beyond."""
    axis = np.array([2.0, -1.0, 2.0]) / 3
    for angle in (0.0, 1e-9, 1e-4, 0.7, 3.0, np.pi - 1e-9, np.pi, 4.0):
        x = angle * axis
        yield angle, x if name == "SO3" else np.concatenate([x, [0.5, -1.0, 2.0]])
    # exactly half a turn about an axis of coordinates: w vanishes
    yield "w = 0", None


def derivatives(own):
    """Each operation at each point: values, forward and reverse derivatives beside the exact ones."""
    found = {}
    for name, exact in EXACT.items():
        group, engine = getattr(own.groups, name), getattr(af, name)
        rest = [] if name == "SO3" else [1.0, 2.0, -0.5]
        h = engine.exp(np.arange(1, engine.dimension + 1) / 5)
        p = np.array([0.3, -2.0, 1.0])
        for label, x in points(name):
            g = np.array([0.0, 1.0, 0.0, 0.0, *rest]) if x is None else engine.exp(x)
            calls = {"log": (g,), "inverse": (g,), "compose": (g, h), "act": (g, p)}
            if x is not None:
                calls["exp"] = (x,)
            for operation, arguments in calls.items():
                key = f"{name}.{operation} at {label}"
                function = getattr(group, operation)
                given = [own.array(a) for a in arguments]
                value = np.asarray(function(*given))
                flat = [mp.mpf(float(c)) for a in arguments for c in a]
                np.testing.assert_allclose(value, [float(c) for c in exact[operation](flat)], atol=1e-14, err_msg=key)
                expected = differences(exact[operation], np.concatenate(arguments))
                for method in (own.forward, own.reverse):
                    matrix = np.concatenate(method(function, *given), axis=-1)
                    assert np.isfinite(matrix).all(), key
                    np.testing.assert_allclose(matrix, expected, atol=2e-13 * max(1, np.abs(expected).max()), err_msg=key)
                found[key] = matrix.tolist()
    return found


def batches(own):
    """A batch, vmap over any axes, and single elements: the same numbers."""
    rng = np.random.default_rng(0)
    for name in ("SO2", "SO3", "SE2", "SE3", "SE2_3", "SL2"):
        group, engine = getattr(own.groups, name), getattr(af, name)
        x = rng.normal(scale=0.5, size=(4, 5, engine.dimension))
        g, h = engine.exp(x), engine.exp(x[::-1])
        np.testing.assert_array_equal(np.asarray(group.exp(own.array(x))), engine.exp(x))
        compose = engine.compose(g, h)
        np.testing.assert_array_equal(np.asarray(own.vmap(group.compose, (0, 0))(own.array(g), own.array(h))), compose)
        np.testing.assert_array_equal(np.asarray(own.vmap(group.compose, (1, None))(own.array(g), own.array(h[:, 0]))).swapaxes(0, 1), engine.compose(g, h[:, :1]))
        twice = own.vmap(own.vmap(group.log, (0,)), (0,))
        np.testing.assert_array_equal(np.asarray(twice(own.array(g))), engine.log(g))
        # the gradient of a batch is that of its elements
        rates = np.asarray(own.gradient_of_sum(group.exp, own.array(x)))
        for at in ((0, 0), (3, 4)):
            single = np.asarray(own.gradient_of_sum(group.exp, own.array(x[at])))
            np.testing.assert_allclose(rates[at], single, atol=1e-14)
        size = engine.generators().shape[-1]
        p = rng.normal(size=(4, 1, size))
        np.testing.assert_allclose(np.asarray(group.act(own.array(g), own.array(p))), engine.act(g, p), atol=1e-14)
        one = np.asarray(own.gradient_of_sum(lambda y: group.act(own.array(g), y), own.array(p)))
        np.testing.assert_allclose(one, engine.matrix(g).sum(axis=(1, 2))[:, None], atol=1e-13)


def types(own):
    """float32 stays float32, and is the rounded result."""
    x = np.random.default_rng(1).normal(size=(7, 3)).astype(np.float32)
    given = own.array(x, own.float32)
    for found, exact in [
        (own.groups.SO3.exp(given), af.SO3.exp(x)),
        (own.gradient_of_sum(own.groups.SO3.exp, given), None),
    ]:
        assert found.dtype == own.float32
        if exact is not None:
            np.testing.assert_array_equal(np.asarray(found), exact.astype(np.float32))
    q = own.groups.SO3.exp(given)
    assert own.groups.SO3.compose(q, q).dtype == own.groups.SO3.log(q).dtype == own.float32


def refusals(own):
    group = own.groups.SO3
    bad = np.asarray(group.log(own.array([[1.0, 0, 0, 0], [0, 0, 0, 0], [np.nan, 0, 0, 1]])))
    assert np.isfinite(bad[0]).all() and np.isnan(bad[1:]).all()
    rates = np.asarray(own.gradient_of_sum(group.log, own.array([[1.0, 0, 0, 0], [0, 0, 0, 0]])))
    assert np.isfinite(rates[0]).all() and np.isnan(rates[1]).all()
    for call in (lambda: group.exp(own.array([1.0, 2])), lambda: group.act(own.array([1.0, 0, 0, 0]), own.array([1.0, 2]))):
        try:
            call()
        except ValueError as error:
            assert "shape" in str(error)
        else:
            raise AssertionError("a wrong shape was taken")
    identity, imaginary = own.array([1.0, 0, 0, 0]), own.array([0.0, 0, 0]) + 1j
    for call in (lambda: group.exp(imaginary), lambda: group.act(identity, imaginary)):
        try:
            call()
        except TypeError as error:
            assert "real numbers, not of dtype" in str(error)
        else:
            raise AssertionError("complex numbers were taken")
    try:
        own.forward(lambda x: own.forward_raw(group.exp, x), own.array([0.1, 0.2, 0.3]))
    except NotImplementedError as error:
        assert "second derivatives" in str(error)
    else:
        raise AssertionError("a second derivative was computed")


def second(own):
    if isinstance(own, Jax):
        own.forward_raw = lambda f, x: own.jax.jacfwd(f)(x)
    else:
        own.forward_raw = lambda f, x: own.torch.func.jacfwd(f)(x)


def large(own):
    """A batch on all threads, within a compiled function where there is one."""
    x = np.random.default_rng(2).normal(size=(200_000, 3))
    found = own.vmap(own.groups.SO3.exp, (0,))(own.array(x))
    np.testing.assert_array_equal(np.asarray(found), af.SO3.exp(x))
    assert np.isfinite(np.asarray(own.gradient_of_sum(own.groups.SO3.exp, own.array(x[:20_000])))).all()


def main():
    own = Jax() if sys.argv[1] == "jax" else Torch()
    second(own)
    begun = time.perf_counter()
    for check in (batches, types, refusals, large):
        check(own)
        print(f"{check.__name__} {time.perf_counter() - begun:.1f} s", file=sys.stderr)
    found = derivatives(own)
    print(f"derivatives {time.perf_counter() - begun:.1f} s", file=sys.stderr)
    print(json.dumps(found))


if __name__ == "__main__":
    main()
