//! The innovation: what the measurement said beyond the prediction, and how likely it was.

use crate::filter::error::Fault;
use crate::filter::quantity::Quantity;
use crate::kernels::{dot, solve_lower};
use crate::scalar::{Mask, Real};

/// ν = z − ẑ of the components that were there, its covariance, and what they say of the filter.
#[derive(Clone, Copy, Debug)]
pub struct Innovation<'a, T> {
    /// ẑ of the d components that were there, in order; angles wrapped into one period.
    pub predicted: &'a [T],
    /// ν = z − ẑ, length d; angles wrapped.
    pub nu: &'a [T],
    /// A lower-triangular root of P_zz, d × d.
    pub factor: &'a [T],
    /// ν in the coordinates of that root: independent and of unit variance if the filter is right.
    pub white: &'a [T],
    /// νᵀ P_zz⁻¹ ν; zero without any component.
    pub nis: T,
    /// −½ (νᵀ P_zz⁻¹ ν + ln |P_zz| + d ln 2π); zero of a measurement beyond the gate, which was not taken in.
    pub log_likelihood: T,
}

impl<T: Real> Innovation<'_, T> {
    /// Element (i, j) of P_zz.
    #[inline(always)]
    pub fn cov(&self, i: usize, j: usize) -> T {
        let d = self.nu.len();
        let row = |i: usize| &self.factor[i * d..(i + 1) * d];
        let least = i.min(j);
        dot(&row(i)[..=least], &row(j)[..=least])
    }
}

/// The memory in which an update writes its innovation.
#[derive(Debug)]
pub(crate) struct InnovationMut<'a, T> {
    pub predicted: &'a mut [T],
    pub nu: &'a mut [T],
    pub factor: &'a mut [T],
    pub white: &'a mut [T],
    pub nis: &'a mut T,
    pub log_likelihood: &'a mut T,
}

impl<T: Real> InnovationMut<'_, T> {
    /// e = S_zz⁻¹ ν, whose square is NIS; `root` is S_zz in rows of length `stride`. A NIS that is not finite is the
    /// fault of the component with which it ceases to be.
    #[inline(always)]
    pub fn whiten(&mut self, root: &[T], stride: usize, d: usize) -> Result<(), Fault> {
        let white = &mut self.white[..d];
        white.copy_from_slice(&self.nu[..d]);
        solve_lower(root, stride, white);
        let mut nis = T::zero();
        for (component, &e) in white.iter().enumerate() {
            nis = e.mul_add(e, nis);
            if (!nis.finite()).all() {
                return Err(Fault::NotFinite { quantity: Quantity::Innovation, component });
            }
        }
        Ok(())
    }

    /// NIS and log-likelihood from the root and the whitened innovation of `d` components, `dof` of them in each lane.
    #[inline(always)]
    pub fn score(&mut self, d: usize, dof: T) {
        let (mut nis, mut half_ln_det) = (T::zero(), T::zero());
        for i in 0..d {
            nis = self.white[i].mul_add(self.white[i], nis);
            half_ln_det += self.factor[i * d + i].ln();
        }
        let constant = T::of(0.5 * Real::ln(core::f64::consts::TAU)) * dof;
        *self.nis = nis;
        *self.log_likelihood = -T::of(0.5) * nis - half_ln_det - constant;
    }
}
