//! What a number stands for, where it is at fault.

/// A quantity that a model computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The transition of a state.
    Transition,
    /// The value of a measure.
    Observation,
    /// The derivative of the transition with respect to the state, at the mean.
    TransitionDerivative,
    /// The derivative of a measure with respect to the state, at the mean.
    ObservationDerivative,
    /// The drift of a state.
    Drift,
    /// The derivative of the drift with respect to the state, at the mean.
    DriftDerivative,
    /// The diffusion of a state.
    Diffusion,
    /// The process noise.
    ProcessNoise,
    /// The measurement noise.
    MeasurementNoise,
    /// A measurement given to the filter.
    Measurement,
    /// The square of a measurement's innovation, in standard deviations.
    Innovation,
    /// A state estimate.
    Estimate,
    /// The variance of a state in the initial belief.
    Variance,
    /// A control given to the filter.
    Control,
    /// A parameter given to the filter.
    Parameter,
    /// The time at which a belief is to hold.
    Time,
}

impl Quantity {
    /// Its name in a message.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::Transition => "transition",
            Quantity::Observation => "predicted measure",
            Quantity::TransitionDerivative => "derivative of the transition",
            Quantity::ObservationDerivative => "derivative of the predicted measure",
            Quantity::Drift => "drift",
            Quantity::DriftDerivative => "derivative of the drift",
            Quantity::Diffusion => "diffusion",
            Quantity::ProcessNoise => "process noise",
            Quantity::MeasurementNoise => "measurement noise",
            Quantity::Measurement => "measurement",
            Quantity::Innovation => "squared innovation",
            Quantity::Estimate => "state estimate",
            Quantity::Variance => "initial variance",
            Quantity::Control => "control",
            Quantity::Parameter => "parameter",
            Quantity::Time => "time of the belief",
        }
    }
}
