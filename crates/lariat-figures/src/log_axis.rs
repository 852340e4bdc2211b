//! A logarithmic axis: values are logarithms to base 10; ticks are powers of ten, and 2 and 5 times
//! them where there is room.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// An axis of logarithms to base 10.
#[derive(Clone, Copy, Debug)]
pub struct LogAxis {
    from: f64,
    to: f64,
    /// Whether ticks are drawn at 2 and 5 too.
    fine: bool,
}

impl LogAxis {
    /// Returns an axis from one logarithm to another, with ticks at powers of ten alone.
    pub fn decades(from: f64, to: f64) -> Self {
        LogAxis { from, to, fine: false }
    }

    /// Returns an axis around positive values with a margin of 6 %, and with ticks at 2 and 5 below
    /// three decades.
    pub fn around(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = crate::style::range(values.map(f64::log10), 0.5);
        let margin = 0.06 * (high - low);
        LogAxis { from: low - margin, to: high + margin, fine: high - low < 3.0 }
    }

    /// Formats a tick: a plain number where that is short, otherwise a power of ten.
    pub fn label(value: f64) -> String {
        let (power, mantissa) = (value.floor(), 10f64.powf(value - value.floor()).round());
        let power = power as i32 + i32::from(mantissa > 9.5);
        let mantissa = if mantissa > 9.5 { 1.0 } else { mantissa };
        match power {
            -2..=3 => format!("{}", mantissa * 10f64.powi(power)).chars().take(5).collect(),
            _ if mantissa == 1.0 => format!("10{}", superscript(power)),
            _ => format!("{mantissa}·10{}", superscript(power)),
        }
    }
}

impl Ranged for LogAxis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;
    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.from) / (self.to - self.from);
        limit.0 + (f64::from(limit.1 - limit.0) * share).round() as i32
    }
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let (first, last) = (self.from.floor() as i32, self.to.ceil() as i32);
        let step = ((last - first) as usize / hint.max_num_points().max(1) + 1).max(1);
        let powers = (first..=last).filter(|p| p.rem_euclid(step as i32) == 0).map(f64::from);
        let mantissas: &[f64] = if self.fine && step == 1 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let ticks = powers.flat_map(|p| mantissas.iter().map(move |m| p + m.log10()));
        ticks.filter(|x| (self.from - 1e-9..=self.to + 1e-9).contains(x)).collect()
    }
    fn range(&self) -> std::ops::Range<f64> {
        self.from..self.to
    }
}

impl ValueFormatter<f64> for LogAxis {
    fn format(value: &f64) -> String {
        LogAxis::label(*value)
    }
}

/// Formats a whole number in superscript digits.
pub fn superscript(power: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    power.to_string().chars().map(digit).collect()
}
