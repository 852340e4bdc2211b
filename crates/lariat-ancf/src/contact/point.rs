//! One contact over a step: its force, its tangent, and what it does to the energy.

use super::impact::Impact;
use super::law::{NormalLaw, friction, spring_energy};
use super::linear::{About, Linear, Tangents};
use super::memory::{ContactMemory, Key};
use super::patch::Patch;
use super::path::ObstacleStep;
use super::roll::Roll;
use nalgebra::Vector3;

/// Time in s in which a body's displacement by others comes to the cable, as a motion of the body. An engine's contact and the cable would
/// pump energy through each other if it came at once: each answers to what the other did a step before.
const CLOSING_TIME: f64 = 0.25;
/// Time in s in which the offset of an obstacle closes, and that of a cable, if losses pay for it.
pub(in crate::contact) const OFFSET_TIME: f64 = 0.05;
pub(in crate::contact) const OFFSET_TIME_OF_PAIRS: f64 = 0.25;
/// Share of the energy lost in the last step that closing offsets may cost.
pub(in crate::contact) const PAID: f64 = 0.9;
/// Distance in radii by which others can lift a body off a cable in a step without ending the contact.
const LIFTED: f64 = 0.1;

/// A material point that can touch an obstacle in the present step.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct ContactPoint {
    pub key: Key,
    /// Number of the obstacle.
    pub obstacle: usize,
    pub xi: f64,
    /// Shape functions of its element.
    pub shape: [f64; 4],
    /// Length in m that it stands for.
    pub weight: f64,
    pub law: NormalLaw,
    /// Coefficient of friction.
    pub friction: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Speed in m/s across it with which the cable came when it first touched, negative once it leaves; 0 without restitution, and if it comes again.
    pub came: f64,
    /// Gap in m at which it touches: radius and skin.
    pub reach: f64,
    pub patch: Patch,
    /// Depth in m at the beginning, offset and all; negative where there is a gap.
    pub depth_before: f64,
    /// Depth in m that does not count, at the beginning.
    pub offset: f64,
    /// What of it counts at the end.
    pub closing: f64,
    /// Whether losses pay for that, not what moved the obstacle.
    pub pays: bool,
    /// Whether it touched when the last step ended.
    pub touched: bool,
    /// Normal force in N at the end of the last step.
    pub remembered: f64,
    /// Where it acts, if that is between the closest points of beginning and end.
    pub between: Option<Between>,
    /// Distance in m from the surface at the beginning.
    pub distance: f64,
    /// Position at the beginning.
    pub start: Vector3<f64>,
    /// Spring of friction at the beginning, in the obstacle's axes.
    pub spring: Vector3<f64>,
    /// Largest friction in N.
    pub bound: f64,
    /// Whether that is the bound of the present step.
    pub renewed: bool,
    /// Distance in m by which it may move beside the obstacle without touching it: the gap of a patch changes no faster than that.
    pub free_way: f64,
    /// Number of the feature that it touches among those that are near.
    pub nearby: Option<usize>,
    /// Number of what it remembers.
    pub recalls: Option<usize>,
    /// How it moves along its element.
    pub roll: Option<Roll>,
    /// What the last linear solve was made with.
    pub linear: Linear,
    /// The depth and the friction about which the next one is.
    pub about: About,
    /// At the end of the present iterate.
    pub now: Evaluation,
    /// What it does to the velocity across it when the step ends.
    pub impact: Impact,
}

/// Where a contact acts between two closest points ([`slide`](super::slide)).
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Between {
    /// What its gap has more than that of the closest points, in m.
    pub excess: f64,
    /// Outward normal at the closest point of the end, in the obstacle's axes.
    pub normal: Vector3<f64>,
    /// The row of the normal force in the matrix.
    pub row: Row,
}

/// A place of an element: shape functions, and position at the beginning.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Row {
    pub shape: [f64; 4],
    pub start: Vector3<f64>,
}

/// A contact at the end of an iterate.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::contact) struct Evaluation {
    /// Force on the cable in N.
    pub force: Vector3<f64>,
    /// Friction alone.
    pub friction: Vector3<f64>,
    pub normal_force: f64,
    /// Outward normal.
    pub normal: Vector3<f64>,
    pub depth: f64,
    /// Spring of friction in the obstacle's axes half way.
    pub spring: Vector3<f64>,
    pub slides: Option<Vector3<f64>>,
    /// Motion beside the obstacle.
    pub slip: Vector3<f64>,
    /// Whether a plane took the place of its patch.
    pub replaced: bool,
    /// Arm of the force about the centre of the body that carries the obstacle.
    pub arm: Vector3<f64>,
    /// Energy in J that it stores.
    pub energy: f64,
    /// Energy in J that it lost.
    pub loss: f64,
    /// What of it friction took.
    pub friction_loss: f64,
    /// Work in J of the obstacle's motion.
    pub work: f64,
    pub pressure: f64,
    pub slope: f64,
}

