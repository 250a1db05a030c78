//! What givens itself says of its answers to a rung, and what they are worth then.

use super::{Rung, Sight, Stage, Verdict, asks, judge};
use givens::filter::Gaussian;
use givens::registry::{Choice, Kind};
use givens::{Data, Doubtful, Doubts, Goal};

impl Rung {
    /// What the answer of a method of givens is worth; none where nothing is determined.
    #[must_use]
    pub fn verdict(&self, choice: &Choice) -> Option<Verdict> {
        let verdict = judge(self.answer(choice.precision)?, asks(choice), &self.run(choice, None))?;
        Some(match verdict {
            Verdict::Wrong(error) if !self.doubts(choice).is_empty() => Verdict::Doubted(error),
            other => other,
        })
    }

    /// Runs a method as its users do, and says what is doubtful about its answers.
    ///
    /// # Panics
    /// If the rung's rows are not in order.
    #[must_use]
    pub fn doubts(&self, choice: &Choice) -> Vec<Doubtful> {
        let (stage, sight) = (Stage(self), Sight(self));
        let prior = Gaussian::from_cov(&self.prior.0, &self.prior.1).unwrap();
        if self.repeat.is_some() {
            return Vec::new();
        }
        let several = choice.kind() == Kind::Discrete && self.steps.len() > 1;
        let mut data = Data::with_controls(self.h.nrows(), usize::from(several)).starting_at(0.0);
        // a control holds from its row to the next, and a filter that is stepped sets it before it predicts
        let control = |k: usize| if several { vec![k as f64] } else { Vec::new() };
        if several {
            data.push_controlled(0.0, &vec![f64::NAN; self.h.nrows()], &control(0)).unwrap();
        }
        for (k, (&time, z)) in self.times.iter().zip(&self.z).enumerate() {
            let next = (k + 1).min(self.steps.len() - 1);
            data.push_controlled(time, z, &control(next)).unwrap();
        }
        let mut doubts = Doubts::new(choice);
        doubts.begin(0, 0.0, &prior);
        if choice.kind() == Kind::Discrete {
            let outcome = choice.run(&stage, &sight, data.rows(), 0.0, &prior, Goal::Filter, &[]);
            doubts.add(0, 0, &outcome.estimates, &mut |_| None);
        } else {
            let outcome = choice.run_continuous(&stage, &sight, data.rows(), 0.0, &prior, Goal::Filter, &[]);
            doubts.add(0, 0, &outcome.estimates, &mut |gap| choice.halved(&stage, &sight, &[], &[], gap));
        }
        doubts.found().copied().collect()
    }
}
