//! Tables in columns: any types, any values, and Parquet files of them with bytes that were changed.

use crate::bytes::Bytes;
use crate::model_file;
use arrow_array::types::Int32Type;
use arrow_array::{
    ArrayRef, BooleanArray, Date32Array, DictionaryArray, DurationMillisecondArray, Float32Array,
    Float64Array, Int32Array, Int64Array, RecordBatch, StringArray, TimestampMicrosecondArray,
    TimestampNanosecondArray, TimestampSecondArray, UInt64Array,
};
use givens::Goal;
use givens_io::{
    Answer, AnswerWriter, Format, Layout, LentAnswers, Model, Tracks, lent_tracks, read_tracks,
    read_tracks_apart,
};
use parquet::arrow::ArrowWriter;
use std::fs::File;
use std::io::{Seek, Write};
use std::num::NonZeroUsize;
use std::sync::Arc;

/// Words in columns of words.
const WORDS: [&str; 14] = [
    "a",
    "b",
    "",
    " a ",
    "radar",
    "gps",
    "7",
    "1.5",
    "nan",
    "2026-03-01T12:00:00Z",
    "-009999-01-01T00:00:00Z",
    "9999-12-31T23:59:59Z",
    "é",
    "\u{0}",
];

pub(crate) fn body(data: &[u8]) {
    let bytes = &mut Bytes(data);
    let models = crate::table::models();
    let model = &models[bytes.below(models.len())];
    let damaged = bytes.below(3) == 2;
    let batches = table(bytes, model);
    let schema = batches[0].schema();
    let scheme = model.scheme();
    if damaged {
        return file(bytes, model, &batches);
    }
    match lent_tracks(batches.iter().cloned().map(Ok), &schema, "a table", &scheme) {
        Err(errors) => assert!(!errors.to_string().is_empty()),
        Ok(tracks) => follow(model, &tracks, &batches),
    }
}

/// Up to three batches of up to five rows, with the columns that the model knows, most of the time.
fn table(bytes: &mut Bytes, model: &Model) -> Vec<RecordBatch> {
    let mut names = vec!["time".to_owned()];
    names.extend(bytes.flag().then(|| "track_id".to_owned()));
    names.extend(bytes.flag().then(|| "sensor".to_owned()));
    names.extend(model.sensors.iter().flat_map(|sensor| sensor.columns.clone()));
    names.extend(model.controls.clone());
    names.dedup();
    if bytes.below(16) == 15 {
        names.swap_remove(0);
    }
    let kinds: Vec<usize> = names.iter().map(|name| kind(bytes, name)).collect();
    let batches = 1 + bytes.below(3);
    let mut first = 0;
    let mut all: Vec<RecordBatch> = Vec::new();
    for _ in 0..batches {
        let rows = bytes.below(6);
        let columns = names.iter().zip(&kinds);
        let columns =
            columns.map(|(name, &kind)| (name.as_str(), column(bytes, name, kind, first, rows), true));
        let batch = RecordBatch::try_from_iter_with_nullable(columns).expect("columns of one length");
        first += rows;
        all.push(batch);
    }
    all
}

/// The type of a column: a usual one for its name, most of the time.
fn kind(bytes: &mut Bytes, name: &str) -> usize {
    match (name, bytes.byte()) {
        (_, any) if any >= 200 => usize::from(any) % 14,
        ("track_id" | "sensor", any) => [5, 5, 3, 9][usize::from(any) % 4],
        ("time", any) => [0, 0, 6, 7][usize::from(any) % 4],
        _ => 0,
    }
}

