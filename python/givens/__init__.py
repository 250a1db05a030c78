"""Nonlinear Gaussian state estimation: filters and smoothers of the cubature family."""
