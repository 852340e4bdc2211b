//! A rigid body over a step of the [discrete gradient](crate::integrate::discrete_gradient).
//!
//! # Equation
//!
//! With velocity v in world axes and angular velocity W in body axes, u = (v, W), the one-leg mean
//! `u^ = u0 + b D u - a O u`, the attitude R and the Cayley map
//!
//! ```text
//! D x = h v^        R1 = R0 Cay(h W^)        Cay(y) = (1 - [y]x/2)^-1 (1 + [y]x/2)
//! B D u + h (0, W^ x I W_m) = h (f, (1 - h [W^]x/2) R0^T tau),      W_m = (W0 + W1)/2
//! ```
//!
//! The second row is the balance of angular momentum, `R1 I W1 - R0 I W0 = h tau`, multiplied by
//! `(1 - h [W^]x/2) R0^T`: without a torque the angular momentum is constant to rounding. Its
//! product with u^ is the energy law, because `W^ . (W^ x ..)` is zero: the work is `f . D x + h
//! tau . w^` with `w^ = R0 W^ = R1 W^`, and a point a of the body moves by exactly `h (v^ + w^ x
//! (R0 a + R1 a)/2)`.
//!
//! B = diag(m, I) plus the carried inertia, which is constant with its rotations in body axes
//! during a host step; so is the torque of what it carries, to which the factor of tau does not
//! apply: inertia and load of a joint that holds the body are some 1e4 times the body's own, and a
//! load that turns otherwise than the inertia spins a slender body about its axis. So do both if
//! they are in body axes by another attitude than that at which they are given, which of a
//! mechanism is the one halfway: a torque of 10 N m has a part of 4e-3 N m about the axis of a bar
//! that turns by 1e-3 in half a step, which spun it up to 26 rad/s in two minutes.
//!
//! Newton's iteration has rows and increments of rotations in world axes by the attitude in the
//! middle of the step. There the second row is that of the torque about the middle arms, which the
//! tangent has; in those by R0 an increment across a slender body has, by that tangent, a part
//! about its axis, which the accepted iterate keeps: with it the bar above went on to 23 rad/s.
//!
//! What a residual row r leaves unbalanced is judged by the velocities B^-1 r that it is worth: the
//! momentum of the body with them, and the square root of m w.I w.
//!
//! # References
//!
//! Simo & Wong, IJNME 31 (1991) 19 (energy and momentum conserving rotation); Austin, Krishnaprasad
//! & Wang, J. Comput. Phys. 107 (1993) 105 (the Cayley map).
//!
//! # Alternatives considered
//!
//! The midpoint rule in the rotation vector of the [other integrators](super::rotation): it keeps
//! neither energy nor angular momentum.

use super::rigid::RigidMotion;
use crate::contact::{BodyPath, When};
use crate::integrate::discrete_gradient::sum_of_forces;
use crate::island::body::{BodyDifferences, RigidBody};
use crate::model::STANDARD_GRAVITY;
use crate::one_leg::{Factors, OneLeg};
use crate::scales::LEAST_HEIGHT;
use crate::scales::integrate::ALPHA;
use crate::system::angular::{Momenta, Turn};
use crate::term::{Account, Balance};
use nalgebra::{Matrix3, Matrix6, Quaternion, UnitQuaternion, Vector3, Vector6};

/// What a step leaves for the next one.
#[derive(Clone, Copy, Debug)]
struct LastStep {
    /// Change of u.
    change: Vector6<f64>,
    dissipation: f64,
    /// Length in s; 0 if there was none.
    step: f64,
}

