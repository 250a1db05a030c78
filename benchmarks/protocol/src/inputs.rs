//! The fixed inputs: tables of numbers.

use crate::Failure;
use std::path::PathBuf;

/// The folder of the inputs.
pub struct Inputs {
    folder: PathBuf,
}

/// Numbers row by row.
#[derive(Clone, Debug)]
pub struct Table {
    /// Numbers in a row.
    pub columns: usize,
    /// All rows, one after the other.
    pub values: Vec<f64>,
}

impl Table {
    /// Row `k`.
    #[must_use]
    pub fn row(&self, k: usize) -> &[f64] {
        &self.values[k * self.columns..(k + 1) * self.columns]
    }

    /// How many rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.values.len() / self.columns
    }
}

impl Inputs {
    /// Inputs in this folder.
    #[must_use]
    pub fn in_folder(folder: &str) -> Self {
        Self { folder: PathBuf::from(folder) }
    }

    /// Where a file of this name is.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// `NAME.csv`: a header, then numbers.
    ///
    /// # Errors
    /// A file that cannot be read, or a cell that is no number.
    pub fn csv(&self, name: &str) -> Result<Table, Failure> {
        let path = self.path(&format!("{name}.csv"));
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let mut lines = text.lines();
        let columns = lines.next().unwrap_or("").split(',').count();
        let cells = lines.flat_map(|line| line.split(','));
        let values = cells.map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        Ok(Table { columns, values })
    }

    /// `NAME.f32`: single precision, the low byte first, in rows of `columns`.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn f32(&self, name: &str, columns: usize) -> Result<Table, Failure> {
        let path = self.path(&format!("{name}.f32"));
        let bytes = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let values = bytes.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])));
        Ok(Table { columns, values: values.collect() })
    }
}
