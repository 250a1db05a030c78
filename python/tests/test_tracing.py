"""Traced functions compute what the functions compute."""

import functools
import math

import numpy as np
import pytest
from functions_to_trace import functions
from hypothesis import given, settings
from hypothesis import strategies as st

from givens._native import Graph
from givens._trace.arguments import read_arguments
from givens._trace.check import compare
from givens._trace.derivatives import compare_slopes
from givens._trace.traced import Sizes
from givens._trace.tracer import trace

SIZES = Sizes(3, 0)


def name_of(function):
    return getattr(function, "__name__", type(function).__name__)


@functools.cache
def traced(index):
    function = functions[index]
    return trace(function, read_arguments("drift", function, ("t", "x"), ()), SIZES)


def values(tape_of, x, t):
    graph = Graph()
    nodes = tape_of.tape.lay_into(graph, tape_of.nodes)
    return graph.evaluate(nodes, x, t, 0.0, np.empty(0), tape_of.arguments.values)


def test_there_are_at_least_sixty():
    assert len(functions) >= 60


@pytest.mark.parametrize("index", range(len(functions)), ids=map(name_of, functions))
def test_a_trace_computes_what_the_function_does(index):
    function = functions[index]
    compare(function, traced(index), SIZES, ())
    assert compare_slopes(function, traced(index), SIZES, ()) is None
    rng = np.random.default_rng(index)
    compared = 0
    for scale in (0.1, 1.0, 20.0):
        for _ in range(8):
            x, t = rng.normal(size=3) * scale, rng.uniform(0, 5)
            with np.errstate(all="ignore"):
                real = np.asarray(function(t, x.copy()), dtype=float).ravel()
            np.testing.assert_allclose(values(traced(index), x, t), real, rtol=1e-10, atol=1e-12 * (1 + scale**3))
            compared += np.isfinite(real).all()
    assert compared >= 12


NUMBER = st.floats(-1e3, 1e3, allow_subnormal=False)


@settings(max_examples=150, deadline=None)
@given(st.integers(0, len(functions) - 1), st.lists(NUMBER, min_size=3, max_size=3), st.floats(0, 10))
def test_no_ordinary_point_tells_a_trace_from_its_function(index, x, t):
    function, x = functions[index], np.array(x)
    with np.errstate(all="ignore"):
        try:
            real = np.asarray(function(t, x.copy()), dtype=float).ravel()
            near = np.asarray(function(t, x * (1 + 2.0**-50)), dtype=float).ravel()
        except (ArithmeticError, ValueError, np.linalg.LinAlgError):
            return
    if name_of(function) in ("remainders", "two_results", "rounding"):
        return  # at their jumps rounding decides
    if name_of(function) == "remainders_by_a_state" and 1e6 + 2 * np.abs(x).max() > 2.0**52 * np.abs(x).min():
        return  # see the next test
    found = np.nan_to_num(values(traced(index), x, t), nan=1e300)
    fine = np.isfinite(real) & np.isfinite(near)
    real, near = np.where(fine, real, 0.0), np.where(fine, near, 0.0)
    room = 1e-9 * (1 + np.abs(real)) + 1e4 * np.abs(real - near)
    assert np.all((np.abs(found - real) <= room) | ~fine)


@pytest.mark.parametrize("divisor", [1e-17, -1e-80, 3.65e-258])
def test_a_remainder_of_which_no_digit_is_left_is_nan(divisor):
    def drift(t, x):
        return [x[0] % x[1], math.fmod(x[0], x[1])]

    sizes = Sizes(2, 0)
    tape = trace(drift, read_arguments("drift", drift, ("t", "x"), ()), sizes)
    assert np.isnan(values(tape, np.array([1.0, divisor]), 0.0)).all()
    assert values(tape, np.array([1.0, 0.3]), 0.0) == pytest.approx([math.fmod(1.0, 0.3)] * 2, rel=1e-15)
