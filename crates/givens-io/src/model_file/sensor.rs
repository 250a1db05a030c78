//! `[[sensor]]`: what is measured, and how well.

use core::ops::Range;

use givens_expr::{ModelObservation, Node, NoiseBlock, ObservationParts};

use super::angles;
use super::context::{Context, MANY};
use super::covariance::covariance;
use super::document::{Entry, Kind, Value};
use super::names::{Names, breaks};
use super::section::{Named, Section, text};
use super::vocabulary::Role;
use crate::findings::Findings;

const KEYS: &[&str] = &["name", "measures", "std", "cov", "angles"];

/// A sensor: a stretch of the stacked measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// Its measures, as places in the stack.
    pub measures: Range<usize>,
    /// The names of its measures, which are those of the data's columns.
    pub columns: Vec<String>,
    /// For each measure its period, if it is an angle.
    pub angles: Vec<Option<f64>>,
}

/// A sensor whose names are known and whose expressions are still to be read.
pub(super) struct Sketch<'a> {
    section: Section<'a>,
    name: Option<String>,
    pub columns: Vec<String>,
    expressions: Vec<&'a Value>,
}

/// Reads names of sensors and measures.
pub(super) fn sketches<'a>(
    findings: &Findings,
    entry: Option<&'a Entry>,
    names: &Names,
) -> Option<Vec<Sketch<'a>>> {
    let Some(entry) = entry else {
        let help = "begin one with [[sensor]] and give it `name`, `measures` and `std`";
        findings.push(findings.source.whole("the model has no sensor").with_help(help));
        return None;
    };
    let Kind::List(items) = &entry.value.kind else {
        findings.wrong_help(
            &entry.span,
            "sensors are a list of tables",
            "write [[sensor]], in double brackets",
        );
        return None;
    };
    if items.is_empty() {
        findings.wrong_help(&entry.span, "the model has no sensor", "begin one with [[sensor]]");
        return None;
    }
    let mut sketches: Vec<Sketch> = Vec::new();
    let mut good = true;
    for item in items {
        let Some(sketch) = sketch(findings, item, names) else {
            good = false;
            continue;
        };
        if let Some((name, at)) = sketch.name.as_ref().zip(sketch.section.get("name"))
            && sketches.iter().any(|other| other.name.as_ref() == Some(name))
        {
            findings.wrong_help(
                &at.value.span,
                format!("two sensors are called `{name}`"),
                "rename one of them",
            );
        }
        sketches.push(sketch);
    }
    let measures: usize = sketches.iter().map(|sketch| sketch.columns.len()).sum();
    if measures > MANY {
        findings.wrong(&entry.span, format!("there are {measures} measures, more than {MANY}"));
        return None;
    }
    good.then_some(sketches)
}

fn sketch<'a>(findings: &Findings, item: &'a Value, names: &Names) -> Option<Sketch<'a>> {
    let Kind::Table(entries) = &item.kind else {
        let message = format!("a sensor is a table; found {}", item.kind.noun());
        findings.wrong_help(&item.span, message, "write [[sensor]] on a line of its own, its keys below");
        return None;
    };
    let section = Section { title: "[[sensor]]", span: &item.span, entries };
    section.known(findings, KEYS);
    let name = section.need(findings, "name", "name it: name = \"radar\"").and_then(|entry| {
        let name = text(findings, &entry.value, "`name`")?;
        if name.is_empty() || name.trim() != name {
            let help = "write a name without spaces around it";
            findings.wrong_help(&entry.value.span, "a sensor's name is empty or has spaces around it", help);
        } else if name.chars().any(breaks) {
            let help = "write a name of letters, digits and signs, on one line";
            findings.wrong_help(
                &entry.value.span,
                "a sensor's name has a line end or a control character",
                help,
            );
        }
        Some(name.to_string())
    });
    let help = "write what it measures: measures = { range = \"hypot(x, y)\" }";
    let entry = section.need(findings, "measures", help)?;
    let Kind::Table(measures) = &entry.value.kind else {
        let message =
            format!("`measures` is a table of names and expressions; found {}", entry.value.kind.noun());
        findings.wrong_help(&entry.value.span, message, help);
        return None;
    };
    if measures.is_empty() {
        findings.wrong_help(&entry.value.span, "the sensor measures nothing", help);
        return None;
    }
    for measure in measures {
        names.measure(&measure.key, &measure.span);
    }
    let columns = measures.iter().map(|measure| measure.key.clone()).collect();
    Some(Sketch {
        section,
        name,
        columns,
        expressions: measures.iter().map(|measure| &measure.value).collect(),
    })
}

