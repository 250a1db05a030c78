//! Whether there is room for what is asked for; the allocator would end the program if not.

use pyo3::prelude::*;

use crate::errors::{Input, Result};

/// An error where `count` things of so many bytes find no room.
pub fn room(argument: &'static str, count: u32, bytes: usize) -> Result<()> {
    let bytes = bytes.saturating_mul(count as usize);
    if Vec::<u8>::new().try_reserve_exact(bytes).is_ok() {
        return Ok(());
    }
    let message = format!(
        "`{argument}` is {count}: they need {:.3e} bytes at once, more than there is memory for",
        bytes as f64
    );
    Err(Input::new(argument, message).help("draw fewer at a time, each time with another seed").into())
}

/// What is always granted, without a look at the system.
const SMALL: usize = 1 << 26;

/// An error where the estimates of so many rows find no room, all together.
pub fn room_for_rows(py: Python<'_>, rows: usize, bytes: usize) -> Result<()> {
    if bytes <= SMALL {
        return Ok(());
    }
    let free: Option<usize> = py.import("givens._memory")?.call_method0("free")?.extract()?;
    if free.is_none_or(|free| bytes <= free) && Vec::<u8>::new().try_reserve_exact(bytes).is_ok() {
        return Ok(());
    }
    let message = format!(
        "the estimates of {rows} rows need {:.2e} bytes, more than there is memory for",
        bytes as f64
    );
    let help = "run fewer tracks at a time, step a `gv.Filter` by hand, or run the command `givens`, which holds few rows at once";
    Err(Input::new("t", message).help(help).into())
}
