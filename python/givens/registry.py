"""The methods by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from givens import _native
from givens._names import known_name

__all__ = ["Method", "MethodList", "methods"]


@dataclass(frozen=True)
class Method:
    """A method of the registry.

    Attributes
    ----------
    name : str
    aliases : tuple of str
    kind : str
        ``"discrete"`` or ``"continuous"``.
    about : str
    rule, form, time_update : str
        Its parts.
    sources : tuple of str
        Where it comes from.
    options : tuple of str
        The parts and options that it reads.
    """

    name: str
    aliases: tuple[str, ...]
    kind: str
    about: str
    rule: str
    form: str
    time_update: str
    sources: tuple[str, ...]
    options: tuple[str, ...]


class MethodList(list[Method]):
    """Methods, shown as a table."""

    def __repr__(self) -> str:
        return "\n".join(f"{one.name:<12} {one.kind:<11} {one.about}" for one in self)

    def _repr_html_(self) -> str:
        from givens._html import listing_html

        header = ("method", "kind", "about", "rule", "form", "time update")
        rows = [(one.name, one.kind, one.about, one.rule, one.form, one.time_update) for one in self]
        return listing_html(header, rows)


def methods(kind: str | None = None) -> MethodList:
    """All methods, or those of a kind.

    Parameters
    ----------
    kind : str, optional
        ``"discrete"`` or ``"continuous"``.

    Raises
    ------
    InputError
        For a kind that does not exist.

    Examples
    --------
    >>> import givens as gv
    >>> [method.name for method in gv.methods("discrete")][:3]
    ['ekf', 'ukf', 'cdkf']
    >>> "kappa" in next(method for method in gv.methods() if method.name == "ukf").options
    True
    """
    if kind is not None:
        known_name("kind", kind, ("discrete", "continuous"), "kind of method")
    found = MethodList()
    for entry in _native.methods():
        fields: dict[str, Any] = dict(entry)
        fields |= {name: tuple(fields[name]) for name in ("aliases", "sources", "options")}
        if kind in (None, fields["kind"]):
            found.append(Method(**fields))
    return found
