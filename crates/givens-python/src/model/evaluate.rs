//! The functions of a model at one point: for checks.

use givens::model::{At, Observation, Sde, Transition};
use numpy::{PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::prelude::*;

use super::{Model, Moves};
use crate::errors::{Input, Refusal, Result};
use crate::numbers::{frozen, shaped};
use crate::watch::detached;

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

impl Model {
    /// The controls of one point.
    pub fn held(&self, u: Option<&Numbers<'_>>) -> Result<Vec<f64>> {
        match (u, self.controls()) {
            (None, 0) => Ok(Vec::new()),
            (Some(u), controls) => shaped("u", u, &[controls]),
            (None, controls) => {
                Err(Input::new("u", format!("the model has {controls} controls: give `u`")).into())
            }
        }
    }

    /// What `f` writes to an array of this shape.
    fn written<'py>(
        &self,
        py: Python<'py>,
        shape: &[usize],
        f: impl FnOnce(&[f64], &mut [f64]) + Send,
    ) -> Result<Bound<'py, PyArrayDyn<f64>>> {
        let mut out = vec![f64::NAN; shape.iter().product()];
        let ((), raised) = detached(py, || f(self.parameters(), &mut out));
        match raised {
            Some(error) => Err(error.into()),
            None => Ok(frozen(py, out, shape)?),
        }
    }
}

fn no(what: &'static str, kind: &str) -> Refusal {
    Input::plain(format!("a {kind} model has no {what}")).into()
}

#[pymethods]
impl Model {
    /// f(t, x, u), length n.
    #[pyo3(signature = (t, x, u=None))]
    fn drift<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        x: Numbers<'py>,
        u: Option<Numbers<'py>>,
    ) -> Result<Bound<'py, PyArrayDyn<f64>>> {
        let Moves::Continuous(model) = &self.moves else { return Err(no("drift", "discrete")) };
        let (n, u) = (self.states(), self.held(u.as_ref())?);
        let x = shaped("x", &x, &[n])?;
        self.written(py, &[n], |p, out| model.drift(&At { t, dt: 0.0, u: &u, p }, &x, out))
    }

    /// G(t, x, u), n × q; columns that are zero throughout are left out.
    #[pyo3(signature = (t, x, u=None))]
    fn diffusion<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        x: Numbers<'py>,
        u: Option<Numbers<'py>>,
    ) -> Result<Bound<'py, PyArrayDyn<f64>>> {
        let Moves::Continuous(model) = &self.moves else { return Err(no("diffusion", "discrete")) };
        let (n, u) = (self.states(), self.held(u.as_ref())?);
        let x = shaped("x", &x, &[n])?;
        let shape = [n, model.noises()];
        self.written(py, &shape, |p, out| model.diffusion(&At { t, dt: 0.0, u: &u, p }, &x, out))
    }

    /// f(t, dt, x, u), length n.
    #[pyo3(signature = (t, dt, x, u=None))]
    fn transition<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        dt: f64,
        x: Numbers<'py>,
        u: Option<Numbers<'py>>,
    ) -> Result<Bound<'py, PyArrayDyn<f64>>> {
        let Moves::Discrete(model) = &self.moves else { return Err(no("transition", "continuous")) };
        let (n, u) = (self.states(), self.held(u.as_ref())?);
        let x = shaped("x", &x, &[n])?;
        self.written(py, &[n], |p, out| model.transition(&At { t, dt, u: &u, p }, &x, out))
    }

    /// Q(t, dt, u), n × n.
    #[pyo3(signature = (t, dt, u=None))]
    fn noise_cov<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        dt: f64,
        u: Option<Numbers<'py>>,
    ) -> Result<Bound<'py, PyArrayDyn<f64>>> {
        let Moves::Discrete(model) = &self.moves else { return Err(no("noise_cov", "continuous")) };
        let (n, u) = (self.states(), self.held(u.as_ref())?);
        let columns = model.noise().columns(n);
        self.written(py, &[n, n], |p, out| {
            out.fill(0.0);
            // a model without noise writes none
            model.process_noise(&At { t, dt, u: &u, p }, &mut out[..n * columns]);
        })
    }

    /// h(t, x, u) of all sensors, length d.
    #[pyo3(signature = (t, x, u=None))]
    fn measure<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        x: Numbers<'py>,
        u: Option<Numbers<'py>>,
    ) -> Result<Bound<'py, PyArrayDyn<f64>>> {
        let u = self.held(u.as_ref())?;
        let x = shaped("x", &x, &[self.states()])?;
        let shape = [self.measures()];
        self.written(py, &shape, |p, out| self.sensing.observe(&At { t, dt: 0.0, u: &u, p }, &x, out))
    }

    /// The lower-triangular root of R(t, u) of all sensors, d × d.
    #[pyo3(signature = (t, u=None))]
    fn measurement_noise<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        u: Option<Numbers<'py>>,
    ) -> Result<Bound<'py, PyArrayDyn<f64>>> {
        let (d, u) = (self.measures(), self.held(u.as_ref())?);
        self.written(py, &[d, d], |p, out| {
            self.sensing.measurement_noise(&At { t, dt: 0.0, u: &u, p }, out);
        })
    }
}
