//! Random expressions: text, bytecode and derivatives against a plain evaluation of the same tree.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod session;

use givens_core::scalar::{Dual2, Real};
use givens_expr::{Inputs, Program};
use proptest::prelude::*;
use session::{Session, close};

#[derive(Clone, Debug)]
enum Tree {
    X,
    Y,
    Number(f64),
    One(&'static str, Box<Tree>),
    Two(&'static str, Box<Tree>, Box<Tree>),
    Where(&'static str, Box<[Tree; 4]>),
}

/// Functions that are smooth or tame on all numbers, so that rounding stays small.
const ONE: [&str; 18] = [
    "-",
    "sin",
    "cos",
    "atan",
    "tanh",
    "erf",
    "erfc",
    "abs",
    "^2",
    "^3",
    "sqrt(1+^2)",
    "log(2+^2)",
    "exp(-^2)",
    "asin(tanh/2)",
    "acos(tanh/2)",
    "tan(tanh)",
    "cosh(tanh)",
    "log10(1+^2)",
];
const TWO: [&str; 9] = ["+", "-", "*", "/(1+^2)", "hypot", "atan2", "min", "max", "(1+^2)^tanh"];

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![Just(Tree::X), Just(Tree::Y), (-4.0..4.0_f64).prop_map(Tree::Number)];
    leaf.prop_recursive(5, 40, 4, |inner| {
        prop_oneof![
            (proptest::sample::select(&ONE[..]), inner.clone())
                .prop_map(|(op, a)| Tree::One(op, Box::new(a))),
            (proptest::sample::select(&TWO[..]), inner.clone(), inner.clone())
                .prop_map(|(op, a, b)| Tree::Two(op, Box::new(a), Box::new(b))),
            (
                proptest::sample::select(&["<", "<=", ">", ">="][..]),
                [inner.clone(), inner.clone(), inner.clone(), inner]
            )
                .prop_map(|(op, trees)| Tree::Where(op, Box::new(trees))),
        ]
    })
}

impl Tree {
    fn text(&self) -> String {
        match self {
            Tree::X => "x".into(),
            Tree::Y => "y".into(),
            Tree::Number(value) => format!("({value:?})"),
            Tree::One(op, a) => {
                let a = a.text();
                match *op {
                    "-" => format!("(-{a})"),
                    "^2" | "^3" => format!("(({a}){op})"),
                    "sqrt(1+^2)" => format!("sqrt(1 + ({a})^2)"),
                    "log(2+^2)" => format!("log(2 + ({a})^2)"),
                    "exp(-^2)" => format!("exp(-({a})^2)"),
                    "asin(tanh/2)" => format!("asin(tanh({a})/2)"),
                    "acos(tanh/2)" => format!("acos(tanh({a})/2)"),
                    "tan(tanh)" => format!("tan(tanh({a}))"),
                    "cosh(tanh)" => format!("cosh(tanh({a}))"),
                    "log10(1+^2)" => format!("log10(1 + ({a})^2)"),
                    name => format!("{name}({a})"),
                }
            }
            Tree::Two(op, a, b) => {
                let (a, b) = (a.text(), b.text());
                match *op {
                    "+" | "-" | "*" => format!("({a} {op} {b})"),
                    "/(1+^2)" => format!("({a}/(1 + ({b})^2))"),
                    "atan2" => format!("atan2({a}, 2 + ({b})^2)"),
                    "hypot" => format!("hypot({a}, 1 + ({b})^2)"),
                    "(1+^2)^tanh" => format!("(1 + ({a})^2)^tanh({b})"),
                    name => format!("{name}({a}, {b})"),
                }
            }
            Tree::Where(op, trees) => {
                let [a, b, yes, no] = trees.each_ref().map(Tree::text);
                format!("where({a} {op} {b}, {yes}, {no})")
            }
        }
    }

    fn value<T: Real>(&self, x: T, y: T) -> T {
        let one = T::one();
        match self {
            Tree::X => x,
            Tree::Y => y,
            Tree::Number(value) => T::of(*value),
            Tree::One(op, a) => {
                let a = a.value(x, y);
                match *op {
                    "-" => -a,
                    "sin" => a.sin(),
                    "cos" => a.cos(),
                    "atan" => a.atan(),
                    "tanh" => a.tanh(),
                    "erf" => a.erf(),
                    "erfc" => a.erfc(),
                    "abs" => a.abs(),
                    "^2" => a * a,
                    "^3" => a * a * a,
                    "sqrt(1+^2)" => (one + a * a).sqrt(),
                    "log(2+^2)" => (T::of(2.0) + a * a).ln(),
                    "exp(-^2)" => (-(a * a)).exp(),
                    "asin(tanh/2)" => (a.tanh() / T::of(2.0)).asin(),
                    "acos(tanh/2)" => (a.tanh() / T::of(2.0)).acos(),
                    "tan(tanh)" => a.tanh().tan(),
                    "cosh(tanh)" => a.tanh().cosh(),
                    "log10(1+^2)" => (one + a * a).log10(),
                    other => panic!("{other}"),
                }
            }
            Tree::Two(op, a, b) => {
                let (a, b) = (a.value(x, y), b.value(x, y));
                match *op {
                    "+" => a + b,
                    "-" => a - b,
                    "*" => a * b,
                    "/(1+^2)" => a / (one + b * b),
                    "hypot" => a.hypot(one + b * b),
                    "atan2" => a.atan2(T::of(2.0) + b * b),
                    "min" => a.min(b),
                    "max" => a.max(b),
                    "(1+^2)^tanh" => (one + a * a).pow(b.tanh()),
                    other => panic!("{other}"),
                }
            }
            Tree::Where(op, trees) => {
                let [a, b, yes, no] = trees.each_ref().map(|tree| tree.value(x, y));
                let holds = match *op {
                    "<" => a.lt(b),
                    "<=" => a.le(b),
                    ">" => b.lt(a),
                    _ => b.le(a),
                };
                T::select(holds, yes, no)
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn values_and_derivatives_are_those_of_the_tree(tree in tree(), x in -2.0..2.0_f64, y in -2.0..2.0_f64) {
        let mut session = Session::new();
        let node = session.read(&tree.text());
        let first = session.slope(node, 0);
        let second = session.slope(first, 0);
        let program = Program::compile(&session.graph, &[node, first, second]).unwrap();
        let found = program.values(&Inputs::of_state(&[x, y]));
        let dual: Dual2<f64> = tree.value(Dual2::variable(x), Dual2::of(y));
        // sizes at which rounding in the middle may have been magnified
        prop_assume!(dual.v.abs() < 1e6 && dual.d.abs() < 1e6 && dual.dd.abs() < 1e6);
        for (found, wanted) in found.into_iter().zip([dual.v, dual.d, dual.dd]) {
            prop_assert!(close(found, wanted, 1e-8), "{}: {found} {dual:?}", tree.text());
        }
    }

    #[test]
    fn a_batch_is_its_points_to_the_bit(trees in [tree(), tree(), tree()], points in 1..14_usize, seed in 0.0..1.0_f64) {
        let mut session = Session::new();
        let mut nodes: Vec<_> = trees.iter().map(|tree| session.read(&tree.text())).collect();
        let slopes: Vec<_> = nodes.iter().map(|&node| session.slope(node, 1)).collect();
        // the same twice, an input, a constant
        nodes.extend([nodes[0], session.read("y"), session.read("2.5")].into_iter().chain(slopes));
        let program = Program::compile(&session.graph, &nodes).unwrap();
        let x: Vec<f64> = (0..2 * points).map(|i| 3.0 * (seed + 0.37 * i as f64).sin()).collect();
        let (mut out, mut scratch) = (vec![0.0; nodes.len() * points], vec![f64::NAN; program.scratch_len(points)]);
        program.eval(&Inputs::of_state(&x), points, &mut out, &mut scratch);
        for j in 0..points {
            let single = program.values(&Inputs::of_state(&[x[j], x[points + j]]));
            for (i, value) in single.into_iter().enumerate() {
                prop_assert_eq!(value.to_bits(), out[i * points + j].to_bits());
            }
        }
    }

    #[test]
    fn one_precision_is_the_other_rounded(tree in tree(), x in -2.0..2.0_f32, y in -2.0..2.0_f32) {
        // duals tell how rounding of the inputs is magnified; where they are tame, f32 must be close
        let dual: Dual2<f64> = tree.value(Dual2::along(f64::from(x), 1.0), Dual2::along(f64::from(y), 1.0));
        prop_assume!(dual.v.abs() < 10.0 && dual.d.abs() < 10.0);
        prop_assume!(!tree.text().contains("where"));
        let mut session = Session::new();
        let node = session.read(&tree.text());
        let program = Program::compile(&session.graph, &[node]).unwrap();
        let (mut out, mut scratch) = ([0.0_f32], vec![0.0_f32; program.scratch_len(1)]);
        program.eval(&Inputs::of_state(&[x, y]), 1, &mut out, &mut scratch);
        let direct: f32 = tree.value(x, y);
        prop_assert!((out[0] - direct).abs() <= 1e-3 * (1.0 + direct.abs()), "{} {direct}", out[0]);
    }
}
