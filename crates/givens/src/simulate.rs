//! Trajectories drawn from a model.

use crate::Row;
use crate::filter::{Fault, Gaussian, Matrix, Quantity, StepError};
use crate::kernels::Health;
use crate::model::{At, Observation, Transition};
use rand_chacha::ChaCha12Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// A stream of independent standard normal numbers, keyed by seed, track and run: the same for any partition of the
/// work, on one machine and instruction set.
#[derive(Clone, Debug)]
pub struct Stream(ChaCha12Rng);

impl Stream {
    /// The stream of one run of one track.
    ///
    /// ```
    /// use givens::simulate::Stream;
    /// let draw = |run| Stream::new(7, 0, run).normal();
    /// assert_eq!(draw(1), draw(1));
    /// assert_ne!(draw(1), draw(2));
    /// ```
    pub fn new(seed: u64, track: u32, run: u32) -> Self {
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        rng.set_stream(u64::from(track) << 32 | u64::from(run));
        Self(rng)
    }

    /// The next number.
    pub fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    /// Adds B w to `x`, w standard normal, B `x.len()` rows of `columns`.
    fn add_noise(&mut self, x: &mut [f64], root: &[f64], columns: usize, w: &mut [f64]) {
        w[..columns].fill_with(|| self.normal());
        for (x, row) in x.iter_mut().zip(root.chunks_exact(columns.max(1))) {
            *x += row.iter().zip(&*w).map(|(b, w)| b * w).sum::<f64>();
        }
    }
}

/// A drawn trajectory.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Simulation {
    /// The time of each row.
    pub time: Vec<f64>,
    /// The true states, rows × n.
    pub states: Vec<f64>,
    /// The measurements, rows × d; angles lie within half a period of zero.
    pub z: Vec<f64>,
}

/// Draws the initial state from `prior`, which holds at `t0`, and carries it through the rows: their times and controls
/// are used, and where a measurement is NaN the drawn one is too.
///
/// # Errors
/// A model that is not finite or whose noise is no covariance, a time that goes backwards, a gap that is not whole
/// steps.
pub fn simulate<'a, M: Transition, H: Observation>(
    model: &M,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>>,
    t0: f64,
    prior: &Gaussian,
    stream: &mut Stream,
) -> Result<Simulation, StepError> {
    let (n, d) = (model.states(), sensors.measures());
    let (q, r) = (model.noise().columns(n), sensors.noise().columns(d));
    let mut out = Simulation::default();
    let mut x = prior.mean().to_vec();
    let mut w = vec![0.0; n.max(q).max(r)];
    let (mut next, mut z) = (vec![0.0; n], vec![0.0; d]);
    let (mut s_q, mut s_r) = (vec![0.0; n * q], vec![0.0; d * r]);
    stream.add_noise(&mut x, prior.factor(), n, &mut w);
    let (mut t, mut held): (f64, Option<Vec<f64>>) = (t0, None);
    for (step, row) in rows.enumerate() {
        let fail = |fault| StepError { fault, time: row.time, step };
        let gap = row.time - t;
        if !(gap >= 0.0 && gap.is_finite()) {
            return Err(fail(Fault::Backwards { to: row.time }));
        }
        let (count, dt) = match model.period() {
            Some(period) => (gap / period, period),
            None => (if gap > 0.0 { 1.0 } else { 0.0 }, gap),
        };
        if (count - count.round()).abs() > 1e-6 {
            return Err(fail(Fault::NotWholeSteps { gap, period: dt }));
        }
        let u = held.get_or_insert_with(|| row.u.to_vec());
        for k in 0..count.round() as usize {
            let at = At { t: t + k as f64 * dt, dt, u, p: model.parameters() };
            model.transition(&at, &x, &mut next);
            healthy(model.noise_root(&at, &mut s_q), Matrix::ProcessNoise).map_err(fail)?;
            finite(&s_q, q.max(1), Quantity::ProcessNoise).map_err(fail)?;
            x.copy_from_slice(&next);
            stream.add_noise(&mut x, &s_q, q, &mut w);
            finite(&x, 1, Quantity::Transition).map_err(fail)?;
        }
        t = row.time;
        u.copy_from_slice(row.u);
        let at = At { t, dt: 0.0, u, p: model.parameters() };
        sensors.observe(&at, &x, &mut z);
        healthy(sensors.noise_root(&at, &mut s_r), Matrix::MeasurementNoise).map_err(fail)?;
        finite(&s_r, r.max(1), Quantity::MeasurementNoise).map_err(fail)?;
        stream.add_noise(&mut z, &s_r, r, &mut w);
        for (i, (z, asked)) in z.iter_mut().zip(row.z).enumerate() {
            if asked.is_nan() {
                *z = f64::NAN;
            } else if !z.is_finite() {
                return Err(fail(Fault::NotFinite { quantity: Quantity::Observation, component: i }));
            } else if let Some(period) = sensors.angle(i) {
                *z = givens_core::scalar::Real::wrap(*z, period);
            }
        }
        out.time.push(t);
        out.states.extend_from_slice(&x);
        out.z.extend_from_slice(&z);
    }
    Ok(out)
}

fn healthy(health: Health<f64>, matrix: Matrix) -> Result<(), Fault> {
    health.failed().map_or(Ok(()), |pivot| Err(Fault::NotPositive { matrix, pivot }))
}

/// All of `values`, rows of length `columns`, must be finite.
fn finite(values: &[f64], columns: usize, quantity: Quantity) -> Result<(), Fault> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(at) => Err(Fault::NotFinite { quantity, component: at / columns }),
        None => Ok(()),
    }
}
