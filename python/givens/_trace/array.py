"""Arrays that hold symbols and numbers side by side."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NoReturn, cast

import numpy as np
import numpy.typing as npt

from givens._trace.refuse import refuse, refuse_branch, refuse_conversion
from givens._trace.symbol import Scalar, Sym, is_number

__all__ = ["SymArray", "boxed", "check_held", "has_symbols", "lifted", "numbers", "plain", "rank", "unboxed"]

Objects = np.ndarray[Any, np.dtype[np.object_]]


class SymArray(np.ndarray[Any, np.dtype[np.object_]]):
    """An array whose elements are symbols or numbers.

    Shapes, slices, views and assignment are NumPy's own; every computation goes through the tables of this package.
    """

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **kwargs: Any) -> Any:
        from givens._trace.universal import call_ufunc

        return call_ufunc(ufunc, method, inputs, kwargs)

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        from givens._trace.functions import call_function

        return call_function(func, args, kwargs)

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        return array[()] if return_scalar else array.view(SymArray)

    def __getitem__(self, index: Any) -> Any:
        return super().__getitem__(_index(index))

    def __setitem__(self, index: Any, value: Any) -> None:
        super().__setitem__(_index(index), plain(boxed(value)) if rank(value) else _element(value))

    def __bool__(self) -> bool:
        if self.size == 1 and not has_symbols(self):
            return bool(self.item())
        if self.size == 1:
            raise refuse_branch()
        raise ValueError("the truth value of an array with more than one element is ambiguous")

    def __float__(self) -> float:
        return float(self.item())

    def __int__(self) -> int:
        return int(self.item())

    def __index__(self) -> int:
        return cast("int", self.item().__index__())

    def __repr__(self) -> str:
        return f"SymArray({self.tolist()!r})"

    __str__ = __repr__

    def __format__(self, spec: str) -> str:
        return repr(self)

    def astype(self, dtype: Any, *_: Any, **kwargs: Any) -> Any:
        if not has_symbols(self):
            return numbers(self).astype(dtype)
        check_held(dtype)
        return self.copy() if kwargs.get("copy", True) else self


def _reduction(name: str) -> Any:
    def method(self: SymArray, *args: Any, **kwargs: Any) -> Any:
        from givens._trace.functions import call_named

        return call_named(name, (self, *args), kwargs)

    method.__name__ = name
    return method


for _name in (
    *("sum", "prod", "mean", "std", "var", "min", "max", "any", "all", "cumsum", "cumprod", "dot", "clip"),
    *("trace", "round", "argmax", "argmin", "sort", "argsort", "ptp", "searchsorted", "partition"),
):
    setattr(SymArray, _name, _reduction(_name))


def _refuse_item(value: object) -> NoReturn:
    raise refuse(
        f"{'an array' if isinstance(value, np.ndarray) else repr(value)} stands where a number is expected",
        "join arrays with np.concatenate or np.hstack; elements are numbers and expressions of the arguments",
    )


def _element(value: Any) -> Scalar:
    if isinstance(value, Sym):
        return value
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
        return _element(value)
    if is_number(value):
        return np.float64(value)
    if isinstance(value, (complex, np.complexfloating)):
        raise refuse_conversion("complex")
    _refuse_item(value)


def _index(index: Any) -> Any:
    """Indices held in traced arrays become numbers again."""
    if isinstance(index, tuple):
        return tuple(_index(part) for part in index)
    if isinstance(index, SymArray):
        if has_symbols(index):
            raise refuse("an index depends on a value that is not known yet", "write np.where(condition, yes, no)")
        return numbers(index).astype(np.intp)
    return index


def rank(value: Any) -> int:
    """The number of dimensions."""
    return value.ndim if isinstance(value, (Sym, np.ndarray)) else np.ndim(value)


def boxed(value: Any) -> SymArray:
    """Anything like an array, as an array of symbols and of 64-bit floats."""
    if isinstance(value, SymArray):
        return value
    if isinstance(value, np.ndarray) and value.dtype.kind in "fiub":
        objects = np.empty(value.shape, dtype=object)
        for at, number in zip(np.ndindex(value.shape), value.ravel(), strict=True):
            objects[at] = np.float64(number)
        return objects.view(SymArray)
    raw = np.array(value, dtype=object)
    objects = np.empty(raw.shape, dtype=object)
    for at in np.ndindex(raw.shape):
        objects[at] = _element(raw[at])
    return objects.view(SymArray)


def lifted(value: Any) -> Any:
    """Arrays of floats or of objects as `SymArray`, to be assigned to; everything else as it is."""
    if isinstance(value, SymArray) or not isinstance(value, np.ndarray):
        return value
    return boxed(value) if value.dtype.kind in "fO" else value


def plain(value: Any) -> Objects:
    """The same memory as an ordinary array of objects."""
    return cast("Objects", boxed(value).view(np.ndarray))


def unboxed(objects: Any) -> Any:
    """What a function on `plain` arrays gave: arrays as `SymArray`, single elements as they are."""
    if isinstance(objects, np.ndarray):
        return objects.item() if objects.ndim == 0 else objects.view(SymArray)
    return objects


def check_held(dtype: Any) -> None:
    """Refuses to hold symbols as anything but 64-bit floats."""
    if dtype is not None and np.dtype(dtype) not in (np.float64, np.object_):
        raise refuse_conversion("int" if np.dtype(dtype).kind in "iu" else str(np.dtype(dtype)))


def has_symbols(value: Any) -> bool:
    """Whether there is a symbol in it, at any depth."""
    if isinstance(value, Sym):
        return True
    if isinstance(value, np.ndarray):
        return value.dtype == object and any(isinstance(element, Sym) for element in value.flat)
    if isinstance(value, dict):
        return any(map(has_symbols, value.values()))
    if isinstance(value, (list, tuple)):
        return any(map(has_symbols, cast("Iterable[Any]", value)))
    return False


def numbers(value: Any) -> npt.NDArray[np.float64]:
    """The numbers of an array that holds no symbol."""
    return np.array(np.asarray(value).tolist(), dtype=float)
