//! The coordinated turn seen by a radar, which three of the papers track: the truth, its measurements, and one run of a
//! method after it.

use crate::Trouble;
use givens::filter::{Gaussian, StepError};
use givens::model::zoo::{Radar3d, Turn3d};
use givens::model::{At, Noise, Observation};
use givens::ode::Steps;
use givens::registry::{Choice, Setting, resolve};
use givens::scalar::Real;
use givens::simulate::{Paths, Scheme, Stream, simulate_continuous};
use givens::{Data, Goal, Outcome};

/// Steps of the truth in an interval between measurements.
const STEPS_OF_TRUTH: usize = 1000;

/// The zoo's radar, standing anywhere.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Radar {
    /// Position, m.
    pub at: [f64; 3],
    /// Range and angles, with their noise.
    pub own: Radar3d,
}

impl Observation for Radar {
    fn states(&self) -> usize {
        7
    }
    fn measures(&self) -> usize {
        3
    }
    fn angle(&self, i: usize) -> Option<f64> {
        self.own.angle(i)
    }
    #[inline(always)]
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], z: &mut [T]) {
        let [a, b, c] = self.at.map(T::of);
        let zero = T::zero();
        self.own.observe(at, &[x[0] - a, zero, x[2] - b, zero, x[4] - c, zero, zero], z);
    }
    fn noise(&self) -> Noise {
        self.own.noise()
    }
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        self.own.measurement_noise(at, out);
    }
}

/// One setting of the experiment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene {
    /// The aircraft; its σ₂ is a parameter of the experiments.
    pub turn: Turn3d,
    /// The radar.
    pub radar: Radar,
    /// True turn rate at the beginning, degrees per second.
    pub omega: f64,
    /// Between measurements, s.
    pub interval: f64,
    /// Number of intervals.
    pub scans: usize,
}

/// A true path and what the radar saw of it.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    /// True state at each measurement.
    pub truth: Vec<[f64; 7]>,
    /// Measurements.
    pub z: Vec<[f64; 3]>,
}

impl Scene {
    /// The true state at the beginning, the same in all runs.
    pub fn begin(&self) -> [f64; 7] {
        [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, self.omega.to_radians()]
    }

    /// Draws a path and its measurements at the intervals `from`, …, `scans`; the stream is then that for anything else
    /// of the run.
    pub fn draw(&self, from: usize, stream: &mut Stream) -> Result<Drawn, Trouble> {
        let mut times = Data::new(3).starting_at(0.0);
        (from..=self.scans).try_for_each(|k| times.push(self.interval * k as f64, &[0.0; 3]))?;
        let begin = Gaussian::from_std(&self.begin(), &[0.0; 7])?;
        let paths = Paths { scheme: Scheme::ItoTaylor, steps: Steps::Count(STEPS_OF_TRUTH) };
        let drawn = simulate_continuous(&self.turn, &self.radar, times.rows(), 0.0, &begin, &paths, stream)?;
        let truth = drawn.states.as_chunks::<7>().0.to_vec();
        Ok(Drawn { truth, z: drawn.z.as_chunks::<3>().0.to_vec() })
    }

    /// Runs a method from `prior`, which holds at the interval `from`, over the measurements after it (the first of them
    /// at `from` + 1); `drawn` begins at `first`.
    pub fn track(
        &self,
        choice: &Choice,
        prior: &Gaussian,
        from: usize,
        first: usize,
        drawn: &Drawn,
        diverged: Diverged,
    ) -> Result<Track, Trouble> {
        let seen = from + 1 - first;
        let mut data = Data::new(3).starting_at(self.interval * from as f64);
        for (k, z) in drawn.z.iter().enumerate().skip(seen) {
            data.push(self.interval * (first + k) as f64, z)?;
        }
        let outcome = run(&self.turn, &self.radar, choice, prior, &data);
        let of = |(mean, truth): (&[f64], &[f64; 7])| core::array::from_fn(|i| mean[i] - truth[i]);
        let means = outcome.estimates.mean.chunks_exact(7);
        let errors = means.zip(drawn.truth.iter().skip(seen)).map(of).collect();
        Ok(Track::of(errors, outcome.failure.map(|(_, error)| Lost::Failed(error)), diverged))
    }
}

/// All methods of these experiments, compiled once.
#[inline(never)]
fn run(turn: &Turn3d, radar: &Radar, choice: &Choice, prior: &Gaussian, data: &Data) -> Outcome {
    choice.run_continuous(turn, radar, data.rows(), data.start(), prior, Goal::Filter, &[])
}

/// Whether the errors of a run say that it has lost the target.
pub(crate) type Diverged = fn(&[[f64; 7]]) -> bool;

