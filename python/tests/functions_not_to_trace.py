"""Functions that cannot be traced, each with the line at fault and what is said of it."""

import math
import random
import time

import numpy as np

CONSTANT = np.eye(3)
GENERATOR = np.random.default_rng(0)
REFUSED = []
count = 0

CHANGES = "leave out what changes between calls, such as random numbers, the clock and counters"
WHERE = "write np.where(condition, yes, no)"
WRITE = "write it with arithmetic and NumPy's elementary functions, or pass trace=False"
HOLDS = "asks whether a value holds that is not known yet"
FIRST = "call it with numbers first; if it is right, write it in NumPy's own functions, or pass trace=False"
FILLED = "`y`, an array of plain numbers, was to take a value that is not known yet"
TAKES = "write y = np.array(y) before: what np.array, np.zeros and their kin make inside the function takes it"
KEEPS = "keep nothing between calls: fill a cache before, compute it outside, or pass trace=False"
ASSIGN = "assign the result: y[:] = …"
CACHE = {}
FIELD = {}
LOG = []


def refused(said, remedy, line=2):
    """`line` counts from the decorator; 0: the message names the function alone."""

    def keep(function):
        REFUSED.append((function, said, remedy, line))
        return function

    return keep


@refused(f"`if` {HOLDS}", WHERE)
def an_if(t, x):
    if x[0] > 0:
        return x
    return -x


@refused(f"`and` {HOLDS}", "write (a > 0) & (b > 0) inside np.where(condition, yes, no)")
def an_and(t, x):
    return x if x[0] > 0 and x[1] > 0 else -x


@refused(f"`or` {HOLDS}", "write (a > 0) | (b > 0) inside np.where(condition, yes, no)")
def an_or(t, x):
    return x if x[0] > 0 or x[1] > 0 else -x


@refused(f"`not` {HOLDS}", "write ~(a > 0) inside np.where(condition, yes, no)")
def a_not(t, x):
    return x * (not x[0])


@refused("`min` compares values that are not known yet", "write np.minimum(a, b)")
def a_min(t, x):
    return x * min(x[0], 1)


@refused("`max` compares values that are not known yet", "write np.maximum(a, b)")
def a_max(t, x):
    return x * max(x)


@refused(
    f"`while` {HOLDS}",
    "repeat a fixed number of times with `for`, and keep values with np.where(condition, yes, no)",
)
def a_while(t, x):
    while x[0] > 1:
        x = x / 2
    return x


@refused(f"`assert` {HOLDS}", "check numbers outside of the function")
def an_assert(t, x):
    assert x[0] > 0
    return x


@refused(f"a chain of comparisons {HOLDS}", "write (a < b) & (b < c) inside np.where(condition, yes, no)")
def a_chain(t, x):
    return x * (0 < x[0] < 1)


@refused("sorting compares values that are not known yet", "write np.minimum and np.maximum of the elements")
def a_sorted(t, x):
    return sorted(x)


@refused("a value that is not known yet is taken as true or false", WHERE)
def an_in(t, x):
    return x * (x[0] in (1, 2))


@refused(f"`if` {HOLDS}", WHERE, line=3)
def a_caught_error(t, x):
    try:
        if x[0] > 0:
            return x
    except Exception:
        pass
    return -x


@refused(
    "a value that is not known yet is turned into a float",
    "leave the conversion out; math.floor, math.sqrt and their kin take such values as they are",
)
def a_float(t, x):
    return [float(x[0]), 0, 0]


@refused("a value that is not known yet is turned into an int", "np.floor(x) or np.trunc(x) stay expressions")
def an_int(t, x):
    return x * int(x[0])


@refused(
    "a value that is not known yet is used as an index or a count",
    "an index, a size or a count must be a number; fix it with functools.partial(function, name=number)",
)
def a_range(t, x):
    return [x[0] for _ in range(x[1])]


@refused("a value that is not known yet is rounded to a plain number", "np.round(x) stays an expression")
def a_round(t, x):
    return x * round(x[0])


