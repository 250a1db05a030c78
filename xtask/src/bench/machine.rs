//! What the figures were measured on.

use std::path::Path;
use std::process::Command;

/// The load of the last one, five and fifteen minutes.
pub fn load() -> String {
    let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let words: Vec<&str> = text.split(' ').take(3).collect();
    if words.len() == 3 { words.join(", ") } else { "unknown".to_owned() }
}

/// Model and number of the processors, and their widest vectors.
pub fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let value = |key: &str| {
        let line = text.lines().find(|line| line.starts_with(key));
        line.and_then(|line| line.split_once(": ")).map_or("", |(_, value)| value)
    };
    let flags: Vec<&str> = value("flags").split(' ').collect();
    let vectors =
        ["avx512f", "avx2", "sse2"].into_iter().find(|set| flags.contains(set)).unwrap_or("unknown");
    let threads = std::thread::available_parallelism().map_or(1, core::num::NonZeroUsize::get);
    format!(
        "{} (family {}, model {}), {threads} threads, vectors up to {vectors}",
        value("model name"),
        value("cpu family"),
        value("model\t")
    )
}

/// The first line that a command prints; nothing if it does not run.
pub fn line_of(program: &str, words: &[&str], folder: &Path) -> String {
    let out = Command::new(program).args(words).current_dir(folder).output();
    let text = out.map(|out| String::from_utf8_lossy(&out.stdout).into_owned()).unwrap_or_default();
    text.lines().next().unwrap_or("").to_owned()
}

/// What stands at the head of a page, by name; `before` is the load when the work began.
pub fn facts(root: &Path, before: &str) -> [(&'static str, String); 4] {
    let line = |program: &str, words: &[&str]| line_of(program, words, root);
    let revision = line("git", &["describe", "--always", "--dirty"]);
    [
        ("date", line("date", &["-u", "+%Y-%m-%d %H:%M UTC"])),
        ("machine", processor()),
        ("load before and after", format!("{before}; {}", load())),
        ("givens", format!("revision {revision}, {}", line("rustc", &["--version"]))),
    ]
}
