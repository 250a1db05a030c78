//! Names, and the expressions that use them.

use givens_io::Model;

use super::{Case, RIGHT, check};

#[test]
fn names_that_cannot_stand_are_told() {
    check(&[
        Case(
            "\"x\", \"vx\", \"y\"]\ntime",
            "\"x\", \"x\", \"vx\", \"y\"]\ntime",
            (2, 15),
            "the name `x` is given twice",
            "rename",
        ),
        Case("q = 0.1", "q = 0.1\nx = 3", (8, 1), "`x` is a state already (line 2)", "rename"),
        Case("[let]", "[let]\nq = 3", (9, 1), "`q` is a parameter already (line 7)", "rename"),
        Case("q = 0.1", "q = 0.1\nt = 1", (8, 1), "`t` is the time", "another name"),
        Case("q = 0.1", "q = 0.1\ndt = 1", (8, 1), "`dt` is the length of a step", "another name"),
        Case("q = 0.1", "q = 0.1\npi = 3", (8, 1), "`pi` is the number π", "another name"),
        Case("q = 0.1", "q = 0.1\natan2 = 3", (8, 1), "`atan2` is a function", "another name"),
        Case("q = 0.1", "q = 0.1\nnot = 3", (8, 1), "`not` is an operator", "another name"),
        Case("q = 0.1", "q = 0.1\nu_q = 3", (8, 1), "`u_` are controls", "another name"),
        Case("q = 0.1", "q = 0.1\n\"\" = 3", (8, 1), "empty name", "give it a name"),
        Case("q = 0.1", "q = 0.1\n\"2q\" = 3", (8, 1), "`2q` cannot be the name", "letters, digits and _"),
        Case(
            "\"y\"]\ntime",
            "\"y\", \"nis\"]\ntime",
            (2, 26),
            "`nis` is a column of every output",
            "another",
        ),
        Case("px = \"x\"", "time = \"x\"", (20, 14), "`time` is a column of every table", "another name"),
        Case("px = \"x\"", "u_x = \"x\"", (20, 14), "a measure cannot be called `u_x`", "another name"),
        Case("px = \"x\"", "\" px\" = \"x\"", (20, 14), "begins or ends with a space", "another name"),
        Case("name = \"gps\"", "name = \"radar\"", (19, 8), "two sensors are called `radar`", "rename"),
        Case("name = \"gps\"", "name = \"\"", (19, 8), "sensor's name is empty", "write a name"),
    ]);
}

#[test]
fn a_state_named_as_the_deviation_of_another_is_told() {
    let text = RIGHT.replace("\"y\"]\ntime", "\"x_std\"]\ntime");
    let errors = Model::parse(&text, "m.toml").unwrap_err();
    assert!(
        errors.first().unwrap().message.contains("`x_std` is the column of a standard deviation"),
        "{errors}"
    );
}

#[test]
fn slips_in_expressions_are_told_within_the_string() {
    check(&[
        Case(
            "x + dt*vx",
            "x + dt*vz",
            (11, 28),
            "unknown name `vz` in the transition of `x`",
            "did you mean `vx`?",
        ),
        Case("x + dt*vx", "x + dt*(vx", (11, 28), "in the transition of `x`", ""),
        Case("x + dt*vx", "", (11, 21), "the expression is empty in the transition of `x`", ""),
        Case("hypot(x, y)", "hypot(x)", (9, 6), "in `r`", "hypot(x, y)"),
        Case("hypot(x, y)", "range", (9, 6), "unknown name `range` in `r`", ""),
        Case("\"atan2(y, x)\"", "\"x > 0\"", (15, 38), "condition", "where"),
        Case("\"hypot(x, y)\"", "'''\nhypot(x, yy)'''", (10, 10), "unknown name `yy` in `r`", "known here"),
        Case("\"hypot(x, y)\"", "\"h\\u0079pot(x, yy)\"", (9, 5), "unknown name `yy` in `r`", "known here"),
    ]);
}

