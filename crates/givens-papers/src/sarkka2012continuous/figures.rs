//! What the text says of Figures 1 and 2.

use super::runs::{Cell, Cells, METHODS, STEPS};
use crate::estimate::{MANY, NOTHING, ONE, all};
use crate::paired::{alike, farthest, ratio};
use crate::statistics::root_of;
use crate::{Claim, Estimate, Verdict};

/// Which runs errors are of.
type Of = fn(&Cell) -> &[Option<f64>];
const KEPT: Of = |cell| &cell.kept;
const ENDED: Of = |cell| &cell.ended;
/// Both readings, in words.
const READINGS: [(&str, Of); 2] = [
    ("runs that strayed beyond 1000 m left out of all filters", KEPT),
    ("strayed runs in the errors of all filters", ENDED),
];

/// A filter, by its key, with so many steps.
fn cell<'c>(cells: &'c Cells, key: &str, steps: usize) -> Option<&'c Cell> {
    let method = METHODS.iter().position(|method| method.key == key)?;
    Some(&cells[method][STEPS.iter().position(|&m| m == steps)?])
}

/// The error of one filter over that of another, each with a number of steps, on the runs that both have.
fn over(cells: &Cells, a: (&str, usize), b: (&str, usize), of: Of) -> Estimate {
    match (cell(cells, a.0, a.1), cell(cells, b.0, b.1)) {
        (Some(a), Some(b)) => ratio(of(a), of(b)),
        _ => Estimate { value: f64::NAN, error: f64::NAN },
    }
}

/// Pairs of filters whose errors are practically the same at these numbers of steps.
fn same(cells: &Cells, what: &str, pairs: &[(&str, &str)], steps: &[usize]) -> Claim {
    let of = |&(a, b): &(&str, &str), m: usize| over(cells, (a, m), (b, m), KEPT);
    let ratios: Vec<Estimate> =
        pairs.iter().flat_map(|pair| steps.iter().map(move |&m| of(pair, m))).collect();
    let far = farthest(ratios.iter().copied()).map_or_else(String::new, |ratio| format!("{ratio:.3}"));
    let verdict = alike(&ratios, 1.1);
    Claim::statement(
        format!("{what} (judged: within 10 %)"),
        format!("on the same runs the farthest a factor {far}"),
        verdict,
    )
}

/// Figure 1.
pub(super) fn one(cells: &Cells) -> Vec<Claim> {
    let mut claims = vec![
        same(
            cells,
            "the Itô–Taylor filters have practically the same errors",
            &[("ckf1", "ukf1"), ("ckf1", "ghkf1")],
            &STEPS,
        ),
        same(
            cells,
            "so have the moment filters from M = 16",
            &[("ckf1", "ckf2"), ("ukf1", "ukf2"), ("ghkf1", "ghkf2")],
            &[16, 32, 64],
        ),
    ];
    claims.extend(READINGS.map(|(reading, of)| {
        let error = |m: usize| {
            root_of(cell(cells, "ekf", m).into_iter().flat_map(|cell| of(cell).iter().flatten().copied()))
        };
        let by = |a: &&usize, b: &&usize| error(**a).value.total_cmp(&error(**b).value);
        let ends = STEPS.iter().min_by(by).zip(STEPS.iter().max_by(by));
        let (ours, verdict) = ends.map_or((String::new(), Verdict::Undecided(NOTHING)), |(&low, &high)| {
            let ratio = over(cells, ("ekf", high), ("ekf", low), of);
            let ours = format!(
                "from {:.0} m at M = {low} to {:.0} m at M = {high}; on the same runs a factor {ratio:.2}",
                error(low),
                error(high)
            );
            (ours, ratio.above(3.0, ONE))
        });
        let what = "the CD-EKF's errors are high with some M and low with others (judged: a factor of 3";
        Claim::statement(format!("{what}; {reading})"), ours, verdict)
    }));
    claims
}

