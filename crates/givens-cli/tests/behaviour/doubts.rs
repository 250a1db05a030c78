//! Answers that may be wrong are doubted where a run is told of.

use super::folder;

const DECAY: &str = "[state]
names = [\"x\"]
time = 0
mean = [2]
std = [1]

[parameters]
rate = 1

[dynamics]
drift = { x = \"-rate*x\" }
diffusion = { x = \"1\" }

[[sensor]]
name = \"gauge\"
measures = { z = \"x\" }
std = { z = 0.5 }
";

const DATA: &str = "time,z\n1,0.5\n2,0.4\n3,\n4,0.3\n5,0.2\n";

#[test]
fn steps_that_are_too_long_are_told_at_the_end_and_on_the_page() {
    let folder = folder("steps");
    folder.write("decay.toml", DECAY).write("data.csv", DATA);
    for run in ["filter", "smooth", "smooth --lag 2", "filter --resume", "filter --at 1.5,2.5"] {
        let (word, options) = run.split_once(' ').unwrap_or((run, ""));
        let line = format!(
            "{word} decay.toml data.csv --set method=sr-cd-ckf {options} -o out.csv --report page.html"
        );
        let line = line.replace("--set method=", "--method ");
        let good = folder.run(&line).good();
        assert!(!good.stderr.contains("doubt"), "{run}: {}", good.stderr);
        assert!(folder.read("page.html").contains("no step was too long"), "{run}");
        let bad = folder.run(&format!("{line} --param rate=20")).good();
        let doubts: Vec<&str> = bad.stderr.lines().filter(|line| line.starts_with("doubt: ")).collect();
        let [doubt] = doubts[..] else { panic!("{run}: {}", bad.stderr) };
        assert!(doubt.starts_with("doubt: data.csv:") && doubt.contains("--set substeps="), "{doubt}");
        assert!(folder.read("page.html").contains("the prediction moves by"), "{run}");
        let solved = folder.run(&format!("{line} --param rate=20").replace("sr-cd-ckf", "sr-cd-ckf2")).good();
        assert!(!solved.stderr.contains("doubt"), "{run}: {}", solved.stderr);
    }
}

#[test]
fn a_folder_and_a_comparison_tell_doubts_too() {
    let folder = folder("many");
    folder.write("decay.toml", &DECAY.replace("rate = 1", "rate = 20"));
    std::fs::create_dir(folder.path("parts")).unwrap();
    folder.write("parts/a.csv", DATA).write("parts/b.csv", DATA);
    let found = folder.run("smooth decay.toml parts -o out --method sr-cd-ckf").good();
    let doubts = found.stderr.matches("doubt: parts/").count();
    assert!(doubts == 2 && found.stderr.contains("doubt: 2 files have doubtful answers"), "{}", found.stderr);
    let found = folder.run("compare decay.toml parts/a.csv --methods sr-cd-ckf,sr-cd-ckf2").good();
    assert!(found.stderr.contains("doubt: sr-cd-ckf: parts/a.csv:"), "{}", found.stderr);
    assert!(!found.stderr.contains("doubt: sr-cd-ckf2"), "{}", found.stderr);
}

#[test]
fn digits_that_a_covariance_has_lost_are_told_with_their_place_and_remedy() {
    let folder = folder("digits");
    folder.write("walk.toml", &super::WALK.replace("std = [2]", "std = [1e9]"));
    folder.write("data.csv", "time,z\n1,0.4\n2,2.1\n");
    let found = folder.run("filter walk.toml data.csv --method ckf");
    let told = "doubt: data.csv:2: t = 1: a measurement made the std of `x` so small";
    assert!(
        found.stderr.contains(told) && found.stderr.contains("--set form=square-root"),
        "{}",
        found.stderr
    );
    let found = folder.run("filter walk.toml data.csv --method sr-ckf");
    assert!(!found.stderr.contains("doubt"), "{}", found.stderr);
}
