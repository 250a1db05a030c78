//! Models of the literature, one cited model per file.

mod coordinated_turn;
mod radar_3d;
mod range_bearing;
mod turn_3d;

pub use coordinated_turn::CoordinatedTurn;
pub use radar_3d::Radar3d;
pub use range_bearing::RangeBearing;
pub use turn_3d::Turn3d;
