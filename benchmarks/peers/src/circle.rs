//! W5: Lorenz-96, one step of the classic Runge–Kutta method; every other component.

use crate::model::Model;

#[derive(Clone, Copy)]
pub struct Circle {
    mean: &'static [f64],
}

impl Circle {
    /// About this prior mean, which lives as long as the program.
    pub fn new(mean: Vec<f64>) -> Self {
        Self { mean: mean.leak() }
    }
}

const H: f64 = 0.05;
/// More states than any workload has.
const MOST: usize = 256;

#[inline]
fn drift(x: &[f64], out: &mut [f64]) {
    let n = x.len();
    out[0] = (x[1] - x[n - 2]) * x[n - 1] - x[0] + 8.0;
    out[1] = (x[2] - x[n - 1]) * x[0] - x[1] + 8.0;
    out[n - 1] = (x[0] - x[n - 3]) * x[n - 2] - x[n - 1] + 8.0;
    for (out, x) in out[2..n - 1].iter_mut().zip(x.windows(4)) {
        *out = (x[3] - x[0]) * x[1] - x[2] + 8.0;
    }
}

impl Model for Circle {
    fn states(&self) -> usize {
        self.mean.len()
    }

    fn measures(&self) -> usize {
        self.mean.len() / 2
    }

    #[inline]
    fn transition(&self, x: &[f64], out: &mut [f64]) {
        let n = x.len();
        let (mut k, mut at) = ([0.0; MOST], [0.0; MOST]);
        let (k, at) = (&mut k[..n], &mut at[..n]);
        out.copy_from_slice(x);
        at.copy_from_slice(x);
        for (weight, ahead) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
            drift(at, k);
            for i in 0..n {
                out[i] += weight * H / 6.0 * k[i];
                at[i] = x[i] + ahead * H * k[i];
            }
        }
    }

    #[inline]
    fn observe(&self, x: &[f64], out: &mut [f64]) {
        out.iter_mut().zip(x.iter().step_by(2)).for_each(|(out, &x)| *out = x);
    }

    fn process(&self) -> Vec<f64> {
        let n = self.mean.len();
        (0..n * n).map(|k| if k % (n + 1) == 0 { 0.05 } else { 0.0 }).collect()
    }

    fn measurement(&self) -> Vec<f64> {
        vec![1.0; self.mean.len() / 2]
    }

    fn mean(&self) -> Vec<f64> {
        self.mean.to_vec()
    }

    fn variances(&self) -> Vec<f64> {
        vec![1.0; self.mean.len()]
    }
}
