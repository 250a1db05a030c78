//! Answers in columns: record batches, and a Parquet file of them.

use core::num::ParseIntError;
use core::str::FromStr;
use std::collections::HashMap;
use std::io::{self, Write};
use std::sync::Arc;

use arrow_array::builder::{FixedSizeListBuilder, Float64Builder, StringDictionaryBuilder};
use arrow_array::types::Int32Type;
use arrow_array::{
    ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, StringArray, TimestampNanosecondArray,
    UInt64Array,
};
use arrow_schema::{DataType, Field, Schema, SchemaRef, TimeUnit};
use givens::Estimates;
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, ZstdLevel};
use parquet::file::properties::WriterProperties;

use super::{AnswerWriter, Layout, Line};
use crate::table::{Calendar, Ids};

/// Rows of a group, at least.
const GROUP: usize = 1 << 17;

/// Answers on their way into a Parquet file, in groups of whole portions.
pub(super) struct Columns {
    schema: SchemaRef,
    /// Rows of the group that is open.
    open: usize,
    file: ArrowWriter<Vec<u8>>,
}

impl Columns {
    /// Writes what stands at the beginning of the file.
    pub fn begin(of: &AnswerWriter, out: &mut dyn Write) -> io::Result<Self> {
        let schema = Arc::new(schema(of));
        let level = ZstdLevel::try_new(1).map_err(io::Error::other)?;
        let properties = WriterProperties::builder().set_compression(Compression::ZSTD(level));
        let properties = properties.set_max_row_group_row_count(None).build();
        let mut file = ArrowWriter::try_new(Vec::new(), Arc::clone(&schema), Some(properties))?;
        hand_on(&mut file, out)?;
        Ok(Self { schema, open: 0, file })
    }

    /// Adds lines.
    pub fn rows(&mut self, of: &AnswerWriter, out: &mut dyn Write, lines: &[Line]) -> io::Result<()> {
        if lines.is_empty() {
            return Ok(());
        }
        let arrays = arrays(of, lines).map_err(io::Error::other)?;
        let batch = RecordBatch::try_new(Arc::clone(&self.schema), arrays).map_err(io::Error::other)?;
        self.file.write(&batch)?;
        self.open += batch.num_rows();
        if self.open >= GROUP {
            self.file.flush()?;
            self.open = 0;
        }
        hand_on(&mut self.file, out)
    }

    /// Writes what stands at the end of the file.
    pub fn end(mut self, out: &mut dyn Write) -> io::Result<()> {
        self.file.finish()?;
        hand_on(&mut self.file, out)
    }
}

/// What the file has written so far goes on to where it shall lie.
fn hand_on(file: &mut ArrowWriter<Vec<u8>>, out: &mut dyn Write) -> io::Result<()> {
    let written = file.inner_mut();
    out.write_all(written)?;
    written.clear();
    Ok(())
}

pub(super) fn schema(of: &AnswerWriter) -> Schema {
    let (scheme, tracks) = (&of.tracks.scheme, of.tracks);
    let number = |name: &str| Field::new(name, DataType::Float64, true);
    let time = if tracks.dated {
        DataType::Timestamp(TimeUnit::Nanosecond, Some("UTC".into()))
    } else {
        DataType::Float64
    };
    let seconds = HashMap::from([("unit".to_owned(), "s".to_owned())]);
    let time = Field::new("time", time, false);
    let time = if tracks.dated { time } else { time.with_metadata(seconds) };
    let mut fields = vec![time];
    if tracks.has_track_id {
        let of = match tracks.ids {
            Ids::Words => DataType::Utf8,
            Ids::Whole => DataType::Int64,
            Ids::Unsigned => DataType::UInt64,
        };
        fields.push(Field::new("track_id", of, false));
    }
    fields.extend(tracks.has_sensor.then(|| Field::new("sensor", DataType::Utf8, true)));
    let n = scheme.states.len();
    if of.layout == Layout::Tidy {
        let name = DataType::Dictionary(Box::new(DataType::Int32), Box::new(DataType::Utf8));
        fields.push(Field::new("state", name, false));
        fields.extend(["mean", "std"].map(number));
    } else {
        fields.extend(scheme.states.iter().map(|name| number(name)));
        fields.extend(scheme.states.iter().map(|name| number(&format!("{name}_std"))));
        fields.push(number("nis"));
        fields.push(Field::new("nis_dof", DataType::Int64, true));
        fields.push(number("log_likelihood"));
        fields.extend(of.gated.then(|| Field::new("gated", DataType::Boolean, true)));
    }
    if of.layout == Layout::Covariances {
        let element = Arc::new(Field::new_list_field(DataType::Float64, true));
        let size = i32::try_from(n * (n + 1) / 2).unwrap_or(i32::MAX);
        fields.push(Field::new("cov", DataType::FixedSizeList(element, size), true));
    }
    let about = [
        ("givens.version", env!("CARGO_PKG_VERSION").to_owned()),
        ("givens.model", scheme.fingerprint.clone()),
        ("givens.states", scheme.states.join(",")),
    ];
    let about: HashMap<String, String> = about.map(|(key, value)| (key.to_owned(), value)).into();
    Schema::new_with_metadata(fields, about)
}

