//! What goes in and comes out of files: model files and tables.
//!
//! [`Model::read`] reads a model file, [`read_tracks`] the measurements for it; both tell all that is wrong with
//! their input at once, each error with its place and the remedy ([`InputErrors`]).

mod error;
pub mod figure;
mod findings;
mod journal;
mod model_file;
mod output;
mod page;
mod source;
mod table;

pub use error::{InputError, InputErrors, Location, Place};
pub use journal::{Identity, Journal, JournalError};
pub use model_file::{
    BeginError, Beginning, Dynamics, FilterSettings, Model, Prior, Sensor, Setting, SettingValue, Start,
};
pub use output::{
    Answer, AnswerWriter, Destination, DestinationError, Drawn, Format, Part, Written, make_folder,
    read_back, write_answers, write_measurements, write_states,
};
pub use page::{Page, Tone};
pub use table::{
    Calendar, Row, Rows, Track, Tracks, Truth, parse_tracks, parse_truth, read_times, read_tracks, read_truth,
};
