//! The normal force over a step: the law of depth, with the loss of an impact in it.
//!
//! # Equation
//!
//! With d0 and d1 the depths that count when the step begins and ends, p the law of depth, W its
//! energy (law.rs), and `s = (d0 - d1)/h` the mean speed with which the surfaces part,
//!
//! ```text
//! N = p(d1) min(1, max(0, (u - s)/v))        v = 1 cm/s,  u the largest speed of separation
//! ```
//!
//! A contact that closes, or opens slowly, follows the law of depth; one that opens faster than u
//! does not push. So what the law has stored cannot throw a cable off faster than u, whatever its
//! stiffness and mass, and however many steps resolve the touch. u is at least v, and e times the
//! speed v0 of the first touch, e > 0 the coefficient of restitution. The step sees the mean speed,
//! but it is the speed at its end that is bound: with s0 that at the beginning and b of the one-leg
//! formula,
//!
//! ```text
//! s1 = s0 + (s - s0)/b <= u      so  s <= (1 - b) s0 + b u,   at least v and at most u
//! ```
//!
//! While the touch is resolved, `h v0 < 5/2 d*` with `W(d*) = rho v0^2/2` (`h omega < 5/2` of a law
//! of constant stiffness), the force is the secant `(W(d1) - W(d0))/(d1 - d0)` in place of `p(d1)`:
//! it loses nothing, so that the bound on s alone decides what is given back. It acts also in the
//! step that ends above the surface.
//!
//! # Without restitution
//!
//! A tenth of the speed at which the law would throw the cable off from the depth D, offset and
//! all, is what a contact without restitution may come up with; its force fades over all of it:
//!
//! ```text
//! u = sqrt(2 W(D)/rho)/10, at least v                N = p(d1) min(1, max(0, 1 - s/u))
//! ```
//!
//! Of two cables, and where contacts press a cable from both sides, it is no more than a tenth of
//! the speed vs with which what it stores came. vs is the largest mean speed with which the
//! surfaces came together in a step since they touched, and goes with the root of W(D) while that
//! falls. So `2 W/vs^2` is the mass per length that the contact carries, whatever bodies, cables
//! and stiffness make it up, found from what it took up. It counts from 10 cm/s on, and until it is
//! less than v: what is slower is pressed, or lies, and has the law of depth.
//!
//! Where p is k d it is a damper of the contact that opens, of five times the critical damping,
//! that does not pull: what fell to a depth comes up in some `10/omega`, and leaves with a tenth of
//! its speed. The whole depth counts, for what was born deep has an offset in place of energy: it
//! comes up as fast, so that it pushes while it does, and while it pushes losses go on to pay for
//! the offset that closes. With the depth that counts alone it would open at 1 cm/s.
//!
//! # Energy
//!
//! W is convex, so `p(d1) (d1 - d0) >= W(d1) - W(d0)`. N is `p(d1)`, or less where the contact
//! opens, and then takes less back: the loss `W(d0) - W(d1) + N (d1 - d0)` is at least 0 in every
//! step, for any u that the step does not change. An offset that closes by c in it costs `N c`, no
//! more than it does without the bound, and that is paid for as ever.
//!
//! # Validity
//!
//! Where a step does not resolve the touch the mean speed says little: what it leaves is bound when
//! it ends ([`impact`](super::impact)), to the same e. The two meet at `h v0 = 5/2 d*`: from there
//! on a touch ends within the step in which it begins or the next one. The mass rho is that of the
//! cable alone; beside a much lighter body it is less. A body that presses a cable down on what it
//! lies on is found by vs, unless that is another cable.
//!
//! A bounce at v reaches 5 um. A contact that is relieved comes up by its depth, some um, at v; one
//! that rests has `s = 0` and the law of depth. Without restitution a cable leaves with at most
//! 0.11 of its speed, 1 % of the height of its fall, and what lands on it likewise. Between cables
//! that is so where they come with 10 cm/s or more. Of a cable that bends, contact takes what is
//! stored in it, and not what bending stores.
//!
//! # References
//!
//! Hunt & Crossley, J. Appl. Mech. 42 (1975) 440 (a normal force that depends on the rate of
//! depth); Moreau, in Nonsmooth Mechanics and Applications, 1988 (the limit v -> 0: a maximal
//! monotone law of the speed of separation).
//!
//! # Alternatives considered
//!
//! docs/decisions/restitution.md: Hunt & Crossley's law itself, hysteresis in the depth, an impact
//! at the end of the step alone, and a bound that does not see the depth.

