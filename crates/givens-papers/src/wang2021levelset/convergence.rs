//! Linear models with exact moments, and how fast a time update comes near them.

use crate::drawing::{axis, steps};
use crate::estimate::bounded;
use crate::{Claim, Expected, Trouble};
use givens::filter::predict::{ItoTaylor, TimeUpdate, Variant};
use givens::filter::{Gaussian, Lskf, Method, SquareRoot};
use givens::model::{At, Sde, Varies};
use givens::ode::{Solver, Steps};
use givens::rule::Cubature3;
use givens::scalar::Real;
use givens_io::figure::{Colour, Mark, Panel, Scale, Shape};

/// dx = J x dt + G dβ, n states and n noises.
pub(super) struct Linear {
    /// J, n × n.
    pub drift: Vec<f64>,
    /// G, n × n.
    pub noise: Vec<f64>,
    /// n.
    pub states: usize,
}

impl Sde for Linear {
    fn states(&self) -> usize {
        self.states
    }
    fn noises(&self) -> usize {
        self.states
    }
    #[inline(always)]
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        for (dx, row) in dx.iter_mut().zip(self.drift.chunks_exact(self.states)) {
            *dx = row.iter().zip(x).fold(T::zero(), |sum, (&j, &x)| T::of(j).mul_add(x, sum));
        }
    }
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        g.iter_mut().zip(&self.noise).for_each(|(g, &x)| *g = T::of(x));
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

/// A mean, length n, and a covariance, n × n.
pub(super) type Moments = (Vec<f64>, Vec<f64>);

impl Linear {
    /// The moments at `t` by their Taylor series, which ends or converges fast for the models of the paper.
    pub fn exact(&self, prior: &Gaussian, t: f64) -> Moments {
        const TERMS: usize = 40;
        let n = self.states;
        let product = |a: &[f64], b: &[f64], i: usize, j: usize| -> f64 {
            (0..n).map(|k| a[i * n + k] * b[k * n + j]).sum()
        };
        let (mut mean, mut cov) = (prior.mean().to_vec(), prior.cov().to_vec());
        let (mut of_mean, mut of_cov) = (mean.clone(), cov.clone());
        for term in 1..=TERMS {
            let share = t / term as f64;
            of_mean = (0..n)
                .map(|i| share * (0..n).map(|k| self.drift[i * n + k] * of_mean[k]).sum::<f64>())
                .collect();
            of_cov = (0..n * n)
                .map(|at| {
                    let (i, j) = (at / n, at % n);
                    let noise = (0..n).map(|k| self.noise[i * n + k] * self.noise[j * n + k]).sum::<f64>();
                    let own = if term == 1 { noise } else { 0.0 };
                    share * (product(&self.drift, &of_cov, i, j) + product(&self.drift, &of_cov, j, i) + own)
                })
                .collect();
            mean.iter_mut().zip(&of_mean).for_each(|(sum, x)| *sum += x);
            cov.iter_mut().zip(&of_cov).for_each(|(sum, x)| *sum += x);
        }
        (mean, cov)
    }
}

/// A time update whose steps are counted.
#[derive(Clone, Copy)]
pub(super) enum Stepping {
    /// The Itô–Taylor step of order 1.5.
    ItoTaylor(Variant),
    /// The level set, by a solver of fixed steps.
    LevelSet(Solver),
}

impl Stepping {
    /// The moments that it predicts for `t`, in `steps` steps.
    pub fn predicted(
        self,
        model: &Linear,
        prior: &Gaussian,
        t: f64,
        steps: usize,
    ) -> Result<Moments, Trouble> {
        match self {
            Self::ItoTaylor(variant) => {
                predicted(&Taylor(ItoTaylor { variant, steps: Steps::Count(steps) }), model, prior, t)
            }
            Self::LevelSet(solver) => {
                predicted(&Lskf { solver, substeps: steps, ..Lskf::default() }, model, prior, t)
            }
        }
    }
}

