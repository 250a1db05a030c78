//! Numerical stress: on every ladder of `golden/stress.json` a method is right, or says that it cannot be, or its answer is
//! doubted. What is only doubted is known, stands here and in docs/stress.md, and is tested to be so still.

use givens::registry::{Choice, FormName, Kind, Precision, RuleName, TimeName, resolve};
use givens_tests::stress::{Asks, Case, Rung, Verdict, case, cases, every_method, judge, named_methods};

const BOTH: [Precision; 2] = [Precision::F64, Precision::F32];

/// The others are asked about below, by themselves.
fn short(case: &Case) -> bool {
    case.name != "stiff" && case.name != "long_run"
}

/// What is not as `good` says, of all methods that `of` names, on all short ladders.
fn otherwise(
    of: impl Fn(&Choice) -> bool,
    good: impl Fn(&Case, &Rung, &Choice, &Verdict) -> bool,
) -> (usize, Vec<String>) {
    let (mut judged, mut found) = (0, Vec::new());
    for case in cases().iter().filter(|case| short(case)) {
        for precision in BOTH {
            for rung in &case.rungs {
                for (name, choice) in every_method(rung, precision).iter().filter(|(_, choice)| of(choice)) {
                    let Some(verdict) = rung.verdict(choice) else { continue };
                    judged += 1;
                    if !good(case, rung, choice, &verdict) {
                        found.push(format!(
                            "{}, d = {:e}, {precision:?} {name}: {verdict:?}",
                            case.name, rung.d
                        ));
                    }
                }
            }
        }
    }
    (judged, found)
}

fn none((judged, found): (usize, Vec<String>), at_least: usize) {
    assert!(found.is_empty(), "{} of {judged}:\n{}", found.len(), found.join("\n"));
    assert!(judged >= at_least, "only {judged} answers were judged");
}

/// Of derivatives, no answer of a prior this wide: the triangularisation keeps digits of a row's largest element, and its
/// answer would need those of the others. Points are rounded there as much.
fn too_wide(case: &Case, rung: &Rung, choice: &Choice) -> bool {
    let most = if choice.precision == Precision::F64 { 1e26 } else { 1e8 };
    case.name.ends_with("vague") && choice.rule == RuleName::Taylor && rung.d > most
}

#[test]
fn a_discrete_square_root_method_answers_right_to_the_last_rung() {
    let of = |choice: &Choice| choice.form == FormName::SquareRoot && choice.kind() == Kind::Discrete;
    let found = otherwise(of, |case, rung, choice, verdict| match verdict {
        Verdict::Right(_) => true,
        // in f32 a rule of many points loses δ² beside one a rung before the others
        Verdict::Said(_) => case.name == "nearly_singular" && choice.gauss_hermite.points > 3,
        Verdict::Doubted(_) => too_wide(case, rung, choice),
        _ => false,
    });
    none(found, 4000);
}

#[test]
fn a_continuous_method_answers_right_or_says_so_over_short_gaps_and_long_ones() {
    let of = |choice: &Choice| choice.kind() == Kind::Continuous;
    none(otherwise(of, |_, _, _, verdict| matches!(verdict, Verdict::Right(_) | Verdict::Said(_))), 400);
}

/// Whether a covariance still holds what the answer needs: beyond, it cannot be told from a singular one.
fn in_digits(case: &Case, rung: &Rung) -> bool {
    match case.name.as_str() {
        "vague" | "zero_and_vague" => rung.d <= 1e12,
        "hidden" => rung.d >= 1e-5,
        _ => true,
    }
}

#[test]
fn a_covariance_form_answers_right_or_says_so_while_its_digits_last() {
    let of = |choice: &Choice| choice.form == FormName::Covariance && choice.kind() == Kind::Discrete;
    let found = otherwise(of, |case, rung, _, verdict| match verdict {
        Verdict::Right(_) => true,
        Verdict::Said(_) => case.name == "nearly_singular" || !in_digits(case, rung),
        Verdict::Doubted(_) => !in_digits(case, rung),
        Verdict::NotANumber | Verdict::Wrong(_) => false,
    });
    none(found, 500);
}

/// What docs/stress.md names as wrong: who mends one of these will want to say so there.
#[test]
fn what_is_known_to_be_wrong_is_doubted() {
    let at = |name: &str, d: f64, method: &str, precision| {
        let case = case(name);
        let rung = case.rungs.iter().find(|rung| rung.d == d).unwrap();
        let choice = Choice { precision, ..resolve(method, &[]).unwrap() };
        let verdict = rung.verdict(&choice);
        assert!(matches!(verdict, Some(Verdict::Doubted(_))), "{name}, d = {d:e}, {method}: {verdict:?}");
    };
    at("vague", 1e16, "ckf", Precision::F64);
    at("hidden", 1e-8, "ckf", Precision::F64);
    at("vague", 1e28, "sr-ekf", Precision::F64);
    at("vague", 1e10, "sr-ekf", Precision::F32);
    at("stiff", 1e2, "sr-cd-ckf", Precision::F64);
}

/// A doubt would be worth nothing if it came with every answer: those that are right are doubted near the rungs where digits end.
#[test]
fn few_right_answers_are_doubted() {
    let (mut right, mut doubted) = (0, 0);
    for case in cases().iter().filter(|case| short(case)) {
        for precision in BOTH {
            for rung in &case.rungs {
                for (_, choice) in named_methods(rung, precision) {
                    if let Some(Verdict::Right(_)) = rung.verdict(&choice) {
                        right += 1;
                        doubted += usize::from(!rung.doubts(&choice).is_empty());
                    }
                }
            }
        }
    }
    assert!(right > 2000 && 15 * doubted < right, "{doubted} of {right}");
}

#[test]
fn of_a_stiff_drift_a_solver_with_a_tolerance_answers_right_and_wrong_steps_are_doubted() {
    let case = case("stiff");
    let mut judged = 0;
    for precision in BOTH {
        for rung in &case.rungs {
            for (name, choice) in named_methods(rung, precision) {
                let adaptive = choice.time_update != TimeName::ItoTaylor;
                let stiff = name.ends_with("rodas4");
                // beyond, the steps of a solver that is not for stiff drifts are many, and its answer is an error
                if adaptive && !stiff && rung.d > 1e4 {
                    continue;
                }
                let verdict = rung.verdict(&choice).unwrap();
                let good = match verdict {
                    Verdict::Right(_) => true,
                    Verdict::Said(_) => !adaptive || (precision == Precision::F32 && stiff),
                    Verdict::Doubted(_) => !adaptive,
                    _ => false,
                };
                assert!(good, "d = {:e}, {precision:?} {name}: {verdict:?}", rung.d);
                judged += 1;
            }
        }
    }
    assert!(judged > 200, "only {judged} answers were judged");
}

/// No drift of mean or root over a hundred thousand rows; ten million are in docs/stress.md.
#[test]
fn a_hundred_thousand_rows_leave_a_root_in_single_precision_where_it_belongs() {
    for rung in &case("long_run").rungs {
        for precision in BOTH {
            let choice = Choice { precision, ..resolve("sr-ckf", &[]).unwrap() };
            let answered = rung.run(&choice, None);
            let (_, cov) = &answered.rows[0];
            assert!(cov[0] > 0.0 && cov[3] > 0.0 && cov[0] * cov[3] > cov[1] * cov[1], "{:e}", rung.d);
            let verdict = judge(rung.answer(precision).unwrap(), Asks::Points, &answered);
            assert!(
                matches!(verdict, Some(Verdict::Right(_))),
                "d = {:e}, {precision:?}: {verdict:?}",
                rung.d
            );
        }
    }
}
