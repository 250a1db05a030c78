//! The Python environments of the peers: one for each list of requirements beside the scripts.

use super::build::done;
use crate::say;
use std::path::Path;
use std::process::Command;

/// Every environment has its requirements beside the scripts.
pub fn environments_of(root: &Path) -> Vec<String> {
    let files = std::fs::read_dir(root.join("benchmarks/python")).into_iter().flatten().flatten();
    let names = files.map(|file| file.file_name().to_string_lossy().into_owned());
    names.filter_map(|name| name.strip_suffix(".txt").map(str::to_owned)).collect()
}

/// Makes an environment and installs its requirements; if they do not go in together, each by itself, so that one package that
/// cannot be installed takes no other with it.
pub fn environment(root: &Path, environments: &Path, name: &str) -> Result<(), String> {
    let folder = environments.join(name);
    let requirements = root.join("benchmarks/python").join(format!("{name}.txt"));
    let interpreter = folder.join("bin/python");
    if !interpreter.exists() {
        done(Command::new("python3").args(["-m", "venv"]).arg(&folder), "python3 -m venv")?;
    }
    let pip = |what: &[&str]| {
        let mut install = Command::new(&interpreter);
        install.current_dir(root).args(["-m", "pip", "install", "--quiet"]).args(what);
        done(&mut install, &format!("pip install {}", what.join(" ")))
    };
    let Err(reason) = pip(&["--requirement", &requirements.to_string_lossy()]) else { return Ok(()) };
    say(&format!("{reason}; now each by itself"));
    let text = std::fs::read_to_string(&requirements).map_err(|error| error.to_string())?;
    let failed: Vec<&str> = packages(&text).filter(|package| pip(&[package]).is_err()).collect();
    if failed.is_empty() { Ok(()) } else { Err(format!("pip could not install {}", failed.join(", "))) }
}

/// The lines that name one.
fn packages(requirements: &str) -> impl Iterator<Item = &str> {
    requirements.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'))
}

#[cfg(test)]
mod tests {
    use super::packages;

    #[test]
    fn comments_and_empty_lines_are_no_packages() {
        let all: Vec<&str> = packages("# of most\nnumpy==2.4.6\n\n  .\n").collect();
        assert_eq!(all, ["numpy==2.4.6", "."]);
    }
}
