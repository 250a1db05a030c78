//! Tables of other libraries, in and out, by Arrow's PyCapsule protocol: memory is lent, and no library is imported.

mod export;
pub mod import;

pub use export::arrow_stream;
pub use import::ArrowTable;
