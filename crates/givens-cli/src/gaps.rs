//! Times without rows, for a report: found in a few ways over the rows, of which a few are in memory.

use crate::judgement::place;
use crate::message::{Stop, count, digits};
use crate::plan::Plan;
use givens_io::{Page, Tone};
use std::io;

/// The longest gaps that are named.
const NAMED: usize = 5;
/// A gap so many times the usual one is told.
const LONG: f64 = 10.0;

/// Tells the gaps of all tracks.
pub fn tell(page: &mut Page, plan: &Plan) -> Result<(), Stop> {
    page.heading("Gaps");
    let Some((usual, gaps)) = usual(plan)? else {
        page.say(Tone::Plain, "No track has measured rows at two times.");
        return Ok(());
    };
    let (mut long, mut longest) = (0, Vec::new());
    each(plan, |gap| {
        if gap.length > LONG * usual {
            long += 1;
            longest.push(gap);
            longest.sort_by(|a, b| b.length.total_cmp(&a.length));
            longest.truncate(NAMED);
        }
    })?;
    let begins = format!("The usual gap between measured rows is {}; ", digits(usual));
    if long == 0 {
        page.say(Tone::Good, &format!("{begins}none is {LONG} times as long."));
    } else {
        page.say(Tone::Look, &format!("{begins}{long} of {gaps} are more than {LONG} times as long."));
    }
    let mut empty = 0;
    for row in plan.tracks.tracks.iter().flat_map(|track| track.rows.iter()) {
        empty += usize::from(!row?.measured());
    }
    if empty > 0 {
        page.say(Tone::Plain, &format!("{} without a measure: predictions.", count(empty, "row")));
    }
    let row = |gap: Gap| {
        let track = &plan.tracks.tracks[gap.track];
        vec![place(plan, track, gap.line), gap.from, gap.to, digits(gap.length)]
    };
    page.table(&["behind row", "from", "to", "length"], &longest.into_iter().map(row).collect::<Vec<_>>());
    Ok(())
}

/// A time between two measured rows.
struct Gap {
    length: f64,
    track: usize,
    /// Of the row before.
    line: usize,
    from: String,
    to: String,
}

/// The gaps of all tracks, one after the other.
fn each(plan: &Plan, mut take: impl FnMut(Gap)) -> io::Result<()> {
    for (track, of) in plan.tracks.tracks.iter().enumerate() {
        let mut before: Option<(f64, usize, String)> = None;
        for row in of.rows.iter() {
            let row = row?;
            if !row.measured() {
                continue;
            }
            let now = (row.time, row.line, row.time_text.clone());
            if let Some((time, line, from)) = before.replace(now)
                && row.time > time
            {
                take(Gap { length: row.time - time, track, line, from, to: row.time_text.clone() });
            }
        }
    }
    Ok(())
}

/// The gap than which no more than half are longer, and how many there are; none where there are none. Positive numbers stand in
/// the order of their bits, so that it is found sixteen bits at a time.
fn usual(plan: &Plan) -> io::Result<Option<(f64, usize)>> {
    let (mut all, mut longer, mut found) = (0, 0, 0_u64);
    for shift in [48, 32, 16, 0] {
        let mut counts = vec![0_usize; 1 << 16];
        each(plan, |gap| {
            let bits = gap.length.to_bits();
            // those that agree in the bits that were found
            if shift == 48 || bits >> (shift + 16) == found {
                counts[(bits >> shift & 0xffff) as usize] += 1;
            }
        })?;
        if shift == 48 {
            all = counts.iter().sum();
        }
        if all == 0 {
            return Ok(None);
        }
        let mut digit = counts.len() - 1;
        while longer + counts[digit] <= all / 2 {
            longer += counts[digit];
            digit -= 1;
        }
        found = found << 16 | digit as u64;
    }
    Ok(Some((f64::from_bits(found), all)))
}
