//! The three trackers in a program without `std`, on the machine that builds it: runs them over recorded rows, compares them
//! with the textbook's answers and measures their stack. The exit status is the number of those that disagree. With an
//! argument, one measurement is falsified, and all must.
#![no_std]
#![no_main]

mod contest;
mod rows;
mod stack;
mod write;

use contest::{Found, run};
use core::ffi::{c_char, c_int};
use core::panic::PanicInfo;
use tracker::{LagMemory, PlaneFilter, PlaneMemory, PlaneSmoother, SpaceFilter, SpaceMemory};
use write::{end, number, text, wide};

/// Called by the C library when it has started.
// SAFETY: no other function of the program has the name.
#[unsafe(no_mangle)]
extern "C" fn main(arguments: c_int, _: *const *const c_char) -> c_int {
    let falsified = arguments > 1;
    text("tracker          rows  off: mean (σ)   deviation (1)   RAM (bytes)   stack: start    step");
    end();
    let mut wrong = 0;
    if cfg!(feature = "plane-filter") {
        let mut memory = PlaneMemory::NEW;
        let found = run::<PlaneFilter, 2, 10>(&mut memory, &rows::PLANE, &rows::PLANE_FILTERED, 0, falsified);
        wrong += tell("plane filter", size_of::<(PlaneMemory, PlaneFilter)>(), &found);
    }
    if cfg!(feature = "plane-smoother") {
        let mut memory = LagMemory::NEW;
        let found =
            run::<PlaneSmoother, 2, 10>(&mut memory, &rows::PLANE, &rows::PLANE_LAGGED, 10, falsified);
        wrong += tell("plane smoother", size_of::<(LagMemory, PlaneSmoother)>(), &found);
    }
    if cfg!(feature = "space-filter") {
        let mut memory = SpaceMemory::NEW;
        let found = run::<SpaceFilter, 3, 14>(&mut memory, &rows::SPACE, &rows::SPACE_FILTERED, 0, falsified);
        wrong += tell("space filter", size_of::<(SpaceMemory, SpaceFilter)>(), &found);
    }
    wrong
}

/// Writes the line of a tracker; 1 if it disagrees with the answers.
fn tell(name: &str, ram: usize, found: &Found) -> c_int {
    wide(name, 14);
    number(found.compared as f64, 7, 0);
    number(found.mean, 16, 5);
    number(found.deviation, 16, 5);
    number(ram as f64, 14, 0);
    text("       ");
    for depth in [found.stack_start, found.stack_step] {
        text(if depth < stack::PAINTED { "  " } else { " >" });
        number(depth as f64, 6, 0);
    }
    text(if found.agrees() { "" } else { "  disagrees" });
    end();
    c_int::from(!found.agrees())
}

/// What a microcontroller would do by a reset: no message is put together, since that is most of what a panic weighs.
#[panic_handler]
fn panic(_: &PanicInfo) -> ! {
    text("panic");
    end();
    write::leave(101)
}

/// `core` comes compiled for programs that unwind, and names what does it: not optimised, the linker wants to see it. Nothing
/// calls it.
// SAFETY: no other function of the program has the name.
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}