/// The cubature filter with an Itô–Taylor step of any variant.
#[derive(Clone, Copy)]
struct Taylor(ItoTaylor);

impl Method for Taylor {
    type Rule = Cubature3;
    type Form = SquareRoot;
    type Time = ItoTaylor;
    fn rule(&self) -> Cubature3 {
        Cubature3
    }
    fn time_update(&self) -> ItoTaylor {
        self.0
    }
}

/// The moments that a method predicts for `t` from a belief at 0.
pub(super) fn predicted<M, X: Method<Time: TimeUpdate<M>>>(
    method: &X,
    model: &M,
    prior: &Gaussian,
    t: f64,
) -> Result<Moments, Trouble> {
    let mut filter = method.start(model, 0.0, prior)?;
    filter.predict(t)?;
    Ok((filter.mean().to_vec(), filter.cov()))
}

/// √Σ (a − b)²: of vectors the length, of matrices Frobenius' norm of the difference.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The order of convergence that the two finest `[steps, error]` show of which neither is rounding, below `floor`.
pub(super) fn order(points: &[[f64; 2]], floor: f64) -> Option<f64> {
    let slope = |pair: &[[f64; 2]]| (pair[0][1] / pair[1][1]).ln() / (pair[1][0] / pair[0][0]).ln();
    points.windows(2).filter(|pair| pair.iter().all(|point| point[1] > floor)).map(slope).next_back()
}

/// A published order against the one found; they agree within 0.1.
pub(super) fn claim(what: String, expected: &Expected, name: &str, found: Option<f64>) -> Claim {
    let published = expected.number(&["order", name]).unwrap_or(f64::NAN);
    let found = found.unwrap_or(f64::NAN);
    let verdict = bounded((found - published).abs(), 0.1);
    Claim { published: format!("{published}"), ..Claim::statement(what, format!("{found:.3}"), verdict) }
}

/// Errors against steps, both on logarithmic axes.
pub(super) fn panel(label: &str, heading: &str, lines: &[(&str, Colour, Vec<[f64; 2]>)]) -> Panel {
    // ever narrower, as some of them lie upon each other
    let marks = lines.iter().zip([5.0, 3.6, 2.2, 1.6]).flat_map(|((name, colour, points), width)| {
        let dots = Shape::Dots { points: points.clone(), radius: 0.5 * width + 1.2, hollow: false };
        let line = Shape::Line { points: points.clone(), width, dashed: false };
        [Mark::new(name, *colour, line), Mark::new("", *colour, dots)]
    });
    let counts = lines.first().map_or(&[][..], |(.., points)| points);
    let counts: Vec<usize> = counts.iter().map(|point| point[0] as usize).collect();
    Panel {
        heading: heading.to_owned(),
        x: steps("steps", &counts),
        y: axis(label, Scale::Log),
        marks: marks.collect(),
        ..Panel::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_moments_are_those_of_a_brownian_ramp() {
        // x₁' = x₂, dx₂ = dβ: var x₁ = t³/3, cov = t²/2, var x₂ = t
        let model = Linear { drift: vec![0.0, 1.0, 0.0, 0.0], noise: vec![0.0, 0.0, 0.0, 1.0], states: 2 };
        let prior = Gaussian::from_std(&[1.0, 2.0], &[0.0, 0.0]).unwrap();
        let (mean, cov) = model.exact(&prior, 3.0);
        assert!(distance(&mean, &[7.0, 2.0]) < 1e-14);
        assert!(distance(&cov, &[9.0, 4.5, 4.5, 3.0]) < 1e-13);
    }

    #[test]
    fn rounding_has_no_order() {
        let points = [[1.0, 1e-3], [2.0, 1e-3 / 16.0], [4.0, 1e-16]];
        assert!((order(&points, 1e-15).unwrap() - 4.0).abs() < 1e-12);
        assert!(order(&points[1..], 1e-15).is_none());
    }
}
