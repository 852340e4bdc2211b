//! Added mass that differs along the axes of a body.
//!
//! # Equation
//!
//! ```text
//! d(m_s v + R w)/dt = F + J              m_s = m + min a,   R = Q diag(a - min a) Q^T,   w = v - u
//! I W' + W x I W = T - w x R w           a_i = C_i rho V_r
//! ```
//!
//! Kirchhoff's equations. Q is the attitude of the body, u the velocity of the water; F are the
//! forces that are known, J is what cables, contacts and joints do. m_s is the mass of the body in
//! Rapier, R what is beyond it; the last term is Munk's moment, which turns a body across its way.
//! Without forces they keep `v.(m_s + R) v/2 + W.I W/2` in still water, and the momentum.
//!
//! *Over a Rapier step* of length h, with M = m_s + R and the attitude that is expected at its end
//! (by the known moments, and by what was not known as far as it lasts),
//!
//! ```text
//! f = m_s M1^-1 (F + k) - F              k = -((R1 - R0) w0 + D)/h
//! D1 = R1 J h/m_s                        J = m_s (v1 - v0)/h - F - f
//! ```
//!
//! f is put on the body beside F, and J is what the step turned out to have beside both. J moves
//! m_s alone in its own step, so that the body has D too much momentum, which the next step takes
//! back: `M v - D` changes by h (F + J) exactly. Munk's moment is that of the momentum and the
//! attitude in the middle of the step. A body in an island of cables, which nothing else touches,
//! has R1 as carried inertia and k as force: then J moves all of M, D is none, and what J changed
//! Munk's moment by, beyond what was expected, is made up for in the next step. Where that
//! has a hundredth of its energy, as a rope snaps taut, the Rapier step is predicted anew, divided
//! (`step/substepping.rs`).
//!
//! # Validity
//!
//! Stable at any step, however stiff what holds the body is: held still, J = -(F + f), so `J h + h
//! F` becomes `(1 - m_s/M) (J h + h F)` along each axis, and m_s is the smallest mass: 0 <= 1 -
//! m_s/M < 1.
//!
//! - Momentum is kept to rounding for the attitude that was expected, which is of third order in a
//!   step; energy to first order, as Rapier's substeps keep it.
//! - A force J is felt late where M is not carried: `M x'' = J + (M/m_s - 1) h J'`, of first order
//!   in the step. On a spring of angular frequency w it is damping of the ratio w h (M/m_s - 1)/2,
//!   and in the step in which a rope snaps taut the body has the energy that the rope already has.
//! - R acts at the centre of mass, along the axes of the body; there is no added inertia of
//!   rotation.
//! - An impulse that a program applies, and Rapier's damping of velocity, are on its mass, m_s; a
//!   force is on all of M.
//! - Munk's swing is symplectic, stable for h w < 2; Rapier steps are shortened to h w <= 0.6, as
//!   for the [heave](super) of a float.
//!
//! # References
//!
//! Lamb 1932, §124 to 127 (Kirchhoff's equations, stability); Munk 1924, NACA TR 184 (moment).
//!
//! # Alternatives considered
//!
//! The mean or the largest of a in Rapier's mass, with R negative: `1 - m_s/M` is then below -1 for
//! a slender body, and a body that a cable holds flies off. J of the last step as forecast: the
//! same f at equal steps, but not the momentum where steps change.

use crate::convert::{rotation, vector};
use ::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use rapier::dynamics::RigidBody;
use serde::{Deserialize, Serialize};

/// Added mass in kg along the axes of a body, beyond the least of the three.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Further(Vector3<f64>);

impl Further {
    /// Returns the least of the added mass along the axes (kg), and what is beyond it, if they
    /// differ.
    pub(super) fn split(added: &Vector3<f64>) -> (f64, Option<Further>) {
        let least = added.min();
        let beyond = added.add_scalar(-least);
        (least, (beyond != Vector3::zeros()).then_some(Further(beyond)))
    }

    /// Returns it along the axes of the body, in kg.
    pub(super) fn axes(&self) -> Vector3<f64> {
        self.0
    }

    /// Returns R in kg, in world axes.
    pub(super) fn at(&self, rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
        turned(rotation, &self.0)
    }

    /// Returns the inverse of m + R in 1/kg, in world axes, for a mass m in kg.
    pub(super) fn mobility(&self, mass: f64, rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
        turned(rotation, &self.0.map(|beyond| 1.0 / (mass + beyond)))
    }

