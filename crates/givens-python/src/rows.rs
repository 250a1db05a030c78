//! Rows of data and initial beliefs, from arrays.

use givens::filter::Gaussian;
use givens::filter::predict::{OneTransition, TimeUpdate};
use givens::scalar::Shown;
use givens::{Data, Goal};
use numpy::{PyReadonlyArrayDyn, PyUntypedArrayMethods};

use crate::errors::{Input, Result, covariance, data, length};
use crate::model::{Model, Moves};
use crate::numbers::{numbers, shaped};

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

/// The rows of one trajectory; NaN where a component is missing.
pub fn rows(
    model: &Model,
    t0: Option<f64>,
    time: &Numbers<'_>,
    z: &Numbers<'_>,
    u: Option<&Numbers<'_>>,
) -> Result<Data> {
    let (k, d, c) = (time.len(), model.measures(), model.controls());
    let time = shaped("t", time, &[k])?;
    let z = shaped("z", z, &[k, d])?;
    let u = match u {
        Some(u) => shaped("u", u, &[k, c])?,
        None if c == 0 => Vec::new(),
        None => return Err(Input::new("u", format!("the model has {c} controls: give `u`")).into()),
    };
    if let Some(at) = u.iter().position(|u| !u.is_finite()) {
        // those of traced models have their names in Python, where this has been found out before
        let message = format!("`u[{}, {}]` is {}, not a finite number", at / c, at % c, u[at]);
        return Err(Input::new("u", message).row(at / c).help("controls are always known").into());
    }
    let mut data_ = Data::with_controls(d, c);
    if let Some(t0) = t0 {
        finite("t0", t0)?;
        data_ = data_.starting_at(t0);
    }
    let names: Vec<&String> = model.known.measures.iter().collect();
    for (row, &t) in time.iter().enumerate() {
        let (z, u) = (&z[row * d..(row + 1) * d], &u[row * c..(row + 1) * c]);
        data_.push_controlled(t, z, u).map_err(|error| data(error, &names))?;
    }
    whole_steps(model, data_.start(), &time)?;
    Ok(data_)
}

/// An error for the first gap that a model with a fixed step cannot cross.
fn whole_steps(model: &Model, t0: f64, time: &[f64]) -> Result<()> {
    let Moves::Discrete(moves) = &model.moves else { return Ok(()) };
    let mut from = t0;
    for (row, &to) in time.iter().enumerate() {
        if let Err(fault) = OneTransition.plan(moves, from, to) {
            let input = Input::new("t", format!("row {row}, t = {}: {fault}", Shown(to))).row(row);
            return Err(input
                .help("put the rows on whole steps, or write the transition in `dt` and leave `step` out")
                .into());
        }
        from = to;
    }
    Ok(())
}

/// An initial belief: `spread` is the covariance, n × n, or the standard deviations, length n.
pub fn belief(model: &Model, mean: &Numbers<'_>, spread: &Numbers<'_>) -> Result<Gaussian> {
    let (n, states) = (model.states(), &model.known.states);
    let mean = shaped("mean", mean, &[n])?;
    let made = match spread.ndim() {
        1 => {
            let std = shaped("std", spread, &[n])?;
            Gaussian::from_std(&mean, &std)
        }
        _ => Gaussian::from_cov(&mean, &shaped("cov", spread, &[n, n])?),
    };
    if let Some(i) = mean.iter().position(|mean| !mean.is_finite()) {
        let message = format!("the initial mean of `{}` is {}", states[i], mean[i]);
        return Err(Input::new("prior", message).of(states.get(i)).into());
    }
    made.map_err(|error| covariance("prior", error, states))
}

/// A number that must be finite.
pub fn finite(argument: &'static str, value: f64) -> Result<()> {
    if value.is_finite() {
        return Ok(());
    }
    Err(Input::new(argument, format!("`{argument}` is {value}, not a finite number")).into())
}

/// What a run is after; `value` is the lag or the point.
pub fn goal(word: &str, value: Option<f64>, time: &[f64], t0: f64) -> Result<Goal> {
    match (word, value) {
        ("filter", _) => Ok(Goal::Filter),
        ("interval", _) => Ok(Goal::Interval),
        ("lag", Some(lag)) if lag >= 0.0 && lag.fract() == 0.0 => Ok(Goal::Lag(lag as usize)),
        ("lag", _) => {
            let message = "`lag` is a whole number of rows, from zero";
            Err(Input::new("lag", message).into())
        }
        ("point", Some(point)) if point == t0 || time.contains(&point) => Ok(Goal::Point(point)),
        ("point", Some(point)) => {
            let near = time.iter().min_by(|a, b| (*a - point).abs().total_cmp(&(*b - point).abs()));
            let message = format!("neither a row nor the initial belief stands at {}", Shown(point));
            let near =
                near.map_or_else(String::new, |near| format!("the nearest row is at {}; ", Shown(*near)));
            Err(Input::new("point", message).help(format!("{near}a row without measures makes one")).into())
        }
        (other, _) => {
            Err(Input::new("goal", format!("goal = {other}: filter, interval, lag or point")).into())
        }
    }
}

/// Times at which states are asked for, increasing from `t0` on.
pub fn times(at: &Numbers<'_>, t0: f64) -> Result<Vec<f64>> {
    length("at", "dimensions of `at`", 1, at.ndim())?;
    let at = numbers(at)?;
    let mut last = t0;
    for (k, &t) in at.iter().enumerate() {
        if !(t.is_finite() && t >= last) {
            let wrong = if t.is_finite() { format!(", before {}", Shown(last)) } else { String::new() };
            let message = format!("time {k} of `at` is {}{wrong}", Shown(t));
            return Err(Input::new("at", message).row(k).help("times increase, from `t0` on").into());
        }
        last = t;
    }
    Ok(at)
}
