"""What is said of a function that cannot be traced, and how NumPy would write it."""

from __future__ import annotations

import re
from contextvars import ContextVar

from givens._trace.place import Place, here
from givens.errors import TraceError

__all__ = [
    "failures",
    "refuse",
    "refuse_argument",
    "refuse_branch",
    "refuse_conversion",
    "refuse_difference",
    "refuse_filling",
    "refuse_function",
]

#: The first refusal while a function is traced: one that the function itself caught is raised all the same.
failures: ContextVar[list[TraceError] | None] = ContextVar("failures", default=None)


def refuse(message: str, remedy: str, place: Place | None = None) -> TraceError:
    """The error for the line at work; the caller raises it."""
    place = here() if place is None else place
    if place.library is not None:
        message, remedy = f"{place.library} takes numbers only", _no_expression(place.library)
    error = TraceError(
        f"{place}: {message}",
        function=place.function,
        file=place.file,
        line=place.line,
        source=place.source,
        remedy=remedy,
    )
    noted = failures.get()
    if noted is not None and not noted:
        noted.append(error)
    return error


_KNOWN = "a value holds that is not known yet"
_WHERE = "write np.where(condition, yes, no)"
#: What in a line asks for true or false, how that is said, and the way to write it.
_BRANCHES = (
    (r"\bmin\s*\(", "`min` compares values that are not known yet", "write np.minimum(a, b)"),
    (r"\bmax\s*\(", "`max` compares values that are not known yet", "write np.maximum(a, b)"),
    (
        r"\bsorted\s*\(|\.sort\(",
        "sorting compares values that are not known yet",
        "write np.minimum and np.maximum of the elements",
    ),
    (r"\band\b", f"`and` asks whether {_KNOWN}", "write (a > 0) & (b > 0) inside np.where(condition, yes, no)"),
    (r"\bor\b", f"`or` asks whether {_KNOWN}", "write (a > 0) | (b > 0) inside np.where(condition, yes, no)"),
    (r"\bnot\b", f"`not` asks whether {_KNOWN}", "write ~(a > 0) inside np.where(condition, yes, no)"),
    (
        r"\bwhile\b",
        f"`while` asks whether {_KNOWN}",
        "repeat a fixed number of times with `for`, and keep values with np.where(condition, yes, no)",
    ),
    (r"\bassert\b", f"`assert` asks whether {_KNOWN}", "check numbers outside of the function"),
    (
        r"<[^<>]*<|>[^<>]*>",
        f"a chain of comparisons asks whether {_KNOWN}",
        "write (a < b) & (b < c) inside np.where(condition, yes, no)",
    ),
    (r"\bif\b", f"`if` asks whether {_KNOWN}", _WHERE),
)


def refuse_branch() -> TraceError:
    """Of a symbol taken as true or false."""
    place = here()
    for pattern, said, remedy in _BRANCHES:
        if re.search(pattern, place.source or ""):
            return refuse(said, remedy, place)
    return refuse("a value that is not known yet is taken as true or false", _WHERE, place)


#: An assignment to an element, or in place: the name of the array.
_FILLED = re.compile(r"([A-Za-z_][\w.]*)\s*(?:\[[^=]*\]\s*(?:[-+*/%@]|\*\*|//)?|(?:[-+*/%@]|\*\*|//))=(?!=)")
_CONVERSIONS = {
    "float": "leave the conversion out; math.floor, math.sqrt and their kin take such values as they are",
    "int": "np.floor(x) or np.trunc(x) stay expressions",
    "complex": "write real and imaginary parts as two numbers",
    "index": "an index, a size or a count must be a number; fix it with functools.partial(function, name=number)",
    "round": "np.round(x) stays an expression",
    "str": "what is printed or formatted must be a number; leave it out",
}


def refuse_conversion(kind: str, remedy: str | None = None) -> TraceError:
    """Of a symbol that was to become a plain number."""
    if kind == "float" and "float(" not in (here().source or "") and _FILLED.search(here().source or ""):
        return refuse_filling()
    what = {"index": "used as an index or a count", "round": "rounded to a plain number"}
    said = what.get(kind, f"turned into {'an' if kind == 'int' else 'a'} {kind}")
    return refuse(
        f"a value that is not known yet is {said}",
        remedy or _CONVERSIONS.get(kind, "leave the conversion out: everything is a 64-bit float"),
    )


def refuse_difference() -> TraceError:
    """Of a difference of two conditions."""
    remedy = "write a ^ b, or np.where(a, 1, 0) - np.where(b, 1, 0)"
    return refuse("NumPy takes no condition from another", remedy)


def refuse_filling() -> TraceError:
    """Of an array made elsewhere, or by arithmetic on numbers, that was to take a symbol."""
    place = here()
    found = _FILLED.search(place.source or "")
    name = found.group(1) if found is not None else "y"
    what = "an array of plain numbers" if found is None else f"`{name}`, an array of plain numbers,"
    remedy = f"write {name} = np.array({name}) before: what np.array, np.zeros and their kin make inside the function"
    return refuse(f"{what} was to take a value that is not known yet", f"{remedy} takes it", place)


def refuse_function(name: str, remedy: str | None = None) -> TraceError:
    """Of a function that has no expression."""
    return refuse(f"{name} has no expression here", remedy or _no_expression(name))


def refuse_argument(name: str, argument: str) -> TraceError:
    """Of an argument of a function that would not be honoured."""
    return refuse(
        f"{name}(…, {argument}=…) has no expression here", _ARGUMENTS.get(argument, f"leave `{argument}` out")
    )


_ARGUMENTS = {
    "where": "write np.where(condition, yes, no)",
    "dtype": "leave `dtype` out: everything is a 64-bit float; np.floor(x) and np.trunc(x) stay expressions",
    "out": "assign the result: y[:] = …",
    "copy": "assign the result: y[:] = np.nan_to_num(y)",
}

_INSTEAD = {
    "numpy.sort": "write np.minimum and np.maximum of the elements",
    "numpy.argmax": "write np.where(a > b, …, …)",
    "numpy.argmin": "write np.where(a < b, …, …)",
    "numpy.median": "for three numbers, np.maximum(np.minimum(a, b), np.minimum(np.maximum(a, b), c))",
    "numpy.unwrap": "declare the angle: Sensor(…, angles=[name]) wraps innovations everywhere",
    "numpy.linalg.eig": "write the eigenvalues by formula, or pass trace=False",
    "numpy.linalg.pinv": "write A.T @ np.linalg.inv(A @ A.T), or pass trace=False",
    "numpy.linalg.lstsq": "write np.linalg.solve(A.T @ A, A.T @ b)",
    "scipy.linalg.expm": "write its elements by formula, or a sum, np.eye(n) + A + A @ A / 2 + …, or pass trace=False",
}


def _no_expression(name: str) -> str:
    return _INSTEAD.get(name, "write it with arithmetic and NumPy's elementary functions, or pass trace=False")
