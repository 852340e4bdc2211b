//! Obstacles: surfaces and how they move.

use super::surface::Surface;
use crate::cable::Cable;
use crate::error::{Error, require, require_finite};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A motion of a rigid body: one of its points moves uniformly, about which it turns uniformly.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RigidMotion {
    /// Time in s at which it has the pose below.
    pub start: f64,
    /// The point that moves uniformly, in the body's axes, in m. Default: their origin.
    pub centre: Vector3<f64>,
    /// Its position in m.
    pub position: Vector3<f64>,
    /// Rotation from the body's axes to the world's.
    pub rotation: UnitQuaternion<f64>,
    /// Velocity of that point in m/s.
    pub velocity: Vector3<f64>,
    /// Angular velocity in rad/s, world axes.
    pub angular_velocity: Vector3<f64>,
}

impl Default for RigidMotion {
    /// At rest at the origin.
    fn default() -> Self {
        RigidMotion {
            start: 0.0,
            centre: Vector3::zeros(),
            position: Vector3::zeros(),
            rotation: UnitQuaternion::identity(),
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
        }
    }
}

impl RigidMotion {
    /// Returns rest at a position (m), with the world's axes.
    pub fn at(position: impl Into<Vector3<f64>>) -> Self {
        RigidMotion { position: position.into(), ..Self::default() }
    }

    fn pose(&self, time: f64) -> Pose {
        let t = time - self.start;
        let turned = if self.angular_velocity == Vector3::zeros() {
            self.rotation
        } else {
            UnitQuaternion::new(self.angular_velocity * t) * self.rotation
        };
        let rotation = *turned.to_rotation_matrix().matrix();
        Pose { position: self.position + self.velocity * t - rotation * self.centre, rotation }
    }
}

/// Something that a cable can touch, but does not move: fixed, or moving as prescribed.
#[derive(Clone, Debug)]
pub struct Obstacle {
    /// Its number, by which contacts remember it from step to step; no two of a cable may share one.
    pub key: u64,
    /// Its shape.
    pub surface: Arc<dyn Surface>,
    /// Its motion.
    pub motion: RigidMotion,
    /// Coefficient of friction between it and the cable, >= 0.
    pub friction: f64,
    /// Distance in m that the cable keeps from it, >= 0.
    pub skin: f64,
}

impl Obstacle {
    /// Creates an obstacle at rest, without skin.
    pub fn new(key: u64, surface: impl Surface + 'static, position: impl Into<Vector3<f64>>, friction: f64) -> Self {
        Obstacle { key, surface: Arc::new(surface), motion: RigidMotion::at(position), friction, skin: 0.0 }
    }

    /// Returns it with a motion.
    pub fn moving(self, motion: RigidMotion) -> Self {
        Obstacle { motion, ..self }
    }

    fn check(&self) -> Result<(), Error> {
        require("friction of an obstacle", self.friction, self.friction >= 0.0, ">= 0")?;
        require("skin of an obstacle (m)", self.skin, self.skin >= 0.0, ">= 0")?;
        let RigidMotion { start, centre, position, rotation, velocity, angular_velocity } = &self.motion;
        require("start of an obstacle's motion (s)", *start, true, "a number")?;
        require_finite("centre of an obstacle's motion (m)", centre)?;
        require_finite("position of an obstacle (m)", position)?;
        require_finite("velocity of an obstacle (m/s)", velocity)?;
        require_finite("angular velocity of an obstacle (rad/s)", angular_velocity)?;
        let norm = rotation.as_ref().norm();
        require("length of an obstacle's quaternion", norm, (norm - 1.0).abs() < 1e-6, "1")
    }
}

/// The obstacles of a cable, by ascending key. They are no part of a serialised cable.
#[derive(Clone, Debug, Default)]
pub(crate) struct Obstacles(pub Vec<Obstacle>);

impl PartialEq for Obstacles {
    fn eq(&self, other: &Self) -> bool {
        self.0.len() == other.0.len()
            && self.0.iter().zip(&other.0).all(|(a, b)| {
                a.key == b.key
                    && Arc::ptr_eq(&a.surface, &b.surface)
                    && a.motion == b.motion
                    && (a.friction, a.skin) == (b.friction, b.skin)
            })
    }
}

