//! Slips in `drift` and `diffusion`, and models that are half discrete.

use givens_io::Model;

use super::{Case, RIGHT, check_in};

/// [`RIGHT`] in continuous time.
fn right() -> String {
    let (head, tail) = RIGHT.split_once("transition").unwrap();
    let tail = tail.split_once("[[sensor]]").unwrap().1;
    let dynamics = "drift = { x = \"vx\", vx = \"-q*vx\", y = 0 }\ndiffusion = { vx = \"sqrt(q)\", y = 1 }\n";
    format!("{head}{dynamics}[[sensor]]{tail}")
}

#[test]
fn the_right_file_is_right() {
    assert!(Model::parse(&right(), "model.toml").is_ok());
}

#[test]
fn a_model_of_two_kinds_is_told() {
    check_in(
        &right(),
        &[
            Case(
                "[dynamics]\n",
                "[dynamics]\ntransition = [\"x\", \"vx\", \"y\"]\n",
                (12, 1),
                "[dynamics] has both `transition` and `drift`",
                "remove one pair",
            ),
            Case(
                "y = 0 }\n",
                "y = 0 }\ntransition = [\"x\", \"vx\", \"y\"]\n",
                (12, 1),
                "[dynamics] has both `drift` and `transition`",
                "remove one pair",
            ),
            Case(
                "diffusion = { vx = \"sqrt(q)\", y = 1 }",
                "noise_cov = [[0, 0, 0], [0, 1, 0], [0, 0, 1]]",
                (12, 1),
                "`noise_cov` is the noise of a `transition`, but the model is continuous",
                "write `diffusion`",
            ),
            Case(
                "y = 0 }\n",
                "y = 0 }\nstep = 0.1\n",
                (12, 1),
                "`step` is the step of a `transition`, but the model is continuous",
                "`substeps` or `max_step` in [filter]",
            ),
        ],
    );
    check_in(
        RIGHT,
        &[Case(
            "[dynamics]\n",
            "[dynamics]\ndiffusion = [1, 1, 1]\n",
            (11, 1),
            "`diffusion` is the noise of a `drift`, but the model is discrete",
            "write `noise_cov`",
        )],
    );
}

#[test]
fn half_a_model_is_told() {
    check_in(
        &right(),
        &[
            Case(
                "drift = { x = \"vx\", vx = \"-q*vx\", y = 0 }\n",
                "",
                (10, 2),
                "[dynamics] has no `drift`",
                "the rate of change of every state",
            ),
            Case(
                "drift = { x = \"vx\", vx = \"-q*vx\", y = 0 }\ndiffusion = { vx = \"sqrt(q)\", y = 1 }\n",
                "",
                (10, 2),
                "[dynamics] has neither `transition` nor `drift`",
                "drift = { x = \"vx\", … }",
            ),
            Case(
                "vx = \"-q*vx\", y = 0 }",
                "y = 0 }",
                (11, 9),
                "`drift` leaves out the state `vx`",
                "a state that stays as it is has the drift vx = 0",
            ),
            Case(
                "{ x = \"vx\", vx = \"-q*vx\", y = 0 }",
                "[0, 1]",
                (11, 9),
                "`drift` has 2 values, but there are 3 states",
                "in this order",
            ),
            Case("y = 0 }", "yy = 0 }", (11, 35), "unknown state `yy` in `drift`", "the states are"),
            Case("y = 1 }", "yy = 1 }", (12, 31), "unknown state `yy` in `diffusion`", "the states are"),
        ],
    );
}

#[test]
fn what_drift_and_diffusion_may_not_name_is_told() {
    check_in(
        &right(),
        &[
            Case(
                "\"-q*vx\"",
                "\"-q*vx*dt\"",
                (11, 33),
                "`dt` may not stand here in the drift of `vx`",
                "drift and diffusion are rates, which hold at a moment",
            ),
            Case(
                "\"sqrt(q)\"",
                "\"sqrt(q*dt)\"",
                (12, 28),
                "`dt` may not stand here in the diffusion of `vx`",
                "only `transition` and `noise_cov` have a step",
            ),
            Case(
                "\"-q*vx\"",
                "\"-q*vz\"",
                (11, 30),
                "unknown name `vz` in the drift of `vx`",
                "did you mean `vx`?",
            ),
            Case("\"sqrt(q)\"", "\"q > 0\"", (12, 21), "condition", "where"),
            Case(
                "\"sqrt(q)\"",
                "\"1/(q - 0.1)\"",
                (12, 20),
                "the diffusion of `vx` is inf",
                "division by zero",
            ),
            Case("y = 0 }", "y = nan }", (11, 39), "the drift of `y` is not a finite number", ""),
        ],
    );
}

#[test]
fn a_diffusion_of_the_wrong_shape_is_told() {
    let shaped = |diffusion: &str, place: (usize, usize), message: &str, help: &str| {
        let right = right();
        let to = format!("diffusion = {diffusion}");
        check_in(&right, &[Case("diffusion = { vx = \"sqrt(q)\", y = 1 }", &to, place, message, help)]);
    };
    shaped("3", (12, 13), "`diffusion` is a table or a list; found a number", "the diagonal of G");
    shaped("[1, 2]", (12, 13), "`diffusion` has 2 values, but there are 3 states", "in this order");
    shaped("[[1], [2]]", (12, 13), "`diffusion` has 2 rows, but there are 3 states", "a row for each state");
    shaped("[[1, 0], [2], [0, 1]]", (12, 22), "row 2 of `diffusion` has 1 value, but needs 2", "one length");
    shaped("[[1, 0], 0, [0, 1]]", (12, 22), "row 2 of `diffusion` has a number, but needs 2", "one length");
    shaped(
        "{ x = [1, 2] }",
        (12, 19),
        "the diffusion of `x` is a number or an expression",
        "[[\"…\", …], …]",
    );
    shaped("[[1], [2], [\"qq\"]]", (12, 26), "unknown name `qq` in row 3, column 1 of `diffusion`", "`q`");
    shaped("[[1], [2], [true]]", (12, 25), "row 3, column 1 of `diffusion` is a number", "");
}
