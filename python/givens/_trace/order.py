"""The places of a function's arguments, and names that contradict them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from givens._trace.place import of_function
from givens.errors import InputError

__all__ = ["check_places", "written"]

#: Names that say what an argument is, wherever it stands. Others, `u` too, may be anything.
_SAID = {
    **dict.fromkeys(("t", "time"), "t"),
    **dict.fromkeys(("dt", "delta_t"), "dt"),
    **dict.fromkeys(("x", "state", "states"), "x"),
}
_CONTROLS = ("u", "control", "controls", "input", "inputs")
_FIRST = {"t": "the time", "dt": "the step", "x": "the state", "u": "the controls"}


def written(function: Callable[..., Any], argument: str, places: Sequence[str]) -> str:
    """How a function of these places begins: `def drift(t, x)`."""
    name = of_function(function).function or argument
    if name == "<lambda>":
        return f"lambda {', '.join(places)}: …"
    return f"def {name if name.isidentifier() else argument}({', '.join(places)})"


def check_places(
    argument: str, function: Callable[..., Any], names: Sequence[str], required: Sequence[str], optional: Sequence[str]
) -> None:
    """Refuses names at the places of others, and too many or too few of them."""
    places = (*required, *optional)
    wanted = ", ".join(required) + "".join(f"[, {name}]" for name in optional)
    takes = f"`{argument}`: {of_function(function).function} takes ({', '.join(names)})" if names else ""
    takes = takes or f"`{argument}`: {of_function(function).function} takes no arguments"
    extra = names[len(places)] if len(names) > len(places) and "u" not in optional else None
    if extra in _CONTROLS and _misplaced(names, places) is None:
        raise InputError(
            f"{takes}, but the model has no controls",
            argument=argument,
            remedy=f'name them with the model: controls=["thrust"]; a parameter has a default: *, {extra}=1.0',
        )
    if not len(required) <= len(names) <= len(places):
        remedy = f"write def {argument}({', '.join((*places, '*', 'parameter=1.0'))})"
        remedy += "; controls are named in controls=[…]" if extra is not None else ""
        raise InputError(f"{takes}, but it is given ({wanted})", argument=argument, remedy=remedy)
    misplaced = _misplaced(names, places)
    if misplaced is None:
        return
    if misplaced in places:
        first, *rest = (_FIRST[place] for place in places[: len(names)])
        remedy = (
            f"write {written(function, argument, places[: len(names)])}, {first} first, then {', then '.join(rest)}"
        )
        remedy += "; controls are named in controls=[…]" if names[-1] in _CONTROLS and "u" not in optional else ""
    else:
        remedy = f"write def {argument}({', '.join(places[: len(names)])}): it may not depend on {_FIRST[misplaced]}"
    raise InputError(f"{takes}, but it is given ({wanted})", argument=argument, remedy=remedy)


def _misplaced(names: Sequence[str], places: Sequence[str]) -> str | None:
    """What the first name says that stands at another's place."""
    for name, place in zip(names, places, strict=False):
        said = _SAID.get(name)
        if said is not None and said != place:
            return said
    return None
