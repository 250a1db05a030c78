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

fn one_panel(panel: Panel, width: f64, height: f64) -> Figure {
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

/// Any number: ordinary, extreme, not a number.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -100.0..100.0f64,
        1 => proptest::num::f64::ANY,
        1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, 1e308, -1e308, 1e-310]),
    ]
}

fn values() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(number(), 0..40)
}

fn pairs() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec([number(), number()], 0..40)
}

fn shape() -> impl Strategy<Value = Shape> {
    prop_oneof![
        (pairs(), number(), any::<bool>()).prop_map(|(points, width, dashed)| Shape::Line {
            points,
            width,
            dashed
        }),
        (pairs(), number(), any::<bool>()).prop_map(|(points, radius, hollow)| Shape::Dots {
            points,
            radius,
            hollow
        }),
        prop::collection::vec([number(), number(), number()], 0..40).prop_map(|rows| Shape::Band { rows }),
        (pairs(), prop::collection::vec([number(), number(), number()], 0..40), number(), number()).prop_map(
            |(centres, covariances, sigmas, apart)| Shape::Ellipses { centres, covariances, sigmas, apart }
        ),
        number().prop_map(|y| Shape::Level { y, dashed: true }),
    ]
}

fn axis() -> impl Strategy<Value = Axis> {
    let scale = prop_oneof![
        Just(Scale::Linear),
        Just(Scale::Log),
        number().prop_map(|unit| Scale::Compressed { unit })
    ];
    (".{0,12}", prop::option::of([number(), number()]), number(), scale, any::<bool>())
        .prop_map(|(label, range, padding, scale, labelled)| Axis { label, range, padding, scale, labelled })
}

/// Draws both formats and checks what can be checked of any figure.
fn drawn(figure: &Figure) -> Result<(), TestCaseError> {
    let text = svg(figure);
    prop_assert!(roxmltree::Document::parse(&text).is_ok());
    prop_assert!(!text.contains("NaN"));
    prop_assert!(png(figure).is_ok());
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_panel_panics_on_any_data(
        shapes in prop::collection::vec((shape(), ".{0,8}"), 0..4),
        x in axis(), y in axis(),
        equal in any::<bool>(), key in any::<bool>(),
        heading in ".{0,300}",
        size in (number(), -10.0..400.0f64),
    ) {
        let marks = shapes.into_iter().map(|(shape, name)| Mark { name, colour: Colour::BLUE, shape }).collect();
        let panel = Panel { remark: heading.clone(), heading, x, y, equal, key, marks };
        let [width, height] = [size.0.clamp(-1.0, 500.0), size.1];
        drawn(&Figure { key, ..one_panel(panel, width, height) })?;
    }

    #[test]
    fn no_track_panics_on_any_data(
        (time, mean, std, truth) in (values(), values(), values(), prop::option::of(values())),
        (nis, lower, upper) in (values(), values(), values()),
        (estimate, measurements, truth_way) in (pairs(), pairs(), prop::option::of(pairs())),
        covariance in prop::collection::vec([number(), number(), number()], 0..40),
        (has_plane, has_nis, smoothed) in any::<(bool, bool, bool)>(),
        states in 0usize..15,
        tracks in 0usize..10,
    ) {
        let filtered = smoothed.then(|| mean.clone());
        let series = StateSeries { name: "x".into(), time: time.clone(), mean, std, filtered, truth };
        let filtered = smoothed.then(|| measurements.clone());
        let plane = PlaneTrack { estimate, covariance, filtered, measurements, truth: truth_way };
        let track = Track {
            name: String::new(),
            plane: has_plane.then_some(plane),
            states: vec![series; states],
            nis: has_nis.then_some(NisSeries { time, nis, lower, upper }),
        };
        let figure = TrackFigure { tracks: vec![track; tracks], smoothed, ..TrackFigure::default() }.figure();
        let text = svg(&figure);
        prop_assert!(roxmltree::Document::parse(&text).is_ok());
        prop_assert!(!text.contains("NaN"));
    }

    #[test]
    fn no_grid_panics_on_any_shape(
        columns in prop::collection::vec(number(), 0..4),
        rows in prop::collection::vec(number(), 0..4),
        cells in prop::collection::vec(any::<bool>(), 0..20),
        weights in [number(), number()],
    ) {
        let cells = cells.into_iter().map(|c| c.then(Panel::default)).collect();
        let grid = Block::Grid(Grid { columns, rows, cells });
        let column = Block::Column(vec![(weights[0], grid.clone()), (weights[1], Block::Row(vec![]))]);
        let body = Block::Row(vec![(weights[0], grid), (weights[1], column)]);
        drawn(&Figure { body, ..one_panel(Panel::default(), 400.0, 200.0) })?;
    }
}
