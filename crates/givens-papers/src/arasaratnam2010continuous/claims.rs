//! What the paper says of its tables and figures, whose numbers the print has lost, under every reading.

use super::runs::{CKF, Cell, Cells, EKF, METHODS, OMEGAS, READINGS, UKF};
use super::statements::Statements;
use crate::estimate::{MANY, ONE, all, counted, fewer_than, more_than};
use crate::paired::{alike, better, exceeds, farthest, more_lost, ratio};
use crate::{Claim, Estimate, Trouble, Verdict};

/// A reading of one interval's runs.
struct Seen<'a> {
    cells: &'a Cells,
    reading: usize,
}

/// A statement's key and what it is judged by; what we see; what that decides; what else is known.
type Said = (&'static str, &'static str, String, Verdict);

impl Seen<'_> {
    fn steps(&self) -> &'static [usize] {
        READINGS[self.reading].steps()
    }

    fn last(&self) -> usize {
        self.steps().len() - 1
    }

    fn cell(&self, omega: usize, method: usize, steps: usize) -> &Cell {
        self.cells.get(self.reading, omega, method, steps)
    }

    fn lost(&self, omega: usize, method: usize, steps: usize) -> (usize, usize) {
        let cell = self.cell(omega, method, steps);
        (cell.lost.count(), cell.squares.len())
    }

    fn percent(&self, omega: usize, method: usize, steps: usize) -> String {
        let (lost, runs) = self.lost(omega, method, steps);
        format!("{:.0}", 100.0 * lost as f64 / runs as f64)
    }

    /// The mean square error in position of each run that was kept.
    fn positions(&self, omega: usize, method: usize, steps: usize) -> Vec<Option<f64>> {
        self.cell(omega, method, steps).squares.iter().map(|squares| squares.map(|of| of[0])).collect()
    }

    /// Losses and errors against those with the most steps.
    fn insensitive(&self) -> Said {
        // one step is few: the paper itself asks for two
        let from = usize::from(self.steps()[1] == 2);
        let (mut ratios, mut losses) = (Vec::new(), Vec::new());
        for omega in 0..OMEGAS.len() {
            let finest = self.positions(omega, CKF, self.last());
            for steps in from..self.last() {
                let coarse = self.positions(omega, CKF, steps);
                ratios.push(ratio(&coarse, &finest));
                losses.push(more_lost(&coarse, &finest));
            }
        }
        let most = losses.iter().copied().max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()));
        let percent = |of: Estimate| Estimate { value: 100.0 * of.value, error: 100.0 * of.error };
        let shown = format!(
            "errors in position against m = 64: the farthest a factor {:.2}; losses: {:.0} % of the runs more",
            farthest(ratios.iter().copied()).unwrap_or(NONE),
            most.map_or(NONE, percent)
        );
        let losses = losses.iter().map(|more| more.between([-0.1, 0.1], MANY));
        let verdict = all([alike(&ratios, 1.15), all(losses)]);
        ("insensitive", " (judged: within 15 %, and 10 % of the runs)", shown, verdict)
    }

    /// Losses and errors of the extended filter with the most steps and with one.
    fn extended_improves(&self) -> Said {
        let (mut verdicts, mut shown) = (Vec::new(), Vec::new());
        for (i, omega) in OMEGAS.iter().enumerate() {
            let [one, most] = [0, self.last()].map(|s| self.positions(i, EKF, s));
            verdicts.push(better(&most, &one, ONE));
            let lost = [0, self.last()].map(|s| self.percent(i, EKF, s));
            let word = format!("ω = {omega}: {} → {} %, {:.2}", lost[0], lost[1], ratio(&most, &one));
            shown.push(word);
        }
        let shown = format!("lost, m = 1 → 64, and the error with 64 over that with 1: {}", shown.join("; "));
        ("extended-improves", "", shown, all(verdicts))
    }

    /// More than half lost with one step, and less than half with the most, at every turn rate.
    fn unscented_survives(&self, method: usize) -> Said {
        let (mut verdicts, mut shown) = (Vec::new(), Vec::new());
        for (i, omega) in OMEGAS.iter().enumerate() {
            let [(one, of), (most, _)] = [0, self.last()].map(|s| self.lost(i, method, s));
            verdicts.extend([more_than(one, of, 0.5, ONE), fewer_than(most, of, 0.5, ONE)]);
            let lost = [0, self.last()].map(|s| self.percent(i, method, s));
            shown.push(format!("ω = {omega}: {} → {} %", lost[0], lost[1]));
        }
        let judged = if method == UKF {
            " (Euler–Maruyama; judged: half, at every ω)"
        } else {
            " (Euler's moments; judged: half, at every ω)"
        };
        let shown = format!("lost, m = 1 → 64: {}", shown.join(", "));
        ("unscented-survives", judged, shown, all(verdicts))
    }

    fn breaks_down(&self, method: usize) -> Said {
        let (key, judged) = match method {
            EKF => ("extended-breaks-down", " (judged: half of the runs)"),
            UKF => ("unscented-breaks-down", " (Euler–Maruyama; judged: half of the runs)"),
            _ => ("unscented-breaks-down", " (Euler's moments; judged: half of the runs)"),
        };
        let lost: Vec<_> = (0..=self.last()).map(|s| self.lost(2, method, s)).collect();
        let verdict = all(lost.iter().map(|&(lost, of)| more_than(lost, of, 0.5, MANY)));
        let least = lost.into_iter().min().unwrap_or_default();
        (key, judged, format!("lost at least {}", counted(least.0, least.1)), verdict)
    }

    fn cubature_breaks_down(&self) -> Said {
        let at = |m: usize| self.steps().iter().position(|&steps| steps == m).unwrap_or_default();
        let lost = |s: usize| self.lost(2, CKF, s);
        let word = |(s, m): (usize, &usize)| format!("m = {m}: {}", counted(lost(s).0, lost(s).1));
        let shown: Vec<_> = self.steps().iter().enumerate().map(word).collect();
        let (eight, of) = lost(at(8));
        ("cubature-breaks-down", " (judged at m = 8)", shown.join(", "), more_than(eight, of, 0.5, ONE))
    }

    /// By all that each run loses, over turn rates and numbers of steps.
    fn order(&self) -> Said {
        let lost = |method: usize| -> Vec<f64> {
            let settings = || (0..OMEGAS.len()).flat_map(|i| (0..=self.last()).map(move |s| (i, s)));
            let one =
                |run: usize| settings().filter(move |&(i, s)| self.cell(i, method, s).squares[run].is_none());
            let runs = self.cell(0, method, 0).squares.len();
            (0..runs).map(|run| one(run).count() as f64).collect()
        };
        let [ekf, ukf, ckf] = [EKF, UKF, CKF].map(lost);
        let more = |a: &[f64], b: &[f64]| exceeds(a.iter().zip(b).map(|(a, b)| a - b));
        let [e, u, c] = [&ekf, &ukf, &ckf].map(|of| of.iter().sum::<f64>());
        let all_runs = OMEGAS.len() * self.steps().len() * ekf.len();
        let shown = format!("lost in all, of {all_runs}: CD-CKF {c}, CD-UKF {u}, CD-EKF {e}");
        ("order", "", shown, all([more(&ukf, &ckf), more(&ekf, &ukf)]))
    }
}

