"""Whether a function keeps symbols in the user's own objects, and taking them out again.

A copy of a function has its own globals, closures and instances, but a list or a table that they hold is the user's.
"""

from __future__ import annotations

import functools
from collections import deque
from collections.abc import Iterator
from types import FunctionType, MethodType
from typing import Any

import numpy as np

from givens._trace.array import SymArray
from givens._trace.symbol import Sym
from givens._trace.transplant import LONGEST, is_foreign, names_in

__all__ = ["Stores"]

_CONTAINERS = (dict, list, set, deque)


class Stores:
    """The containers that a function can reach, with what they held before it was traced."""

    def __init__(self, function: Any) -> None:
        self._held = [(label, store, _copied(store)) for label, store in _Reach().of(function, "")]

    def polluted(self) -> str | None:
        """The name of the first one that took a symbol; all of them are put back as they were."""
        found: str | None = None
        for label, store, before in self._held:
            if _took_symbols(store, before):
                found = label if found is None else found
                _put_back(store, before)
        return found


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


def _copied(store: Any) -> Any:
    return store.copy()


def _took_symbols(store: Any, before: Any) -> bool:
    if isinstance(store, dict):
        return any(_symbolic(part) for key, part in store.items() if before.get(key) is not part)
    known = set(map(id, np.ravel(before) if isinstance(before, np.ndarray) else before))
    parts = store.ravel() if isinstance(store, np.ndarray) else store
    return any(_symbolic(part) for part in parts if id(part) not in known)


def _symbolic(value: Any, depth: int = 0) -> bool:
    """Whether it is made of what only stands for numbers."""
    if isinstance(value, (Sym, SymArray)):
        return True
    if depth > 3:
        return False
    if isinstance(value, dict):
        return any(_symbolic(part, depth + 1) for part in value.values())
    return isinstance(value, (tuple, *_CONTAINERS)) and any(_symbolic(part, depth + 1) for part in value)


def _put_back(store: Any, before: Any) -> None:
    if isinstance(store, np.ndarray):
        store[...] = before
        return
    store.clear()
    store.extend(before) if isinstance(store, (list, deque)) else store.update(before)