/// Tells the vocabulary the measures, for `start`.
pub(super) fn define(context: &mut Context, sketches: &[Sketch]) {
    let names = sketches.iter().flat_map(|sketch| &sketch.columns);
    for (index, name) in names.enumerate() {
        context.vocabulary.define_measure(&mut context.graph, name, index);
    }
}

/// Reads the expressions of all sensors, stacked in file order.
pub(super) fn read(
    context: &mut Context,
    sketches: &[Sketch],
    states: usize,
) -> Option<(Vec<Sensor>, ModelObservation)> {
    let (mut sensors, mut measures, mut angles, mut noise) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut good = true;
    let mut first = 0;
    for sketch in sketches {
        let nodes = expressions(context, sketch);
        let block = block(context, sketch);
        let periods = angles::periods(context, &sketch.section, &sketch.columns);
        let next = first + sketch.columns.len();
        if let (Some(nodes), Some(block), Some(periods), Some(name)) =
            (nodes, block, periods, sketch.name.clone())
        {
            measures.extend(nodes);
            angles.extend(periods.iter().copied());
            noise.push(block);
            sensors.push(Sensor {
                name,
                measures: first..next,
                columns: sketch.columns.clone(),
                angles: periods,
            });
        } else {
            good = false;
        }
        first = next;
    }
    if !good {
        return None;
    }
    let (controls, parameters) = (context.controls, context.parameters.len());
    let parts = ObservationParts { states, controls, parameters, measures, angles, noise };
    match ModelObservation::new(&mut context.graph, parts) {
        Ok(observation) => Some((sensors, observation)),
        Err(error) => {
            context.findings.push(context.findings.source.whole(format!("[[sensor]]: {error}")));
            None
        }
    }
}

fn expressions(context: &mut Context, sketch: &Sketch) -> Option<Vec<Node>> {
    let scope = context.scope(Role::Measure);
    let mut nodes = Vec::with_capacity(sketch.columns.len());
    for (value, name) in sketch.expressions.iter().zip(&sketch.columns) {
        nodes.push(context.finite_expression(&scope, value, &format!("the measure `{name}`")));
    }
    nodes.into_iter().collect()
}

/// The noise, from `std` or `cov`.
fn block(context: &mut Context, sketch: &Sketch) -> Option<NoiseBlock> {
    let scope = context.scope(Role::MeasurementNoise);
    match (sketch.section.get("std"), sketch.section.get("cov")) {
        (Some(_), Some(cov)) => {
            context.findings.wrong_help(
                &cov.span,
                "the sensor has both `std` and `cov`",
                "remove one of them",
            );
            None
        }
        (None, None) => {
            let help = "write the standard deviation of each measure, or their covariance";
            context.findings.wrong_help(sketch.section.span, "the sensor has neither `std` nor `cov`", help);
            None
        }
        (Some(std), None) => {
            let named = Named { noun: "measure", names: &sketch.columns };
            let values = named.values(context.findings, &std.value, "`std`")?;
            context.deviations(&scope, &values, &sketch.columns, "`std`").map(NoiseBlock::Std)
        }
        (None, Some(cov)) => {
            covariance(context, &scope, &cov.value, &sketch.columns, "`cov`").map(NoiseBlock::Cov)
        }
    }
}
