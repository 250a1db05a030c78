//! Arasaratnam & Haykin 2009: cubature Kalman filters. Moments of a multi-quadric, and an aircraft that turns.

mod curves;
mod figure_10;
mod figure_5;
mod figure_6;
mod figure_8;
mod halts;
mod levels;
mod moments;
mod multiquadric;
mod turn;

use crate::{Experiment, Paper};

/// The paper.
pub const PAPER: Paper = Paper {
    key: "arasaratnam2009cubature",
    citation: "I. Arasaratnam, S. Haykin: Cubature Kalman filters. IEEE Transactions on Automatic Control 54 (2009) \
               1254–1269.",
    experiments: &[
        Experiment {
            name: "figure-5",
            shows: "Figure 5: moments of a multi-quadric in up to 100 dimensions",
            runs: moments::OWN,
            bytes: 16_000,
            with: figure_5::run,
        },
        Experiment {
            name: "figure-6",
            shows: "Figure 6: moments of a multi-quadric in 50 dimensions, for priors of different width",
            runs: moments::OWN,
            bytes: 16_000,
            with: figure_6::run,
        },
        Experiment {
            name: "figure-8",
            shows: "Figure 8: tracking a turning aircraft, Gaussian noise",
            runs: turn::OWN,
            bytes: 12_000,
            with: figure_8::run,
        },
        Experiment {
            name: "figure-10",
            shows: "Figure 10: tracking a turning aircraft, noise of two Gaussians",
            runs: turn::OWN,
            bytes: 12_000,
            with: figure_10::run,
        },
        Experiment {
            name: "halts",
            shows: "§VIII-B: filters that halt, and filters that lose the aircraft",
            runs: halts::RUNS,
            bytes: 2_000,
            with: halts::run,
        },
    ],
};
