//! Every row of the zoo's table is drawn, piped into the smoother, and believed.

use super::common::cells;
use super::folder;
use std::path::Path;

#[test]
fn each_model_of_the_zoo_simulates_smooths_and_is_consistent_as_its_table_says() {
    let folder = folder("zoo");
    let zoo = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/zoo");
    let readme = std::fs::read_to_string(zoo.join("README.md")).unwrap();
    let rows: Vec<Vec<&str>> = readme
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), 8);
    for row in rows {
        let [file, _, _, _, _, every, until, shown] = row[..] else { panic!("{row:?}") };
        let model = zoo.join(file.trim_matches('`'));
        let model = model.to_str().unwrap();
        let args = ["simulate", model, "--every", every, "--until", until, "--runs", "20", "--seed", "1"];
        let drawn = folder.run_args(&args).good().stdout;
        let smoothed = folder.run_with(&format!("smooth {model} - --method sr-cd-ckf"), &drawn).good();
        assert_eq!(cells(&smoothed.stdout).len(), cells(&drawn).len(), "{file}");
        let said = smoothed.stderr.split(", consistent: mean NIS ").nth(1);
        let nis = said.unwrap_or_else(|| panic!("{file}: {}", smoothed.stderr));
        let nis = nis.split(' ').next().unwrap();
        // the last digit may differ with the machine's exp and sin
        let apart = nis.parse::<f64>().unwrap() - shown.parse::<f64>().unwrap();
        assert!(apart.abs() < 0.0015, "{file}: {nis}, and the table says {shown}");
    }
}
