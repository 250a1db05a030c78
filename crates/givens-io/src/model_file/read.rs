//! The order in which the sections of a model file are read: names first, then what uses them.

use std::collections::HashSet;

use givens_expr::{Graph, Input};

use super::context::{Context, MANY};
use super::document::{self, Entry, Kind};
use super::names::Names;
use super::section::{Section, unknown_key};
use super::vocabulary::{Vocabulary, controls};
use super::{Model, definitions, dynamics, filter, sensor, start, state};
use crate::error::InputErrors;
use crate::findings::Findings;
use crate::source::Source;

/// Sections of a model file.
const SECTIONS: &[&str] = &["state", "parameters", "let", "dynamics", "sensor", "plot", "filter"];

/// Bytes of the longest model file. Its tree takes up to a hundred times as much memory, and each byte about a
/// microsecond, whatever it says.
pub(super) const LONGEST: u64 = 8 << 20;

/// Reads a model, with the values of `given` for parameters.
pub(super) fn model(source: &Source, given: &[(&str, f64)]) -> Result<Model, InputErrors> {
    let findings = Findings::new(source);
    if source.text.len() as u64 > LONGEST {
        let message = format!("the model file is longer than {} MiB", LONGEST >> 20);
        let help = "write large matrices by expressions of parameters, with fewer digits, or as a model in Rust or Python";
        return Err(source.whole(message).with_help(help).into());
    }
    let model = document::read(&findings).and_then(|document| {
        for entry in document.iter().filter(|entry| !SECTIONS.contains(&entry.key.as_str())) {
            unknown_key(&findings, entry, "a model file", SECTIONS);
        }
        sections(&findings, &document, given)
    });
    findings.finish(model)
}

fn sections(findings: &Findings, document: &[Entry], given: &[(&str, f64)]) -> Option<Model> {
    let entry = |key: &str| document.iter().find(|entry| entry.key == key);
    let need = |key: &str, title: &'static str, keys: &[&str], help: &str| {
        let Some(entry) = entry(key) else {
            findings.push(findings.source.whole(format!("the model has no {title}")).with_help(help));
            return None;
        };
        Section::of(findings, title, entry, keys)
    };
    let open = |key: &str, title: &'static str| {
        entry(key).and_then(|entry| {
            let Kind::Table(entries) = &entry.value.kind else {
                return Section::of(findings, title, entry, &[]);
            };
            if entries.len() > MANY {
                findings
                    .wrong(&entry.span, format!("{title} has {} entries, more than {MANY}", entries.len()));
                return None;
            }
            Some(Section { title, span: &entry.span, entries })
        })
    };
    let state_section =
        need("state", "[state]", state::KEYS, "begin it with [state] and `names`, the names of the states");
    let dynamics_section = need(
        "dynamics",
        "[dynamics]",
        dynamics::KEYS,
        "begin it with [dynamics] and `transition` or `drift`",
    );

    let mut names = Names::new(findings);
    let states = state_section.and_then(|section| state::names(findings, &section, &mut names));
    let mut context = Context {
        findings,
        graph: Graph::new(),
        vocabulary: Vocabulary::default(),
        parameters: Vec::new(),
        controls: 0,
        step: None,
    };
    for (index, name) in states.iter().flatten().enumerate() {
        let node = context.graph.input(Input::State(index as u32));
        context.vocabulary.define(&mut context.graph, name, Some(node));
    }
    let controls = inputs(&mut context, document);
    let parameters =
        definitions::parameters(&mut context, open("parameters", "[parameters]"), given, &mut names);
    // Without its states, all that follows would be found wrong.
    let states = states?;
    definitions::lets(&mut context, open("let", "[let]"), &mut names);
    let sketches = sensor::sketches(findings, entry("sensor"), &names);
    sensor::define(&mut context, sketches.as_deref().unwrap_or(&[]));

    let state_section = state_section?;
    let time = state::time(&mut context, &state_section);
    let found = if let Some(sketches) = &sketches {
        let measures = sketches.iter().map(|sketch| sketch.columns.len()).sum();
        start::read(&mut context, &state_section, &states, measures)
    } else {
        start::Found::default()
    };
    let prior = state::prior(&mut context, &state_section, &states, &found.started);
    context.step = dynamics_section.and_then(|section| dynamics::step(&mut context, &section));
    let dynamics = dynamics_section.and_then(|section| dynamics::read(&mut context, &section, &states));
    let observed = sketches.as_ref().and_then(|sketches| sensor::read(&mut context, sketches, states.len()));
    let plane = entry("plot")
        .and_then(|entry| Section::of(findings, "[plot]", entry, &["plane"]))
        .and_then(|section| filter::plane(findings, &section, &states));
    let filter = open("filter", "[filter]").map(|section| filter::read(findings, section));

    let (sensors, observation) = observed?;
    let measures = sensors.last().map_or(0, |sensor| sensor.measures.end);
    let started: Vec<usize> =
        (0..states.len()).filter(|&i| found.started.get(i).is_some_and(|&is| is)).collect();
    let start = start::function(&mut context, &found, &started, measures);
    let placement =
        plane.and_then(|[i, j]| start::function(&mut context, &found, &[i.min(j), i.max(j)], measures));
    // a single row cannot place a rate
    let placement = placement.filter(|placement| !placement.two_rows);
    let (time, epoch) = time?;
    Some(Model {
        file: findings.source.name.clone(),
        states,
        parameters,
        controls,
        time,
        epoch,
        prior: prior?,
        start,
        dynamics: dynamics?,
        observation,
        sensors,
        plane,
        placement,
        filter: filter.unwrap_or_default(),
        source: findings.source.clone(),
    })
}

/// Takes up time, step, and the controls that expressions use.
fn inputs(context: &mut Context, document: &[Entry]) -> Vec<String> {
    let mut found = Vec::new();
    for section in document {
        let skipped: &[&str] = match section.key.as_str() {
            "state" => &["names"],
            "sensor" => &["name", "angles"],
            "parameters" | "let" | "dynamics" => &[],
            _ => continue,
        };
        let tables = match &section.value.kind {
            Kind::List(items) => items.as_slice(),
            _ => core::slice::from_ref(&section.value),
        };
        for table in tables {
            let Kind::Table(entries) = &table.kind else { continue };
            for entry in entries.iter().filter(|entry| !skipped.contains(&entry.key.as_str())) {
                controls(&entry.value, &mut found);
            }
        }
    }
    // The sort is stable, so that controls hidden by escapes keep their order in the string.
    found.sort_by_key(|(at, _)| *at);
    let mut seen = HashSet::new();
    let mut found: Vec<String> =
        found.into_iter().map(|(_, name)| name).filter(|name| seen.insert(name.clone())).collect();
    if found.len() > MANY {
        context.findings.push(context.findings.source.whole(format!("there are more than {MANY} controls")));
        found.truncate(MANY);
    }
    for (name, input) in [("t", Input::Time), ("dt", Input::Step)] {
        let node = context.graph.input(input);
        context.vocabulary.define(&mut context.graph, name, Some(node));
    }
    for (index, name) in found.iter().enumerate() {
        let node = context.graph.input(Input::Control(index as u32));
        context.vocabulary.define(&mut context.graph, name, Some(node));
    }
    context.controls = found.len();
    found
}