    /// Returns the largest angular frequency in rad/s with which Munk's moment lets a body swing
    /// that moves at a velocity (m/s, along its axes) through the water, with its mass (kg) and its
    /// moments of inertia (kg m^2).
    pub(super) fn fastest_swing(&self, mass: f64, velocity: &Vector3<f64>, moments: &Vector3<f64>) -> f64 {
        let masses = self.0.add_scalar(mass);
        let momentum = masses.component_mul(velocity);
        let about = |axis: usize| {
            let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
            let stiffness = (momentum[i].powi(2) + momentum[j].powi(2)) * (1.0 / masses[i] - 1.0 / masses[j]).abs();
            if moments[axis] > 0.0 { stiffness / moments[axis] } else { 0.0 }
        };
        about(0).max(about(1)).max(about(2)).sqrt()
    }
}

/// Returns a diagonal matrix in the axes of a body, in world axes.
fn turned(rotation: &UnitQuaternion<f64>, diagonal: &Vector3<f64>) -> Matrix3<f64> {
    let turn = rotation.to_rotation_matrix();
    turn * Matrix3::from_diagonal(diagonal) * turn.transpose()
}

/// Returns what is expected again of a vector that had two values in the last steps: by component
/// the smaller of both, where they agree in sign.
pub(super) fn lasting(last: &Vector3<f64>, before: &Vector3<f64>) -> Vector3<f64> {
    last.zip_map(before, |a, b| if a * b <= 0.0 { 0.0 } else { a.abs().min(b.abs()).copysign(a) })
}

/// What is remembered of further mass from step to step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Carry {
    /// Attitude at the end of the step, and the one for which M v - D is the momentum.
    attitudes: [UnitQuaternion<f64>; 2],
    /// J in N.
    pub(super) others: Vector3<f64>,
    /// D in N s; `None` at rest, where it is that of a step in which nothing changed.
    debt: Option<Vector3<f64>>,
    /// What Munk's moment was to have been more, by forces that were not expected, in N m s.
    owed: Vector3<f64>,
    /// Angular acceleration by what was not known in rad/s^2, of the last step and of the one
    /// before.
    spun: [Vector3<f64>; 2],
}

impl Carry {
    /// Returns that of a body at rest at an attitude, on which others act with a force (N).
    pub(super) fn at_rest(attitude: UnitQuaternion<f64>, others: Vector3<f64>) -> Self {
        let zero = Vector3::zeros();
        Carry { attitudes: [attitude; 2], others, debt: None, owed: zero, spun: [zero; 2] }
    }
}

/// Further mass over a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct FurtherStep {
    further: Further,
    /// m_s in kg.
    mass: f64,
    h: f64,
    /// R at the beginning and at the end in kg, and the attitude that is expected there.
    start: Matrix3<f64>,
    end: Matrix3<f64>,
    attitude: UnitQuaternion<f64>,
    /// M1^-1 in 1/kg.
    pub(super) mobility: Matrix3<f64>,
    /// w0 and u in m/s.
    relative: Vector3<f64>,
    water: Vector3<f64>,
    /// D in N s, as the body alone and as one in an island has it.
    debts: [Vector3<f64>; 2],
    /// Whether it begins at rest, where what is not known balances the rest.
    rests: bool,
    /// Angular acceleration in rad/s^2 by what is known, and by what was not in the last two steps.
    spun: Vector3<f64>,
    spun_by_others: [Vector3<f64>; 2],
    /// F in N.
    known: Vector3<f64>,
    /// f, and k as one in an island has it, in N.
    pub(super) force: Vector3<f64>,
    in_island: Vector3<f64>,
    /// What was expected of J, in N.
    expected: Vector3<f64>,
    /// Attitude in the middle, without the lead of the substeps.
    middle: UnitQuaternion<f64>,
    /// The mean of Munk's moment in N m, with what the last step was to have had more of it.
    pub(super) moment: Vector3<f64>,
    /// Whether R is carried in an island.
    pub(super) carried: bool,
}

impl FurtherStep {
    /// Begins a step of `h` (s) of a body in water of a velocity (m/s), with what was remembered of
    /// the last one. The end is that of a uniform rotation.
    pub(super) fn new(further: Further, body: &RigidBody, carry: Option<&Carry>, water: Vector3<f64>, h: f64) -> Self {
        let mass = f64::from(body.mass());
        let now = rotation(*body.rotation());
        // a body that a program turned has the momentum of its new attitude
        let known = carry.filter(|carry| carry.attitudes[0] == now);
        let start = further.at(&known.map_or(now, |carry| carry.attitudes[1]));
        let attitude = UnitQuaternion::from_scaled_axis(vector(body.angvel()) * h) * now;
        let zero = Vector3::zeros();
        let debts = match carry {
            None => [zero; 2],
            Some(Carry { debt: Some(debt), .. }) => [*debt; 2],
            Some(Carry { debt: None, others, .. }) => [start * others * (h / mass), zero],
        };
        FurtherStep {
            further,
            mass,
            h,
            start,
            end: further.at(&attitude),
            attitude,
            mobility: further.mobility(mass, &attitude),
            relative: vector(body.linvel()) - water,
            water,
            debts,
            rests: carry.is_some_and(|carry| carry.debt.is_none()),
            spun: zero,
            spun_by_others: carry.map_or([zero; 2], |carry| carry.spun),
            known: zero,
            force: zero,
            in_island: zero,
            expected: zero,
            middle: now,
            moment: carry.filter(|_| h > 0.0).map_or(zero, |carry| carry.owed / h),
            carried: false,
        }
    }