impl ContactPoint {
    /// Takes up what was remembered of it: the spring and the bound of friction, and the depth, beyond which nothing counts: the offset. Of an
    /// obstacle on a body that was moved since then, by an engine, the difference has either sign, and closes by the engine's work.
    pub fn recall(&mut self, y: &Vector3<f64>, obstacle: &ObstacleStep, memory: Option<&ContactMemory>) {
        let depth = self.depth_at(self.patch.gap(y).0);
        self.depth_before = depth;
        self.free_way = if memory.is_none() { -depth } else { 0.0 };
        let difference = depth.max(0.0) - memory.map_or(0.0, |memory| memory.depth);
        (self.offset, self.closing, self.pays) = (difference.max(0.0), 0.0, false);
        self.touched = memory.is_some();
        self.remembered = memory.map_or(0.0, |memory| memory.force);
        if let Some(memory) = memory {
            let difference = depth - memory.depth;
            if obstacle.moved && difference > -LIFTED * self.reach {
                (self.offset, self.closing) = (difference, difference * (obstacle.h / CLOSING_TIME).min(1.0));
                self.remembered = 0.0;
            }
            self.spring = memory.spring;
            self.came = memory.came;
            self.bound = self.friction * memory.force;
        }
    }

    /// Returns the depth in m of the closest point where the gap of this one is `gap`.
    fn depth_at(&self, gap: f64) -> f64 {
        self.reach + self.between.map_or(0.0, |between| between.excess) - gap
    }

    /// Returns the energy in J that it would cost to close the offset, under the force of the last step.
    pub fn cost(&self) -> f64 {
        self.remembered * self.offset
    }

    /// Closes a share of the offset.
    pub fn close(&mut self, share: f64) {
        if self.remembered > 0.0 && self.offset > 0.0 {
            (self.closing, self.pays) = (share * self.offset, true);
        }
    }

    /// Returns the energy in J that it stores at the beginning.
    pub fn energy_before(&self) -> f64 {
        let depth = self.depth_before - self.offset;
        self.weight * self.law.at(depth).energy + spring_energy(self.law.stiffness * self.weight, &self.spring)
    }

    /// Returns the row of its normal force.
    pub fn row(&self) -> Row {
        self.between.map_or(Row { shape: self.shape, start: self.start }, |between| between.row)
    }

    /// Returns the change of its position.
    pub fn change(&self, change: &[f64]) -> Vector3<f64> {
        combine(change, self.key.0 as usize, &self.shape)
    }

