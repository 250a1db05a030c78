//! What the lanes of a pack learn, written to the estimates of their tracks.

use super::Track;
use crate::Estimates;
use crate::filter::{Filter, Innovation, Over};
use crate::kernels::square;
use crate::model::Observation;
use crate::run::{Goal, Outcome};
use crate::scalar::{LaneMask, MAX_WIDTH, Pack, Real};

/// The estimates of the tracks of a pack.
pub(super) struct Lanes<P: Pack> {
    of: Vec<Estimates>,
    states: usize,
    measures: usize,
    goal: Goal,
    /// A matrix of packs, and its numbers lane by lane.
    matrix: Vec<P>,
    numbers: Vec<P::Element>,
}

impl<P: Pack> Lanes<P> {
    /// Room for all rows of the tracks, of n states: those of the filter, which the prior of a track that could not begin may
    /// not have.
    pub fn new<M, H: Observation>(tracks: &[Track<M, H>], n: usize, goal: Goal) -> Self {
        let d = tracks[0].sensors.measures();
        let smoothed = goal != Goal::Filter;
        let room = |track: &Track<M, H>| {
            let rows = track.data.len();
            let zeros = |len: usize| vec![0.0; rows * len];
            let filtered = |len: usize| zeros(if smoothed { len } else { 0 });
            Estimates {
                time: track.data.rows().map(|row| row.time).collect(),
                mean: zeros(n),
                cov: zeros(n * n),
                factor: zeros(n * n),
                filtered_mean: filtered(n),
                filtered_cov: filtered(n * n),
                predicted_mean: zeros(n),
                predicted_cov: zeros(n * n),
                innovation: vec![f64::NAN; rows * d],
                innovation_cov: vec![f64::NAN; rows * d * d],
                nis: vec![f64::NAN; rows],
                nis_dof: vec![0; rows],
                log_likelihood: zeros(1),
                gated: vec![false; rows],
                ..Estimates::new(n, d, smoothed)
            }
        };
        let largest = (n * n).max(d * d).max(1);
        Self {
            of: tracks.iter().map(room).collect(),
            states: n,
            measures: d,
            goal,
            matrix: vec![P::zero(); largest],
            numbers: vec![P::Element::zero(); largest * P::WIDTH],
        }
    }

    /// Writes down what `active` lanes predict for row `k`.
    #[inline(always)]
    pub fn predicted<X: Over<M>, M>(&mut self, filter: &Filter<'_, X, M, P, Vec<P>>, k: usize, active: u32) {
        let n = self.states;
        self.put(filter.mean(), k, active, |out| &mut out.predicted_mean);
        let mut cov = core::mem::take(&mut self.matrix);
        filter.write_cov(&mut cov[..n * n]);
        self.put(&cov[..n * n], k, active, |out| &mut out.predicted_cov);
        self.matrix = cov;
    }

    /// Writes down what `active` lanes believe after row `k`, of whose components those `present` were there, and which
    /// those `gated` have not taken in.
    #[inline(always)]
    pub fn updated<X: Over<M>, M>(
        &mut self,
        filter: &Filter<'_, X, M, P, Vec<P>>,
        k: usize,
        present: &[P::Mask],
        active: u32,
        gated: u32,
    ) {
        let n = self.states;
        self.put(filter.mean(), k, active, |out| &mut out.mean);
        self.put(filter.factor(), k, active, |out| &mut out.factor);
        let mut matrix = core::mem::take(&mut self.matrix);
        filter.write_cov(&mut matrix[..n * n]);
        self.put(&matrix[..n * n], k, active, |out| &mut out.cov);
        if self.goal != Goal::Filter {
            self.put(filter.mean(), k, active, |out| &mut out.filtered_mean);
            self.put(&matrix[..n * n], k, active, |out| &mut out.filtered_cov);
        }
        self.innovation(&filter.innovation(), &mut matrix, k, present, active);
        for (lane, out) in self.of.iter_mut().enumerate().filter(|(lane, _)| active >> lane & 1 == 1) {
            out.gated[k] = gated >> lane & 1 == 1;
        }
        self.matrix = matrix;
    }

