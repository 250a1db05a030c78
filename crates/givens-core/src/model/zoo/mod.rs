//! Models of the literature, one cited model per file. `examples/zoo` has the continuous ones as model files.

mod circadian;
mod components;
mod coordinated_turn;
mod harmonic_oscillator;
mod lorenz_63;
mod lorenz_96;
mod ornstein_uhlenbeck;
mod radar_3d;
mod range_bearing;
mod reentry;
mod turn_3d;
mod van_der_pol;

pub use circadian::Circadian;
pub use components::Components;
pub use coordinated_turn::CoordinatedTurn;
pub use harmonic_oscillator::HarmonicOscillator;
pub use lorenz_63::Lorenz63;
pub use lorenz_96::Lorenz96;
pub use ornstein_uhlenbeck::OrnsteinUhlenbeck;
pub use radar_3d::Radar3d;
pub use range_bearing::RangeBearing;
pub use reentry::{RangeAside, Reentry};
pub use turn_3d::Turn3d;
pub use van_der_pol::VanDerPol;
