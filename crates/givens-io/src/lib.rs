//! What goes in and comes out of files: model files and tables.
//!
//! [`Model::read`] reads a model file, [`read_tracks`] the measurements for it; both tell all that is wrong with
//! their input at once, each error with its place and the remedy ([`InputErrors`]).

pub mod decode;
mod error;
pub mod figure;
mod files;
mod findings;
mod journal;
mod model_file;
mod output;
mod page;
mod partition;
mod source;
mod table;

pub use error::{InputError, InputErrors, Location, Place};
pub use files::list_files;
pub use journal::{Identity, Journal, JournalError};
pub use model_file::{
    BeginError, Beginning, Dynamics, FilterSettings, Model, Prior, Sensor, Setting, SettingValue, Start,
};
pub use output::{
    Answer, AnswerWriter, Answers, Destination, DestinationError, Drawn, Format, Layout, Part, Written,
    make_folder, read_back, write_measurements, write_states,
};
pub use page::{Page, Tone};
pub use partition::{Partition, Partitioned};
pub use table::{
    Calendar, Row, Rows, Track, Tracks, Truth, parse_tracks, parse_truth, read_times, read_tracks, read_truth,
};
