//! The coefficients of the explicit Runge–Kutta methods.

use crate::scalar::Real;

/// k_i = f(t + c_i h, y + h Σ_j<i a_ij k_j), y⁺ = y + h Σ b_i k_i (docs/algorithms.md O1). The slope at the end,
/// f(t + h, y⁺), counts as one stage more in `error` and `dense`.
pub(super) struct Tableau {
    /// Number of stages.
    pub stages: usize,
    /// Below the diagonal, row by row.
    pub a: &'static [f64],
    /// Weights of the stages.
    pub b: &'static [f64],
    /// Times of the stages.
    pub c: &'static [f64],
    /// b − b̂ of the embedded formula, the end included; empty without one.
    pub error: &'static [f64],
    /// Weights of what dense output has beyond the cubic; empty without.
    pub dense: &'static [f64],
}

/// Σ weights_i vectors_i to `out`, in the order of i; the vectors stand one behind the other.
#[inline(always)]
pub(super) fn combine<T: Real>(weights: &[f64], vectors: &[T], out: &mut [T]) {
    out.fill(T::zero());
    for (&weight, vector) in weights.iter().zip(vectors.chunks_exact(out.len())) {
        if weight != 0.0 {
            let weight = T::of(weight);
            for (out, &x) in out.iter_mut().zip(vector) {
                *out = x.mul_add(weight, *out);
            }
        }
    }
}

/// Order 1.
pub(super) const EULER: Tableau = Tableau { stages: 1, a: &[], b: &[1.0], c: &[0.0], error: &[], dense: &[] };

/// Order 2: Heun's method, the RK2 of the golden values. (The midpoint rule has a = ½, b = 0, 1, c = 0, ½.)
pub(super) const RK2: Tableau =
    Tableau { stages: 2, a: &[1.0], b: &[0.5, 0.5], c: &[0.0, 1.0], error: &[], dense: &[] };

/// Order 4: the classical one.
pub(super) const RK4: Tableau = Tableau {
    stages: 4,
    a: &[0.5, 0.0, 0.5, 0.0, 0.0, 1.0],
    b: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    c: &[0.0, 0.5, 0.5, 1.0],
    error: &[],
    dense: &[],
};

/// Order 5 with an embedded 4 (Dormand & Prince 1980); dense output of order 4 (Hairer, Nørsett & Wanner 1993, §II.6).
pub(super) const DP5: Tableau = Tableau {
    stages: 6,
    a: &[
        1.0 / 5.0,
        3.0 / 40.0,
        9.0 / 40.0,
        44.0 / 45.0,
        -56.0 / 15.0,
        32.0 / 9.0,
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
    ],
    b: &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    c: &[0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0],
    error: &[
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339_200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ],
    dense: &[
        -12_715_105_075.0 / 11_282_082_432.0,
        0.0,
        87_487_479_700.0 / 32_700_410_799.0,
        -10_690_763_975.0 / 1_880_347_072.0,
        701_980_252_875.0 / 199_316_789_632.0,
        -1_453_857_185.0 / 822_651_844.0,
        69_997_945.0 / 29_380_423.0,
    ],
};

#[cfg(test)]
mod tests {
    use super::{DP5, EULER, RK2, RK4, Tableau};

    /// Row `i` of a.
    fn row(tableau: &Tableau, i: usize) -> &[f64] {
        &tableau.a[i * i.saturating_sub(1) / 2..][..i]
    }

    #[test]
    fn rows_sum_to_their_times_weights_to_one_and_errors_to_zero() {
        for tableau in [&EULER, &RK2, &RK4, &DP5] {
            assert_eq!(tableau.a.len(), tableau.stages * (tableau.stages - 1) / 2);
            assert!((tableau.b.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            assert!(tableau.error.iter().sum::<f64>().abs() < 1e-15);
            assert!(tableau.dense.iter().sum::<f64>().abs() < 1e-14);
            for i in 0..tableau.stages {
                assert!((row(tableau, i).iter().sum::<f64>() - tableau.c[i]).abs() < 1e-14);
            }
        }
    }
}
