//! A copy of the project with the mutants in it, built; mutants that do not compile are left out.

use super::group::{Group, Stage};
use super::list::Mutant;
use super::switch;
use super::weave::{Woven, weave};
use crate::say;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The built test programs.
#[derive(Debug)]
pub struct Built {
    /// In the order in which they are asked.
    pub programs: Vec<Program>,
    pub unviable: BTreeSet<u32>,
    /// By the number that a function asks with, its mutants.
    pub functions: BTreeMap<u32, Vec<u32>>,
}

#[derive(Debug)]
pub struct Program {
    pub name: String,
    pub arguments: Vec<String>,
    pub path: PathBuf,
    /// The folder that it is run in.
    pub folder: PathBuf,
}

pub fn build(root: &Path, group: &Group, stage: &Stage, mutants: &[&Mutant]) -> Result<Built, String> {
    let copy = root.join("target/mutants").join(group.name);
    copy_project(root, &copy)?;
    let own = copy.join(group.folder).join("src/lib.rs");
    let text = read(&own)?;
    write(&own, &format!("{}{text}{}", switch::HEAD, switch::MODULE))?;
    let mut unviable = BTreeSet::new();
    loop {
        let woven = weave_files(root, &copy, mutants, &unviable)?;
        match compile(root, &copy, stage, &woven)? {
            Compiled::Programs(programs) => {
                let functions = woven.into_values().flat_map(|woven| woven.functions).collect();
                return Ok(Built { programs, unviable, functions });
            }
            Compiled::Wrong(wrong) => {
                say(&format!("{} mutants do not compile", wrong.len()));
                unviable.extend(wrong);
            }
        }
    }
}

/// Copies what git knows of the project.
fn copy_project(root: &Path, copy: &Path) -> Result<(), String> {
    let mut git = Command::new("git");
    git.current_dir(root).args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]);
    let out = git.output().map_err(|error| format!("git cannot be run: {error}"))?;
    for path in String::from_utf8_lossy(&out.stdout).split_terminator('\0') {
        let (from, to) = (root.join(path), copy.join(path));
        if !from.is_file() {
            continue;
        }
        let bytes = std::fs::read(&from).map_err(|error| format!("{path}: {error}"))?;
        // what is the same keeps its time, and is not built again
        if std::fs::read(&to).is_ok_and(|there| there == bytes) {
            continue;
        }
        let folder = to.parent().unwrap_or(copy);
        std::fs::create_dir_all(folder)
            .and_then(|()| std::fs::write(&to, bytes))
            .map_err(|error| format!("{}: {error}", to.display()))?;
    }
    Ok(())
}

fn weave_files(
    root: &Path,
    copy: &Path,
    mutants: &[&Mutant],
    unviable: &BTreeSet<u32>,
) -> Result<HashMap<String, Woven>, String> {
    let mut files: BTreeMap<&str, Vec<&Mutant>> = BTreeMap::new();
    for &mutant in mutants.iter().filter(|mutant| !unviable.contains(&mutant.number)) {
        files.entry(&mutant.file).or_default().push(mutant);
    }
    let mut woven = HashMap::new();
    for (file, own) in files {
        // copies inlined into copies would grow without bound
        let text = read(&root.join(file))?.replace("#[inline(always)]", "#[inline(never)] ");
        let file_woven = weave(&text, &own);
        if read(&copy.join(file))? != file_woven.text {
            write(&copy.join(file), &file_woven.text)?;
        }
        woven.insert(file.to_owned(), file_woven);
    }
    Ok(woven)
}

enum Compiled {
    Programs(Vec<Program>),
    /// The mutants that do not compile.
    Wrong(BTreeSet<u32>),
}

fn compile(
    root: &Path,
    copy: &Path,
    stage: &Stage,
    woven: &HashMap<String, Woven>,
) -> Result<Compiled, String> {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(copy).args(["test", "-j1", "--no-run", "--message-format=json", "-p", stage.package]);
    for program in stage.programs.iter().filter_map(|program| program.split(' ').next()) {
        if program == stage.package {
            cargo.arg("--lib");
        } else {
            cargo.args(["--test", program]);
        }
    }
    cargo.env("CARGO_TARGET_DIR", root.join("target/mutants/build"));
    // what a constant asks is asked of the compiler, which stable Rust cannot tell apart
    cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTFLAGS", "--cap-lints allow");
    cargo.env("CARGO_PROFILE_DEV_DEBUG", "0");
    cargo.env("CARGO_PROFILE_DEV_OPT_LEVEL", if stage.optimised { "1" } else { "0" });
    let out = cargo.output().map_err(|error| format!("cargo cannot be run: {error}"))?;
    let text = String::from_utf8_lossy(&out.stdout);
    let messages: Vec<Value> = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    if out.status.success() {
        return programs(copy, stage, &messages).map(Compiled::Programs);
    }
    let mut wrong = BTreeSet::new();
    let mut elsewhere = String::new();
    for message in messages.iter().map(|message| &message["message"]).filter(|m| m["level"] == "error") {
        let spans = message["spans"].as_array().map_or(&[][..], Vec::as_slice);
        let found: Vec<u32> =
            spans.iter().filter(|s| s["is_primary"] == true).filter_map(|s| of(s, woven)).collect();
        if found.is_empty() && !spans.is_empty() {
            elsewhere.push_str(message["rendered"].as_str().unwrap_or("?"));
        }
        wrong.extend(found);
    }
    if wrong.is_empty() {
        let words = String::from_utf8_lossy(&out.stderr);
        return Err(format!("the mutated project does not compile:\n{elsewhere}{words}"));
    }
    Ok(Compiled::Wrong(wrong))
}

/// The mutant in whose copy a place stands, or the place that a macro is called from.
fn of(span: &Value, woven: &HashMap<String, Woven>) -> Option<u32> {
    let line = span["line_start"].as_u64()? as usize;
    let own = woven.get(span["file_name"].as_str()?).and_then(|woven| {
        woven.lines.iter().find(|(lines, _)| lines.contains(&line)).map(|&(_, number)| number)
    });
    own.or_else(|| of(span["expansion"].get("span")?, woven))
}

fn programs(copy: &Path, stage: &Stage, messages: &[Value]) -> Result<Vec<Program>, String> {
    let find = |program: &str| {
        messages.iter().find_map(|message| {
            let manifest = Path::new(message["manifest_path"].as_str()?);
            let name = |name: &str| name.replace('-', "_");
            let named = name(message["target"]["name"].as_str()?) == name(program);
            let own = message["package_id"].as_str()?.contains(stage.package);
            let test = message["profile"]["test"] == true;
            let path = message["executable"].as_str()?;
            (named && own && test)
                .then(|| (PathBuf::from(path), manifest.parent().unwrap_or(copy).to_path_buf()))
        })
    };
    let mut programs = Vec::new();
    for program in stage.programs {
        let mut words = program.split(' ').map(str::to_owned);
        let name = words.next().unwrap_or_default();
        let (path, folder) = find(&name).ok_or_else(|| format!("{} {name}: no program", stage.package))?;
        programs.push(Program { name, arguments: words.collect(), path, folder });
    }
    Ok(programs)
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}
