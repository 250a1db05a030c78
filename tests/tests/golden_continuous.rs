//! `golden/continuous.json`: every time update of the papers, alone and within ten measurements, through the library.

use givens::filter::predict::{
    EulerMaruyama, Gauge, ItoTaylor, LevelSet, MomentOde, Root, Variant, Velocity,
};
use givens::filter::{Block, Covariance, Filter, Form, Gaussian, Method, Over, SquareRoot, StepError};
use givens::model::Observation;
use givens::model::zoo::{Radar3d, Turn3d};
use givens::ode::{Integrator, Solver, Steps, Tolerance};
use givens::rule::{Cubature3, GaussHermite, Rule, Taylor, Unscented};
use givens_tests::{cov_error, golden, mean_error, numbers};
use serde_json::Value;
use std::marker::PhantomData;

/// A method from any parts.
#[derive(Clone, Copy)]
struct Parts<R, U, F> {
    rule: R,
    time: U,
    form: PhantomData<F>,
}

impl<R: Rule, U: Copy, F: Form> Method for Parts<R, U, F> {
    type Rule = R;
    type Form = F;
    type Time = U;
    fn rule(&self) -> R {
        self.rule
    }
    fn time_update(&self) -> U {
        self.time
    }
    fn block(&self) -> Block {
        Block::Joint
    }
}

fn parts<R, U, F>(rule: R, time: U, _: F) -> Parts<R, U, F> {
    Parts { rule, time, form: PhantomData }
}

type Own<X> = Filter<'static, X, Turn3d, f64, Vec<f64>>;

static TURN: Turn3d = Turn3d { velocity: 0.447_213_595_499_957_9, rate: 7e-3 };

fn start<X: Over<Turn3d>>(method: X, prior: &Gaussian) -> Own<X> {
    method.start(&TURN, 0.0, prior).unwrap()
}

fn prior(value: &Value) -> Gaussian {
    Gaussian::from_cov(&numbers(&value["m0"]), &numbers(&value["P0"])).unwrap()
}

/// What a question asks of the method that a name stands for.
trait Question {
    type Answer;
    fn ask<X: Over<Turn3d>>(&self, method: X) -> Self::Answer;
}

/// Asks the method of a name of the golden file, with M sub-steps; in square-root form where it exists too.
fn ask<Q: Question>(name: &str, m: usize, question: &Q) -> Vec<Q::Answer> {
    let steps = Steps::Count(m);
    let integrator = |solver, rtol| MomentOde { integrator: solver_of(solver, m, rtol) };
    let rk4 = integrator(Solver::Rk4, 1e-6);
    let ukf = Unscented::default();
    let gh = GaussHermite { points: 3 };
    let (full, simplified, once) = (
        ItoTaylor { variant: Variant::Full, steps },
        ItoTaylor { variant: Variant::Simplified, steps },
        ItoTaylor { variant: Variant::NoiseOnce, steps },
    );
    let em = EulerMaruyama { steps };
    macro_rules! both {
        ($rule:expr, $time:expr) => {
            vec![question.ask(parts($rule, $time, Covariance)), question.ask(parts($rule, $time, SquareRoot))]
        };
    }
    match name {
        "EKF-RK4" => vec![question.ask(parts(Taylor, rk4, Covariance))],
        "EKF-Euler" => both!(Taylor, em),
        "CKF1" => both!(Cubature3, full),
        "UKF1" => both!(ukf, full),
        "GHKF1" => both!(gh, full),
        "CKF2" => vec![question.ask(parts(Cubature3, rk4, Covariance))],
        "UKF2" => vec![question.ask(parts(ukf, rk4, Covariance))],
        "GHKF2" => vec![question.ask(parts(gh, rk4, Covariance))],
        "UKF-Euler" => vec![question.ask(parts(ukf, integrator(Solver::Euler, 1e-6), Covariance))],
        "UKF-EM" => both!(ukf, em),
        "CKF2010-sub" => both!(Cubature3, simplified),
        "CKF2010-once" => both!(Cubature3, once),
        "SQRT2" => vec![question.ask(parts(Cubature3, rk4, SquareRoot))],
        _ => {
            let (velocity, solver) = name.strip_prefix("LSKF-").unwrap().rsplit_once('-').unwrap();
            let velocity = match velocity {
                "std" => Velocity::Standard,
                "avg_printed" => Velocity::AveragedPrinted,
                "avg_code" => Velocity::Averaged,
                "partial_mean" => Velocity::Partial,
                "partial_x1" => Velocity::PartialPrinted,
                "avg_sqrtn" => Velocity::Cubature,
                other => panic!("no velocity {other}"),
            };
            let solver = match solver {
                "RK1" => Solver::Euler,
                "RK2" => Solver::Rk2,
                "RK4" => Solver::Rk4,
                "AD" => Solver::Dp5,
                other => panic!("no solver {other}"),
            };
            // the golden update draws its points from the root as the step has left it
            let time = LevelSet {
                velocity,
                gauge: Gauge::Free,
                root: Root::Moved,
                integrator: solver_of(solver, m, 1e-11),
            };
            vec![question.ask(parts(Cubature3, time, SquareRoot))]
        }
    }
}

