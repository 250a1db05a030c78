//! A filter stepped by hand, with any calls in any order, and resumed from snapshots that may have been changed.

use crate::bytes::Bytes;
use crate::world::{Moves, World, refused};
use crate::{method, promise};
use givens::filter::Snapshot;
use givens::registry::{AnyFilter, Choice, Kind};

pub(crate) fn body(data: &[u8]) {
    let bytes = &mut Bytes(data);
    let kind = if bytes.flag() { Kind::Continuous } else { Kind::Discrete };
    let Some(world) = World::any(bytes, kind) else { return };
    let Some(choice) = method::method(bytes, kind, world.states) else { return };
    let Some(prior) = world.prior(bytes) else { return };
    let t0 = bytes.plain();
    let started = match &world.moves {
        Moves::Discrete(model) => choice.start(model, &world.sensors, t0, &prior),
        Moves::Continuous(model) => choice.start_continuous(model, &world.sensors, t0, &prior),
    };
    let Some(mut filter) = refused(started) else { return };
    for _ in 0..12 {
        if bytes.is_empty() {
            break;
        }
        call(&mut filter, &world, &choice, bytes);
        sound(&filter);
    }
}

/// One call; what fails leaves the belief as it was.
fn call<'w>(filter: &mut AnyFilter<'w>, world: &'w World, choice: &Choice, bytes: &mut Bytes) {
    let before = (filter.time(), filter.mean().to_vec(), filter.factor().to_vec());
    let done = match bytes.below(8) {
        0..=2 => {
            let gap = match world.period {
                Some(period) if bytes.below(8) < 7 => f64::from(bytes.byte() % 4) * period,
                Some(_) => f64::NAN,
                None => bytes.number(),
            };
            let to = filter.time() + gap;
            // a prediction is made in steps, and the belief is that of the last of them
            return refused(filter.predict(to)).unwrap_or(());
        }
        3 | 4 => {
            let count = if bytes.below(16) == 15 { bytes.below(6) } else { world.measures };
            let z: Vec<f64> =
                (0..count).map(|_| if bytes.below(5) == 4 { f64::NAN } else { bytes.number() }).collect();
            filter.update(&z)
        }
        5 => {
            let count = if bytes.below(8) == 7 { bytes.below(6) } else { world.controls };
            filter.set_controls(&bytes.numbers(count))
        }
        6 => {
            let count = if bytes.below(8) == 7 { bytes.below(6) } else { world.parameters };
            filter.set_parameters(&bytes.numbers(count))
        }
        _ => {
            let whole = filter.snapshot();
            let mut snapshot = whole.clone();
            changed(&mut snapshot, bytes);
            let resumed = match &world.moves {
                Moves::Discrete(model) => choice.resume(model, &world.sensors, &snapshot),
                Moves::Continuous(model) => choice.resume_continuous(model, &world.sensors, &snapshot),
            };
            match refused(resumed) {
                Some(resumed) => *filter = resumed,
                None => assert!(snapshot != whole, "a filter's own snapshot is refused: {whole:?}"),
            }
            return;
        }
    };
    if let Err(error) = done {
        promise::told(&error, choice);
        assert_eq!(before, (filter.time(), filter.mean().to_vec(), filter.factor().to_vec()));
    }
}

/// What a filter tells at any time.
fn sound(filter: &AnyFilter) {
    let n = filter.states();
    assert!(filter.time().is_finite());
    assert!(filter.mean().iter().chain(filter.factor()).all(|x| x.is_finite()), "{filter:?}");
    // of a root that a snapshot brought, the square may be beyond the range of numbers
    let large = filter.factor().iter().any(|x| x.abs() > 1e150);
    assert!(large || filter.cov().iter().all(|x| x.is_finite()), "{filter:?}");
    promise::lower(filter.factor(), n);
    assert!(filter.dof() <= filter.measures());
    assert_eq!(filter.dof() == 0, filter.nis().is_nan());
    assert!(filter.dof() == 0 || filter.nis() >= 0.0 && filter.nis().is_finite(), "{}", filter.nis());
    assert!(filter.log_likelihood().is_finite());
    let (nu, cov) = filter.whole_innovation();
    assert_eq!((nu.len(), cov.len()), (filter.measures(), filter.measures().pow(2)));
    assert!(!format!("{filter:?}").is_empty());
}

/// A snapshot as a file may give it back: one number, or one length, may be another.
fn changed(snapshot: &mut Snapshot, bytes: &mut Bytes) {
    let fields = [
        &mut snapshot.mean,
        &mut snapshot.factor,
        &mut snapshot.cov,
        &mut snapshot.moved,
        &mut snapshot.floor,
        &mut snapshot.parameters,
    ];
    let which = bytes.below(10);
    if let Some(field) = fields.into_iter().nth(which) {
        match bytes.below(4) {
            0 => field.resize(bytes.below(20), 1.0),
            _ if !field.is_empty() => {
                let at = bytes.below(field.len());
                field[at] = bytes.number();
            }
            _ => {}
        }
    }
    match which {
        6 => snapshot.time = bytes.number(),
        7 => snapshot.step = bytes.length(),
        8 => snapshot.controls = Some(bytes.numbers(bytes.0.len().min(3))),
        _ => {}
    }
}