#[test]
fn names_where_they_may_not_stand_are_told() {
    check(&[
        Case(
            "\"q*dt\"",
            "\"q*vx\"",
            (12, 18),
            "`vx` may not stand here in row 1, column 1 of `noise_cov`",
            "may not depend on the state",
        ),
        Case("\"q*dt\"", "\"r\"", (12, 16), "`r` may not stand here", "may not depend on the state"),
        Case(
            "[10, 0.1]",
            "[\"x\", 0.1]",
            (16, 9),
            "`x` may not stand here in `std` of `range`",
            "depend on the state",
        ),
        Case("[10, 0.1]", "[\"dt\", 0.1]", (16, 9), "`dt` may not stand here", "a measurement has no step"),
        Case(
            "\"atan2(y, x)\"",
            "\"dt*x\"",
            (15, 38),
            "`dt` may not stand here in the measure `bearing`",
            "no step",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, \"t\", 3]",
            (4, 13),
            "`t` may not stand here in `mean` of `vx`",
            "only numbers and parameters",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, \"x\", 3]",
            (4, 13),
            "`x` may not stand here",
            "only numbers and parameters",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, \"u_a\", 3]",
            (4, 13),
            "`u_a` may not stand here",
            "only numbers and parameters",
        ),
        Case("q = 0.1", "q = \"p\"\np = 1", (7, 6), "unknown name `p` in the parameter `q`", ""),
        Case("hypot(x, y)", "hypot(px, y)", (9, 12), "unknown name `px` in `r`", ""),
    ]);
}

#[test]
fn definitions_in_a_circle_are_told() {
    check(&[
        Case(
            "r = \"hypot(x, y)\"",
            "r = \"r + 1\"",
            (9, 1),
            "[let] defines `r` by itself: r → r",
            "without the others",
        ),
        Case("r = \"hypot(x, y)\"", "r = \"b\"\nb = \"2*c\"\nc = \"r\"", (9, 1), "r → b → c → r", ""),
    ]);
}

#[test]
fn names_that_break_a_line_are_told() {
    for (name, place) in [("a\\nb", 14), ("a\\u001b[2J", 14), ("a\\u2028b", 14)] {
        let text = RIGHT.replacen("\"radar\"", &format!("\"{name}\""), 1);
        let errors = Model::parse(&text, "m.toml").unwrap_err();
        let first = errors.first().unwrap();
        assert_eq!(first.position().0, place, "{errors}");
        assert!(first.message.contains("a line end or a control character"), "{errors}");
    }
}

#[test]
fn controls_without_their_prefix_are_told() {
    let told = |next: &str| {
        let text = RIGHT.replacen("x + dt*vx", next, 1);
        let errors = Model::parse(&text, "m.toml").unwrap_err();
        errors.first().unwrap().help.clone().unwrap()
    };
    assert_eq!(told("x + gas + u_gas"), "did you mean the control `u_gas`?");
    assert!(told("x + gas").ends_with("(a control would be `u_gas`)"));
    // where no control may stand, none is proposed
    let errors = Model::parse(&RIGHT.replacen("q = 0.1", "q = \"gas\"", 1), "m.toml").unwrap_err();
    assert!(!errors.to_string().contains("u_gas"), "{errors}");
}

#[test]
fn what_is_missing_is_told_with_the_way_to_add_it() {
    for (from, to, help) in [
        ("vx = \"vx\", ", "", "a state that stays as it is has the transition vx = \"vx\""),
        ("vx = 1, ", "", "add vx = …"),
        ("x + dt*vx", "x + dt*", "complete it"),
        ("x + dt*vx", "x + * dt", "write one before `*`"),
    ] {
        let errors = Model::parse(&RIGHT.replacen(from, to, 1), "m.toml").unwrap_err();
        assert!(errors.first().unwrap().help.as_ref().is_some_and(|told| told.contains(help)), "{errors}");
    }
}

#[test]
fn what_nests_too_deeply_is_told_at_its_line() {
    let dots = vec!["a"; 3000].join(".");
    for deep in
        [format!("{dots} = 1"), format!("x = {}", "[".repeat(3000)), format!("x = {}", "{a=".repeat(3000))]
    {
        let errors = Model::parse(&format!("[state]\n{deep}\n[dynamics]\n"), "m.toml").unwrap_err();
        assert_eq!(
            errors.first().unwrap().position().0,
            2,
            "{deep:.20}: {}",
            errors.first().unwrap().message
        );
    }
}
