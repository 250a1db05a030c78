//! continuous.json through the command: one interval of every filter, and ten measurements with the failure among them.

use super::common::{Folder, golden_json, numbers};
use super::compare::Expected;
use super::set;
use core::fmt::Write;
use serde_json::Value;

/// The parts of a filter of the file, beside `substeps`, for each form in which it is the same.
fn parts(name: &str) -> Vec<Vec<String>> {
    let both = |words: &[&str]| {
        ["covariance", "square-root"].map(|form| {
            let form = format!("form={form}");
            words.iter().map(|word| (*word).to_owned()).chain([form]).collect::<Vec<_>>()
        })
    };
    let one = |form: usize, words: &[&str]| vec![both(words)[form].clone()];
    let full = ["time_update=ito-taylor", "variant=full"];
    let rk4 = ["time_update=moment-ode", "solver=rk4"];
    let of = |rule: &'static str, words: &[&'static str]| [&[rule], words].concat();
    match name {
        "EKF-RK4" => one(0, &of("rule=taylor", &rk4)),
        "EKF-Euler" => both(&["rule=taylor", "time_update=euler-maruyama"]).to_vec(),
        "CKF1" => both(&of("rule=cubature3", &full)).to_vec(),
        "UKF1" => both(&of("rule=unscented", &full)).to_vec(),
        "GHKF1" => both(&of("rule=gauss-hermite", &full)).to_vec(),
        "CKF2" => one(0, &of("rule=cubature3", &rk4)),
        "UKF2" => one(0, &of("rule=unscented", &rk4)),
        "GHKF2" => one(0, &of("rule=gauss-hermite", &rk4)),
        "UKF-Euler" => one(0, &["rule=unscented", "time_update=moment-ode", "solver=euler"]),
        "UKF-EM" => both(&["rule=unscented", "time_update=euler-maruyama"]).to_vec(),
        "CKF2010-sub" => both(&["rule=cubature3", "time_update=ito-taylor", "variant=simplified"]).to_vec(),
        "CKF2010-once" => both(&["rule=cubature3", "time_update=ito-taylor", "variant=noise-once"]).to_vec(),
        "SQRT2" => one(1, &of("rule=cubature3", &rk4)),
        _ => {
            let (velocity, solver) = name.strip_prefix("LSKF-").unwrap().rsplit_once('-').unwrap();
            let velocity = match velocity {
                "std" => "standard",
                "avg_printed" => "averaged-printed",
                "avg_code" => "averaged",
                "partial_mean" => "partial",
                "partial_x1" => "partial-printed",
                _ => "cubature",
            };
            let solver = match solver {
                "RK1" => "solver=euler",
                "RK2" => "solver=rk2",
                "RK4" => "solver=rk4",
                _ => "solver=dp5",
            };
            let velocity = format!("velocity={velocity}");
            one(1, &["rule=cubature3", "time_update=level-set", "root=moved", solver, &velocity])
        }
    }
}

struct Radar {
    folder: Folder,
    golden: Value,
}

impl Radar {
    fn new(name: &str) -> Self {
        let golden = golden_json("continuous.json");
        let (turn, radar) = (&golden["models"]["turn"], &golden["radar_sequence"]);
        let (noise, r) = (numbers(&turn["sQ_diag"]), numbers(&turn["R_diag"]));
        let cov: Vec<String> = numbers(&radar["P0"]).chunks_exact(7).map(|row| format!("{row:?}")).collect();
        let std: Vec<f64> = r.iter().map(|r| r.sqrt()).collect();
        let folder = Folder::new(name);
        folder.write(
            "model.toml",
            &format!(
                "[state]\nnames = [\"e\", \"de\", \"n\", \"dn\", \"z\", \"dz\", \"w\"]\ntime = 0\nmean = {:?}\n\
                 cov = [{}]\n\n[dynamics]\n\
                 drift = [\"de\", \"-w*dn\", \"dn\", \"w*de\", \"dz\", 0, 0]\ndiffusion = {noise:?}\n\n\
                 [[sensor]]\nname = \"radar\"\nmeasures = {{ range = \"hypot(hypot(e, n), z)\", \
                 azimuth = \"atan2(n, e)\", elevation = \"atan2(z, hypot(e, n))\" }}\nstd = {std:?}\n\
                 angles = [\"azimuth\"]\n",
                numbers(&radar["m0"]),
                cov.join(", "),
            ),
        );
        let interval = radar["T"].as_f64().unwrap();
        let mut rows = String::from("time,range,azimuth,elevation\n");
        for (k, z) in numbers(&radar["z"]).chunks_exact(3).enumerate() {
            let time = interval * (k + 1) as f64;
            writeln!(rows, "{time:?},{:?},{:?},{:?}", z[0], z[1], z[2]).unwrap();
        }
        folder
            .write("data.csv", &rows)
            .write("blank.csv", &format!("time,range,azimuth,elevation\n{interval},,,\n"));
        Self { folder, golden }
    }

    fn filter(&self, data: &str, settings: Vec<String>, steps: &Value) -> super::common::Run {
        let mut settings = settings;
        if settings.iter().any(|word| word == "solver=dp5") {
            settings.push("rtol=1e-11".into());
        } else {
            settings.push(format!("substeps={steps}"));
        }
        let mut args = ["filter", "model.toml", data, "--format", "jsonl"].map(str::to_owned).to_vec();
        args.extend(set(settings));
        super::run(&self.folder, &args)
    }
}

fn tolerance(name: &str) -> f64 {
    if name.ends_with("AD") { 1e-8 } else { 1e-10 }
}

#[test]
fn one_interval_of_every_continuous_filter() {
    let radar = Radar::new("continuous-interval");
    for entry in radar.golden["predict"].as_array().unwrap() {
        let name = entry["filter"].as_str().unwrap();
        for settings in parts(name) {
            let found = radar.filter("blank.csv", settings.clone(), &entry["M"]).good().objects();
            let error = Expected::full(&entry["m"], &entry["P"]).error(&found[0]["mean"], &found[0]["cov"]);
            assert!(error < tolerance(name), "{name} {settings:?}: {error:e}");
        }
    }
}

#[test]
fn ten_measurements_of_every_continuous_filter() {
    let radar = Radar::new("continuous-sequence");
    for entry in radar.golden["sequence"].as_array().unwrap() {
        let name = entry["filter"].as_str().unwrap();
        for settings in parts(name) {
            let run = radar.filter("data.csv", settings.clone(), &entry["M"]);
            let failed = entry["failed_at"].as_u64();
            assert_eq!(run.code, i32::from(failed.is_some()), "{name}: {}", run.stderr);
            let (found, means) = (run.objects(), entry["m"].as_array().unwrap());
            assert_eq!(found.len(), failed.map_or(10, |row| row as usize), "{name}");
            let last = found.len() - 1;
            for (k, (row, mean)) in found.iter().zip(means).enumerate() {
                let cov = numbers(&row["cov"]);
                let variances: Vec<f64> = (0..7).map(|i| cov[8 * i]).collect();
                let mut error = Expected::diagonal(&numbers(mean), &variances).mean_error(&row["mean"]);
                for (at, key) in [(0, "P_first"), (last, "P_last")] {
                    if k == at {
                        error = error.max(Expected::full(mean, &entry[key]).cov_error(&row["cov"]));
                    }
                }
                assert!(error < tolerance(name), "{name} {settings:?} {k}: {error:e}");
            }
        }
    }
}