/// Figure 2.
pub(super) fn two(cells: &Cells) -> Vec<Claim> {
    let mut claims: Vec<Claim> = READINGS
        .map(|(reading, of)| {
            let ratios = STEPS.map(|m| over(cells, ("ekf", m), ("ghkf1", m), of));
            let least = ratios.iter().copied().filter(|ratio| ratio.value.is_finite());
            let least = least.min_by(|a, b| a.value.total_cmp(&b.value));
            let shown = least.map_or_else(|| "–".to_owned(), |least| format!("{least:.2}"));
            Claim::statement(
                format!("the CD-EKF's errors are an order of magnitude higher than the others' (judged: ten times; {reading})"),
                format!("over those of the CD-GHKF1, on the same runs: at least {shown} times"),
                all(ratios.iter().map(|ratio| ratio.above(10.0, MANY))),
            )
        })
        .into();
    claims.push(same(
        cells,
        "corresponding filters by Itô–Taylor and by moments have practically the same errors after M = 8",
        &[("ckf1", "ckf2"), ("ghkf1", "ghkf2")],
        &[16, 32, 64],
    ));
    claims.push(smaller(cells));
    claims
}

/// The Gauss–Hermite filters against the others of their kind.
fn smaller(cells: &Cells) -> Claim {
    let mut ratios = Vec::new();
    for (hermite, others) in [("ghkf1", ["ckf1", "ukf1"]), ("ghkf2", ["ckf2", "ukf2"])] {
        for other in others {
            ratios.extend(
                [8, 16, 32, 64].map(|m| (hermite, other, m, over(cells, (hermite, m), (other, m), KEPT))),
            );
        }
    }
    let largest = ratios.iter().max_by(|a, b| a.3.value.total_cmp(&b.3.value));
    let shown = largest.map_or_else(String::new, |(hermite, other, m, ratio)| {
        format!("{} over {} at M = {m}: {ratio:.3}", hermite.to_uppercase(), other.to_uppercase())
    });
    Claim::statement(
        "from M = 8 both Gauss–Hermite filters have smaller errors than the cubature and unscented ones",
        format!("on the same runs the largest of {} ratios: {shown}", ratios.len()),
        all(ratios.iter().map(|(.., ratio)| ratio.below(1.0, MANY))),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(square: impl Fn(&str, usize) -> Option<f64>) -> Cells {
        let mut cells = Cells::default();
        for (method, of) in METHODS.iter().zip(&mut cells) {
            for cell in of {
                cell.kept = (0..30).map(|run| square(method.key, run)).collect();
                // three runs of the extended filter strayed
                cell.ended = cell.kept.iter().map(|kept| kept.or(Some(1e12))).collect();
            }
        }
        cells
    }

    #[test]
    fn strayed_runs_make_no_order_of_magnitude_where_they_are_left_out() {
        let of = cells(|key, run| {
            (key != "ekf" || run > 2).then_some(if key == "ekf" { 2.0 } else { 1.0 } + 0.01 * run as f64)
        });
        let claims = two(&of);
        assert_eq!(claims[0].verdict, Verdict::Fails, "{}", claims[0].ours);
        assert!(claims[0].ours.contains("at least 1.3"), "{}", claims[0].ours);
        // with them in, three runs in thirty make the whole error
        assert_eq!(claims[1].verdict, Verdict::Holds, "{}", claims[1].ours);
    }

    #[test]
    fn the_ratio_that_decides_is_named() {
        let of = cells(|key, run| {
            Some(
                if key == "ukf2" {
                    0.5
                } else if key.starts_with("gh") {
                    0.8
                } else {
                    1.0
                } + 0.001 * run as f64,
            )
        });
        let claim = smaller(&of);
        assert_eq!(claim.verdict, Verdict::Fails);
        assert!(claim.ours.contains("GHKF2 over UKF2 at M = "), "{}", claim.ours);
    }
}
