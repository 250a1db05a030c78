//! Tables in columns: Parquet in and out. Those that are read here were written by another program (tables/make.py).

use super::common::Folder;
use super::common::models::WALK;
use super::folder;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::record::Row;
use std::fs::{self, File};
use std::path::Path;

/// A folder with the tables.
fn with_tables(name: &str) -> Folder {
    let folder = folder(name);
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/behaviour/tables");
    for table in fs::read_dir(tables).unwrap() {
        let table = table.unwrap().path();
        fs::copy(&table, folder.path(table.file_name().unwrap().to_str().unwrap())).unwrap();
    }
    // times are dates in some, and any
    folder.write("walk.toml", &WALK.replace("time = 0\n", "").replace("step = 1\n", ""));
    folder
}

/// The rows of a Parquet file, as another reader of the crate shows them, and the names and types of its columns.
fn written(folder: &Folder, name: &str) -> (Vec<String>, Vec<Row>) {
    let file = File::open(folder.path(name)).unwrap();
    let schema =
        ParquetRecordBatchReaderBuilder::try_new(file.try_clone().unwrap()).unwrap().schema().clone();
    let columns = schema.fields().iter().map(|field| format!("{}: {}", field.name(), field.data_type()));
    let columns = columns.collect();
    let reader = parquet::file::reader::SerializedFileReader::new(file).unwrap();
    (columns, reader.into_iter().map(Result::unwrap).collect())
}

#[test]
fn dates_names_and_numbers_are_those_of_the_csv() {
    let folder = with_tables("columns");
    for name in ["dates", "whole"] {
        let text = folder.run(&format!("smooth walk.toml {name}.csv")).good();
        let columns = folder.run(&format!("smooth walk.toml {name}.parquet")).good();
        assert_eq!(columns.stdout, text.stdout, "{name}");
        let note = columns.stderr.contains("column not used by the model: note");
        assert_eq!(note, name == "dates", "{}", columns.stderr);
    }
}

#[test]
fn what_is_wrong_with_a_table_is_told_by_row_and_column() {
    let folder = with_tables("wrong");
    let told = |name: &str| {
        let found = folder.run(&format!("filter walk.toml {name}"));
        assert_eq!((found.code, found.stdout.as_str()), (2, ""), "{name}");
        found.stderr
    };
    let wrong = told("wrong.parquet");
    assert!(wrong.contains("wrong.parquet: row 2: inf in `z` is not a finite number"), "{wrong}");
    assert!(wrong.contains("row 3: the row at 0.5 stands after the row at 1 (row 2)"), "{wrong}");
    let lists = told("lists.parquet");
    assert!(
        lists.contains("lists.parquet: `z` holds List(") && lists.contains("cast it to float64"),
        "{lists}"
    );
    assert_eq!(lists.matches("error:").count(), 1, "{lists}");
    let bytes = fs::read(folder.path("dates.parquet")).unwrap();
    fs::write(folder.path("cut.parquet"), &bytes[..bytes.len() / 2]).unwrap();
    let cut = told("cut.parquet");
    assert!(cut.contains("cut.parquet: this Parquet file cannot be read") && cut.contains("help:"), "{cut}");
    let floats = told("float_ids.parquet");
    assert!(
        floats.contains("float_ids.parquet: `track_id` holds Float64") && floats.contains("cast it to int64"),
        "{floats}"
    );
    // a bit of its footer was turned: a chunk begins before the file
    let damaged = told("damaged.parquet");
    assert!(damaged.contains("damaged.parquet: this Parquet file cannot be read"), "{damaged}");
    let gzip = told("gzip.parquet");
    assert!(gzip.contains("gzip.parquet: `z` is compressed by gzip\n  help: write it anew"), "{gzip}");
    let cut = folder.run("partition gzip.parquet --by track_id -o gzip");
    assert!(cut.code == 2 && cut.stderr.contains("is compressed by gzip"), "{}", cut.stderr);
    let other = folder.run("filter model.toml dates.parquet");
    assert!(other.stderr.contains("dates.parquet:1:1: the table has no"), "{}", other.stderr);
    assert!(other.stderr.contains("1 | time,track_id,z,note"), "{}", other.stderr);
}

