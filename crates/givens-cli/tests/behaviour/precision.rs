//! `precision = "f32"`: honoured wherever it is set, told, and refused where it cannot be.

use super::common::models::{DATA, MODEL, OSCILLATOR};
use super::common::objects;
use super::folder;
use serde_json::Value;

fn means(rows: &[Value]) -> Vec<f64> {
    rows.iter().flat_map(|row| row["mean"].as_array().unwrap()).map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn the_file_and_the_command_line_set_it_alike_for_every_command() {
    let folder = folder("alike");
    folder.write("single.toml", &format!("{MODEL}precision = \"f32\"\n"));
    for command in ["filter", "smooth", "smooth --lag 2", "smooth --point 2", "filter --at every:0.5"] {
        let run = |rest: &str| {
            let (name, options) = command.split_once(' ').unwrap_or((command, ""));
            folder.run(&format!("{name} {rest} data.csv {options} --format jsonl")).good()
        };
        let of_file = run("single.toml");
        assert_eq!(of_file.stdout, run("model.toml --set precision=f32").stdout, "{command}");
        let double = run("single.toml --set precision=f64");
        assert_eq!(double.stdout, run("model.toml").stdout, "{command}");
        let (single, double) = (means(&objects(&of_file.stdout)), means(&objects(&double.stdout)));
        assert!(single.iter().all(|&x| f64::from(x as f32) == x), "{command}");
        let off = single.iter().zip(&double).map(|(a, b)| (a - b).abs() / b.abs().max(1.0));
        let off = off.fold(0.0, f64::max);
        assert!(off > 0.0 && off < 1e-4, "{command}: {off:e}");
    }
    let checked = folder.run("check single.toml").good();
    assert!(checked.stdout.contains("precision f32"), "{}", checked.stdout);
    assert!(folder.run("methods").good().stdout.contains("precision"));
}

#[test]
fn many_tracks_come_out_alike_for_any_number_of_threads() {
    let folder = folder("tracks");
    let rows = |track: usize| {
        let row = move |line: &str| {
            let (time, rest) = line.split_once(',').unwrap();
            format!("{time},{track},{rest}\n")
        };
        DATA.lines().skip(1).map(row).collect::<String>()
    };
    let tracks: String = (0..11).map(rows).collect();
    folder.write("tracks.csv", &format!("time,track_id,range,bearing,px,py\n{tracks}"));
    let run = |rest: &str| {
        folder.run(&format!("smooth model.toml {rest} --set precision=f32 --format jsonl")).good().stdout
    };
    let one = run("tracks.csv --threads 1");
    assert_eq!(one, run("tracks.csv --threads 3"));
    let (alone, packed) = (means(&objects(&run("data.csv"))), means(&objects(&one)));
    for track in packed.chunks_exact(alone.len()) {
        assert!(track.iter().zip(&alone).all(|(a, b)| (a - b).abs() < 1e-4 * b.abs().max(1.0)));
    }
}

#[test]
fn what_f32_cannot_keep_is_told_with_its_name_and_the_way_out() {
    let folder = folder("beyond");
    folder.write("far.toml", &MODEL.replace("mean = [30,", "mean = [3e39,"));
    let far = folder.run("filter far.toml data.csv --set precision=f32 -o out.csv");
    assert_eq!(far.code, 1, "{}", far.stderr);
    for part in ["`x`, 3e39, is beyond what f32 can keep", "choose other units", "--set precision=f64"] {
        assert!(far.stderr.contains(part), "{part}: {}", far.stderr);
    }
    folder.write(
        "osc.toml",
        &format!("{OSCILLATOR}[filter]\nmethod = \"sr-cd-ckf2\"\nrtol = 1e-9\nprecision = \"f32\"\n"),
    );
    folder.write("osc.csv", "time,z\n1,0.5\n");
    let fine = folder.run("filter osc.toml osc.csv");
    assert_eq!(fine.code, 2);
    assert!(
        fine.stderr.contains("osc.toml:20:1: rtol = 1e-9: must be at least 1e-6 in f32"),
        "{}",
        fine.stderr
    );
    folder.run("filter osc.toml osc.csv --set rtol=1e-5").good();
}
