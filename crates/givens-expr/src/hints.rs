//! What to write here for what other languages write.

/// The remedy for a sign that is none of ours.
pub(crate) fn sign(text: &str) -> Option<&'static str> {
    Some(match text {
        "**" => "write `^` for a power",
        "//" => "write `floor(a/b)`",
        "=" => "write `==` to compare",
        "=<" | "≤" | "⩽" => "write `<=`",
        "=>" | "≥" | "⩾" => "write `>=`",
        "<>" | "!==" | "~=" | "≠" => "write `!=`",
        "===" | "≡" => "write `==`",
        "&&" | "&" | "∧" => "write `and`",
        "||" | "|" | "∨" => "write `or`",
        "!" | "~" | "¬" => "write `not`",
        "?" | ":" => "write `where(condition, a, b)` for a choice",
        "%" => "write `a - b*floor(a/b)` for a remainder",
        "−" | "–" | "—" | "‐" | "‑" => "write the ASCII minus `-`",
        "×" | "·" | "⋅" | "∗" | "•" => "write `*`",
        "÷" | "∕" | "⁄" => "write `/`",
        "²" => "write `^2`",
        "³" => "write `^3`",
        "√" => "write `sqrt(…)`",
        "°" => "angles are in radians: write `*pi/180`",
        "∞" => "an infinite number may not stand in an expression",
        "[" | "]" | "{" | "}" => "components have names; only `(` and `)` group",
        "）" | "（" => "write the ASCII parentheses `(` and `)`",
        "'" => "there is no transpose and no text in an expression",
        "\"" | "“" | "”" => "names stand without quotation marks",
        "." => "names have no dots: write `sin(x)`, not `np.sin(x)`",
        ";" => "an expression is a single one; separate arguments by `,`",
        "$" | "@" | "#" | "\\" | "`" => "names are letters, digits and `_`",
        _ => return None,
    })
}

/// The remedy for a function that is none of ours.
pub(crate) fn function(name: &str) -> Option<&'static str> {
    Some(match name {
        "ln" | "loge" => "write `log(x)`, which is the natural logarithm",
        "log2" | "lb" => "write `log(x)/log(2)`",
        "log1p" => "write `log(1 + x)`",
        "lg" => "write `log10(x)`",
        "expm1" => "write `exp(x) - 1`",
        "exp2" => "write `2^x`",
        "pow" | "power" | "powf" | "powi" => "write `x^y`",
        "square" | "sqr" => "write `x^2`",
        "cbrt" => "write `sign(x)*abs(x)^(1/3)`",
        "arctan2" => "write `atan2(y, x)`",
        "arctan" => "write `atan(x)`",
        "arcsin" => "write `asin(x)`",
        "arccos" => "write `acos(x)`",
        "asinh" | "arcsinh" => "write `log(x + sqrt(x^2 + 1))`",
        "acosh" | "arccosh" => "write `log(x + sqrt(x^2 - 1))`",
        "atanh" | "arctanh" => "write `log((1 + x)/(1 - x))/2`",
        "cot" => "write `1/tan(x)`",
        "sec" => "write `1/cos(x)`",
        "csc" => "write `1/sin(x)`",
        "fabs" | "absolute" => "write `abs(x)`",
        "sgn" | "signum" => "write `sign(x)`",
        "ceil" => "write `-floor(-x)`",
        "round" | "rint" => "write `floor(x + 0.5)`",
        "trunc" | "int" | "fix" => "write `sign(x)*floor(abs(x))`",
        "mod" | "fmod" | "remainder" => "write `a - b*floor(a/b)`",
        "minimum" | "fmin" => "write `min(a, b)`",
        "maximum" | "fmax" => "write `max(a, b)`",
        "clip" | "clamp" => "write `max(low, min(x, high))`",
        "norm" => "write `hypot(x, y)`, or `sqrt(x^2 + y^2 + z^2)`",
        "if" | "ifelse" | "cond" | "select" | "piecewise" | "iif" => "write `where(condition, a, b)`",
        "deg2rad" | "radians" | "rad" => "write `x*pi/180`",
        "rad2deg" | "degrees" | "deg" => "write `x*180/pi`",
        "sinc" => "write `where(x == 0, 1, sin(x)/x)`",
        "heaviside" | "step" => "write `where(x > 0, 1, 0)`",
        "normcdf" | "ndtr" | "phi" => "write `erfc(-x/sqrt(2))/2`",
        "sum" => "write the sum with `+`",
        _ => return None,
    })
}

/// The remedy for a name that other languages know.
pub(crate) fn name(name: &str) -> Option<&'static str> {
    Some(match name {
        "e" | "E" => "write `exp(1)`",
        "π" | "PI" | "Pi" => "write `pi`",
        "tau" | "TAU" | "τ" => "write `2*pi`",
        "inf" | "Inf" | "INF" | "infinity" | "Infinity" => {
            "an infinite number may not stand in an expression"
        }
        "nan" | "NaN" | "NAN" => "not-a-number may not stand in an expression",
        "true" | "True" | "false" | "False" => "write a comparison, such as `x > 0`",
        "if" | "else" | "then" => "write `where(condition, a, b)` for a choice",
        "AND" | "And" => "write `and`",
        "OR" | "Or" => "write `or`",
        "NOT" | "Not" => "write `not`",
        _ => return None,
    })
}
