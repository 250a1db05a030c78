"""Functions as users write them; each is a claim that it can be traced and computes what NumPy computes."""

import functools
import math
from dataclasses import dataclass
from functools import partial
from math import atan2, exp, hypot, sin, sqrt
from typing import NamedTuple

import helpers_elsewhere
import numpy as np
from helpers_elsewhere import Aircraft, rotation
from numpy import arctan2, array, cos, eye, where, zeros
from numpy.linalg import norm

MATRIX = np.array([[0.0, 1.0, 0.0], [-2.0, -0.3, 0.5], [0.0, 0.0, -1.0]])
RATE = 0.7
TABLE = {"gain": 3.0, "law": lambda v: np.tanh(v)}
functions = []


def traced(function):
    """Adds a function of (t, x), three states, to the list."""
    functions.append(function)
    return function


def named(name, function):
    """Adds one that `def` does not make."""
    functions.append(function)
    try:
        function.__name__ = name
    except AttributeError:
        pass


@traced
def a_list(t, x):
    return [x[1], -x[0] * x[2], 0]


@traced
def a_tuple_with_time(t, x):
    return x[0] * t, t, 3.0


@traced
def vector_arithmetic(t, x):
    return 2 * x + x**2 / 3 - (1 - x) * -x


@traced
def unpacking(t, x):
    a, b, c = x
    first, *rest = x
    return a * b, sum(rest), c - first


@traced
def slices_and_views(t, x):
    y = x.copy()
    v = y[1:]
    v *= 2
    return np.append(y[::-1][:2], x[-1])


@traced
def zeros_and_assignment(t, x):
    y = np.zeros(3)
    y[0] = x[1]
    y[1:] = x[:2]
    y += 1
    y[0] *= 3
    return y


@traced
def zeros_like_and_empty(t, x):
    y, z = np.zeros_like(x), np.empty(3)
    y[1] = x[0]
    z[:] = y
    z[2] -= np.ones(2)[0] * x[1]
    return z


@traced
def constant_matrix(t, x):
    return MATRIX @ x + x @ MATRIX + MATRIX.dot(x) + np.dot(MATRIX, x) + np.matmul(x, MATRIX)


@traced
def matrix_with_symbols(t, x):
    f = np.eye(3)
    f[0, 1] = t
    f[1, 2] = x[0]
    return f @ f.T @ x


@traced
def rotation_from_elsewhere(t, x):
    return np.append(rotation(x[2]) @ x[:2], x[2])


@traced
def module_from_elsewhere(t, x):
    return helpers_elsewhere.filled(x) + helpers_elsewhere.np.cos(x)


@traced
def from_math_import(t, x):
    return [sin(x[0]), exp(-abs(x[1])), sqrt(x[2] ** 2 + 1)]


@traced
def math_module(t, x):
    a = math.atan2(x[0], x[1]) + math.hypot(x[0], x[1], x[2]) + math.fabs(x[0]) + math.pow(abs(x[1]), 1.5)
    b = math.log(1 + x[0] ** 2, 2) + math.radians(x[1]) + math.copysign(x[0], x[1]) + math.pi
    return a, b, math.fsum([x[0], x[1], 1.0]) + math.prod(x) + math.dist(x[:2], [1.0, 2.0])


@traced
def from_numpy_import(t, x):
    y = zeros(3)
    y[:2] = cos(x[:2])
    return where(x > 0, y, arctan2(x, 2.0)) + eye(3) @ array([1.0, x[0], 2])


@traced
def import_inside(t, x):
    from math import tan

    import numpy as linear

    y = linear.zeros(3)
    y[1] = tan(x[0] / 1e3)
    return y


@traced
def atan2_hypot(t, x):
    return [atan2(x[1], x[0]), hypot(x[0], x[2]), norm(x)]


@traced
def where_and_conditions(t, x):
    a = np.where((x > 0) & (x < 1), x, -x)
    b = np.where((x[0] > 0) | ~(x[1] >= 0.5), 1.0, x[2])
    return a * b + np.where(x != x[0], 1, 2) + (x[0] <= 3)


@traced
def logical(t, x):
    c = np.logical_and(x > -1, np.logical_not(x > 1)) ^ (x[0] > 0)
    return np.where(np.logical_or(c, x < -5), x, 0.0)


@traced
def select(t, x):
    return np.select([x < -1, x < 1], [x**2, -x], default=7)


@traced
def piecewise(t, x):
    return np.piecewise(x, [x < 0, x >= 0], [lambda v: -v, lambda v: v**2])


@traced
def clip_and_extremes(t, x):
    a = np.clip(x, -1, 1) + x.clip(0, None) + np.minimum(x, x[0]) + np.maximum(0, x)
    return a + np.max(x) - x.min() + np.fmax(x, 0.5) - np.fmin(x, 2) + np.ptp(x)