impl Cable {
    /// Returns the obstacles, by ascending key.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.model.obstacles.0
    }

    /// Sets what the cable can touch from the next step on, in place of the obstacles it had; it touches them if it has the effect
    /// [`Contact`](crate::Contact). Cheap enough for every step, and allocates only for more obstacles than ever before. Obstacles are no part of a
    /// snapshot or of a serialised cable, whose contacts know them by their keys.
    ///
    /// # Errors
    /// [`Error::InvalidValue`] for a number out of range, [`Error::ObstacleKey`] for a key that two share; the obstacles are then as before.
    pub fn set_obstacles(&mut self, obstacles: impl IntoIterator<Item = Obstacle>) -> Result<(), Error> {
        let own = &mut self.model.obstacles.0;
        let before = own.len();
        own.extend(obstacles);
        own[before..].sort_unstable_by_key(|obstacle| obstacle.key);
        let twice = own[before..].windows(2).find(|pair| pair[0].key == pair[1].key).map(|pair| pair[0].key);
        let checked = own[before..].iter().try_for_each(Obstacle::check);
        let outcome = match twice {
            Some(key) => Err(Error::ObstacleKey { cable: self.model.name.clone(), key }),
            None => checked.map_err(|e| e.of_cable(&self.model.name)),
        };
        let own = &mut self.model.obstacles.0;
        match outcome {
            Ok(()) => drop(own.drain(..before)),
            Err(_) => own.truncate(before),
        }
        outcome
    }
}

/// Place and axes at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub position: Vector3<f64>,
    pub rotation: Matrix3<f64>,
}

impl Pose {
    /// Returns a point of the world in the body's axes.
    pub fn own(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(x - self.position))
    }
}

/// The motion of an obstacle over a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObstacleStep {
    pub start: Pose,
    pub end: Pose,
    /// Axes half way.
    pub middle: Matrix3<f64>,
    /// Displacement of the origin over the step.
    shift: Vector3<f64>,
    /// Whether the axes turn.
    pub turns: bool,
    /// Whether it moves at all.
    pub moves: bool,
    /// Direction of the angular velocity.
    pub axis: Vector3<f64>,
    velocity: Vector3<f64>,
    angular_velocity: Vector3<f64>,
}

impl ObstacleStep {
    /// Over a step of length `h` (s) from a time (s) on.
    pub fn new(motion: &RigidMotion, time: f64, h: f64) -> Self {
        let turns = motion.angular_velocity != Vector3::zeros();
        let start = motion.pose(time);
        let (end, middle) = if turns {
            (motion.pose(time + h), motion.pose(time + 0.5 * h).rotation)
        } else {
            (Pose { position: start.position + motion.velocity * h, ..start }, start.rotation)
        };
        ObstacleStep {
            start,
            end,
            middle,
            shift: end.position - start.position,
            turns,
            moves: turns || motion.velocity != Vector3::zeros(),
            axis: motion.angular_velocity.try_normalize(0.0).unwrap_or_default(),
            velocity: motion.velocity,
            angular_velocity: motion.angular_velocity,
        }
    }

    /// Returns the speed of its fastest point within `distance` (m) of a point.
    pub fn speed(&self, x: &Vector3<f64>, distance: f64) -> f64 {
        self.velocity.norm() + self.angular_velocity.norm() * ((x - self.start.position).norm() + distance)
    }

    /// Returns vectors from one of its points to a point of the cable at both ends, in the axes half way.
    pub fn beside(&self, own: &Vector3<f64>, x: &Vector3<f64>, change: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        if self.turns {
            let (y0, y1) = (self.start.own(x), self.end.own(&(x + change)));
            (self.middle * (y0 - own), self.middle * (y1 - own))
        } else {
            self.translated(own, x, change)
        }
    }

    /// Returns the same vectors in the world's axes.
    pub fn translated(
        &self,
        own: &Vector3<f64>,
        x: &Vector3<f64>,
        change: &Vector3<f64>,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let z0 = x - self.start.position - self.start.rotation * own;
        let moved = if self.turns { (self.end.rotation - self.start.rotation) * own } else { Vector3::zeros() };
        (z0, z0 + (change - self.shift - moved))
    }

    /// Returns the motion of a point of the cable beside its material, in the axes half way.
    pub fn slip(&self, x: &Vector3<f64>, change: &Vector3<f64>) -> Vector3<f64> {
        if self.turns { self.middle * (self.end.own(&(x + change)) - self.start.own(x)) } else { change - self.shift }
    }
}
