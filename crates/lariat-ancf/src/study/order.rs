//! What the distances between meshes say about the next one, and how far the order that is seen
//! falls below the first.
//!
//! # Equation
//!
//! An error `C h^p` makes the distance `d = C h^p (1 - f^-p)` between meshes with element lengths
//! `h` and `h/f`. Two distances with ratios `f` and `g`, the second mesh of the latter shorter by
//! `r`, have `d_1/d_2 = r^p (1 - f^-p)/(1 - g^-p)`, which grows with `p`; the error of the finest
//! mesh is `d_2/(g^p - 1)`.
//!
//! # Validity
//!
//! Before meshes resolve a motion their distances follow no order, and points beside a kink are
//! nearer to one mesh than to the next. So orders are kept between 1/4 and 4, and a study is ended
//! on one that spans four meshes only. A claim about a motion never rests on an order above the
//! first; one below it, of the distances or of the mesh indicator `eta = max h^3 |[[r''']]|/96`,
//! makes it larger: a cable that is set in motion by a jolt can have meshes of 4 and 8 elements
//! nearer to each other than to the truth, while the indicator of the finer one is the larger one.
//! A claim from two meshes alone assumes the order of waves with kinks, 2/3: the hoist of the
//! shipped scenes has meshes of 4 and 8 elements 5.3e-4 m apart and the truth 6.2e-4 m away. Where
//! velocities jump, kinks travel along the cable, and the order is 2/3 at most (Brenner, Thomee &
//! Wahlbin 1975, chapter 5); what buckles under such a shock follows none.
//!
//! In equilibria nothing accumulates. One that is smooth between its ends has the order 3 to 4 once
//! it is resolved, and up to the second is believed, if three meshes and the indicator show it. Of
//! two meshes the indicator alone shows an order; but it is an estimate of the error too,
//! independent of their distance, and a claim is at least four times that of the finer one. A
//! support between the ends bends a cable within `sqrt(EI/T)`, where that is shorter than the
//! elements a kink in its tangent, and meshes converge with 0.5 to 0.9: the order is that of waves
//! with kinks.
//!
//! # References
//!
//! Roache 1998, *Verification and validation in computational science and engineering*, section
//! 5.10 (observed order).
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/study.md.

use crate::scales::study::{AIM, ASSUMED, FACTOR, HALF, LEAST, ORDERS, SMALL};

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

/// Returns the factor by which a claim is larger than the last of several distances: `1/(g^p - 1)`,
/// with the least order p that the last two distances or the mesh indicator show, at most
/// `largest`, and at least 1 unless that is above the first order.
pub(super) fn factor(differences: &[Difference], indicated: Option<f64>, largest: f64) -> f64 {
    let [.., last] = differences else { return f64::INFINITY };
    let seen = observed(tail(differences, 2)).into_iter().chain(indicated);
    let order = seen.fold(largest, f64::min).max(ORDERS[0]);
    let factor = 1.0 / (last.ratio.powf(order) - 1.0);
    if largest > 1.0 { factor } else { factor.max(1.0) }
}

/// Returns the order that the last two distances and the mesh indicator both show; `None` if either
/// shows none.
pub(super) fn shown_by_both(differences: &[Difference], indicated: Option<f64>) -> Option<f64> {
    observed(tail(differences, 2)).zip(indicated).map(|(seen, indicated)| seen.min(indicated))
}

/// Returns the order that the last two distances show.
pub(super) fn shown(differences: &[Difference]) -> Option<f64> {
    observed(tail(differences, 2))
}

/// Returns the last of several distances, at most `count`.
pub(super) fn tail(differences: &[Difference], count: usize) -> &[Difference] {
    &differences[differences.len().saturating_sub(count)..]
}

/// Returns the factor by which the number of elements is to grow for an error in m; by the order of
/// the last distances, if they show `one`.
pub(super) fn growth(differences: &[Difference], error: f64, one: bool) -> f64 {
    let [.., last] = differences else { return LEAST };
    let order = observed(tail(differences, 3)).filter(|_| one).unwrap_or(ASSUMED).min(ASSUMED);
    let finest = last.distance / (last.ratio.powf(order) - 1.0);
    let growth = (finest / (AIM * error)).powf(1.0 / (order + 0.5));
    if growth.is_finite() { growth.clamp(LEAST, 3.0) } else { 3.0 }
}

/// Returns what the last distance in m is at the [order](ASSUMED) that motions with impacts have at
/// most: one below it is small by chance. 0 of a single one.
pub(super) fn least_distance(differences: &[Difference]) -> f64 {
    match differences {
        [.., before, last] => {
            let [first, second] = [before, last].map(|d| d.ratio.powf(ASSUMED));
            before.distance * (1.0 - 1.0 / second) / (first - 1.0)
        }
        _ => 0.0,
    }
}

