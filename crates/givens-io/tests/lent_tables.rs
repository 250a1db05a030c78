//! Tables that another library lends: what their columns may hold, and what answers have of it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::UInt64Type;
use arrow_array::{
    Array, ArrayRef, Float64Array, RecordBatch, StringArray, TimestampMicrosecondArray, UInt64Array,
};
use arrow_schema::{DataType, Field, Schema};
use givens_io::{
    Answer, AnswerWriter, FailedTrack, Format, InputErrors, Layout, LentAnswers, Model, Tracks, lent_tracks,
    parse_tracks,
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
fn a_column_of_a_type_that_cannot_serve_is_one_error_with_its_remedy() {
    let words = || -> ArrayRef { Arc::new(StringArray::from(vec!["1", "2"])) };
    let dates = || -> ArrayRef { Arc::new(TimestampMicrosecondArray::from(vec![5, 3])) };
    let nulls = || arrow_array::new_null_array(&DataType::Null, 2);
    let flags = || -> ArrayRef { Arc::new(arrow_array::BinaryArray::from(vec![&b"1"[..], &b"2"[..]])) };
    for (column, of, said) in [
        ("z", words(), "`z` holds Utf8\n  help: measures and controls are numbers, null where there is none"),
        ("z", dates(), "`z` holds Timestamp(µs)\n  help: measures and controls are numbers"),
        (
            "time",
            flags(),
            "`time` holds Binary\n  help: times are seconds, dates, or words in RFC 3339: cast",
        ),
        ("track_id", numbers(&[1.0, 1.0]), "`track_id` holds Float64\n  help: tracks are named by words or"),
        ("track_id", nulls(), "`track_id` holds Null\n  help: give each row the name of its track, or leave"),
        (
            "sensor",
            numbers(&[1.0, 1.0]),
            "`sensor` holds Float64\n  help: sensors are named by words: cast it",
        ),
    ] {
        let usual = [("time", numbers(&[0.0, 1.0])), ("z", numbers(&[1.0, 2.0]))];
        let mut columns: Vec<_> = usual.into_iter().filter(|(name, _)| *name != column).collect();
        columns.push((column, of));
        let told = read(&table(&columns)).unwrap_err();
        assert_eq!((told.errors.len(), told.more), (1, 0), "{told}");
        assert!(told.to_string().starts_with(&format!("the table: {said}")), "{told}");
    }
    // a table may have no measure at all, and rows that name no sensor
    let none = read(&table(&[("time", numbers(&[0.0, 1.0])), ("z", nulls()), ("sensor", nulls())])).unwrap();
    assert!(none.refused.is_empty() && !none.tracks[0].rows.first().unwrap().measured());
}

#[test]
fn a_column_that_nobody_reads_may_stand_twice() {
    let names = ["time", "note", "z", "note", ""];
    let fields = names.map(|name| Field::new(name, DataType::Float64, true));
    let columns = [[0.0, 1.0], [7.0, 7.0], [1.0, 2.0], [8.0, 8.0], [9.0, 9.0]].map(|of| numbers(&of));
    let twice = RecordBatch::try_new(Arc::new(Schema::new(fields.to_vec())), columns.to_vec()).unwrap();
    let tracks = read(&twice).unwrap();
    assert_eq!(tracks.tracks[0].rows.last().unwrap().z, [2.0]);
    let text = parse_tracks("time,a,z,a\n1,2,3,4\n", "t.csv", &Model::parse(MODEL, "model.toml").unwrap());
    assert_eq!(text.unwrap().tracks[0].rows.last().unwrap().z, [3.0]);
    let fields: Vec<_> = ["time", "z", "z"].map(|name| Field::new(name, DataType::Float64, true)).into();
    let columns = columns[..3].to_vec();
    let told = read(&RecordBatch::try_new(Arc::new(Schema::new(fields)), columns).unwrap()).unwrap_err();
    assert!(told.to_string().contains("the column `z` stands twice"), "{told}");
}

#[test]
fn rows_of_a_table_in_columns_are_called_so() {
    let told = |times: &[f64]| {
        let table = table(&[("time", numbers(times)), ("z", numbers(&vec![1.0; times.len()]))]);
        read(&table).unwrap().refused.remove(0).message
    };
    assert!(
        told(&[0.0, 2.0, 1.0]).contains("stands after the row at 2 (row 2)"),
        "{}",
        told(&[0.0, 2.0, 1.0])
    );
    assert!(told(&[0.0, 2.0, 2.0]).contains("this one and row 2"), "{}", told(&[0.0, 2.0, 2.0]));
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
