//! Figure 5: the velocities of the level set where the drift is quadratic, from random roots.

use super::convergence::{Moments, distance};
use super::shear::{Shear, density_error, truth};
use crate::drawing::{axis, line};
use crate::estimate::{MANY, ONE, all, exactly};
use crate::page::Table;
use crate::statistics::{mean, mean_of, spread};
use crate::{Claim, Estimate, Page, Plan, Trouble, Verdict};
use givens::filter::predict::Velocity;
use givens::simulate::Stream;
use givens_io::figure::{Block, Colour, Figure, Grid, Mark, Panel, Scale, Shape};

/// Random roots of the paper.
pub(super) const OWN: usize = 1024;
const TRACK: u32 = 202_105;
/// Times 0, 0.05, …, 1.
const TIMES: usize = 21;
/// Name, colour in the paper (the last two are not in it), velocity.
const METHODS: [(&str, Colour, Velocity); 5] = [
    ("partially averaged", Colour::BLUE, Velocity::Partial),
    ("averaged (eq 49)", Colour::VERMILION, Velocity::AveragedPrinted),
    ("standard", Colour::ORANGE, Velocity::Standard),
    ("averaged, central", Colour::PURPLE, Velocity::Averaged),
    ("cubature radius", Colour::GREEN, Velocity::Cubature),
];

fn time(k: usize) -> f64 {
    k as f64 / (TIMES - 1) as f64
}

/// The moments of one trial, by method, then by time.
type Trial = Vec<Vec<Moments>>;

fn trial(seed: u64, run: u32) -> Result<Trial, Trouble> {
    let mut stream = Stream::new(seed, TRACK, run);
    let shear = Shear::random(|| stream.normal());
    let times = |velocity| (0..TIMES).map(|k| shear.predicted(velocity, time(k))).collect();
    METHODS.iter().map(|&(.., velocity)| times(velocity)).collect()
}

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let trials: Vec<Trial> =
        plan.each(plan.runs(OWN), |run| trial(plan.seed, run)).into_iter().collect::<Result<_, _>>()?;
    let sample: Vec<&Trial> = trials.iter().collect();
    let at = |m: usize, k: usize| trials.iter().map(|trial| density_error(&trial[m][k], time(k))).collect();
    let of_method = |m: usize| (0..TIMES).map(|k| at(m, k)).collect();
    let densities: Vec<Vec<Vec<f64>>> = (0..METHODS.len()).map(of_method).collect();
    let (mut table, mut errors, mut deviations) = (columns(), Vec::new(), Vec::new());
    for (m, (name, ..)) in METHODS.iter().enumerate() {
        let (mut of_error, mut of_deviation) = (Vec::new(), Vec::new());
        for k in 0..TIMES {
            let (t, (true_mean, true_cov)) = (time(k), truth(time(k)));
            let found = |trial: &Trial| trial[m][k].clone();
            let [of_density, deviation] = [mean(densities[m][k].iter().copied()), deviation(&sample, m, k)];
            let numbers = [
                of_density,
                mean(trials.iter().map(|trial| distance(&found(trial).0, &true_mean))),
                mean(trials.iter().map(|trial| distance(&found(trial).1, &true_cov))),
                mean(trials.iter().map(|trial| found(trial).0[1])),
                mean(trials.iter().map(|trial| found(trial).1[3])),
                deviation,
            ];
            let mut row = vec![(*name).into(), t.into()];
            row.extend(numbers.map(Into::into));
            table.rows.push(row);
            of_error.push([t, of_density]);
            of_deviation.push([t, deviation]);
        }
        errors.push(of_error);
        deviations.push(of_deviation);
    }
    let claims = claims(&sample, &densities);
    let figure = drawn(trials.first(), errors, deviations);
    Ok(Page {
        about: format!(
            "{} random roots of the identity. The flow is (0, x²) without noise, x and y begin independent of variance 1; \
             at t the mean of y is t and its variance 1 + 2t². The error is the L2 norm of the difference of the Gaussian's \
             density and the true one, the mean over all roots; the deviation that of an element of the covariance over the \
             roots, the mean over its four elements. The paper does not say until when it ran: here until t = 1. Not in \
             the paper: the averaged velocity by central differences, which its authors' program has, and the cubature \
             radius.",
            trials.len()
        ),
        claims,
        tables: vec![table],
        figures: vec![("velocities", figure)],
        ..Page::default()
    })
}

fn columns() -> Table {
    Table::new(
        "velocities",
        &[
            "velocity",
            "time",
            "density error",
            "mean error",
            "covariance error",
            "mean of y",
            "variance of y",
            "deviation of the covariance",
        ],
    )
}

