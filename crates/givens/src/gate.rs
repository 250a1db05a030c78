//! A gate for measurements that the filter believes all but impossible.

use crate::Computes;
use crate::filter::{Fault, Over, StepError};
use crate::metrics::chi_squared_quantile;
use crate::model::Observation;
use crate::rule::RuleError;
use crate::run::OwnFilter;
use crate::scalar::Real;

/// A method with a gate: for whole runs over real data, whose sensors now and then report what is not there.
///
/// A row whose squared innovation νᵀ P_zz⁻¹ ν (NIS) is beyond the quantile of this probability, of the χ² distribution with as
/// many degrees of freedom as components are there, is not taken in: the belief after it is the predicted one, as if nothing had
/// been measured (docs/algorithms.md U7). [`Estimates::gated`](crate::Estimates::gated) marks it; its innovation and NIS are
/// those that were seen, and its log-likelihood is zero.
///
/// Of a right filter over data without outliers, one row in ten thousand is beyond 0.9999, a usual choice. Without a
/// probability there is no gate.
///
/// ```
/// use givens::filter::{Gaussian, SrCkf};
/// use givens::model::zoo::{CoordinatedTurn, RangeBearing};
/// use givens::{Data, Gated};
///
/// let mut data = Data::new(2).starting_at(0.0);
/// data.push(1.0, &[1640.0, 0.65])?;
/// data.push(2.0, &[8890.0, 0.56])?; // not the aircraft
/// let prior = Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01])?;
/// let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
/// let method = Gated { method: SrCkf::default(), gate: Some(0.9999) };
/// let est = givens::filter(&method, &turn, &radar, &data, &prior)?;
/// assert_eq!(est.gated, [false, true]);
/// assert_eq!(est.mean(1), est.predicted_mean(1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gated<X> {
    /// The method.
    pub method: X,
    /// The probability, above 0 and below 1; none: every row is taken in.
    pub gate: Option<f64>,
}

impl<M, X: Computes<M>> Computes<M> for Gated<X> {
    type Method = X::Method;
    type Number = X::Number;
    fn method(self) -> X::Method {
        self.method.method()
    }
    fn gate(self) -> Option<f64> {
        self.gate
    }
}

/// What a gate's probability must be, if this is none.
pub(crate) fn check(gate: f64) -> Result<(), RuleError> {
    if gate > 0.0 && gate < 1.0 {
        return Ok(());
    }
    let must = "must be a probability above 0 and below 1, such as 0.9999";
    Err(RuleError { option: "gate", value: gate, must })
}

/// The largest NIS of rows with 1, 2, … up to `measures` components that is taken in; empty without a gate.
pub(crate) fn limits(gate: Option<f64>, measures: usize) -> Result<Vec<f64>, Fault> {
    let Some(gate) = gate else { return Ok(Vec::new()) };
    check(gate).map_err(Fault::Option)?;
    Ok((1..=measures).map(|dof| chi_squared_quantile(dof as f64, gate)).collect())
}

/// The limit for a row with so many components, if there is one.
pub(crate) fn limit(limits: &[f64], dof: usize) -> Option<f64> {
    dof.checked_sub(1).and_then(|k| limits.get(k)).copied()
}

/// Teaches a filter the components of a row that are there, if they are not beyond the limits; whether it was taught.
pub(crate) fn teach<X: Over<M>, M, H: Observation, T: Real>(
    filter: &mut OwnFilter<X, M, T>,
    sensors: &H,
    z: &[f64],
    present: &[bool],
    limits: &[f64],
) -> Result<bool, StepError> {
    let dof = present.iter().filter(|there| **there).count();
    match limit(limits, dof) {
        Some(limit) => filter.update_gated(sensors, z, present, limit),
        None => filter.update_present(sensors, z, present).map(|()| true),
    }
}
