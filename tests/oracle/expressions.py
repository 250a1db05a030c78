"""The expressions of a model file, evaluated in sixty digits on many points at once."""

import ast

import numpy as np
from mpmath import mp, mpf

from precise import elementwise

FUNCTIONS = {
    name: elementwise(getattr(mp, name))
    for name in "sin cos tan asin acos atan sinh cosh tanh erf erfc exp sqrt log10 floor".split()
}
FUNCTIONS |= {
    "log": elementwise(mp.ln),
    "abs": elementwise(abs),
    "sign": elementwise(mp.sign),
    "atan2": elementwise(mp.atan2, 2),
    "hypot": elementwise(mp.hypot, 2),
    "min": elementwise(min, 2),
    "max": elementwise(max, 2),
    "where": elementwise(lambda condition, yes, no: yes if condition else no, 3),
}

BINARY = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.Pow: lambda a, b: elementwise(mp.power, 2)(a, b),
}
COMPARE = {
    ast.Lt: lambda a, b: a < b,
    ast.LtE: lambda a, b: a <= b,
    ast.Gt: lambda a, b: a > b,
    ast.GtE: lambda a, b: a >= b,
    ast.Eq: lambda a, b: a == b,
    ast.NotEq: lambda a, b: a != b,
}


def parse(source):
    """A number or a text of the model file as a syntax tree. A decimal literal is its nearest double."""
    return ast.parse(str(source).replace("^", "**"), mode="eval").body


def evaluate(tree, names):
    """`names` gives each name a number or an array with one entry per point."""
    match tree:
        case ast.Constant(value=value):
            return mpf(value)
        case ast.Name(id="pi"):
            return mp.pi + 0
        case ast.Name(id=name):
            return names[name]
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -evaluate(operand, names)
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return elementwise(lambda a: not a)(evaluate(operand, names))
        case ast.BinOp(left=left, op=op, right=right):
            return BINARY[type(op)](evaluate(left, names), evaluate(right, names))
        case ast.BoolOp(op=op, values=values):
            both = (lambda a, b: bool(a and b)) if isinstance(op, ast.And) else (lambda a, b: bool(a or b))
            first, *others = [evaluate(value, names) for value in values]
            for other in others:
                first = elementwise(both, 2)(first, other)
            return first
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            return COMPARE[type(op)](evaluate(left, names), evaluate(right, names))
        case ast.Call(func=ast.Name(id=function), args=args):
            return FUNCTIONS[function](*(evaluate(arg, names) for arg in args))
    raise ValueError(f"no meaning for {ast.dump(tree)}")


def column(value, points):
    """The value at every point, also where it is the same at all of them."""
    if isinstance(value, np.ndarray):
        return value
    array = np.empty(points, dtype=object)
    array.fill(value)
    return array
