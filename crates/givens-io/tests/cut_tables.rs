//! Tables that are cut together: what they may differ in.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema};
use givens_io::Partition;
use parquet::arrow::ArrowWriter;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file of one track whose measure may be missing, or may not.
fn write(path: &Path, track: &str, z: Option<f64>, nullable: bool) {
    let fields = [
        Field::new("track_id", DataType::Utf8, false),
        Field::new("time", DataType::Float64, false),
        Field::new("z", DataType::Float64, nullable),
    ];
    let columns: Vec<ArrayRef> = vec![
        Arc::new(StringArray::from(vec![track])),
        Arc::new(Float64Array::from(vec![1.0])),
        Arc::new(Float64Array::from(vec![z])),
    ];
    let rows = RecordBatch::try_new(Arc::new(Schema::new(fields.to_vec())), columns).unwrap();
    let mut writer = ArrowWriter::try_new(File::create(path).unwrap(), rows.schema(), None).unwrap();
    writer.write(&rows).unwrap();
    writer.close().unwrap();
}

#[test]
fn what_is_missing_in_one_table_alone_is_cut_with_the_others() {
    let folder = tempfile::tempdir().unwrap();
    let tables: Vec<PathBuf> = ["a", "b"].iter().map(|name| folder.path().join(name)).collect();
    write(&tables[0], "a", Some(2.0), false);
    write(&tables[1], "b", None, true);
    let cut = Partition { by: "track_id".into(), rows: 100 };
    let done = cut.write(&tables, &folder.path().join("parts")).unwrap();
    assert_eq!((done.files, done.tracks, done.rows), (1, 2, 2));
    assert_eq!(fs::read_dir(folder.path().join("parts")).unwrap().count(), 1);
}

#[test]
fn times_name_no_tracks() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("a");
    write(&table, "a", Some(2.0), false);
    let cut = Partition { by: "time".into(), rows: 100 };
    let refused = cut.write(&[table], &folder.path().join("parts")).unwrap_err();
    assert!(refused.to_string().contains("that is the column of times"), "{refused}");
    assert!(!folder.path().join("parts").exists());
}
