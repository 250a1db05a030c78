//! What is mutated, and which tests are asked.

/// Code that is mutated together.
#[derive(Debug)]
pub struct Group {
    pub name: &'static str,
    /// The crate, and its folder.
    pub package: &'static str,
    pub folder: &'static str,
    /// The files, as cargo-mutants takes them.
    pub files: &'static str,
    /// Every so many mutants are tried.
    pub every: usize,
    /// What is asked, and of what survives it, what comes next.
    pub stages: &'static [Stage],
}

/// Test programs of a package with their arguments, in the order in which they are asked; that of unit tests has the
/// package's name.
#[derive(Debug)]
pub struct Stage {
    pub package: &'static str,
    pub programs: &'static [&'static str],
    /// For programs that take long, when few mutants are left: all of them are more than an optimiser has memory for.
    pub optimised: bool,
}

const CORE: &str = "givens-core";
const ALL: &str = "givens-tests";
/// But for what simulates for minutes.
const RUN_TIME: &str = "run_time --skip calibration:: --skip coverage::";
const FILTERS: &[Stage] = &[
    Stage {
        package: CORE,
        programs: &[CORE, "rules", "alike", "ode", "packs", "continuous"],
        optimised: false,
    },
    Stage {
        package: ALL,
        programs: &["golden_discrete", "golden_continuous", "golden_oracle"],
        optimised: false,
    },
    Stage {
        package: ALL,
        programs: &["no_allocation", "ill_conditioned", "contract", "time_updates", RUN_TIME, "golden_paths"],
        optimised: true,
    },
];

const fn core(name: &'static str, files: &'static str, every: usize) -> Group {
    Group { name, package: CORE, folder: "crates/givens-core", files, every, stages: FILTERS }
}

pub const GROUPS: &[Group] = &[
    Group {
        stages: &[Stage { package: CORE, programs: &[CORE, "kernels", "packs"], optimised: true }],
        ..core("kernels", "crates/givens-core/src/kernels/**", 1)
    },
    core("rules", "crates/givens-core/src/rule/**", 1),
    core("updates", "crates/givens-core/src/filter/update/**", 1),
    core("predictions", "crates/givens-core/src/filter/predict/**", 4),
];

impl Group {
    pub fn named(name: &str) -> Option<&'static Self> {
        GROUPS.iter().find(|group| group.name == name)
    }
}

pub fn names() -> String {
    GROUPS.iter().map(|group| group.name).collect::<Vec<_>>().join(", ")
}
