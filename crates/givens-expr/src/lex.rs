//! From text to tokens.

use core::ops::Range;

use crate::error::ExprError;
use crate::hints;

/// A piece of an expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Token<'t> {
    Number(f64),
    Name(&'t str),
    /// An operator, a parenthesis or a comma.
    Sign(&'static str),
    End,
}

/// Our signs; a sign stands before those that begin it.
const SIGNS: [&str; 14] = ["<=", ">=", "==", "!=", "<", ">", "+", "-", "*", "/", "^", "(", ")", ","];

/// Signs of other languages that begin with one of ours, or that belong together.
const FOREIGN: [&str; 13] = ["===", "!==", "**", "//", "<>", "=<", "=>", "&&", "||", "~=", "=", "!", "."];

pub(crate) struct Lexer<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Lexer<'t> {
    pub(crate) fn new(text: &'t str) -> Self {
        Self { text, at: 0 }
    }

    /// The next token and where it stands.
    pub(crate) fn next(&mut self) -> Result<(Token<'t>, Range<usize>), ExprError> {
        let rest = self.rest().trim_start();
        self.at = self.text.len() - rest.len();
        let start = self.at;
        let token = match rest.chars().next() {
            None => Ok(Token::End),
            Some(c) if begins_name(c) => Ok(Token::Name(self.take(continues_name))),
            Some(c) if c.is_ascii_digit() || c == '.' && digit_follows(rest) => self.number(),
            Some(_) => self.sign(rest),
        };
        Ok((token?, start..self.at))
    }

    fn rest(&self) -> &'t str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// Moves over the characters that `belongs` accepts.
    fn take(&mut self, belongs: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let taken = rest.find(|c| !belongs(c)).map_or(rest, |end| &rest[..end]);
        self.at += taken.len();
        taken
    }

    fn number(&mut self) -> Result<Token<'t>, ExprError> {
        let start = self.at;
        let digit = |c: char| c.is_ascii_digit();
        self.take(digit);
        if self.rest().starts_with('.') {
            self.at += 1;
            self.take(digit);
        }
        let mantissa = &self.text[start..self.at];
        let mut tail = self.rest().chars();
        if matches!(tail.next(), Some('e' | 'E')) {
            let (first, second) = (tail.next(), tail.next());
            let signed = matches!(first, Some('+' | '-')) && second.is_some_and(digit);
            if signed || first.is_some_and(digit) {
                self.at += 1 + usize::from(signed);
                self.take(digit);
            }
        }
        let text = &self.text[start..self.at];
        let after = self.take(|c| continues_name(c) || c == '.');
        if !after.is_empty() {
            return Err(run_on(text, after, start..self.at));
        }
        let error = |message: &str| Err(ExprError::new(start..self.at, format!("`{text}` {message}")));
        match text.parse::<f64>() {
            Ok(value) if value.is_infinite() => {
                error("is too large for a number").map_err(|e| e.help("the largest is about 1.8e308"))
            }
            Ok(0.0) if mantissa.contains(|c: char| c.is_ascii_digit() && c != '0') => {
                error("is too small for a number").map_err(|e| e.help("write `0`, or change the units"))
            }
            Ok(value) => Ok(Token::Number(value)),
            Err(_) => error("is not a number"),
        }
    }

    fn sign(&mut self, rest: &'t str) -> Result<Token<'t>, ExprError> {
        let foreign = FOREIGN.into_iter().find(|sign| rest.starts_with(sign));
        let ours = SIGNS.into_iter().find(|sign| rest.starts_with(sign));
        if let Some(sign) = ours.filter(|ours| foreign.is_none_or(|foreign| foreign.len() <= ours.len())) {
            self.at += sign.len();
            return Ok(Token::Sign(sign));
        }
        let first = rest.chars().next().map_or(0, char::len_utf8);
        let found = foreign.unwrap_or(&rest[..first]);
        let start = self.at;
        self.at += found.len();
        let message = match found.chars().next() {
            Some(c) if c.is_control() || c.is_whitespace() => {
                format!("the character U+{:04X} may not stand here", u32::from(c))
            }
            _ => format!("`{found}` may not stand here"),
        };
        let error = ExprError::new(start..self.at, message);
        Err(match hints::sign(found) {
            Some(help) => error.help(help),
            None => error,
        })
    }
}

/// The error for a number that runs on into `after`.
fn run_on(number: &str, after: &str, span: Range<usize>) -> ExprError {
    let whole = format!("{number}{after}");
    let error = ExprError::new(span, format!("`{whole}` is neither a number nor a name"));
    if after.starts_with('_') || after.starts_with('.') {
        error.help("a number has at most one point and no `_`")
    } else if matches!(after, "e" | "E") {
        error.help("the exponent has no digits")
    } else {
        error.help(format!("write `{number}*{after}` to multiply"))
    }
}

fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn continues_name(c: char) -> bool {
    c.is_alphabetic() || c.is_ascii_digit() || c == '_'
}

fn digit_follows(rest: &str) -> bool {
    rest.chars().nth(1).is_some_and(|c| c.is_ascii_digit())
}

/// Whether a text can be a name in expressions: a letter or `_`, then letters, digits and `_`. It may still be
/// [reserved](crate::is_reserved).
///
/// ```
/// use givens_expr::is_name;
/// assert!(is_name("v_x2") && is_name("ω") && !is_name("2x") && !is_name("a b") && !is_name(""));
/// ```
#[must_use]
pub fn is_name(text: &str) -> bool {
    text.chars().next().is_some_and(begins_name) && text.chars().all(continues_name)
}

/// The names in the text of an expression, those of functions included, and where they stand, in bytes. What is
/// wrong with the text is passed over: [`parse`](crate::parse()) reports it.
///
/// ```
/// let names: Vec<&str> = givens_expr::names("x + u_a*sin(x)").map(|(_, name)| name).collect();
/// assert_eq!(names, ["x", "u_a", "sin", "x"]);
/// ```
pub fn names(text: &str) -> impl Iterator<Item = (Range<usize>, &str)> {
    let mut lexer = Lexer::new(text);
    core::iter::from_fn(move || {
        loop {
            match lexer.next() {
                Ok((Token::Name(name), span)) => return Some((span, name)),
                Ok((Token::End, _)) => return None,
                Ok(_) | Err(_) => {}
            }
        }
    })
}
