//! Methods of run time: the rules made of points are data, so all of them share one compiled filter.

use crate::filter::{Block, Form, Method};
use crate::rule::{Cubature3, Cubature5, GaussHermite, Pairs, PointRule, Rule, RuleError, Unscented};
use core::marker::PhantomData;

/// Any rule that is made of points.
#[derive(Clone, Copy, Debug)]
pub(super) enum AnyPoints {
    Cubature3(Cubature3),
    Cubature5(Cubature5),
    Unscented(Unscented),
    GaussHermite(GaussHermite),
}

macro_rules! each {
    ($self:ident, $rule:ident => $body:expr) => {
        match $self {
            AnyPoints::Cubature3($rule) => $body,
            AnyPoints::Cubature5($rule) => $body,
            AnyPoints::Unscented($rule) => $body,
            AnyPoints::GaussHermite($rule) => $body,
        }
    };
}

impl PointRule for AnyPoints {
    fn check(&self, n: usize) -> Result<(), RuleError> {
        each!(self, rule => PointRule::check(rule, n))
    }
    fn centre(&self, n: usize) -> Option<f64> {
        each!(self, rule => rule.centre(n))
    }
    fn pairs(&self, n: usize) -> Pairs {
        each!(self, rule => rule.pairs(n))
    }
    fn pair(&self, l: usize, xi: &mut [f64]) -> f64 {
        each!(self, rule => rule.pair(l, xi))
    }
    fn every_pair(&self, n: usize, xi: &mut [f64], put: &mut dyn FnMut(usize, &[f64], f64)) {
        each!(self, rule => rule.every_pair(n, xi, put));
    }
}

/// A method from its parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts<R, F, U> {
    rule: R,
    block: Block,
    time: U,
    form: PhantomData<F>,
}

impl<R, F, U> Parts<R, F, U> {
    pub fn new(rule: R, block: Block, time: U) -> Self {
        Self { rule, block, time, form: PhantomData }
    }
}

impl<R: Rule, F: Form, U: Copy> Method for Parts<R, F, U> {
    type Rule = R;
    type Form = F;
    type Time = U;
    fn rule(&self) -> R {
        self.rule
    }
    fn time_update(&self) -> U {
        self.time
    }
    fn block(&self) -> Block {
        self.block
    }
}
