//! Obstacles: surfaces and how they move.

use super::rigid_motion::{Mount, RigidMotion};
use super::surface::Surface;
use crate::error::{Error, require, require_finite};
use crate::scales::integrate::ALPHA;
use nalgebra::{UnitQuaternion, Vector3};
use std::sync::Arc;

/// Coefficient: largest coefficient of restitution with which the discrete gradient makes no
/// energy.
pub const LARGEST_RESTITUTION: f64 = (1.0 - ALPHA) / (1.0 + ALPHA);

/// Something that a cable can touch: fixed, moving as prescribed, or carried by a body that the
/// cable moves in turn.
#[derive(Clone, Debug)]
pub struct Obstacle {
    /// Its number, by which contacts remember it from step to step; no two of a cable may share
    /// one.
    pub key: u64,
    /// Its shape.
    pub surface: Arc<dyn Surface>,
    /// Its motion; of one that a body carries only where it is now.
    pub motion: RigidMotion,
    /// The body of the island that carries it. Default: none, its motion is prescribed.
    pub mount: Option<Mount>,
    /// Coefficient of friction between it and the cable, >= 0.
    pub friction: f64,
    /// Newton's coefficient of restitution between it and the cable, from 0 to
    /// [`LARGEST_RESTITUTION`]: the share of the velocity with which the cable comes that it leaves
    /// with. Default: 0.
    pub restitution: f64,
    /// Distance in m that the cable keeps from it, >= 0.
    pub skin: f64,
    /// Pieces of the cable, by their arc lengths in m, that do not touch it: where it holds the
    /// cable. Default: none.
    pub except: Vec<[f64; 2]>,
}

impl Obstacle {
    /// Creates an obstacle at rest, without skin.
    pub fn new(key: u64, surface: impl Surface + 'static, position: impl Into<Vector3<f64>>, friction: f64) -> Self {
        let motion = RigidMotion::at(position);
        let (surface, except) = (Arc::new(surface), Vec::new());
        Obstacle { key, surface, motion, mount: None, friction, restitution: 0.0, skin: 0.0, except }
    }

    /// Returns it with a motion.
    pub fn moving(self, motion: RigidMotion) -> Self {
        Obstacle { motion, ..self }
    }

    /// Returns it with a coefficient of restitution.
    pub fn with_restitution(self, restitution: f64) -> Self {
        Obstacle { restitution, ..self }
    }

    /// Returns it carried by a body of the island, which is where the obstacle should be on it. The
    /// cable then steps only in an [`Island`](crate::island::Island) with that body.
    pub fn on(self, mount: Mount) -> Self {
        Obstacle { mount: Some(mount), ..self }
    }

    /// Returns the key and the distance in m if it is elsewhere at a time (s) than its predecessor
    /// among those before, by ascending key, and is said to be at rest.
    pub(crate) fn posed(&self, before: &[Obstacle], time: f64) -> Option<(u64, f64)> {
        let RigidMotion { velocity, angular_velocity, .. } = &self.motion;
        let rests = self.mount.is_none() && *velocity == Vector3::zeros() && *angular_velocity == Vector3::zeros();
        let old = before.binary_search_by_key(&self.key, |old| old.key).ok().filter(|_| rests)?;
        let old = &before[old].motion;
        if old.position == self.motion.position && old.velocity == Vector3::zeros() {
            return None;
        }
        let distance = (self.motion.pose(time).position - old.pose(time).position).norm();
        (distance > 0.0).then_some((self.key, distance))
    }

    /// Returns whether a piece at an arc length (m) does not touch it.
    pub(crate) fn excepts(&self, arc_length: f64) -> bool {
        self.except.iter().any(|[from, to]| (*from..=*to).contains(&arc_length))
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        require("friction of an obstacle", self.friction, self.friction >= 0.0, ">= 0")?;
        let restitution = self.restitution;
        require(
            "restitution of an obstacle",
            restitution,
            (0.0..=LARGEST_RESTITUTION).contains(&restitution),
            "from 0 to 15/17",
        )?;
        require("skin of an obstacle (m)", self.skin, self.skin >= 0.0, ">= 0")?;
        let RigidMotion { start, centre, position, rotation, velocity, angular_velocity } = &self.motion;
        require("start of an obstacle's motion (s)", *start, true, "a number")?;
        require_finite("centre of an obstacle's motion (m)", centre)?;
        require_finite("position of an obstacle (m)", position)?;
        require_finite("velocity of an obstacle (m/s)", velocity)?;
        require_finite("angular velocity of an obstacle (rad/s)", angular_velocity)?;
        let unit = |rotation: &UnitQuaternion<f64>| {
            let norm = rotation.as_ref().norm();
            require("length of an obstacle's quaternion", norm, (norm - 1.0).abs() < 1e-6, "1")
        };
        unit(rotation)?;
        if let Some(Mount { position, rotation, .. }) = &self.mount {
            require_finite("position of an obstacle on its body (m)", position)?;
            unit(rotation)?;
        }
        let numbers = self.except.iter().flatten();
        numbers.into_iter().try_for_each(|s| require("arc length that touches nothing (m)", *s, true, "a number"))
    }
}

/// The obstacles of a cable, by ascending key. They are no part of a serialised cable.
#[derive(Clone, Debug, Default)]
pub(crate) struct Obstacles(pub Vec<Obstacle>);

impl Obstacles {
    /// Checks that a step has the bodies that carry obstacles of a cable.
    pub fn check_bodies(&self, cable: &str, bodies: usize) -> Result<(), Error> {
        let missing = self.0.iter().find_map(|o| o.mount.filter(|mount| mount.body >= bodies).map(|m| (o.key, m.body)));
        match missing {
            Some((key, body)) => Err(Error::ObstacleBody { cable: cable.to_string(), key, body, bodies }),
            None => Ok(()),
        }
    }
}

impl PartialEq for Obstacles {
    fn eq(&self, other: &Self) -> bool {
        self.0.len() == other.0.len()
            && self.0.iter().zip(&other.0).all(|(a, b)| {
                a.key == b.key
                    && Arc::ptr_eq(&a.surface, &b.surface)
                    && (a.motion, a.mount, a.friction, a.skin) == (b.motion, b.mount, b.friction, b.skin)
                    && (a.restitution, &a.except) == (b.restitution, &b.except)
            })
    }
}
