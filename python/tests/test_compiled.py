"""Functions of C: what they are called with, and what is said of those that are not what they should be."""

import ctypes
from ctypes import c_double, c_float, c_void_p

import numpy as np
import pytest

import givens as gv

POINTER = ctypes.POINTER(c_double)
MOVE = ctypes.CFUNCTYPE(None, c_double, POINTER, POINTER, POINTER)
PRIOR = gv.Gaussian([1.0], std=[1e-6])
DRIFT = "`drift` is a function of C "
PLAIN = "\n  help: write void f(double t, const double *x, const double *p, double *out)"


def sde(drift, **options):
    return gv.Sde(drift, diffusion=[0.1], state=["x"], **options)


def of(*types):
    return ctypes.CFUNCTYPE(*types)(lambda *_: None)


@MOVE
def still(t, x, p, out):
    out[0] = 0.0


@MOVE
def scaled(t, x, p, out):
    out[0] = p[0] * x[0] + p[1]


REFUSED = [
    (lambda: sde(of(None, c_double, POINTER, POINTER)), DRIFT + "with 3 arguments, and it is given 4" + PLAIN),
    (
        lambda: sde(of(None, c_float, POINTER, POINTER, POINTER)),
        DRIFT + "whose argument 1 is c_float, not double" + PLAIN,
    ),
    (
        lambda: sde(of(None, c_double, POINTER, ctypes.POINTER(c_float), POINTER)),
        DRIFT + "whose argument 3 is LP_c_float, not double *" + PLAIN,
    ),
    (
        lambda: sde(of(c_double, c_double, POINTER, POINTER, POINTER)),
        DRIFT + "that gives c_double, and its results are to be written to `out`" + PLAIN,
    ),
    (
        lambda: gv.Transition(still, noise_cov=[[1.0]], state=["x"]),
        "`f` is a function of C with 4 arguments, and it is given 5\n"
        "  help: write void f(double t, double dt, const double *x, const double *p, double *out)",
    ),
    (
        lambda: gv.Sde(lambda t, x: x, diffusion=still, state=["x"]),
        "`diffusion` is a function of C, and can only be one that is traced, or numbers\n"
        "  help: write def diffusion(t): return […]",
    ),
    (
        lambda: sde(still, trace=False, vectorized=True),
        "`vectorized` is given, but `drift` is a function of C, which takes one point\n  help: leave it out",
    ),
    (
        lambda: sde(4096),
        "`drift` is not a function: 4096\n  help: write def drift(t, x): return […]; of an address, "
        "ctypes.CFUNCTYPE(None, …)(address) makes a function",
    ),
]


@pytest.mark.parametrize(("make", "message"), REFUSED)
def test_a_function_of_c_is_held_against_what_it_is_called_with(make, message):
    with pytest.raises(gv.InputError) as caught:
        make()
    assert str(caught.value) == message


def test_pointers_to_anything_are_pointers():
    sde(of(None, c_double, c_void_p, POINTER, c_void_p))


def test_a_function_of_numba_is_held_against_its_signature():
    numba = pytest.importorskip("numba")
    types = numba.types
    double, pointer = types.double, types.CPointer(types.double)

    def compiled(*signature):
        return numba.cfunc(signature[0](*signature[1:]))(lambda t, x, p, out: None)

    sde(compiled(types.void, double, pointer, pointer, pointer))
    for signature, said in (
        ((types.void, types.float32, pointer, pointer, pointer), "whose argument 1 is float32, not double"),
        ((types.void, double, types.CPointer(types.int64), pointer, pointer), "argument 2 is int64\\*, not double \\*"),
        ((types.none, double, double, pointer, pointer), "argument 2 is double, not double \\*"),
    ):
        with pytest.raises(gv.InputError, match=said):
            sde(compiled(*signature))

    @numba.cfunc(double(double, pointer, pointer, pointer))
    def giving(t, x, p, out):
        return 1.0

    with pytest.raises(gv.InputError, match="that gives float64, and its results are to be written to `out`"):
        sde(giving)


def test_a_function_of_c_reads_its_own_parameters_and_the_controls_behind_them():
    model = gv.Sde(lambda t, x, u, *, rate=5.0: [-rate * x[0] + u[0]], diffusion=[0.1], state=["x"], controls=["c"])
    first = gv.Sensor(lambda t, x, *, bias=3.0: x + bias, measures=["a"], std=[0.1], name="first")
    sensor = gv.Sensor(scaled, measures=["z"], std=[0.1], parameters={"gain": 2.0}, name="second")
    found = gv.filter(model, [first, sensor], [0.0], [[0.0, 0.0]], prior=PRIOR, method="sr-cd-ckf", u=[[7.0]])
    np.testing.assert_allclose(found.innovation, [[-4.0, -9.0]], rtol=1e-9)
    gained = sensor.with_params(gain=4.0)
    found = gv.filter(model, [first, gained], [0.0], [[0.0, 0.0]], prior=PRIOR, method="sr-cd-ckf", u=[[7.0]])
    np.testing.assert_allclose(found.innovation, [[-4.0, -11.0]], rtol=1e-9)
