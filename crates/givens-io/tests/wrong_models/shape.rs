//! Syntax, keys, sections, lists and tables.

use givens_io::Model;

use super::{Case, RIGHT, check};

#[test]
fn slips_in_the_syntax_are_told_in_place() {
    check(&[
        Case("time = 0.0", "time = ", (3, 8), "not valid TOML", ""),
        Case("mean = [1, 2, 3]", "mean = [1, 2, 3", (5, 1), "not valid TOML", "lists in [ ]"),
        Case("method = \"sr-ckf\"", "method = sr-ckf", (25, 10), "not valid TOML", "strings stand in quotes"),
        Case("method = \"sr-ckf\"", "method = \"sr-ckf", (25, 17), "not valid TOML", ""),
        Case("[parameters]", "[state]", (6, 2), "duplicate key", ""),
        Case("q = 0.1", "q = 0.1\nq = 0.2", (8, 1), "duplicate key", ""),
        Case("mean =", "[mean", (4, 6), "not valid TOML", ""),
    ]);
}

#[test]
fn unknown_keys_are_told_with_the_near_one() {
    check(&[
        Case("[plot]", "[plots]", (22, 2), "unknown key `plots` in a model file", "did you mean `plot`?"),
        Case("[filter]", "[zebra]", (24, 2), "unknown key `zebra` in a model file", "has the keys `state`"),
        Case("time = 0.0", "tiem = 0.0", (3, 1), "unknown key `tiem` in [state]", "did you mean `time`?"),
        Case(
            "noise_cov =",
            "noise_covariance =",
            (12, 1),
            "unknown key `noise_covariance` in [dynamics]",
            "",
        ),
        Case(
            "angles = [\"bearing\"]",
            "angle = [\"bearing\"]",
            (17, 1),
            "unknown key `angle` in [[sensor]]",
            "`angles`",
        ),
        Case("plane =", "plan =", (23, 1), "unknown key `plan` in [plot]", "did you mean `plane`?"),
    ]);
}

#[test]
fn missing_parts_are_told() {
    check(&[
        Case("names = [\"x\", \"vx\", \"y\"]\n", "", (1, 2), "[state] has no `names`", "name the states"),
        Case("mean = [1, 2, 3]\n", "", (1, 2), "[state] has no `mean`", "initial mean of `x`, `vx`, `y`"),
        Case(
            "std = { x = 1, vx = 1, y = 2 }\n",
            "",
            (1, 2),
            "neither `std` nor `cov`",
            "standard deviation of `x`",
        ),
        Case(
            "transition = { x = \"x + dt*vx\", vx = \"vx\", y = \"y\" }\n",
            "",
            (10, 2),
            "no `transition`",
            "next value",
        ),
        Case("name = \"radar\"\n", "", (13, 1), "[[sensor]] has no `name`", "name = \"radar\""),
        Case("measures = { px = \"x\" }\n", "", (18, 1), "[[sensor]] has no `measures`", "what it measures"),
        Case("cov = [[4]]\n", "", (18, 1), "neither `std` nor `cov`", "standard deviation of each measure"),
        Case("vx = \"vx\", ", "", (11, 14), "`transition` leaves out the state `vx`", ""),
        Case("vx = 1, y = 2 }", "}", (5, 7), "`std` leaves out the states `vx`, `y`", ""),
    ]);
}

#[test]
fn missing_sections_are_told() {
    let whole = |text: &str| Model::parse(text, "m.toml").unwrap_err().errors;
    assert_eq!(whole("").len(), 2);
    assert!(whole("")[0].message.contains("the model has no [state]"));
    assert!(whole("")[1].message.contains("the model has no [dynamics]"));
    let sensor = RIGHT.find("[[sensor]]").unwrap();
    assert!(whole(&RIGHT[..sensor])[0].message.contains("the model has no sensor"));
    let dynamics = RIGHT.replace("[dynamics]", "[zebra]");
    assert!(whole(&dynamics).iter().any(|error| error.message.contains("no [dynamics]")));
}

