//! The force of a contact along the cable, where a sharp part of an obstacle is near.
//!
//! # Equation
//!
//! A sample of a cable that slides along itself over an edge comes into contact and leaves it again
//! within a few steps. The end-point derivative `p(d1)` of the law takes the energy
//! `W(d0) - W(d1) + p(d1) (d1 - d0)` from every one of them, which brakes the cable without
//! friction. So the motion s beside the obstacle is split by the mean unit tangent t of the cable,
//! and with it the depth:
//!
//! ```text
//! d1 = d0 + D_t + D_n,    D_t = -(gbar . t) (t . s)
//! f = p(d1) gbar + (p_t - p(d1)) (gbar . t) t,    p_t = (W(d0 + D_t) - W(d0))/D_t
//! ```
//!
//! Along the cable acts the secant of the energy over the way along the cable, across it the law of
//! the end.
//!
//! # Energy
//!
//! The contact loses `W(d0 + D_t) - W(d1) + p(d1) D_n`, at least zero since W is convex, and zero
//! where the cable moves along itself. The loss is linear in `p_t` and not negative for `p_t =
//! p(d1)` either, so neither is it between both: `p_t` is limited to the range of the pressures of
//! beginning and end, which a cable that lands beside its tangent would leave.
//!
//! # Validity
//!
//! Places that lie on the obstacle, `(gbar . t)^2 < 1/2`: an end that points at a face keeps the
//! law of the end, since the secant rings.
//!
//! # References
//!
//! Gonzalez, J. Nonlinear Sci. 6 (1996) 449 (the secant of an energy as its discrete gradient).

use super::law::NormalLaw;
use crate::element::shape;
use crate::scales::contact::{LIES, SECANT};
use nalgebra::Vector3;

/// The tangent of the cable at a contact.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Glide {
    /// Shape functions of the slope.
    pub slope: [f64; 4],
    /// Slope when the step begins.
    start: Vector3<f64>,
    /// Mean unit tangent at the iterate.
    tangent: Vector3<f64>,
}

/// What a contact does along the cable in a step, per length of it.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Along {
    /// What its force has more than the pressure along the mean normal, in N/m.
    pub force: Vector3<f64>,
    /// Work in J/m of that on the cable.
    pub work: f64,
}

impl Glide {
    /// At a place of an element of length `length` (m), where a vector of the cable is found from
    /// its shape functions.
    pub fn new(xi: f64, length: f64, at: impl Fn(&[f64; 4]) -> Vector3<f64>) -> Self {
        let slope = shape::slope(xi, length);
        let start = at(&slope);
        Glide { slope, start, tangent: start.try_normalize(0.0).unwrap_or_default() }
    }

    /// Follows an iterate that changes the slope.
    pub fn follow(&mut self, change: &Vector3<f64>) {
        self.tangent = (self.start + 0.5 * change).try_normalize(0.0).unwrap_or_default();
    }

    /// Returns what it does beside the mean normal `mean`, from the depth `start` (m) on, at a
    /// pressure (N/m) when the step ends; `slip` is the motion beside the obstacle.
    pub fn along(
        &self,
        law: &NormalLaw,
        (start, pressure): (f64, f64),
        mean: &Vector3<f64>,
        slip: &Vector3<f64>,
    ) -> Option<Along> {
        let across = mean.dot(&self.tangent);
        if across * across >= LIES {
            return None;
        }
        let way = self.tangent.dot(slip);
        let sinks = -across * way;
        let (before, after) = (law.at(start), law.at(start + sinks));
        let secant = if sinks.abs() > SECANT * start.abs().max((start + sinks).abs()) {
            (after.energy - before.energy) / sinks
        } else {
            0.5 * (before.force + after.force)
        };
        let [low, high] = [before.force.min(pressure), before.force.max(pressure)];
        let more = (secant.max(low).min(high) - pressure) * across;
        (more != 0.0).then(|| Along { force: self.tangent * more, work: more * way })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A contact loses no energy where the cable moves along itself, and never less than nothing
    /// where it moves otherwise.
    ///
    /// *Source.* The loss by its definition: what the law held, less what it holds and its work on
    /// the cable.
    #[test]
    fn a_cable_that_moves_along_itself_loses_nothing() {
        let law = NormalLaw::new(1e9, 5e-3);
        let (tangent, mean) = (Vector3::new(0.8, 0.6, 0.0), Vector3::new(-0.3, 1.0, 0.2).normalize());
        let mut glide = Glide::new(0.3, 0.1, |_| tangent * 0.9);
        let mut compared = 0;
        for start in [-3e-5, -1e-6, 0.0, 2e-6, 8e-5, 4e-4] {
            for along in [-2e-4, -1e-6, 0.0, 3e-7, 5e-5, 3e-3] {
                for across in [-1e-4, -2e-6, 0.0, 1e-6, 7e-5] {
                    glide.follow(&Vector3::new(0.1, -0.2, 0.05));
                    let slip = glide.tangent * along + Vector3::new(0.1, 1.0, -0.3) * across;
                    let end = start - mean.dot(&slip);
                    let (before, after) = (law.at(start), law.at(end));
                    let more = glide.along(&law, (start, after.force), &mean, &slip);
                    let work = after.force * mean.dot(&slip) + more.map_or(0.0, |more| more.force.dot(&slip));
                    assert!(
                        more.is_none_or(|more| (more.work - more.force.dot(&slip)).abs() <= 1e-12 * more.work.abs())
                    );
                    let loss = before.energy - after.energy - work;
                    let scale = 1e-12 * (before.energy + after.energy + work.abs());
                    assert!(loss >= -scale, "{start} {along} {across}: {loss:e}");
                    if across == 0.0 {
                        assert!(loss <= scale, "{start} {along}: {loss:e}");
                        compared += usize::from(before.energy != after.energy);
                    }
                }
            }
        }
        assert!(compared > 10, "{compared}");
    }

    /// One that points at the obstacle keeps the law of the end.
    ///
    /// *Source.* The definition.
    #[test]
    fn an_end_that_points_at_a_face_keeps_the_law_of_the_end() {
        let law = NormalLaw::new(1e9, 5e-3);
        let glide = Glide::new(1.0, 0.1, |_| Vector3::y());
        assert!(glide.along(&law, (1e-5, 3.0), &Vector3::y(), &Vector3::new(0.0, -1e-4, 0.0)).is_none());
    }
}