fn solver_of(solver: Solver, m: usize, rtol: f64) -> Integrator {
    let tolerance = Tolerance { rtol, atol: 0.0 };
    Integrator { solver, steps: Steps::Count(m), tolerance, ..Integrator::default() }
}

fn tolerance(name: &str) -> f64 {
    if name.ends_with("AD") { 1e-8 } else { 1e-10 }
}

struct Predict<'a> {
    golden: &'a Value,
    start: Gaussian,
}

impl Question for Predict<'_> {
    type Answer = (f64, f64);
    fn ask<X: Over<Turn3d>>(&self, method: X) -> (f64, f64) {
        let mut f = start(method, &self.start);
        f.predict(self.golden["T"].as_f64().unwrap()).unwrap();
        let cov = numbers(&self.golden["P"]);
        (mean_error(f.mean(), &numbers(&self.golden["m"]), &cov), cov_error(&f.cov(), &cov, 7))
    }
}

#[test]
fn one_interval_agrees_for_every_filter() {
    let golden = golden("continuous.json");
    let start = prior(&golden["radar_sequence"]);
    for entry in golden["predict"].as_array().unwrap() {
        let (name, m) = (entry["filter"].as_str().unwrap(), entry["M"].as_u64().unwrap() as usize);
        assert!(entry["ok"].as_bool().unwrap());
        for (mean, cov) in ask(name, m, &Predict { golden: entry, start: start.clone() }) {
            println!("{name} M = {m}: mean {mean:.1e} cov {cov:.1e}");
            assert!(mean < tolerance(name) && cov < tolerance(name), "{name} M = {m}: {mean:e} {cov:e}");
        }
    }
}

struct Sequence<'a> {
    z: &'a [f64],
    interval: f64,
    start: Gaussian,
}

/// The filtered means and covariances, and the step that failed if one did.
type Answers = (Vec<(Vec<f64>, Vec<f64>)>, Option<(usize, StepError)>);

impl Question for Sequence<'_> {
    type Answer = Answers;
    fn ask<X: Over<Turn3d>>(&self, method: X) -> Answers {
        let (radar, mut f) = (Radar3d::default(), start(method, &self.start));
        let mut answers = Vec::new();
        for (k, z) in self.z.chunks_exact(radar.measures()).enumerate() {
            let time = self.interval * (k + 1) as f64;
            if let Err(error) = f.predict(time).and_then(|()| f.update(&radar, z)) {
                return (answers, Some((k, error)));
            }
            answers.push((f.mean().to_vec(), f.cov()));
        }
        (answers, None)
    }
}

