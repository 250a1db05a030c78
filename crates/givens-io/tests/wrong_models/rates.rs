//! Slips in `rate`.

use super::values::with_start;

/// States of `start` that are right, and the first error of a file with another one beside them.
fn told(vx: &str) -> (usize, usize, String) {
    let start = format!("start = {{ x = \"range*cos(bearing)\", vx = \"{vx}\" }}");
    let mut errors = with_start(&format!("{start}\nmean = {{ y = 0 }}\nstd = {{ y = 1 }}"));
    assert_eq!(errors.len(), 1, "{vx}: {errors:?}");
    errors.remove(0)
}

#[test]
fn what_has_no_rate_is_told() {
    let place = |vx: &str, column: usize, words: &str| {
        let (line, found, message) = told(vx);
        assert_eq!((line, found), (3, column), "{message}");
        assert!(message.contains(words), "{message}");
    };
    place("rate(px)", 48, "`rate(px)` may not stand here in the start of `vx`");
    place("rate(y)", 48, "`rate(y)` may not stand here");
    place("rate(vx)", 48, "`rate(vx)` may not stand here");
    place("rate(xx)", 48, "there is no `rate(xx)`");
    place("2*rate(x*2)", 51, "`rate` takes a name, and nothing beside it");
    place("rate(3)", 48, "`rate` takes a name");
    place("rate()", 48, "`rate` takes a name");
    place("rate(x", 47, "never closed");
    place("rate", 43, "unknown name `rate`");
}

#[test]
fn a_rate_of_what_is_wrong_itself_is_told_once() {
    let start = "start = { x = \"range*cos(\", vx = \"rate(x)\" }\nmean = { y = 0 }\nstd = { y = 1 }";
    let errors = with_start(start);
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].2.contains("the start of `x`"), "{errors:?}");
}
