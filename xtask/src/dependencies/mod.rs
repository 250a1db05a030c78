//! `cargo xtask dependencies`: whether every crate that a lock file names may be depended upon, by `deny.toml`.
//!
//! It asks nobody: what is known to be weak is told by `cargo deny`, which runs too where it is installed.

mod policy;

use crate::say;
use policy::Policy;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// The workspaces of what users get or copy; the peers of the benchmark are nobody's dependencies.
const WORKSPACES: &[&str] = &["Cargo.toml", "examples/embedded/Cargo.toml"];

/// Checks all; whether nothing was found.
pub fn run(root: &Path) -> bool {
    match checked(root) {
        Ok(findings) => {
            for finding in &findings {
                say(finding);
            }
            findings.is_empty() && denied(root)
        }
        Err(message) => {
            say(&message);
            false
        }
    }
}

fn checked(root: &Path) -> Result<Vec<String>, String> {
    let policy = Policy::read(&root.join("deny.toml"))?;
    let (mut findings, mut crates) = (Vec::new(), 0);
    for workspace in WORKSPACES {
        let metadata = metadata(&root.join(workspace))?;
        let packages = metadata["packages"].as_array().ok_or("cargo metadata names no packages")?;
        // what has no source lies in this repository
        for package in packages.iter().filter(|package| !package["source"].is_null()) {
            crates += 1;
            findings.extend(policy.judge(package).map(|wrong| format!("{workspace}: {wrong}")));
        }
    }
    findings.sort();
    findings.dedup();
    if findings.is_empty() {
        say(&format!("dependencies: {crates} crates, all of allowed licences and sources"));
    }
    Ok(findings)
}

fn metadata(manifest: &Path) -> Result<Value, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command
        .args(["metadata", "--format-version", "1", "--locked", "--all-features", "--manifest-path"])
        .arg(manifest);
    let out = command.output().map_err(|error| format!("cargo metadata could not be run: {error}"))?;
    if !out.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&out.stderr).trim()));
    }
    serde_json::from_slice(&out.stdout).map_err(|error| format!("cargo metadata: {error}"))
}

/// What `cargo deny` says where it is installed; known weaknesses only where their list can be had.
fn denied(root: &Path) -> bool {
    let deny = |words: &[&str]| Command::new("cargo").arg("deny").args(words).current_dir(root).output();
    if !deny(&["--version"]).is_ok_and(|out| out.status.success()) {
        say("cargo deny is not installed: nothing was asked about known weaknesses");
        return true;
    }
    let mut good = true;
    for words in [["check", "bans", "licenses", "sources"].as_slice(), &["check", "advisories"]] {
        let Ok(out) = deny(words) else { return false };
        let told = String::from_utf8_lossy(&out.stderr);
        let no_list = words.contains(&"advisories") && told.contains("failed to fetch advisory database");
        if no_list {
            say("cargo deny: the list of known weaknesses could not be had");
        } else {
            say(&format!(
                "cargo deny {}: {}",
                words.join(" "),
                if out.status.success() { "good" } else { told.trim() }
            ));
            good &= out.status.success();
        }
    }
    good
}
