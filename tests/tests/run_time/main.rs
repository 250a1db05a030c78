//! What a front end of run time is promised, over the whole registry: filters stepped by hand, snapshots, factors, joint draws, batches, packs, streams, the gate, calibration.

mod batches;
mod by_hand;
mod calibration;
mod coverage;
mod factors;
mod gate;
mod gate_limits;
mod lanes;
mod neighbours;
mod packs;
mod samples;
mod simulated;
mod single;
mod snapshots;
mod streamed;
mod streams;