use super::law::{NormalLaw, Pressure};
use crate::scales::contact::{DEPTHS, RESOLVED, RISE, SECANT, SLOW};

/// What a contact may give back in a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Rebound {
    /// Largest mean speed of separation in m/s; infinite where the law is that of depth.
    pub limit: f64,
    /// Speed in m/s over which the force fades below it.
    pub fade: f64,
    /// Whether the force is the secant of the energy.
    pub elastic: bool,
}

impl Default for Rebound {
    fn default() -> Self {
        Rebound { limit: f64::INFINITY, fade: SLOW, elastic: false }
    }
}

/// Returns whether a step of length `h` (s) resolves the touch of a mass per length (kg/m) that
/// came with a speed (m/s).
pub(in crate::contact) fn is_resolved(law: &NormalLaw, h: f64, mass: f64, speed: f64) -> bool {
    h * speed < RESOLVED * law.depth_of_energy(0.5 * mass * speed * speed)
}

/// Returns the speed in m/s at which what the law stores at a depth (m) throws a mass per length
/// (kg/m).
pub(in crate::contact) fn thrown(law: &NormalLaw, mass: f64, depth: f64) -> f64 {
    (2.0 * law.at(depth).energy / mass).sqrt()
}

/// Returns the largest mean speed of separation in a step that ends with at most `fastest` and
/// begins with `opens` (m/s), in a formula with the coefficient b.
fn mean_limit(fastest: f64, opens: f64, b: f64) -> f64 {
    let fastest = fastest.max(SLOW);
    ((1.0 - b) * opens + b * fastest).clamp(SLOW, fastest)
}

impl Rebound {
    /// Returns what a contact gives back that came with a speed and of which restitution leaves
    /// `fastest`, if it opens with the speed `opens` when the step begins (m/s).
    pub fn new(fastest: f64, opens: f64, b: f64, elastic: bool) -> Self {
        Rebound { limit: mean_limit(fastest, opens, b), fade: SLOW, elastic }
    }

    /// Returns the same without restitution, of a contact that the law of its depth would throw off
    /// with a speed `thrown` (m/s).
    pub fn dead(thrown: f64, opens: f64, b: f64) -> Self {
        let limit = mean_limit(RISE * thrown, opens, b);
        Rebound { limit, fade: limit, elastic: false }
    }

    /// Returns whether it bounds the force of the law of depth.
    pub fn is_bound(&self) -> bool {
        self.limit.is_finite()
    }
}

/// The normal force as a function of the depth at the end of a step.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Push<'a> {
    pub law: &'a NormalLaw,
    pub rebound: Rebound,
    /// Depth in m when the step begins.
    pub start: f64,
    /// Length of the step in s.
    pub h: f64,
}

