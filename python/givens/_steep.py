"""Methods that take derivatives, refused where a function's expressions do not have its own."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from givens import _native
from givens._arrays import Array
from givens._dynamics import Dynamics
from givens._join import Joined, Placed
from givens._part import Part
from givens._trace.steep import Steep
from givens.errors import TraceError

__all__ = ["Derivatives", "refuse_steep_paths"]

#: Different points of one call at which derivatives are compared.
_MOST = 64


@dataclass
class Derivatives:
    """What a method takes of them, and the points at which they have been compared."""

    choice: _native.Choice
    #: Of which functions of a `Joined` it takes them, and a method that does not.
    taken: list[tuple[str, str]]
    seen: set[bytes] = field(default_factory=set)

    @classmethod
    def of(cls, joined: Joined, choice: _native.Choice) -> Derivatives:
        """Those that a method takes; refused where they are known to be wrong somewhere."""
        parts, continuous = choice.parts(len(joined.states)), joined.kind == "continuous"
        all_of_them = parts["rule"] == "taylor"
        taken = []
        if all_of_them or parts["time_update"] == "ito-taylor" or parts.get("solver") == "rodas4":
            taken.append(("motion", "sr-cd-ckf2" if continuous else "sr-ckf"))
        if all_of_them:
            taken.append(("measuring", "sr-cd-ckf" if continuous else "sr-ckf"))
        found = cls(choice, taken)
        for part, instead in found._functions(joined):
            if part[0].steep is not None:
                raise found._error(part[0], part[0].steep, instead)
        return found

    def refuse(self, joined: Joined, t: float, mean: Array, u: Array | None) -> None:
        """Refuses a run that begins there if they are wrong there."""
        functions = [found for found in self._functions(joined) if found[0][0].has_kinks]
        if not functions or len(self.seen) >= _MOST:
            return
        values, controls = joined.native.parameters, _controls(joined, u)
        self.seen.add(np.concatenate([mean, values]).tobytes())
        for (part, places), instead in functions:
            steep = part.steep_at(t, mean, controls, values[list(places)])
            if steep is not None:
                raise self._error(part, steep, instead)

    def _functions(self, joined: Joined) -> list[tuple[Placed, str]]:
        return [(placed, instead) for of, instead in self.taken for placed in getattr(joined, of)]

    def _error(self, part: Part, steep: Steep, instead: str) -> TraceError:
        return steep.error(part.argument, f"`{self.choice.name}`", f'method="{instead}"')


def _controls(joined: Joined, u: Array | None) -> Array:
    """The first ones, without the noise that stands behind them."""
    count = len(joined.controls)
    return np.zeros(count) if u is None or not len(u) else np.array(u[0, :count])


def refuse_steep_paths(model: Any, joined: Joined, t: float, mean: Array, u: Array | None) -> None:
    """Refuses to draw paths by an expansion of a drift whose derivatives the expressions do not have."""
    # where the noise depends on the state, paths are drawn without derivatives
    if not isinstance(model, Dynamics) or model.kind != "continuous" or model._parts["diffusion"].reads_state:
        return
    for part, places in joined.motion:
        steep = part.steep_at(t, mean, _controls(joined, u), joined.native.parameters[list(places)])
        if steep is not None:
            raise steep.error(part.argument, "`simulate`", "trace=False")
