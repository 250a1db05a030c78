//! What a run over a trajectory learnt, row by row.

/// The estimates of a trajectory: one row for each row of data, columns named as in the command's JSON lines.
///
/// All numbers of a kind stand in one array, row after row; the accessors cut out one row.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Estimates {
    pub(crate) states: usize,
    pub(crate) measures: usize,
    pub(crate) smoothed: bool,
    /// Time of every row.
    pub time: Vec<f64>,
    /// Filtered or smoothed means, rows × n.
    pub mean: Vec<f64>,
    /// Filtered or smoothed covariances, rows × n × n.
    pub cov: Vec<f64>,
    /// Lower-triangular roots of these covariances, rows × n × n, diagonal ≥ 0: those of a square-root method are its own,
    /// never taken of a covariance.
    pub factor: Vec<f64>,
    /// Filtered means of a smoother, rows × n; empty for a filter.
    pub filtered_mean: Vec<f64>,
    /// Filtered covariances of a smoother, rows × n × n; empty for a filter.
    pub filtered_cov: Vec<f64>,
    /// Predicted means, rows × n.
    pub predicted_mean: Vec<f64>,
    /// Predicted covariances, rows × n × n.
    pub predicted_cov: Vec<f64>,
    /// Innovations, rows × d; NaN where a component was missing.
    pub innovation: Vec<f64>,
    /// Innovation covariances, rows × d × d; NaN where a component was missing.
    pub innovation_cov: Vec<f64>,
    /// νᵀ P_zz⁻¹ ν of every row; NaN where nothing was measured.
    pub nis: Vec<f64>,
    /// Components that were there, of every row.
    pub nis_dof: Vec<usize>,
    /// Log-likelihood of every row's measurement; 0 where nothing was measured, or taken in.
    pub log_likelihood: Vec<f64>,
    /// Whether a row was beyond the [gate](crate::Gated), and so not taken in.
    pub gated: Vec<bool>,
}

/// Lists the arrays of floats of some estimates with the lengths of their rows; a filter has no rows of filtered ones besides.
macro_rules! arrays {
    ($of:ident $(, $mut:tt)?) => {{
        let (n, d, smoother) = ($of.states, $of.measures, usize::from($of.smoothed));
        [
            (&$($mut)? $of.time, 1),
            (&$($mut)? $of.mean, n),
            (&$($mut)? $of.cov, n * n),
            (&$($mut)? $of.factor, n * n),
            (&$($mut)? $of.filtered_mean, n * smoother),
            (&$($mut)? $of.filtered_cov, n * n * smoother),
            (&$($mut)? $of.predicted_mean, n),
            (&$($mut)? $of.predicted_cov, n * n),
            (&$($mut)? $of.innovation, d),
            (&$($mut)? $of.innovation_cov, d * d),
            (&$($mut)? $of.nis, 1),
            (&$($mut)? $of.log_likelihood, 1),
        ]
    }};
}

impl Estimates {
    pub(crate) fn new(states: usize, measures: usize, smoothed: bool) -> Self {
        Self { states, measures, smoothed, ..Self::default() }
    }

    /// The arrays of floats, each with the length of its rows.
    fn arrays(&self) -> [(&Vec<f64>, usize); 12] {
        arrays!(self)
    }

    fn arrays_mut(&mut self) -> [(&mut Vec<f64>, usize); 12] {
        arrays!(self, mut)
    }

    /// Makes room for so many more rows, if there is that much memory.
    pub(crate) fn reserve(&mut self, rows: usize) {
        for (array, len) in self.arrays_mut() {
            let _ = array.try_reserve_exact(rows.saturating_mul(len));
        }
        let _ = self.nis_dof.try_reserve_exact(rows);
        let _ = self.gated.try_reserve_exact(rows);
    }

    /// Drops what stands behind the first `rows` rows.
    pub(crate) fn truncate(&mut self, rows: usize) {
        for (array, len) in self.arrays_mut() {
            array.truncate(rows * len);
        }
        self.nis_dof.truncate(rows);
        self.gated.truncate(rows);
    }

    /// Appends row `row` of other estimates, of as many states and measures; those of the first row that is appended to none.
    ///
    /// False, and nothing is appended, where the others have not this row, or rows of other lengths.
    #[must_use]
    pub fn push(&mut self, other: &Self, row: usize) -> bool {
        let of = |est: &Self| (est.states, est.measures, est.smoothed);
        if row >= other.len() || !(self.is_empty() || of(self) == of(other)) {
            return false;
        }
        if self.is_empty() {
            *self = Self::new(other.states, other.measures, other.smoothed);
        }
        for ((to, len), (from, _)) in self.arrays_mut().into_iter().zip(other.arrays()) {
            to.extend_from_slice(&from[row * len..(row + 1) * len]);
        }
        self.nis_dof.push(other.nis_dof[row]);
        self.gated.push(other.gated[row]);
        true
    }