#[test]
fn lists_and_tables_of_the_wrong_shape_are_told() {
    check(&[
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, 2]",
            (4, 8),
            "`mean` has 2 values, but there are 3 states",
            "`x`, `vx`, `y`",
        ),
        Case("mean = [1, 2, 3]", "mean = 1", (4, 8), "`mean` is a list or a table; found a number", "[ … ]"),
        Case("mean = [1, 2, 3]", "mean = [1, true, 3]", (4, 12), "found a truth value", "write a number"),
        Case("y = 2 }", "z = 2 }", (5, 24), "unknown state `z` in `std`", ""),
        Case(
            "y = \"y\" }",
            "y = \"y\", vz = \"0\" }",
            (11, 53),
            "unknown state `vz` in `transition`",
            "`vx`",
        ),
        Case(
            "[10, 0.1]",
            "[10]",
            (16, 7),
            "`std` has 1 value, but there are 2 measures",
            "`range`, `bearing`",
        ),
        Case(
            "[10, 0.1]",
            "{ range = 1, baring = 2 }",
            (16, 20),
            "unknown measure `baring` in `std`",
            "`bearing`",
        ),
        Case(
            "[[\"q*dt\", 0, 0], [0, 1, 0], [0, 0, 1]]",
            "[[1]]",
            (12, 13),
            "`noise_cov` has 1 row, but needs 3",
            "3 rows of 3",
        ),
        Case("[0, 1, 0]", "[0, 1]", (12, 30), "row 2 of `noise_cov` has 2 values, but needs 3", ""),
        Case("[0, 1, 0]", "7", (12, 30), "row 2 of `noise_cov` has a number", ""),
        Case("[[4]]", "4", (21, 7), "`cov` is a list of rows; found a number", "[[…], …]"),
        Case(
            "measures = { px = \"x\" }",
            "measures = [\"x\"]",
            (20, 12),
            "`measures` is a table",
            "what it measures",
        ),
        Case("measures = { px = \"x\" }", "measures = {}", (20, 12), "measures nothing", "what it measures"),
        Case(
            "names = [\"x\", \"vx\", \"y\"]",
            "names = \"x\"",
            (2, 9),
            "`names` is a list of names",
            "write [",
        ),
        Case(
            "names = [\"x\", \"vx\", \"y\"]",
            "names = []",
            (2, 9),
            "the model has no state",
            "at least one",
        ),
        Case(
            "names = [\"x\", \"vx\", \"y\"]",
            "names = [\"x\", 3]",
            (2, 15),
            "`names` is a text; found a number",
            "quotes",
        ),
        Case("name = \"radar\"", "name = 3", (14, 8), "`name` is a text; found a number", "quotes"),
        Case(
            "plane = [\"x\", \"y\"]",
            "plane = [\"x\"]",
            (23, 9),
            "`plane` names two states, not 1",
            "horizontal",
        ),
        Case("method = \"sr-ckf\"", "method = 3", (25, 10), "`method` is a text; found a number", "quotes"),
        Case("method = \"sr-ckf\"", "kappa = [1]", (25, 9), "`kappa` in [filter]", "single values"),
        Case("method = \"sr-ckf\"", "kappa = nan", (25, 9), "found no finite number", ""),
    ]);
}

#[test]
fn single_brackets_for_a_sensor_are_told() {
    let text = RIGHT.replacen("[[sensor]]", "[sensor]", 1).replacen(
        "[[sensor]]\nname = \"gps\"\nmeasures = { px = \"x\" }\ncov = [[4]]\n",
        "",
        1,
    );
    let errors = Model::parse(&text, "m.toml").unwrap_err();
    assert!(errors.first().unwrap().help.as_ref().unwrap().contains("[[sensor]]"), "{errors}");
}
