//! Ranges of numbers.

/// A range of finite numbers.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// The range as text; empty for all finite numbers.
    pub text: &'static str,
    inside: fn(f64) -> bool,
    /// True if the number goes to Rapier, which computes in single precision.
    single: bool,
}

/// All finite numbers.
pub const ANY: Range = Range { text: "", inside: |_| true, single: false };
/// Positive numbers.
pub const POSITIVE: Range = Range { text: "> 0", inside: |x| x > 0.0, single: false };
/// Zero and positive numbers.
pub const NOT_NEGATIVE: Range = Range { text: ">= 0", inside: |x| x >= 0.0, single: false };
/// From 0 to 1.
pub const UNIT: Range = Range { text: "from 0 to 1", inside: |x| (0.0..=1.0).contains(&x), single: false };
/// Shares of a whole that are not zero.
pub const SHARE: Range = Range { text: "in (0, 1]", inside: |x| x > 0.0 && x <= 1.0, single: false };
/// What the discrete gradient may dissipate.
pub const DISSIPATION: Range =
    Range { text: "from 0 to 0.0625", inside: |x| (0.0..=0.0625).contains(&x), single: false };

impl Range {
    /// Returns the same range for numbers that must stay in it when they are rounded to single precision.
    pub const fn single(self) -> Self {
        Range { single: true, ..self }
    }

    /// Returns whether a number is in the range.
    pub fn contains(&self, x: f64) -> bool {
        let rounded = f64::from(x as f32);
        self.contains_in_double(x) && (!self.single || rounded.is_finite() && (self.inside)(rounded))
    }

    /// Returns whether a number is in the range before it is rounded to single precision.
    pub fn contains_in_double(&self, x: f64) -> bool {
        x.is_finite() && (self.inside)(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_precision_excludes_what_it_rounds_out_of_the_range() {
        assert!(POSITIVE.contains(1e-60) && POSITIVE.contains(1e60));
        assert!(!POSITIVE.single().contains(1e-60) && !POSITIVE.single().contains(1e60));
        assert!(!ANY.contains(f64::NAN) && !NOT_NEGATIVE.contains(f64::INFINITY));
        assert!(SHARE.contains(1.0) && !SHARE.contains(0.0) && !SHARE.contains(1.1));
    }
}
