//! Values of expressions while a model is read.
