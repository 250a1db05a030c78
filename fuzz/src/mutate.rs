//! One input made of another: as libFuzzer does it, and by the words of a target.

/// Random numbers from a seed (SplitMix64).
pub struct Random(u64);

impl Random {
    /// Those of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// Below `most`, or zero.
    pub fn below(&mut self, most: usize) -> usize {
        (self.word() % most.max(1) as u64) as usize
    }
}

/// One to four changes of `input`, of at most `longest` bytes after them.
#[must_use]
pub fn mutate(input: &[u8], words: &[&str], longest: usize, random: &mut Random) -> Vec<u8> {
    let mut made = input.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(made.len() + 1);
        let span = at..(at + random.below(9)).min(made.len());
        match random.below(if words.is_empty() { 6 } else { 9 }) {
            0 => drop(made.drain(span)),
            1 => drop(made.splice(at..at, [random.word() as u8])),
            2 | 3 if at < made.len() => made[at] = random.word() as u8,
            4 if at < made.len() => made[at] ^= 1 << random.below(8),
            5 => {
                let from = random.below(made.len() + 1);
                let piece = made[from..(from + random.below(40)).min(made.len())].to_vec();
                drop(made.splice(at..at, piece));
            }
            6 => drop(made.splice(span, words[random.below(words.len())].bytes())),
            7.. => drop(made.splice(at..at, words[random.below(words.len())].bytes())),
            _ => made.push(random.word() as u8),
        }
    }
    made.truncate(longest);
    made
}
