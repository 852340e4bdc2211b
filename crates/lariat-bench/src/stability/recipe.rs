//! Parameters of random scenes: numbers between 0 and 1, so that a property test can shrink them.

use super::host::{Host, ITERATIONS, Precision, RATES};

/// Number of parameters.
pub const NUMBERS: usize = 32;

/// Random scenes of the full run.
pub const SCENES: usize = 500;

/// The parameters of a random scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe(pub [f64; NUMBERS]);

impl Recipe {
    /// Returns the parameters of a seed: SplitMix64 (Steele, Lea, Flood 2014).
    pub fn from_seed(seed: u64) -> Self {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        Recipe([(); NUMBERS].map(|()| {
            state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            (z ^ (z >> 31)) as f64 / u64::MAX as f64
        }))
    }

    /// Maps a parameter to one of `n` choices.
    pub fn choose(&self, i: usize, n: usize) -> usize {
        ((self.0[i] * n as f64) as usize).min(n - 1)
    }

    /// Maps a parameter to a power of ten between two exponents.
    pub fn power(&self, i: usize, low: f64, high: f64) -> f64 {
        10f64.powf(low + (high - low) * self.0[i])
    }

    /// Maps a parameter to a number between -1 and 1.
    pub fn signed(&self, i: usize) -> f64 {
        2.0 * self.0[i] - 1.0
    }

    /// Returns the host that the scene is run on; the shortest step, which costs most, is rare.
    pub fn host(&self) -> Host {
        Host {
            rate: RATES[self.choose(0, 7) / 2],
            iterations: ITERATIONS[self.choose(1, 3)],
            precision: if self.choose(2, 2) == 0 { Precision::Single } else { Precision::Double },
            effects: self.choose(3, 3) == 0,
        }
    }
}
