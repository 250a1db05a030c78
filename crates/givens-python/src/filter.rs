//! A filter that is stepped by hand.

use givens::filter::StepError;
use givens::registry::{AnyFilter, Choice as Chosen};
use numpy::{PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use self_cell::self_cell;

use crate::choice::Choice;
use crate::errors::{Input, Result};
use crate::failure::{At, noted, refusal};
use crate::model::{Model, Moves};
use crate::numbers::{frozen, shaped};
use crate::rows::{belief, finite};
use crate::snapshot::{self, Learnt};
use crate::watch::detached;

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;
type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

self_cell!(
    /// A filter and the model that it steps.
    struct Stepper {
        owner: Model,
        #[covariant]
        dependent: AnyFilter,
    }
);

impl Stepper {
    fn begin(
        model: &Model,
        start: impl for<'m> FnOnce(&'m Model) -> core::result::Result<AnyFilter<'m>, StepError>,
    ) -> core::result::Result<Self, StepError> {
        Self::try_new(model.clone(), |model| start(model))
    }
}

/// A filter that is stepped by hand; see the stub.
#[pyclass(module = "givens._native")]
pub struct Filter {
    stepper: Stepper,
    choice: Chosen,
    learnt: Learnt,
}

impl Filter {
    fn model(&self) -> &Model {
        self.stepper.borrow_owner()
    }

    fn filter(&self) -> &AnyFilter<'_> {
        self.stepper.borrow_dependent()
    }

    /// Begins without the interpreter.
    fn begin(
        py: Python<'_>,
        model: &Model,
        choice: Chosen,
        start: impl for<'m> FnOnce(&'m Model) -> core::result::Result<AnyFilter<'m>, StepError> + Send,
    ) -> Result<Self> {
        let (begun, raised) = detached(py, || Stepper::begin(model, start));
        match (raised, begun) {
            (Some(raised), _) => Err(raised.into()),
            (None, Err(error)) => Err(refusal(py, model, Some(&choice), &error, At::default())),
            (None, Ok(stepper)) => Ok(Self { stepper, choice, learnt: Learnt::nothing(model.measures()) }),
        }
    }

    /// Takes a step without the interpreter.
    fn step(
        &mut self,
        py: Python<'_>,
        step: impl FnOnce(&mut AnyFilter<'_>) -> core::result::Result<(), StepError> + Send,
    ) -> Result<()> {
        let stepper = &mut self.stepper;
        let (done, raised) = detached(py, || stepper.with_dependent_mut(|_, filter| step(filter)));
        match (raised, done) {
            (None, Ok(())) => Ok(()),
            (Some(raised), done) => Err(noted(py, raised, None, done.err().as_ref()).into()),
            (None, Err(error)) => {
                let at = At { row: None, mean: self.filter().mean() };
                Err(refusal(py, self.model(), Some(&self.choice), &error, at))
            }
        }
    }
}

/// A filter that nobody steps meanwhile.
fn free<'py>(filter: &Bound<'py, Filter>) -> Result<PyRef<'py, Filter>> {
    Ok(filter.try_borrow().map_err(|_| at_work())?)
}

/// The same, to step it.
fn free_mut<'py>(filter: &Bound<'py, Filter>) -> Result<PyRefMut<'py, Filter>> {
    Ok(filter.try_borrow_mut().map_err(|_| at_work())?)
}

fn at_work() -> Input {
    Input::plain(
        "the filter is at work: another thread, or a function of its own model, cannot use it meanwhile",
    )
    .help("give each thread a filter of its own: f.copy()")
}

#[pymethods]
impl Filter {
    /// Starts from a belief at `t0`.
    #[staticmethod]
    #[pyo3(signature = (model, choice, mean, cov, t0))]
    fn start(
        py: Python<'_>,
        model: &Model,
        choice: &Choice,
        mean: Numbers<'_>,
        cov: Numbers<'_>,
        t0: f64,
    ) -> Result<Self> {
        let choice = choice.0;
        model.serves(&choice)?;
        finite("t0", t0)?;
        let prior = belief(model, &mean, &cov)?;
        Self::begin(py, model, choice, |model| match &model.moves {
            Moves::Discrete(moves) => choice.start(moves, &model.sensing, t0, &prior),
            Moves::Continuous(moves) => choice.start_continuous(moves, &model.sensing, t0, &prior),
        })
    }