@traced
def sums(t, x):
    return [np.sum(x), x.sum() + np.prod(x) + sum(x), np.mean(x) + x.mean() + np.std(x) + np.var(x, ddof=1)]


@traced
def sums_over_axes(t, x):
    m = np.outer(x, x) + MATRIX
    return m.sum(axis=0) + np.sum(m, 1) + np.mean(m, axis=1, keepdims=True)[:, 0] + m.sum() + m.max(axis=0)


@traced
def einsum(t, x):
    return np.einsum("ij,j->i", MATRIX, x) + np.einsum("i,i->", x, x) + np.einsum("ij,j,k->k", MATRIX, x, x)


@traced
def products(t, x):
    c = np.cross(x, [1.0, 2.0, x[0]])
    return c + np.inner(x, x) + np.vdot(x, c) + np.kron(x[:1], x) + np.tensordot(MATRIX, x, axes=1)


@traced
def norms(t, x):
    return [np.linalg.norm(x), np.linalg.norm(x, 1) + norm(x, np.inf), np.linalg.norm(np.outer(x, x))]


@traced
def norm_over_axis(t, x):
    return np.linalg.norm(np.vstack([x, 2 * x, x + 1]), axis=1)


@traced
def solve(t, x):
    a = MATRIX + 3 * np.eye(3) + 0.1 * np.outer(np.sin(x), np.cos(x))
    return np.linalg.solve(a, x) + np.linalg.inv(a) @ np.ones(3) + np.linalg.det(a)


@traced
def solve_with_numbers(t, x):
    return np.linalg.solve(MATRIX - np.eye(3), x) + np.linalg.inv(MATRIX - np.eye(3)) @ x


@traced
def solve_six(t, x):
    a = 4 * np.eye(6)
    a[:3, 3:] = np.diag(np.sin(x))
    a[3:, :3] = np.outer(np.cos(x), np.tanh(x))
    return np.linalg.solve(a, np.concatenate([x, x]))[2:5]


@traced
def cholesky(t, x):
    a = np.outer(np.sin(x), np.sin(x)) + np.diag([1.0, 2.0, 3.0])
    return np.linalg.cholesky(a) @ x + np.linalg.slogdet(a)[1] + np.trace(np.linalg.matrix_power(a, 3))


@traced
def joining(t, x):
    a = np.hstack([x[:1], [0.0], x[2:]])
    b = np.concatenate([x[1:], x[:1]])
    c = np.stack([a, b]).sum(axis=0) + np.vstack([a, b])[1] + np.column_stack([a, b])[:, 0]
    return c + np.r_[x[0], x[1:]] + np.array([x, a]).T[:, 1] + np.block([x[:1], x[1:]])


@traced
def shapes(t, x):
    m = np.reshape(np.tile(x, 2), (2, 3))
    m = m + np.arange(6).reshape(2, 3)
    return m.T.ravel()[:3] + m[0] + np.squeeze(m[:1]) + np.broadcast_to(x[0], 3) + m.flatten()[3:] + x[np.newaxis, :][0]


@traced
def moves(t, x):
    a = np.roll(x, 1) + np.flip(x) + np.diff(np.append(x, 0.0)) + np.cumsum(x) + np.cumprod(x) + x.cumsum()
    return a + np.diag(np.diag(x)) + np.tril(np.outer(x, x))[:, 0] + np.repeat(x[:1], 3) + np.atleast_1d(x[0])


@traced
def fancy_indices(t, x):
    index = np.array([2, 0, 1])
    return x[index] + x[[0, 0, 1]] + MATRIX[index] @ x + x[np.array([True, True, True])]


@traced
def elementary(t, x):
    a = np.abs(x) + 0.1
    b = np.sqrt(a) + np.cbrt(x) + np.square(x) + np.reciprocal(a) + np.exp(-a) + np.exp2(-a) + np.log(a)
    return b + np.log2(a) + np.log10(a) + np.sign(x) + np.fabs(x) + np.negative(x) + np.positive(x)


@traced
def close_to_zero(t, x):
    y = np.sin(x) * 1e-9
    return np.expm1(y) / 1e-9 + np.log1p(y) / 1e-9 + np.sinc(y) + np.arcsinh(y) / 1e-9 + np.arctanh(y) / 1e-9


@traced
def trigonometric(t, x):
    a = np.sin(x)
    b = np.cos(x) + np.tan(a) + np.arcsin(a) + np.arccos(a) + np.arctan(x) + np.arctan2(x, a) + np.hypot(x, a)
    return b + np.deg2rad(x) + np.rad2deg(x) + np.radians(a) + np.degrees(a)


