//! The table of `givens compare`.

use super::folder;

fn table(stdout: &str) -> Vec<Vec<String>> {
    let cells = |line: &str| {
        line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).map(str::to_owned).collect()
    };
    stdout.lines().map(cells).collect()
}

#[test]
fn a_line_for_each_method_with_aligned_columns() {
    let folder = folder("lines");
    let found =
        folder.run("compare model.toml data.csv --methods ekf,sr-ukf,sckf,qkf --set qkf.points=5").good();
    let rows = table(&found.stdout);
    assert_eq!(rows[0], ["method", "rows", "failed", "log-likelihood", "NIS/dof", "verdict", "µs/row"]);
    let names: Vec<&str> = rows[1..].iter().map(|row| row[0].as_str()).collect();
    assert_eq!(names, ["ekf", "sr-ukf", "sckf = sr-ckf", "qkf"]);
    let width = found.stdout.lines().map(|line| line.chars().count());
    assert!(
        width.clone().all(|width| width == found.stdout.lines().next().unwrap().chars().count()),
        "{}",
        found.stdout
    );
    for row in &rows[1..] {
        assert_eq!((row.len(), row[1].as_str(), row[2].as_str()), (7, "5", "0"));
    }
    // what filter says of the same method
    let filter = folder.run("filter model.toml data.csv --method qkf --set points=5").good();
    let log_likelihood = rows[4][3].parse::<f64>().unwrap();
    assert!(filter.stderr.contains(&format!("log-likelihood {log_likelihood:.3}")), "{}", filter.stderr);
    assert!(found.stderr.contains("5 rows; µs/row"), "{}", found.stderr);
}

#[test]
fn with_a_truth_the_errors_of_filter_and_smoother_stand_side_by_side() {
    let folder = folder("truth");
    folder.write("data.csv", "time,z\n1,6\n2,22\n").write("truth.csv", "time,x\n1,4\n2,13\n");
    let found = folder.run("compare walk.toml data.csv --methods ckf --truth truth.csv").good();
    let rows = table(&found.stdout);
    assert_eq!(rows[0][7..], ["x RMSE", "NEES/dof"]);
    // the smoother moves the first estimate to 10: errors 6 and 3
    let rmse = format!("{:.4} | {:.4}", 5_f64.sqrt(), 22.5_f64.sqrt());
    assert_eq!(rows[1][7], rmse, "{}", found.stdout);
}

#[test]
fn settings_are_for_all_methods_or_for_one() {
    let folder = folder("settings");
    let line = "compare model.toml data.csv --methods ukf,sr-ukf";
    let likelihoods = |more: &str| -> Vec<String> {
        table(&folder.run(&format!("{line} {more}")).good().stdout)[1..]
            .iter()
            .map(|row| row[3].clone())
            .collect()
    };
    let (plain, all, one) = (likelihoods(""), likelihoods("--set kappa=2"), likelihoods("--set ukf.kappa=2"));
    assert_ne!(plain[0], all[0]);
    assert_ne!(plain[1], all[1]);
    assert_eq!((&one[0], &one[1]), (&all[0], &plain[1]));
}

#[test]
fn options_of_the_file_that_do_not_fit_are_left_out_with_a_note() {
    let folder = folder("notes");
    let note = "model.toml:35: `kappa` of [filter] does not go with ckf: left out\n";
    let found = folder.run("compare model.toml data.csv --methods ukf,ckf").good();
    assert_eq!(found.stderr.matches(note).count(), 1, "{}", found.stderr);
    assert_eq!(found.stderr.matches("does not go with").count(), 1, "{}", found.stderr);
    let found = folder.run("filter model.toml data.csv --method ckf").good();
    assert!(found.stderr.contains(note), "{}", found.stderr);
    // kept where it fits: κ = 0 is the cubature rule
    let ukf = folder.run("filter model.toml data.csv --method ukf").good();
    assert!(!ukf.stderr.contains("left out"), "{}", ukf.stderr);
    let other = folder.run("filter model.toml data.csv --method ukf --set kappa=2").good();
    assert_ne!(ukf.stdout, other.stdout);
}

#[test]
fn parts_of_the_file_give_way_to_a_named_method() {
    let folder = folder("parts");
    let parts = "method = \"ukf\"\nrule = \"taylor\"\nform = \"square-root\"\nupdate = \"separate\"\n";
    folder.write("model.toml", &super::MODEL.replace("method = \"sr-ukf\"\nkappa = 0\n", parts));
    let of_file = folder.run("filter model.toml data.csv").good();
    assert!(of_file.stderr.contains("ukf, rule taylor, form square-root: 5 rows"), "{}", of_file.stderr);
    let named = folder.run("filter model.toml data.csv --method sr-ckf").good();
    assert!(
        named.stderr.contains("model.toml:35: `rule` of [filter] does not go with sr-ckf"),
        "{}",
        named.stderr
    );
    // the form is the same and the update fits
    assert_eq!(named.stderr.matches("left out").count(), 1, "{}", named.stderr);
    let same = folder.run("filter model.toml data.csv --set rule=cubature3").good();
    assert_eq!(named.stdout, same.stdout);
}
