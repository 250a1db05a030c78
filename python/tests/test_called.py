"""Functions that are called while a filter runs, and what is said of those that give something else."""

import ctypes

import numpy as np
import pytest

import givens as gv

NAMES = ["a", "b"]
TIMES = np.arange(4.0)
SENSOR = gv.Sensor(lambda t, x: [x[0]], measures=["z"], std=[1.0])


def model_of(f, **options):
    return gv.Transition(f, noise_cov=np.eye(2) * 1e-4, state=NAMES, **options)


def mean_of(f, **options):
    prior = gv.Gaussian([1.0, 1.0], std=[0.8, 0.8])
    return gv.filter(model_of(f, **options), SENSOR, TIMES, np.ones((4, 1)), prior=prior).mean


def saturated(t, dt, x):
    return x * 0.5 if np.linalg.norm(x) > 3.0 else x


def one_by_one(t, dt, x):
    assert x.shape == (2,)
    return saturated(t, dt, x)


def test_a_function_is_called_point_by_point_unless_it_says_that_it_takes_all():
    np.testing.assert_array_equal(mean_of(saturated, trace=False), mean_of(one_by_one, trace=False))
    shapes = set()

    def seen(t, dt, x):
        shapes.add(x.shape)
        return [x[0], 1.0]

    mean_of(seen, trace=False, vectorized=True)
    assert shapes == {(2, 4)}


def test_nobody_reads_vectorized_of_a_function_that_is_traced():
    for make in (
        lambda: model_of(saturated, vectorized=True),
        lambda: gv.Sde(lambda t, x: x, diffusion=[1, 1], state=NAMES, vectorized=True),
        lambda: gv.Sensor(lambda t, x: x, measures=["z"], std=[1], vectorized=True),
    ):
        with pytest.raises(gv.InputError, match="`vectorized` is given, but the function is traced"):
            make()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (lambda x: None, "`f` gave nothing"),
        (lambda x: 1.0, "`f` gave one number, not one of shape (2,)"),
        (lambda x: np.zeros((2, 1)), "`f` gave an array of shape (2, 1), not one of shape (2,)"),
        (lambda x: [x[0], x[1], 0], "`f` gave an array of shape (3,), not one of shape (2,)"),
        (lambda x: ["a", "b"], "`f` gave ['a', 'b'], which is no array of real numbers"),
        (lambda x: [1j, 2], "`f` gave [1j, (2+0j)], which is no array of real numbers"),
        (lambda x: [[1, 2], 3], "`f` gave [[1, 2], 3], which is no array of numbers"),
        (lambda x: {"a": x[0]}, "`f` gave a table without `b`"),
    ],
)
def test_what_a_function_gives_is_checked_where_it_gives_it(given, said):
    with pytest.raises(gv.InputError) as caught:
        mean_of(lambda t, dt, x: given(x), trace=False)
    assert str(caught.value) == f"{said}\n  help: return one value for each of a, b"


def test_numbers_held_as_objects_are_numbers():
    np.testing.assert_array_equal(
        mean_of(lambda t, dt, x: np.array([x[0], x[1]], dtype=object), trace=False), mean_of(saturated, trace=False)
    )


def test_an_address_that_is_no_function_is_never_jumped_to():
    class Shop:
        address = 12345

    with pytest.raises(gv.InputError, match="`f` is not a function"):
        model_of(Shop())
    with pytest.raises(gv.InputError, match="`h` is not a function"):
        gv.Sensor(Shop(), measures=["z"], std=[1.0])

    class Callable(Shop):
        def __call__(self, t, dt, x):
            return 0.9 * x

    np.testing.assert_allclose(mean_of(Callable()), mean_of(lambda t, dt, x: 0.9 * x), rtol=1e-14)


POINTER = ctypes.POINTER(ctypes.c_double)
FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_double, ctypes.c_double, POINTER, POINTER, POINTER)


def test_a_function_pointer_of_ctypes_serves():
    @FUNCTION
    def pointed(t, dt, x, p, out):
        out[0], out[1] = 0.9 * x[0], x[1]

    np.testing.assert_allclose(mean_of(pointed), mean_of(lambda t, dt, x: [0.9 * x[0], x[1]]), rtol=1e-14)


def test_a_function_pointer_says_how_many_arguments_it_takes_and_where_it_is():
    short = ctypes.CFUNCTYPE(None, ctypes.c_double, POINTER, POINTER, POINTER)(lambda *_: None)
    with pytest.raises(gv.InputError, match="is a function of C with 4 arguments, and it is given 5"):
        model_of(short)
    with pytest.raises(gv.InputError, match="points nowhere"):
        model_of(FUNCTION())
