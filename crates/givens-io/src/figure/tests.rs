//! Claims about whole figures.

use super::gallery::{self, Noise};
use super::track::{NisSeries, StateSeries, Track, TrackFigure};
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
        all: None,
        gated: Vec::new(),
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

#[test]
fn every_scene_is_well_formed_svg_whose_references_resolve() {
    for (name, scene) in scenes() {
        let text = svg(&scene.figure());
        let document = roxmltree::Document::parse(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let ids: Vec<&str> = document.descendants().filter_map(|n| n.attribute("id")).collect();
        for node in document.descendants().filter(|n| n.has_tag_name("use")) {
            let target = node.attribute(("http://www.w3.org/1999/xlink", "href")).unwrap();
            assert!(ids.contains(&target.trim_start_matches('#')), "{name}: {target}");
        }
        for clip in document.descendants().filter_map(|n| n.attribute("clip-path")) {
            let id = clip.trim_start_matches("url(#").trim_end_matches(')');
            assert!(ids.contains(&id), "{name}: {clip}");
        }
        assert!(!text.contains("NaN") && !text.contains("inf\""), "{name} holds a number that is none");
    }
}

#[test]
fn the_same_figure_gives_the_same_bytes() {
    let figure = || gallery::figure(vec![gallery::turn("A1", 90, 5)]).figure();
    assert_eq!(svg(&figure()), svg(&figure()));
    assert_eq!(png(&figure()).unwrap(), png(&figure()).unwrap());
}

pub(super) fn one_panel(panel: Panel, width: f64, height: f64) -> Figure {
    let grid = Grid { columns: vec![1.0], rows: vec![1.0], cells: vec![Some(panel)] };
    Figure { title: String::new(), notes: vec![], key: false, body: Block::Grid(grid), width, height }
}

/// Width and height that a PNG tells in its first chunk.
fn png_size(bytes: &[u8]) -> [u32; 2] {
    [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
}

#[test]
fn a_png_has_two_pixels_for_each_of_the_figure() {
    let bytes = png(&one_panel(Panel::default(), 640.0, 300.0)).unwrap();
    assert_eq!(&bytes[1..4], b"PNG");
    // Above the panels stands the upper edge of the page, below them the lower one.
    assert_eq!(png_size(&bytes), [1280, 2 * (300 + 36)]);
}

#[test]
fn a_huge_figure_is_drawn_coarser_not_refused() {
    let [w, h] = png_size(&png(&one_panel(Panel::default(), 1e9, 1e9)).unwrap());
    assert!(u64::from(w) * u64::from(h) < 81_000_000, "{w} × {h}");
}

#[test]
fn errors_say_what_to_do() {
    let figure = one_panel(Panel::default(), 300.0, 200.0);
    for (path, says) in [
        ("track.pdf", "“.pdf” is none; name it with .svg or .png"),
        ("track", "its name has no extension; name it with .svg or .png"),
    ] {
        let error = write(path, &figure).unwrap_err();
        assert!(matches!(error, FigureError::Format { .. }) && error.to_string().ends_with(says), "{error}");
    }
    let error = write("no/such/folder/track.svg", &figure).unwrap_err().to_string();
    assert!(
        error.contains("no/such/folder/track.svg") && error.ends_with("make its folder first"),
        "{error}"
    );
}

#[test]
fn a_written_file_leaves_no_partial_one() {
    let folder = std::env::temp_dir().join(format!("givens-figure-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let figure = one_panel(Panel::default(), 300.0, 200.0);
    write(folder.join("a.svg"), &figure).unwrap();
    write(folder.join("a.PNG"), &figure).unwrap();
    // A folder stands where the file should go.
    std::fs::create_dir_all(folder.join("b.svg")).unwrap();
    assert!(matches!(write(folder.join("b.svg"), &figure), Err(FigureError::Write { .. })));
    let mut names: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["a.PNG", "a.svg", "b.svg"]);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn labels_are_escaped_and_cannot_break_the_document() {
    let heading = "a < b & \"c\" \u{1} \u{ffff} 漢字 '".to_owned();
    let figure =
        Figure { title: heading.clone(), ..one_panel(Panel { heading, ..Panel::default() }, 900.0, 200.0) };
    let text = svg(&figure);
    let document = roxmltree::Document::parse(&text).unwrap();
    let title = document.descendants().find(|n| n.has_tag_name("title")).and_then(|n| n.text());
    assert_eq!(title, Some("a < b & \"c\" \u{fffd} \u{fffd} 漢字 '"));
}

#[test]
fn an_axis_is_ticked_where_it_asks_to_be_as_far_as_there_is_room() {
    let of = |width: f64| {
        let ticks = (0..7).map(|k| (f64::from(1 << k), format!("{}", 1 << k))).collect();
        let x = Axis { scale: Scale::Log, ticks, ..Axis::default() };
        let points = vec![[1.0, 3.0], [64.0, 5.0]];
        let marks = vec![Mark::new("", Colour::BLUE, Shape::Line { points, width: 1.0, dashed: false })];
        let cells = vec![Some(Panel { x, marks, ..Panel::default() })];
        let body = Block::Grid(Grid { columns: vec![1.0], rows: vec![1.0], cells });
        let figure = Figure { title: String::new(), notes: vec![], key: false, body, width, height: 200.0 };
        let text = svg(&figure);
        ["1", "2", "4", "8", "16", "32", "64"].map(|tick| text.contains(&format!("aria-label=\"{tick}\"")))
    };
    assert_eq!(of(400.0), [true; 7]);
    // nothing between 1 and 64 that was not asked for, and only some of it
    let narrow = of(240.0).iter().filter(|&&shown| shown).count();
    assert!((2..=7).contains(&narrow), "{narrow}");
}
