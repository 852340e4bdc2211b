//! The tension at an eye that goes with a pull of the winch.
//!
//! # Equation
//!
//! ```text
//! T f - u = P        T(f), u(f) the axial law and its energy per length, f the stretch at the eye
//! Green    EA (eps + 3/2 eps^2) = P        d(T f - u)/df = f dT/df >= 0
//! ```
//!
//! # Validity
//!
//! A stretch above 1/4. The moment at the eye is that of the rest shape: a cable of natural
//! curvature that a clamp holds straight there reads too little by `EI kappa_0^2/2`, the energy
//! that it takes from the winch to be bent. A rope that is slack has no tension, whatever its
//! stretch. Internal damping counts as a part of the law.

use crate::effect::acts::Single;
use crate::effect::tables::ElementTables;
use crate::element::kernel::DiscreteGradientForce;
use crate::scales::effect::CRUMPLED;
use crate::system::System;

impl System {
    /// Returns the tension over EA at the eye that element `e` is at, by the pull over EA along the
    /// cable there.
    pub(crate) fn tension_of_pull(&self, e: usize, pull: f64) -> f64 {
        let strain = ((1.0 + 6.0 * pull).max(0.0).sqrt() - 1.0) / 3.0;
        let by_green = strain * (1.0 + 2.0 * strain).max(0.0).sqrt();
        let Some(effects) = &self.forces.in_element else { return by_green };
        let law = |square: f64| Law::of(effects, e, square);
        let found = law(1.0 + 2.0 * strain);
        if found.is_green {
            return by_green;
        }
        let mut stretch = [CRUMPLED.sqrt(), 1.0];
        while law(stretch[1] * stretch[1]).pull < pull && stretch[1].is_finite() {
            stretch = [stretch[1], 2.0 * stretch[1]];
        }
        // until halves are none
        loop {
            let middle = 0.5 * (stretch[0] + stretch[1]);
            let at = law(middle * middle);
            if middle <= stretch[0] || middle >= stretch[1] {
                return at.tension;
            }
            stretch[usize::from(at.pull >= pull)] = middle;
        }
    }
}

/// An axial law at a stretch: tension and `T f - u`, over EA.
struct Law {
    tension: f64,
    pull: f64,
    /// Whether the effects leave the Green law as it is.
    is_green: bool,
}

impl Law {
    fn of(effects: &ElementTables, e: usize, square: f64) -> Self {
        let [mut missing, mut energy] = [0.0; 2];
        effects.add_rest_strain(square, &Single(e), &mut missing);
        effects.add_rest_energy(square, &Single(e), &mut energy);
        let (green, stretch) = (square - 1.0, square.max(CRUMPLED).sqrt());
        let tension = 0.5 * (green - missing) * stretch;
        Law {
            tension,
            pull: tension * stretch - (0.125 * green * green + energy),
            is_green: missing == 0.0 && energy == 0.0,
        }
    }
}
