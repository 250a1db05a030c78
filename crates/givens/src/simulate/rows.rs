//! A trajectory through the rows, whatever moves it.

use super::Stream;
use crate::Row;
use crate::filter::{Fault, Gaussian, Matrix, Quantity, StepError};
use crate::kernels::Health;
use crate::model::{At, Observation};

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

/// What carries a state over a gap.
pub(super) trait Moves {
    /// Length n of the state.
    fn states(&self) -> usize;
    /// Number of controls.
    fn controls(&self) -> usize;
    /// The model's parameters.
    fn parameters(&self) -> &[f64];
    /// Moves `x` from time `from` to `to` with the controls `u`.
    fn advance(
        &mut self,
        from: f64,
        to: f64,
        u: &[f64],
        x: &mut [f64],
        stream: &mut Stream,
    ) -> Result<(), Fault>;
}

/// See [`simulate`](super::simulate).
pub(super) fn draw<'a, H: Observation>(
    mut moves: impl Moves,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>>,
    t0: f64,
    prior: &Gaussian,
    stream: &mut Stream,
) -> Result<Simulation, StepError> {
    let (n, d) = (prior.mean().len(), sensors.measures());
    let r = sensors.noise().columns(d);
    for (of, expected, found) in
        [("the prior", moves.states(), n), ("the sensors' state", n, sensors.states())]
    {
        length(of, expected, found).map_err(|fault| StepError { fault, time: t0, step: 0 })?;
    }
    let mut out = Simulation::default();
    let mut x = prior.mean().to_vec();
    let mut w = vec![0.0; n.max(r)];
    let (mut z, mut s_r) = (vec![0.0; d], vec![0.0; d * r]);
    stream.add_noise(&mut x, prior.factor(), n, &mut w);
    let (mut t, mut held): (f64, Option<Vec<f64>>) = (t0, None);
    for (step, row) in rows.enumerate() {
        let fail = |fault| StepError { fault, time: row.time, step };
        let gap = row.time - t;
        if !(gap >= 0.0 && gap.is_finite()) {
            return Err(fail(Fault::Backwards { to: row.time }));
        }
        length("controls", moves.controls(), row.u.len()).map_err(fail)?;
        length("measurement", d, row.z.len()).map_err(fail)?;
        let u = held.get_or_insert_with(|| row.u.to_vec());
        moves.advance(t, row.time, u, &mut x, stream).map_err(fail)?;
        t = row.time;
        u.copy_from_slice(row.u);
        let at = At { t, dt: 0.0, u, p: moves.parameters() };
        sensors.observe(&at, &x, &mut z);
        healthy(sensors.noise_root(&at, &mut s_r), Matrix::MeasurementNoise).map_err(fail)?;
        finite(&s_r, r.max(1), Quantity::MeasurementNoise).map_err(fail)?;
        stream.add_noise(&mut z, &s_r, r, &mut w);
        for (i, (z, asked)) in z.iter_mut().zip(row.z).enumerate() {
            if asked.is_nan() {
                *z = f64::NAN;
                continue;
            }
            if let Some(period) = sensors.angle(i) {
                *z = givens_core::scalar::Real::wrap(*z, period);
            }
            // an angle of more periods than there are numbers has none within one
            if !z.is_finite() {
                return Err(fail(Fault::NotFinite { quantity: Quantity::Observation, component: i }));
            }
        }
        out.time.push(t);
        out.states.extend_from_slice(&x);
        out.z.extend_from_slice(&z);
    }
    Ok(out)
}

fn length(of: &'static str, expected: usize, found: usize) -> Result<(), Fault> {
    if expected == found { Ok(()) } else { Err(Fault::Length { of, expected, found }) }
}

pub(super) fn healthy(health: Health<f64>, matrix: Matrix) -> Result<(), Fault> {
    health.failed().map_or(Ok(()), |pivot| Err(Fault::NotPositive { matrix, pivot }))
}

/// All of `values`, rows of length `columns`, must be finite.
pub(super) fn finite(values: &[f64], columns: usize, quantity: Quantity) -> Result<(), Fault> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(at) => Err(Fault::NotFinite { quantity, component: at / columns }),
        None => Ok(()),
    }
}
