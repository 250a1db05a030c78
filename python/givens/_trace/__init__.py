"""Calling a user's function once with symbols, and keeping what it computes as expressions.

The way of a function: `arguments` reads its signature, `transplant` makes a copy whose NumPy, `math` and helpers know
symbols, `tracer` calls that copy with symbols (`symbol`, `array`), whose operations land on a `tape`, and `check`
compares the tape with the function at random points, its values and (`slopes`) its derivatives. `left_behind` sees that
no symbol stays in the user's lists and tables.
"""
