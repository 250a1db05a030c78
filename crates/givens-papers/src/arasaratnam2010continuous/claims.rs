//! What the paper says of its tables and figures, whose numbers the print has lost, under every reading.

use super::figures::error;
use super::runs::{CKF, Cell, Cells, EKF, METHODS, OMEGAS, READINGS, UKF};
use crate::Claim;

/// A reading of one interval's runs.
struct Seen<'a> {
    cells: &'a Cells,
    reading: usize,
}

/// A statement, what we see, and whether it holds.
type Said = (&'static str, String, bool);

impl Seen<'_> {
    fn steps(&self) -> &'static [usize] {
        READINGS[self.reading].steps()
    }

    fn cell(&self, omega: usize, method: usize, steps: usize) -> &Cell {
        self.cells.get(self.reading, omega, method, steps)
    }

    fn share(&self, omega: usize, method: usize, steps: usize) -> f64 {
        let cell = self.cell(omega, method, steps);
        cell.lost.count() as f64 / cell.runs().max(1) as f64
    }

    fn shares(&self, omega: usize, method: usize) -> Vec<f64> {
        (0..self.steps().len()).map(|s| self.share(omega, method, s)).collect()
    }

    /// Lost of all runs of a filter, over turn rates and numbers of steps.
    fn total(&self, method: usize) -> usize {
        let each = |omega: usize| (0..self.steps().len()).map(move |s| (omega, s));
        (0..OMEGAS.len()).flat_map(each).map(|(i, s)| self.cell(i, method, s).lost.count()).sum()
    }

    fn error(&self, omega: usize, method: usize, steps: usize) -> f64 {
        error(self.cells, [self.reading, omega, method, steps], 0)
    }

    /// In what it loses, and in the error of what it keeps.
    fn insensitive(&self) -> Said {
        let (mut worst, mut change) = (1.0f64, 0.0f64);
        // one step is few: the paper itself asks for two
        let from = usize::from(self.steps()[1] == 2);
        let range = |of: &mut dyn Iterator<Item = f64>| {
            of.fold((f64::INFINITY, 0f64), |(low, high), x| (low.min(x), high.max(x)))
        };
        for omega in 0..OMEGAS.len() {
            let (low, high) = range(&mut (from..self.steps().len()).map(|s| self.share(omega, CKF, s)));
            change = change.max(high - low);
            let (low, high) = range(&mut (from..self.steps().len()).map(|s| self.error(omega, CKF, s)));
            worst = worst.max(high / low);
        }
        let shown = format!(
            "errors in position a factor of {worst:.2} apart at most, losses {:.0} % of the runs",
            100.0 * change
        );
        ("the CD-CKF hardly depends on m", shown, worst < 1.15 && change <= 0.1)
    }

    /// Losses and errors of the extended filter with the most steps and with one.
    fn extended_improves(&self) -> Said {
        let last = self.steps().len() - 1;
        let mut holds = true;
        let mut shown = Vec::new();
        for (i, omega) in OMEGAS.iter().enumerate() {
            let (one, most) = (self.share(i, EKF, 0), self.share(i, EKF, last));
            let errors = [self.error(i, EKF, 0), self.error(i, EKF, last)];
            holds &= most < one || (most == one && (errors[1] <= errors[0] || errors[0].is_nan()));
            shown.push(format!("ω = {omega}: {:.0} → {:.0} %", 100.0 * one, 100.0 * most));
        }
        ("the CD-EKF improves with m", format!("lost, m = 1 → 64: {}", shown.join(", ")), holds)
    }

    fn unscented_survives(&self, method: usize) -> Said {
        let what = if method == UKF {
            "the CD-UKF survives only with many steps (Euler–Maruyama)"
        } else {
            "the CD-UKF survives only with many steps (Euler's moments)"
        };
        let last = self.steps().len() - 1;
        let (mut lost, mut survives) = (0.0f64, 1.0f64);
        for omega in 0..OMEGAS.len() {
            lost = lost.max(self.share(omega, method, 0));
            survives = survives.min(self.share(omega, method, last));
        }
        let shown =
            format!("lost up to {:.0} % at m = 1, from {:.0} % at m = 64", 100.0 * lost, 100.0 * survives);
        (what, shown, lost > 0.5 && survives < 0.5)
    }

    fn breaks_down(&self, method: usize) -> Said {
        let what = match method {
            EKF => "the CD-EKF breaks down at ω = 6°/s, whatever m",
            UKF => "the CD-UKF breaks down at ω = 6°/s, whatever m (Euler–Maruyama)",
            _ => "the CD-UKF breaks down at ω = 6°/s, whatever m (Euler's moments)",
        };
        let least = self.shares(2, method).into_iter().fold(1.0, f64::min);
        (what, format!("lost at least {:.0} %", 100.0 * least), least >= 0.9)
    }

    fn cubature_breaks_down(&self) -> Said {
        let shares = self.shares(2, CKF);
        let shown: Vec<_> = self
            .steps()
            .iter()
            .zip(&shares)
            .map(|(m, share)| format!("{:.0} % at m = {m}", 100.0 * share))
            .collect();
        let holds = self.steps().iter().zip(&shares).any(|(&m, &share)| m == 8 && share > 0.5);
        ("the CD-CKF loses more than half of its runs at ω = 6°/s (judged at m = 8)", shown.join(", "), holds)
    }

    fn order(&self) -> Said {
        let [ekf, ukf, ckf] = [EKF, UKF, CKF].map(|method| self.total(method));
        let shown = format!("lost in all: CD-CKF {ckf}, CD-UKF {ukf}, CD-EKF {ekf}");
        ("the CD-CKF is the most reliable, then the CD-UKF, then the CD-EKF", shown, ckf <= ukf && ukf <= ekf)
    }
}

/// The claims of one table and its figure.
pub(super) fn claims(cells: &Cells, number: usize, interval: f64) -> Vec<Claim> {
    const TABLES: [&str; 4] = ["Table I", "Table II", "Table III", "Table IV"];
    let name = TABLES.get(number.wrapping_sub(1)).copied().unwrap_or_default();
    let mut claims = vec![Claim::lost(
        format!("{name}: the counts"),
        "",
        "in the table below",
        "the numbers of the table are lost in the scan",
    )];
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
        let claim =
            |(what, ours, holds): Said| Claim::statement(format!("{what} — {}", of.name()), ours, holds);
        claims.extend(said.into_iter().map(claim));
    }
    claims
}