/// A body, at its present state and over a step.
#[derive(Clone, Debug)]
pub(in crate::island) struct BodyStep {
    mass: f64,
    /// B.
    matrix: Matrix6<f64>,
    inertia: Matrix3<f64>,
    gyroscopic: bool,
    pub free: [bool; 6],
    force: Vector3<f64>,
    torque: Vector3<f64>,
    /// The torque that turns with the body, in body axes.
    turning: Vector3<f64>,
    /// B^-1, as far as it exists.
    compliance: Matrix6<f64>,
    pub position: Vector3<f64>,
    pub rotation: UnitQuaternion<f64>,
    /// u at the present state.
    pub velocity: Vector6<f64>,
    last: LastStep,
    h: f64,
    leg: OneLeg,
    /// The share of the last step that counts in this one.
    kept: f64,
    /// Whether its state at the beginning of the host step was not that of the last one.
    moved: bool,
    /// Whether something about it was changed since the last step.
    pub changed: bool,
    /// O u.
    before: Vector6<f64>,
    /// D u.
    pub change: Vector6<f64>,
    /// v^ and w^ in world axes.
    pub mean: [Vector3<f64>; 2],
    /// R at the end of the step, and in its middle: rows and increments of rotations are in its
    /// axes there, turned to those of the world.
    pub end: UnitQuaternion<f64>,
    pub middle: UnitQuaternion<f64>,
    /// What is taken from u at the end.
    pub taken: Vector6<f64>,
    /// What impacts of cables take from it, and from D u.
    pub landed: Vector6<f64>,
}

fn split(x: &Vector6<f64>) -> [Vector3<f64>; 2] {
    [x.fixed_rows::<3>(0).into_owned(), x.fixed_rows::<3>(3).into_owned()]
}

fn stack([a, b]: [Vector3<f64>; 2]) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

