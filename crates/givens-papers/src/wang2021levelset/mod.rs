//! Wang & Forger 2021: the level-set Kalman filter, its convergence, and the comparison with the cubature filter on a
//! turning aircraft.

mod comparison;
mod convergence;
mod figure_1;
mod figure_2;
mod figure_3;
mod figure_4;
mod figure_5;
mod grid;
mod shear;

use crate::{Experiment, Paper};

/// The paper.
pub const PAPER: Paper = Paper {
    key: "wang2021levelset",
    citation: "N. Wang, D. B. Forger: The level set Kalman filter for state estimation of continuous-discrete systems. 2021 \
               (arXiv 2103.11130, version 3).",
    experiments: &[
        Experiment {
            name: "figure-1",
            shows: "Figure 1: the level set converges at its solver's order (linear drift, §3.3)",
            runs: 0,
            bytes: 0,
            with: figure_1::run,
        },
        Experiment {
            name: "figure-2",
            shows: "Figure 2: orders of the time updates on an oscillator (§3.5)",
            runs: 0,
            bytes: 0,
            with: figure_2::run,
        },
        Experiment {
            name: "figure-3",
            shows: "Figure 3: errors and divergences on the turning aircraft against the number of sub-steps (§4)",
            runs: comparison::OWN,
            bytes: 20_000,
            with: figure_3::run,
        },
        Experiment {
            name: "figure-4",
            shows: "Figure 4: errors on the turning aircraft against the interval between measurements (§4)",
            runs: comparison::OWN,
            bytes: 20_000,
            with: figure_4::run,
        },
        Experiment {
            name: "figure-5",
            shows: "Figure 5: the velocities of the level set in a quadratic flow, from random roots (Appendix A)",
            runs: figure_5::OWN,
            bytes: 16_000,
            with: figure_5::run,
        },
    ],
};
