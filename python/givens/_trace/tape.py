"""The instructions that a traced function left behind, each distinct one once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from givens._native import Graph

__all__ = ["MAX_NODES", "Instruction", "Tape"]

#: The most instructions that one function may need.
MAX_NODES = 50_000

#: An operation and its operands: numbers of instructions above it, a whole number, or the text of a constant.
Instruction = tuple[str | int, ...]

_INPUTS = ("state", "control", "parameter")


class Tape:
    """Instructions in order; an equal one is written once, so that equal functions leave equal numbers.

    A tape is plain data: it can be compared, pickled, and laid into any graph.
    """

    __slots__ = ("_known", "instructions")

    instructions: list[Instruction]
    _known: dict[Instruction, int]

    def __init__(self, instructions: Iterable[Instruction] = ()) -> None:
        self.instructions = list(instructions)
        self._known = {instruction: k for k, instruction in enumerate(self.instructions)}

    def __len__(self) -> int:
        return len(self.instructions)

    def __eq__(self, other: object) -> bool:
        return self.instructions == other.instructions if isinstance(other, Tape) else NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[type[Tape], tuple[list[Instruction]]]:
        return Tape, (self.instructions,)

    def put(self, *instruction: str | int) -> int:
        """The number of this instruction, new or known."""
        found = self._known.get(instruction)
        if found is not None:
            return found
        if len(self.instructions) >= MAX_NODES:
            raise OverflowError(f"more than {MAX_NODES} distinct operations")
        number = len(self.instructions)
        self.instructions.append(instruction)
        self._known[instruction] = number
        return number

    def constant(self, value: float) -> int:
        """A number, kept to the bit."""
        return self.put("constant", float(value).hex())

    def constant_value(self, number: int) -> float | None:
        """The value of an instruction that is a constant."""
        instruction = self.instructions[number]
        return float.fromhex(str(instruction[1])) if instruction[0] == "constant" else None

    def reachable(self, roots: Iterable[int]) -> list[int]:
        """What `roots` are made of, themselves included, operands first."""
        wanted = set(roots)
        for k in range(max(wanted, default=-1), -1, -1):
            if k in wanted:
                wanted.update(_operands(self.instructions[k]))
        return sorted(wanted)

    def inputs(self, roots: Iterable[int]) -> set[tuple[str, int]]:
        """What `roots` depend on: ``("state", 2)``, ``("time", 0)``, …"""
        kinds = (*_INPUTS, "time", "step")
        found = (self.instructions[k] for k in self.reachable(roots))
        return {(str(op[0]), int(op[1]) if len(op) > 1 else 0) for op in found if op[0] in kinds}

    def pruned(self, roots: Sequence[int]) -> tuple[Tape, list[int]]:
        """The instructions that `roots` need and no others, with the new numbers of `roots`."""
        kept = Tape()
        numbers: dict[int, int] = {}
        for k in self.reachable(roots):
            numbers[k] = kept.put(*_renumbered(self.instructions[k], numbers.__getitem__))
        return kept, [numbers[k] for k in roots]

    def lay_into(self, graph: Graph, roots: Sequence[int], parameters: Sequence[int] | None = None) -> list[int]:
        """Writes what `roots` need into a graph, parameter i as `parameters[i]`; the nodes of `roots`."""
        nodes: dict[int, int] = {}
        for k in self.reachable(roots):
            nodes[k] = _lay(graph, self.instructions[k], nodes, parameters)
        return [nodes[k] for k in roots]


def _operands(instruction: Instruction) -> tuple[int, ...]:
    op = instruction[0]
    if op in _INPUTS or op in ("constant", "time", "step"):
        return ()
    numbers = instruction[1:2] if op == "power" else instruction[1:]
    return tuple(int(number) for number in numbers)


def _renumbered(instruction: Instruction, new: Callable[[int], int]) -> Instruction:
    operands = _operands(instruction)
    return (instruction[0], *map(new, operands), *instruction[1 + len(operands) :])


def _lay(graph: Graph, instruction: Instruction, nodes: dict[int, int], parameters: Sequence[int] | None) -> int:
    op = str(instruction[0])
    match instruction[1:]:
        case (str(value),):
            return graph.constant(float.fromhex(value))
        case ():
            return graph.time() if op == "time" else graph.step()
        case (int(index),) if op == "state":
            return graph.state(index)
        case (int(index),) if op == "control":
            return graph.control(index)
        case (int(index),) if op == "parameter":
            return graph.parameter(index if parameters is None else parameters[index])
        case (int(a),):
            return graph.unary(op, nodes[a])
        case (int(a), int(exponent)) if op == "power":
            return graph.power(nodes[a], exponent)
        case (int(a), int(b)):
            return graph.binary(op, nodes[a], nodes[b])
        case (int(a), int(b), int(c)):
            return graph.select(nodes[a], nodes[b], nodes[c])
    raise ValueError(f"no instruction {instruction!r}")