impl BodyStep {
    /// Begins a host step.
    pub fn new(body: &RigidBody) -> Self {
        let mut matrix = Matrix6::zeros();
        for x in 0..3 {
            matrix[(x, x)] = body.mass;
        }
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&body.inertia);
        let at = body.attitude_of_carried();
        if let Some(carried) = &body.carried {
            let mut turn = Matrix6::identity();
            turn.fixed_view_mut::<3, 3>(3, 3).copy_from(at.to_rotation_matrix().matrix());
            matrix += turn.transpose() * carried * turn;
        }
        let own = body.carried.is_none();
        let compliance = matrix.try_inverse().filter(|_| !own).unwrap_or_else(|| {
            let mut inverse = Matrix6::from_diagonal_element(if body.mass > 0.0 { 1.0 / body.mass } else { 0.0 });
            let angular = body.inertia.try_inverse().unwrap_or_else(Matrix3::zeros);
            inverse.fixed_view_mut::<3, 3>(3, 3).copy_from(&angular);
            inverse
        });
        let spin = body.rotation.inverse() * body.angular_velocity;
        let last = match body.memory.as_ref().and_then(|memory| memory.differences.as_ref()) {
            Some(BodyDifferences { change, dissipation, step, .. }) => {
                LastStep { change: stack(*change), dissipation: *dissipation, step: *step }
            }
            None => LastStep { change: Vector6::zeros(), dissipation: ALPHA, step: 0.0 },
        };
        BodyStep {
            mass: body.mass,
            matrix,
            inertia: body.inertia,
            gyroscopic: body.gyroscopic,
            free: body.free,
            force: body.force,
            torque: body.torque - body.turning_torque,
            turning: at.inverse() * body.turning_torque,
            compliance,
            position: body.position,
            rotation: body.rotation,
            velocity: stack([body.velocity, spin]),
            moved: last.step == 0.0,
            changed: !body.is_as_after_last_step(),
            last,
            h: 0.0,
            leg: OneLeg::default(),
            kept: 1.0,
            before: Vector6::zeros(),
            change: Vector6::zeros(),
            mean: [Vector3::zeros(); 2],
            end: body.rotation,
            middle: body.rotation,
            taken: Vector6::zeros(),
            landed: Vector6::zeros(),
        }
    }

    /// Sets velocity and angular velocity in world axes.
    pub fn set_velocity(&mut self, velocity: &Vector3<f64>, spin: &Vector3<f64>) {
        self.velocity = stack([*velocity, self.rotation.inverse() * spin]);
    }

    /// Begins a step of length `h` (s) with a formula, at constant acceleration.
    pub fn predict(&mut self, h: f64, leg: OneLeg) {
        (self.h, self.leg) = (h, leg);
        self.kept = leg.share_kept((self.last.dissipation, self.last.step), h);
        let [mut v, spin] = split(&(self.last.change * self.kept));
        let mut turned = self.rotation * spin;
        for x in 0..3 {
            if !self.free[x] {
                v[x] = 0.0;
            }
            if !self.free[3 + x] {
                turned[x] = 0.0;
            }
        }
        self.before = stack([v, self.rotation.inverse() * turned]);
        self.change = self.before;
        (self.taken, self.landed) = (Vector6::zeros(), Vector6::zeros());
        self.update();
    }

    /// Adds an increment of D u, its rotation in world axes by the middle attitude.
    pub fn add(&mut self, increment: &[f64]) {
        let mut turned = self.rotation * (self.middle.inverse() * Vector3::from_column_slice(&increment[3..]));
        (0..3).filter(|&x| !self.free[3 + x]).for_each(|x| turned[x] = 0.0);
        self.change += stack([Vector3::from_column_slice(&increment[..3]), self.rotation.inverse() * turned]);
        self.update();
    }

    /// Computes means and end of the iterate.
    fn update(&mut self) {
        let [v, spin] = split(&(self.velocity + self.leg.b * self.change - self.leg.a * self.before));
        let mut spin = self.rotation * spin;
        if self.free[3..] == [false; 3] {
            // a driven rotation by exactly h w
            let angle = 0.5 * self.h * spin.norm();
            if angle > 0.0 && angle < std::f64::consts::FRAC_PI_2 {
                spin *= angle.tan() / angle;
            }
        }
        self.mean = [v, spin];
        let half = spin * (0.5 * self.h);
        let cayley = UnitQuaternion::new_normalize(Quaternion::from_parts(1.0, half));
        self.end = cayley * self.rotation;
        self.middle = UnitQuaternion::new_normalize(cayley.into_inner() + Quaternion::identity()) * self.rotation;
    }

    /// Returns its motion as the contacts of cables see it.
    pub fn path(&self) -> BodyPath {
        let half = self.mean[1] * (0.5 * self.h);
        let (centre, displacement) = (self.position, self.displacement());
        BodyPath { centre, displacement, rotation: self.rotation, half, moved: self.moved }
    }

    /// Returns the change of position.
    pub fn displacement(&self) -> Vector3<f64> {
        self.mean[0] * self.h
    }

    /// Returns a vector of the body in world axes at both ends of the step.
    pub fn ends(&self, local: &Vector3<f64>) -> [Vector3<f64>; 2] {
        [self.rotation * local, self.end * local]
    }

    /// Completes a row of impulse and angular impulse of the pins in world axes: adds the loads,
    /// subtracts the inertia.
    pub fn complete_row(&self, row: &mut [f64]) {
        let h = self.h;
        let [_, spin] = self.mean;
        let impulse = Vector3::new(row[0], row[1], row[2]) + self.force * h;
        let angular = Vector3::new(row[3], row[4], row[5]) + self.torque * h;
        let angular = angular - spin.cross(&angular) * (0.5 * h) + self.rotation * self.turning * h;
        let [momentum, mut rotational] = split(&(self.matrix * self.change));
        if self.gyroscopic {
            let [_, middle] = split(&(self.velocity + 0.5 * self.change));
            rotational += (self.rotation.inverse() * spin).cross(&(self.inertia * middle)) * h;
        }
        let out = [impulse - momentum, self.middle * (self.rotation.inverse() * angular - rotational)];
        row.copy_from_slice(stack(out).as_slice());
    }

    /// Subtracts a change of momentum, its rotation in body axes, from a row.
    pub fn subtract_momentum(&self, momentum: &Vector6<f64>, row: &mut [f64]) {
        let [linear, angular] = split(momentum);
        let out = stack([linear, self.middle * angular]);
        row.iter_mut().zip(&out).for_each(|(row, p)| *row -= p);
    }

    /// Returns D u - O u.
    pub fn second_difference(&self) -> Vector6<f64> {
        self.change - self.before
    }

    /// Returns the estimated error in m of a point of the body in a step of smooth motion; 0 where
    /// it is not known, and of one that cannot move.
    pub fn error(&self, anchor: Vector3<f64>, factors: Factors) -> f64 {
        let before = self.last.step;
        if before == 0.0 || self.kept == 0.0 || self.is_driven() {
            return 0.0;
        }
        let [of_change, of_before] = factors(&self.leg, self.h / before, self.kept);
        let [v, spin] = split(&(self.change * of_change - self.before * of_before));
        self.h * (v + self.rotation * spin.cross(&anchor)).norm()
    }

    /// Returns whether the error of a step is known.
    pub fn is_estimated(&self) -> bool {
        self.last.step > 0.0 && self.kept > 0.0
    }

    /// Returns what the step does not take up of the changes of the one before, so that half its
    /// square is the energy lost.
    pub fn change_shortened(&self) -> Vector6<f64> {
        let share = self.leg.share_held(self.last.dissipation, self.kept);
        if share < 1.0 && !self.is_driven() {
            self.last.change * (self.last.dissipation * (1.0 - share)).sqrt()
        } else {
            Vector6::zeros()
        }
    }

    /// Returns the energy in J of the store that the step does not take up.
    pub fn energy_shortened(&self) -> f64 {
        let change = self.change_shortened();
        0.5 * change.dot(&(self.matrix * change))
    }

    /// Returns whether impacts changed its velocity in the step.
    pub fn is_hit(&self) -> bool {
        self.taken != Vector6::zeros() || self.landed != Vector6::zeros()
    }

    /// Returns u at the end of the step.
    pub fn final_velocity(&self) -> Vector6<f64> {
        self.velocity + self.change
    }

    /// Removes the components of a row along the axes that are locked.
    pub fn lock(&self, row: &mut [f64]) {
        (0..6).filter(|&x| !self.free[x]).for_each(|x| row[x] = 0.0);
    }

    /// Adds the terms of the energy law; `row` is the completed row.
    pub fn add_balance(&self, row: &mut [f64], total: &mut Balance) {
        let power = |row: &[f64]| stack(self.mean).iter().zip(row).map(|(u, r)| u * r).sum::<f64>();
        let all = power(row);
        self.lock(row);
        total.residual -= power(row);
        // the locks take what is left
        total.to(Account::Supports).work -= all - power(row);
        let imbalance = if self.mass > 0.0 {
            self.momentum_size(&(self.compliance * self.in_body_axes(row)))
        } else {
            sum_of_forces(row)
        };
        total.imbalance += imbalance;
        let of_loads = self.compliance * stack([self.force, self.turning]) * self.h;
        let impulse = self.momentum_size(&self.change) + self.mass * split(&of_loads)[0].norm();
        total.impulse += impulse;
        if self.mass > 0.0 {
            let least = self.mass * STANDARD_GRAVITY.norm() * self.h;
            total.imbalance_of_bodies = total.imbalance_of_bodies.max(imbalance / (impulse + least));
        }
        let (second, start) = (self.second_difference(), self.velocity);
        total.numerical += 0.5 * self.leg.a * second.dot(&(self.matrix * second));
        let torque = self.torque + self.rotation * self.turning;
        let work = self.h * (self.force.dot(&self.mean[0]) + torque.dot(&self.mean[1]));
        let loads = total.to(Account::Loads);
        (loads.work, loads.aside) = (loads.work + work, loads.aside + work);
        total.held += 0.5 * start.dot(&(self.matrix * start)) + self.mass * STANDARD_GRAVITY.norm() * LEAST_HEIGHT;
    }

    /// Returns a row with its rotation in body axes.
    fn in_body_axes(&self, row: &[f64]) -> Vector6<f64> {
        let turned = self.middle.inverse() * Vector3::new(row[3], row[4], row[5]);
        stack([Vector3::new(row[0], row[1], row[2]), turned])
    }

    /// Returns how much momentum in N s a change of u is worth, what is carried apart.
    fn momentum_size(&self, change: &Vector6<f64>) -> f64 {
        let [v, spin] = split(change);
        self.mass * v.norm() + (self.mass * spin.dot(&(self.inertia * spin))).max(0.0).sqrt()
    }

    /// Returns whether its motion is prescribed.
    pub fn is_driven(&self) -> bool {
        self.free == [false; 6]
    }

    /// Returns whether it is driven, and stands still.
    pub fn is_at_rest(&self) -> bool {
        self.is_driven() && self.velocity == Vector6::zeros()
    }

    /// Returns velocity and spin at the end of the step, in world axes.
    pub fn end_velocity(&self) -> [Vector3<f64>; 2] {
        let [velocity, spin] = split(&(self.velocity + self.change));
        [velocity, self.end * spin]
    }

    /// Returns its velocity at an arm about its centre in world axes, at an end of the step.
    pub fn velocity_at(&self, when: When, arm: &Vector3<f64>) -> Vector3<f64> {
        let (velocity, rotation) = match when {
            When::Begin => (self.velocity, self.rotation),
            When::End => (self.velocity + self.change - self.taken, self.end),
        };
        let [velocity, spin] = split(&velocity);
        velocity + (rotation * spin).cross(arm)
    }

    /// Returns u at the end of the step, and the share of D u that the store holds.
    pub fn carried_velocity(&self) -> Vector6<f64> {
        self.velocity + self.change - self.taken + self.leg.a * self.change
    }

    /// Sets what impacts take from its velocities, the rotation in world axes.
    pub fn land(&mut self, taken: &[f64]) {
        let turned = self.middle.inverse() * Vector3::new(taken[3], taken[4], taken[5]);
        self.landed = stack([Vector3::new(taken[0], taken[1], taken[2]), turned]);
    }

    /// Takes all free velocities beside a rigid motion from the end of the step; returns their
    /// kinetic energy in J, and their product with all velocities.
    pub fn take_relative(&mut self, rigid: &RigidMotion) -> (f64, f64) {
        let end = self.final_velocity();
        let [v, spin] = split(&end);
        let mut relative = v - rigid.at(&(self.position + self.displacement()));
        (0..3).filter(|&x| !self.free[x]).for_each(|x| relative[x] = 0.0);
        let relative_spin = spin - self.end.inverse() * rigid.spin;
        let relative_spin = if self.free[3..] == [true; 3] { relative_spin } else { Vector3::zeros() };
        self.taken = stack([relative, relative_spin]);
        if self.carries() {
            self.taken = self.compliance * stack([relative * self.mass, self.inertia * relative_spin]);
        }
        let momentum = self.matrix * self.taken;
        (0.5 * self.taken.dot(&momentum), end.dot(&momentum))
    }

    /// Returns what is taken from the velocity of a point that it holds, at the end of the step, or
    /// from that of a slope vector, of which `before` would be taken: along it that stays.
    pub fn taken_at(&self, anchor: &Vector3<f64>, slope: Option<Vector3<f64>>, before: &Vector3<f64>) -> Vector3<f64> {
        let [velocity, spin] = split(&self.taken);
        let spin = self.end * spin;
        match slope.and_then(|slope| Some((slope, slope.try_normalize(0.0)?))) {
            Some((slope, along)) => spin.cross(&slope) + along * along.dot(before),
            None => velocity + spin.cross(&(self.end * anchor)),
        }
    }

    /// Returns its velocity in a rigid motion of the island at the end of the step: along an axis,
    /// or about one through `centre`.
    pub fn velocity_in(&self, mode: usize, centre: &Vector3<f64>) -> Vector6<f64> {
        if mode < 3 {
            return stack([Vector3::ith(mode, 1.0), Vector3::zeros()]);
        }
        let axis = Vector3::ith(mode - 3, 1.0);
        stack([axis.cross(&(self.position + self.displacement() - centre)), self.end.inverse() * axis])
    }

    /// Returns whether it carries other bodies.
    pub fn carries(&self) -> bool {
        let at = |r, c| self.matrix.fixed_view::<3, 3>(r, c).into_owned();
        at(0, 0) != Matrix3::identity() * self.mass || at(0, 3) != Matrix3::zeros() || at(3, 3) != self.inertia
    }

    /// Returns the momenta of a velocity.
    pub fn momentum_of(&self, velocity: &Vector6<f64>) -> Vector6<f64> {
        self.matrix * velocity
    }

    /// Returns momentum at the end of the step and mass, without what is carried.
    pub fn momentum(&self) -> (Vector3<f64>, f64) {
        (self.mass * split(&(self.velocity + self.change))[0], self.mass)
    }

    /// Returns B with rotations in world axes.
    pub fn world_matrix(&self) -> Matrix6<f64> {
        let mut turn = Matrix6::identity();
        turn.fixed_view_mut::<3, 3>(3, 3).copy_from(self.middle.inverse().to_rotation_matrix().matrix());
        turn.transpose() * self.matrix * turn
    }

    /// Makes the end of the step the present state.
    pub fn accept(&mut self) {
        self.position += self.displacement();
        let [v, spin] = split(&(self.velocity + self.change - self.taken - self.landed));
        let mut turned = self.end * spin;
        let [_, held] = split(&self.velocity);
        let held = self.rotation * held;
        for x in 0..3 {
            if !self.free[3 + x] {
                turned[x] = held[x];
            }
        }
        self.rotation = self.end;
        self.velocity = stack([v, self.rotation.inverse() * turned]);
        self.last = LastStep { change: self.change - self.landed, dissipation: self.leg.a, step: self.h };
    }

    /// Adds its momenta at the present state.
    pub fn add_momenta(&self, momenta: &mut Momenta) {
        let turn = self.rotation.to_rotation_matrix();
        let inertia = turn * self.inertia * turn.inverse();
        momenta.add_body(self.mass, &inertia, &self.position, [split(&self.velocity)[0], self.spin()]);
    }

    /// Adds the second difference of its velocities in a step that has just ended.
    pub fn add_second_difference(&self, momenta: &mut Momenta) {
        let [v, spin] = split(&self.second_difference());
        momenta.add_second_difference_of_body(&self.position, [v * self.mass, self.rotation * (self.inertia * spin)]);
    }

    /// Returns impulse and angular impulse about the origin of the loads over a step that has just
    /// ended.
    pub fn outside_impulses(&self) -> [Vector3<f64>; 2] {
        let (impulse, middle) = (self.force * self.h, self.position - 0.5 * self.displacement());
        [impulse, middle.cross(&impulse) + self.torque * self.h]
    }

    /// Changes its velocities by a turn.
    pub fn turn(&mut self, turn: &Turn) {
        let [v, spin] = turn.of_body(&self.position, [split(&self.velocity)[0], self.spin()]);
        let spin = if self.free[3..] == [true; 3] { spin } else { self.spin() };
        self.set_velocity(&v, &spin);
    }

    /// Returns whether nothing but cables acts on it beside its loads, and it keeps its angular
    /// momentum.
    pub fn is_free(&self) -> bool {
        self.free == [true; 6] && self.gyroscopic && !self.carries()
    }

    /// Returns whether nothing but cables acts on it beside its loads, and it is a point: without
    /// inertia, so that it does not turn.
    pub fn is_point(&self) -> bool {
        self.free == [true, true, true, false, false, false] && self.inertia == Matrix3::zeros() && !self.carries()
    }

    /// Returns the angular velocity in world axes.
    pub fn spin(&self) -> Vector3<f64> {
        self.rotation * split(&self.velocity)[1]
    }

    /// Writes the present state to a body.
    pub fn write(&self, body: &mut RigidBody) {
        body.position = self.position;
        body.rotation = self.rotation;
        body.velocity = split(&self.velocity)[0];
        body.angular_velocity = self.spin();
    }

    /// Returns the memory of the last step.
    pub fn differences(&self) -> BodyDifferences {
        BodyDifferences {
            change: split(&self.last.change),
            step: self.last.step,
            dissipation: self.last.dissipation,
            velocity: [split(&self.velocity)[0], self.spin()],
            rotation: self.rotation,
        }
    }
}
