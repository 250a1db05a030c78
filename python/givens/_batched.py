"""What all models have in common that run over tables of tracks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from givens.gaussian import Gaussian

if TYPE_CHECKING:
    from givens.job import BatchJob

__all__ = ["Batched"]


class Batched:
    """A model of which a job can be made."""

    __slots__ = ()

    def batch_job(
        self,
        sensors: Any = None,
        *,
        prior: Gaussian | Callable[[Any, Any], Gaussian] | None = None,
        goal: str = "filter",
        lag: int | None = None,
        method: str | None = None,
        output: str = "wide",
        t0: float | None = None,
        params: Mapping[str, Any] | None = None,
        threads: int | None = None,
        **options: Any,
    ) -> BatchJob:
        """A run over tables of many tracks, to be sent to where they are; see `BatchJob`.

        Parameters
        ----------
        sensors : Sensor or list of Sensor
            What is measured; left out for a model file, which has its own.
        prior : Gaussian, or a function of a track's times (rows,) and measurements (rows, d) that gives one
            The belief in which each track begins; for a model file optional, in place of its own.
        goal : str
            ``"filter"``, or ``"smooth"``; with `lag`, that many rows later.
        method : str, optional
            A name of `methods`.
        output : str
            The columns of the answers. ``"wide"``: mean and standard deviation of each state, NIS and log-likelihood.
            ``"covariances"``: also ``cov``, of each row the lower triangle, row by row. ``"tidy"``: a row for each
            state.
        t0 : float, optional
            When the prior holds; by default at the first row of each track. Of tables with dates, seconds after that.
            A model file says it by itself.
        params : mapping, optional
            Values of parameters by name.
        threads : int, optional
            By default as many as there are cores, and one where the job has come by pickle.
        **options
            Parts and options of the method, as for `filter`.
        """
        from givens.job import BatchJob

        return BatchJob(
            self,
            sensors,
            prior=prior,
            goal=goal,
            lag=lag,
            method=method,
            output=output,
            t0=t0,
            params=params,
            threads=threads,
            **options,
        )
