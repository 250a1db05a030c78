//! The names that an expression may use.

use std::collections::HashMap;

use crate::error::{ExprError, short};
use crate::function::FUNCTIONS;
use crate::graph::Node;
use crate::hints;
use crate::suggest::suggest;

/// What a name stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// A subexpression: an input, or what a definition gave.
    Is(Node),
    /// A name that exists but may not stand here: why, and the remedy.
    Forbidden(String),
}

/// The names that an expression may use, beside the functions and `pi`.
///
/// ```
/// use givens_expr::{Graph, Input, Meaning, Scope, parse};
/// let (mut graph, mut scope) = (Graph::new(), Scope::new());
/// scope.insert("x", Meaning::Is(graph.input(Input::State(0))));
/// scope.insert("vx", Meaning::Forbidden("a noise may not depend on the state".into()));
/// assert!(parse(&mut graph, &scope, "x^2").is_ok());
/// let error = parse(&mut graph, &scope, "x + vx").unwrap_err();
/// assert_eq!(error.to_string(), "`vx` may not stand here: a noise may not depend on the state");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Scope {
    names: Vec<String>,
    meanings: HashMap<String, Meaning>,
    /// Words that stand before a name in parentheses, and what they mean with each name.
    of: HashMap<String, Vec<(String, Meaning)>>,
}

impl Scope {
    /// A scope without names.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Gives a name its meaning, and returns the one that it had before. Names of functions, `pi`, `and`, `or` and
    /// `not` cannot be given one: [`is_reserved`](crate::is_reserved) tells them, and expressions keep reading them
    /// as before.
    pub fn insert(&mut self, name: impl Into<String>, meaning: Meaning) -> Option<Meaning> {
        let name = name.into();
        let before = self.meanings.insert(name.clone(), meaning);
        if before.is_none() {
            self.names.push(name);
        }
        before
    }

    /// Gives `word(name)` its meaning. The word takes names that it has been given only, no expressions; names of
    /// functions cannot be such words.
    ///
    /// ```
    /// use givens_expr::{Graph, Input, Meaning, Scope, parse};
    /// let (mut graph, mut scope) = (Graph::new(), Scope::new());
    /// scope.insert_of("rate", "x", Meaning::Is(graph.input(Input::State(0))));
    /// assert!(parse(&mut graph, &scope, "2*rate(x)").is_ok());
    /// let error = parse(&mut graph, &scope, "2*rate(y)").unwrap_err();
    /// assert_eq!(error.to_string(), "there is no `rate(y)`: known here: `rate(x)`");
    /// ```
    pub fn insert_of(&mut self, word: &str, name: &str, meaning: Meaning) {
        let known = self.of.entry(word.to_string()).or_default();
        known.retain(|(other, _)| other != name);
        known.push((name.to_string(), meaning));
    }

    /// Whether a word takes names.
    pub(crate) fn takes_names(&self, word: &str) -> bool {
        self.of.contains_key(word)
    }

    /// The node of `word(name)`.
    pub(crate) fn find_of(&self, word: &str, name: &str) -> Result<Node, ExprError> {
        let known = self.of.get(word).map_or(&[][..], Vec::as_slice);
        let whole = format!("`{word}({})`", short(name));
        match known.iter().find(|(other, _)| other == name) {
            Some((_, Meaning::Is(node))) => Ok(*node),
            Some((_, Meaning::Forbidden(why))) => {
                Err(ExprError::new(0..name.len(), format!("{whole} may not stand here")).help(why.as_str()))
            }
            None => {
                let error = ExprError::new(0..name.len(), format!("there is no {whole}"));
                Err(error.help(self.names_of(word)))
            }
        }
    }

    /// The names that a word takes, for a remedy.
    pub(crate) fn names_of(&self, word: &str) -> String {
        let known = self.of.get(word).into_iter().flatten();
        let known = known.filter(|(_, meaning)| matches!(meaning, Meaning::Is(_)));
        let all: Vec<String> = known.map(|(name, _)| format!("`{word}({name})`")).take(12).collect();
        if all.is_empty() {
            format!("nothing has a `{word}` here")
        } else {
            format!("known here: {}", all.join(", "))
        }
    }

    /// The names, in the order in which they were first given.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// The meaning of a name.
    pub fn get(&self, name: &str) -> Option<&Meaning> {
        self.meanings.get(name)
    }

    /// The node of a name.
    ///
    /// # Errors
    /// The name is unknown, forbidden, or that of a function; the error names a near one. Its span counts from the
    /// start of the name.
    pub fn find(&self, name: &str) -> Result<Node, ExprError> {
        match self.meanings.get(name) {
            Some(Meaning::Is(node)) => Ok(*node),
            Some(Meaning::Forbidden(why)) => {
                let message = format!("`{}` may not stand here", short(name));
                Err(ExprError::new(0..name.len(), message).help(why.as_str()))
            }
            None => Err(self.unknown(name)),
        }
    }

    fn unknown(&self, name: &str) -> ExprError {
        let error = ExprError::new(0..name.len(), format!("unknown name `{}`", short(name)));
        if let Some(function) = FUNCTIONS.iter().find(|function| function.name == name) {
            let message = format!("`{name}` is a function and needs its arguments");
            return ExprError::new(0..name.len(), message).help(format!("write `{}`", function.signature));
        }
        if let Some(help) = hints::name(name) {
            return error.help(help);
        }
        // controls are named so in model files
        if let Some(Meaning::Is(_)) = self.get(&format!("u_{name}")) {
            return error.help(format!("did you mean the control `u_{name}`?"));
        }
        if let Some(near) = suggest(name, self.names().chain(["pi"])) {
            return error.help(format!("did you mean `{near}`?"));
        }
        let allowed = self.names().filter(|name| matches!(self.get(name), Some(Meaning::Is(_))));
        let allowed: Vec<String> = allowed.map(|name| format!("`{name}`")).collect();
        match allowed.len() {
            0 => error.help("only numbers, `pi` and functions may stand here"),
            1..=12 => error.help(format!("known here: {}", allowed.join(", "))),
            _ => error,
        }
    }
}
