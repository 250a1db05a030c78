//! Särkkä & Solin 2012: continuous-discrete cubature filters by Itô–Taylor steps and by the moment equations.

mod ekf;
mod figures;
mod runs;
mod table;

pub use runs::lost;

use crate::{Experiment, Paper};

/// The paper.
pub const PAPER: Paper = Paper {
    key: "sarkka2012continuous",
    citation: "S. Särkkä, A. Solin: On continuous-discrete cubature Kalman filtering. Proc. 16th IFAC Symposium on System \
               Identification (2012).",
    experiments: &[
        Experiment {
            name: "table-1",
            shows: "Table 1 and Figure 1: runs lost and errors in position, T = 4 s",
            runs: runs::OWN,
            bytes: 8_000,
            with: table::one,
        },
        Experiment {
            name: "table-2",
            shows: "Table 2 and Figure 2: runs lost and errors in position, T = 8 s",
            runs: runs::OWN,
            bytes: 8_000,
            with: table::two,
        },
    ],
};
