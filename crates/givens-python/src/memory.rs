//! Whether there is room for what is asked for; the allocator would end the program if not.

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

/// An error where `rows` rows of so many bytes each find no room.
pub fn room_for_rows(rows: usize, each: usize) -> Result<()> {
    let bytes = rows.saturating_mul(each);
    if Vec::<u8>::new().try_reserve_exact(bytes).is_ok() {
        return Ok(());
    }
    let message = format!(
        "`t` has {rows} times: their estimates, {each} bytes each, need {:.3e} bytes, more than there is memory for",
        bytes as f64
    );
    let help = "step a `gv.Filter` by hand, or run the command `givens`, which holds few rows at once";
    Err(Input::new("t", message).help(help).into())
}
