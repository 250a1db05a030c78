//! Claims about whole figures.

use proptest::prelude::*;

use super::gallery::{self, Noise};
use super::track::{NisSeries, PlaneTrack, StateSeries, Track, TrackFigure};
use super::{Axis, Block, Colour, Figure, FigureError, Grid, Mark, Panel, Scale, Shape, png, svg, write};

fn without_truth(mut track: Track) -> Track {
    track.states.iter_mut().for_each(|s| s.truth = None);
    if let Some(plane) = &mut track.plane {
        plane.truth = None;
    }
    track
}

/// Figures of every arrangement, by name.
fn scenes() -> Vec<(&'static str, TrackFigure)> {
    let turn = gallery::turn("A1", 180, 7);
    let bare = without_truth(turn.clone());
    let mut few = bare.clone();
    few.states.truncate(2);
    let mut outlier = turn.clone();
    if let Some(nis) = &mut outlier.nis {
        nis.nis[50] = 900.0;
        nis.nis[90] = f64::NAN;
        nis.upper[100..130].fill(9.348);
    }
    outlier.states[0].mean[60..80].fill(f64::NAN);
    let mut many = turn.clone();
    many.states =
        (0..12).map(|i| StateSeries { name: format!("x{i}"), ..turn.states[i % 5].clone() }).collect();
    let mut lorenz = bare.clone();
    lorenz.plane = None;
    lorenz.states =
        (0..40).map(|i| StateSeries { name: format!("x{i}"), ..bare.states[i % 5].clone() }).collect();
    let mut no_plane = turn.clone();
    no_plane.plane = None;
    let mut flat = turn.clone();
    if let Some(plane) = &mut flat.plane {
        let squash = |p: &mut [f64; 2]| p[1] *= 0.1;
        plane.estimate.iter_mut().for_each(squash);
        plane.measurements.iter_mut().for_each(squash);
        plane.truth.iter_mut().flatten().for_each(squash);
        plane.covariance.iter_mut().for_each(|c| *c = [c[0], 0.1 * c[1], 0.01 * c[2]]);
    }
    let mut smooth = turn.clone();
    if let Some(plane) = &mut smooth.plane {
        plane.filtered = Some(plane.estimate.clone());
        plane.estimate.clone_from(plane.truth.as_ref().unwrap());
    }
    for state in &mut smooth.states {
        state.filtered = Some(state.mean.clone());
        state.mean.clone_from(state.truth.as_ref().unwrap());
    }
    let fleet: Vec<Track> =
        (0..3).map(|i| gallery::turn(&format!("A{i}"), 60 + 30 * i as usize, i + 3)).collect();
    let mut noise = Noise(3);
    let long = StateSeries {
        name: "speed (m/s)".into(),
        time: (0..100_000).map(|i| 1.7e9 + f64::from(i)).collect(),
        mean: (0..100_000).map(|i| 1e4 * (f64::from(i) / 9e3).sin() + 100.0 * noise.next()).collect(),
        std: vec![900.0; 100_000],
        ..StateSeries::default()
    };
    let dense = NisSeries {
        time: long.time.clone(),
        nis: (0..100_000).map(|_| noise.next().powi(2) + noise.next().powi(2)).collect(),
        lower: vec![0.0506; 100_000],
        upper: vec![7.378; 100_000],
    };
    let of = |track: Track| gallery::figure(vec![track]);
    vec![
        ("turn", of(turn)),
        ("turn_without_truth", of(bare)),
        ("two_states", of(few)),
        ("outlier_and_gap", of(outlier)),
        ("twelve_states", of(many)),
        ("forty_states", of(lorenz)),
        ("no_plane", of(no_plane)),
        ("flat", of(flat)),
        ("smoothed", TrackFigure { smoothed: true, ..of(smooth) }),
        ("fleet", gallery::figure(fleet)),
        ("long", of(Track { states: vec![long], nis: Some(dense), ..Track::default() })),
        ("empty", of(Track::default())),
    ]
}

#[test]
#[ignore = "draws every scene into the folder GIVENS_GALLERY, to look at"]
fn draw_the_gallery() {
    let folder = std::path::PathBuf::from(std::env::var_os("GIVENS_GALLERY").unwrap());
    for (name, scene) in scenes() {
        let figure = scene.figure();
        write(folder.join(format!("{name}.png")), &figure).unwrap();
        write(folder.join(format!("{name}.svg")), &figure).unwrap();
    }
}
