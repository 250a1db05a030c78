"""A trace without the function's derivatives, which serves every method that takes none."""

from __future__ import annotations

from dataclasses import dataclass

from givens._trace.place import Place
from givens.errors import TraceError

__all__ = ["Steep"]


@dataclass(frozen=True)
class Steep:
    """Where derivatives differ: kept until someone takes them."""

    place: Place
    #: Which derivative, and what both are.
    said: str

    def error(self, argument: str, taker: str, instead: str) -> TraceError:
        """What is said to the one who takes them; `instead` is a way that takes none."""
        return TraceError(
            f"{self.place}: its expressions do not have its derivatives, which {taker} takes: {self.said}",
            function=self.place.function,
            file=self.place.file,
            line=self.place.line,
            source=self.place.source,
            argument=argument,
            remedy="write np.where(x < 0, -f(-x), f(x)) for np.sign(x) * f(np.abs(x)), and give both sides of an "
            f"np.where one slope where they meet; or write {instead}, which takes none",
        )
