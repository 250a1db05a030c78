//! All methods by name: the one list that drives the contract tests, the command and Python.

mod choice;
mod entry;
mod runtime;
mod setting;

pub use choice::{Choice, FormName, RuleName};
pub use entry::{ENTRIES, Entry, find, names};
pub use setting::{OPTIONS, OptionInfo, Setting, SettingError, Value, resolve};