    /// Starts where another one was when its snapshot was taken.
    #[staticmethod]
    fn resume(py: Python<'_>, model: &Model, choice: &Choice, snapshot: &Bound<'_, PyDict>) -> Result<Self> {
        let choice = choice.0;
        model.serves(&choice)?;
        let (from, learnt) = snapshot::read(model, snapshot)?;
        let filter = Self::begin(py, model, choice, |model| match &model.moves {
            Moves::Discrete(moves) => choice.resume(moves, &model.sensing, &from),
            Moves::Continuous(moves) => choice.resume_continuous(moves, &model.sensing, &from),
        })?;
        Ok(Self { learnt, ..filter })
    }

    /// Moves the belief to time `t`.
    fn predict(slf: &Bound<'_, Self>, t: f64) -> Result<()> {
        finite("t", t)?;
        free_mut(slf)?.step(slf.py(), |filter| filter.predict(t))
    }

    /// Teaches the belief a measurement of all sensors, length d; NaN where a component is missing.
    fn update(slf: &Bound<'_, Self>, z: Numbers<'_>) -> Result<()> {
        let mut own = free_mut(slf)?;
        let z = shaped("z", &z, &[own.model().measures()])?;
        if let Some(i) = z.iter().position(|z| z.is_infinite()) {
            let name = own.model().known.measures.get(i);
            let message = format!("measure `{}` is infinite", name.map_or("", String::as_str));
            return Err(Input::new("z", message).of(name).help("a missing component is NaN").into());
        }
        own.learnt = Learnt::nothing(z.len());
        own.step(slf.py(), |filter| filter.update(&z))?;
        own.learnt = Learnt::of(own.filter());
        Ok(())
    }

    /// Sets the controls, which hold until they are set again.
    fn set_controls(slf: &Bound<'_, Self>, u: Numbers<'_>) -> Result<()> {
        let mut own = free_mut(slf)?;
        let u = shaped("u", &u, &[own.model().controls()])?;
        if let Some(i) = u.iter().position(|u| !u.is_finite()) {
            return Err(Input::new("u", format!("`u[{i}]` is {}, not a finite number", u[i])).into());
        }
        own.step(slf.py(), |filter| filter.set_controls(&u))
    }

    #[getter]
    fn time(slf: &Bound<'_, Self>) -> Result<f64> {
        Ok(free(slf)?.filter().time())
    }

    #[getter]
    fn mean<'py>(slf: &Bound<'py, Self>) -> Result<Array<'py>> {
        let own = free(slf)?;
        Ok(frozen(slf.py(), own.filter().mean().to_vec(), &[own.filter().states()])?)
    }

    #[getter]
    fn factor<'py>(slf: &Bound<'py, Self>) -> Result<Array<'py>> {
        let own = free(slf)?;
        let n = own.filter().states();
        Ok(frozen(slf.py(), own.filter().factor().to_vec(), &[n, n])?)
    }

    #[getter]
    fn cov<'py>(slf: &Bound<'py, Self>) -> Result<Array<'py>> {
        let own = free(slf)?;
        let n = own.filter().states();
        Ok(frozen(slf.py(), own.filter().cov(), &[n, n])?)
    }

    #[getter]
    fn innovation<'py>(slf: &Bound<'py, Self>) -> Result<Array<'py>> {
        let own = free(slf)?;
        Ok(frozen(slf.py(), own.learnt.innovation.clone(), &[own.filter().measures()])?)
    }

    #[getter]
    fn innovation_cov<'py>(slf: &Bound<'py, Self>) -> Result<Array<'py>> {
        let own = free(slf)?;
        let d = own.filter().measures();
        Ok(frozen(slf.py(), own.learnt.innovation_cov.clone(), &[d, d])?)
    }

    #[getter]
    fn nis(slf: &Bound<'_, Self>) -> Result<f64> {
        Ok(free(slf)?.learnt.nis)
    }

    #[getter]
    fn nis_dof(slf: &Bound<'_, Self>) -> Result<usize> {
        Ok(free(slf)?.learnt.nis_dof)
    }

    #[getter]
    fn log_likelihood(slf: &Bound<'_, Self>) -> Result<f64> {
        Ok(free(slf)?.learnt.log_likelihood)
    }

    #[getter]
    fn gated(slf: &Bound<'_, Self>) -> Result<bool> {
        Ok(free(slf)?.learnt.gated)
    }

    /// All that it carries, as plain data.
    fn snapshot<'py>(slf: &Bound<'py, Self>) -> Result<Bound<'py, PyDict>> {
        let own = free(slf)?;
        Ok(snapshot::write(slf.py(), own.filter(), &own.learnt)?)
    }
}
