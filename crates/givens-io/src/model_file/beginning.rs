//! Where a track begins: the initial belief, as the file gives it or as `start` finds it from one row or two.

use givens::filter::{Gaussian, InvalidCovariance};
use givens::model::{At, Observation};
use givens::scalar::Real;

use super::Model;
use super::start::Start;
use crate::table::{Row, Track};
use std::borrow::Cow;

/// The initial belief of one track.
#[derive(Clone, Debug, PartialEq)]
pub struct Beginning {
    /// When it holds.
    pub time: f64,
    /// N(mean, covariance) of all states.
    pub prior: Gaussian,
    /// The row of the track at which it holds, or the first one after; rows before it have no estimate.
    pub row: usize,
    /// Whether `start` has read that row: it must not be used again. (If it has read another, that one lies before.)
    pub started: bool,
}

/// Why a track cannot begin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BeginError {
    /// The line of the table, from one, where it was to begin; none if there is no such row.
    pub line: Option<usize>,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub help: &'static str,
}

impl core::fmt::Display for BeginError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        write!(f, "{} ({})", self.message, self.help)
    }
}

impl core::error::Error for BeginError {}

impl Model {
    /// The initial belief of a track. States that `start` finds have the covariance that follows from the sensors'
    /// noise, C R Cᵀ; the others are independent of them. With `rate` it holds at the second of the rows that are read.
    ///
    /// # Errors
    /// A track without rows that have what `start` reads, or with two of them at one time; values of `start` that are
    /// not finite; a measurement noise that is no covariance.
    pub fn begin(&self, track: &Track) -> Result<Beginning, BeginError> {
        let mut mean: Vec<f64> = self.prior.mean.iter().map(|m| m.unwrap_or(0.0)).collect();
        let Some(start) = &self.start else {
            let prior = gaussian(&mean, &self.prior.cov, None)?;
            return Ok(Beginning { time: track.start, prior, row: 0, started: false });
        };
        let (row, read) = self.read_by(start, track)?;
        let n = self.states.len();
        let k = start.states.len();
        let p: Vec<f64> = self.parameters.iter().map(|(_, value)| *value).collect();
        let (time, line) = (read.present.time, read.present.line);
        let [u, z] = read.inputs(self);
        let (mut values, mut slopes) = (vec![0.0; k], vec![0.0; k * z.len()]);
        let at = At { t: time, dt: read.earlier.as_ref().map_or(0.0, |row| time - row.time), u: &u, p: &p };
        start.function.evaluate(&at, &z, &mut values, &mut slopes);
        let spread = self.spread(start, &read, &p, &slopes)?;
        let mut cov = self.prior.cov.clone();
        for (a, &i) in start.states.iter().enumerate() {
            mean[i] = values[a];
            for (b, &j) in start.states.iter().enumerate() {
                cov[i * n + j] = spread[a * k + b];
            }
        }
        if let Some(i) = mean.iter().position(|m| !m.is_finite()) {
            let from = if start.two_rows { "this row and the one before it" } else { "this row" };
            let message = format!("`start` finds no finite `{}` from {from}", self.states[i]);
            let help = "look for a division by zero, or the root of a negative number";
            return Err(BeginError { line: Some(line), message, help });
        }
        let prior = gaussian(&mean, &cov, Some(line))?;
        Ok(Beginning { time, prior, row, started: true })
    }

