//! Measurements of one trajectory.

use crate::scalar::Shown;

/// One row of a trajectory: a time, the measurement there, and the controls that hold from then on.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// When.
    pub time: f64,
    /// The measurement, length d; NaN where a component is missing.
    pub z: &'a [f64],
    /// Controls.
    pub u: &'a [f64],
}

/// The measurements of one trajectory in order of time.
///
/// ```
/// let mut data = givens::Data::new(1);
/// data.push(0.5, &[3.0])?;
/// data.push(1.0, &[f64::NAN])?; // nothing measured: the row asks for the prediction
/// assert!(data.push(0.7, &[3.0]).is_err());
/// # Ok::<(), givens::DataError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Data {
    measures: usize,
    controls: usize,
    start: Option<f64>,
    time: Vec<f64>,
    z: Vec<f64>,
    u: Vec<f64>,
}

/// Why a row was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DataError {
    /// A time that is not finite, or before the row above; the first row's before the initial belief.
    Time {
        /// The row, from zero.
        row: usize,
        /// Its time.
        time: f64,
        /// The earliest time that it may have.
        earliest: f64,
    },
    /// An infinite measurement.
    Infinite {
        /// The row, from zero.
        row: usize,
        /// The component, from zero.
        component: usize,
    },
    /// A measurement or control of the wrong length.
    Length {
        /// The row, from zero.
        row: usize,
        /// The length it must have.
        expected: usize,
        /// The length it has.
        found: usize,
    },
}

impl core::fmt::Display for DataError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::Time { row, time, .. } if !time.is_finite() => {
                write!(f, "row {row}: time {} is not finite", Shown(time))
            }
            Self::Time { row, time, earliest } => {
                let before = if row == 0 { "the initial belief" } else { "the row above" };
                write!(f, "row {row}: time {} is before {before}, at {}", Shown(time), Shown(earliest))
            }
            Self::Infinite { row, component } => {
                write!(f, "row {row}: component {component} is infinite; a missing component is NaN")
            }
            Self::Length { row, expected, found } => {
                write!(f, "row {row}: expected length {expected}, found {found}")
            }
        }
    }
}

impl core::error::Error for DataError {}

impl Data {
    /// No rows yet, of measurements of length `measures`.
    pub fn new(measures: usize) -> Self {
        Self::with_controls(measures, 0)
    }

    /// No rows yet, of measurements and controls of these lengths.
    pub fn with_controls(measures: usize, controls: usize) -> Self {
        Self { measures, controls, start: None, time: Vec::new(), z: Vec::new(), u: Vec::new() }
    }

    /// The initial belief holds at `t0`; without this, at the first row, which is then updated without prediction.
    #[must_use]
    pub fn starting_at(self, t0: f64) -> Self {
        Self { start: Some(t0), ..self }
    }

    /// The time at which the initial belief holds; zero if there is nothing to tell it.
    pub fn start(&self) -> f64 {
        self.start.or(self.time.first().copied()).unwrap_or(0.0)
    }

    /// Adds a row; NaN marks a missing component.
    ///
    /// # Errors
    /// A row out of time order, of the wrong length, or with an infinite number.
    pub fn push(&mut self, time: f64, z: &[f64]) -> Result<(), DataError> {
        self.push_controlled(time, z, &[])
    }

    /// Adds a row with controls, which hold from its time to the next row's.
    ///
    /// # Errors
    /// As [`push`](Self::push).
    pub fn push_controlled(&mut self, time: f64, z: &[f64], u: &[f64]) -> Result<(), DataError> {
        let row = self.time.len();
        for (expected, found) in [(self.measures, z.len()), (self.controls, u.len())] {
            if expected != found {
                return Err(DataError::Length { row, expected, found });
            }
        }
        let earliest = self.time.last().copied().or(self.start).unwrap_or(f64::NEG_INFINITY);
        if !time.is_finite() || time < earliest {
            return Err(DataError::Time { row, time, earliest });
        }
        if let Some(component) = z.iter().position(|z| z.is_infinite()) {
            return Err(DataError::Infinite { row, component });
        }
        self.time.push(time);
        self.z.extend_from_slice(z);
        self.u.extend_from_slice(u);
        Ok(())
    }

    /// Length d of a measurement.
    pub fn measures(&self) -> usize {
        self.measures
    }

    /// Number of controls.
    pub fn controls(&self) -> usize {
        self.controls
    }

    /// Row `k`, if there is one.
    pub fn row(&self, k: usize) -> Option<Row<'_>> {
        let (d, c) = (self.measures, self.controls);
        let time = *self.time.get(k)?;
        Some(Row { time, z: &self.z[k * d..(k + 1) * d], u: &self.u[k * c..(k + 1) * c] })
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// No rows.
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// The rows.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> + Clone {
        let (d, c) = (self.measures, self.controls);
        let row = move |(k, &time): (usize, &f64)| Row {
            time,
            z: &self.z[k * d..(k + 1) * d],
            u: &self.u[k * c..(k + 1) * c],
        };
        self.time.iter().enumerate().map(row)
    }
}
