//! The load of water at rest on a body, as statics ask for it.

use super::member::{Input, Member};
use crate::scales::water::SMALL_ANGLE;
use ::nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};
use lariat_ancf::island::{LoadThere, PlacedLoad};
use lariat_ancf::{Sea, Water};

/// Water without its wave, at a time, and a body in it.
#[derive(Clone, Debug)]
pub(crate) struct StillWater {
    pub(super) member: Member,
    pub(super) water: Water,
    pub(super) sea: Option<Sea>,
    pub(super) gravity: Vector3<f64>,
    pub(super) time: f64,
    /// Centre of mass in the axes of the body, in m, and its gravity scale.
    pub(super) centre: Vector3<f64>,
    pub(super) scale: f64,
}

impl PlacedLoad for StillWater {
    fn at(&self, position: &Vector3<f64>, rotation: &UnitQuaternion<f64>) -> LoadThere {
        let StillWater { water, sea, gravity, time, .. } = self;
        let input = Input { water, sea: sea.as_ref(), gravity: *gravity, time: *time, h: 0.0, lead: 0.0 };
        self.member.still(&input, (&self.centre, self.scale), (position, rotation))
    }

    fn stiffness(&self, position: &Vector3<f64>, rotation: &UnitQuaternion<f64>) -> Matrix6<f64> {
        let load = |way: &Vector6<f64>| {
            let turn = UnitQuaternion::from_scaled_axis(way.fixed_rows::<3>(3).into_owned());
            let LoadThere { force, moment, .. } = self.at(&(position + way.fixed_rows::<3>(0)), &(turn * rotation));
            Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
        };
        let mut stiffness = Matrix6::zeros();
        for axis in 0..6 {
            let size = if axis < 3 { SMALL_ANGLE * self.member.radius() } else { SMALL_ANGLE };
            let way = Vector6::ith(axis, size);
            stiffness.set_column(axis, &((load(&-way) - load(&way)) / (2.0 * size)));
        }
        stiffness
    }

    fn driven_by(&self, share: f64) -> Option<Box<dyn PlacedLoad>> {
        let mut slower = self.clone();
        slower.water.flow.velocity *= share;
        Some(Box::new(slower))
    }
}