impl Push<'_> {
    /// Returns the share of the force that acts at a depth (m), and its derivative in 1/m.
    fn share(&self, depth: f64) -> (f64, f64) {
        let opens = (self.start - depth) / self.h;
        let share = (self.rebound.limit - opens) / self.rebound.fade;
        if share >= 1.0 {
            (1.0, 0.0)
        } else if share > 0.0 {
            (share, 1.0 / (self.rebound.fade * self.h))
        } else {
            (0.0, 0.0)
        }
    }

    /// Returns the force per length at a depth (m), its derivative, and the energy that is stored.
    pub fn at(&self, depth: f64) -> Pressure {
        let mut out = self.law.at(depth);
        if self.rebound.elastic && depth.max(self.start) > 0.0 {
            let (way, before) = (depth - self.start, self.law.at(self.start));
            // of a small way the difference of the energies is lost in rounding
            if way.abs() > SECANT * depth.abs() {
                let force = (out.energy - before.energy) / way;
                (out.force, out.slope) = (force, (out.force - force) / way);
            } else {
                (out.force, out.slope) = (0.5 * (out.force + before.force), 0.5 * out.slope);
            }
        }
        let (share, growth) = self.share(depth);
        if share < 1.0 {
            (out.force, out.slope) = (share * out.force, share * out.slope + growth * out.force);
        }
        out
    }

    /// Returns the depth at which the force per length is `force` > 0 (N/m).
    pub fn depth_of(&self, force: f64) -> f64 {
        let plain = self.law.depth_of(force);
        if !self.rebound.elastic && self.share(plain).0 >= 1.0 {
            return plain;
        }
        // the force grows with the depth
        let (mut low, mut high) = ((self.start - self.rebound.limit * self.h).min(0.0), plain.max(self.start));
        for _ in 0..DEPTHS {
            if self.at(high).force >= force {
                break;
            }
            (low, high) = (high, 2.0 * high.abs() + plain);
        }
        let mut depth = high;
        for _ in 0..DEPTHS {
            let at = self.at(depth);
            if (at.force - force).abs() <= 1e-13 * force {
                break;
            } else if at.force > force {
                high = depth;
            } else {
                low = depth;
            }
            let next = depth - (at.force - force) / at.slope;
            depth = if next >= low && next <= high { next } else { 0.5 * (low + high) };
        }
        depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slopes are the derivatives of forces, the depth of a force is the inverse, and no step makes
    /// energy, whichever way it goes.
    ///
    /// *Source.* Central differences; the definition of the loss.
    #[test]
    fn the_force_grows_with_depth_and_makes_no_energy() {
        let law = NormalLaw::new(1e9, 5e-3);
        for (elastic, is_dead) in [(false, false), (true, false), (false, true)] {
            for (h, limit) in [(1e-6, 0.01), (1e-5, 0.6), (1e-3, 0.01), (4e-3, 2.0)] {
                for start in [-3e-3, -1e-6, 0.0, 2e-6, 8e-5, 4e-4] {
                    let fade = if is_dead { limit } else { SLOW };
                    let rebound = Rebound { limit, fade, elastic };
                    let push = Push { law: &law, rebound, start, h };
                    let mut last = 0.0;
                    for k in 1..400 {
                        let depth = 2e-6 * f64::from(k) * 1.0007;
                        let at = push.at(depth);
                        let loss = law.at(start).energy - at.energy + at.force * (depth - start);
                        assert!(loss >= -1e-12 * at.energy.max(law.at(start).energy), "{elastic} {start} {depth}");
                        assert!(at.force >= last, "{elastic} {start} {depth}");
                        last = at.force;
                        let d = 1e-4 * depth;
                        let (low, high) = (push.at(depth - d), push.at(depth + d));
                        let corner = push.share(depth - d).1 != push.share(depth + d).1;
                        let smooth = !corner && (depth - start).abs() > 2.0 * d && (depth - 1e-4).abs() > 2.0 * d;
                        if smooth {
                            let slope = (high.force - low.force) / (2.0 * d);
                            assert!((slope - at.slope).abs() <= 1e-5 * at.slope + 1e-3, "{slope} {at:?}");
                        }
                        if at.force > 0.0 {
                            let found = push.at(push.depth_of(at.force)).force;
                            assert!((found / at.force - 1.0).abs() < 1e-9, "{elastic} {start} {depth}: {found} {at:?}");
                        }
                    }
                }
            }
        }
    }
}
