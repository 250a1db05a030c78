//! What is promised of every answer, and of every refusal.

use givens::explain::{Explain, Face};
use givens::filter::StepError;
use givens::registry::Choice;
use givens::{Estimates, Outcome};
use givens_io::InputErrors;

/// Errors lie on a line that is there, in a column that is there or one beyond, and say something.
pub(crate) fn well_placed(text: &str, errors: &InputErrors) {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    assert!(!errors.errors.is_empty());
    for error in &errors.errors {
        assert!(!error.message.is_empty());
        let Some(place) = &error.place else { continue };
        let line = text.split('\n').nth(place.line - 1).expect("the line is there");
        assert_eq!(line.trim_end_matches('\r'), place.source);
        assert!(place.column >= 1 && place.column <= line.chars().count() + 1, "{place:?}");
    }
    assert!(!errors.to_string().is_empty());
}

/// Finished rows are whole and finite, and a failure stands right behind them, in words.
pub(crate) fn kept(outcome: &Outcome, rows: usize, choice: &Choice) {
    let est = &outcome.estimates;
    finite(est);
    finite(&outcome.at);
    assert!(est.len() <= rows, "{} estimates of {rows} rows", est.len());
    assert!(!outcome.log_likelihood.is_nan());
    match &outcome.failure {
        None => assert!(outcome.failed_at.is_empty()),
        Some((row, error)) => {
            assert!(*row <= rows, "row {row} of {rows}");
            told(error, choice);
        }
    }
}

/// A failure in words.
pub(crate) fn told(error: &StepError, choice: &Choice) {
    assert!(!error.to_string().is_empty());
    for face in [Face::Python, Face::Command] {
        let explain = Explain { face, kind: choice.kind(), states: &["x"], measures: &["z"] };
        let told = explain.told(Some(choice), &error.fault);
        assert!(!told.what.is_empty() && told.remedy.is_none_or(|remedy| !remedy.is_empty()));
    }
}

/// Means and covariances are finite; roots are lower triangular with a non-negative diagonal.
pub(crate) fn finite(est: &Estimates) {
    let n = est.states();
    for k in 0..est.len() {
        let all = [est.mean(k), est.cov(k), est.factor(k), est.predicted_mean(k), est.predicted_cov(k)];
        assert!(all.iter().all(|of| of.iter().all(|x| x.is_finite())), "row {k}: {est:?}");
        lower(est.factor(k), n);
        assert!((0..n).all(|i| est.std(k, i) >= 0.0));
        if est.is_smoothed() {
            assert!(
                est.filtered_mean(k).iter().chain(est.filtered_cov(k)).all(|x| x.is_finite()),
                "row {k}: {est:?}"
            );
        }
        assert!(est.log_likelihood[k].is_finite() && est.time[k].is_finite(), "row {k}: {est:?}");
        assert!(est.nis_dof[k] <= est.measures());
        assert_eq!(est.nis_dof[k] == 0, est.nis[k].is_nan(), "row {k}: {est:?}");
        assert!(est.nis_dof[k] == 0 || est.nis[k] >= 0.0 && est.nis[k].is_finite(), "row {k}: {est:?}");
    }
}

/// A lower-triangular root with a non-negative diagonal.
pub(crate) fn lower(factor: &[f64], n: usize) {
    for i in 0..n {
        assert!(factor[i * n + i] >= 0.0, "{factor:?}");
        assert!((i + 1..n).all(|j| factor[i * n + j] == 0.0), "{factor:?}");
    }
}

/// Two runs gave the same rows to the bit.
pub(crate) fn same(a: &Estimates, b: &Estimates) {
    assert_eq!(a.len(), b.len());
    let bits =
        |of: &[f64]| of.iter().map(|x| if x.is_nan() { u64::MAX } else { x.to_bits() }).collect::<Vec<_>>();
    for k in 0..a.len() {
        for (a, b) in [
            (a.mean(k), b.mean(k)),
            (a.cov(k), b.cov(k)),
            (a.factor(k), b.factor(k)),
            (&a.nis[k..=k], &b.nis[k..=k]),
            (&a.log_likelihood[k..=k], &b.log_likelihood[k..=k]),
        ] {
            assert_eq!(bits(a), bits(b), "row {k}");
        }
    }
}
