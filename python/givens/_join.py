"""A model and its sensors as one native model, made once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from givens import _native
from givens._arrays import Array
from givens._called import slots
from givens._dynamics import Dynamics
from givens._native import Graph
from givens._part import Part
from givens._scalars import shown
from givens.errors import InputError
from givens.model_file import ModelFile
from givens.sensor import Sensor

__all__ = ["Joined", "Placed", "join", "named_sensor", "sensors_of"]

#: Joints of one model that are kept.
_KEPT = 16


#: A function, and where its parameters stand among those of a native model.
Placed = tuple[Part, tuple[int, ...]]


@dataclass(frozen=True)
class Joined:
    """A native model, and how its measures and controls are made of what users give."""

    native: _native.Model
    states: tuple[str, ...]
    controls: tuple[str, ...]
    #: Names of the sensors, and where each one's measures stand among all.
    sensors: dict[str, slice]
    measures: tuple[str, ...]
    #: For each sensor whose noise comes with the rows, how many numbers a row has: of `std` d, of `cov` d².
    noise: dict[str, tuple[int, ...]]
    #: Functions of motion, and those of the sensors, with where their parameters stand among all.
    motion: tuple[Placed, ...] = ()
    measuring: tuple[Placed, ...] = ()

    @property
    def widths(self) -> dict[str, int]:
        """How many measures each sensor has."""
        return {name: place.stop - place.start for name, place in self.sensors.items()}

    @property
    def kind(self) -> Any:
        """``"continuous"`` or ``"discrete"``."""
        return self.native.kind


def sensors_of(sensors: Any) -> tuple[Sensor, ...]:
    """One sensor or several, with different names."""
    found = (sensors,) if isinstance(sensors, Sensor) else tuple(sensors) if isinstance(sensors, (list, tuple)) else ()
    if not found:
        raise InputError(
            f"`sensors` is {type(sensors).__name__}, not a Sensor or a list of them",
            argument="sensors",
            remedy="write gv.Sensor(h, measures=[…], std=[…])",
        )
    for k, sensor in enumerate(found):
        if not isinstance(sensor, Sensor):
            raise InputError(f"`sensors` holds {shown(sensor)}, which is no Sensor", argument="sensors")
        if any(sensor.name == other.name for other in found[:k]):
            raise InputError(
                f"two sensors are called `{sensor.name}`",
                argument="sensors",
                component=sensor.name,
                remedy='give them names: gv.Sensor(…, name="radar")',
            )
    return found


def join(model: Any, sensors: Any, noise: Mapping[str, tuple[int, ...]] | None = None) -> Joined:
    """Joins a model and its sensors; `noise` says which sensors have theirs given row by row, and of which shape."""
    noise = dict(noise or {})
    if isinstance(model, ModelFile):
        return _of_file(model, sensors, noise)
    if not isinstance(model, Dynamics):
        raise InputError(
            f"`model` is {type(model).__name__}, not a Sde, a Transition or a model file",
            argument="model",
            remedy="write gv.Sde(drift, …), gv.Transition(f, …) or gv.read_model(path)",
        )
    parts = sensors_of(sensors)
    # sensors that differ in the values of parameters only share their traces
    key = (tuple(id(sensor._traces) for sensor in parts), tuple(sorted(noise.items())))
    known = model._joined.get(key)
    if known is None:
        if len(model._joined) >= _KEPT:
            model._joined.clear()
        known = model._joined[key] = (_made(model, parts, noise), parts)
    joined: Joined = known[0]
    values = np.concatenate([np.empty(0), *_values(model, parts)])
    if np.array_equal(values, joined.native.parameters):
        return joined
    return replace(joined, native=joined.native.with_parameters(values))


def _values(model: Dynamics, sensors: Sequence[Sensor]) -> list[Array]:
    values = []
    for owner in (model, *sensors):
        for name, value in owner._parameters.items():
            if not np.isfinite(value).all():
                raise InputError(
                    f"the parameter `{name}` is {value[~np.isfinite(value)][0]}, not a finite number",
                    argument="parameters",
                    component=name,
                    remedy="write it as a constant into the function, or give a finite number",
                )
            values.append(value.ravel())
    return values


def _of_file(model: ModelFile, sensors: Any, noise: Mapping[str, Any]) -> Joined:
    if sensors is not None and sensors != ():
        raise InputError(
            "`sensors` are given beside a model file, which has its own",
            argument="sensors",
            remedy="leave them out: gv.filter(model_file, None, t, z), model_file.filter(…), model_file.batch_job(…)",
        )
    if noise:
        raise InputError("`noise` cannot be given for a model file", argument="noise", remedy="write it into the file")
    native = model.native
    places, start = {}, 0
    for sensor in native.sensors:
        stop = start + len(sensor["columns"])
        places[sensor["name"]] = slice(start, stop)
        start = stop
    states, controls = tuple(native.states), tuple(native.control_names)
    return Joined(native, states, controls, places, tuple(native.measures), {})


def _made(model: Dynamics, sensors: Sequence[Sensor], noise: Mapping[str, tuple[int, ...]]) -> Joined:
    graph = Graph()
    values = np.concatenate([np.empty(0), *_values(model, sensors)]).tolist()
    places = slots(model._parameters)
    start = sum(value.size for value in model._parameters.values())
    controls, stacked, blocks, count = len(model.controls), [], {}, 0
    measuring: list[Placed] = []
    for sensor in sensors:
        own = slots(sensor._parameters, start)
        start += sum(value.size for value in sensor._parameters.values())
        shape = noise.get(sensor.name)
        stacked.append(_sensor(graph, sensor, model, own, shape, controls))
        measuring.append(_placed(sensor._traced(model.state, model.controls)["h"], own))
        controls += int(np.prod(shape)) if shape is not None else 0
        blocks[sensor.name] = slice(count, count + len(sensor.measures))
        count += len(sensor.measures)
    parts = {argument: part.into(graph, places) for argument, part in model._parts.items()}
    jacobian: Any = model.jacobian.into(graph, places) if model.jacobian is not None else None
    if model.kind == "continuous":
        shape = model._parts["diffusion"].shape
        noises = shape[1] if shape is not None else 0
        native = _native.Model.continuous(
            graph, model.state, controls, values, parts["drift"], parts["diffusion"], noises, stacked, jacobian=jacobian
        )
    else:
        step = getattr(model, "step", None)
        native = _native.Model.discrete(
            graph, model.state, controls, values, parts["f"], parts["noise_cov"], step, stacked, jacobian=jacobian
        )
    measures = tuple(name for sensor in sensors for name in sensor.measures)
    motion = tuple(_placed(part, places) for part in model._parts.values())
    return Joined(native, model.state, model.controls, blocks, measures, dict(noise), motion, tuple(measuring))


def _placed(part: Part, places: Mapping[str, slice]) -> Placed:
    return part, tuple(k for name in part.parameters for k in range(places[name].start, places[name].stop))


def _sensor(
    graph: Graph,
    sensor: Sensor,
    model: Dynamics,
    places: Mapping[str, slice],
    shape: tuple[int, ...] | None,
    controls: int,
) -> Any:
    parts = sensor._traced(model.state, model.controls)
    described: dict[str, Any] = {
        "name": sensor.name,
        "columns": list(sensor.measures),
        "measures": parts["h"].into(graph, places),
        "angles": list(sensor._periods),
    }
    if shape is None:
        described[sensor._noise] = parts[sensor._noise].into(graph, places)
    else:
        # noise that comes with the rows travels behind the controls
        hidden = [graph.control(controls + k) for k in range(int(np.prod(shape)))]
        described["std" if len(shape) == 1 else "cov"] = hidden
    if "jacobian" in parts:
        described["jacobian"] = parts["jacobian"].into(graph, places)
    return described


def named_sensor(joined: Joined, argument: str, name: object) -> slice:
    """Where the measures of a sensor stand."""
    from givens._names import known_name

    return joined.sensors[known_name(argument, name, tuple(joined.sensors), "sensor")]
