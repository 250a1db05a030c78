"""What a traced function has become."""

from __future__ import annotations

from dataclasses import dataclass

from givens._trace.arguments import Arguments
from givens._trace.tape import Tape

__all__ = ["Sizes", "Traced"]


@dataclass(frozen=True)
class Sizes:
    """Lengths of the state and of the controls."""

    states: int
    controls: int


@dataclass(frozen=True)
class Traced:
    """What a function computes: its tape, and the instructions that give its results."""

    tape: Tape
    nodes: tuple[int, ...]
    shape: tuple[int, ...]
    arguments: Arguments

    def pruned(self) -> Traced:
        """Without what does not matter for the results."""
        tape, nodes = self.tape.pruned(self.nodes)
        return Traced(tape, tuple(nodes), self.shape, self.arguments)
