//! Scenes drawn by chance: a recipe is a list of numbers between 0 and 1, so that a test can shrink it.

use super::host::{Host, ITERATIONS, Precision, RATES};

/// Numbers of a recipe.
pub const NUMBERS: usize = 32;

/// Scenes of the full run.
pub const SCENES: usize = 500;

/// What a random scene is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe(pub [f64; NUMBERS]);

impl Recipe {
    /// The recipe of a seed: SplitMix64 (Steele, Lea, Flood 2014).
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

    /// One of `n` choices.
    pub fn choose(&self, i: usize, n: usize) -> usize {
        ((self.0[i] * n as f64) as usize).min(n - 1)
    }

    /// A power of ten between two exponents.
    pub fn power(&self, i: usize, low: f64, high: f64) -> f64 {
        10f64.powf(low + (high - low) * self.0[i])
    }

    /// A number between -1 and 1.
    pub fn signed(&self, i: usize) -> f64 {
        2.0 * self.0[i] - 1.0
    }

    /// The host it is run on; the finest step only now and then, it costs most.
    pub fn host(&self) -> Host {
        Host {
            rate: RATES[self.choose(0, 7) / 2],
            iterations: ITERATIONS[self.choose(1, 3)],
            precision: if self.choose(2, 2) == 0 { Precision::Single } else { Precision::Double },
            effects: self.choose(3, 3) == 0,
        }
    }
}