#[test]
fn ten_measurements_agree_for_every_filter_and_fail_where_it_must() {
    let golden = golden("continuous.json");
    let radar = &golden["radar_sequence"];
    let question =
        Sequence { z: &numbers(&radar["z"]), interval: radar["T"].as_f64().unwrap(), start: prior(radar) };
    for entry in golden["sequence"].as_array().unwrap() {
        let (name, m) = (entry["filter"].as_str().unwrap(), entry["M"].as_u64().unwrap() as usize);
        for (answers, failed) in ask(name, m, &question) {
            assert_eq!(failed.map(|(k, _)| k as u64), entry["failed_at"].as_u64(), "{name}: {failed:?}");
            let means = numbers(&entry["m"]);
            assert_eq!(answers.len() * 7, means.len(), "{name}");
            let (first, last) = (numbers(&entry["P_first"]), numbers(&entry["P_last"]));
            let mut worst = (0.0_f64, 0.0_f64);
            for ((mean, cov), expected) in answers.iter().zip(means.chunks_exact(7)) {
                worst.0 = worst.0.max(mean_error(mean, expected, cov));
            }
            worst.1 =
                cov_error(&answers[0].1, &first, 7).max(cov_error(&answers[answers.len() - 1].1, &last, 7));
            println!("{name}: mean {:.1e} cov {:.1e}", worst.0, worst.1);
            assert!(worst.0 < tolerance(name) && worst.1 < tolerance(name), "{name}: {worst:?}");
        }
    }
}

struct Update<'a> {
    golden: &'a Value,
    angle: bool,
}

/// The radar with or without an azimuth that is an angle.
struct Plain(Radar3d, bool);

impl Observation for Plain {
    fn states(&self) -> usize {
        7
    }
    fn measures(&self) -> usize {
        3
    }
    fn angle(&self, i: usize) -> Option<f64> {
        self.0.angle(i).filter(|_| self.1)
    }
    fn observe<T: givens::scalar::Real>(&self, at: &givens::model::At<T>, x: &[T], z: &mut [T]) {
        self.0.observe(at, x, z);
    }
    fn noise(&self) -> givens::model::Noise {
        self.0.noise()
    }
    fn measurement_noise<T: givens::scalar::Real>(&self, at: &givens::model::At<T>, out: &mut [T]) {
        self.0.measurement_noise(at, out);
    }
}

impl Question for Update<'_> {
    type Answer = (f64, f64);
    fn ask<X: Over<Turn3d>>(&self, method: X) -> (f64, f64) {
        let mut f = start(method, &prior(self.golden));
        f.update(&Plain(Radar3d::default(), self.angle), &numbers(&self.golden["z"])).unwrap();
        let cov = numbers(&self.golden["P"]);
        (mean_error(f.mean(), &numbers(&self.golden["m"]), &cov), cov_error(&f.cov(), &cov, 7))
    }
}

#[test]
fn one_update_agrees_for_every_rule_on_and_off_the_circle() {
    let golden = golden("continuous.json");
    let steps = Steps::Count(1);
    for entry in golden["update"].as_array().unwrap() {
        if entry["root"].as_str() == Some("symmetric") {
            // a root that no filter of ours carries: the rules take the lower one
            continue;
        }
        let question = Update { golden: entry, angle: entry["wrap"].as_bool().unwrap_or(true) };
        let em = EulerMaruyama { steps };
        let rule = entry["rule"].as_str().unwrap();
        macro_rules! both {
            ($rule:expr) => {
                vec![question.ask(parts($rule, em, Covariance)), question.ask(parts($rule, em, SquareRoot))]
            };
        }
        let answers = match rule {
            "ekf" => both!(Taylor),
            "ckf" | "sqrt-ckf" => both!(Cubature3),
            "ukf" => both!(Unscented::default()),
            "gh3" => both!(GaussHermite { points: 3 }),
            other => panic!("no rule {other}"),
        };
        for (mean, cov) in answers {
            assert!(mean < 1e-10 && cov < 1e-10, "{rule} {:?}: {mean:e} {cov:e}", entry["wrap"]);
        }
    }
}