    /// The rows that `start` reads, and the place of the last of them in the track.
    fn read_by<'t>(&self, start: &Start, track: &'t Track) -> Result<(usize, Read<'t>), BeginError> {
        let has = |z: &[f64]| start.measures.iter().all(|&i| z.get(i).is_some_and(|z| z.is_finite()));
        let rows = track.rows.iter().enumerate().map(|(k, row)| row.map(|row| (k, row)));
        let mut readable = rows.filter(|row| row.as_ref().is_ok_and(|(_, row)| has(&row.z)) || row.is_err());
        let mut next = || readable.next().transpose().map_err(|error| unreadable(&error));
        let first = next()?;
        let second = if start.two_rows { next()? } else { None };
        let lacking = |rows: &str| {
            let columns = self.sensors.iter().flat_map(|sensor| &sensor.columns).enumerate();
            let needed =
                columns.filter(|(i, _)| start.measures.contains(i)).map(|(_, column)| column.as_str());
            let needed: Vec<_> = needed.collect();
            let message = format!("{rows} all that `start` reads: {}", needed.join(", "));
            let help = "leave the track out, or give all states `mean` and `std` in place of `start`";
            BeginError { line: None, message, help }
        };
        let Some((row, first)) = first else { return Err(lacking("no row has")) };
        if !start.two_rows {
            return Ok((row, Read { present: first, earlier: None }));
        }
        let Some((row, second)) = second else {
            return Err(lacking("only one row has, where `rate` needs two,"));
        };
        if second.time <= first.time {
            let message =
                format!("`rate` needs two times, but this row and that of line {} are at one", first.line);
            let help = "leave one of the two rows out, or move what it measures to the other";
            return Err(BeginError { line: Some(second.line), message, help });
        }
        Ok((row, Read { present: second, earlier: Some(first) }))
    }

    /// C R Cᵀ, k × k, from the slopes C of `start` along the measures of all rows that it reads, whose errors are
    /// independent of each other.
    fn spread(&self, start: &Start, read: &Read, p: &[f64], slopes: &[f64]) -> Result<Vec<f64>, BeginError> {
        let (d, k) = (self.measures(), start.states.len());
        let rows: Vec<&Row> = read.rows().collect();
        let columns = self.observation.noise().columns(d);
        let width = rows.len() * columns;
        let mut images = vec![0.0; k * width];
        for (r, row) in rows.iter().enumerate() {
            let root = self.noise_root(row, p)?;
            for a in 0..k {
                let slopes = &slopes[(a * rows.len() + r) * d..][..d];
                for (c, image) in images[a * width + r * columns..][..columns].iter_mut().enumerate() {
                    // A measure that `start` does not read has slope zero, whatever its noise.
                    *image = start.measures.iter().map(|&i| slopes[i] * root[i * columns + c]).sum();
                }
            }
        }
        let mut spread = vec![0.0; k * k];
        givens::kernels::square(&mut spread, k, &images, width, width);
        Ok(spread)
    }

    /// A root of R at a row.
    fn noise_root(&self, row: &Row, p: &[f64]) -> Result<Vec<f64>, BeginError> {
        let d = self.measures();
        let mut root = vec![0.0; d * self.observation.noise().columns(d)];
        let health = self.observation.noise_root(&At { t: row.time, dt: 0.0, u: &row.u, p }, &mut root);
        let Some(pivot) = health.failed() else { return Ok(root) };
        let mut names = self.sensors.iter().flat_map(|sensor| &sensor.columns);
        let name = names.nth(pivot).map_or("", String::as_str);
        let message = format!("the measurement noise is no covariance at this row (measure `{name}`)");
        let help = "check the expressions of `std` and `cov`";
        Err(BeginError { line: Some(row.line), message, help })
    }
}

/// The rows that `start` reads.
struct Read<'t> {
    present: Cow<'t, Row>,
    earlier: Option<Cow<'t, Row>>,
}

impl Read<'_> {
    fn rows(&self) -> impl Iterator<Item = &Row> {
        core::iter::once(&*self.present).chain(self.earlier.as_deref())
    }

    /// The controls and the measurements of the rows, the present one's first. Earlier angles are taken near the
    /// present ones, so that their rates do not see the jump where a period ends.
    fn inputs(&self, model: &Model) -> [Vec<f64>; 2] {
        let u = self.rows().flat_map(|row| row.u.iter().copied()).collect();
        let near = |(i, &earlier): (usize, &f64)| {
            let present = self.present.z.get(i).copied().unwrap_or(f64::NAN);
            match model.observation.angle(i) {
                Some(period) if (earlier - present).abs() > period / 2.0 => {
                    present + (earlier - present).wrap(period)
                }
                _ => earlier,
            }
        };
        let earlier = self.earlier.iter().flat_map(|row| row.z.iter().enumerate().map(near));
        [u, self.present.z.iter().copied().chain(earlier).collect()]
    }
}

fn unreadable(error: &std::io::Error) -> BeginError {
    let help = "run it again, with a TMPDIR that can be read";
    BeginError { line: None, message: error.to_string(), help }
}

fn gaussian(mean: &[f64], cov: &[f64], line: Option<usize>) -> Result<Gaussian, BeginError> {
    Gaussian::from_cov(mean, cov).map_err(|error: InvalidCovariance| BeginError {
        line,
        message: format!("the initial covariance: {error}"),
        help: "a covariance has no negative variance, and no correlation above one",
    })
}