fn column(bytes: &mut Bytes, name: &str, kind: usize, first: usize, rows: usize) -> ArrayRef {
    let mut number = |k: usize| match (name, bytes.byte()) {
        (_, 255) => None,
        (_, 240..) => Some(bytes.number()),
        ("time", plain) => Some((first + k) as f64 * 0.5 + f64::from(plain % 2) * 0.5),
        ("track_id", plain) => Some(f64::from(plain % 3)),
        (_, plain) => Some(f64::from(plain) / 16.0),
    };
    let numbers: Vec<Option<f64>> = (0..rows).map(&mut number).collect();
    let whole = || numbers.iter().map(|x| x.map(|x| x as i64));
    let word = |x: f64| WORDS[x.abs() as usize % WORDS.len()];
    let words = || numbers.iter().map(|x| x.map(word));
    match kind {
        0 => Arc::new(numbers.iter().copied().collect::<Float64Array>()),
        1 => Arc::new(numbers.iter().map(|x| x.map(|x| x as f32)).collect::<Float32Array>()),
        2 => Arc::new(numbers.iter().map(|x| x.map(|x| x as i32)).collect::<Int32Array>()),
        3 => Arc::new(whole().collect::<Int64Array>()),
        4 => Arc::new(numbers.iter().map(|x| x.map(|x| x as u64)).collect::<UInt64Array>()),
        5 => Arc::new(words().collect::<StringArray>()),
        6 => Arc::new(whole().collect::<TimestampSecondArray>().with_timezone("UTC")),
        7 => Arc::new(whole().collect::<TimestampNanosecondArray>()),
        8 => Arc::new(whole().collect::<TimestampMicrosecondArray>().with_timezone("+02:00")),
        9 => Arc::new(words().collect::<DictionaryArray<Int32Type>>()),
        10 => Arc::new(numbers.iter().map(|x| x.map(|x| x as i32)).collect::<Date32Array>()),
        11 => Arc::new(whole().collect::<DurationMillisecondArray>()),
        12 => Arc::new(numbers.iter().map(|x| x.map(|x| x > 1.0)).collect::<BooleanArray>()),
        _ => arrow_array::new_null_array(&arrow_schema::DataType::Null, rows),
    }
}

/// Answers in columns have a line for each row that is not refused.
fn follow(model: &Model, tracks: &Tracks, batches: &[RecordBatch]) {
    let (mut answers, mut lines) = (Vec::new(), 0);
    for track in &tracks.tracks {
        assert!(!track.rows.is_empty());
        let rows = track.rows.read(0..track.rows.len()).expect("they are in memory");
        let mut last = track.start;
        for row in rows.iter() {
            assert!(row.time.is_finite() && row.time >= last && row.z.iter().all(|z| !z.is_infinite()));
            last = row.time;
        }
        let run = model_file::run(model, track, Goal::Interval);
        answers.push(run.map_or_else(Answer::default, |(row, outcome)| {
            lines += row + outcome.estimates.len();
            Answer { estimates: outcome.estimates, row, started: false, from_first: false }
        }));
    }
    for refused in &tracks.refused {
        assert!(!refused.message.is_empty());
        let left = tracks.tracks.iter().all(|track| refused.id.is_none() || track.id != refused.id);
        assert!(left, "{refused:?}");
    }
    let (format, threads) = (Format::Parquet, NonZeroUsize::new(1));
    let by = AnswerWriter { format, layout: Layout::Wide, tracks, smoothed: true, gated: false, threads };
    let lent = LentAnswers::new(by, batches);
    let parts: Vec<_> =
        tracks.tracks.iter().zip(&answers).map(|(track, answer)| answer.part(track)).collect();
    match lent.rows(&parts) {
        Ok(batch) => assert_eq!(batch.num_rows(), lines),
        // beyond what nanoseconds count
        Err(error) => assert!(tracks.dated, "{error}"),
    }
}

/// A Parquet file of which some bytes are others: refused in words, or a table.
fn file(bytes: &mut Bytes, model: &Model, batches: &[RecordBatch]) {
    let mut writer = ArrowWriter::try_new(Vec::new(), batches[0].schema(), None).expect("a writer");
    // of some types there are no files
    if batches.iter().any(|batch| writer.write(batch).is_err()) {
        return;
    }
    let Ok(mut written) = writer.into_inner() else { return };
    let length = written.len();
    for _ in 0..bytes.below(6) {
        let at = (bytes.word() % length as u64) as usize;
        // most of what a reader believes stands at the end
        let at = if bytes.flag() { length - 1 - at % length.min(600) } else { at };
        written[at] = bytes.byte();
    }
    if bytes.below(16) == 15 {
        written.truncate((bytes.word() % length as u64) as usize);
    }
    let path = std::env::temp_dir().join(format!("givens-fuzz-{}.parquet", std::process::id()));
    let mut file = File::create(&path).expect("a temporary file");
    file.write_all(&written).and_then(|()| file.rewind()).expect("a temporary file");
    let name = path.to_str().expect("words");
    let (apart, whole) = (read_tracks_apart(name, &model.scheme()), read_tracks(name, model));
    let _ = std::fs::remove_file(&path);
    match whole {
        Err(errors) => assert!(!errors.to_string().is_empty()),
        Ok(tracks) => {
            assert!(!tracks.tracks.is_empty());
            // what is read as a whole has no track that is refused
            assert!(
                apart
                    .is_ok_and(|apart| apart.refused.is_empty() && apart.tracks.len() == tracks.tracks.len())
            );
        }
    }
}
