//! What friction leaves open of a shape at rest.
//!
//! # Equation
//!
//! Friction of at most mu times the pressure acts along the cable, and a tension that it adds
//! presses the cable on what it bends around. From contact to contact along the cable, with the
//! normal force F and the angle theta by which it turns there,
//!
//! ```text
//! D' = D exp(mu theta) + mu F
//! ```
//!
//! is the largest change of the tension that friction could hold: mu times the weight that lies on
//! a plane, and `T (exp(mu theta) - 1)` around a drum that a tension T presses it on.
//!
//! # Validity
//!
//! The shape that was found without friction. A state at rest with friction has another one, and
//! its tensions lie within this bound to the first order in what it moves. Contacts of cables with
//! each other are not counted.
//!
//! # References
//!
//! Euler 1769, Eytelwein 1808 (the capstan).

use super::Cable;

impl Cable {
    /// Returns the largest difference of tensions in N along the cable that the friction of what it
    /// rests on could hold; 0 without contact, or where nothing has friction.
    /// [Equilibria](Self::equilibrium) are found without friction: their tensions may be off by as
    /// much.
    pub fn friction_bound(&self) -> f64 {
        let friction = |key: u64| self.obstacles().iter().find(|o| o.key == key).map_or(0.0, |o| o.friction);
        let mut touches: Vec<[f64; 3]> =
            self.contacts().map(|touch| [touch.arc_length, friction(touch.obstacle), touch.normal_force]).collect();
        touches.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let (mut bound, mut last) = (0.0, None);
        for [at, friction, force] in touches {
            // the angle between this contact and the last one, if it is on the same piece
            let element = self.elements()[self.model.locate(at).0].length;
            let way = last.map_or(0.0, |last: f64| (at - last).min(element));
            let curvature = self.sample(at).map_or(0.0, |sample| sample.curvature.norm());
            bound = bound * (friction * curvature * way).exp() + friction * force;
            last = Some(at);
        }
        bound
    }
}
