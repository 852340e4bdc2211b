//! What the distances between meshes say about the next one. No claim rests on it.
//!
//! # Equation
//!
//! An error `C h^p` makes the distance `d = C h^p (1 - f^-p)` between meshes with element lengths `h` and `h/f`. Two distances with ratios `f`
//! and `g`, the second mesh of the latter shorter by `r`, have `d_1/d_2 = r^p (1 - f^-p)/(1 - g^-p)`, which grows with `p`; the error of the
//! finest mesh is `d_2/(g^p - 1)`.
//!
//! # Validity
//!
//! Before meshes resolve a motion their distances follow no order, and points beside a kink are nearer to one mesh than to the next. So orders
//! are kept between 1/4 and 4, and a study is ended on one that spans four meshes only.
//!
//! # References
//!
//! Roache 1998, *Verification and validation in computational science and engineering*, section 5.10 (observed order).
//!
//! # Alternatives considered
//!
//! - The order 2.5 throughout: where the order is 1, the elements grow by so little that a study takes three runs more.

/// Order that is assumed where distances show none.
const ASSUMED: f64 = 2.5;
/// Least and largest order.
const ORDERS: [f64; 2] = [0.25, 4.0];
/// Share of the allowed error that the next but one mesh is meant to have.
const AIM: f64 = 0.6;
/// Least growth of the number of elements, and the factor of a distance in a claim that belongs to it.
const LEAST: f64 = 1.5;
const FACTOR: f64 = 1.0 / (LEAST - 1.0);

/// Two meshes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Difference {
    /// Largest distance of their positions in m.
    pub distance: f64,
    /// Ratio of their element lengths.
    pub ratio: f64,
}

/// Returns the order that the first and the last of several distances in succession show.
fn observed(differences: &[Difference]) -> Option<f64> {
    let [first, .., last] = differences else { return None };
    let between: f64 = differences[..differences.len() - 1].iter().map(|difference| difference.ratio).product();
    let ratio = first.distance / last.distance;
    if !ratio.is_finite() {
        return None;
    }
    let [mut low, mut high] = ORDERS;
    for _ in 0..40 {
        let order = 0.5 * (low + high);
        let there = between.powf(order) * (1.0 - first.ratio.powf(-order)) / (1.0 - last.ratio.powf(-order));
        if there < ratio {
            low = order;
        } else {
            high = order;
        }
    }
    Some(low)
}

/// Returns the last of several distances, at most `count`.
fn tail(differences: &[Difference], count: usize) -> &[Difference] {
    &differences[differences.len().saturating_sub(count)..]
}

/// Returns the factor by which the number of elements is to grow for an error in m; by the order of the last distances, if they show `one`.
pub(super) fn growth(differences: &[Difference], error: f64, one: bool) -> f64 {
    let [.., last] = differences else { return LEAST };
    let order = observed(tail(differences, 3)).filter(|_| one).unwrap_or(ASSUMED).min(ASSUMED);
    let finest = last.distance / (last.ratio.powf(order) - 1.0);
    let growth = (finest / (AIM * error)).powf(1.0 / (order + 0.5));
    if growth.is_finite() { growth.clamp(LEAST, 3.0) } else { 3.0 }
}

/// Returns whether refining does not bring the runs together.
pub(super) fn stuck(differences: &[Difference]) -> bool {
    matches!(differences, [.., before, _, last] if last.distance > 0.6 * before.distance)
}

/// Returns the factor by which the number of elements must grow until an error in m is proven, by the order of the last three distances;
/// `None` before there are as many.
pub(super) fn needed(differences: &[Difference], error: f64) -> Option<f64> {
    let [.., _, _, last] = differences else { return None };
    let order = observed(tail(differences, 3))?;
    let finest = last.distance / (last.ratio.powf(order) - 1.0);
    let claimed = finest * FACTOR * (1.0 - LEAST.powf(-order));
    Some(LEAST * (claimed / error).powf(1.0 / order)).filter(|share| share.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// *Source.* The definition of the order.
    #[test]
    fn the_order_of_a_power_is_found_whatever_the_meshes() {
        for order in [0.5, 1.0, 2.0, 3.5] {
            for ratios in [&[2.0, 2.0][..], &[1.5, 3.0], &[3.0, 1.2], &[2.0, 1.5, 3.0]] {
                let mut h = 1.0_f64;
                let mut difference = |ratio: f64| {
                    let coarse = 0.7 * h.powf(order);
                    h /= ratio;
                    Difference { distance: coarse - 0.7 * h.powf(order), ratio }
                };
                let differences: Vec<_> = ratios.iter().map(|ratio| difference(*ratio)).collect();
                assert!((observed(&differences).unwrap() - order).abs() < 1e-6);
            }
        }
    }
}
