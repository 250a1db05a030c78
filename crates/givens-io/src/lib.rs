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
mod pages;
mod partition;
mod portion;
mod scheme;
mod source;
mod table;

pub use error::{InputError, InputErrors, Location, Place};
pub use files::list_files;
pub use journal::{Identity, Journal, JournalError};
pub use model_file::{
    BeginError, Beginning, Dynamics, FilterSettings, Model, Prior, Sensor, Setting, SettingValue, Start,
};
pub use output::{
    Answer, AnswerWriter, Answers, Destination, DestinationError, Drawn, FailedTrack, Format, Layout,
    LentAnswers, Part, Written, make_folder, read_back, write_measurements, write_states,
};
pub use page::{Page, Tone};
pub use partition::{Partition, Partitioned};
pub use portion::{Portion, Unread, portions};
pub use scheme::Scheme;
pub use table::{
    Calendar, Ids, Refused, Row, Rows, Track, Tracks, Truth, lent_tracks, parse_tracks, parse_truth,
    read_times, read_tracks, read_tracks_apart, read_truth,
};
