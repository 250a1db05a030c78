//! Arasaratnam & Haykin 2011: cubature Kalman smoothers, on a ballistic target that re-enters the atmosphere.

mod figures;
mod runs;
mod table_4;

use crate::{Experiment, Paper};

/// The paper.
pub const PAPER: Paper = Paper {
    key: "arasaratnam2011smoothers",
    citation: "I. Arasaratnam, S. Haykin: Cubature Kalman smoothers. Automatica 47 (2011) 2245–2250.",
    experiments: &[
        Experiment {
            name: "figures-1-3",
            shows: "Figures 1–3: errors in position, velocity and ballistic coefficient over time",
            runs: runs::OWN,
            bytes: 10_000,
            with: figures::run,
        },
        Experiment {
            name: "table-4",
            shows: "Table 4: accumulated errors of the filter and of four smoothers",
            runs: runs::OWN,
            bytes: 10_000,
            with: table_4::run,
        },
    ],
};
