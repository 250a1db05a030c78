"""What is said of functions that cannot be traced: all of it."""

import inspect
import linecache
import os

import numpy as np
import pytest
from functions_not_to_trace import REFUSED

import givens as gv

NAMES = ["a", "b", "c"]


def place(function, line):
    """The place as the message has it, with the number and the text of the line."""
    file = os.path.relpath(inspect.getsourcefile(function)) if os.getcwd() in inspect.getsourcefile(function) else None
    file = file or inspect.getsourcefile(function)
    first = function.__code__.co_firstlineno
    lines = inspect.getsource(function).splitlines()
    head = next(k for k, text in enumerate(lines) if text.startswith("def "))
    number = first if line == 0 else first + head + line - 1
    source = linecache.getline(inspect.getsourcefile(function), number).strip() if line else None
    shown = f": `{source}`" if line else ""
    return f"{file}:{number}, in {function.__name__}{shown}", number, source


@pytest.mark.parametrize(("function", "said", "remedy", "line"), REFUSED, ids=[case[0].__name__ for case in REFUSED])
def test_a_function_that_cannot_be_traced_is_told_the_way_to_write_it(function, said, remedy, line):
    where, number, source = place(function, line)
    with pytest.raises(gv.TraceError) as caught:
        gv.Sde(function, diffusion=[1, 1, 1], state=NAMES)
    error = caught.value
    assert str(error) == f"{where}: {said}\n  help: {remedy}"
    assert (error.function, error.line, error.source) == (function.__name__, number, source)
    assert error.file == inspect.getsourcefile(function) and error.argument == "drift"


def test_a_state_at_which_to_compare_lets_a_narrow_function_through():
    def narrow(t, x):
        return np.sqrt(np.sin(x / 1e9) - np.sin(0.999)) + 0 * x

    with pytest.raises(gv.TraceError, match="pass check_at"):
        gv.Sde(narrow, diffusion=[1, 1, 1], state=NAMES)
    gv.Sde(narrow, diffusion=[1, 1, 1], state=NAMES, check_at=[1.3e9, 1.3e9, 1.3e9])


def test_a_noise_is_not_told_of_a_way_that_it_has_not():
    with pytest.raises(gv.TraceError) as caught:
        gv.Sde(lambda t, x: x, diffusion=lambda t: [np.spacing(t), 1, 1], state=NAMES)
    assert caught.value.remedy == "write it with arithmetic and NumPy's elementary functions"
    assert caught.value.argument == "diffusion"


def test_a_function_of_scipy_that_takes_numbers_only_is_named_with_the_users_line():
    linalg = pytest.importorskip("scipy.linalg")

    def noise(t, dt):
        return linalg.expm(np.eye(2) * dt)

    with pytest.raises(gv.TraceError) as caught:
        gv.Transition(lambda t, dt, x: [x[0], x[1]], noise_cov=noise, state=["a", "b"])
    error = caught.value
    assert error.source == "return linalg.expm(np.eye(2) * dt)"
    assert "scipy.linalg.expm takes numbers only" in str(error)
    assert "np.eye(n) + A + A @ A / 2" in error.remedy
