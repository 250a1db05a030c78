//! The unscented transform, plain and scaled.

use super::{Pairs, PointRule, RuleError, Shape};

/// 2n + 1 points: the mean, and ±√(n + λ) e_i with λ = α² (n + κ) − n (Julier & Uhlmann 1997; Wan & van der Merwe 2000).
///
/// α = 1, β = 0 is the plain transform with κ; with κ = 0 too it is the cubature rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unscented {
    /// Spread of the points about the mean.
    pub alpha: f64,
    /// Added to the centre's weight in the covariance; 2 suits a Gaussian when `alpha` is small.
    pub beta: f64,
    /// The plain transform's parameter; 3 − n if `None`, as in the papers.
    pub kappa: Option<f64>,
}

impl Default for Unscented {
    fn default() -> Self {
        Self { alpha: 1.0, beta: 0.0, kappa: None }
    }
}

impl Unscented {
    /// The sizes for a state of length `n`, as a constant.
    #[must_use]
    pub const fn shape_for(self, n: usize) -> Shape {
        self.axes(n).shape(n, Some(1.0))
    }

    const fn kappa(self, n: usize) -> f64 {
        match self.kappa {
            Some(kappa) => kappa,
            None => 3.0 - n as f64,
        }
    }

    /// n + λ, the square of the points' distance from the mean.
    const fn radius2(self, n: usize) -> f64 {
        self.alpha * self.alpha * (n as f64 + self.kappa(n))
    }

    const fn axes(self, n: usize) -> Pairs {
        // w^c₀ − w₀ = 1 − α² + β, and radius² = α² (n + κ)
        let bend = self.beta + self.alpha * self.alpha * self.kappa(n) / n as f64;
        Pairs::Axes { radius2: self.radius2(n), bend }
    }
}

impl PointRule for Unscented {
    fn check(&self, n: usize) -> Result<(), RuleError> {
        let finite = |option, value: f64| {
            if value.is_finite() {
                Ok(())
            } else {
                Err(RuleError { option, value, must: "must be a finite number" })
            }
        };
        finite("beta", self.beta)?;
        if self.alpha.is_nan() || self.alpha <= 0.0 {
            return Err(RuleError { option: "alpha", value: self.alpha, must: "must be above zero" });
        }
        let kappa = self.kappa.unwrap_or(3.0 - n as f64);
        let beside = n as f64 + kappa;
        if beside.is_nan() || beside <= 0.0 {
            let must = "n + kappa must be above zero (n: number of states)";
            return Err(RuleError { option: "kappa", value: kappa, must });
        }
        // nearer points differ by rounding only, further ones overflow
        if !(1e-18..=1e18).contains(&self.radius2(n)) {
            let must = "the points, sqrt(alpha^2 (n + kappa)) standard deviations from the mean, must stand between 1e-9 \
                        and 1e9 away (n: number of states)";
            let far = !(1e-18..=1e18).contains(&beside);
            let (option, value) = if far { ("kappa", kappa) } else { ("alpha", self.alpha) };
            return Err(RuleError { option, value, must });
        }
        Ok(())
    }
    fn centre(&self, n: usize) -> Option<f64> {
        let radius2 = self.radius2(n);
        Some((radius2 - n as f64) / radius2)
    }
    fn pairs(&self, n: usize) -> Pairs {
        self.axes(n)
    }
}

#[cfg(test)]
mod tests {
    use super::Unscented;
    use crate::rule::{Pairs, PointRule};

    #[test]
    fn options_that_leave_no_points_are_refused_by_name() {
        const FAR: &str = "must stand between 1e-9 and 1e9 away";
        const N: usize = 3;
        for (alpha, beta, kappa, option, must) in [
            (0.0, 0.0, 0.0, "alpha", "must be above zero"),
            (-1.0, 0.0, 0.0, "alpha", "must be above zero"),
            (f64::NAN, 0.0, 0.0, "alpha", "must be above zero"),
            (f64::INFINITY, 0.0, 0.0, "alpha", FAR),
            (1e-10, 0.0, 0.0, "alpha", FAR),
            (1.0, f64::INFINITY, 0.0, "beta", "must be a finite number"),
            (1.0, f64::NAN, 0.0, "beta", "must be a finite number"),
            (1.0, 0.0, -3.0, "kappa", "n + kappa must be above zero"),
            (1.0, 0.0, f64::NAN, "kappa", "n + kappa must be above zero"),
            (1.0, 0.0, f64::INFINITY, "kappa", FAR),
            (1.0, 0.0, 1e19, "kappa", FAR),
        ] {
            let told = Unscented { alpha, beta, kappa: Some(kappa) }.check(N).err();
            let told = told.map(|error| (error.option, error.must.contains(must)));
            assert_eq!(told, Some((option, true)), "{alpha} {beta} {kappa}");
        }
        assert!(Unscented { alpha: 1e-8, beta: 2.0, kappa: Some(-2.9) }.check(N).is_ok());
    }

    #[test]
    fn the_points_weigh_one_together() {
        for (alpha, kappa, n) in [(1.0, None, 2), (0.5, Some(1.0), 4), (1e-3, Some(0.0), 7)] {
            let rule = Unscented { alpha, beta: 2.0, kappa };
            let radius2 = if let Pairs::Axes { radius2, .. } = rule.pairs(n) { radius2 } else { f64::NAN };
            // each of the 2 n points along the axes weighs 1/(2 radius²)
            let weight = rule.centre(n).unwrap_or(f64::NAN) + n as f64 / radius2;
            assert!(
                (weight - 1.0).abs() < 1e-15 * n as f64 / radius2.min(1.0),
                "{alpha} {kappa:?}: {weight}"
            );
        }
    }
}