pub(super) fn arrays(of: &AnswerWriter, lines: &[Line]) -> Result<Vec<ArrayRef>, String> {
    let (scheme, tracks) = (&of.tracks.scheme, of.tracks);
    let n = scheme.states.len();
    let tidy = of.layout == Layout::Tidy;
    // in the tidy layout a line has a row for each of its states
    let each = if tidy { n } else { 1 };
    let spread = || lines.iter().flat_map(|line| core::iter::repeat_n(line, each));
    let mut all: Vec<ArrayRef> = Vec::new();
    if tracks.dated {
        let nanoseconds = spread().map(|line| instant(&line.row.time_text)).collect::<Result<Vec<_>, _>>()?;
        all.push(Arc::new(TimestampNanosecondArray::from(nanoseconds).with_timezone("UTC")));
    } else {
        all.push(Arc::new(Float64Array::from_iter_values(spread().map(|line| line.row.time))));
    }
    if tracks.has_track_id {
        let ids = spread().map(|line| line.track.unwrap_or_default());
        all.push(match tracks.ids {
            Ids::Words => Arc::new(StringArray::from_iter_values(ids)),
            Ids::Whole => Arc::new(Int64Array::from(whole::<i64>(ids)?)),
            Ids::Unsigned => Arc::new(UInt64Array::from(whole::<u64>(ids)?)),
        });
    }
    if tracks.has_sensor {
        all.push(Arc::new(spread().map(|line| line.sensor).collect::<StringArray>()));
    }
    let numbers = |of: &dyn Fn(&Estimates, usize) -> f64| -> ArrayRef {
        let one = |line: &Line| line.estimate.map(|(est, k)| of(est, k));
        Arc::new(lines.iter().map(one).collect::<Float64Array>())
    };
    if tidy {
        let mut names = StringDictionaryBuilder::<Int32Type>::new();
        let (mut means, mut stds) = (Float64Builder::new(), Float64Builder::new());
        for line in lines {
            for (i, name) in scheme.states.iter().enumerate() {
                names.append_value(name);
                means.append_option(line.estimate.map(|(est, k)| est.mean(k)[i]));
                stds.append_option(line.estimate.map(|(est, k)| est.std(k, i)));
            }
        }
        all.push(Arc::new(names.finish()));
        all.push(Arc::new(means.finish()));
        all.push(Arc::new(stds.finish()));
        return Ok(all);
    }
    all.extend((0..n).map(|i| numbers(&|est, k| est.mean(k)[i])));
    all.extend((0..n).map(|i| numbers(&|est, k| est.std(k, i))));
    // the row that `start` has read was neither predicted nor measured
    let stepped = |line: &Line| {
        if line.started {
            None
        } else {
            line.estimate.map(|(est, k)| (est.nis_dof[k], est.log_likelihood[k]))
        }
    };
    let nis = |line: &Line| line.estimate.map(|(est, k)| est.nis[k]).filter(|nis| !nis.is_nan());
    all.push(Arc::new(lines.iter().map(nis).collect::<Float64Array>()));
    all.push(Arc::new(
        lines
            .iter()
            .map(|line| stepped(line).map(|(dof, _)| i64::try_from(dof).unwrap_or(i64::MAX)))
            .collect::<Int64Array>(),
    ));
    all.push(Arc::new(
        lines.iter().map(|line| stepped(line).map(|(_, value)| value)).collect::<Float64Array>(),
    ));
    if of.gated {
        let gated =
            |line: &Line| if line.started { None } else { line.estimate.map(|(est, k)| est.gated[k]) };
        all.push(Arc::new(lines.iter().map(gated).collect::<BooleanArray>()));
    }
    if of.layout == Layout::Covariances {
        all.push(packed(lines, n));
    }
    Ok(all)
}

/// Names that are whole numbers.
fn whole<'a, T: FromStr<Err = ParseIntError>>(ids: impl Iterator<Item = &'a str>) -> Result<Vec<T>, String> {
    ids.map(|id| id.parse().map_err(|error| format!("track {id}: {error}"))).collect()
}

/// The lower triangles of the covariances, row by row.
fn packed(lines: &[Line], n: usize) -> ArrayRef {
    let size = i32::try_from(n * (n + 1) / 2).unwrap_or(i32::MAX);
    let mut lists = FixedSizeListBuilder::new(Float64Builder::new(), size);
    for line in lines {
        for i in 0..n {
            for j in 0..=i {
                lists.values().append_option(line.estimate.map(|(est, k)| est.cov(k)[i * n + j]));
            }
        }
        lists.append(line.estimate.is_some());
    }
    Arc::new(lists.finish())
}

/// Nanoseconds since 1970 of a time in RFC 3339.
pub(super) fn instant(text: &str) -> Result<i64, String> {
    let nanoseconds = Calendar::parse(text)?.nanoseconds();
    i64::try_from(nanoseconds)
        .map_err(|_| format!("{text} is beyond what nanoseconds since 1970 count: write CSV"))
}
