//! What the pages show is what the program reads.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_io::{Model, parse_tracks};
use std::path::PathBuf;

fn page(path: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The fenced blocks of a language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    let rest = page.split(fence.as_str()).skip(1);
    rest.map(|rest| rest.split("```").next().unwrap_or_default().to_owned()).collect()
}

fn read(text: &str, name: &str) -> Model {
    Model::parse(text, name).unwrap_or_else(|errors| panic!("{errors}\nin\n{text}"))
}

#[test]
fn every_model_of_the_pages_is_read() {
    for (path, count) in [("docs/model-file.md", 5), ("README.md", 1)] {
        let models = blocks(&page(path), "toml");
        assert_eq!(models.len(), count, "{path}");
        for text in models {
            read(&text, path);
        }
    }
}

#[test]
fn the_small_model_reads_the_small_table() {
    let page = page("docs/model-file.md");
    let model = read(&blocks(&page, "toml")[0], "small.toml");
    let tracks = parse_tracks(&blocks(&page, "csv")[0], "small.csv", &model).unwrap();
    let rows = tracks.tracks[0].rows.read(0..usize::MAX).unwrap();
    assert_eq!(rows.iter().map(givens_io::Row::measured).collect::<Vec<_>>(), [true, true, false]);
}

#[test]
fn the_reference_names_every_function() {
    let page = page("docs/model-file.md");
    let line = page.lines().find(|line| line.starts_with("- `where(")).unwrap();
    let named: Vec<&str> = line.split(|c: char| !c.is_ascii_alphanumeric()).collect();
    for function in givens_expr::functions() {
        assert!(named.contains(&function), "{function}");
    }
}
