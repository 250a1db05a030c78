"""Wrong arguments, and all that is said of them."""

import pickle

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, SPEED, Z3, T, Z

import givens as gv

S = ["x", "v"]


def f(t, x):
    return [x[1], -x[0]]


# what is done, the exception, the whole message
CASES = [
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1], state="x v"),
        gv.InputError,
        '`state` is \'x v\', not a list of names\n  help: write state=["x", "vx"]',
    ),
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1], state=["x", "x"]),
        gv.InputError,
        "`state` names `x` twice\n  help: name each one once",
    ),
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1], state=[]),
        gv.InputError,
        '`state` names no state\n  help: write state=["x", "vx"]',
    ),
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1], state=["x", 3]),
        gv.InputError,
        '`state` holds 3, which is no name\n  help: write state=["x", "vx"]',
    ),
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1, 0.2], state=S),
        gv.InputError,
        "`diffusion` has shape (3,), not (2,), the diagonal of G, nor (2, noises), all of it\n  help: a diagonal has one value for each state; all of G has one row for each",
    ),
    (
        lambda: gv.Sde(f, diffusion={"w": 0.1}, state=S),
        gv.InputError,
        "`diffusion` names `w`, which is no state\n  help: there are `x`, `v`",
    ),
    (
        lambda: gv.Sde(f, diffusion={"vv": 0.1}, state=S),
        gv.InputError,
        "`diffusion` names `vv`, which is no state\n  help: did you mean `v`?",
    ),
    (lambda: gv.Sde(f, diffusion=[0, np.nan], state=S), gv.InputError, "`diffusion` is not finite: nan"),
    (
        lambda: gv.Sde(f, diffusion=[[0], [1], [2]], state=S),
        gv.InputError,
        "`diffusion` has shape (3, 1), not (2,), the diagonal of G, nor (2, noises), all of it\n  help: a diagonal has one value for each state; all of G has one row for each",
    ),
    (
        lambda: gv.Sde(f, diffusion=lambda t: [1, 2, 3], state=S),
        gv.InputError,
        "`diffusion` has shape (3,), not (2,), the diagonal of G, nor (2, noises), all of it\n  help: a diagonal has one value for each state; all of G has one row for each",
    ),
    (
        lambda: gv.Sde(lambda t, x: [x[0]], diffusion=[0, 0.1], state=S),
        gv.InputError,
        "`drift` has shape (1,), not (2,): one value for each of x, v\n  help: return one value for each state, in their order",
    ),
    (
        lambda: gv.Sde(lambda t, x: np.reshape(x, (2, 1)), diffusion=[0, 0.1], state=S),
        gv.InputError,
        "`drift` has shape (2, 1), not (2,): one value for each of x, v\n  help: return a vector: np.ravel(…)",
    ),
    (
        lambda: gv.Sde(lambda x: x, diffusion=[0, 0.1], state=S),
        gv.InputError,
        "`drift`: <lambda> takes (x), but it is given (t, x)\n  help: write def drift(t, x, *, parameter=1.0)",
    ),
    (
        lambda: gv.Sde(lambda t, x, u: x, diffusion=[0, 0.1], state=S),
        gv.InputError,
        '`drift`: <lambda> takes (t, x, u), but the model has no controls\n  help: name them with the model: controls=["thrust"]; a parameter has a default: *, u=1.0',
    ),
    (
        lambda: gv.Sde(lambda t, x, *, k: x, diffusion=[0, 0.1], state=S),
        gv.InputError,
        "`drift`: <lambda> asks for `k`, which has no value\n  help: give it a default, k=…, or write parameters={'k': …}",
    ),
    (
        lambda: gv.Sde(lambda t, x, *, k=np.nan: x, diffusion=[0, 0.1], state=S),
        gv.InputError,
        "`drift`: the parameter `k` is NaN\n  help: give it a number, as a default or in parameters={…}",
    ),
    (
        lambda: gv.Sde(3, diffusion=[0, 0.1], state=S),
        gv.InputError,
        "`drift` is not a function: 3\n  help: write def drift(t, x): return […]",
    ),
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1], state=S, controls=["x"]),
        gv.InputError,
        "`x` is both a state and a control\n  help: name them differently",
    ),
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1], state=S, parameters={"k": 1}),
        gv.InputError,
        "`parameters` names `k`, which is no parameter of the functions\n  help: there is none",
    ),
    (
        lambda: gv.Sde(f, diffusion=[0, 0.1], state=S, jacobian=f),
        gv.InputError,
        "`jacobian` is given, but the function is traced\n  help: leave it out: a traced function has exact derivatives of its own",
    ),
    (
        lambda: gv.Sde(lambda t, x, *, k=1.0: x, diffusion=lambda t, *, k=2.0: [0, k], state=S),
        gv.InputError,
        "the parameter `k` is 1.0 in one function and 2.0 in another\n  help: give both the same default, or one value for both: parameters={'k': …}",
    ),
    (
        lambda: gv.Sde(lambda t, x, *, k=1.0: x * k, diffusion=[0, 1], state=S).with_params(kk=2),
        gv.InputError,
        "`with_params` names `kk`, which is no parameter\n  help: did you mean `k`?",
    ),
    (
        lambda: gv.Sde(lambda t, x, *, k=1.0: x * k, diffusion=[0, 1], state=S).with_params(k=[1, 2]),
        gv.InputError,
        "`with_params`: `k` has shape (2,), not ()\n  help: give as many numbers as it had",
    ),
    (
        lambda: gv.Sde(lambda t, x, *, k=1.0: x * k, diffusion=[0, 1], state=S).with_params(k="a"),
        gv.InputError,
        "`with_params`: the parameter `k` is not a number: 'a'\n  help: parameters are floats or arrays of floats; bind others with functools.partial",
    ),
    (
        lambda: gv.Transition(lambda t, dt, x: x, noise_cov=[1, 2], state=S),
        gv.InputError,
        "`noise_cov` has shape (2,), not (2, 2)\n  help: noise_cov=np.diag(…) makes one of variances",
    ),
    (
        lambda: gv.Transition(lambda t, dt, x: x, noise_cov=[[1, 2], [0, 2]], state=S),
        gv.InputError,
        "`noise_cov` is not symmetric: 2.0 at [0, 1], 0.0 at [1, 0]\n  help: give a symmetric matrix, such as (Q + Q.T) / 2 if they differ by rounding",
    ),
    (
        lambda: gv.Transition(lambda t, x: x, noise_cov=np.eye(2), state=S),
        gv.InputError,
        "`f`: <lambda> takes (t, x), but it is given (t, dt, x)\n  help: write def f(t, dt, x, *, parameter=1.0)",
    ),
    (
        lambda: gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=S, step=0),
        gv.InputError,
        "`step` is 0\n  help: a step is longer than 0",
    ),
    (
        lambda: gv.Sensor(f, measures=[], std=1),
        gv.InputError,
        '`measures` names nothing\n  help: write measures=["range"]',
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "a"], std=[1, 1]),
        gv.InputError,
        "`measures` names `a` twice\n  help: name each one once",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"]),
        gv.InputError,
        "the sensor `sensor` has neither `std` nor `cov`\n  help: give the standard deviations of its errors, std=[…], or else their covariance, cov=[[…]]",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], std=[1, 1], cov=np.eye(2)),
        gv.InputError,
        "the sensor `sensor` has `std` and `cov` at once\n  help: give the standard deviations of its errors, std=[…], or else their covariance, cov=[[…]]",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], std=[1, -1]),
        gv.InputError,
        "`std` of `b` is -1.0\n  help: standard deviations are finite, from 0 up",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], std=[1, 1, 1]),
        gv.InputError,
        "`std` has shape (3,), not (2,) for the measures a, b",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], std={"a": 1}),
        gv.InputError,
        "`std` has no entry `b`\n  help: give one for each measure",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], std={"a": 1, "c": 2}),
        gv.InputError,
        "`std` names `c`, which is no measure of this sensor\n  help: there are `a`, `b`",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], cov=[1, 1]),
        gv.InputError,
        "`cov` has shape (2,), not (2, 2) for the measures a, b\n  help: write std=… for standard deviations, or cov=np.diag(…)",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], cov=[[1, 2], [1, 1]]),
        gv.InputError,
        "`cov` is not symmetric: 2.0 at [0, 1], 1.0 at [1, 0]\n  help: give a symmetric matrix, such as (Q + Q.T) / 2 if they differ by rounding",
    ),
    (
        lambda: gv.Sensor(f, measures=["bearing", "b"], std=[1, 1], angles=["bering"]),
        gv.InputError,
        "`angles` names `bering`, which is no measure of this sensor\n  help: did you mean `bearing`?",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], std=[1, 1], angles={"a": -1}),
        gv.InputError,
        "`angles`: the period of `a` is -1\n  help: a period is longer than 0: 2π of radians, 360 of degrees",
    ),
    (
        lambda: gv.Sensor(f, measures=["a", "b"], std=[1, 1], angles="a"),
        gv.InputError,
        "`angles` is 'a', not a list of names\n  help: write angles=[\"bearing\"]",
    ),
    (
        lambda: gv.Sensor("no", measures=["a", "b"], std=[1, 1]),
        gv.InputError,
        "`h` is not a function: 'no'\n  help: write def h(t, x): return […]",
    ),
    (
        lambda: gv.filter(MODEL, gv.Sensor(lambda t, x: x, measures=["a"], std=[1]), T, Z, prior=PRIOR),
        gv.InputError,
        "`h` has shape (2,), not (1,): one value for each of a\n  help: return one value for each measure, in their order",
    ),
    (
        lambda: gv.filter(MODEL, gv.Sensor(lambda t, x: x[:1, None], measures=["a"], std=[1]), T, Z, prior=PRIOR),
        gv.InputError,
        "`h` has shape (1, 1), not (1,): one value for each of a\n  help: return a vector: np.ravel(…)",
    ),
    (
        lambda: gv.Gaussian([0, 1]),
        gv.InputError,
        "a Gaussian with neither `cov` nor `std`\n  help: write Gaussian(mean, cov) or Gaussian(mean, std=…)",
    ),
    (
        lambda: gv.Gaussian([0, 1], np.eye(2), std=[1, 1]),
        gv.InputError,
        "a Gaussian with `cov` and `std` at once\n  help: write Gaussian(mean, cov) or Gaussian(mean, std=…)",
    ),
    (
        lambda: gv.Gaussian([[0], [1]], np.eye(2)),
        gv.InputError,
        "`mean` has shape (2, 1), not (n,)\n  help: a vector has one dimension: mean=np.ravel(…)",
    ),
    (
        lambda: gv.Gaussian([0, np.inf], np.eye(2)),
        gv.InputError,
        "`mean[1]` is inf\n  help: give a finite number",
    ),
    (
        lambda: gv.Gaussian([0, 1], [1, 1]),
        gv.InputError,
        "`cov` has shape (2,), not (2, 2)\n  help: cov=np.diag(…) makes one of variances",
    ),
    (
        lambda: gv.Gaussian([0, 1], std=[1, -1]),
        gv.InputError,
        "`std[1]` is -1.0\n  help: standard deviations are finite, from 0 up",
    ),
    (lambda: gv.Gaussian([0, 1], std=[1, 1, 1]), gv.InputError, "`std` has shape (3,), not (2,), the shape of `mean`\n  help: give one for each entry of `mean`"),
    (
        lambda: gv.Gaussian([0, 1], [[1, 2], [2, 1]]),
        gv.InputError,
        "`cov` is not positive semidefinite at pivot 2 of 2\n  help: variances are from 0 up and correlations from -1 to 1; were standard deviations meant, write std=…",
    ),
    (
        lambda: gv.Gaussian([0, 1], [[1, 0.2], [0.1, 1]]),
        gv.InputError,
        "`cov` is not symmetric: 0.2 at [0, 1], 0.1 at [1, 0]\n  help: give a symmetric matrix, such as (P + P.T) / 2 if they differ by rounding",
    ),
    (
        lambda: gv.Gaussian([0, 1], [[1, np.nan], [0.1, 1]]),
        gv.InputError,
        "`cov[0, 1]` is nan\n  help: give a finite number",
    ),
    (
        lambda: gv.Gaussian(["a", 1], np.eye(2)),
        gv.InputError,
        "`mean` is not an array of real numbers: it holds text\n  help: give a list of numbers, or a NumPy array of floats",
    ),
    (
        lambda: gv.filter(3, LENGTH, T, Z, prior=PRIOR),
        gv.InputError,
        "`model` is int, not a Sde, a Transition or a model file\n  help: write gv.Sde(drift, …), gv.Transition(f, …) or gv.read_model(path)",
    ),
    (
        lambda: gv.filter(MODEL, 3, T, Z, prior=PRIOR),
        gv.InputError,
        "`sensors` is int, not a Sensor or a list of them\n  help: write gv.Sensor(h, measures=[…], std=[…])",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, LENGTH], T, Z, prior=PRIOR),
        gv.InputError,
        'two sensors are called `ruler`\n  help: give them names: gv.Sensor(…, name="radar")',
    ),
    (lambda: gv.filter(MODEL, [LENGTH, 3], T, Z, prior=PRIOR), gv.InputError, "`sensors` holds 3, which is no Sensor"),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z),
        gv.InputError,
        "`prior` is missing\n  help: write prior=gv.Gaussian(mean, cov)",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=([0, 0], np.eye(2))),
        gv.InputError,
        "`prior` is a tuple of 2, not one Gaussian\n  help: write gv.Gaussian(mean, cov)",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=gv.Gaussian([0], std=[1])),
        gv.InputError,
        "`prior` has 1 components, but the model has the states x, v\n  help: give one mean for each state, in their order",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, prior=PRIOR),
        gv.InputError,
        "`z` is missing\n  help: give times and measurements, or a table with named columns",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z[:5], prior=PRIOR),
        gv.InputError,
        "`z` has shape (5, 1), not (20, 1)\n  help: one row for each time, one column for each of length",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, SPEED], T, Z3.T, prior=PRIOR),
        gv.InputError,
        "`z` has shape (3, 20), not (20, 3)\n  help: rows are times: z=z.T",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, SPEED], [1.0], [1, 2, 3], prior=PRIOR),
        gv.InputError,
        "`z` has shape (3,), not (1, 3)\n  help: one measurement is a row of its own: z=[z], t=[t]",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, SPEED], T, Z3[..., None], prior=PRIOR),
        gv.InputError,
        "`z` has shape (20, 3, 1), not (20, 3)\n  help: a measurement is a vector, not a column: z[..., 0]",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, SPEED], T, {"rader": Z3[:, 1:]}, prior=PRIOR),
        gv.InputError,
        "`z` names `rader`, which is no sensor\n  help: did you mean `radar`?",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, SPEED], T, {"radar": Z3}, prior=PRIOR),
        gv.InputError,
        "`z['radar']` has shape (20, 3), not (20, 2)\n  help: one row for each time, one column for each of speed, both",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T[:, None], Z, prior=PRIOR),
        gv.InputError,
        "`t` has shape (20, 1), not (rows,)\n  help: times are a vector: t=np.ravel(…)",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T[::-1], Z, prior=PRIOR),
        gv.InputError,
        "row 1: time 9.5 is before the row above, at 10\n  help: times increase from `t0` on; sort the rows, or start earlier",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, t0=3.0),
        gv.InputError,
        "row 0: time 0.5 is before the initial belief, at 3\n  help: times increase from `t0` on; sort the rows, or start earlier",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, np.where(T == 2, np.nan, T), Z, prior=PRIOR),
        gv.InputError,
        "row 3: time NaN is not finite\n  help: give its time, or leave the row out",
    ),
    (
        lambda: gv.filter(
            gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=S, step=1.0),
            LENGTH,
            [0, 1, 3, 5.5],
            Z[:4],
            prior=PRIOR,
        ),
        gv.InputError,
        "row 3, t = 5.5: a gap of 2.5 is not a whole number of steps of 1\n  help: put the rows on whole steps, or write the transition in `dt` and leave `step` out",
    ),
    (
        lambda: gv.filter(
            gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=S, step=0.5),
            LENGTH,
            [0, 1e300],
            Z[:2],
            prior=PRIOR,
        ),
        gv.InputError,
        "row 1, t = 1e300: a gap of 1e300 is not a whole number of steps of 0.5\n  help: put the rows on whole steps, or write the transition in `dt` and leave `step` out",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, np.where(T[:, None] == 2, np.inf, Z), prior=PRIOR),
        gv.InputError,
        "row 3: measure `length` is infinite\n  help: a missing component is NaN",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, [["a"]] * 20, prior=PRIOR),
        gv.InputError,
        "`z` is not an array of real numbers: it holds text\n  help: give a list of numbers, or a NumPy array of floats",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, u=Z),
        gv.InputError,
        '`u` is given, but the model has no controls\n  help: name them: controls=["thrust"]',
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, method="sr-cd-ckff"),
        gv.MethodError,
        "there is no method `sr-cd-ckff`\n  help: did you mean `sr-cd-ckf`?",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, method="ckf"),
        gv.MethodError,
        "`ckf` is a discrete-time method, and the model is continuous\n  help: its counterpart for continuous models is `cd-ckf`",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, substep=3),
        gv.MethodError,
        "there is no option `substep`\n  help: did you mean `substeps`?",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, kappa=3),
        gv.MethodError,
        "`sr-cd-ckf` does not read `kappa`\n  help: it belongs to the unscented rule",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, substeps=[3]),
        gv.MethodError,
        "`substeps` is a number or a word, not list",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, noise={"rler": Z}),
        gv.InputError,
        "`noise` names `rler`, which is no sensor\n  help: did you mean `ruler`?",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, SPEED], T, Z3, prior=PRIOR, noise=Z),
        gv.InputError,
        "`noise` does not say for which sensor it is: there are `ruler`, `radar`\n  help: write noise={name: array}",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, noise=-np.abs(Z)),
        gv.InputError,
        "`noise['ruler']` of `length` is -0.9121409810968514 in row 0\n  help: standard deviations are finite, from 0 up",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, noise=Z[:4]),
        gv.InputError,
        "`noise['ruler']` has shape (4, 1), not (20, 1) of standard deviations or (20, 1, 1)",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, k=1.0),
        gv.MethodError,
        "there is no option `k`\n  help: it is a parameter: params={'k': …}",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, {"length": [1.0]}, prior=PRIOR),
        gv.InputError,
        "the table has no column `time`: it has `length`\n  help: name the column of times `time`",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, at=[np.nan]),
        gv.InputError,
        "time 0 of `at` is NaN\n  help: times increase, from `t0` on",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, params={"kk": 1}),
        gv.InputError,
        "`params` names `kk`, which is no parameter of the model or a sensor\n  help: did you mean `k`?",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, params={"k": [1, 2]}),
        gv.InputError,
        "`params`: `k` has shape (2,), not ()\n  help: give one number",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, at=[-1.0]),
        gv.InputError,
        "time 0 of `at` is -1, before 0.5\n  help: times increase, from `t0` on",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, t0=np.datetime64("2024-01-01")),
        gv.InputError,
        "`t` holds numbers, but the other times are dates\n  help: give all times as numbers, or all as dates",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, np.stack([Z, Z]), prior=[PRIOR]),
        gv.InputError,
        "`prior` is a list of 1, not one for each of 2 tracks\n  help: write gv.Gaussian(mean, cov)",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, np.stack([Z, Z])[:, :4], prior=PRIOR),
        gv.InputError,
        "track 0: `z` has shape (4, 1), not (20, 1)\n  help: one row for each time, one column for each of length",
    ),
    (
        lambda: gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, lag=-1),
        gv.InputError,
        "`lag` is -1\n  help: a lag is a whole number of rows, from 0 up",
    ),
    (
        lambda: gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, lag=1, point=2.0),
        gv.InputError,
        "`lag` and `point` at once\n  help: give one of them",
    ),
    (
        lambda: gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, point=2.3),
        gv.InputError,
        "neither a row nor the initial belief stands at 2.3\n  help: the nearest row is at 2.5; a row without measures makes one",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, {"time": T, "lenght": Z[:, 0]}, prior=PRIOR),
        gv.InputError,
        "the table has none of the measures `length`: it has `time`, `lenght`\n  help: name the columns as the measures are named",
    ),
    (
        lambda: gv.filter(MODEL, [LENGTH, SPEED], {"time": T, "lenght": Z[:, 0], "speed": T}, prior=PRIOR),
        gv.InputError,
        "the table has no column `both` of the sensor `radar`\n  help: a sensor may be absent as a whole, not in part",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, {"time": T, "length": ["a"] * 20}, prior=PRIOR),
        gv.InputError,
        "the column `length` is not an array of real numbers: it holds text\n  help: give a list of numbers, or a NumPy array of floats",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, {"time": T, "length": Z[:, 0], "sensor": ["ruller"] * 20}, prior=PRIOR),
        gv.InputError,
        "`sensor` names `ruller`, which is no sensor\n  help: did you mean `ruler`?",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, "data.csv", prior=PRIOR),
        gv.InputError,
        "`t` is the path 'data.csv', which only a model file can read\n  help: read the table with pandas or polars and give that",
    ),
    (lambda: gv.read_model("/nonexistent/a.toml"), gv.ModelError, "/nonexistent/a.toml: there is no such file"),
    (
        lambda: gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=0.0).update([1, 2]),
        gv.InputError,
        "`z` has shape (2,), not (1,): one number for each of length\n  help: name the sensor: update(z, sensor)",
    ),
    (
        lambda: gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=0.0).update([1], "radar"),
        gv.InputError,
        "`sensor` names `radar`, which is no sensor\n  help: there is `ruler`",
    ),
    (
        lambda: gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=0.0).predict(-1.0),
        gv.StepError,
        "t = 0: cannot predict back to t = -1\n  help: give times in order, or go on from a copy() made before that time",
    ),
    (
        lambda: gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=0.0).set_controls([1]),
        gv.InputError,
        'the model has no controls\n  help: name them: controls=["thrust"]',
    ),
    (
        lambda: gv.simulate(MODEL, LENGTH, T, prior=PRIOR, seed=-1),
        gv.InputError,
        "`seed` is -1\n  help: give a whole number, from 0 up",
    ),
    (
        lambda: gv.simulate(MODEL, LENGTH, T, prior=PRIOR, seed=1, runs=1.5),
        gv.InputError,
        "`runs` is 1.5\n  help: give a whole number, from 0 up",
    ),
    (
        lambda: gv.compare(MODEL, LENGTH, T, Z, prior=PRIOR, methods="ekf"),
        gv.InputError,
        '`methods` is \'ekf\'\n  help: write methods=["ekf", "sr-ckf"]',
    ),
    (
        lambda: gv.compare(MODEL, LENGTH, T, Z, prior=PRIOR, methods=["cd-ekf"], options={"ekf": {}}),
        gv.InputError,
        "`options` names `ekf`, which is no method among `methods`\n  help: did you mean `cd-ekf`?",
    ),
    (
        lambda: gv.merge({"a": (T, Z[:3])}),
        gv.InputError,
        "`a` has 20 times and 3 measurements\n  help: give times (rows,) and measurements (rows, d)",
    ),
]


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_a_wrong_argument_is_told_with_place_and_remedy(case):
    wrong, kind, message = case
    with pytest.raises(kind) as caught:
        wrong()
    assert str(caught.value) == message
    assert type(caught.value) is kind
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == message and again.__dict__.keys() == caught.value.__dict__.keys()