/// The standard deviation over the trials of an element of the covariance, the mean over the four.
fn deviation<'t>(trials: &[&'t Trial], method: usize, k: usize) -> f64 {
    let of = |element: usize| {
        let all = || trials.iter().map(|trial: &&'t Trial| trial[method][k].1[element]);
        let middle = mean(all());
        mean(all().map(|x| (x - middle).powi(2))).sqrt()
    };
    (0..4).map(of).sum::<f64>() / 4.0
}

/// What the errors of the densities and the covariances say: `densities` by method, then by time, then by trial.
fn claims(trials: &[&Trial], densities: &[Vec<Vec<f64>>]) -> Vec<Claim> {
    let last = TIMES - 1;
    let less = |m: usize, than: usize, k: usize| {
        let pairs = densities[m][k].iter().zip(&densities[than][k]);
        mean_of(pairs.map(|(one, other)| other - one)).above(0.0, MANY)
    };
    let shown = |m: usize| format!("{:.4}", mean_of(densities[m][last].iter().copied()));
    let below = |what: &str, m: usize| {
        let verdicts: Vec<Verdict> = (1..TIMES).map(|k| less(m, 2, k)).collect();
        let times = verdicts.iter().filter(|&&verdict| verdict == Verdict::Holds).count();
        let ours = format!(
            "at t = 1 {} against {}; less by 3 σ at {times} of {} times",
            shown(m),
            shown(2),
            TIMES - 1
        );
        Claim::statement(what, ours, all(verdicts))
    };
    let deviates = |m: usize| {
        let more = |sample: &mut dyn Iterator<Item = &&Trial>| {
            let sample: Vec<&Trial> = sample.copied().collect();
            deviation(&sample, 0, last) - deviation(&sample, m, last)
        };
        Estimate { value: more(&mut trials.iter()), error: spread(trials, more) }
    };
    let (printed, central) = (deviates(1), deviates(3));
    let means = [2, 3, 4].map(|m| mean(trials.iter().map(|trial| trial[m][last].0[1])));
    vec![
        below("the partially averaged velocity has less error than the standard one", 0),
        below("the averaged velocity (eq 49) has less error than the standard one", 1),
        below("the averaged velocity, central, has less error than the standard one", 3),
        Claim::statement(
            "the averaged velocity's covariance depends less on the root than the partially averaged one's",
            format!("its deviation at t = 1 is less by {printed:.4} (eq 49) and by {central:.4} (central)"),
            all([printed, central].map(|less| less.above(0.0, ONE))),
        ),
        Claim::statement(
            "not in the paper: the mean of y, which is 1 at t = 1, is exact at the cubature radius and at no other",
            format!("standard {:.4}, averaged {:.4}, cubature radius {:.4}", means[0], means[1], means[2]),
            exactly((means[2] - 1.0).abs() < 1e-9 && means[..2].iter().all(|mean| (mean - 1.0).abs() > 0.1)),
        ),
        Claim::statement(
            "not in the paper: the velocity whose mean is exact has the least error of the density",
            format!("at t = 1, cubature radius {} against {} averaged, central", shown(4), shown(3)),
            all((0..4).map(|m| less(4, m, last))),
        )
        .explained("neither velocity sees the variance of y grow, and half the shift costs the density less than all of it"),
        Claim::lost(
            "heights of the curves of Figure 5",
            "",
            "`velocities`, on its page",
            "they stand in the figure alone, without the time at which it ends",
        ),
    ]
}

fn drawn(first: Option<&Trial>, errors: Vec<Vec<[f64; 2]>>, deviations: Vec<Vec<[f64; 2]>>) -> Figure {
    let circle = |at: &dyn Fn(f64, f64) -> [f64; 2]| -> Vec<[f64; 2]> {
        (0..=96)
            .map(|k| (core::f64::consts::TAU * f64::from(k) / 96.0).sin_cos())
            .map(|(s, c)| at(c, s))
            .collect()
    };
    let mut marks = vec![Mark::new(
        "the true level set",
        Colour::GREY,
        Shape::Line { points: circle(&|c, s| [c, s + c * c]), width: 1.6, dashed: true },
    )];
    for ((name, colour, _), times) in METHODS.iter().zip(first.into_iter().flatten()) {
        let (mean, cov) = &times[TIMES - 1];
        let root = [cov[0].sqrt(), cov[2] / cov[0].sqrt()];
        let rest = (cov[3] - root[1] * root[1]).max(0.0).sqrt();
        let at = |c: f64, s: f64| [mean[0] + root[0] * c, mean[1] + root[1] * c + rest * s];
        marks.push(line(name, *colour, circle(&at)));
        marks.push(line("", *colour, times.iter().map(|(mean, _)| [mean[0], mean[1]]).collect()));
        let centre = Shape::Dots { points: vec![[mean[0], mean[1]]], radius: 3.0, hollow: false };
        marks.push(Mark::new("", *colour, centre));
    }
    let lines = |of: Vec<Vec<[f64; 2]>>| {
        METHODS.iter().zip(of).map(|((name, colour, _), points)| line(name, *colour, points)).collect()
    };
    let plane = Panel {
        heading: "(a) centres, and level sets at t = 1, of one root".to_owned(),
        x: axis("x", Scale::Linear),
        y: axis("y", Scale::Linear),
        equal: true,
        marks,
        ..Panel::default()
    };
    let over = |heading: &str, label: &str, marks: Vec<Mark>| Panel {
        heading: heading.to_owned(),
        x: axis("t", Scale::Linear),
        y: axis(label, Scale::Linear),
        marks,
        ..Panel::default()
    };
    let panels = [
        plane,
        over("(b) error", "L2 error of the density", lines(errors)),
        over("(c) dependence on the root", "deviation of the covariance", lines(deviations)),
    ];
    let cells = panels.into_iter().map(Some).collect();
    let body = Block::Grid(Grid { columns: vec![1.0; 3], rows: vec![1.0], cells });
    let title = "The velocities of the level set in a quadratic flow".to_owned();
    Figure { title, notes: Vec::new(), key: true, body, width: 1200.0, height: 380.0 }
}