const NONE: Estimate = Estimate { value: f64::NAN, error: f64::NAN };

/// What larger samples gave, of ours with seed 1 and of others, by the reading.
const LARGER: [&str; 4] = [
    "1000 runs at m = 8: 993; independent programs 98 of 100, 992 of 1000",
    "1000 runs at m = 8: 476; independent programs 37 of 100, 450 of 1000",
    "1000 runs at m = 8: 879; an independent program 873 of 1000",
    "1000 runs at m = 8: 437; an independent program 409 of 1000",
];

/// The claims of one table and its figure.
pub(super) fn claims(cells: &Cells, number: usize, interval: f64) -> Result<Vec<Claim>, Trouble> {
    const TABLES: [&str; 4] = ["Table I", "Table II", "Table III", "Table IV"];
    let name = TABLES.get(number.wrapping_sub(1)).copied().unwrap_or_default();
    let mut claims = vec![Claim::lost(
        format!("{name}: the counts"),
        "",
        "`lost`, on its page",
        "the numbers of the table are lost in the scan",
    )];
    let statements = Statements::read()?;
    for (reading, of) in READINGS.into_iter().enumerate() {
        let seen = Seen { cells, reading };
        let mut said = vec![seen.insensitive(), seen.extended_improves()];
        said.extend((UKF..CKF).map(|method| seen.unscented_survives(method)));
        if interval == 6.0 {
            said.extend((0..METHODS.len() - 1).map(|method| seen.breaks_down(method)));
        }
        if interval == 8.0 {
            said.push(seen.cubature_breaks_down());
        }
        said.push(seen.order());
        for (key, judged, ours, verdict) in said {
            let (says, page) = statements.of(key)?;
            let what = format!("{says}{judged} — {}", of.name());
            let known = if key == "cubature-breaks-down" { LARGER[reading] } else { "" };
            let claim = Claim::statement(what, ours, verdict).remark(known);
            claims.push(Claim { published: page, ..claim });
        }
    }
    Ok(claims)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arasaratnam2010continuous::runs::Cells;

    /// Cells of 60 runs, of which `lost(ω, method, m)` are lost; the others err alike.
    fn cells(lost: impl Fn(usize, usize, usize) -> usize) -> Cells {
        let mut cells = Cells::none();
        for reading in 0..READINGS.len() {
            for omega in 0..OMEGAS.len() {
                for method in 0..METHODS.len() {
                    for (s, &m) in READINGS[reading].steps().iter().enumerate() {
                        let cell = cells.get_mut(reading, omega, method, s);
                        for run in 0..60 {
                            let lost = run < lost(omega, method, m);
                            cell.squares.push((!lost).then_some([1.0 + 0.01 * run as f64; 3]));
                            if lost {
                                cell.lost.note_kind("diverged");
                            }
                        }
                    }
                }
            }
        }
        cells
    }

    fn verdict<'c>(cells: &'c Cells, what: impl FnOnce(&Seen<'c>) -> Said) -> Verdict {
        what(&Seen { cells, reading: 0 }).3
    }

    #[test]
    fn where_nobody_loses_a_run_no_order_holds() {
        let none = cells(|_, _, _| 0);
        assert!(matches!(verdict(&none, Seen::order), Verdict::Undecided(_)));
        assert!(matches!(verdict(&none, Seen::extended_improves), Verdict::Undecided(_)));
        assert_eq!(verdict(&none, Seen::insensitive), Verdict::Holds);
        let all = cells(|_, _, _| 60);
        assert!(matches!(verdict(&all, Seen::extended_improves), Verdict::Undecided(_)));
    }

    #[test]
    fn survival_is_asked_for_at_every_turn_rate() {
        let survives = |seen: &Seen<'_>| seen.unscented_survives(UKF);
        let at_all = cells(|_, _, m| if m == 1 { 60 } else { 0 });
        assert_eq!(verdict(&at_all, survives), Verdict::Holds);
        // 60 of 60 lost at 6°/s with 64 steps too
        let not_there = cells(|omega, _, m| if m == 1 || omega == 2 { 60 } else { 0 });
        assert_eq!(verdict(&not_there, survives), Verdict::Fails);
    }

    #[test]
    fn a_little_more_than_half_is_undecided() {
        let of = |lost: usize| verdict(&cells(|_, _, _| lost), Seen::cubature_breaks_down);
        assert!(matches!(of(32), Verdict::Undecided(_)));
        assert_eq!([of(54), of(6)], [Verdict::Holds, Verdict::Fails]);
    }

    #[test]
    fn fewer_losses_from_the_cubature_filter_to_the_extended_one_are_an_order() {
        let falls = |_: usize, method: usize, _: usize| [30, 10, 10, 0][method];
        assert_eq!(verdict(&cells(falls), Seen::order), Verdict::Holds);
        let turned = |_: usize, method: usize, _: usize| [10, 30, 10, 0][method];
        assert_eq!(verdict(&cells(turned), Seen::order), Verdict::Fails);
    }
}
