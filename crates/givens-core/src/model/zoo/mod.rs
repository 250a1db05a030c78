//! Models of the literature, one cited model per file.

mod coordinated_turn;
mod range_bearing;

pub use coordinated_turn::CoordinatedTurn;
pub use range_bearing::RangeBearing;
