"""A number that is not known yet."""

from __future__ import annotations

from typing import Any, NoReturn, cast

import numpy as np

from givens._trace.refuse import refuse, refuse_branch, refuse_conversion, refuse_difference
from givens._trace.tape import Tape

__all__ = ["Scalar", "Sym", "binary", "is_condition", "is_number", "is_symbol", "power", "select", "unary"]

#: What stands in a traced array: a symbol or a plain number.
Scalar = Any


class Sym:
    """A number that an instruction on a tape gives; arithmetic with it writes further instructions.

    It looks like a NumPy scalar. Where Python needs its value, to branch or to convert, it refuses with a
    `TraceError` that names the line.
    """

    __slots__ = ("node", "tape")

    tape: Tape
    node: int

    def __init__(self, tape: Tape, node: int) -> None:
        self.tape = tape
        self.node = node

    # how NumPy calls it

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **kwargs: Any) -> Any:
        from givens._trace.universal import call_ufunc

        return call_ufunc(ufunc, method, inputs, kwargs)

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        from givens._trace.functions import call_function

        return call_function(func, args, kwargs)

    def __getattr__(self, name: str) -> Any:
        # NumPy's loops over objects call x.sin() for np.sin
        from givens._trace.universal import method_of

        found = method_of(self, name)
        if found is None:
            raise AttributeError(f"a number has no attribute {name!r}")
        return found

    # arithmetic

    def __add__(self, other: Any) -> Any:
        # of two conditions, NumPy's sum is their or
        return binary("or" if is_condition(self) and is_condition(other) else "add", self, other)

    def __radd__(self, other: Any) -> Any:
        return binary("add", other, self)

    def __sub__(self, other: Any) -> Any:
        if is_condition(self) and is_condition(other):
            raise refuse_difference()
        return binary("sub", self, other)

    def __rsub__(self, other: Any) -> Any:
        return binary("sub", other, self)

    def __mul__(self, other: Any) -> Any:
        return binary("mul", self, other)

    def __rmul__(self, other: Any) -> Any:
        return binary("mul", other, self)

    def __truediv__(self, other: Any) -> Any:
        return binary("div", self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return binary("div", other, self)

    def __pow__(self, other: Any, modulo: None = None) -> Any:
        return power(self, other)

    def __rpow__(self, other: Any) -> Any:
        return power(other, self)

    def __floordiv__(self, other: Any) -> Any:
        return NotImplemented if not _fits(other) else np.floor_divide(self, other)

    def __rfloordiv__(self, other: Any) -> Any:
        return NotImplemented if not _fits(other) else np.floor_divide(other, self)

    def __mod__(self, other: Any) -> Any:
        return NotImplemented if not _fits(other) else np.mod(self, other)

    def __rmod__(self, other: Any) -> Any:
        return NotImplemented if not _fits(other) else np.mod(other, self)

    def __divmod__(self, other: Any) -> Any:
        return (self // other, self % other)

    def __rdivmod__(self, other: Any) -> Any:
        return (other // self, other % self)

    def __neg__(self) -> Sym:
        return unary("neg", self)

    def __pos__(self) -> Sym:
        return self

    def __abs__(self) -> Sym:
        return unary("abs", self)

    def __floor__(self) -> Sym:
        return unary("floor", self)

    def __ceil__(self) -> Any:
        return np.ceil(cast("Any", self))

    def __trunc__(self) -> Any:
        return np.trunc(cast("Any", self))

    def __round__(self, digits: int | None = None) -> Any:
        if digits is None:
            raise refuse_conversion("round")
        return np.round(cast("Any", self), digits)

    # conditions

    def __lt__(self, other: Any) -> Any:
        return binary("less", self, other)

    def __le__(self, other: Any) -> Any:
        return binary("less_equal", self, other)

    def __gt__(self, other: Any) -> Any:
        return binary("less", other, self)

    def __ge__(self, other: Any) -> Any:
        return binary("less_equal", other, self)

    def __eq__(self, other: object) -> Any:
        return binary("equal", self, other)

    def __ne__(self, other: object) -> Any:
        same = binary("equal", self, other)
        return same if same is NotImplemented else unary("not", same)

    __hash__ = None  # type: ignore[assignment]

    def __and__(self, other: Any) -> Any:
        return binary("and", self, other)

    __rand__ = __and__

    def __or__(self, other: Any) -> Any:
        return binary("or", self, other)

    __ror__ = __or__

    def __xor__(self, other: Any) -> Any:
        return NotImplemented if not _fits(other) else (self | other) & ~(self & other)

    __rxor__ = __xor__

    def __invert__(self) -> Sym:
        return unary("not", self)

    # what needs a value

    def __bool__(self) -> NoReturn:
        raise refuse_branch()

    def __float__(self) -> NoReturn:
        raise refuse_conversion("float")

    def __int__(self) -> NoReturn:
        raise refuse_conversion("int")

    def __index__(self) -> NoReturn:
        raise refuse_conversion("index")

    def __complex__(self) -> NoReturn:
        raise refuse_conversion("complex")

    def __format__(self, spec: str) -> str:
        if spec:
            raise refuse_conversion("str")
        return repr(self)

    def __repr__(self) -> str:
        return f"<symbol {self.node}>"

    # what a NumPy scalar is

    shape = ()
    ndim = 0
    size = 1
    dtype = np.dtype(float)
    imag = 0.0

    @property
    def real(self) -> Sym:
        return self

    T = real

    def copy(self) -> Sym:
        return self

    item = copy

    def astype(self, dtype: Any, **_: Any) -> Any:
        from givens._trace.array import check_held

        check_held(dtype)
        return self

    __copy__ = copy

    def __deepcopy__(self, memo: object) -> Sym:
        return self


def is_symbol(value: object) -> bool:
    """Whether this is a symbol."""
    return isinstance(value, Sym)


_CONDITIONS = frozenset(("less", "less_equal", "equal", "and", "or", "not"))


def is_condition(value: object) -> bool:
    """Whether this symbol is true or false."""
    return isinstance(value, Sym) and value.tape.instructions[value.node][0] in _CONDITIONS


def is_number(value: object) -> bool:
    """Whether this is one plain real number."""
    if isinstance(value, (int, float, np.floating, np.integer, np.bool_)):
        return True
    return isinstance(value, np.ndarray) and value.ndim == 0 and value.dtype.kind in "fiub"


def _fits(value: object) -> bool:
    return isinstance(value, Sym) or is_number(value)


def _tape(*values: Scalar) -> Tape:
    tapes = [value.tape for value in values if isinstance(value, Sym)]
    if any(tape is not tapes[0] for tape in tapes):
        raise refuse(
            "a value of another call is used here",
            "keep nothing between calls: a function is traced as a function of its arguments alone",
        )
    return tapes[0]


def _node(tape: Tape, value: Scalar) -> int:
    return value.node if isinstance(value, Sym) else _put(tape, "constant", float(value).hex()).node


def _put(tape: Tape, *instruction: str | int) -> Sym:
    try:
        return Sym(tape, tape.put(*instruction))
    except OverflowError as error:
        raise refuse(str(error), "shorten its loops, or pass trace=False") from None


def unary(op: str, a: Sym) -> Sym:
    """An operation on one symbol."""
    return _put(a.tape, op, a.node)


def binary(op: str, a: Scalar, b: Scalar) -> Any:
    """An operation on two numbers, one of them a symbol; NotImplemented for what is no number."""
    if not (_fits(a) and _fits(b)):
        if isinstance(a, (complex, np.complexfloating)) or isinstance(b, (complex, np.complexfloating)):
            raise refuse_conversion("complex")
        return NotImplemented
    tape = _tape(a, b)
    return _put(tape, op, _node(tape, a), _node(tape, b))


def power(a: Scalar, b: Scalar) -> Any:
    """`a` to the power `b`; whole numbers up to a thousand by multiplication."""
    if isinstance(a, Sym) and is_number(b) and float(b).is_integer() and abs(float(b)) <= 1000:
        return _put(a.tape, "power", a.node, int(b))
    return binary("pow", a, b)


def select(condition: Scalar, yes: Scalar, no: Scalar) -> Scalar:
    """`yes` where the condition holds, else `no`."""
    if not isinstance(condition, Sym):
        return yes if condition else no
    tape = _tape(condition, yes, no)
    return _put(tape, "select", condition.node, _node(tape, yes), _node(tape, no))
