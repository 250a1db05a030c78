//! W3b: a turn in space, 4 s by 16 steps of the classic Runge–Kutta method; range, azimuth and elevation.

use crate::model::Model;

#[derive(Clone, Copy)]
pub struct Space;

const GAP: f64 = 4.0;

#[inline]
fn drift(x: &[f64; 7]) -> [f64; 7] {
    [x[1], -x[6] * x[3], x[3], x[6] * x[1], x[5], 0.0, 0.0]
}

#[inline]
fn ahead(x: &[f64; 7], by: f64, k: &[f64; 7]) -> [f64; 7] {
    core::array::from_fn(|i| x[i] + by * k[i])
}

impl Model for Space {
    fn states(&self) -> usize {
        7
    }

    fn measures(&self) -> usize {
        3
    }

    #[inline]
    fn transition(&self, x: &[f64], out: &mut [f64]) {
        let mut x: [f64; 7] = core::array::from_fn(|i| x[i]);
        let h = GAP / 16.0;
        for _ in 0..16 {
            let k1 = drift(&x);
            let k2 = drift(&ahead(&x, 0.5 * h, &k1));
            let k3 = drift(&ahead(&x, 0.5 * h, &k2));
            let k4 = drift(&ahead(&x, h, &k3));
            x = core::array::from_fn(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
        out.copy_from_slice(&x);
    }

    #[inline]
    fn observe(&self, x: &[f64], out: &mut [f64]) {
        let ground = (x[0] * x[0] + x[2] * x[2]).sqrt();
        out[0] = (ground * ground + x[4] * x[4]).sqrt();
        out[1] = x[2].atan2(x[0]);
        out[2] = x[4].atan2(ground);
    }

    fn process(&self) -> Vec<f64> {
        let mut q = vec![0.0; 49];
        for i in [0, 2, 4] {
            q[8 * i] = 0.2 * GAP.powi(3) / 3.0;
            (q[8 * i + 1], q[8 * i + 7]) = (0.1 * GAP * GAP, 0.1 * GAP * GAP);
            q[8 * i + 8] = 0.2 * GAP;
        }
        q[48] = 4.9e-7 * GAP;
        q
    }

    fn measurement(&self) -> Vec<f64> {
        let angle = 0.1_f64.to_radians();
        vec![2500.0, angle * angle, angle * angle]
    }

    fn mean(&self) -> Vec<f64> {
        vec![1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 6.0_f64.to_radians()]
    }

    fn variances(&self) -> Vec<f64> {
        vec![100.0, 10.0, 100.0, 10.0, 100.0, 10.0, 1e-4]
    }
}