    /// The components that a lane has not are left as they are.
    #[inline(always)]
    fn innovation(
        &mut self,
        innovation: &Innovation<P>,
        matrix: &mut [P],
        k: usize,
        present: &[P::Mask],
        active: u32,
    ) {
        let d = self.measures;
        // no lane has a measurement, or none took it in
        if innovation.nu.len() < d {
            return;
        }
        square(&mut matrix[..d * d], d, innovation.factor, d, d);
        let (mut nu, mut cov) = ([P::Element::zero(); MAX_WIDTH], [P::Element::zero(); MAX_WIDTH]);
        let there = |i: usize| present[i].bits() & active;
        for i in 0..d {
            innovation.nu[i].store(&mut nu);
            for (lane, out) in self.of.iter_mut().enumerate().filter(|(lane, _)| there(i) >> lane & 1 == 1) {
                out.innovation[k * d + i] = nu[lane].first();
                out.nis_dof[k] += 1;
            }
            for j in 0..d {
                matrix[i * d + j].store(&mut cov);
                let both = there(i) & there(j);
                for (lane, out) in self.of.iter_mut().enumerate().filter(|(lane, _)| both >> lane & 1 == 1) {
                    out.innovation_cov[k * d * d + i * d + j] = cov[lane].first();
                }
            }
        }
        innovation.nis.store(&mut nu);
        innovation.log_likelihood.store(&mut cov);
        for (lane, out) in self.of.iter_mut().enumerate() {
            if active >> lane & 1 == 1 && out.nis_dof[k] > 0 {
                (out.nis[k], out.log_likelihood[k]) = (nu[lane].first(), cov[lane].first());
            }
        }
    }

    /// Writes the smoothed beliefs, mean and factor, from the last row of the pack back to its first. The lanes whose numbers
    /// are finite.
    #[inline(always)]
    pub fn smoothed(&mut self, way: &[P]) -> u32 {
        let n = self.states;
        let len = n + n * n;
        let last = way.len() / len - 1;
        let mut finite = u32::MAX;
        let mut cov = core::mem::take(&mut self.matrix);
        for (age, belief) in way.chunks_exact(len).enumerate() {
            let k = last - age;
            let active = self.have(k);
            let (mean, factor) = belief.split_at(n);
            square(&mut cov[..n * n], n, factor, n, n);
            let sum = crate::kernels::plus_magnitudes(P::zero(), belief);
            finite &= sum.finite().bits() | !active;
            self.put(mean, k, active, |out| &mut out.mean);
            self.put(factor, k, active, |out| &mut out.factor);
            self.put(&cov[..n * n], k, active, |out| &mut out.cov);
        }
        self.matrix = cov;
        finite
    }

    /// The lanes that have a row `k`.
    fn have(&self, k: usize) -> u32 {
        self.of.iter().enumerate().fold(0, |bits, (lane, out)| bits | u32::from(k < out.time.len()) << lane)
    }

    /// Writes row `k` of an array of the `active` lanes.
    #[inline(always)]
    fn put(&mut self, packs: &[P], k: usize, active: u32, array: fn(&mut Estimates) -> &mut Vec<f64>) {
        for (to, pack) in self.numbers.chunks_exact_mut(P::WIDTH).zip(packs) {
            pack.store(to);
        }
        for (lane, out) in self.of.iter_mut().enumerate() {
            if active >> lane & 1 == 1 {
                let row = &mut array(out)[k * packs.len()..(k + 1) * packs.len()];
                for (to, numbers) in row.iter_mut().zip(self.numbers.chunks_exact(P::WIDTH)) {
                    *to = numbers[lane].first();
                }
            }
        }
    }

    /// The outcomes of the lanes that are `well`.
    pub fn finish(self, well: u32) -> Vec<Option<Outcome>> {
        let (n, d, goal) = (self.states, self.measures, self.goal);
        let lanes = self.of.into_iter().enumerate();
        let outcome = |estimates: Estimates| {
            let blank = Outcome::new(n, d, goal);
            let at = Estimates::new(n, d, goal != Goal::Filter);
            Outcome { log_likelihood: estimates.total_log_likelihood(), estimates, at, ..blank }
        };
        lanes.map(|(lane, estimates)| (well >> lane & 1 == 1).then(|| outcome(estimates))).collect()
    }
}
