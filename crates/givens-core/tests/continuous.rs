//! Continuous models stepped by hand: what has an answer in closed form, and what is refused.
#![allow(clippy::unwrap_used, clippy::panic)]

use givens_core::filter::{
    CdCkf, CdCkf2, CdEkf, Fault, Gaussian, Lskf, Method, Over, SrCdCkf, SrCdCkf2, SrCdEkf, StepError,
};
use givens_core::model::{At, Sde, Varies};
use givens_core::ode::Solver;
use givens_core::scalar::Real;

/// dx = −x/2 dt + x/2 dβ, which says of its diffusion what it is told to.
struct Proportional(Varies);

impl Sde for Proportional {
    fn states(&self) -> usize {
        1
    }
    fn noises(&self) -> usize {
        1
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = T::of(-0.5) * x[0];
    }
    fn diffusion<T: Real>(&self, _: &At<T>, x: &[T], g: &mut [T]) {
        g[0] = T::of(0.5) * x[0];
    }
    fn diffusion_varies(&self) -> Varies {
        self.0
    }
}

/// A Brownian motion of strength a/b, of the two parameters.
struct Quotient;

impl Sde for Quotient {
    fn states(&self) -> usize {
        1
    }
    fn noises(&self) -> usize {
        1
    }
    fn drift<T: Real>(&self, _: &At<T>, _: &[T], dx: &mut [T]) {
        dx[0] = T::zero();
    }
    fn diffusion<T: Real>(&self, at: &At<T>, _: &[T], g: &mut [T]) {
        g[0] = at.p[0] / at.p[1];
    }
    fn parameters(&self) -> &[f64] {
        &[1.0, 1.0]
    }
}

#[test]
fn a_diffusion_that_overflows_is_told_as_that() {
    let mut f =
        SrCdCkf::default().start(&Quotient, 0.0, Gaussian::from_std(&[0.0], &[1.0]).unwrap()).unwrap();
    f.set_parameters(&[1e6, 5e-324]).unwrap();
    let mut f = SrCdCkf::default().resume(&Quotient, &f.snapshot()).unwrap();
    let fault = f.predict(1.0).unwrap_err().fault;
    assert!(matches!(fault, Fault::NotFinite { .. }), "{fault}");
}

/// dx = (1 − x) dt.
struct Relaxing;

impl Sde for Relaxing {
    fn states(&self) -> usize {
        1
    }
    fn noises(&self) -> usize {
        0
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = T::one() - x[0];
    }
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], _: &mut [T]) {}
}

fn moments<X: Over<Proportional>>(name: &str, method: X) {
    let model = Proportional(Varies::WithState);
    let mut f = method.start(&model, 0.0, Gaussian::from_std(&[1.0], &[0.5]).unwrap()).unwrap();
    f.predict(1.0).unwrap();
    // E[x²] decays with 3/4, the mean with 1/2
    let (mean, second) = ((-0.5_f64).exp(), 1.25 * (-0.75_f64).exp());
    let error = (f.mean()[0] - mean).abs().max((f.cov()[0] - (second - mean * mean)).abs());
    assert!(error < 1e-6, "{name}: {error:e}");
}

#[test]
fn a_diffusion_proportional_to_the_state_spreads_by_all_of_its_second_moment() {
    moments("cd-ekf", CdEkf::default());
    moments("sr-cd-ekf", SrCdEkf::default());
    moments("cd-ckf2", CdCkf2::default());
    moments("sr-cd-ckf2", SrCdCkf2::default());
}

fn refused<X: Over<Proportional>>(method: X, varies: Varies) -> Fault {
    let prior = Gaussian::from_std(&[1.0], &[0.5]).unwrap();
    method.start(&Proportional(varies), 0.0, prior).map(|_| ()).unwrap_err().fault
}

#[test]
fn a_diffusion_that_reads_the_state_must_say_so_and_go_to_who_can_serve_it() {
    for varies in [Varies::Never, Varies::WithTime] {
        assert!(matches!(refused(CdEkf::default(), varies), Fault::Mismatch { .. }));
        assert!(matches!(refused(SrCdCkf::default(), varies), Fault::Mismatch { .. }));
    }
    assert_eq!(refused(CdCkf::default(), Varies::WithState), Fault::StateDependentDiffusion);
    assert_eq!(refused(Lskf::default(), Varies::WithState), Fault::StateDependentDiffusion);
}

fn relaxes<X: Over<Relaxing>>(name: &str, method: X) {
    let mut f = method.start(&Relaxing, 0.0, Gaussian::from_std(&[0.5], &[0.1]).unwrap()).unwrap();
    for t in 1..=60 {
        let done: Result<(), StepError> = f.predict(f64::from(t));
        done.unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    assert!((f.mean()[0] - 1.0).abs() < 1e-9 && f.cov()[0].sqrt() < 1e-12, "{name}");
}

#[test]
fn a_state_that_comes_to_rest_without_noise_is_no_error() {
    relaxes("cd-ckf", CdCkf::default());
    relaxes("sr-cd-ckf", SrCdCkf::default());
    relaxes("cd-ckf2", CdCkf2::default());
    relaxes("cd-ekf", CdEkf::default());
}

#[test]
fn steps_too_short_for_a_gap_are_an_option_out_of_range() {
    let prior = Gaussian::from_std(&[0.5], &[0.1]).unwrap();
    let max_step = Some(1e-300);
    let option =
        |error: StepError| assert!(matches!(error.fault, Fault::Option(of) if of.option == "max_step"));
    let mut f = SrCdCkf { max_step, ..Default::default() }.start(&Relaxing, 0.0, &prior).unwrap();
    option(f.predict(1.0).unwrap_err());
    let rk4 = SrCdCkf2 { solver: Solver::Rk4, max_step, ..Default::default() };
    option(rk4.start(&Relaxing, 0.0, &prior).unwrap().predict(1.0).unwrap_err());
}
