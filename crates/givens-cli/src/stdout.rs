//! The command's one writer to stdout.

use crate::files::Output;
use crate::message::Stop;
use givens_io::Written;
use std::io::{self, BufWriter, ErrorKind, StdoutLock, Write};

impl Output for BufWriter<StdoutLock<'_>> {
    fn settle(&mut self) -> io::Result<Written> {
        self.flush().map(|()| Written::default())
    }
}

/// Writes data to stdout. A reader that has gone away (`| head`) is no error.
pub fn write(data: impl FnOnce(&mut dyn Output) -> io::Result<()>) -> Result<(), Stop> {
    let mut out = BufWriter::new(io::stdout().lock());
    let done = data(&mut out).and_then(|()| out.flush());
    match done {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Stop::failed(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}
