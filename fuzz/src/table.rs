//! The text of a table, for a model: refused with places, or rows that run and are written.

use crate::{model_file, promise};
use givens::Goal;
use givens_io::{Answer, AnswerWriter, Format, Layout, Model, Tracks, Truth, parse_tracks, parse_truth};
use std::num::NonZeroUsize;
use std::sync::OnceLock;

/// What tables are made of.
pub(crate) const WORDS: &[&str] = &[
    "time",
    "track_id",
    "sensor",
    "range",
    "bearing",
    "px",
    "u_a",
    "note",
    ",",
    "\n",
    "\r\n",
    "\"",
    "\"\"",
    "0",
    "1",
    "0.5",
    "-1",
    "1e308",
    "1e-320",
    "nan",
    "inf",
    "radar",
    "gps",
    "a",
    "b",
    "2026-03-01T12:00:00Z",
    "2026-03-01T12:00:00.5+01:00",
    "9999-12-31T23:59:59Z",
    "-009999-01-01T00:00:00Z",
    "T",
    ":",
    "Z",
    "é",
    "\u{feff}",
    "\u{0}",
    "time,px,u_a\n",
    "time,range,bearing\n",
    "1,2,0.5,1,0\n",
    " ",
    "+",
    "1e9",
    "2e9",
];

/// Models of all kinds: the first byte of an input chooses one.
const MODELS: [&str; 3] = [
    include_str!("../models/stepped.toml"),
    include_str!("../models/started.toml"),
    include_str!("../models/calendar.toml"),
];

/// The models, read once.
pub(crate) fn models() -> &'static [Model] {
    static READ: OnceLock<Vec<Model>> = OnceLock::new();
    READ.get_or_init(|| MODELS.iter().map(|text| Model::parse(text, "m.toml").expect("it is one")).collect())
}

pub(crate) fn body(data: &[u8]) {
    let models = models();
    let (which, data) = data.split_first().unwrap_or((&0, &[]));
    let model = &models[usize::from(*which) % models.len()];
    let text = &*String::from_utf8_lossy(data);
    match parse_tracks(text, "d.csv", model) {
        Err(errors) => promise::well_placed(text, &errors),
        Ok(tracks) => follow(model, &tracks, text),
    }
}

/// A truth has finite times of tracks that are there, and a column for each state that it names.
fn known(model: &Model, tracks: &Tracks, truth: &Truth) {
    let rows = truth.times.len();
    assert!(rows > 0 && truth.times.iter().all(|t| t.is_finite()));
    assert!(truth.tracks.len() == rows && truth.tracks.iter().all(|&track| track < tracks.tracks.len()));
    assert!(truth.states.len() == model.states.len());
    assert!(truth.states.iter().flatten().all(|column| column.len() == rows));
}

fn follow(model: &Model, tracks: &Tracks, text: &str) {
    let mut answers = Vec::new();
    assert!(!tracks.tracks.is_empty());
    for track in &tracks.tracks {
        assert!(!track.rows.is_empty());
        for row in track.rows.iter().map(Result::unwrap) {
            assert!(row.z.len() == model.measures() && row.u.len() == model.controls.len());
            assert!(
                row.time.is_finite() && row.time >= track.start && row.z.iter().all(|z| !z.is_infinite())
            );
            assert!(!track.time_text(row.time).is_empty());
        }
        // the last line as a time
        match track.parse_time(text.lines().last().unwrap_or("")) {
            Ok(time) => assert!(time.is_finite()),
            Err(why) => assert!(!why.is_empty()),
        }
        answers.push(match model_file::run(model, track, Goal::Filter) {
            Some((row, outcome)) => {
                Answer { estimates: outcome.estimates, row, started: false, from_first: false }
            }
            None => Answer::default(),
        });
    }
    let written = |format| {
        let mut out = Vec::new();
        let (layout, threads) = (Layout::Covariances, NonZeroUsize::new(1));
        let writer = AnswerWriter { format, layout, tracks, smoothed: false, gated: false, threads };
        // dates may be beyond what nanoseconds count
        let done = writer.write(&mut out, &answers);
        assert!(done.is_ok() || format == Format::Parquet && tracks.dated);
        out
    };
    written(Format::Parquet);
    for format in [Format::Csv, Format::Jsonl] {
        let out = String::from_utf8(written(format)).expect("it is UTF-8");
        for text in [text, &out] {
            match parse_truth(text, "t.csv", model, tracks) {
                Err(errors) => promise::well_placed(text, &errors),
                Ok(truth) => known(model, tracks, &truth),
            }
        }
        if format == Format::Jsonl {
            for line in out.lines() {
                serde_json::from_str::<serde_json::Value>(line).expect("it is JSON");
            }
        }
    }
}
