//! Against the number of states.

use super::peak;
use super::study::{Besides, Guide, Point, Series, Study};
use crate::models::{Circle, Every};
use crate::problem::{Problem, prior};
use crate::single;
use givens::Data;
use givens::simulate::{Stream, simulate};
use givens_contest::{Failure, Inputs, Table};
use givens_core::filter::{Ckf, Over, SrCdCkf, SrCkf};
use givens_core::model::{At, Transition};

const SIZES: [usize; 12] = [2, 3, 5, 10, 20, 30, 50, 100, 200, 300, 500, 1000];
/// Derivatives of second order in as many directions as there are states take longer than a page is worth.
const MOST_IN_CONTINUOUS_TIME: usize = 100;
/// From here on the cube may be compared with.
const LARGE: usize = 10;
/// Seconds between rows.
const GAP: f64 = 0.05;

/// Multiplications and additions of one step of the textbook's covariance filter with n states, n/2 measures, as a
/// multiple of n³: both Cholesky factors 2/3; X Xᵀ of 2n deviations, one half of it, 2; Z Zᵀ 1/2 and X Zᵀ 2; the gain by two
/// substitutions 1/2; half of K P_zz Kᵀ 1/2. The model is left out.
const TEXTBOOK: f64 = 2.0 / 3.0 + 2.0 + 0.5 + 2.0 + 0.5 + 0.5;

pub fn study(_: &Inputs) -> Result<Study, Failure> {
    let peak = peak::operations_per_nanosecond()?;
    let continuous = SrCdCkf { substeps: 1, ..Default::default() };
    Ok(Study {
        name: "states",
        title: "Against the number of states",
        about: "Lorenz-96 as in W5, its rows drawn with a fixed seed; one filter, all matrices dense but the noises' roots, every other component measured. `sr-ckf` and `ckf` over one \
                step of the classic Runge–Kutta method, `sr-cd-ckf` by one sub-step of order 1.5.",
        x: "states",
        y: "one step",
        wall: false,
        series: vec![
            series("sr-ckf", SrCkf::default(), usize::MAX)?,
            series("ckf", Ckf::default(), usize::MAX)?,
            series("sr-cd-ckf", continuous, MOST_IN_CONTINUOUS_TIME)?,
        ],
        guides: vec![
            Guide {
                name: format!("{TEXTBOOK:.1} n³ operations at {peak:.1} GFLOP/s"),
                at: Box::new(move |_, n| (n >= LARGE).then(|| TEXTBOOK * cube(n) / peak)),
            },
            Guide {
                name: "n³".to_owned(),
                at: Box::new(|series, n| Some(cube(n) * last(series).filter(|_| n >= LARGE)?)),
            },
        ],
        besides: Besides::Cube,
    })
}

fn cube(n: usize) -> f64 {
    (n as f64).powi(3)
}

/// The time of the largest size in the first series, by its cube.
fn last(series: &[Series]) -> Option<f64> {
    let point = series.first()?.points.last()?;
    Some(point.time?.median / cube(point.x))
}

fn series<X: Over<Circle> + 'static>(name: &'static str, method: X, most: usize) -> Result<Series, Failure> {
    let mut points = Vec::new();
    for n in SIZES.into_iter().filter(|&n| n <= most) {
        // a repetition of some milliseconds where that can be
        let steps = (2e6 / cube(n)).clamp(2.0, 1000.0) as usize;
        let (mean, rows) = drawn(n, steps)?;
        let prior = prior(&mean, &vec![1.0; n])?;
        let (model, sensor) = (Circle(n), Every(n));
        let problem = Problem { method, model, sensor, prior, dt: GAP, rows, steps, every: steps };
        points.push(Point::new(n, single::untold(problem)));
    }
    Ok(Series { name, points })
}

/// A state on the attractor, and measurements from there on.
fn drawn(n: usize, steps: usize) -> Result<(Vec<f64>, Table), Failure> {
    let (model, sensor) = (Circle(n), Every(n));
    let at = At { t: 0.0, dt: GAP, u: &[], p: &[] };
    let (mut x, mut next) = (vec![8.0; n], vec![0.0; n]);
    x[0] += 0.01;
    for _ in 0..1000 {
        model.transition(&at, &x, &mut next);
        x.copy_from_slice(&next);
    }
    let mut times = Data::new(n / 2).starting_at(0.0);
    for k in 0..steps {
        times.push(GAP * (k + 1) as f64, &vec![0.0; n / 2])?;
    }
    let begin = prior(&x, &vec![1.0; n])?;
    let values = simulate(&model, &sensor, times.rows(), 0.0, &begin, &mut Stream::new(1, 0, 0))?.z;
    Ok((x, Table { columns: n / 2, values }))
}
