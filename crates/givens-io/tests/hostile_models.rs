//! Model files from strangers: whatever they say, they are read or refused within some seconds and some memory.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_io::{InputErrors, Model};
use std::time::Instant;

/// A hundred times what these files take where nothing is done twice; they took hours.
const SECONDS: f64 = 60.0;

fn read(text: &str) -> Result<Model, InputErrors> {
    let begin = Instant::now();
    let read = Model::parse(text, "m.toml");
    assert!(begin.elapsed().as_secs_f64() < SECONDS);
    read
}

fn refused(text: &str) -> InputErrors {
    read(text).unwrap_err()
}

/// A model that is read; its errors would each show a line of a megabyte.
fn whole(text: &str) -> Model {
    read(text).unwrap_or_else(|errors| panic!("{errors}"))
}

/// `piece`, with `#` for its number, so many times.
fn each(count: usize, piece: &str) -> String {
    (0..count).map(|i| piece.replace('#', &i.to_string())).collect::<Vec<_>>().join(",")
}

/// n states, with what stands above the dynamics, and the process noise.
fn model(n: usize, above: &str, noise_cov: &str) -> String {
    format!(
        "[state]\nnames = [{}]\nmean = [{}]\nstd = [{}]\n{above}\n[dynamics]\ntransition = [{}]\n{noise_cov}\n\
         [[sensor]]\nname = \"a\"\nmeasures = {{ z = \"x0\" }}\nstd = [1]\n",
        each(n, "\"x#\""),
        each(n, "0"),
        each(n, "1"),
        each(n, "\"x#\""),
    )
}

/// A definition of `count` sines, greater than zero, which is a large part of a graph.
fn long(count: usize) -> String {
    format!("1 + ({})^2", each(count, "sin(p*#)").replace(',', "+"))
}

#[test]
fn errors_on_one_long_line_do_not_each_carry_the_line() {
    let errors = refused(&format!("[state]\nnames = [{}]\n", each(400_000, "1")));
    assert!(errors.more > 399_000, "{}", errors.more);
    assert!(errors.errors.len() < 20 && errors.to_string().len() < 10_000);
}

#[test]
fn a_million_wrong_names_are_not_each_compared_with_all_others() {
    let n = 700;
    let row = format!("[{}]", each(n, "\"zz\""));
    let errors = refused(&model(n, "", &format!("noise_cov = [{}]", each(n, &row))));
    assert!(errors.errors[0].message.contains("unknown name `zz`"), "{errors}");
    let many = format!("std = {{ {} }}", each(200_000, "zz# = 1"));
    let errors = refused(&model(n, "", "").replace(&format!("std = [{}]", each(n, "1")), &many));
    assert!(errors.errors[0].message.contains("unknown state `zz0`"), "{errors}");
}

#[test]
fn what_a_million_entries_depend_on_is_found_in_one_go() {
    let n = 700;
    let above = format!("[parameters]\np = 1\n[let]\nlong = \"{}\"", long(20_000));
    let row = format!("[{}]", each(n, "\"long\""));
    let read = whole(&model(n, &above, &format!("noise_cov = [{}]", each(n, &row))));
    assert_eq!(read.states.len(), n);
}

#[test]
fn what_a_definition_depends_on_is_found_once_for_all_sensors() {
    let lets = (0..900).map(|i| format!("a{i} = \"long + {i}\"")).collect::<Vec<_>>().join("\n");
    let above = format!("[parameters]\np = 1\n[let]\nlong = \"{}\"\n{lets}", long(20_000));
    let sensors =
        (0..900).map(|i| format!("[[sensor]]\nname = \"s{i}\"\nmeasures = {{ z{i} = \"x0\" }}\nstd = [1]\n"));
    let read = whole(&(model(2, &above, "") + &sensors.collect::<String>()));
    assert_eq!(read.sensors.len(), 901);
}

#[test]
fn a_model_file_longer_than_eight_mebibytes_is_refused_unread() {
    let text = model(1, "", "") + &"#".repeat(8 << 20);
    let errors = refused(&text);
    assert_eq!(errors.errors[0].message, "the model file is longer than 8 MiB");
    assert!(errors.errors[0].help.as_ref().unwrap().contains("parameters"));
    let path = std::env::temp_dir().join(format!("givens-hostile-{}.toml", std::process::id()));
    std::fs::write(&path, &text).unwrap();
    let read = Model::read(path.to_str().unwrap());
    std::fs::remove_file(&path).unwrap();
    assert_eq!(read.unwrap_err().errors[0].message, errors.errors[0].message);
}

#[test]
fn tables_of_tables_are_refused() {
    assert!(!refused(&format!("a = [{}]", "{},".repeat(1_000_000))).errors.is_empty());
    let dotted: Vec<String> = (0..10_000).map(|i| format!("a{}.c{i} = 1\n", ".b".repeat(60))).collect();
    assert!(!refused(&dotted.concat()).errors.is_empty());
}
