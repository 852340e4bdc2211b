//! A straight cable under compression does not stand: it is given the bend that rounding would.
//!
//! # Equation
//!
//! A straight line is in equilibrium under any compression, in exact arithmetic for ever. Beyond
//! the Euler load it is unstable, and what grows from is whatever bends it. A cable that is
//! straight to less than that, and whose mean compression is more than a free span of its whole
//! length with one free end could bear,
//!
//! ```text
//! N = -(1/L) sum_e EA eps_e l_e > pi^2 EI/(2 L)^2        r_i += a sum_(k = 1..8) sin(k pi s_i/L)/8 n        a = 2^-23 L
//! ```
//!
//! is bent by `a`, which is the rounding of positions in single precision, in which hosts have
//! them. The slopes are bent with it. What is held stays. n is normal to the cable: along x or y,
//! the one that is less along the cable.
//!
//! # Validity
//!
//! Below the load of its own supports a bent cable straightens again, so the bend does nothing, and
//! is not made again until the compression is a quarter more, or the cable was under tension. It
//! changes the energy by less than `2e-12 N L`. It is looked for when a step begins; a cable that
//! is bent is left after its first elements. The mean is that of a half wave over the whole cable;
//! waves of compression that run along a taut cable, whose mean is tension, do not bend it.
//!
//! # References
//!
//! Euler 1744; Timoshenko & Gere 1961, section 2.1.
//!
//! # Alternatives considered
//!
//! A law that cannot push ([`AxialLaw::Rope`](crate::AxialLaw::Rope)): it is there, for cables that
//! the user calls ropes; rods push. A larger bend: it would make or take energy that is seen.

use super::Cable;
use crate::scales::cable::{BEND, BENT_AGAIN, COMPRESSED, UNBENT, WAVES};
use crate::support::SlopeSupport;
use nalgebra::Vector3;
use std::f64::consts::PI;

/// A straight cable under compression.
pub(crate) struct Strut {
    along: Vector3<f64>,
    /// Mean shortening over its length.
    strain: f64,
}

impl Cable {
    /// Bends a straight cable under compression.
    pub(crate) fn bend_strut(&mut self, strut: &Strut) {
        self.snapshot.state.memory.bent_at = strut.strain;
        let along = &strut.along;
        let axis = if along.x.abs() <= along.y.abs() { Vector3::x() } else { Vector3::y() };
        let normal = (axis - along * along.dot(&axis)).normalize();
        let length = self.length();
        let size = BEND * length / WAVES as f64;
        let mut from = 0.0;
        for node in 0..self.nodes() {
            let support = self.model.support(node).copied().unwrap_or_default();
            let waves = (1..=WAVES).map(|k| k as f64 * PI / length);
            let (bend, slope) =
                waves.fold((0.0, 0.0), |(bend, slope), k| (bend + (k * from).sin(), slope + k * (k * from).cos()));
            let q = &mut self.snapshot.state.q[6 * node..6 * node + 6];
            if !support.holds_position() {
                (0..3).for_each(|i| q[i] += size * bend * normal[i]);
            }
            if support.slope == SlopeSupport::Free {
                (0..3).for_each(|i| q[3 + i] += size * slope * normal[i]);
            }
            from += self.model.elements.get(node).map_or(0.0, |element| element.length);
        }
    }

    /// Returns a cable that is straight, in the mean compressed beyond its Euler load, and was not
    /// bent under such a load before.
    pub(crate) fn loaded_strut(&mut self) -> Option<Strut> {
        let q = &self.snapshot.state.q;
        let part = |at: usize| Vector3::from_column_slice(&q[at..at + 3]);
        let first = part(0);
        let along = (part(6) - first).try_normalize(0.0)?;
        let length = self.length();
        let off = |x: Vector3<f64>| x - along * along.dot(&x);
        let least = UNBENT * BEND;
        // integrals along the cable: compression, shortening, and bending stiffness
        let (mut pushed, mut shorter, mut bears) = (0.0, 0.0, 0.0);
        let mut before = first;
        for (e, element) in self.model.elements.iter().enumerate() {
            let (position, slope) = (part(6 * e + 6), part(6 * e + 9));
            if off(position - first).amax() > least * length || off(slope).amax() > least {
                return None;
            }
            let strain = (position - before).norm() / element.length - 1.0;
            let section = &element.section;
            shorter -= strain * element.length;
            pushed -= strain * element.length * section.axial_stiffness;
            bears += section.bending_stiffness * element.length;
            before = position;
        }
        let strain = shorter / length;
        if strain < 0.0 {
            self.snapshot.state.memory.bent_at = 0.0;
        }
        (strain > COMPRESSED.max(BENT_AGAIN * self.snapshot.state.memory.bent_at)
            && pushed > (PI / (2.0 * length)).powi(2) * bears
            && off(part(3)).amax() <= least)
            .then_some(Strut { along, strain })
    }
}
