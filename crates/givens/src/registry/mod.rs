//! All methods by name: the one list that drives the contract tests, the command and Python.

mod any_filter;
mod batches;
mod begin;
mod choice;
mod dispatch;
mod entry;
mod option;
mod resolve;
mod running;
mod runtime;
mod sampling;
mod setting;
mod stepping;
mod streaming;
mod time;
mod words;

pub use any_filter::AnyFilter;
pub use choice::Choice;
pub use entry::{ENTRIES, Entry, default_method, find, names};
pub use option::{OPTIONS, OptionInfo, Reader};
pub use resolve::resolve;
pub use setting::{Setting, SettingError, Value};
pub use words::{FormName, Kind, Precision, RuleName, TimeName};
