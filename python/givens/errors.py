"""What goes wrong, as exceptions that carry their fields.

All of them are `GivensError`; each also is the built-in exception that its kind suggests, so that programs which know
nothing of this package catch it where they look for it. They can be pickled.

Fields are indices, from zero, as everywhere in Python; so are rows and elements in the messages (row 3, `cov[0, 1]`).
What has a name, such as a state, is called by it. Only pivots are counted from one in words (pivot 2 of 3).
"""

from __future__ import annotations

from typing import Any

__all__ = ["DoubtWarning", "GivensError", "InputError", "MethodError", "ModelError", "StepError", "TraceError"]


class DoubtWarning(UserWarning):
    """Answers that may be wrong, though no step of the filter has refused them.

    Steps of equal length were too long, so that a prediction moves by more than a twentieth of its standard deviation
    where they are halved; or a measurement has left of a covariance only what is rounding. The words say which, where,
    and what to do about it.

    Whoever would rather have an exception turns it into one: ``warnings.simplefilter("error", gv.DoubtWarning)``.
    """


class GivensError(Exception):
    """Anything that this package raises on its own account.

    Parameters
    ----------
    message
        What is wrong.
    remedy
        What to do about it, if that is known.

    Attributes
    ----------
    message : str
        What is wrong.
    remedy : str or None
        What to do about it.
    """

    message: str
    remedy: str | None

    def __init__(self, message: str, *, remedy: str | None = None) -> None:
        # only the message is an argument: copies and pickles bring the fields by themselves
        super().__init__(message)
        self.message = message
        self.remedy = remedy

    def __str__(self) -> str:
        return self.message if self.remedy is None else f"{self.message}\n  help: {self.remedy}"


class InputError(GivensError, ValueError):
    """An argument that cannot serve.

    Attributes
    ----------
    argument : str or None
        The argument, as the function names it.
    row : int or None
        The row of the data, from zero; of a batch, the row of the track. The message says which of a table it is.
    component : str or None
        The state, measure, control or parameter, by its name.
    track : object
        The track concerned, where there are several: its name or number.
    """

    argument: str | None
    row: int | None
    component: str | None
    track: Any

    def __init__(
        self,
        message: str,
        *,
        argument: str | None = None,
        row: int | None = None,
        component: str | None = None,
        track: Any = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(message, remedy=remedy)
        self.argument = argument
        self.row = row
        self.component = component
        self.track = track


class TraceError(InputError):
    """A function that cannot become expressions.

    Attributes
    ----------
    function : str or None
        Its name.
    file : str or None
        Where it stands.
    line : int or None
        The line at fault, from one.
    source : str or None
        That line.
    """

    function: str | None
    file: str | None
    line: int | None
    source: str | None

    def __init__(
        self,
        message: str,
        *,
        function: str | None = None,
        file: str | None = None,
        line: int | None = None,
        source: str | None = None,
        argument: str | None = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(message, argument=argument, remedy=remedy)
        self.function = function
        self.file = file
        self.line = line
        self.source = source


class ModelError(InputError):
    """A model file, or a table read for one, with errors; the message tells all of them, with their places.

    Attributes
    ----------
    file : str or None
        The file, as it was named.
    line, column : int or None
        The place of the first error, from one.
    """

    file: str | None
    line: int | None
    column: int | None

    def __init__(
        self,
        message: str,
        *,
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(message, remedy=remedy)
        self.file = file
        self.line = line
        self.column = column


class MethodError(InputError):
    """A method, a part or an option that does not exist, is out of its range, or does not go with the model.

    Attributes
    ----------
    option : str or None
        The part or option; None: the method itself.
    """

    option: str | None

    def __init__(
        self,
        message: str,
        *,
        option: str | None = None,
        argument: str | None = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(message, argument=argument or option or "method", remedy=remedy)
        self.option = option


class StepError(GivensError, ArithmeticError):
    """A step of a filter, a smoother or a simulation that failed on the way.

    Attributes
    ----------
    time : float or None
        The time that was reached, or was to be reached by the prediction that failed.
    row : int or None
        The row of the data at work, from zero.
    step : int or None
        How many predictions and updates had been done before.
    fault : str or None
        The kind of failure: ``"not-positive"``, ``"not-finite"``, ``"singular-innovation"``, ``"solver"``, …
    matrix : str or None
        The covariance that has no root, such as ``"innovation covariance"``.
    pivot : int or None
        The pivot at which its factorisation failed, from zero; the message counts from one, and names its state or
        measure.
    quantity : str or None
        What is not a finite number, such as ``"drift"``.
    component : str or None
        The state or measure concerned, by its name.
    mean : array or None
        The mean from which the failed step set out.
    track : object
        The track that failed, where there are several: its name or number.
    finished : object
        The estimates of the rows before, where a whole trajectory was run.
    """

    time: float | None
    row: int | None
    step: int | None
    fault: str | None
    matrix: str | None
    pivot: int | None
    quantity: str | None
    component: str | None
    mean: Any
    track: Any
    finished: Any

    def __init__(
        self,
        message: str,
        *,
        time: float | None = None,
        row: int | None = None,
        step: int | None = None,
        fault: str | None = None,
        matrix: str | None = None,
        pivot: int | None = None,
        quantity: str | None = None,
        component: str | None = None,
        mean: Any = None,
        track: Any = None,
        finished: Any = None,
        remedy: str | None = None,
    ) -> None:
        super().__init__(message, remedy=remedy)
        self.time = time
        self.row = row
        self.step = step
        self.fault = fault
        self.matrix = matrix
        self.pivot = pivot
        self.quantity = quantity
        self.component = component
        self.mean = mean
        self.track = track
        self.finished = finished
