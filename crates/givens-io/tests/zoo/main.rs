//! The models of the zoo and the model files of `examples/zoo` say the same: drift, diffusion, Jacobian and Itô derivatives at
//! random points, the files by symbol, the Rust ones by duals, and both as finite differences have them.
#![allow(clippy::unwrap_used, clippy::panic)]

mod calculus;

use calculus::{by_differences, in_units_of, of};
use givens_core::model::zoo::{
    Circadian, HarmonicOscillator, Lorenz63, Lorenz96, OrnsteinUhlenbeck, Radar3d, RangeAside, Reentry,
    Turn3d, VanDerPol,
};
use givens_core::model::{At, Observation, Sde};
use givens_io::Model;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/zoo")
}

fn file(name: &str) -> Model {
    let path = folder().join(format!("{name}.toml"));
    Model::read(path.to_str().unwrap()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// 20 points about `centre`, up to `spread` away in each component, at times of one day.
fn points<const N: usize>(centre: [f64; N], spread: [f64; N]) -> Vec<(f64, Vec<f64>)> {
    // a linear congruential generator: only the points are to be anywhere
    let mut state = 1_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut point = || (0..N).map(|i| centre[i] + spread[i] * (2.0 * uniform() - 1.0)).collect();
    (0..20).map(|k| (1.2 * f64::from(k) + 0.1, point())).collect()
}

#[track_caller]
fn near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(0.0_f64, |max, value| max.max(value.abs()));
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance * scale, "{what}: {found:?} is not {expected:?}");
    }
}

/// The file `name` and `model` agree to 1e-12 of the largest entry, in units of `spread`, and with finite differences to what these can do.
#[track_caller]
fn agree<M: Sde, const N: usize>(name: &str, model: &M, centre: [f64; N], spread: [f64; N]) {
    let file = file(name);
    let written = file.dynamics.continuous().unwrap();
    assert_eq!((written.states(), written.noises()), (N, model.noises()), "{name}");
    for (t, x) in points(centre, spread) {
        let scaled = |calculus| in_units_of(&spread, calculus);
        let (symbol, duals) = (scaled(of(written, t, &x)), scaled(of(model, t, &x)));
        let differences = scaled(by_differences(model, t, &x, &spread));
        for k in 0..symbol.len() {
            let (what, found) = &duals[k];
            near(found, &symbol[k].1, 1e-12, &format!("{name}: {what} of the file"));
            near(found, &differences[k].1, 1e-6, &format!("{name}: {what} by differences"));
        }
    }
}

/// The stacked sensors of the file `name` and `sensor` agree.
#[track_caller]
fn sensors_agree<H: Observation>(name: &str, sensor: &H, points: &[(f64, Vec<f64>)]) {
    let written = file(name).observation;
    for (t, x) in points {
        let [mut found, mut expected] = [0; 2].map(|_| vec![0.0; sensor.measures()]);
        let [mut noise, mut root] = [0; 2].map(|_| vec![0.0; sensor.measures().pow(2)]);
        let at = At { t: *t, dt: 0.0, u: &[], p: &[] };
        sensor.observe(&at, x, &mut expected);
        let _ = sensor.noise_root(&at, &mut root);
        let p: Vec<f64> = file(name).parameters.iter().map(|(_, value)| *value).collect();
        let at = At { p: &p, ..at };
        written.observe(&at, x, &mut found);
        let _ = written.noise_root(&at, &mut noise);
        near(&found, &expected, 1e-14, name);
        near(&noise, &root, 1e-14, name);
    }
}

#[test]
fn ornstein_uhlenbeck() {
    agree("ornstein_uhlenbeck", &OrnsteinUhlenbeck::default(), [0.0], [2.0]);
}

#[test]
fn harmonic_oscillator() {
    agree("harmonic_oscillator", &HarmonicOscillator::default(), [0.0; 2], [2.0; 2]);
}

#[test]
fn van_der_pol() {
    agree("van_der_pol", &VanDerPol::default(), [0.0; 2], [3.0; 2]);
}

#[test]
fn reentry() {
    let model = Reentry { speed_noise: 5.0, coefficient_noise: 1e-5, ..Default::default() };
    let (centre, spread) = ([30e3, 2000.0, 4.5e-4], [25e3, 1500.0, 3e-4]);
    agree("reentry", &model, centre, spread);
    sensors_agree("reentry", &RangeAside::default(), &points(centre, spread));
}

#[test]
fn lorenz_63() {
    agree("lorenz_63", &Lorenz63::default(), [0.0, 0.0, 25.0], [15.0, 20.0, 20.0]);
}

#[test]
fn lorenz_96() {
    agree("lorenz_96", &Lorenz96 { states: 8, ..Default::default() }, [3.0; 8], [8.0; 8]);
}

#[test]
fn circadian() {
    agree("circadian", &Circadian::default(), [0.0, 0.0, 0.5], [1.2, 1.2, 0.5]);
}

#[test]
fn turn_3d() {
    let model = Turn3d { velocity: 0.2_f64.sqrt(), rate: 7e-4 };
    let centre = [0.0, 0.0, 0.0, 0.0, 1000.0, 0.0, 0.1];
    let spread = [3e3, 150.0, 3e3, 150.0, 500.0, 10.0, 0.1];
    agree("turn_3d", &model, centre, spread);
    sensors_agree("turn_3d", &Radar3d::default(), &points(centre, spread));
}

#[test]
fn every_file_of_the_folder_has_its_test_and_its_row() {
    let mut files: Vec<String> = std::fs::read_dir(folder())
        .unwrap()
        .filter_map(|entry| entry.unwrap().file_name().to_str()?.strip_suffix(".toml").map(str::to_owned))
        .collect();
    files.sort();
    let mut tested = ["ornstein_uhlenbeck", "harmonic_oscillator", "van_der_pol", "reentry"].to_vec();
    tested.extend(["lorenz_63", "lorenz_96", "circadian", "turn_3d"]);
    tested.sort_unstable();
    assert_eq!(files, tested);
    let readme = std::fs::read_to_string(folder().join("README.md")).unwrap();
    for name in tested {
        assert!(readme.contains(&format!("| `{name}.toml` |")), "{name}");
    }
}