def counted(what):
    """A call that is refused at the second of two states, measures, controls or parameters."""
    model = gv.Transition(
        lambda t, dt, x, u, *, k=1.0, w=np.ones(2): k * w * x + u[0] * u[1],
        noise_cov=np.eye(2),
        state=["x", "v"],
        controls=["thrust", "flap"],
    )
    sensor = gv.Sensor(lambda t, x: x, measures=["p", "q"], std=[1.0, 1.0], name="ruler")
    given = {"u": {"thrust": 0.0, "flap": 0.0}, "prior": gv.Gaussian([0, 0], std=[1, 1])}
    if what == "controls":
        given["u"] = [[0, 0], [0, np.nan], [0, 0]]
    elif what == "parameters":
        model = model.with_params(w=[1.0, np.inf])
    elif what == "noise":
        given["noise"] = [[1, 1], [1, 1], [1, -1]]
    elif what == "covariances":
        given["noise"] = np.stack([np.eye(2), np.diag([1, np.nan]), np.eye(2)])
    elif what == "set_controls":
        return gv.Filter(model, sensor, prior=given["prior"], t0=0, u=[0, np.inf])
    return gv.filter(model, sensor, [0, 1, 2], np.zeros((3, 2)), **given)


COUNTED = {
    "controls": ("`u` of `flap` is nan in row 1", 1, "flap"),
    "set_controls": ("`u` of `flap` is inf", None, "flap"),
    "parameters": ("the parameter `w` is inf, not a finite number", None, "w"),
    "noise": ("`noise['ruler']` of `q` is -1.0 in row 2", 2, "q"),
    "covariances": ("`noise['ruler']` of `q` is nan in row 1", 1, "q"),
}


