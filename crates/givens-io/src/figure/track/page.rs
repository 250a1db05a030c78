//! Where the panels of a track stand on the page.

use super::{Look, StateSeries, Track, TrackFigure, nis, plane, state};
use crate::figure::plot::{Axis, Block, Figure, Grid, Panel};
use crate::figure::scale::{Scale, span};

const WIDTH: f64 = 1280.0;
/// Height of one row of states in pixels.
const ROW: f64 = 122.0;
/// More states than this are not drawn.
const MOST_STATES: usize = 48;
/// With more states than this the plane does not stand beside them.
const MOST_BESIDE: usize = 12;
/// A track flatter than this gets the full width.
const FLAT: f64 = 0.36;

/// Lays out the figure.
pub(super) fn figure(given: &TrackFigure) -> Figure {
    let index = given.tracks.iter().position(|t| !t.states.is_empty() || t.nis.is_some());
    let shown = index.and_then(|i| given.tracks.get(i));
    let states: &[StateSeries] = shown.map_or(&[], |t| t.states.as_slice());
    let drawn = &states[..states.len().min(MOST_STATES)];
    let plane = plane::panel(given);
    let nis = shown.and_then(|t| t.nis.as_ref()).map(|n| nis::panel(n, time_axis(given, shown)));
    let errors = drawn.iter().filter(|s| s.truth.is_some()).count();
    let pairs = errors > 0 && errors == drawn.len();
    let cells = if pairs { drawn.len() } else { drawn.len() + errors };
    let look = Look::of(given, index.unwrap_or(0));
    let columns = |groups: usize| states_grid(drawn, groups, &look, &time_axis(given, shown));
    let (body, width, height) = match (plane, cells) {
        (None, 0) => (grid(1, &[1.0], vec![Some(nis.unwrap_or_default())]), WIDTH, 300.0),
        (None, n) => {
            let groups = groups(n, pairs);
            under(columns(groups), n.div_ceil(groups), nis, None)
        }
        (Some((plane, ratio)), 0) => {
            let height = (900.0 * ratio).clamp(320.0, 820.0);
            let below = if nis.is_some() { 170.0 } else { 0.0 };
            let weights = if nis.is_some() { vec![height, 150.0] } else { vec![height] };
            (grid(1, &weights, vec![Some(plane), nis]), 960.0, height + below + 70.0)
        }
        (Some((plane, ratio)), n) if ratio < FLAT || n > MOST_BESIDE => {
            let height = (1180.0 * ratio).clamp(240.0, 520.0);
            let groups = groups(n, pairs);
            under(columns(groups), n.div_ceil(groups), nis, Some((plane, height)))
        }
        (Some((plane, ratio)), n) => {
            let groups = n.div_ceil(6);
            let rows = n.div_ceil(groups);
            beside((plane, ratio), columns(groups), rows, nis, if pairs { 2 * groups } else { groups })
        }
    };
    let title = given.title.clone();
    Figure { title, notes: notes(given, shown, states.len()), key: true, body, width, height }
}

/// In how many groups side by side the states stand where they have the full width.
fn groups(states: usize, pairs: bool) -> usize {
    match (pairs, states) {
        (true, ..=6) | (false, ..=3) => 1,
        (true, _) | (false, ..=8) => 2,
        (false, ..=24) => 3,
        (false, _) => 4,
    }
}

/// The plane, if any, over the states over NIS.
fn under(states: Block, rows: usize, nis: Option<Panel>, plane: Option<(Panel, f64)>) -> (Block, f64, f64) {
    let mut blocks = Vec::new();
    if let Some((plane, height)) = plane {
        blocks.push((height + 70.0, grid(1, &[1.0], vec![Some(plane)])));
    }
    let row = if rows <= 2 { 1.6 * ROW } else { ROW };
    blocks.push((row * rows as f64 + 40.0, states));
    if let Some(nis) = nis {
        blocks.push((190.0, grid(1, &[1.0], vec![Some(nis)])));
    }
    let height = blocks.iter().map(|b| b.0).sum();
    (Block::Column(blocks), WIDTH, height)
}

