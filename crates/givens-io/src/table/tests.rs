//! A table is the same, whatever is in memory of it at once.

use super::chunks::{Chunks, USUAL};
use super::reading::{HELD, How, tracks};
use super::{Row, Tracks};
use crate::error::InputErrors;
use crate::model_file::Model;
use proptest::prelude::*;

const MODEL: &str = r#"
[state]
names = ["x", "v"]
mean  = [0, 0]
std   = [1, 1]
[dynamics]
step = 0.5
transition = { x = "x + dt*v", v = "v" }
noise_cov  = [[0, 0], [0, 1]]
[[sensor]]
name     = "position"
measures = { px = "x" }
std      = { px = 1 }
[[sensor]]
name     = "speed"
measures = { pv = "v" }
std      = { pv = 1 }
"#;

fn read(text: &str, size: usize, held: usize) -> Result<Tracks, InputErrors> {
    let model = Model::parse(MODEL, "model").unwrap();
    let how = How { held, ..How::default() };
    tracks(Chunks::new("data", &mut text.as_bytes(), size), "data", &model.scheme(), how)
}

/// All that is known of a table.
fn all(tracks: &Tracks) -> impl PartialEq + core::fmt::Debug {
    let of = tracks.tracks.iter().map(|track| {
        let rows: Vec<Row> = track.rows.iter().map(|row| row.unwrap().into_owned()).collect();
        // NaN is not equal to itself
        (track.id.clone(), track.start, format!("{rows:?}"), rows.len() == track.rows.len())
    });
    let ranges = tracks.ranges.clone();
    (of.collect::<Vec<_>>(), tracks.ignored.clone(), tracks.has_track_id, ranges, tracks.fingerprint.clone())
}

/// Rows of tables, right and wrong, with all that may stand between quotation marks.
fn line() -> impl Strategy<Value = String> {
    let id = prop_oneof![
        Just("\u{feff}a"),
        Just("a"),
        Just("b"),
        Just("\"a\""),
        Just("\"two\nlines\""),
        Just("5\" pipe"),
        Just("\"a \"\"b\"\"\""),
        Just("π")
    ];
    let number = prop_oneof![
        4 => (0..40).prop_map(|x| (f64::from(x) / 2.0).to_string()),
        1 => Just(String::new()),
        1 => Just("x".to_owned()),
        1 => Just("1e999".to_owned()),
    ];
    let end = prop_oneof![Just("\n"), Just("\r\n"), Just("\n\n"), Just("\"\n"), Just(",\n"), Just("")];
    (id, number.clone(), number, end).prop_map(|(id, time, z, end)| format!("{id},{time},{z},{end}"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn stretches_of_any_length_are_the_whole(
        lines in proptest::collection::vec(line(), 0..12), sorted in any::<bool>(), size in 1..40_usize, held in 1..6_usize,
    ) {
        let mut text = String::from("\u{feff}track_id,time,px,\"a\nb\"\n");
        if sorted {
            text.extend((0..12).map(|k| format!("{},{},{k},\n", ["a", "π", "\"b\n\""][k % 3], k / 2)));
        }
        text.extend(lines);
        let (whole, apart) = (read(&text, USUAL, HELD), read(&text, size, held));
        let all = |read: Result<Tracks, _>| read.map(|tracks| format!("{:?}", all(&tracks)));
        prop_assert_eq!(all(whole), all(apart));
    }
}

#[test]
fn rows_on_the_disk_are_read_as_they_were_written() {
    let mut text = String::from("time,px\n");
    text.extend((0..10_000).map(|k| format!("{},{k}\n", f64::from(k) / 2.0)));
    let (whole, spooled) = (read(&text, USUAL, HELD).unwrap(), read(&text, 1000, 4500).unwrap());
    let (whole, spooled) = (&whole.tracks[0].rows, &spooled.tracks[0].rows);
    for range in [
        0..3,
        4094..4098,
        4498..4502,
        8990..9010,
        9999..10_000,
        9000..20_000,
        7..7,
        12_000..12_001,
        0..10_000,
    ] {
        let bits = |rows: &[Row]| format!("{rows:?}");
        assert_eq!(bits(&whole.read(range.clone()).unwrap()), bits(&spooled.read(range).unwrap()));
    }
    assert_eq!(spooled.row(5000).unwrap().unwrap().z[0], 5000.0);
    assert_eq!(
        (spooled.before(2500.0).unwrap(), spooled.before(-1.0).unwrap(), spooled.before(1e9).unwrap()),
        (5000, 0, 10_000)
    );
    assert_eq!(
        (spooled.first().unwrap().line, spooled.last().unwrap().line, spooled.len()),
        (2, 10_001, 10_000)
    );
}

#[test]
fn a_character_that_is_no_text_is_told_by_its_line() {
    let model = Model::parse(MODEL, "model").unwrap();
    let mut text = b"time,px\n".to_vec();
    (0..50).for_each(|k| text.extend(format!("{k},1\n").bytes()));
    text.extend(b"50,\xff1\n51,1\n");
    let told =
        tracks(Chunks::new("data", &mut &text[..], 16), "data", &model.scheme(), How::default()).unwrap_err();
    assert!(told.to_string().starts_with("data:52:4: this is not UTF-8 text"), "{told}");
}
