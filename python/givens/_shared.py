"""Measures of one name that several sensors have, in tables that do not say whose a number is."""

from __future__ import annotations

from typing import Any

import numpy as np

from givens._arrays import Array
from givens._join import Joined
from givens._names import listed
from givens.errors import InputError

__all__ = ["refuse_shared", "refuse_shared_rows"]


def _shared(joined: Joined) -> dict[str, list[str]]:
    """The sensors of each measure that several have."""
    owners: dict[str, list[str]] = {}
    for sensor, place in joined.sensors.items():
        for name in joined.measures[place]:
            owners.setdefault(name, []).append(sensor)
    return {name: sensors for name, sensors in owners.items() if len(sensors) > 1}


def refuse_shared(joined: Joined, remedy: str) -> None:
    """Refuses a table by the names of measures, if one of them is of several sensors: it would be counted for each."""
    for name, sensors in _shared(joined).items():
        raise InputError(
            f"the column `{name}` may be of {listed(sensors)}, which all measure `{name}`",
            argument="z",
            component=name,
            remedy=remedy,
        )


def refuse_shared_rows(joined: Joined, nameless: np.ndarray[Any, Any], z: Array) -> None:
    """Refuses rows of no sensor, `nameless`, in which there is a measure of several sensors."""
    for name, sensors in _shared(joined).items():
        at = [k for k, measure in enumerate(joined.measures) if measure == name]
        rows = np.flatnonzero(nameless & ~np.isnan(z[:, at]).all(axis=1))
        if len(rows):
            raise InputError(
                f"row {rows[0]} of the table names no sensor, and `{name}` may be of {listed(sensors)}",
                argument="z",
                row=int(rows[0]),
                component=name,
                remedy="name the sensor of each such row in the column `sensor`",
            )
