"""Whether a function keeps symbols in the user's own objects, and taking them out again.

A copy of a function has its own globals, closures and instances, but a list or a table that they hold is the user's.
"""

from __future__ import annotations

import functools
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import FunctionType, MethodType
from typing import Any

import numpy as np

from givens._trace.array import SymArray
from givens._trace.culprit import line_that
from givens._trace.place import Place
from givens._trace.symbol import Sym
from givens._trace.transplant import LONGEST, is_foreign, names_in

__all__ = ["Stores"]

_CONTAINERS = (dict, list, set, deque)


@dataclass(frozen=True)
class Held:
    """A container, by the name under which it was found, and a copy of what it held."""

    name: str
    store: Any
    before: Any

    def took_symbols(self) -> bool:
        if isinstance(self.store, dict):
            return any(_symbolic(part) for key, part in self.store.items() if self.before.get(key) is not part)
        known = set(map(id, np.ravel(self.before) if isinstance(self.before, np.ndarray) else self.before))
        parts = self.store.ravel() if isinstance(self.store, np.ndarray) else self.store
        return any(_symbolic(part) for part in parts if id(part) not in known)

    def put_back(self) -> None:
        if isinstance(self.store, np.ndarray):
            self.store[...] = self.before
            return
        self.store.clear()
        self.store.extend(self.before) if isinstance(self.store, (list, deque)) else self.store.update(self.before)


class Stores:
    """The containers that a function can reach, with what they held before it was traced."""

    def __init__(self, function: Any) -> None:
        self._held = [Held(label, store, store.copy()) for label, store in _Reach().of(function, "")]

    def polluted(self) -> Held | None:
        """The first one that took a symbol; all of them are put back as they were."""
        found = [held for held in self._held if held.took_symbols()]
        for held in found:
            held.put_back()
        return found[0] if found else None

    def line_of(self, held: Held, call: Callable[[], object]) -> Place | None:
        """The line that fills this one when the function is called again."""
        try:
            return line_that(held.took_symbols, call)
        finally:
            self.polluted()


class _Reach:
    """Walks from a function over globals, closures, defaults, instances and what lies in containers."""

    def __init__(self) -> None:
        self.seen: dict[int, Any] = {}

    def of(self, value: Any, label: str) -> Iterator[tuple[str, Any]]:
        if id(value) in self.seen:
            return
        self.seen[id(value)] = value
        if isinstance(value, MethodType):
            yield from self.of(value.__self__, "self")
            yield from self.of(value.__func__, label)
        elif isinstance(value, functools.partial):
            for part in (value.func, *value.args, *value.keywords.values()):
                yield from self.of(part, label)
        elif isinstance(value, FunctionType):
            if not is_foreign(value.__module__):
                for name, part in _around(value):
                    yield from self.of(part, name)
        elif isinstance(value, _CONTAINERS) or (isinstance(value, np.ndarray) and value.dtype == object):
            if len(value) <= LONGEST:
                yield label, value
                for part in value.values() if isinstance(value, dict) else value:
                    yield from self.of(part, label)
        elif isinstance(value, tuple) and len(value) <= LONGEST:
            for part in value:
                yield from self.of(part, label)
        elif not isinstance(value, type) and not is_foreign(type(value).__module__):
            yield from self.instance(value, label)

    def instance(self, value: Any, label: str) -> Iterator[tuple[str, Any]]:
        fields = getattr(value, "__dict__", None)
        label = label or "self"
        if isinstance(fields, dict) and type(value).__module__ != "builtins":
            yield label, fields
            for name, part in fields.items():
                yield from self.of(part, f"{label}.{name}")
            for name, part in vars(type(value)).items():
                if isinstance(part, (FunctionType, *_CONTAINERS)):
                    yield from self.of(part, f"{label}.{name}")


def _around(function: FunctionType) -> Iterator[tuple[str, Any]]:
    for name in sorted(set(names_in(function.__code__)) & function.__globals__.keys()):
        yield name, function.__globals__[name]
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        try:
            yield name, cell.cell_contents
        except ValueError:
            continue
    names = function.__code__.co_varnames[: function.__code__.co_argcount]
    defaults = function.__defaults__ or ()
    yield from zip(names[len(names) - len(defaults) :], defaults, strict=True)
    yield from (function.__kwdefaults__ or {}).items()
    wrapped = getattr(function, "__wrapped__", None)
    if wrapped is not None:
        yield function.__name__, wrapped


def _symbolic(value: Any, depth: int = 0) -> bool:
    """Whether it is made of what only stands for numbers."""
    if isinstance(value, (Sym, SymArray)):
        return True
    if depth > 3:
        return False
    if isinstance(value, dict):
        return any(_symbolic(part, depth + 1) for part in value.values())
    return isinstance(value, (tuple, *_CONTAINERS)) and any(_symbolic(part, depth + 1) for part in value)
