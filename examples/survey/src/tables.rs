//! The tables. Their digits are fewer than the arithmetic's, so that every machine writes the same.

use core::fmt::Write;

use crate::recording::Fix;

const HEADER: &str = "time,east_fix,north_fix,up_fix,u_vel_east,u_vel_north\n";

/// Whether fix `k` is one of those held out, every `every`-th.
pub fn is_held_out(k: usize, every: usize) -> bool {
    k % every == every - 1
}

/// All fixes in s, m and m/s; with `every`, those held out are rows without measures.
pub fn fixes(fixes: &[Fix], every: Option<usize>) -> String {
    let mut table = HEADER.to_owned();
    for (k, fix) in fixes.iter().enumerate() {
        let there = every.is_none_or(|every| !is_held_out(k, every));
        row(&mut table, fix.time, there.then_some(fix.place), fix.velocity);
    }
    table
}

/// A row; empty cells without a place.
fn row(table: &mut String, time: f64, place: Option<[f64; 3]>, [v_east, v_north]: [f64; 2]) {
    let place = place.map_or(",,".to_owned(), |[east, north, up]| format!("{east:.1},{north:.1},{up:.1}"));
    // writing to a string cannot fail
    let _ = writeln!(table, "{time},{place},{v_east:.1},{v_north:.1}");
}

#[cfg(test)]
mod tests {
    use super::{Fix, fixes};

    const FLIGHT: [Fix; 3] = [
        Fix { time: 20.0, place: [1.0, 2.0, 3.0], velocity: [4.0, 5.0] },
        Fix { time: 22.0, place: [6.0, 7.0, 8.0], velocity: [9.0, 10.0] },
        Fix { time: 23.0, place: [0.0; 3], velocity: [0.0; 2] },
    ];

    #[test]
    fn a_fix_held_out_is_a_row_without_measures() {
        let table = fixes(&FLIGHT, Some(2));
        let rows: Vec<&str> = table.lines().skip(1).collect();
        assert_eq!(rows, ["20,1.0,2.0,3.0,4.0,5.0", "22,,,,9.0,10.0", "23,0.0,0.0,0.0,0.0,0.0"]);
    }
}
