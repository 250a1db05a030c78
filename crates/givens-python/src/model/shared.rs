//! A model's dynamics, shared by all that differ from it in the values of the parameters only.

use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;

use crate::watch::go_on;

/// Traced, as a program of expressions, or with functions that are called. A clone shares everything but the values of the
/// parameters.
#[derive(Debug)]
pub struct Shared<T, C> {
    pub way: Arc<Way<T, C>>,
    pub parameters: Vec<f64>,
    /// Ends its evaluations, on whatever thread, once it is set.
    stop: Option<Arc<AtomicBool>>,
}

/// How a model was given.
#[derive(Debug)]
pub enum Way<T, C> {
    Traced(T),
    Called(C),
}

impl<T, C> Shared<T, C> {
    /// Of expressions.
    pub fn traced(model: T, parameters: Vec<f64>) -> Self {
        Self { way: Arc::new(Way::Traced(model)), parameters, stop: None }
    }

    /// Of functions.
    pub fn called(model: C, parameters: Vec<f64>) -> Self {
        Self { way: Arc::new(Way::Called(model)), parameters, stop: None }
    }

    /// The functions, if some are called.
    pub fn functions(&self) -> Option<&C> {
        match &*self.way {
            Way::Traced(_) => None,
            Way::Called(called) => Some(called),
        }
    }

    /// Tells models of the same graphs or functions, whatever their parameters.
    pub fn origin(&self) -> usize {
        Arc::as_ptr(&self.way).addr()
    }

    /// The same with other values, as many as there are.
    pub fn with(&self, parameters: Vec<f64>) -> Self {
        Self { way: Arc::clone(&self.way), parameters, stop: None }
    }

    /// The same for a run that `stop` ends.
    pub fn until(&self, stop: &Arc<AtomicBool>) -> Self {
        Self { stop: Some(Arc::clone(stop)), ..self.clone() }
    }

    /// Whether it is to be evaluated still.
    #[inline]
    pub fn goes_on(&self) -> bool {
        go_on() && self.stop.as_ref().is_none_or(|stop| !stop.load(Ordering::Relaxed))
    }
}

impl<T, C> Clone for Shared<T, C> {
    fn clone(&self) -> Self {
        self.with(self.parameters.clone())
    }
}