/// The plane over NIS on the left, the states on the right.
fn beside(
    (plane, ratio): (Panel, f64),
    states: Block,
    rows: usize,
    nis: Option<Panel>,
    columns: usize,
) -> (Block, f64, f64) {
    let height = (ROW * rows as f64 + 40.0).max(600.0);
    // A tall track needs less of the width; many columns leave it less.
    let most = if columns > 1 { 0.42 } else { 0.5 };
    let width = if columns > 2 { 1.2 * WIDTH } else { WIDTH };
    let share = ((0.7 * height / ratio + 100.0) / width).clamp(0.3, most);
    let left = match nis {
        None => grid(1, &[1.0], vec![Some(plane)]),
        Some(nis) => {
            // What the plane wants of the height that is left beside labels and headings.
            let room = height - 100.0;
            let wanted = (ratio * (share * width - 100.0)).clamp(0.5 * room, room - 120.0);
            let below = (room - wanted).min(190.0);
            grid(1, &[room - below, below], vec![Some(plane), Some(nis)])
        }
    };
    (Block::Row(vec![(share, left), (1.0 - share, states)]), width, height)
}

fn grid(columns: usize, rows: &[f64], cells: Vec<Option<Panel>>) -> Block {
    Block::Grid(Grid { columns: vec![1.0; columns], rows: rows.to_vec(), cells })
}

/// The states in so many groups side by side, filled downwards. Where the truth of all is known, each group is two
/// columns, the states and beside them their errors; else the error of a state stands below it.
fn states_grid(states: &[StateSeries], groups: usize, look: &Look, time: &Axis) -> Block {
    let pairs = !states.is_empty() && states.iter().all(|s| s.truth.is_some());
    let error = |s: &StateSeries, axis: Axis| Some(state::error(s, s.truth.as_ref()?, axis, look));
    let kinds = |s: &StateSeries| if pairs || s.truth.is_none() { 1 } else { 2 };
    let places: Vec<(&StateSeries, usize)> =
        states.iter().flat_map(|s| (0..kinds(s)).map(move |kind| (s, kind))).collect();
    let rows = places.len().div_ceil(groups);
    let mut cells = Vec::new();
    for (row, group) in (0..rows).flat_map(|row| (0..groups).map(move |group| (row, group))) {
        let index = group * rows + row;
        // Time is written once under each column.
        let labelled = row + 1 == rows || index + 1 >= places.len();
        let axis = || Axis { labelled, ..time.clone() };
        let place = places.get(index);
        cells.push(place.and_then(|&(s, kind)| match kind {
            0 => Some(state::estimate(s, axis(), look)),
            _ => error(s, axis()),
        }));
        if pairs {
            cells.push(place.and_then(|&(s, _)| error(s, axis())));
        }
    }
    let columns = if pairs { 2 * groups } else { groups };
    grid(columns, &vec![1.0; rows], cells)
}

/// One range of time for all panels.
fn time_axis(given: &TrackFigure, shown: Option<&Track>) -> Axis {
    let label = if given.time_label.is_empty() { "time (s)".to_owned() } else { given.time_label.clone() };
    let states = shown.into_iter().flat_map(|t| &t.states).flat_map(|s| &s.time);
    let nis = shown.into_iter().flat_map(|t| &t.nis).flat_map(|s| &s.time);
    let found = span(Scale::Linear, states.chain(nis).copied());
    let range = found.map(|_| Scale::Linear.range(found, 0.012));
    Axis { label, range, ..Axis::default() }
}

fn notes(given: &TrackFigure, shown: Option<&Track>, states: usize) -> Vec<String> {
    let mut notes = given.notes.clone();
    if let (true, Some(track)) = (given.tracks.len() > 1, shown) {
        notes.push(format!(
            "{} tracks; states and NIS are those of {}.",
            given.tracks.len(),
            if track.name.is_empty() { "the first" } else { &track.name }
        ));
    }
    if states > MOST_STATES {
        notes.push(format!("The first {MOST_STATES} of {states} states."));
    }
    notes
}