    /// Takes off the rows from `row` on.
    pub(crate) fn split_off(&mut self, row: usize) -> Self {
        let mut off = Self::new(self.states, self.measures, self.smoothed);
        for ((to, len), (from, _)) in off.arrays_mut().into_iter().zip(self.arrays_mut()) {
            *to = from.split_off(row * len);
        }
        off.nis_dof = self.nis_dof.split_off(row);
        off.gated = self.gated.split_off(row);
        off
    }

    /// Writes row `from` of other estimates of the same trajectory over row `row`.
    pub(crate) fn copy_row(&mut self, row: usize, other: &Self, from: usize) {
        for ((to, len), (source, _)) in self.arrays_mut().into_iter().zip(other.arrays()) {
            to[row * len..(row + 1) * len].copy_from_slice(&source[from * len..(from + 1) * len]);
        }
        self.nis_dof[row] = other.nis_dof[from];
        self.gated[row] = other.gated[from];
    }

    /// Bytes of one row of the estimates of n `states` and d `measures`; those of a smoother are `smoothed`.
    ///
    /// ```
    /// assert_eq!(givens::Estimates::row_bytes(5, 2, false), 761);
    /// ```
    pub const fn row_bytes(states: usize, measures: usize, smoothed: bool) -> usize {
        let (vectors, matrices) = if smoothed { (3, 4) } else { (2, 3) };
        let belief = states.saturating_mul(states.saturating_mul(matrices).saturating_add(vectors));
        let innovation = measures.saturating_mul(measures.saturating_add(1));
        let floats = belief.saturating_add(innovation).saturating_add(4);
        floats.saturating_mul(size_of::<f64>()).saturating_add(size_of::<bool>())
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// No rows.
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// Whether `mean` and `cov` are smoothed ones.
    pub fn is_smoothed(&self) -> bool {
        self.smoothed
    }

    /// Length n of the state.
    pub fn states(&self) -> usize {
        self.states
    }

    /// Length d of the measurement, all sensors together.
    pub fn measures(&self) -> usize {
        self.measures
    }

    /// Log-likelihood of the whole trajectory.
    pub fn total_log_likelihood(&self) -> f64 {
        self.log_likelihood.iter().sum()
    }

    fn vector<'a>(&self, of: &'a [f64], row: usize) -> &'a [f64] {
        &of[row * self.states..(row + 1) * self.states]
    }

    fn matrix<'a>(&self, of: &'a [f64], row: usize) -> &'a [f64] {
        let square = self.states * self.states;
        &of[row * square..(row + 1) * square]
    }

    /// Mean of a row, length n.
    pub fn mean(&self, row: usize) -> &[f64] {
        self.vector(&self.mean, row)
    }

    /// Covariance of a row, n × n.
    pub fn cov(&self, row: usize) -> &[f64] {
        self.matrix(&self.cov, row)
    }

    /// Lower-triangular root of the covariance of a row, n × n, diagonal ≥ 0.
    pub fn factor(&self, row: usize) -> &[f64] {
        self.matrix(&self.factor, row)
    }

    /// Standard deviation of component `i` of a row.
    pub fn std(&self, row: usize, i: usize) -> f64 {
        self.cov(row)[i * self.states + i].max(0.0).sqrt()
    }

    /// Filtered mean of a row, length n.
    pub fn filtered_mean(&self, row: usize) -> &[f64] {
        self.vector(if self.smoothed { &self.filtered_mean } else { &self.mean }, row)
    }

    /// Filtered covariance of a row, n × n.
    pub fn filtered_cov(&self, row: usize) -> &[f64] {
        self.matrix(if self.smoothed { &self.filtered_cov } else { &self.cov }, row)
    }

    /// Predicted mean of a row, length n.
    pub fn predicted_mean(&self, row: usize) -> &[f64] {
        self.vector(&self.predicted_mean, row)
    }

    /// Predicted covariance of a row, n × n.
    pub fn predicted_cov(&self, row: usize) -> &[f64] {
        self.matrix(&self.predicted_cov, row)
    }

    /// Innovation of a row, length d; NaN where a component was missing.
    pub fn innovation(&self, row: usize) -> &[f64] {
        &self.innovation[row * self.measures..(row + 1) * self.measures]
    }

    /// Innovation covariance of a row, d × d; NaN where a component was missing.
    pub fn innovation_cov(&self, row: usize) -> &[f64] {
        let square = self.measures * self.measures;
        &self.innovation_cov[row * square..(row + 1) * square]
    }
}
