//! What the mutated crate is given to know which of its mutants is switched on.

/// The attribute that its root begins with.
pub const HEAD: &str = "#![feature(core_intrinsics, const_eval_select)]\n";

/// The module that its root ends with.
pub const MODULE: &str = r#"
#[doc(hidden)]
pub mod switched {
    extern crate std;
    use core::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};
    use std::io::Write;

    const UNREAD: u32 = u32::MAX;
    const NONE: u32 = u32::MAX - 1;
    const NOTE: u32 = u32::MAX - 2;
    static NUMBER: AtomicU32 = AtomicU32::new(UNREAD);
    static ASKED: [AtomicBool; 10_000] = [const { AtomicBool::new(false) }; 10_000];

    /// The number switched on, asked by the function whose mutants begin at `first`; when the compiler asks, none.
    #[inline(always)]
    pub const fn on(first: u32) -> u32 {
        core::intrinsics::const_eval_select((first,), never, asked)
    }

    const fn never(_: u32) -> u32 {
        NONE
    }

    #[inline(always)]
    fn asked(first: u32) -> u32 {
        let number = NUMBER.load(Relaxed);
        if number < NOTE { number } else { seldom(first, number) }
    }

    #[cold]
    #[inline(never)]
    fn seldom(first: u32, number: u32) -> u32 {
        let mut number = number;
        if number == UNREAD {
            let told = std::env::var("MUTANT").ok();
            number = match told.as_deref() {
                Some("note") => NOTE,
                Some(told) => told.parse().unwrap(),
                None => NONE,
            };
            NUMBER.store(number, Relaxed);
        }
        if number == NOTE && !ASKED[first as usize].swap(true, Relaxed) {
            let path = std::env::var("MUTANTS_ASKED").unwrap();
            let mut file = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
            file.write_all(std::format!("{first}\n").as_bytes()).unwrap();
        }
        number
    }
}
"#;
