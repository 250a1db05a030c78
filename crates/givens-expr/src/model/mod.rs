//! Models of run time: what filters take, made of expressions.

mod error;
mod expansion;
mod frame;
mod jacobian;
mod observation;
mod sde;
mod start;
mod transition;

pub use error::ModelError;
pub use observation::{ModelObservation, NoiseBlock, ObservationParts};
pub use sde::{ModelSde, SdeParts};
pub use start::{ModelStart, StartParts, rate};
pub use transition::{ModelTransition, TransitionParts};
