//! The classical continuous-discrete extended Kalman filter by four-stage Runge–Kutta steps, without any test of its
//! covariance: the paper's counts were made so. `cd-ekf` of the registry stops at a covariance that is not definite.

use crate::Trouble;
use crate::radar::{Diverged, Drawn, Lost, Scene, Track};
use givens::filter::Gaussian;
use givens::kernels::{lu, lu_order, lu_solve};
use givens::model::{At, Linear, Observation, Sde};
use givens::scalar::Real;

const N: usize = 7;
const D: usize = 3;
const AT: At<'static, f64> = At { t: 0.0, dt: 0.0, u: &[], p: &[] };
/// A mean beyond this is no estimate any more.
const BEYOND: f64 = 1e12;

/// Mean, and covariance row by row.
#[derive(Clone, Copy)]
struct Moments {
    mean: [f64; N],
    cov: [f64; N * N],
}

impl Moments {
    fn moved(&self, by: f64, slope: &Self) -> Self {
        let mut to = *self;
        to.mean.iter_mut().zip(&slope.mean).for_each(|(x, &d)| *x += by * d);
        to.cov.iter_mut().zip(&slope.cov).for_each(|(x, &d)| *x += by * d);
        to
    }
}

/// One run from a prior at time zero over measurements at the intervals 1, 2, …, with so many steps in each.
pub(super) fn track(
    scene: &Scene,
    steps: usize,
    prior: &Gaussian,
    drawn: &Drawn,
    diverged: Diverged,
) -> Result<Track, Trouble> {
    let mut belief = Moments { mean: prior.mean().try_into()?, cov: prior.cov().try_into()? };
    let mut filter = Filter::new(scene);
    let mut errors = Vec::with_capacity(drawn.z.len());
    for (z, truth) in drawn.z.iter().zip(&drawn.truth) {
        let h = scene.interval / steps as f64;
        for _ in 0..steps {
            belief = filter.step(&belief, h);
        }
        filter.update(&mut belief, z);
        // written so that a number that is none fails too
        if !belief.mean.iter().all(|x| x.abs() <= BEYOND) {
            return Ok(Track::of(errors, Some(Lost::Overflow), diverged));
        }
        errors.push(core::array::from_fn(|i| belief.mean[i] - truth[i]));
    }
    Ok(Track::of(errors, None, diverged))
}

struct Filter<'a> {
    scene: &'a Scene,
    /// G Gᵀ.
    noise: [f64; N * N],
    /// R.
    measurement_noise: [f64; D * D],
    scratch: Vec<f64>,
}

impl<'a> Filter<'a> {
    fn new(scene: &'a Scene) -> Self {
        let (mut g, mut s_r) = ([0.0; N * 4], [0.0; D * D]);
        scene.turn.diffusion(&AT, &[0.0; N], &mut g);
        scene.radar.measurement_noise(&AT, &mut s_r);
        let scratch = scene.turn.drift_scratch(1).max(scene.radar.observe_scratch(1));
        Self {
            scene,
            noise: core::array::from_fn(|k| (0..4).map(|j| g[k / N * 4 + j] * g[k % N * 4 + j]).sum()),
            measurement_noise: core::array::from_fn(|k| {
                (0..D).map(|j| s_r[k / D * D + j] * s_r[k % D * D + j]).sum()
            }),
            scratch: vec![0.0; scratch],
        }
    }

    /// m' = f(m), P' = J P + P Jᵀ + G Gᵀ.
    fn slope(&mut self, at: &Moments) -> Moments {
        let (mut mean, mut moved) = ([0.0; N], [0.0; N * N]);
        let out = Linear { value: &mut mean, image: &mut moved, stride: N };
        self.scene.turn.drift_linear(&AT, &at.mean, &at.cov, out, &mut self.scratch);
        let cov = core::array::from_fn(|k| moved[k] + moved[k % N * N + k / N] + self.noise[k]);
        Moments { mean, cov }
    }

    fn step(&mut self, from: &Moments, h: f64) -> Moments {
        let one = self.slope(from);
        let two = self.slope(&from.moved(0.5 * h, &one));
        let three = self.slope(&from.moved(0.5 * h, &two));
        let four = self.slope(&from.moved(h, &three));
        let third = h / 3.0;
        from.moved(0.5 * third, &one).moved(third, &two).moved(third, &three).moved(0.5 * third, &four)
    }

    fn update(&mut self, belief: &mut Moments, z: &[f64; D]) {
        let radar = &self.scene.radar;
        let (mut predicted, mut h, mut hp) = ([0.0; D], [0.0; D * N], [0.0; D * N]);
        let unit: [f64; N * N] = core::array::from_fn(|k| if k % (N + 1) == 0 { 1.0 } else { 0.0 });
        for (root, image) in [(&unit, &mut h), (&belief.cov, &mut hp)] {
            let out = Linear { value: &mut predicted, image, stride: N };
            radar.observe_linear(&AT, &belief.mean, root, out, &mut self.scratch);
        }
        let of = |i: usize, j: usize| (0..N).map(|k| hp[i * N + k] * h[j * N + k]).sum::<f64>();
        let mut innovation: [f64; D * D] =
            core::array::from_fn(|k| of(k / D, k % D) + self.measurement_noise[k]);
        let mut nu: [f64; D] = core::array::from_fn(|i| {
            let nu = z[i] - predicted[i];
            radar.angle(i).map_or(nu, |period| nu.wrap(period))
        });
        let mut order = [0.0; lu_order(D)];
        // a singular one leaves no finite number behind, and the run is counted as lost
        let _ = lu(&mut innovation, D, &mut order);
        lu_solve(&innovation, D, &order, &mut nu);
        for i in 0..N {
            belief.mean[i] += (0..D).map(|j| hp[j * N + i] * nu[j]).sum::<f64>();
        }
        for i in 0..N {
            let mut row: [f64; D] = core::array::from_fn(|j| hp[j * N + i]);
            lu_solve(&innovation, D, &order, &mut row);
            for k in 0..N {
                belief.cov[i * N + k] -= (0..D).map(|j| row[j] * hp[j * N + k]).sum::<f64>();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::radar::{about, method, position};
    use crate::sarkka2012continuous::runs;
    use givens::simulate::Stream;

    #[test]
    fn where_the_covariance_stays_definite_it_is_the_registrys() {
        let (scene, mut stream) = (Scene { scans: 8, ..runs::scene(4.0) }, Stream::new(3, 0, 0));
        let drawn = scene.draw(1, &mut stream).unwrap();
        let prior = about(&scene.begin(), &[10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 1e-3], &mut stream).unwrap();
        let choice = method("cd-ekf", &[("solver", "rk4"), ("substeps", "16")]).unwrap();
        let theirs = scene.track(&choice, &prior, 0, 1, &drawn, |_| false).unwrap();
        let ours = track(&scene, 16, &prior, &drawn, |_| false).unwrap();
        assert!(theirs.lost.is_none() && ours.errors.len() == 8);
        for (a, b) in ours.errors.iter().zip(&theirs.errors) {
            assert!((position(a) - position(b)).abs() < 1e-6, "{a:?} {b:?}");
        }
    }
}
