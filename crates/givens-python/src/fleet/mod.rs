//! Tables of many tracks: read, run and written without an array of NumPy between.

mod answers;
mod portion;
mod table;

pub use table::TrackTable;