@traced
def hyperbolic(t, x):
    a = np.tanh(x)
    b = np.sinh(a) + np.cosh(a) + np.arctanh(0.9 * a) + np.arcsinh(x) + np.arccosh(1 + np.abs(x))
    return b + np.logaddexp(x, a) + np.expm1(a) + np.log1p(np.abs(x)) + np.sinc(a)


@traced
def rounding(t, x):
    a = np.floor(x) + np.ceil(x) + np.trunc(x) + np.rint(x) + np.round(x, 2) + np.fix(x) + x.round(1)
    return a + math.floor(x[0]) + math.ceil(x[1]) + math.trunc(x[2]) + np.heaviside(x, 0.5) + np.copysign(x, x[0])


@traced
def remainders(t, x):
    return (x + np.pi) % (2 * np.pi) - np.pi + x // 3 + np.mod(x, 2.5) + np.fmod(x, 2.5) + divmod(x[0], 2)[1]


@traced
def wrapped_angle(t, x):
    return np.arctan2(np.sin(x - 1), np.cos(x - 1))


@traced
def powers(t, x):
    return [x[0] ** 3 + x[1] ** -1, np.abs(x[1]) ** 0.5 + np.power(2.0, x[2] / 1e6), pow(x[0], 2) + 2 ** np.sin(x[1])]


@traced
def polynomial(t, x):
    return np.polyval([1.0, -2.0, 0.5], x) + sum(c * x**k for k, c in enumerate([0.1, 0.2, 0.3]))


@traced
def interpolation(t, x):
    return np.interp(x, [-1.0, 0.0, 2.0, 5.0], [3.0, -1.0, 4.0, 0.0])


@traced
def loop(t, x):
    y = np.array(x)
    for i in range(3):
        for j in range(len(x)):
            if i != j:
                y[i] += np.sin(x[j] - x[i]) / (i + j + 1)
    return y


@traced
def lorenz_96(t, x):
    return (np.roll(x, -1) - np.roll(x, 2)) * np.roll(x, 1) - x + 8


@traced
def comprehension(t, x):
    return np.array([v * w for v, w in zip(x, reversed(x))])


@traced
def globals_and_tables(t, x):
    return RATE * TABLE["gain"] * TABLE["law"](x)


@traced
def numpy_scalars(t, x):
    return np.float64(2.0) * x + np.float64(x[0]) + np.int64(3) * x[1] + np.float32(0.5)


@traced
def nan_handling(t, x):
    return np.where(np.isfinite(x), np.nan_to_num(x), 0.0) + np.where(np.isnan(x) | np.isinf(x), 1.0, 2.0)


@traced
def nested_functions(t, x):
    def force(v, k=RATE):
        out = np.zeros(3)
        out[0] = k * v[1]
        return out

    return force(x) + (lambda v: np.asarray(v, dtype=float))(x)


@traced
def statistics(t, x):
    return [np.average(x, weights=[1, 2, 3]), np.count_nonzero(x > 0) * 1.0, np.linspace(x[0], x[1], 5)[2]]


@traced
def two_results(t, x):
    fraction, whole = np.modf(x)
    quotient, rest = np.divmod(x, 0.7)
    return fraction + whole + np.sin(quotient) * 0 + rest


@traced
def ufunc_methods(t, x):
    return np.add.reduce(x) + np.multiply.outer(x, x)[0] + np.maximum.reduce(x) + np.add.accumulate(x)


@traced
def written_into(t, x):
    y = np.empty(3)
    np.multiply(x, 2, out=y)
    np.fill_diagonal(m := np.zeros((3, 3)), x)
    return y + m @ x


@traced
def empty_sum(t, x):
    return x * 0 + np.full(3, t) + np.full(3, x[0]) + np.ones_like(x) + np.full_like(x, 2.0)


def _make(gain):
    offset = np.array([1.0, 2.0, 3.0])

    def helper(v):
        y = np.zeros(3)
        y[:] = v * gain + offset
        return y

    def closure(t, x):
        return helper(x)

    return closure


def _with_gain(t, x, gain, *, name="linear"):
    return gain * x if name == "linear" else x


def _doubled(function):
    @functools.wraps(function)
    def inner(t, x):
        return 2 * np.asarray(function(t, x))

    return inner


@dataclass(frozen=True)
class _Pendulum:
    length: float = 2.0

    def __call__(self, t, x):
        y = np.zeros(3)
        y[0], y[1] = x[1], -9.81 / self.length * math.sin(x[0])
        return y


class _Base:
    def rate(self, x):
        y = np.zeros(3)
        y[0] = x[2]
        return y