/// Length of the error in position, m.
pub(crate) fn position(error: &[f64; 7]) -> f64 {
    error[0].hypot(error[2]).hypot(error[4])
}

/// What one run of a method comes to.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    /// Estimate less truth, at each scan that was finished.
    pub errors: Vec<[f64; 7]>,
    /// Why it is lost, if it is.
    pub lost: Option<Lost>,
}

/// Why a run is lost.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lost {
    /// The filter stopped.
    Failed(StepError),
    /// Its numbers left all bounds.
    Overflow,
    /// Its errors did.
    Diverged,
}

impl Track {
    /// A run with these errors.
    pub fn of(errors: Vec<[f64; 7]>, failure: Option<Lost>, diverged: Diverged) -> Self {
        let lost = failure.or_else(|| diverged(&errors).then_some(Lost::Diverged));
        Self { errors, lost }
    }
}

impl crate::Failures {
    /// Counts a run that is lost.
    pub(crate) fn note_lost(&mut self, lost: &Lost) {
        match lost {
            Lost::Failed(error) => self.note(error),
            Lost::Overflow => self.note_kind("beyond all bounds"),
            Lost::Diverged => self.note_kind("diverged"),
        }
    }
}

/// A method by its registry name, with settings: numbers and words as one would type them.
pub(crate) fn method(name: &str, settings: &[(&str, &str)]) -> Result<Choice, Trouble> {
    let setting = |&(key, value): &(&str, &str)| Setting { key: key.to_owned(), value: value.into() };
    Ok(resolve(name, &settings.iter().map(setting).collect::<Vec<_>>())?)
}

/// An initial belief drawn about the truth: N(x₀ + S w, S²), S = diag(`std`).
pub(crate) fn about(truth: &[f64; 7], std: &[f64; 7], stream: &mut Stream) -> Result<Gaussian, Trouble> {
    let mean: [f64; 7] = core::array::from_fn(|i| truth[i] + std[i] * stream.normal());
    Ok(Gaussian::from_std(&mean, std)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let turn = Turn3d { rate: 7e-4, ..Turn3d::default() };
        Scene { turn, radar: Radar::default(), omega: 6.0, interval: 4.0, scans: 3 }
    }

    #[test]
    fn the_radar_sees_from_where_it_stands() {
        let radar = Radar { at: [1000.0, 2650.0, 100.0], own: Radar3d::default() };
        let mut z = [0.0; 3];
        let x = [1000.0, 9.0, 2750.0, 9.0, 200.0, 9.0, 9.0];
        radar.observe(&At { t: 0.0, dt: 0.0, u: &[], p: &[] }, &x, &mut z);
        let quarter = core::f64::consts::FRAC_PI_4;
        assert!((z[0] - 2e4f64.sqrt()).abs() < 1e-9);
        assert!((z[1] - 2.0 * quarter).abs() < 1e-12 && (z[2] - quarter).abs() < 1e-12);
    }

    #[test]
    fn without_noise_the_path_is_a_circle() {
        let turn = Turn3d { velocity: 0.0, rate: 0.0 };
        let drawn = Scene { turn, ..scene() }.draw(0, &mut Stream::new(1, 0, 0)).unwrap();
        // 72° of a circle of radius 150/ω
        let (radius, angle) = (150.0 / 6f64.to_radians(), 72f64.to_radians());
        let [x, _, y, ..] = drawn.truth[3];
        assert!((x - (1000.0 - radius * (1.0 - angle.cos()))).abs() < 1e-3, "{x}");
        assert!((y - (2650.0 + radius * angle.sin())).abs() < 1e-3, "{y}");
    }

    #[test]
    fn a_method_follows_from_a_drawn_start() {
        let (scene, mut stream) = (scene(), Stream::new(2, 0, 0));
        let drawn = scene.draw(1, &mut stream).unwrap();
        let prior = about(&scene.begin(), &[100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 0.02], &mut stream);
        let choice = method("sr-cd-ckf", &[("substeps", "4")]).unwrap();
        let track = scene.track(&choice, &prior.unwrap(), 0, 1, &drawn, |_| false).unwrap();
        assert_eq!(track.errors.len(), 3);
        assert!(track.lost.is_none() && position(&track.errors[2]) < 150.0, "{:?}", track.errors);
        let lost = scene.track(
            &choice,
            &Gaussian::from_std(&[1e4; 7], &[1.0; 7]).unwrap(),
            0,
            1,
            &drawn,
            |errors| errors.iter().any(|error| position(error) > 1000.0),
        );
        assert!(matches!(lost.unwrap().lost, Some(Lost::Diverged)));
    }
}
