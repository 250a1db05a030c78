"""Filters that are stepped by hand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Self

import numpy as np

from givens import _native
from givens._arrays import Array, numbers, shape_error, vector
from givens._clock import Clock, clock_of
from givens._join import Joined, join, named_sensor
from givens._method import choose
from givens._plan import read_prior
from givens._steep import Derivatives
from givens.errors import InputError, StepError
from givens.gaussian import Gaussian

__all__ = ["Filter"]


class Filter:
    """A filter for measurements as they come.

    It can be copied and pickled at any time; the copy goes on to the bit.

    Parameters
    ----------
    model, sensors, method, **options
        As for `filter`.
    prior : Gaussian
        The belief at `t0`.
    t0 : float or date
        When it holds.
    u : array_like or mapping, optional
        The first controls.

    Raises
    ------
    InputError, MethodError
        For arguments that cannot serve.

    Examples
    --------
    >>> import givens as gv
    >>> model = gv.Sde(lambda t, x: [x[1], -x[0]], diffusion=[0.0, 0.1], state=["x", "v"])
    >>> ruler = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[0.1])
    >>> f = gv.Filter(model, ruler, prior=gv.Gaussian([1, 0], std=[1, 1]), t0=0.0)
    >>> f.predict(0.5)
    >>> f.update([0.9])
    >>> f.time, f.state.mean.shape, f.nis_dof
    (0.5, (2,), 1)
    """

    def __init__(
        self,
        model: Any,
        sensors: Any = None,
        *,
        prior: Gaussian | None = None,
        t0: Any,
        method: str | None = None,
        u: Any = None,
        **options: Any,
    ) -> None:
        self._model, self._sensors = model, sensors
        self._method, self._options = method, options
        self._clock: Clock = clock_of(t0, t0)
        mean, cov = read_prior(model, prior, join(model, sensors).states)
        self._bind()
        start = self._clock.moment("t0", t0)
        derivatives = Derivatives.of(self._joined, self._choice)
        self._native = _native.Filter.start(self._joined.native, self._choice, mean, cov, start)
        controls = self._controls(u) if u is not None or self._joined.controls else None
        derivatives.refuse(self._joined, start, mean, None if controls is None else controls[None])
        if controls is not None:
            self._native.set_controls(controls)

    def _bind(self) -> None:
        self._joined: Joined = join(self._model, self._sensors)
        self._choice = choose(self._model, self._joined, self._method, self._options)

    def predict(self, t: Any) -> None:
        """Moves the belief to time `t`, at or after `time`.

        Raises
        ------
        StepError
            For a step that fails; the belief stays as it was.
        """
        with self._dated():
            self._native.predict(self._clock.moment("t", t))

    def update(self, z: Any, sensor: str | None = None) -> None:
        """Teaches the belief a measurement made at `time`.

        Parameters
        ----------
        z : array_like or mapping
            Of all sensors, length d, or a table by sensor; NaN where a component is missing.
        sensor : str, optional
            The sensor that `z` is of, where there are several.

        Raises
        ------
        StepError
            For a step that fails; the belief stays as it was.
        """
        with self._dated():
            self._native.update(self._stacked(z, sensor))

    @contextmanager
    def _dated(self) -> Iterator[None]:
        """Says what the seconds in an error are counted from, if they are counted from a date."""
        try:
            yield
        except StepError as error:
            if self._clock.origin is not None:
                error.add_note(f"t is in seconds since {self._clock.origin}")
            raise

    def _stacked(self, z: Any, sensor: str | None) -> Array:
        names = self._joined.measures
        if isinstance(z, Mapping) and sensor is None:
            stacked = np.full(len(names), np.nan)
            for name, values in z.items():
                place = named_sensor(self._joined, "z", name)
                stacked[place] = _measurement(f"z[{name!r}]", values, names[place])
            return stacked
        if sensor is None:
            return _measurement("z", z, names)
        stacked, place = np.full(len(names), np.nan), named_sensor(self._joined, "sensor", sensor)
        stacked[place] = _measurement("z", z, names[place])
        return stacked

    def set_controls(self, u: Any) -> None:
        """Sets the controls, which hold until they are set again: a list in order, or a table by name."""
        self._native.set_controls(self._controls(u))

    def _controls(self, u: Any) -> Array:
        names = self._joined.controls
        if not names:
            raise InputError("the model has no controls", argument="u", remedy='name them: controls=["thrust"]')
        if u is None:
            raise InputError(f"`u` is missing: the model has the controls {', '.join(names)}", argument="u")
        controls = vector("u", u, names)
        for name, value in zip(names, controls, strict=True):
            if not np.isfinite(value):
                raise InputError(
                    f"`u` of `{name}` is {value}", argument="u", component=name, remedy="controls are always known"
                )
        return controls

    @property
    def time(self) -> Any:
        """The time of the belief: a number, or a date if `t0` is one."""
        shown = self._clock.shown(np.array([self._native.time]))[0]
        return float(shown) if self._clock.origin is None else shown

    @property
    def state(self) -> Gaussian:
        """The belief."""
        return Gaussian._known(self._native.mean, self._native.cov, self._native.factor)

    @property
    def innovation(self) -> Array:
        """Of the last measurement, shape (d,); NaN where a component was missing, and before the first."""
        return self._native.innovation

    @property
    def innovation_cov(self) -> Array:
        """Its covariance, shape (d, d)."""
        return self._native.innovation_cov

    @property
    def nis(self) -> float:
        """Of the last measurement; NaN if nothing was measured."""
        return self._native.nis

    @property
    def nis_dof(self) -> int:
        """Measures that were there."""
        return self._native.nis_dof

    @property
    def log_likelihood(self) -> float:
        """Of the last measurement; 0 if nothing was measured, or taken in."""
        return self._native.log_likelihood

    @property
    def gated(self) -> bool:
        """Whether the last measurement was beyond the `gate`, and so not taken in."""
        return self._native.gated

    @property
    def method(self) -> str:
        """The method, by its name in the registry."""
        return self._choice.title

    def copy(self) -> Self:
        """Another filter in the same belief."""
        twin = object.__new__(type(self))
        twin.__dict__.update(self.__dict__)
        twin._native = _native.Filter.resume(self._joined.native, self._choice, self._native.snapshot())
        return twin

    def __copy__(self) -> Self:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> Self:
        return self.copy()

    def __getstate__(self) -> dict[str, Any]:
        kept = ("_model", "_sensors", "_method", "_options", "_clock")
        return {name: self.__dict__[name] for name in kept} | {"_snapshot": self._native.snapshot()}

    def __setstate__(self, fields: dict[str, Any]) -> None:
        snapshot = fields.pop("_snapshot")
        self.__dict__.update(fields)
        self._bind()
        self._native = _native.Filter.resume(self._joined.native, self._choice, snapshot)

    def __repr__(self) -> str:
        return f"Filter(time={self.time}, method={self.method}, mean={np.array2string(self._native.mean, precision=6)})"


def _measurement(argument: str, z: Any, names: tuple[str, ...]) -> Array:
    array = np.atleast_1d(numbers(argument, z))
    if array.shape != (len(names),):
        column = array.ndim == 2 and 1 in array.shape and array.size == len(names)
        remedy = f"a measurement is a vector: np.ravel({argument})" if column else "name the sensor: update(z, sensor)"
        raise shape_error(argument, array.shape, f"({len(names)},): one number for each of {', '.join(names)}", remedy)
    return array
