//! Parquet files of strangers: the library that reads them may panic over damaged pages, which is an error here.

use core::cell::Cell;
use core::panic::AssertUnwindSafe;
use std::fs::File;
use std::panic::{catch_unwind, set_hook, take_hook};
use std::sync::Once;

use arrow_array::RecordBatch;
use parquet::arrow::arrow_reader::{ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder};

thread_local! {
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// What comes of the work, or that the file is damaged; of that nothing is printed.
fn guarded<R>(work: impl FnOnce() -> Result<R, String>) -> Result<R, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = take_hook();
        set_hook(Box::new(move |panic| {
            if !QUIET.get() {
                usual(panic);
            }
        }));
    });
    let before = QUIET.replace(true);
    let done = catch_unwind(AssertUnwindSafe(work));
    QUIET.set(before);
    done.unwrap_or_else(|_| Err("its pages are damaged".to_owned()))
}

/// Reads what stands at the end of the file.
pub(crate) fn open(file: File) -> Result<ParquetRecordBatchReaderBuilder<File>, String> {
    guarded(|| ParquetRecordBatchReaderBuilder::try_new(file).map_err(|error| error.to_string()))
}

/// Batches of rows, up to the first that cannot be read.
pub(crate) struct Pages(Option<ParquetRecordBatchReader>);

impl Pages {
    /// From the first one on.
    pub fn of(builder: ParquetRecordBatchReaderBuilder<File>) -> Result<Self, String> {
        guarded(|| builder.build().map_err(|error| error.to_string())).map(|reader| Self(Some(reader)))
    }
}

impl Iterator for Pages {
    type Item = Result<RecordBatch, String>;

    fn next(&mut self) -> Option<Self::Item> {
        let reader = self.0.as_mut()?;
        let next = guarded(|| reader.next().transpose().map_err(|error| error.to_string()));
        if next.is_err() {
            self.0 = None;
        }
        next.transpose()
    }
}