    /// Returns the force in N by which M turns with the body, -(R1 - R0) w0/h; zero without a step.
    pub(super) fn turning(&self) -> Vector3<f64> {
        if self.h > 0.0 { (self.end - self.start) * self.relative / -self.h } else { Vector3::zeros() }
    }

    /// Adds Munk's moment in the middle of a step, by the forces that are known and those that are
    /// expected (N), and the attitude there.
    pub(super) fn add_munk(&mut self, [known, expected]: [Vector3<f64>; 2], middle: UnitQuaternion<f64>) {
        (self.known, self.expected, self.middle) = (known, expected, middle);
        self.moment += self.munk(&expected);
    }

    /// Returns Munk's moment in N m in the middle of a step with a force J (N).
    fn munk(&self, others: &Vector3<f64>) -> Vector3<f64> {
        let FurtherStep { further, mass, h, .. } = self;
        // without D: what is held still has no momentum
        let momentum = self.relative * *mass + self.start * self.relative + (self.known + others) * (0.5 * h);
        momentum.cross(&(further.mobility(*mass, &self.middle) * momentum))
    }

    /// Completes a step with the angular acceleration (rad/s^2) by the known moments, of a body
    /// that Rapier's substeps lead by `lead` (s).
    pub(super) fn complete(&mut self, body: &RigidBody, acceleration: &Vector3<f64>, lead: f64) {
        let FurtherStep { further, mass, h, known, .. } = *self;
        if h <= 0.0 {
            return;
        }
        self.spun = *acceleration;
        let [last, before] = self.spun_by_others;
        let expected = if self.rests { Vector3::zeros() } else { acceleration + lasting(&last, &before) };
        let turn = vector(body.angvel()) * h + expected * (h * (0.5 * h + lead));
        self.attitude = UnitQuaternion::from_scaled_axis(turn) * rotation(*body.rotation());
        (self.end, self.mobility) = (further.at(&self.attitude), further.mobility(mass, &self.attitude));
        let turning = self.turning();
        self.force = self.mobility * (known + turning - self.debts[0] / h) * mass - known;
        self.in_island = turning - self.debts[1] / h;
    }

    /// Lets an island carry R, or not. Returns R in kg, in world axes, and what the force on the
    /// body exceeds f by then, in N.
    pub(super) fn carry(&mut self, carried: bool) -> Option<(Matrix3<f64>, Vector3<f64>)> {
        self.carried = carried;
        carried.then(|| (self.end, self.in_island - self.force))
    }

    /// Returns the impulse of Munk's moment in N m s that was not expected, of a body in an island
    /// whose velocity changes by `change` (m/s).
    pub(super) fn owed(&self, change: &Vector3<f64>) -> Vector3<f64> {
        (self.munk(&self.others(change)) - self.munk(&self.expected)) * self.h
    }

    /// Returns J in N of a body in an island, by the change of its velocity in m/s.
    fn others(&self, change: &Vector3<f64>) -> Vector3<f64> {
        (change * self.mass + self.end * change) / self.h - self.known - self.in_island
    }

    /// Returns what is remembered of the step, by the changes of velocity (m/s) and spin (rad/s) in
    /// it and the attitude at its end.
    pub(super) fn ended(&self, [change, spun]: [&Vector3<f64>; 2], attitude: UnitQuaternion<f64>) -> Carry {
        let FurtherStep { mass, h, end, known, force, .. } = self;
        let attitudes = [attitude, self.attitude];
        let last = spun / *h - self.spun;
        let spun = [last, if self.rests { last } else { self.spun_by_others[0] }];
        if self.carried {
            let (others, owed) = (self.others(change), self.owed(change));
            return Carry { attitudes, others, debt: Some(Vector3::zeros()), owed, spun };
        }
        let others = change * (mass / h) - known - force;
        Carry { attitudes, others, debt: Some(end * others * (h / mass)), owed: Vector3::zeros(), spun }
    }

    /// Returns the work in J of a current on R as it turns: u.(R1 - R0) u/2.
    pub(super) fn work_of_current(&self) -> f64 {
        0.5 * self.water.dot(&((self.end - self.start) * self.water))
    }
}
