//! A rung as givens' traits see it.

use super::Rung;
use crate::models::row;
use givens::model::{At, Noise, Observation, Sde, Transition, Varies};
use givens::scalar::Real;
use nalgebra::DMatrix;

/// The motion of a rung, in steps or continuous. Where every row has a step of its own, the control says which.
pub struct Stage<'r>(pub &'r Rung);

impl Stage<'_> {
    fn step<T: Real>(&self, at: &At<T>) -> &(DMatrix<f64>, DMatrix<f64>) {
        let index = at.u.first().map_or(0, |u| u.first() as usize);
        &self.0.steps[index]
    }
}

fn write<T: Real>(matrix: &DMatrix<f64>, out: &mut [T]) {
    let columns = matrix.ncols();
    out.iter_mut().enumerate().for_each(|(at, out)| *out = T::of(matrix[(at / columns, at % columns)]));
}

fn image<T: Real>(matrix: &DMatrix<f64>, x: &[T], out: &mut [T]) {
    out.iter_mut().enumerate().for_each(|(i, out)| *out = row(matrix, i, x));
}

impl Transition for Stage<'_> {
    fn states(&self) -> usize {
        self.0.prior.0.len()
    }
    fn controls(&self) -> usize {
        usize::from(self.0.steps.len() > 1)
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        image(&self.step(at).0, x, out);
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        write(&self.step(at).1, out);
    }
    fn serves_packs(&self) -> bool {
        self.0.steps.len() == 1
    }
}

impl Sde for Stage<'_> {
    fn states(&self) -> usize {
        self.0.prior.0.len()
    }
    fn noises(&self) -> usize {
        self.0.flow.as_ref().map_or(0, |flow| flow.g.ncols())
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        self.0.flow.iter().for_each(|flow| image(&flow.a, x, dx));
    }
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        self.0.flow.iter().for_each(|flow| write(&flow.g, g));
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

/// The sensor of a rung; an angle is told as it is within half a period of zero.
pub struct Sight<'r>(pub &'r Rung);

impl Observation for Sight<'_> {
    fn states(&self) -> usize {
        self.0.h.ncols()
    }
    fn measures(&self) -> usize {
        self.0.h.nrows()
    }
    fn angle(&self, _: usize) -> Option<f64> {
        self.0.period
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        image(&self.0.h, x, out);
        if self.0.period.is_some() {
            out.iter_mut().for_each(|z| *z = z.sin().atan2(z.cos()));
        }
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        write(&self.0.r, out);
    }
}
