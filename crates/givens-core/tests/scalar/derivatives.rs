//! First and second derivatives against the known ones.

use givens_core::scalar::{Dual2, Real};

/// x(s) = v + d s + ½ dd s²: f(x)' = f₁ d and f(x)'' = f₂ d² + f₁ dd.
fn agrees(name: &str, found: Dual2<f64>, [f, d, dd]: [f64; 3]) {
    let size = f.abs().max(d.abs()).max(dd.abs()).max(1.0);
    for (what, found, expected) in [("value", found.v, f), ("first", found.d, d), ("second", found.dd, dd)] {
        assert!((found - expected).abs() <= 2e-14 * size, "{name}, {what}: {found}, not {expected}");
    }
}

/// Values that move straight on, with a bend, and not at all.
const MOVES: [(f64, f64); 4] = [(1.0, 0.0), (-0.7, 1.3), (0.0, 0.4), (0.0, 0.0)];

fn one(name: &str, at: &[f64], f: impl Fn(Dual2<f64>) -> Dual2<f64>, known: impl Fn(f64) -> [f64; 3]) {
    for &v in at {
        for (d, dd) in MOVES {
            let [value, f1, f2] = known(v);
            let name = format!("{name} at {v} along ({d}, {dd})");
            agrees(&name, f(Dual2 { v, d, dd }), [value, f1 * d, f2 * d * d + f1 * dd]);
        }
    }
}

/// erf at −2.3, −0.4, 0.3 and 1.7, by mpmath.
const ERF: [f64; 4] =
    [-0.998_856_823_402_643_4, -0.428_392_355_046_668_5, 0.328_626_759_459_127_4, 0.983_790_458_590_774_5];

#[test]
fn functions_of_one_number_have_their_known_derivatives() {
    let (all, positive, within) = ([-2.3, -0.4, 0.3, 1.7], [0.02, 0.9, 6.5], [-0.95, -0.2, 0.6]);
    one("recip", &all, Real::recip, |x| [1.0 / x, -1.0 / (x * x), 2.0 / x.powi(3)]);
    one("sqrt", &positive, Real::sqrt, |x| [x.sqrt(), 0.5 / x.sqrt(), -0.25 * x.powf(-1.5)]);
    one("abs", &all, Real::abs, |x| [x.abs(), x.signum(), 0.0]);
    one("neg", &all, |x| -x, |x| [-x, -1.0, 0.0]);
    one("floor", &all, Real::floor, |x| [x.floor(), 0.0, 0.0]);
    one("sign", &all, Real::sign, |x| [x.signum(), 0.0, 0.0]);
    one("exp", &all, Real::exp, |x| [x.exp(); 3]);
    one("ln", &positive, Real::ln, |x| [x.ln(), 1.0 / x, -1.0 / (x * x)]);
    let ten = 10f64.ln();
    one("log10", &positive, Real::log10, |x| [x.log10(), 1.0 / (x * ten), -1.0 / (x * x * ten)]);
    one("sin", &all, Real::sin, |x| [x.sin(), x.cos(), -x.sin()]);
    one("cos", &all, Real::cos, |x| [x.cos(), -x.sin(), -x.cos()]);
    let square = |x: f64| x * x;
    one("tan", &all, Real::tan, |x| [x.tan(), 1.0 / square(x.cos()), 2.0 * x.sin() / x.cos().powi(3)]);
    let w = |x: f64| (1.0 - x * x).powf(-0.5);
    one("asin", &within, Real::asin, |x| [x.asin(), w(x), x * w(x).powi(3)]);
    one("acos", &within, Real::acos, |x| [x.acos(), -w(x), -x * w(x).powi(3)]);
    one("atan", &all, Real::atan, |x| [x.atan(), 1.0 / (1.0 + x * x), -2.0 * x / square(1.0 + x * x)]);
    one("sinh", &all, Real::sinh, |x| [x.sinh(), x.cosh(), x.sinh()]);
    one("cosh", &all, Real::cosh, |x| [x.cosh(), x.sinh(), x.cosh()]);
    let c = |x: f64| x.cosh().recip();
    one("tanh", &all, Real::tanh, |x| [x.tanh(), square(c(x)), -2.0 * x.sinh() * c(x).powi(3)]);
    let erf = |x: f64| ERF[all.iter().position(|&at| at == x).unwrap()];
    let bell = |x: f64| core::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp();
    one("erf", &all, Real::erf, |x| [erf(x), bell(x), -2.0 * x * bell(x)]);
    one("erfc", &all, Real::erfc, |x| [1.0 - erf(x), -bell(x), 2.0 * x * bell(x)]);
    for e in -3..=4 {
        let n = f64::from(e);
        let f = |x: Dual2<f64>| Real::powi(x, e);
        one("powi", &all, f, |x| [x.powi(e), n * x.powi(e - 1), n * (n - 1.0) * x.powi(e - 2)]);
    }
    one("wrap", &all, |x| Real::wrap(x, Dual2::of(1.5)), |x| [x - 1.5 * (x / 1.5 + 0.5).floor(), 1.0, 0.0]);
}

