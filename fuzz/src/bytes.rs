//! Choices and numbers from bytes; where they end, all further ones are zero.

/// What is left of the input.
pub(crate) struct Bytes<'a>(pub &'a [u8]);

/// Numbers at the ends of what there is, and plain ones.
const NUMBERS: [f64; 40] = [
    0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    -0.0,
    0.1,
    1e-3,
    3.0,
    10.0,
    -0.5,
    100.0,
    1e-6,
    1e-9,
    1e3,
    1e6,
    -10.0,
    0.25,
    1e-12,
    1e12,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    5e-324,
    1e-310,
    f64::MIN_POSITIVE,
    1e-160,
    1e-154,
    1e154,
    1e160,
    1e300,
    f64::MAX,
    f64::MIN,
    f64::EPSILON,
    1.0 + f64::EPSILON,
    3.5e38,
    1e-46,
    9_007_199_254_740_993.0,
    core::f64::consts::TAU,
    -1e300,
];

/// Those of them that are neither missing nor near an end.
const PLAIN: usize = 20;

impl Bytes<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let (&first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        first
    }

    /// Below `most`, which is not zero.
    pub fn below(&mut self, most: usize) -> usize {
        usize::from(self.byte()) % most
    }

    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    pub fn word(&mut self) -> u64 {
        (0..8).fold(0, |word, _| word << 8 | u64::from(self.byte()))
    }

    /// Any number.
    pub fn number(&mut self) -> f64 {
        match self.byte() {
            255 => f64::from_bits(self.word()),
            byte @ 200.. => f64::from(self.byte()) / 16.0 * if byte % 2 == 0 { 1.0 } else { -1.0 },
            byte => NUMBERS[usize::from(byte) % NUMBERS.len()],
        }
    }

    /// A number that may well stand in a model: seldom one of the extremes.
    pub fn plain(&mut self) -> f64 {
        match self.byte() {
            255 => self.number(),
            byte @ 128.. => (f64::from(byte) - 190.0) / 16.0,
            byte => NUMBERS[usize::from(byte) % PLAIN],
        }
    }

    pub fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    pub fn plains(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.plain()).collect()
    }

    /// A length: mostly short, now and then the largest or near a root of it.
    pub fn length(&mut self) -> usize {
        match self.byte() {
            255 => usize::MAX,
            254 => usize::MAX / 2 + 1,
            253 => 1 << 32,
            252 => (1 << 32) + 1,
            251 => usize::MAX - 1,
            250 => 3_037_000_500,
            byte => usize::from(byte) % 9,
        }
    }
}
