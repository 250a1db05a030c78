//! W1, W2: a turn in the plane, range and bearing.

use crate::model::Model;

#[derive(Clone, Copy)]
pub struct Plane;

impl Model for Plane {
    fn states(&self) -> usize {
        5
    }

    fn measures(&self) -> usize {
        2
    }

    #[inline]
    fn transition(&self, x: &[f64], out: &mut [f64]) {
        let w = x[4];
        let (s, c) = w.sin_cos();
        let (a, b) = (s / w, (1.0 - c) / w);
        out[0] = x[0] + a * x[1] - b * x[3];
        out[1] = c * x[1] - s * x[3];
        out[2] = x[2] + b * x[1] + a * x[3];
        out[3] = s * x[1] + c * x[3];
        out[4] = w;
    }

    #[inline]
    fn observe(&self, x: &[f64], out: &mut [f64]) {
        out[0] = (x[0] * x[0] + x[2] * x[2]).sqrt();
        out[1] = x[2].atan2(x[0]);
    }

    fn process(&self) -> Vec<f64> {
        let mut q = vec![0.0; 25];
        for i in [0, 2] {
            q[6 * i] = 0.1 / 3.0;
            (q[6 * i + 1], q[6 * i + 5]) = (0.05, 0.05);
            q[6 * i + 6] = 0.1;
        }
        q[24] = 1e-7;
        q
    }

    fn measurement(&self) -> Vec<f64> {
        vec![100.0, 1e-5]
    }

    fn mean(&self) -> Vec<f64> {
        vec![20000.0, 300.0, 20000.0, 0.0, -3.0_f64.to_radians()]
    }

    fn variances(&self) -> Vec<f64> {
        vec![100.0, 10.0, 100.0, 10.0, 1e-5]
    }
}
