//! Tables that another library lends: what their columns may hold, and what answers have of it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::UInt64Type;
use arrow_array::{
    Array, ArrayRef, Float64Array, RecordBatch, StringArray, TimestampMicrosecondArray, UInt64Array,
};
use arrow_schema::DataType;
use givens_io::{
    Answer, AnswerWriter, FailedTrack, Format, InputErrors, Layout, LentAnswers, Model, Tracks, lent_tracks,
};

const MODEL: &str = r#"
[state]
names = ["x"]
mean = [0]
std = [1]
[dynamics]
transition = ["x"]
[[sensor]]
name = "eye"
measures = { z = "x" }
std = [1]
"#;

fn table(columns: &[(&str, ArrayRef)]) -> RecordBatch {
    RecordBatch::try_from_iter(columns.iter().map(|(name, of)| (*name, Arc::clone(of)))).unwrap()
}

fn read(batch: &RecordBatch) -> Result<Tracks, InputErrors> {
    let scheme = Model::parse(MODEL, "model.toml").unwrap().scheme();
    lent_tracks(core::iter::once(Ok(batch.clone())), &batch.schema(), "the table", &scheme)
}

fn writer(tracks: &Tracks) -> AnswerWriter<'_> {
    let (format, layout) = (Format::Parquet, Layout::Wide);
    AnswerWriter { format, layout, tracks, smoothed: false, gated: false, threads: None }
}

/// The answers of the tracks that were left out.
fn refused(tracks: &Tracks) -> RecordBatch {
    let of = tracks.refused.iter().map(|of| FailedTrack { id: of.id.clone(), ..FailedTrack::default() });
    LentAnswers::new(writer(tracks), &[]).failed(&of.collect::<Vec<_>>()).unwrap()
}

fn numbers(of: &[f64]) -> ArrayRef {
    Arc::new(Float64Array::from(of.to_vec()))
}

fn type_of(batch: &RecordBatch, column: &str) -> DataType {
    batch.column_by_name(column).unwrap().data_type().clone()
}

#[test]
fn dates_are_dates_where_no_track_is_sound_and_where_there_is_no_row() {
    let dates: ArrayRef = Arc::new(TimestampMicrosecondArray::from(vec![5, 3]));
    let words: ArrayRef = Arc::new(StringArray::from(vec!["2026-03-01T12:00:01Z", "2026-03-01T12:00:00Z"]));
    for time in [dates, words] {
        let whole = table(&[("time", time), ("z", numbers(&[1.0, 2.0]))]);
        let tracks = read(&whole).unwrap();
        assert_eq!((tracks.tracks.len(), tracks.refused.len()), (0, 1));
        assert!(matches!(type_of(&refused(&tracks), "time"), DataType::Timestamp(..)));
        let none = read(&whole.slice(0, 0)).unwrap();
        assert!(matches!(type_of(&refused(&none), "time"), DataType::Timestamp(..)));
    }
    // seconds in words
    let words: ArrayRef = Arc::new(StringArray::from(vec!["1", "0"]));
    let seconds = read(&table(&[("time", words), ("z", numbers(&[1.0, 2.0]))])).unwrap();
    assert_eq!(type_of(&refused(&seconds), "time"), DataType::Float64);
}

#[test]
fn names_that_are_unsigned_stay_so() {
    let ids: ArrayRef = Arc::new(UInt64Array::from(vec![u64::MAX, 5, 5]));
    let time = numbers(&[0.0, 1.0, 0.0]);
    let batch = table(&[("track_id", Arc::clone(&ids)), ("time", time), ("z", numbers(&[1.0; 3]))]);
    let tracks = read(&batch).unwrap();
    assert_eq!(tracks.tracks.len(), 1);
    let failed = refused(&tracks);
    assert_eq!(failed.column_by_name("track_id").unwrap().as_primitive::<UInt64Type>().values(), &[5]);
    // a row before the belief has an empty line: of a table at hand, and of one that is not
    let answer = Answer { row: 1, ..Answer::default() };
    for at_hand in [&[][..], core::slice::from_ref(&batch)] {
        let lent = LentAnswers::new(writer(&tracks), at_hand);
        let rows = lent.rows(&[answer.part(&tracks.tracks[0])]).unwrap();
        let names = rows.column_by_name("track_id").unwrap();
        assert_eq!(names.as_primitive::<UInt64Type>().values(), &[u64::MAX]);
    }
}
