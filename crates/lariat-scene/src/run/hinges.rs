//! Kinks of cables that are too stiff for them.
//!
//! # Equation
//!
//! A cable of stiffness EI under a tension T that turns by an angle theta at a point bends there within `b = sqrt(EI/T)`, and the point is
//! `b sin(theta/2)` nearer to the inside of the corner than where both sides would meet without stiffness. A kink, which is a hinge, leaves
//! that out.
//!
//! # Validity
//!
//! An upper estimate, by about 3 on the cable of tests/kinks.rs, and for elements that are longer than b; shorter ones are bent by what the
//! hinge does not hold.

use super::World;
use crate::scene::kinks::Kink;
use crate::warning::Warning;

/// Share of the length of a cable by which a point may be off without a warning, as in those of lariat-ancf.
const SHARE: f64 = 2e-3;

/// A kink, and where it was off most: length within which the cable bends and estimate of the error in m, and the time in s.
pub(super) struct Hinge {
    kink: Kink,
    worst: [f64; 3],
}

impl Hinge {
    /// Returns those of a world.
    pub fn all(world: &World) -> Vec<Self> {
        world.scene.kinks.iter().map(|kink| Hinge { kink: *kink, worst: [0.0; 3] }).collect()
    }

    /// Reads both sides at a host time.
    pub fn note(&mut self, world: &World) {
        let cables = world.cables();
        let [before, behind] = self.kink;
        let stiffness = world.scene.cables[behind].sections.first().bending_stiffness;
        let order = &world.order[world.scene.whole(behind)];
        // after a break the part before it is another
        let place = order.iter().position(|&part| part == behind).and_then(|k| k.checked_sub(1));
        let before = place.map_or(before, |k| order[k]);
        let sides = [(before, cables[before].length()), (behind, 0.0)];
        let [Ok(a), Ok(b)] = sides.map(|(part, s)| cables[part].sample(s)) else { return };
        let tension = a.tension.min(b.tension);
        if stiffness == 0.0 || tension <= 0.0 {
            return;
        }
        let layer = (stiffness / tension).sqrt();
        let off = layer * (0.5 * a.slope.angle(&b.slope)).sin();
        if off > self.worst[1] {
            self.worst = [layer, off, world.time()];
        }
    }

    /// Returns the warning, if the error was too large.
    pub fn warning(&self, world: &World) -> Option<Warning> {
        let [layer_m, error_m, time_s] = self.worst;
        let cable = world.scene.whole(self.kink[0]);
        let at_m = world.scene.along(self.kink[1], 0.0);
        let cable_name = world.scene.cables[cable].name.clone();
        let length = world.scene.whole_length(cable);
        (error_m > SHARE * length).then(|| Warning::StiffKink {
            cable: cable_name,
            at_m,
            time_s,
            layer_m,
            error_m,
            mesh: mesh(
                world.scene.parts[cable].iter().map(|&part| world.scene.cables[part].elements).sum(),
                length,
                at_m,
                layer_m,
            ),
        })
    }
}

/// Returns the value of `elements` of an even mesh of a cable of a length in m that is fine at an arc length: elements of
/// `2 sqrt(EI/T)` there, and as many more as grow from them by a ratio of 2.
fn mesh(even: usize, length: f64, at: f64, layer: f64) -> String {
    let finest = 2.0 * layer;
    let doublings = (length / (even as f64 * finest)).log2().ceil().max(0.0);
    let count = even + 2 * doublings as usize;
    // an even mesh of as many is as fine
    if finest * count as f64 >= length {
        return count.to_string();
    }
    format!("{{ count = {count}, finest = {finest:.2e}, at = [{at:.4}] }}")
}
