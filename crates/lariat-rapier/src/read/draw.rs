//! Drawing of cables through Rapier's debug renderer, coloured by tension, and of the forces of
//! their contacts.

use crate::convert::to_vector;
use crate::scales::read::{DRAWN_LINES, FORCE_LENGTH};
use ::nalgebra::Vector3;
use lariat_ancf::Cable;
use rapier::dynamics::{RigidBodyBuilder, RigidBodyHandle};
use rapier::pipeline::{DebugColor, DebugRenderBackend, DebugRenderObject};

/// How cables are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawStyle {
    /// Lines per element. Default 4.
    pub lines: u32,
    /// Tension in N that is drawn red; zero tension is drawn blue. Default: the largest tension.
    pub red: Option<f64>,
    /// Length in m of the green line of a contact force of 1 N; 0 draws none. Default 5e-3.
    pub force_length: f64,
}

impl Default for DrawStyle {
    fn default() -> Self {
        DrawStyle { lines: DRAWN_LINES, red: None, force_length: FORCE_LENGTH }
    }
}

/// Draws cables as lines of a body with an invalid handle, which a filter of the renderer may
/// reject.
pub(crate) fn draw<'a>(
    cables: impl Iterator<Item = &'a Cable>,
    backend: &mut impl DebugRenderBackend,
    style: &DrawStyle,
) {
    let stand_in = RigidBodyBuilder::fixed().build();
    let object = DebugRenderObject::RigidBody(RigidBodyHandle::invalid(), &stand_in);
    if !backend.filter_object(object) {
        return;
    }
    let samples = |cable: &Cable| -> Vec<(Vector3<f64>, f64)> {
        let count = cable.elements().len() * style.lines.max(1) as usize;
        let arc_length = |k: usize| cable.length() * k as f64 / count as f64;
        (0..=count).filter_map(|k| cable.sample(arc_length(k)).ok()).map(|s| (s.position, s.tension)).collect()
    };
    let mut all = Vec::new();
    for cable in cables {
        all.push(samples(cable));
        let touches =
            cable.contacts().map(|touch| (touch.arc_length, touch.normal * touch.normal_force + touch.friction));
        let among =
            cable.cable_contacts().map(|touch| (touch.arc_length, touch.normal * touch.normal_force + touch.friction));
        for (arc_length, force) in touches.chain(among).filter(|_| style.force_length > 0.0) {
            let Ok(sample) = cable.sample(arc_length) else { continue };
            let force = force * style.force_length;
            let (from, to) = (to_vector(&sample.position), to_vector(&(sample.position + force)));
            backend.draw_line(object, from, to, CONTACT);
        }
    }
    let largest = || all.iter().flatten().map(|(_, tension)| *tension).fold(0.0, f64::max);
    let red = style.red.unwrap_or_else(largest).max(f64::MIN_POSITIVE);
    for ends in all.iter().flat_map(|cable| cable.windows(2)) {
        let share = (0.5 * (ends[0].1 + ends[1].1) / red).clamp(0.0, 1.0);
        backend.draw_line(object, to_vector(&ends[0].0), to_vector(&ends[1].0), colour(share));
    }
}

/// Colour of contact forces: green.
const CONTACT: DebugColor = [120.0, 1.0, 0.4, 1.0];

/// Returns hue, saturation, lightness and alpha: blue for 0, red for 1.
fn colour(share: f64) -> DebugColor {
    [240.0 * (1.0 - share as f32), 1.0, 0.5, 1.0]
}
