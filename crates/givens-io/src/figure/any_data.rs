//! No figure panics, whatever its data.

use proptest::prelude::*;

use super::tests::one_panel;
use super::track::{NisSeries, PlaneTrack, StateSeries, Track, TrackFigure};
use super::{Axis, Block, Colour, Figure, Grid, Mark, Panel, Scale, Shape, png, svg};

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
    let ticks = prop::collection::vec((number(), ".{0,12}"), 0..9);
    (".{0,12}", prop::option::of([number(), number()]), number(), scale, ticks, any::<bool>()).prop_map(
        |(label, range, padding, scale, ticks, labelled)| Axis {
            label,
            range,
            padding,
            scale,
            ticks,
            labelled,
        },
    )
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
        let series = StateSeries { name: "x".into(), time: time.clone(), mean, std, filtered, truth, inside: None };
        let filtered = smoothed.then(|| measurements.clone());
        let plane = PlaneTrack { estimate, covariance, filtered, measurements, truth: truth_way };
        let track = Track {
            name: String::new(),
            plane: has_plane.then_some(plane),
            states: vec![series; states],
            nis: has_nis.then_some(NisSeries { time, nis, lower, upper, gated: Vec::new(), all: None }),
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
