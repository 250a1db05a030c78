"""Measurements, controls and noise of one track, as the arrays that run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from givens._arrays import Array, dimensions, numbers, shape_error
from givens._covariance import check_rows
from givens._frames import is_frame, numbers_by_name
from givens._join import Joined, named_sensor
from givens._names import known_name, listed
from givens._shared import refuse_shared
from givens.errors import InputError

__all__ = ["controls_of", "measured", "noise_shapes", "with_noise"]


def measured(joined: Joined, z: Any, rows: int) -> Array:
    """Measurements (rows, d), NaN where one is missing; of a table by sensor, those left out are missing."""
    d = len(joined.measures)
    if isinstance(z, Mapping):
        stacked = np.full((rows, d), np.nan)
        for name, values in z.items():
            place = named_sensor(joined, "z", name)
            columns = joined.measures[place]
            stacked[:, place] = _rows(f"z[{name!r}]", values, rows, columns)
        return stacked
    if is_frame(z):
        refuse_shared(joined, "give a table for each sensor: z={name: table}, or give the measures other names")
    return _rows("z", z, rows, joined.measures)


def _rows(argument: str, values: Any, rows: int, columns: tuple[str, ...]) -> Array:
    array = numbers_by_name(argument, values, columns, "measure")
    d = len(columns)
    if array.ndim == 1 and d == 1:
        array = array.reshape(-1, 1)
    if array.shape == (rows, d):
        return np.ascontiguousarray(array)
    remedy = f"one row for each time, one column for each of {', '.join(columns)}"
    if array.shape == (d,) and rows != d:
        remedy = f"one measurement is a row of its own: {argument}=[z], t=[t]"
    elif array.shape == (d, rows):
        remedy = f"rows are times: {argument}={argument}.T"
    elif array.ndim == 3 and array.shape[2] == 1:
        remedy = f"a measurement is a vector, not a column: {argument}[..., 0]"
    raise shape_error(argument, array.shape, f"({rows}, {d})", remedy)


def controls_of(joined: Joined, u: Any, rows: int) -> Array | None:
    """Controls (rows, c), each holding from its row to the next; None for a model without any."""
    found = _controls(joined, u, rows)
    if found is not None and not np.isfinite(found).all():
        row, at = map(int, np.argwhere(~np.isfinite(found))[0])
        name = joined.controls[at]
        raise InputError(
            f"`u` of `{name}` is {found[row, at]} in row {row}",
            argument="u",
            row=row,
            component=name,
            remedy="controls are always known",
        )
    return found


def _controls(joined: Joined, u: Any, rows: int) -> Array | None:
    names = joined.controls
    if not names:
        if u is None:
            return None
        raise InputError(
            "`u` is given, but the model has no controls", argument="u", remedy='name them: controls=["thrust"]'
        )
    if u is None:
        raise InputError(
            f"`u` is missing: the model has the controls {listed(names)}",
            argument="u",
            remedy=f"give u={{name: value}}, or an array ({rows}, {len(names)}): one row for each time",
        )
    if isinstance(u, Mapping):
        for name in u:
            known_name("u", name, names, "control")
        missing = [name for name in names if name not in u]
        if missing:
            raise InputError(
                f"`u` has no entry `{missing[0]}`",
                argument="u",
                component=missing[0],
                remedy="give one for each of " + ", ".join(names),
            )
        return np.stack([_control(f"u[{name!r}]", u[name], rows) for name in names], axis=1)
    array = numbers_by_name("u", u, names, "control", "u_")
    if array.ndim == 1 and len(names) == 1:
        array = array.reshape(-1, 1)
    if array.shape != (rows, len(names)):
        wanted = f"({rows}, {len(names)}): one column for each of {', '.join(names)}"
        raise shape_error("u", array.shape, wanted, "constant controls: u={name: number}")
    return array


def _control(argument: str, given: Any, rows: int) -> Array:
    array = numbers(argument, given)
    if array.shape not in ((), (1,), (rows,)):
        raise shape_error(argument, array.shape, f"({rows},)", "give one number for each time, or one for all")
    return np.broadcast_to(array, (rows,))


def noise_shapes(noise: Any, sensors: Mapping[str, int]) -> dict[str, tuple[int, ...]]:
    """For each sensor in `noise` the shape of a row: (d,) of standard deviations, (d, d) of covariances."""
    if noise is None:
        return {}
    if not isinstance(noise, Mapping):
        if len(sensors) > 1:
            raise InputError(
                f"`noise` does not say for which sensor it is: there are {listed(sensors)}",
                argument="noise",
                remedy="write noise={name: array}",
            )
        noise = {next(iter(sensors)): noise}
    shapes: dict[str, tuple[int, ...]] = {}
    for name, values in noise.items():
        known_name("noise", name, tuple(sensors), "sensor")
        d = sensors[name]
        shapes[name] = (d, d) if dimensions(values) == 3 else (d,)
    return shapes


def with_noise(joined: Joined, u: Array | None, noise: Any, z: Array) -> Array | None:
    """The controls with the noise of the rows behind them."""
    if not joined.noise:
        return u
    table = noise if isinstance(noise, Mapping) else {next(iter(joined.noise)): noise}
    rows = len(z)
    stacked = [np.empty((rows, 0)) if u is None else u]
    for name, shape in joined.noise.items():
        argument = f"noise[{name!r}]"
        measures = joined.measures[joined.sensors[name]]
        array = numbers_by_name(argument, table[name], measures, "measure")
        array = array.reshape(-1, 1) if array.ndim == 1 and shape == (1,) else array
        if array.shape != (rows, *shape):
            d = shape[0]
            raise shape_error(argument, array.shape, f"({rows}, {d}) of standard deviations or ({rows}, {d}, {d})")
        flat = array.reshape(rows, -1).copy()
        absent = np.isnan(z[:, joined.sensors[name]]).all(axis=1)
        # of a row in which the sensor is missing, nobody reads it
        flat[absent] = np.eye(shape[0]).ravel() if len(shape) == 2 else 1.0
        wrong = ~np.isfinite(flat) | ((flat < 0) if len(shape) == 1 else False)
        if wrong.any():
            row, at = map(int, np.argwhere(wrong)[0])
            raise InputError(
                f"`{argument}` of `{measures[at // (flat.shape[1] // len(measures))]}` is {flat[row, at]} in row {row}",
                argument="noise",
                row=row,
                component=measures[at // (flat.shape[1] // len(measures))],
                remedy="standard deviations are finite, from 0 up" if len(shape) == 1 else "give finite numbers",
            )
        if len(shape) == 2:
            check_rows(argument, name, flat.reshape(rows, *shape), measures)
        stacked.append(flat)
    return np.concatenate(stacked, axis=1)
