//! Words and numbers to the standard output, without the formatting of `core`, which weighs more than a filter.

use core::ffi::{c_int, c_void};

// The C library, which starts the program, writes and ends it; nothing else is asked of it.
#[link(name = "c")]
unsafe extern "C" {
    fn write(file: c_int, bytes: *const c_void, len: usize) -> isize;
    fn _exit(status: c_int) -> !;
}

fn bytes(all: &[u8]) {
    let mut rest = all;
    while !rest.is_empty() {
        // SAFETY: so many bytes stand there.
        let written = unsafe { write(1, rest.as_ptr().cast(), rest.len()) };
        let Some(later) = usize::try_from(written).ok().filter(|&n| n > 0).and_then(|n| rest.get(n..)) else {
            return; // nobody reads
        };
        rest = later;
    }
}

pub fn text(words: &str) {
    bytes(words.as_bytes());
}

pub fn end() {
    bytes(b"\n");
}

fn blanks(count: usize) {
    for _ in 0..count {
        bytes(b" ");
    }
}

/// Words, filled with blanks behind.
pub fn wide(words: &str, width: usize) {
    text(words);
    blanks(width.saturating_sub(words.len()));
}

/// A number ≥ 0 with so many digits behind the point, filled with blanks before.
pub fn number(value: f64, width: usize, digits: u32) {
    if value.is_nan() || value > 1e9 {
        blanks(width.saturating_sub(5));
        return text("large");
    }
    let scale = 10_u64.pow(digits);
    // rounded
    let mut left = (value * scale as f64 + 0.5) as u64;
    let mut line = [b' '; 24];
    let (mut at, mut written) = (line.len(), 0);
    while left > 0 || written <= digits {
        if written == digits && digits > 0 {
            at -= 1;
            line[at] = b'.';
        }
        at -= 1;
        line[at] = b'0' + (left % 10) as u8;
        left /= 10;
        written += 1;
    }
    blanks(width.saturating_sub(line.len() - at));
    bytes(&line[at..]);
}

pub fn leave(status: c_int) -> ! {
    // SAFETY: it takes a number, and ends the program.
    unsafe { _exit(status) }
}
