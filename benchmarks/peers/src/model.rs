//! A model as all peers are given it.

/// Transition, observation, noises and prior; matrices row by row.
pub trait Model: Copy + 'static {
    /// n.
    fn states(&self) -> usize;
    /// d.
    fn measures(&self) -> usize;
    fn transition(&self, x: &[f64], out: &mut [f64]);
    fn observe(&self, x: &[f64], out: &mut [f64]);
    /// Q, n × n.
    fn process(&self) -> Vec<f64>;
    /// R's diagonal.
    fn measurement(&self) -> Vec<f64>;
    fn mean(&self) -> Vec<f64>;
    /// P's diagonal.
    fn variances(&self) -> Vec<f64>;
}