/// Returns whether the last `count` distances show the [least order](HALF) each that a claim about
/// impacts may rest on, or are small beside an error in m.
pub(super) fn converge(differences: &[Difference], count: usize, error: f64) -> bool {
    let last = tail(differences, count);
    let small = |difference: &Difference| difference.distance <= SMALL * error;
    let falls = |pair: &[Difference]| observed(pair).is_some_and(|order| order >= HALF);
    last.len() == count && (last.iter().all(small) || last.windows(2).all(falls))
}

/// Returns whether refining does not bring the runs together.
pub(super) fn stuck(differences: &[Difference]) -> bool {
    matches!(differences, [.., before, _, last] if last.distance > 0.6 * before.distance)
}

/// Returns whether that is so of the last mesh and of one of the two before, as it would be of all
/// finer ones: before meshes resolve a motion their distances follow no order, and a single one
/// that does not fall may be that of a whip of 12 and 18 elements, which 27 resolve. Where no finer
/// mesh may be taken, `at_limit`, one of the last three is enough.
pub(super) fn stuck_for_good(differences: &[Difference], at_limit: bool) -> bool {
    let before = |finer: usize| stuck(&differences[..differences.len().saturating_sub(finer)]);
    let earlier = before(1) || before(2);
    if at_limit { stuck(differences) || earlier } else { stuck(differences) && earlier }
}

/// Returns the factor by which the number of elements must grow until an error in m is proven, by
/// the order of the last three distances; `None` before there are as many.
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
    use crate::scales::study::KINKS;

    /// *Source.* A geometric series: all later distances together.
    #[test]
    fn the_factor_is_that_of_the_least_order_that_is_seen() {
        let series = |order: f64| -> Vec<Difference> {
            (0..3).map(|k| Difference { distance: 2f64.powf(-order * f64::from(k)), ratio: 2.0 }).collect()
        };
        for order in [0.3, 0.5, 0.8, 1.0, 2.0, 4.0] {
            let rest: f64 = (1..400).map(|k| 2f64.powf(-order * f64::from(k))).sum();
            let found = factor(&series(order), None, 1.0);
            assert!((found / rest.max(1.0) - 1.0).abs() < 1e-6, "{order}: {found} {rest}");
            assert!(factor(&series(4.0), Some(order), 1.0) > (1.0 - 1e-9) * rest.max(1.0));
        }
        // a single distance; distances that grow, or an indicator that does
        assert_eq!(factor(&series(2.0)[..1], None, 1.0), 1.0);
        assert!(factor(&series(-1.0), None, 1.0) > 5.0 && factor(&series(2.0), Some(-3.0), 1.0) > 5.0);
        assert!((factor(&series(2.0), None, KINKS) - 1.0 / (2f64.powf(2.0 / 3.0) - 1.0)).abs() < 1e-12);
        assert_eq!(factor(&[], None, 1.0), f64::INFINITY);
        // above the first order the error is what is left of the series
        assert!((factor(&series(4.0), Some(3.0), 2.0) - 1.0 / 3.0).abs() < 1e-9);
        assert!((shown_by_both(&series(1.5), Some(3.0)).unwrap() - 1.5).abs() < 1e-6);
        assert_eq!(shown_by_both(&series(1.5)[..1], Some(3.0)).or(shown_by_both(&series(1.5), None)), None);
    }

    /// Distances of coarse meshes that do not fall yet, and those of a motion that no mesh
    /// determines.
    #[test]
    fn one_mesh_that_does_not_help_is_not_the_end() {
        let of = |distances: &[f64]| -> Vec<Difference> {
            distances.iter().map(|&distance| Difference { distance, ratio: 1.5 }).collect()
        };
        let whip = of(&[0.1, 0.3, 0.2, 0.02]);
        assert!(stuck(&whip[..3]) && (1..=4).all(|meshes| !stuck_for_good(&whip[..meshes], false)));
        let chaos = of(&[0.4, 0.5, 0.45, 0.6, 0.5]);
        assert!(stuck_for_good(&chaos[..4], false) && !stuck_for_good(&chaos[..3], false));
        assert!(stuck_for_good(&chaos[..3], true) && !stuck_for_good(&whip[..2], true));
        // by chance one of them is near
        let chance = of(&[0.98, 0.24, 0.95, 0.04, 1.05]);
        assert!(stuck_for_good(&chance, false) && (1..=4).all(|meshes| !stuck_for_good(&chance[..meshes], false)));
    }

    /// *Source.* Series of known orders, and one that does not fall.
    #[test]
    fn series_that_fall_too_slowly_do_not_converge() {
        let series = |order: f64| -> Vec<Difference> {
            (0..3).map(|k| Difference { distance: 2f64.powf(-order * f64::from(k)), ratio: 2.0 }).collect()
        };
        for (order, falls) in [(0.0, false), (0.4, false), (0.6, true), (2.0, true)] {
            assert_eq!(converge(&series(order), 3, 1.0), falls, "{order}");
            assert!(converge(&series(order), 3, 1e3) && !converge(&series(order)[..2], 3, 1e3));
        }
    }

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
