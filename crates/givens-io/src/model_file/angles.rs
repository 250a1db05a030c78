//! `angles`: which measures are wrapped, and at what period.

use core::f64::consts::TAU;

use givens_core::scalar::Shown;

use super::context::Context;
use super::document::Kind;
use super::section::{Named, Section, texts};
use super::vocabulary::Role;

/// The period of each measure that is an angle.
pub(super) fn periods(
    context: &mut Context,
    sensor: &Section,
    measures: &[String],
) -> Option<Vec<Option<f64>>> {
    let mut periods = vec![None; measures.len()];
    let Some(entry) = sensor.get("angles") else { return Some(periods) };
    let named = Named { noun: "measure", names: measures };
    let mut good = true;
    if let Kind::Table(entries) = &entry.value.kind {
        let scope = context.scope(Role::Fixed);
        for angle in entries {
            let what = format!("the period of `{}`", angle.key);
            let index = named.index(context.findings, &angle.key, &angle.span, "`angles`");
            let period = context.number(&scope, &angle.value, &what);
            let positive = period.is_none_or(|period| period > 0.0);
            if !positive {
                let message =
                    format!("{what} is {}, but a period is greater than zero", Shown(period.unwrap_or(0.0)));
                context.findings.wrong_help(
                    &angle.value.span,
                    message,
                    "write 360 for degrees, \"2*pi\" for radians",
                );
            }
            match index {
                Some(index) if period.is_some() && positive => periods[index] = period,
                _ => good = false,
            }
        }
        return good.then_some(periods);
    }
    for (name, span) in texts(context.findings, &entry.value, "`angles`")? {
        match named.index(context.findings, name, span, "`angles`") {
            Some(index) if periods[index].is_some() => {
                context.findings.wrong_help(
                    span,
                    format!("`{name}` stands twice in `angles`"),
                    "remove one of them",
                );
                good = false;
            }
            Some(index) => periods[index] = Some(TAU),
            None => good = false,
        }
    }
    good.then_some(periods)
}