class _Derived(_Base):
    def drift(self, t, x):
        return self.rate(x) + self.constant()

    @classmethod
    def constant(cls):
        return np.ones(3)


named("a_closure", _make(2.5))
named("a_partial", partial(_with_gain, gain=2.0))
named("a_lambda", lambda t, x: [math.sin(x[0]), x[1], -x[2]])
named("a_bound_method", Aircraft(3.0).drift)
named("a_callable", Aircraft(3.0))
named("a_dataclass", _Pendulum())
named("an_inherited_method", _Derived().drift)
named("a_decorated_function", _doubled(a_list))


class _Slots:
    __slots__ = ("gain",)

    def __init__(self, gain):
        self.gain = gain

    def drift(self, t, x):
        y = np.zeros(3)
        y[0] = self.gain * x[0]
        return y


class _Point(NamedTuple):
    x: float
    y: float

    def distance(self):
        return math.hypot(self.x, self.y)


@dataclass
class _State:
    a: float
    b: float
    c: float

    @classmethod
    def of(cls, x):
        return cls(*x)

    def rates(self):
        out = np.empty(3)
        out[:] = [self.b, -self.a, math.sin(self.c)]
        return out


def _even(n, x):
    return x[0] if n == 0 else _odd(n - 1, x)


def _odd(n, x):
    return math.sin(x[1]) if n == 0 else _even(n - 1, x)


def _cosines(x):
    for value in x:
        yield math.cos(value)


@functools.lru_cache
def _eye(n):
    return np.eye(n)


@traced
def a_named_tuple(t, x):
    return [_Point(x[0], x[1]).distance(), *_Point(x[1], x[2])]


@traced
def a_state_class(t, x):
    return _State.of(x).rates()


@traced
def mutual_recursion(t, x):
    return [_even(4, x), _odd(4, x), _even(3, x)]


@traced
def a_generator_and_a_cache(t, x):
    return _eye(3) @ np.array(list(_cosines(x)))


@traced
def guards_on_shapes(t, x):
    if len(x) != 3 or x.ndim != 1 or t is None:
        raise ValueError("three states")
    x = np.asarray(x, dtype=np.float64) if isinstance(x, np.ndarray) else x
    return x.astype(float) * 2


@traced
def lists_of_values(t, x):
    return [np.linalg.norm([x[0], x[1]]), np.max([x[0], x[1]]) + np.dot([x[0], 1], [2, x[1]]), np.arctan2(*x[:2])]


named("slots", _Slots(2.0).drift)


@traced
def shares(t, x):
    return [np.logaddexp(x[0], 0), np.logaddexp2(x[1], 0), np.logaddexp.reduce(x / 100), np.logaddexp(-np.inf, x[2])][
        :3
    ]


@traced
def beyond_overflow(t, x):
    y = x * 1e155
    return np.arcsinh(y) + np.arccosh(1 + np.abs(y)) + np.expm1(-np.abs(y)) + np.arcsinh(np.exp(x))


@traced
def periods_of_time(t, x):
    k = np.rint(t * 100)
    return [(k * 0.1) % 0.1 + x[0], (k * 0.1) // 0.1, np.fmod(k * 0.7, 0.7) + divmod(k * 0.1, 0.1)[0]]


@traced
def remainders_by_a_state(t, x):
    return (x + 1e6) % x[0] + x // x[1] + np.fmod(x, -x[2])


@traced
def exponents(t, x):
    y = 2.0 ** np.floor(x)
    return [np.floor(np.log2(y[0])), np.floor(np.log2(y[1])), np.ceil(np.log2(y[2]))]


@traced
def results_put_elsewhere(t, x):
    y, z = np.array([t * 10, x[0], x[1]]), np.array(x)
    np.clip(y, -1, 1.5, out=y)
    z.clip(-0.5, None, out=z)
    w = np.zeros(3)
    np.dot(MATRIX, x, out=w)
    np.cumsum(z, out=z)
    np.round(w, 1, out=w)
    np.nan_to_num(z, copy=False)
    return y + z + w


@traced
def sums_of_conditions(t, x):
    both = (x > 0) + (x > 0.5)
    return [both.astype(float)[0], np.sum(x > 0) * 1.0 + np.mean(x > 1), ((x[0] > 0) + (x[0] > 1)) * x[1] + sum(x > 0)]


@traced
def nearly_the_same(t, x):
    return np.where(np.isclose(x, np.where(x > 2, np.inf, x[0])), 1.0, 2.0) + np.isclose(1 / (x - x), np.inf)


@traced
def error_functions(t, x):
    return [math.erf(x[0]), math.erfc(x[1]), math.erf(0.5) + math.erfc(-x[2] * t)]