@refused("a value that is not known yet is turned into a complex", "write real and imaginary parts as two numbers")
def a_complex(t, x):
    return x[0] * 1j * x


@refused(
    "a value that is not known yet is turned into a str",
    "what is printed or formatted must be a number; leave it out",
)
def a_format(t, x):
    return [f"{x[0]:.3f}"]


@refused(FILLED, TAKES, line=3)
def a_copy_of_numbers(t, x):
    y = CONSTANT.copy()
    y[0, 0] = x[0]
    return y @ x


@refused(FILLED, TAKES, line=3)
def numbers_by_arithmetic(t, x):
    y = np.arange(3) * 0.5
    y[0] = x[0]
    return y


@refused(FILLED, TAKES, line=3)
def in_place_on_numbers(t, x):
    y = CONSTANT[0].copy()
    y += x
    return y


@refused("numpy.sort has no expression here", "write np.minimum and np.maximum of the elements")
def a_sort(t, x):
    return np.sort(x)


@refused("numpy.argmax has no expression here", "write np.where(a > b, …, …)")
def an_argmax(t, x):
    return x * np.argmax(x)


@refused("numpy.linalg.eig has no expression here", "write the eigenvalues by formula, or pass trace=False")
def an_eigenvalue(t, x):
    return np.linalg.eig(np.outer(x, x))[0]


@refused("math.gamma has no expression here", WRITE)
def a_gamma(t, x):
    return x * math.gamma(x[0])


@refused("numpy.spacing has no expression here", WRITE)
def a_spacing(t, x):
    return np.spacing(x)


@refused(
    "an inverse of 9 rows has no expression here: at most 6 rows are written out",
    "use the structure of the matrix to make it smaller, or pass trace=False",
)
def a_large_inverse(t, x):
    return np.linalg.inv(np.kron(np.outer(x, x), CONSTANT))[0, :3]


@refused("np.where(condition) alone gives indices", WHERE)
def a_where_of_indices(t, x):
    return x * len(np.where(x > 0))


@refused("an index depends on a value that is not known yet", WHERE)
def a_mask(t, x):
    return x[x > 0]


@refused("more than 50000 distinct operations", "shorten its loops, or pass trace=False", line=3)
def a_long_loop(t, x):
    for _ in range(30000):
        x = x + np.sin(x)
    return x


@refused(
    "'a' stands where a number is expected",
    "join arrays with np.concatenate or np.hstack; elements are numbers and expressions of the arguments",
)
def a_word(t, x):
    return np.array([x[0], "a", 1])


@refused("when called with symbols it raised IndexError: index 5 is out of bounds for axis 0 with size 3", FIRST)
def beyond_the_end(t, x):
    return [x[0], x[1], x[5]]


@refused("when called with symbols it raised NameError: name 'undefined' is not defined", FIRST)
def a_name_error(t, x):
    return undefined * x  # noqa: F821


@refused("called twice with the same arguments, it computes different things", CHANGES, line=0)
def a_generator(t, x):
    return x + GENERATOR.normal()


@refused("called twice with the same arguments, it computes different things", CHANGES, line=0)
def a_clock(t, x):
    return x * time.perf_counter()


@refused("called twice with the same arguments, it computes different things", CHANGES, line=0)
def a_random_number(t, x):
    return x * random.random()


@refused("called twice with the same numbers, it gives different results", CHANGES, line=0)
def a_counter(t, x):
    global count
    count += 1
    return x * count


@refused("it returns nothing", "end it with `return [...]`", line=0)
def nothing(t, x):
    x[0] = 1


@refused(
    "it returns something else than an array of numbers",
    "return a list of numbers; np.concatenate and np.hstack join arrays",
    line=0,
)
def ragged(t, x):
    return [x[:2], x[2]]


@refused("it returns a table in which 'c' is missing", "its names are a, b, c", line=0)
def an_incomplete_table(t, x):
    return {"a": x[0], "b": x[1]}