/// f with its partial derivatives f_x, f_y, f_xx, f_xy, f_yy.
fn two(
    name: &str,
    at: &[[f64; 2]],
    f: impl Fn(Dual2<f64>, Dual2<f64>) -> Dual2<f64>,
    known: impl Fn(f64, f64) -> [f64; 6],
) {
    for &[x, y] in at {
        for (xd, xdd) in MOVES {
            for (yd, ydd) in MOVES {
                let [value, fx, fy, fxx, fxy, fyy] = known(x, y);
                let bend = fxx * xd * xd + 2.0 * fxy * xd * yd + fyy * yd * yd + fx * xdd + fy * ydd;
                let name = format!("{name} at ({x}, {y}) along ({xd}, {yd}; {xdd}, {ydd})");
                let found = f(Dual2 { v: x, d: xd, dd: xdd }, Dual2 { v: y, d: yd, dd: ydd });
                agrees(&name, found, [value, fx * xd + fy * yd, bend]);
            }
        }
    }
}

#[test]
fn functions_of_two_numbers_have_their_known_derivatives() {
    let all = [[1.2, -0.7], [-2.0, 0.5], [-0.3, -1.9], [3.0, 4.0]];
    two("add", &all, |x, y| x + y, |x, y| [x + y, 1.0, 1.0, 0.0, 0.0, 0.0]);
    two("sub", &all, |x, y| x - y, |x, y| [x - y, 1.0, -1.0, 0.0, 0.0, 0.0]);
    two("mul", &all, |x, y| x * y, |x, y| [x * y, y, x, 0.0, 1.0, 0.0]);
    let half = Dual2::of(0.5);
    two("mul_add", &all, |x, y| x.mul_add(y, half), |x, y| [x * y + 0.5, y, x, 0.0, 1.0, 0.0]);
    two(
        "div",
        &all,
        |x, y| x / y,
        |x, y| [x / y, 1.0 / y, -x / (y * y), 0.0, -1.0 / (y * y), 2.0 * x / y.powi(3)],
    );
    two("hypot", &all, Real::hypot, |x, y| {
        let r = x.hypot(y);
        [r, x / r, y / r, y * y / r.powi(3), -x * y / r.powi(3), x * x / r.powi(3)]
    });
    two(
        "atan2",
        &all,
        |x, y| Real::atan2(y, x),
        |x, y| {
            let r2 = x * x + y * y;
            let r4 = r2 * r2;
            [y.atan2(x), -y / r2, x / r2, 2.0 * x * y / r4, (y * y - x * x) / r4, -2.0 * x * y / r4]
        },
    );
    two("pow", &[[1.2, -0.7], [0.3, 2.5], [2.0, 3.0]], Real::pow, |x, e| {
        let (p, less, ln) = (x.powf(e), x.powf(e - 1.0), x.ln());
        [p, e * less, p * ln, e * (e - 1.0) * x.powf(e - 2.0), less * (1.0 + e * ln), p * ln * ln]
    });
    let pick = |x: f64, y: f64, first: bool| {
        if first { [x, 1.0, 0.0, 0.0, 0.0, 0.0] } else { [y, 0.0, 1.0, 0.0, 0.0, 0.0] }
    };
    two("max", &all, Real::max, |x, y| pick(x, y, x > y));
    two("min", &all, Real::min, |x, y| pick(x, y, x < y));
    let side = |x: f64, y: f64| x.signum() * y.signum();
    two("copysign", &all, Real::copysign, |x, y| [x.copysign(y), side(x, y), 0.0, 0.0, 0.0, 0.0]);
}

#[test]
fn a_fixed_exponent_serves_every_base() {
    for (x, e) in [(-2.0, 3.0), (-2.0, -2.0), (0.0, 3.0), (0.0, 2.0)] {
        let found = Dual2 { v: x, d: 0.5, dd: 2.0 }.pow(Dual2::of(e));
        let (f1, f2) = (e * f64::powf(x, e - 1.0), e * (e - 1.0) * f64::powf(x, e - 2.0));
        agrees("pow", found, [f64::powf(x, e), 0.5 * f1, 0.25 * f2 + 2.0 * f1]);
    }
}

#[test]
fn what_does_not_move_has_no_derivative_also_where_there_is_none() {
    let still = [
        Dual2::<f64>::of(0.0).sqrt(),
        Dual2::of(0.0).hypot(Dual2::of(0.0)),
        Dual2::of(0.0).atan2(Dual2::of(0.0)),
        Dual2::of(1.0).asin(),
        Dual2::of(-1.0).acos(),
        Dual2::of(0.0).pow(Dual2::of(0.5)),
    ];
    for (i, dual) in still.into_iter().enumerate() {
        assert_eq!((dual.d, dual.dd), (0.0, 0.0), "{i}: {dual:?}");
    }
}
