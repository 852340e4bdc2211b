//! Parts of cables that turn at a wheel: the points where they leave it stay on its body, and are off by radius times angle.

use super::World;
use crate::warning::Warning;
use lariat_ancf::Vector3;

/// Share of the length of a part by which the point where it leaves the wheel may be off without a warning.
const SHARE: f64 = 1e-3;

/// The parts of a cable at a wheel with a radius.
pub(super) struct WheelWatch {
    sheave: usize,
    /// Directions of both parts there at the start, in the axes of the body.
    start: Option<[Vector3<f64>; 2]>,
    /// Angle in rad, time in s and length of the part in m where the share of the error was largest.
    worst: Option<[f64; 3]>,
}

impl WheelWatch {
    /// Returns those of a world.
    pub fn all(world: &World) -> Vec<Self> {
        let wheels = world.scene.sheaves.iter().enumerate().filter(|(_, sheave)| sheave.radius > 0.0);
        wheels.map(|(sheave, _)| WheelWatch { sheave, start: None, worst: None }).collect()
    }

    /// Reads the directions at a host time.
    pub fn note(&mut self, world: &World) {
        let sheave = &world.scene.sheaves[self.sheave];
        let Some(behind) = world.owners.get(sheave.cables[1]).map(|_| sheave.cables[1]) else { return };
        let order = &world.order[world.scene.whole(behind)];
        // after a break the part before it is another
        let place = order.iter().position(|&part| part == behind).and_then(|k| k.checked_sub(1));
        let Some(before) = place.map(|k| order[k]) else { return };
        let cables = world.cables();
        let body =
            world.scene.attachments.iter().find(|a| a.cable == behind && a.arc_length == 0.0).and_then(|a| a.body);
        let turn = body.and_then(|body| world.body(body)).map(|state| state.rotation.inverse());
        let ends = [(before, cables[before].length()), (behind, 0.0)];
        let direction = |(part, s): (usize, f64)| {
            let slope = cables[part].sample(s).ok()?.slope.try_normalize(0.0)?;
            Some(turn.map_or(slope, |turn| turn * slope))
        };
        let [Some(a), Some(b)] = ends.map(direction) else { return };
        let start = *self.start.get_or_insert([a, b]);
        for (k, now) in [a, b].into_iter().enumerate() {
            let (angle, length) = (start[k].angle(&now), cables[ends[k].0].length());
            if angle / length > self.worst.map_or(0.0, |[angle, _, length]| angle / length) {
                self.worst = Some([angle, world.time(), length]);
            }
        }
    }

    /// Returns the warning, if the error was too large.
    pub fn warning(&self, world: &World) -> Option<Warning> {
        let sheave = &world.scene.sheaves[self.sheave];
        let [angle_rad, time_s, part_m] = self.worst?;
        let error_m = sheave.radius * angle_rad;
        let sheave = sheave.name.clone();
        (error_m > SHARE * part_m).then_some(Warning::WheelTurned { sheave, angle_rad, time_s, error_m, part_m })
    }
}
