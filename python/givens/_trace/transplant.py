"""A copy of a function, and of all of the user's code that it reaches, in which NumPy and `math` know symbols.

Nothing of the user's is changed: functions are made anew from the same code with other globals, closures and defaults,
objects are shallow copies of a class with such methods. Code that cannot be reached this way still meets the symbols
themselves, and either works with them or refuses.
"""

from __future__ import annotations

import copy
import functools
import sys
from abc import ABCMeta
from collections.abc import Iterator
from types import CellType, CodeType, FunctionType, MethodType, ModuleType
from typing import Any

from givens._trace.faces import Face, face_of_value, faced_builtins

__all__ = ["LONGEST", "is_foreign", "names_in", "transplanted"]

#: Packages whose code is left as it is.
_FOREIGN = frozenset(sys.stdlib_module_names) | {
    *("numpy", "scipy", "givens", "pandas", "polars", "pyarrow", "xarray", "matplotlib", "sympy", "numba", "llvmlite"),
    *("jax", "torch", "tensorflow", "pytest", "hypothesis", "IPython"),
}
#: The longest list or table that is looked through.
LONGEST = 1000


def transplanted(function: Any) -> Any:
    """The copy of a callable."""
    return _Transplant().of(function)


def is_foreign(module: object) -> bool:
    """Whether code of this module is left as it is."""
    # what stands for SymPy's expressions leads to a function made by SymPy
    return isinstance(module, str) and module.partition(".")[0] in _FOREIGN and module != "givens._symbolic"


def names_in(code: CodeType) -> Iterator[str]:
    """The global names and the attributes that code asks for, with those of the functions inside it."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from names_in(constant)


class _Transplant:
    def __init__(self) -> None:
        # the originals are kept alive beside their copies: an id is only good for so long
        self.known: dict[int, tuple[Any, Any]] = {}
        self.builtins = faced_builtins(self.of)

    def of(self, value: Any) -> Any:
        """What stands for a value; itself where nothing in it is to be replaced."""
        known = self.known.get(id(value))
        if known is not None:
            return known[1]
        seen = face_of_value(value)
        return self.keep(value, self.copied(value) if seen is value else seen)

    def keep(self, value: Any, stands: Any) -> Any:
        self.known[id(value)] = (value, stands)
        return stands

    def copied(self, value: Any) -> Any:
        if isinstance(value, FunctionType):
            module = value.__module__ or value.__globals__.get("__name__")
            return value if is_foreign(module) else self.function(value)
        if isinstance(value, MethodType):
            return MethodType(self.of(value.__func__), self.of(value.__self__))
        if isinstance(value, functools.partial):
            return functools.partial(self.of(value.func), *map(self.of, value.args), **self.mapped(value.keywords))
        if isinstance(value, ModuleType):
            ours = getattr(value, "__file__", None) and not is_foreign(value.__name__)
            return Face(value, self.of) if ours else value
        if type(value) in (list, tuple) and len(value) <= LONGEST:
            parts = [self.of(part) for part in value]
            changed = any(part is not old for part, old in zip(parts, value, strict=True))
            return type(value)(parts) if changed else value
        if type(value) is dict and len(value) <= LONGEST:
            mapping = self.mapped(value)
            return mapping if any(mapping[key] is not value[key] for key in value) else value
        wrapped = getattr(value, "py_func", None) or getattr(value, "__wrapped__", None)
        if isinstance(wrapped, FunctionType) and not isinstance(value, type):
            return self.of(wrapped)
        if isinstance(value, type):
            return self.type(value)
        return self.object(value)

    def mapped(self, mapping: dict[Any, Any]) -> dict[Any, Any]:
        return {key: self.of(value) for key, value in mapping.items()}

    def function(self, value: FunctionType) -> FunctionType:
        namespace = self.namespace(value.__globals__)
        cells = tuple(map(self.cell, value.__closure__ or (), value.__code__.co_freevars))
        new = FunctionType(value.__code__, namespace, value.__name__, None, cells or None)
        # known before what it refers to, which may be itself
        self.keep(value, new)
        new.__qualname__ = value.__qualname__
        new.__defaults__ = None if value.__defaults__ is None else tuple(map(self.of, value.__defaults__))
        new.__kwdefaults__ = self.mapped(value.__kwdefaults__ or {})
        for name in set(names_in(value.__code__)) & value.__globals__.keys():
            namespace[name] = self.of(value.__globals__[name])
        for cell, old in zip(cells, value.__closure__ or (), strict=True):
            if cell is not old and not _holds(cell) and _holds(old):
                cell.cell_contents = self.of(old.cell_contents)
        return new

    def cell(self, cell: CellType, name: str) -> CellType:
        if name == "__class__":
            return cell
        known = self.known.get(id(cell))
        return known[1] if known is not None else self.keep(cell, CellType())  # type: ignore[no-any-return]

    def namespace(self, names: dict[str, Any]) -> dict[str, Any]:
        known = self.known.get(id(names))
        if known is not None:
            return known[1]  # type: ignore[no-any-return]
        return self.keep(names, {**names, "__builtins__": self.builtins})  # type: ignore[no-any-return]

    def type(self, cls: type) -> type:
        """A subclass with the same methods, transplanted."""
        if type(cls) not in (type, ABCMeta) or is_foreign(cls.__module__):
            return cls
        self.keep(cls, cls)
        namespace: dict[str, Any] = {"__slots__": (), "__module__": cls.__module__, "__qualname__": cls.__qualname__}
        bases = [base for base in reversed(cls.__mro__) if not is_foreign(base.__module__)]
        for name, member in (item for base in bases for item in vars(base).items()):
            if isinstance(member, FunctionType) and name not in ("__new__", "__init_subclass__"):
                namespace[name] = self.of(member)
            elif isinstance(member, (staticmethod, classmethod)):
                namespace[name] = type(member)(self.of(member.__func__))
            elif isinstance(member, property):
                namespace[name] = property(*map(self.of, (member.fget, member.fset, member.fdel)))
        if len(namespace) == 3:
            return cls
        try:
            return type(cls)(cls.__name__, (cls,), namespace)
        except TypeError:
            return cls

    def object(self, value: Any) -> Any:
        """A shallow copy whose methods are transplanted."""
        cls = type(value)
        if is_foreign(cls.__module__):
            return value
        new = self.of(cls)
        if new is cls:
            return value
        try:
            twin = copy.copy(value)
            object.__setattr__(twin, "__class__", new)
        except Exception:
            # a class with its own ideas of copying: its code meets the symbols as it is
            return value
        self.keep(value, twin)
        fields = getattr(twin, "__dict__", {})
        fields.update({name: self.of(field) for name, field in fields.items()})
        return twin


def _holds(cell: CellType) -> bool:
    try:
        return cell.cell_contents is not cell
    except ValueError:
        return False
