#!/usr/bin/env python3
"""Writes reference.csv: elementary functions in 60 digits, as the sum of two float64.

    python3 reference.py            draws the points, keeps those of the file that a search has found, writes it
    python3 reference.py --check    computes every row again and compares

A row is name,x,y,hi,lo with the numbers as hexadecimal patterns of bits; functions of one number have y = 0.
Points that are in the file already stay: among them are the worst that a search through 10^6 of each has found."""
import random
import struct
import sys
from pathlib import Path

import mpmath
from mpmath import mpf

mpmath.mp.prec = 220
FILE = Path(__file__).with_name("reference.csv")
ONE = "sin cos tan asin acos atan exp ln log10 sinh cosh tanh".split()
TWO = "atan2 pow hypot".split()
# drawn last, so that the others stay
LATER = "erf erfc".split()


def bits(x):
    return f"{struct.unpack('<Q', struct.pack('<d', x))[0]:016x}"


def number(text):
    return struct.unpack("<d", struct.pack("<Q", int(text, 16)))[0]


def exact(name, x, y):
    x, y = mpf(x), mpf(y)
    if name in ("sin", "cos", "tan"):
        with mpmath.workprec(1400):
            return +getattr(mpmath, name)(x)
    if name == "atan2":
        return mpmath.atan2(x, y)
    if name == "pow":
        return mpmath.power(x, y)
    if name == "hypot":
        return mpmath.sqrt(x * x + y * y)
    if name == "ln":
        return mpmath.log(x)
    return getattr(mpmath, name)(x)


def rounded(value):
    """The nearest float64, subnormal ones included."""
    if value == 0:
        return 0.0
    exponent = max(mpmath.frexp(value)[1] - 53, -1074)
    whole = mpmath.nint(mpmath.ldexp(value, -exponent))
    if mpmath.frexp(whole)[1] + exponent > 1024:
        return float("inf") if value > 0 else float("-inf")
    return float(mpmath.ldexp(whole, exponent))


def row(name, x, y):
    value = exact(name, x, y)
    hi = rounded(value)
    lo = 0.0 if hi in (float("inf"), float("-inf")) else rounded(value - mpf(hi))
    return ",".join([name, bits(x), bits(y), bits(hi), bits(lo)])


def drawn(name, rng):
    """Points over the whole range of a function, denser where it is difficult."""
    sign = lambda x: rng.choice([-1, 1]) * x
    size = lambda a, b: 2.0 ** rng.uniform(a, b)
    if name in ("sin", "cos", "tan"):
        near = lambda: sign(float(mpf(rng.randrange(1, 2 ** rng.randrange(2, 60))) * mpmath.pi / 2))
        return [rng.uniform(-10, 10), sign(size(-60, 1024)), sign(size(0, 40)), near()]
    if name in ("asin", "acos"):
        return [rng.uniform(-1, 1), sign(size(-1022, 0)), sign(1 - size(-53, -1)), sign(0.5 + sign(size(-50, -2)))]
    if name == "atan":
        return [rng.uniform(-4, 4), sign(size(-1070, 1023)), sign(size(-4, 4))]
    if name == "exp":
        return [rng.uniform(-745, 709.7), rng.uniform(-2, 2), sign(size(-60, 3)), rng.uniform(-746, -707)]
    if name in ("ln", "log10"):
        return [size(-1074, 1023), 1 + sign(size(-52, -1)), rng.uniform(0.3, 3)]
    if name in ("sinh", "cosh"):
        return [rng.uniform(-710.4, 710.4), rng.uniform(-2, 2), sign(size(-1022, 4))]
    if name == "erf":
        return [rng.uniform(-6.2, 6.2), rng.uniform(-1.3, 1.3), sign(size(-1022, 3))]
    if name == "erfc":
        return [rng.uniform(-6.2, 27.3), rng.uniform(-1.3, 1.3), sign(size(-60, 2)), rng.uniform(0.8, 2.9)]
    return [rng.uniform(-22, 22), rng.uniform(-2, 2), sign(size(-1022, 4))]


def drawn_pairs(name, rng):
    sign = lambda x: rng.choice([-1, 1]) * x
    size = lambda a, b: 2.0 ** rng.uniform(a, b)
    if name == "pow":
        base = rng.choice([size(-3, 3), size(-1022, 1023), 1 + sign(size(-50, -1))])
        return [(base, rng.uniform(-744, 709) / float(mpmath.log(base))), (-size(-3, 3), float(rng.randrange(-99, 99)))]
    x = sign(size(-4, 4))
    return [(x, sign(size(-4, 4))), (sign(size(-1000, 1000)), sign(size(-1000, 1000))), (x, x * (1 + sign(size(-50, -2))))]


def main():
    rows = [line.split(",") for line in FILE.read_text().splitlines()] if FILE.exists() else []
    if "--check" in sys.argv:
        wrong = [r for r in rows if ",".join(r) != row(r[0], number(r[1]), number(r[2]))]
        sys.exit(f"{len(wrong)} rows differ, first {wrong[0]}" if wrong else f"{len(rows)} rows agree")
    points = {(r[0], number(r[1]), number(r[2])) for r in rows}
    rng = random.Random(6)
    for name in ONE:
        points |= {(name, x, 0.0) for _ in range(60) for x in drawn(name, rng)}
    for name in TWO:
        points |= {(name, x, y) for _ in range(80) for x, y in drawn_pairs(name, rng)}
    for name in LATER:
        points |= {(name, x, 0.0) for _ in range(60) for x in drawn(name, rng)}
    FILE.write_text("".join(sorted(row(*point) + "\n" for point in points)))


if __name__ == "__main__":
    main()
