"""Names of states, measures, controls and parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from givens._scalars import shown, text
from givens.errors import InputError

__all__ = ["known_name", "listed", "names_of"]


def listed(names: Iterable[object]) -> str:
    """Names as they stand in a message: `a`, `b`."""
    return ", ".join(f"`{name}`" for name in names)


def names_of(argument: str, names: object, *, example: str) -> tuple[str, ...]:
    """The names that an argument lists: words, not empty, each once."""
    words = f"write {argument}={example}"
    if isinstance(names, str) or not isinstance(names, Iterable):
        raise InputError(f"`{argument}` is {shown(names)}, not a list of names", argument=argument, remedy=words)
    found = tuple(names)
    for name in found:
        if not isinstance(name, str) or not name.strip():
            raise InputError(f"`{argument}` holds {shown(name)}, which is no name", argument=argument, remedy=words)
        text(argument, name, "a name", words)
    for k, name in enumerate(found):
        if name in found[:k]:
            raise InputError(
                f"`{argument}` names `{name}` twice", argument=argument, component=name, remedy="name each one once"
            )
    return found


def known_name(argument: str, name: object, among: Sequence[str], what: str) -> str:
    """`name`, if it is among the known ones; `what` says of what kind they are."""
    if isinstance(name, str) and name in among:
        return name
    from difflib import get_close_matches

    word = name if isinstance(name, str) else shown(name)
    close = get_close_matches(word, among, 1)
    if close:
        remedy = f"did you mean `{close[0]}`?"
    else:
        remedy = f"there {'is' if len(among) == 1 else 'are'} {listed(among)}" if among else "there is none"
    raise InputError(
        f"`{argument}` names `{word}`, which is no {what}", argument=argument, component=word, remedy=remedy
    )


def ordered(argument: str, table: Mapping[str, object], among: Sequence[str], what: str) -> list[object | None]:
    """The entries of a table by name, in the order of the names; None where there is none."""
    for name in table:
        known_name(argument, name, among, what)
    return [table.get(name) for name in among]
