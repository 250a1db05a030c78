//! Whether a contestant computes the same as the reference.

use std::path::Path;

/// How far two results are from each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// Largest difference of a mean, in the reference's standard deviations.
    pub mean: f64,
    /// Largest relative difference of a standard deviation.
    pub std: f64,
}

impl Distance {
    /// Of a result from the reference, both row by row: `states` means, then variances.
    pub fn of(result: &[f64], reference: &[f64], states: usize) -> Result<Self, String> {
        if result.len() != reference.len() {
            return Err(format!("{} numbers in place of {}", result.len(), reference.len()));
        }
        let (mut mean, mut std) = (0.0_f64, 0.0_f64);
        for (own, right) in result.chunks(2 * states).zip(reference.chunks(2 * states)) {
            for i in 0..states {
                let sigma = right[states + i].sqrt();
                mean = larger(mean, (own[i] - right[i]).abs() / sigma);
                std = larger(std, (own[states + i].sqrt() / sigma - 1.0).abs());
            }
        }
        Ok(Self { mean, std })
    }

    /// The larger of both.
    pub fn worst(self) -> f64 {
        larger(self.mean, self.std)
    }
}

/// NaN counts as the largest.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// The reference of a workload: its numbers, and how many states they are of.
pub fn reference(inputs: &Path, workload: &str) -> Result<(Vec<f64>, usize), String> {
    let path = inputs.join("expected").join(format!("{workload}.csv"));
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut lines = text.lines();
    let columns = lines.next().unwrap_or("").split(',').count();
    let numbers = lines.flat_map(|line| line.split(',')).map(str::parse).collect::<Result<_, _>>();
    Ok((numbers.map_err(|error| format!("{}: {error}", path.display()))?, columns / 2))
}

#[cfg(test)]
mod tests {
    use super::Distance;

    #[test]
    fn distances_are_in_standard_deviations() {
        let right = [1.0, 2.0, 4.0, 9.0];
        let own = [1.2, 2.0, 4.0, 9.0 * 1.21];
        let distance = Distance::of(&own, &right, 2).unwrap();
        assert!((distance.mean - 0.1).abs() < 1e-12 && (distance.std - 0.1).abs() < 1e-12);
        assert!(Distance::of(&own[..3], &right, 2).is_err());
        assert!(Distance::of(&[f64::NAN, 2.0, 4.0, 9.0], &right, 2).unwrap().worst().is_nan());
    }
}
