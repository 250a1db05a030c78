"""Models written in SymPy, and what is said of expressions that are none."""

import numpy as np
import pytest

import givens as gv

sympy = pytest.importorskip("sympy")
x, v, k, t, dt, w = sympy.symbols("x v k t dt w")
STATES = ["x", "v"]
PRIOR = gv.Gaussian([1.0, 0.0], std=[1.0, 1.0])
RULER = gv.Sensor(lambda t, x: x[:1], measures=["z"], std=[0.1])


def sde(drift, diffusion=(0.0, 0.1), **options):
    return gv.Sde(drift, diffusion=diffusion, state=STATES, **options)


def mean(model, sensor=RULER, **options):
    return gv.filter(model, sensor, [0.0, 1.0], [[1.0], [0.5]], prior=PRIOR, **options).mean


def numpy_model():
    return sde(lambda t, x: [x[1], -2.0 * x[0]])


@pytest.mark.parametrize(
    "drift",
    [[v, -k * x], (v, -k * x), sympy.Matrix([v, -k * x]), sympy.Matrix([[v, -k * x]]), {"v": -k * x, "x": v}],
)
def test_lists_rows_columns_and_tables_are_vectors(drift):
    np.testing.assert_allclose(mean(sde(drift, parameters={"k": 2.0})), mean(numpy_model()), rtol=1e-13)


def test_noises_are_expressions_of_what_they_may_depend_on():
    steady = gv.Transition([x, v], noise_cov=sympy.Matrix([[dt * k, 0], [0, dt]]), state=STATES, parameters={"k": 0.1})
    plain = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[0.1 * dt, 0], [0, dt]], state=STATES)
    np.testing.assert_allclose(mean(steady), mean(plain), rtol=1e-13)
    grown, same = sde([v, -x], [0, x]), sde(lambda t, x: [x[1], -x[0]], lambda t, x: [0, x[0]])
    np.testing.assert_allclose(mean(grown, method="sr-cd-ckf2"), mean(same, method="sr-cd-ckf2"), rtol=1e-13)
    sensor = gv.Sensor([x], measures=["z"], std=[k], parameters={"k": 0.1})
    np.testing.assert_allclose(mean(plain, sensor), mean(plain), rtol=1e-13)


REFUSED = [
    (
        lambda: sde([v, -k * x]),
        "`drift` names `k`, which is neither a state nor a control nor a parameter\n  help: write parameters={'k': …}",
    ),
    (
        lambda: sde([v, -sympy.Symbol("xx")]),
        "`drift` names `xx`, which is neither a state nor a control nor a parameter\n  help: did you mean `x`?",
    ),
    (
        lambda: sde([v, -x * dt]),
        "`drift` names `dt`, which there is in `f` and `noise_cov` only\n  help: name it differently",
    ),
    (
        lambda: gv.Sde([t], diffusion=[0.1], state=["t"]),
        "`drift` names `t`, which is a state and the time\n  help: name it differently",
    ),
    (
        lambda: gv.Transition([x, v], noise_cov=[[x, 0], [0, dt]], state=STATES),
        "`noise_cov` names the state `x`, on which it may not depend",
    ),
    (
        lambda: sde([v, -sympy.Symbol("x", positive=True) * x]),
        "`drift` has two symbols `x`, which SymPy tells apart by their assumptions\n  help: make each symbol once",
    ),
    (
        lambda: sde([v, -sympy.Symbol("lambda") * x], parameters={"lambda": 1.0}),
        "`drift` names `lambda`, which is a word of Python\n  help: name the parameter differently",
    ),
    (
        lambda: sde([v, sympy.Function("g")(x)]),
        "`drift` holds `g(x)`, a function that is not defined\n  help: put an expression in its place with .subs(…)",
    ),
    (lambda: sde([v, sympy.nan]), "`drift` holds `nan`, which is no finite number"),
    (lambda: sde([v, -sympy.oo]), "`drift` holds `-oo`, which is no finite number"),
    (
        lambda: sde([v]),
        "`drift` has shape (1,), not (2,): one value for each of x, v\n"
        "  help: return one value for each state, in their order",
    ),
]


@pytest.mark.parametrize(("make", "message"), REFUSED)
def test_expressions_that_are_no_model_are_told_why(make, message):
    with pytest.raises(gv.InputError) as caught:
        make()
    assert str(caught.value) == message


def test_what_sympy_cannot_write_is_told_in_its_words():
    with pytest.raises(gv.InputError, match=r"(?s)`drift`: SymPy does not write it in NumPy: .*Integral.*\.doit\(\)"):
        sde([v, sympy.Integral(sympy.exp(-(w**2)), (w, 0, x))])


def test_a_refusal_names_the_line_that_makes_the_model():
    for expressions, said in (([v, sympy.gamma(x)], "math.gamma has no"), ({"x": v, "w": x}, "'v' is missing")):
        with pytest.raises(gv.TraceError, match=said) as caught:
            gv.Sde(expressions, diffusion=[0, 1], state=STATES)  # here
        assert caught.value.file == __file__
        assert caught.value.source.endswith("# here")