@refused(
    "its expressions do not compute what it computes: component 'a' is 1.0403074299560306, but its expressions give "
    "-1.0403074299560306 at t = 1.3092007913863868, x = [1.0403074299560306, 0.67966228007249896, 0.059912434184884074]",
    "values read from elsewhere must not change between calls, and branches must be np.where; or pass trace=False",
    line=0,
)
def a_question_of_types(t, x):
    return x if isinstance(x[0], float) else -x


@refused(
    "it cannot be compared with its expressions at any of 20 random points: it is finite at none of them",
    "pass check_at=… with a state where it is finite",
    line=0,
)
def finite_nowhere(t, x):
    return np.log(-(x**2) - 1)


@refused(
    "it cannot be compared with its expressions at any of 20 random points: it raised ValueError: math domain error",
    "pass check_at=… with a state where it is finite",
    line=0,
)
def failing_everywhere(t, x):
    return [math.sqrt(-(x[0] ** 2) - 1), 0, 0]


@refused("it keeps a value that is not known yet in `CACHE`", KEEPS, line=3)
def a_filled_cache(t, x):
    if "A" not in CACHE:
        CACHE["A"] = np.eye(3) * 0.9
    return CACHE["A"] @ x


@refused("it keeps a value that is not known yet in `LOG`", KEEPS)
def a_log(t, x):
    LOG.append(x)
    return x


def halved(value):
    return value / 2


@refused("it keeps a value that is not known yet in `FIELD`", KEEPS, line=3)
def an_element(t, x):
    y = np.sin(x) + halved(1.0)
    FIELD["a"] = [t, y[0]]
    y = y + 1
    return y


@refused("it keeps a value that is not known yet in `CACHE`", KEEPS, line=4)
def a_table_after_a_helper(t, x):
    values = [halved(v) for v in x]
    total = sum(values)
    CACHE[0] = halved(total); y = halved(total)  # noqa: E702
    return [y, *values[1:]]


@refused("it keeps a value that is not known yet in `store`", KEEPS)
def a_default_that_is_filled(t, x, store=[]):  # noqa: B006
    store.append({"x": x})
    return x


@refused("numpy.sum(…, where=…) has no expression here", WHERE)
def a_sum_of_some(t, x):
    return x * np.sum(x, where=[True, False, True])


@refused("numpy.mean(…, where=…) has no expression here", WHERE)
def a_mean_of_some(t, x):
    return x * np.mean(x, where=[True, False, True])


DOUBLE = "leave `dtype` out: everything is a 64-bit float; np.floor(x) and np.trunc(x) stay expressions"


@refused("numpy.sum(…, dtype=…) has no expression here", DOUBLE)
def a_sum_of_whole_numbers(t, x):
    return x * np.sum(x, dtype=int)


@refused("numpy.multiply(…, dtype=…) has no expression here", DOUBLE)
def a_product_in_single_precision(t, x):
    return np.multiply(x, x, dtype=np.float32)


@refused(
    "a value that is not known yet is turned into a float32",
    "leave the conversion out: everything is a 64-bit float",
)
def a_single_precision(t, x):
    return x.astype(np.float32)


@refused("numpy.round(…, out=…) has no expression here", ASSIGN, line=3)
def an_out_by_position(t, x):
    y = np.array(x)
    np.round(y, 2, y)
    return y


@refused("numpy.average(…, returned=…) has no expression here", "leave `returned` out")
def an_average_with_its_weight(t, x):
    return x * np.average(x, weights=[1, 2, 3], returned=True)[1]


@refused("numpy.linspace(…, retstep=…) has no expression here", "leave `retstep` out")
def a_linspace_with_its_step(t, x):
    return x * np.linspace(0, x[0], 4, retstep=True)[1]


@refused("NumPy takes no condition from another", "write a ^ b, or np.where(a, 1, 0) - np.where(b, 1, 0)")
def a_difference_of_conditions(t, x):
    return x * ((x > 0) - (x > 1))