    /// Evaluates it for a change of its position over the step, and sets its tangents, which are zero, if they are asked for.
    pub fn evaluate(
        &self,
        obstacle: &ObstacleStep,
        change: &Vector3<f64>,
        about: About,
        mut tangents: Option<&mut Tangents>,
    ) -> Evaluation {
        if self.free_way > 0.0 && about.depth.is_none() && self.linear.slope == 0.0 {
            let slip = obstacle.slip(&self.start, change);
            if slip.norm_squared() < self.free_way * self.free_way {
                return Evaluation { slip, ..Evaluation::default() };
            }
        }
        let meets = self.between.is_none().then_some(self.reach);
        let gap = self.patch.over_step(obstacle, &self.start, change, meets);
        let depth = self.depth_at(gap.end) - (self.offset - self.closing);
        let stiffness = self.weight * self.law.stiffness;
        let u0 = obstacle.middle * self.spring;
        let before = self.weight * self.law.at(self.depth_at(gap.start) - self.offset).energy;
        if depth <= 0.0 && about.depth.is_none() {
            let loss = before + spring_energy(stiffness, &u0);
            let slip = obstacle.slip(&self.start, change);
            return Evaluation { depth, normal: gap.normal, slip, loss, ..Evaluation::default() };
        }
        let end = self.law.at(depth);
        let (mut pressure, mut slope) = (end.force, end.slope);
        if let Some(about) = about.depth {
            let at = self.law.at(about);
            (pressure, slope) = (at.force + at.slope * (depth - about), at.slope);
        }
        let normal = self.between.map_or(gap.normal, |between| obstacle.end.rotation * between.normal);
        if let Some(tangents) = &mut tangents {
            // symmetric, of the derivative between the mean normal and the one of the end
            let row = 0.5 * (gap.mean + normal);
            (tangents.normal, tangents.across) = (row * row.transpose() * (self.weight * slope), row);
        }
        let normal_force = self.weight * pressure;
        let after = self.weight * end.energy;
        let slip = obstacle.slip(&self.start, change);
        let mut out = Evaluation {
            force: gap.mean * normal_force,
            arm: obstacle.arm(&self.start, change),
            slip,
            replaced: gap.replaced,
            normal_force,
            normal,
            depth,
            energy: after,
            loss: before - after - normal_force * (gap.mean.dot(&slip) - self.closing),
            work: normal_force * self.closing,
            pressure,
            slope,
            ..Evaluation::default()
        };
        if self.pays {
            out.loss -= out.work;
            out.work = 0.0;
        }
        if self.friction > 0.0 {
            let is_constant = gap.mean == gap.normal;
            let mean = if is_constant { gap.mean } else { gap.mean.try_normalize(0.0).unwrap_or(gap.normal) };
            let friction = friction(stiffness, self.bound, &mean, &u0, &slip, about.sticks);
            out.friction = friction.spring * -friction.stiffness;
            out.force += out.friction;
            if let Some(tangents) = tangents {
                tangents.friction = friction.tangent(&mean);
            }
            out.spring = friction.spring;
            out.slides = friction.slides;
            out.energy += spring_energy(stiffness, &friction.spring);
            out.loss += friction.loss;
            out.friction_loss = friction.loss;
        }
        if obstacle.driven {
            out.work += out.force.dot(&(change - slip));
        }
        out
    }

    /// Returns what is remembered of it at the end of the step.
    pub fn memory(&self, obstacle: &ObstacleStep) -> ContactMemory {
        let (now, (element, key, place)) = (&self.now, self.key);
        ContactMemory {
            element,
            place,
            obstacle: key,
            xi: self.xi,
            weight: self.weight,
            patch: self.patch,
            normal: obstacle.end.rotation.tr_mul(&now.normal),
            depth: now.depth,
            offset: self.offset - self.closing,
            spring: obstacle.middle.tr_mul(&now.spring),
            force: now.normal_force,
            energy: now.energy,
            friction_power: now.friction_loss / obstacle.h,
            direction: now.normal,
            friction: now.friction,
            slips: now.slides.is_some(),
            came: self.came,
        }
    }
}

/// Returns a nodal vector at a point of an element.
pub(crate) fn combine(q: &[f64], element: usize, shape: &[f64; 4]) -> Vector3<f64> {
    let d = &q[6 * element..6 * element + 12];
    let part = |x: usize| shape[0] * d[x] + shape[1] * d[3 + x] + shape[2] * d[6 + x] + shape[3] * d[9 + x];
    Vector3::new(part(0), part(1), part(2))
}

#[cfg(test)]
mod tests {
    use super::super::path::BodyPath;
    use super::super::rigid_motion::{Mount, RigidMotion};
    use super::*;
    use nalgebra::UnitQuaternion;

    fn point(patch: Patch, friction: f64) -> ContactPoint {
        let (xi, shape, weight, reach) = (0.5, [0.5, 0.0, 0.5, 0.0], 0.03, 5e-3);
        let law = NormalLaw::new(1e9, 5e-3);
        ContactPoint { xi, shape, weight, law, friction, reach, patch, ..ContactPoint::default() }
    }