@pytest.mark.parametrize("what", COUNTED)
def test_what_has_a_name_is_called_by_it_and_rows_count_from_zero(what):
    with pytest.raises(gv.InputError) as caught:
        counted(what)
    error = caught.value
    assert (error.message, error.row, error.component) == COUNTED[what]


def test_words_count_pivots_from_one_and_fields_from_zero():
    model = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[1, 0], [0, -dt]], state=["x", "v"])
    sensor = gv.Sensor(lambda t, x: x, measures=["p", "q"], cov=lambda t: [[1, 0], [0, 1 - t]])
    run = {"t": [0, 0.5, 3], "z": np.zeros((3, 2)), "prior": gv.Gaussian([0, 0], std=[1, 1])}
    with pytest.raises(gv.StepError, match=r"the process noise covariance is not positive definite at pivot 2 \(state `v`\)") as caught:
        gv.filter(model, sensor, **run)
    assert (caught.value.matrix, caught.value.pivot, caught.value.component) == ("process noise covariance", 1, "v")
    still = gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=["x", "v"])
    with pytest.raises(gv.StepError, match=r"the measurement noise .* at pivot 2 \(measure `q`\)") as caught:
        gv.filter(still, sensor, **run)
    assert (caught.value.row, caught.value.pivot, caught.value.component) == (2, 1, "q")
    for cov, said in (
        ([[1, 2, 0], [2, 1, 0], [0, 0, 1]], "not positive semidefinite at pivot 2 of 3"),
        ([[1, 0, 0], [0, 1, 0], [0, 0, -1]], "not positive semidefinite at pivot 3 of 3"),
        ([[1, 0, 0], [0, 1, 0], [0, np.inf, 1]], "`cov[2, 1]` is inf"),
        ([[1, 0, 0], [0, 1, 0], [0, 1, 1]], "0.0 at [1, 2], 1.0 at [2, 1]"),
    ):
        with pytest.raises(gv.InputError) as caught:
            gv.Gaussian(np.zeros(3), cov)
        assert said in caught.value.message
