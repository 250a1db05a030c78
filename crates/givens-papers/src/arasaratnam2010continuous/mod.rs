//! Arasaratnam, Haykin & Hurd 2010: the continuous-discrete cubature filter, after an aircraft that turns.

mod claims;
mod counted;
mod figures;
mod runs;
mod start;
mod statements;
mod table_5;
mod tables;

pub use runs::lost;

use crate::{Experiment, Paper};

const fn table(name: &'static str, shows: &'static str, with: crate::paper::Run) -> Experiment {
    Experiment { name, shows, runs: runs::OWN, bytes: 32_000, with }
}

/// The paper.
pub const PAPER: Paper = Paper {
    key: "arasaratnam2010continuous",
    citation: "I. Arasaratnam, S. Haykin, T. R. Hurd: Cubature Kalman filtering for continuous-discrete systems: theory and \
               simulations. IEEE Transactions on Signal Processing 58 (2010) 4977–4993.",
    experiments: &[
        table("table-1", "Table I and Figure 2: runs lost and errors, T = 2 s", tables::two),
        table("table-2", "Table II and Figure 3: runs lost and errors, T = 4 s", tables::four),
        table("table-3", "Table III and Figure 4: runs lost and errors, T = 6 s", tables::six),
        table("table-4", "Table IV and Figure 5: runs lost and errors, T = 8 s", tables::eight),
        Experiment {
            name: "table-5",
            shows: "Table V: operations of the square-root filter, counted",
            runs: 0,
            bytes: 0,
            with: table_5::run,
        },
    ],
};