    /// Without friction the tangent is minus the derivative of the force, but for the turn of the mean normal, on a plane; and no contact
    /// with an obstacle, moving or turning or at rest, loses less than nothing: `F . D x = work - D (W + U) - loss` with a loss above zero.
    ///
    /// *Source.* Central differences, and the energies by their formulas.
    #[test]
    fn a_contact_makes_no_energy_but_the_work_of_its_obstacle() {
        let turning = RigidMotion {
            velocity: Vector3::new(0.3, -0.2, 0.1),
            angular_velocity: Vector3::new(3.0, 10.0, -5.0),
            ..RigidMotion::default()
        };
        let normal = Vector3::new(0.0, 0.6, 0.8);
        let patches = [
            Patch::Plane { point: Vector3::zeros(), normal },
            Patch::Line { point: Vector3::zeros(), direction: Vector3::x(), radius: 0.1 },
            Patch::Point { point: Vector3::zeros(), radius: 0.1 },
        ];
        for patch in patches {
            let (origin, spin) = (Vector3::zeros(), UnitQuaternion::identity());
            let mount = Mount { body: 0, position: origin, rotation: spin };
            let half = Vector3::new(0.05, -0.1, 0.2);
            let path = BodyPath { centre: origin, displacement: 3e-5 * half, rotation: spin, half, moved: false };
            let h = 1.0 / 240.0;
            let still = ObstacleStep::new(&RigidMotion::default(), 0.0, h);
            let carried = ObstacleStep::carried(&mount, &path, h);
            for step in [still, ObstacleStep::new(&turning, 0.0, h), carried] {
                for i in 0..64 {
                    let way = |k: i32, n: i32| f64::from((i * n + k * 5) % 11 - 5) * 4e-5;
                    let mut p = point(patch, 0.4);
                    let height = patch.radius().unwrap_or(0.0) + 5e-3 + 2e-5 * f64::from(i % 5 - 3);
                    p.start = height * normal;
                    p.spring = 1e-6 * Vector3::new(1.0, -0.8, 0.6) * f64::from(i % 3);
                    p.bound = f64::from(i % 4) * 20.0;
                    p.depth_before = p.depth_at(patch.gap(&p.start).0);
                    let before = p.energy_before();
                    let change = Vector3::new(way(1, 3), way(2, 7), way(3, 2));
                    let now = p.evaluate(&step, &change, About::default(), None);
                    let way = step.slip(&p.start, &change);
                    let made = now.force.dot(&way) + now.energy - before + now.loss;
                    let work = if step.driven { now.force.dot(&(change - way)) } else { 0.0 };
                    assert_eq!(now.work, work);
                    assert!(made.abs() < 1e-12, "{patch:?} {i} {made:e}");
                    assert!(now.loss > -1e-13, "{patch:?} {i} {:e}", now.loss);
                }
            }
        }
    }

    /// What closes of an offset is paid by the contact itself, `F . D x = -D (W + U) - loss`, or by what moved the obstacle, with its work.
    ///
    /// *Source.* The energies by their formulas.
    #[test]
    fn an_offset_that_closes_is_paid_for() {
        let step = ObstacleStep::new(&RigidMotion::default(), 0.0, 1.0 / 240.0);
        for pays in [true, false] {
            let mut p = point(Patch::Plane { point: Vector3::zeros(), normal: Vector3::y() }, 0.4);
            p.start = Vector3::new(0.0, 5e-3 - 6e-5, 0.0);
            (p.bound, p.offset, p.closing, p.pays) = (30.0, 4e-5, 1e-5, pays);
            p.depth_before = p.depth_at(p.patch.gap(&p.start).0);
            let before = p.energy_before();
            let change = Vector3::new(3e-4, -1e-5, 0.0);
            let now = p.evaluate(&step, &change, About::default(), None);
            let made = now.force.dot(&change) + now.energy - before + now.loss - now.work;
            assert!(now.normal_force > 0.0 && made.abs() < 1e-12, "{made:e}");
            assert_eq!(now.work, if pays { 0.0 } else { now.normal_force * p.closing });
        }
    }

    /// On a plane the tangent is exact: of the normal force, of sticking and of slipping.
    ///
    /// *Source.* Central differences.
    #[test]
    fn the_tangent_of_a_plane_is_the_derivative_of_the_force() {
        let step = ObstacleStep::new(&RigidMotion::default(), 0.0, 1.0 / 240.0);
        for bound in [0.0, 2.0, 1e4] {
            let mut p = point(Patch::Plane { point: Vector3::zeros(), normal: Vector3::y() }, 0.4);
            p.start = Vector3::new(0.0, 5e-3 - 2e-5, 0.0);
            p.bound = bound;
            let change = Vector3::new(3e-6, -2e-5, 2e-6);
            let at = |change: &Vector3<f64>| p.evaluate(&step, change, About::default(), None);
            let mut tangents = Tangents::default();
            p.evaluate(&step, &change, About::default(), Some(&mut tangents));
            for c in 0..3 {
                let d = 1e-10 * Vector3::ith(c, 1.0);
                let slope = (at(&(change - d)).force - at(&(change + d)).force) / 2e-10;
                let column = (tangents.normal + tangents.friction).column(c).into_owned();
                assert!((slope - column).norm() < 1e-4 * 3e7, "{bound} {slope:?} {column:?}");
            }
        }
    }
}
