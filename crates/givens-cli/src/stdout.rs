//! The command's one writer to stdout.

use crate::message::Stop;
use std::io::{self, BufWriter, ErrorKind, Write};

/// Writes data to stdout. A reader that has gone away (`| head`) is no error.
pub fn write(data: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Stop> {
    let mut out = BufWriter::new(io::stdout().lock());
    let done = data(&mut out).and_then(|()| out.flush());
    match done {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Stop::failed(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}