#[test]
fn answers_are_the_columns_of_the_csv() {
    let folder = with_tables("answers");
    folder.run("smooth walk.toml whole.csv -o answers.parquet").good();
    let text = folder.run("smooth walk.toml whole.csv").good().cells();
    let (columns, rows) = written(&folder, "answers.parquet");
    let names: Vec<&str> = columns.iter().map(|column| column.split(':').next().unwrap()).collect();
    assert_eq!(names, text[0]);
    assert_eq!(rows.len(), text.len() - 1);
    for (row, cells) in rows.iter().zip(&text[1..]) {
        for ((_, value), cell) in row.get_column_iter().zip(cells) {
            let value = value.to_string();
            match value.parse::<f64>() {
                Ok(number) => assert_eq!(number, cell.parse::<f64>().unwrap(), "{cell}"),
                _ => assert_eq!(value.trim_matches('"').replace("null", ""), *cell),
            }
        }
    }
}

#[test]
fn dates_and_whole_names_stay_what_they_are() {
    let folder = with_tables("kinds");
    folder.run("filter walk.toml dates.parquet -o dates-out.parquet").good();
    folder.run("filter walk.toml whole.parquet -o whole-out.parquet").good();
    let (columns, rows) = written(&folder, "dates-out.parquet");
    assert_eq!(columns[..2], ["time: Timestamp(ns, \"UTC\")", "track_id: Utf8"]);
    // 2026-03-01T12:00:02.25Z
    assert!(rows[3].to_string().contains("1772366402250000000"), "{}", rows[3]);
    let (columns, rows) = written(&folder, "whole-out.parquet");
    assert_eq!(columns[..2], ["time: Float64", "track_id: Int64"]);
    assert!(rows[1].to_string().starts_with("{time: 0E0, track_id: 12, x: 1.59999"), "{}", rows[1]);
}

#[test]
fn covariances_are_lower_triangles_and_the_tidy_layout_has_a_row_for_each_state() {
    let folder = with_tables("layouts");
    folder.run("filter model.toml data.csv -o cov.parquet --layout covariances").good();
    folder.run("filter model.toml data.csv -o tidy.parquet --layout tidy").good();
    let lines = folder.run("filter model.toml data.csv --format jsonl").good().stdout;
    let lines: Vec<serde_json::Value> =
        lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let n = lines[0]["mean"].as_array().unwrap().len();
    let (columns, rows) = written(&folder, "cov.parquet");
    assert!(columns.last().unwrap().starts_with("cov: FixedSizeList("), "{columns:?}");
    for (row, line) in rows.iter().zip(&lines) {
        let cov = line["cov"].as_array().unwrap();
        let expected: Vec<f64> = (0..n)
            .flat_map(|i| (0..=i).map(move |j| (i, j)))
            .map(|(i, j)| cov[i][j].as_f64().unwrap())
            .collect();
        let found = row.get_column_iter().last().unwrap().1.to_string();
        let found: Vec<f64> =
            found.trim_matches(['[', ']']).split(", ").map(|number| number.parse().unwrap()).collect();
        assert_eq!(found, expected);
    }
    let (columns, rows) = written(&folder, "tidy.parquet");
    let names: Vec<&str> = columns.iter().map(|column| column.split(':').next().unwrap()).collect();
    assert_eq!(names[names.len() - 3..], ["state", "mean", "std"]);
    assert_eq!(rows.len(), n * lines.len());
    for (k, row) in rows.iter().enumerate() {
        let (line, i) = (&lines[k / n], k % n);
        let values: Vec<String> = row.get_column_iter().map(|(_, value)| value.to_string()).collect();
        let [mean, std] = [values.len() - 2, values.len() - 1].map(|at| values[at].parse::<f64>().unwrap());
        assert_eq!(mean, line["mean"][i].as_f64().unwrap());
        assert_eq!(std, line["cov"][i][i].as_f64().unwrap().sqrt());
    }
}

#[test]
fn a_layout_is_for_parquet_and_a_parquet_file_is_not_gone_on_with() {
    let folder = with_tables("refused");
    let layout = folder.run("filter walk.toml whole.csv -o out.csv --layout tidy");
    assert!(layout.code == 2 && layout.stderr.contains("--layout is for Parquet"), "{}", layout.stderr);
    folder.write("cov.toml", &WALK.replace("\"x\"", "\"cov\""));
    folder.write("cov.csv", "time,z\n1,2\n");
    let cov = folder.run("filter cov.toml cov.csv -o cov.parquet --layout covariances");
    assert!(cov.code == 2 && cov.stderr.contains("the state `cov` and the covariances"), "{}", cov.stderr);
    folder.run("filter cov.toml cov.csv -o cov.parquet").good();
    let resume = folder.run("filter walk.toml whole.csv -o out.parquet --resume");
    assert!(resume.code == 2 && resume.stderr.contains("cannot be gone on with"), "{}", resume.stderr);
    let standard = folder.run("filter walk.toml whole.csv --format parquet -o out").good();
    assert_eq!(standard.stdout, "");
    assert_eq!(written(&folder, "out").1.len(), 6);
}
