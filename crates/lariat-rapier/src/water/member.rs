//! The force of water on one body over a step.

use super::added_mass::{Carry, Further, FurtherStep, lasting};
use super::drag::{mean_drag, midpoint};
use super::hull::{Hull, Wet};
use super::immersed::Immersed;
use super::rise::{Rising, bisect};
use crate::convert::{rotation, symmetric_inertia, to_vector, vector};
use crate::scales::water::{SAME_DRAG, SMALL_ANGLE, STEP_ROUNDS};
use ::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use lariat_ancf::island::LoadThere;
use lariat_ancf::{Sea, Water};
use rapier::dynamics::{LockedAxes, RigidBody, RigidBodyHandle};
use rapier::math::Vector;
use serde::{Deserialize, Serialize};

/// What is remembered of the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Memory {
    velocity: Vector3<f64>,
    /// Length of the step in s, 0 if there was none.
    step: f64,
    /// All forces that were known.
    known: Vector3<f64>,
    /// What was not, in the step before it.
    unknown: Vector3<f64>,
    drag: Vector3<f64>,
    /// Of its further mass, if it has some.
    #[serde(default)]
    carry: Option<Carry>,
}

/// Returns the inertia about the centre of mass in kg m^2, in world axes.
fn world_inertia(body: &RigidBody) -> Matrix3<f64> {
    let turn = rotation(*body.rotation()).to_rotation_matrix();
    turn * symmetric_inertia(body) * turn.transpose()
}

/// Returns the angular acceleration in rad/s^2 that moments (N m) give, in world axes.
fn acceleration(body: &RigidBody, moments: &Vector3<f64>) -> Vector3<f64> {
    let inertia = world_inertia(body);
    let Some(inverse) = inertia.try_inverse() else { return Vector3::zeros() };
    let spin = vector(body.angvel());
    let gyroscopic = if body.gyroscopic_forces_enabled() { spin.cross(&(inertia * spin)) } else { Vector3::zeros() };
    let axes = [LockedAxes::ROTATION_LOCKED_X, LockedAxes::ROTATION_LOCKED_Y, LockedAxes::ROTATION_LOCKED_Z];
    let free = Vector3::from(axes.map(|axis| if body.locked_axes().contains(axis) { 0.0 } else { 1.0 }));
    free.component_mul(&(inverse * free.component_mul(&(moments - gyroscopic))))
}

/// What acts on a body in a Rapier step.
#[derive(Clone, Copy, Debug)]
struct Acting {
    /// Force and torque of the user, and those with the water's.
    own: [Vector; 2],
    with: [Vector; 2],
    /// What was remembered before.
    memory: Memory,
    /// Centre of mass in m and attitude, at the beginning.
    place: (Vector3<f64>, UnitQuaternion<f64>),
    /// Velocity in m/s and spin in rad/s, at the beginning.
    velocity: [Vector3<f64>; 2],
    /// What balances the weight of the added mass in N.
    balance: Vector3<f64>,
    /// Share of the step by which the position is ahead.
    lead: f64,
    further: Option<FurtherStep>,
}

/// A body in water.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Member {
    pub(super) body: RigidBodyHandle,
    hull: Hull,
    pub(super) immersed: Immersed,
    /// Added mass in kg, part of that of the body while any of it is wet, and what is beyond it
    /// along its axes.
    added: f64,
    #[serde(default)]
    further: Option<Further>,
    /// Whether all of it is in air.
    #[serde(default)]
    dry: bool,
    /// Volume in m^3 that it displaces when it floats.
    floating: f64,
    memory: Memory,
    /// Work of the water on it in J.
    pub(super) work: f64,
    /// What Rapier's substeps took from it in J.
    #[serde(default)]
    pub(super) substeps: f64,
    #[serde(skip)]
    acting: Option<Acting>,
}

/// Forces of the water on a body, without what balances the weight of the added mass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct WaterForce {
    /// Buoyancy and the pressure of the wave in N, world axes.
    pub pressure: Vector3<f64>,
    /// Where it acts in m, in the axes of the body from its origin.
    pub pressure_point: Vector3<f64>,
    /// Drag in N, world axes.
    pub drag: Vector3<f64>,
    /// Where it acts in m, in the axes of the body from its origin.
    pub drag_point: Vector3<f64>,
    /// Force of the wave on the added mass, in N, through the centre of mass.
    pub inertia: Vector3<f64>,
    /// Moment in N m beside that of the forces, world axes: drag of rotation, what makes
    /// the righting moment that of the middle of the step, and Munk's moment.
    pub moment: Vector3<f64>,
    /// Share of the volume that is wet.
    pub wet: f64,
}

/// What the force of a step depends on.
pub(super) struct Input<'a> {
    pub(super) water: &'a Water,
    pub(super) sea: Option<&'a Sea>,
    pub(super) gravity: Vector3<f64>,
    /// Middle of the step in s.
    pub(super) time: f64,
    pub(super) h: f64,
    /// Time in s by which the position is ahead of one that a constant force moves exactly.
    pub(super) lead: f64,
}

/// What acts on a body in a step, and where.
struct InStep {
    /// Centroid of its volume in m, in the middle of the step.
    middle: Vector3<f64>,
    wet: Wet,
    pressure: Vector3<f64>,
    inertia: Vector3<f64>,
    /// Half the density times the share that is wet.
    factor: f64,
    drag: Vector3<f64>,
}

/// A body in a step.
struct Place {
    /// Centroid of its volume in m, in the middle of the step but for the height, at its beginning.
    centre: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
}

impl Member {
    /// Creates a body in water by its added mass (kg), and the volume (m^3) that it displaces when
    /// it floats.
    pub(super) fn new(
        body: RigidBodyHandle,
        hull: Hull,
        immersed: Immersed,
        (added, further): (f64, Option<Further>),
        floating: f64,
    ) -> Self {
        Member {
            body,
            hull,
            immersed,
            added,
            further,
            dry: false,
            floating,
            memory: Memory::default(),
            work: 0.0,
            substeps: 0.0,
            acting: None,
        }
    }

    /// Returns the volume in m^3.
    pub(super) fn volume(&self) -> f64 {
        self.hull.volume()
    }

    /// Returns the added mass in kg that is in the mass of the body now.
    pub(super) fn carried(&self) -> f64 {
        if self.dry { 0.0 } else { self.added }
    }

    /// Returns the added mass that the body has now beyond that.
    pub(super) fn further(&self) -> Option<Further> {
        self.further.filter(|_| !self.dry)
    }

    /// Lets an island carry the further mass over the present step, or not, as
    /// [`FurtherStep::carry`].
    pub(super) fn carry(&mut self, carried: bool) -> Option<(Matrix3<f64>, Vector3<f64>)> {
        self.acting.as_mut()?.further.as_mut()?.carry(carried)
    }

    /// Returns [`FurtherStep::owed`] of a body in an island.
    pub(super) fn owed(&self, change: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.acting.as_ref()?.further.as_ref().filter(|further| further.carried).map(|further| further.owed(change))
    }

    /// Finds whether all of the body is in air over a step. Returns the mass in kg to add to it if
    /// that has changed, and its velocity (m/s) then: the water that it takes along has its
    /// momentum, and keeps that when it is left behind.
    pub(super) fn meet(&mut self, body: &RigidBody, input: &Input<'_>) -> Option<(f64, Vector3<f64>)> {
        let sea = input.sea.filter(|_| self.added > 0.0 || self.further.is_some())?;
        let (turn, velocity) = (rotation(*body.rotation()), vector(body.linvel()));
        let centre = vector(body.translation()) + turn * self.hull.centre();
        // what is below by its centroid is wet, without a look at its shape
        let is_above = |centre: &Vector3<f64>| sea.depth(input.time, centre) < 0.0;
        let dry_at = |centre: &Vector3<f64>| is_above(centre) && self.wet(input, centre, &turn).volume <= 0.0;
        let dry = dry_at(&centre) && dry_at(&(centre + velocity * input.h));
        if dry == self.dry {
            return None;
        }
        let mass = f64::from(body.mass());
        let water = input.water.current(input.time, &centre) + sea.at(input.time, &centre).velocity;
        let (change, mut after) = if dry {
            (-self.added, velocity)
        } else {
            (self.added, (velocity * mass + water * self.added) / (mass + self.added))
        };
        if let Some(further) = self.further {
            let energy = |velocity: &Vector3<f64>| 0.5 * velocity.dot(&(further.at(&turn) * velocity));
            if dry {
                self.work -= energy(&velocity);
            } else {
                let both = after * (mass + self.added) + further.at(&turn) * water;
                after = further.mobility(mass + self.added, &turn) * both;
                self.work += energy(&after);
            }
        }
        self.work += 0.5 * ((mass + change) * after.norm_squared() - mass * velocity.norm_squared());
        self.forget();
        self.dry = dry;
        Some((change, after))
    }

    /// Forgets the last step.
    pub(super) fn forget(&mut self) {
        (self.memory, self.acting) = (Memory::default(), None);
    }

    /// Remembers rest at an attitude under known forces (N), and drag, that others balance.
    pub(super) fn rest(&mut self, known: Vector3<f64>, drag: Vector3<f64>, attitude: UnitQuaternion<f64>) {
        let carry = self.further().map(|_| Carry::at_rest(attitude, -known));
        // the length of a step in which nothing changed does not matter
        self.memory = Memory { velocity: Vector3::zeros(), step: 1.0, known, unknown: -known, drag, carry };
    }

    /// Returns the speed in m/s that no point of the body exceeds.
    pub(super) fn fastest(&self, body: &RigidBody) -> f64 {
        let arm = (self.hull.centre() - vector(body.local_center_of_mass())).norm() + self.hull.radius();
        f64::from(body.linvel().length()) + f64::from(body.angvel().length()) * arm
    }

    /// Returns the force on the body as it is, without a step.
    pub(super) fn at_rest(&self, body: &RigidBody, input: &Input<'_>) -> WaterForce {
        Member { memory: Memory::default(), ..self.clone() }.force(body, input).0
    }

    /// Returns the load on the body at rest with its centre of mass at a point (m) and an attitude:
    /// without a wave. It has a potential where there is no drag:
    ///
    /// ```text
    /// E = rho g V_s d, or rho V g.x without a surface;  + a g.x - u.R u/2        d: depth of the centroid of V_s
    /// ```
    pub(super) fn still(
        &self,
        input: &Input<'_>,
        (local, scale): (&Vector3<f64>, f64),
        (centre, rotation): (&Vector3<f64>, &UnitQuaternion<f64>),
    ) -> LoadThere {
        let &Input { water, sea, gravity, time, .. } = input;
        let arm = rotation * (self.hull.centre() - local);
        let wet = self.wet(input, &(centre + arm), rotation);
        let pressure = gravity * (-water.density * wet.volume);
        let lever = rotation * (wet.centre - local);
        let share = if self.floating > 0.0 { (wet.volume / self.floating).min(1.0) } else { 0.0 };
        let relative = rotation.inverse() * -water.current(time, &(centre + arm));
        let coefficient = self.immersed.drag_area * (0.5 * water.density * share);
        let drag = rotation * (coefficient.component_mul(&relative) * -relative.norm());
        let weight = gravity * (-scale * self.carried());
        // Munk's moment of a body at rest in a current
        let carried = self.further().map_or(Vector3::zeros(), |further| further.axes().component_mul(&relative));
        let munk = rotation * carried.cross(&relative);
        let of_water = match sea {
            Some(sea) => gravity.norm() * sea.depth(time, &(centre + lever)),
            None => gravity.dot(&(centre + lever)),
        };
        let energy = water.density * wet.volume * of_water - weight.dot(centre) - 0.5 * carried.dot(&relative);
        LoadThere {
            force: pressure + drag + weight,
            moment: lever.cross(&pressure) + arm.cross(&drag) + munk,
            energy: (relative == Vector3::zeros() || self.immersed.drag_area == Vector3::zeros()).then_some(energy),
        }
    }

    /// Returns the angular frequency in rad/s of heave, `sqrt(rho g A/m)` with the area A of the
    /// surface through the centroid, of a body that the surface reaches within `dt` (s).
    pub(super) fn heave(
        &self,
        body: &RigidBody,
        sea: &Sea,
        (time, dt): (f64, f64),
        (density, gravity): (f64, f64),
    ) -> f64 {
        let turn = rotation(*body.rotation());
        let centre = vector(body.translation()) + turn * self.hull.centre();
        let reach = self.hull.radius() + dt * (vector(body.linvel()).norm() + 0.5 * gravity * dt);
        if sea.depth(time, &centre).abs() > reach {
            return 0.0;
        }
        let (normal, small) = (turn.inverse() * sea.up(), SMALL_ANGLE * self.hull.radius());
        let [below, above] = [small, -small].map(|depth| self.hull.below(&normal, depth).volume);
        let mass = f64::from(body.mass());
        let mass =
            self.further().map_or(mass, |further| 1.0 / sea.up().dot(&(further.mobility(mass, &turn) * sea.up())));
        (density * gravity * (below - above) / (2.0 * small * mass)).sqrt()
    }

    /// Returns the angular frequency in rad/s with which the body swings at most by Munk's moment.
    pub(super) fn swing(&self, body: &RigidBody, water: &Water, time: f64) -> f64 {
        let Some(further) = self.further() else { return 0.0 };
        let turn = rotation(*body.rotation());
        let centre = vector(body.translation()) + turn * self.hull.centre();
        let velocity = turn.inverse() * (vector(body.linvel()) - water.current(time, &centre));
        further.fastest_swing(f64::from(body.mass()), &velocity, &symmetric_inertia(body).diagonal())
    }

    /// Returns the length in m that goes with a radian.
    pub(super) fn radius(&self) -> f64 {
        self.hull.radius()
    }

    /// Adds the force of a step to that of the user.
    pub(super) fn put_on(&mut self, body: &mut RigidBody, input: &Input<'_>) {
        let memory = self.memory;
        let (force, turned, further) = self.force(body, input);
        let (centre, scale) = (vector(body.local_center_of_mass()), f64::from(body.gravity_scale()));
        let balance = input.gravity * (-scale * self.carried());
        let sum = force.pressure + force.drag + force.inertia + balance;
        let sum = further.map_or(sum, |further| sum + further.force);
        let moment = (turned * (force.pressure_point - centre)).cross(&force.pressure)
            + (turned * (force.drag_point - centre)).cross(&force.drag)
            + force.moment;
        let own = [body.user_force(), body.user_torque()];
        body.add_force(to_vector(&sum), false);
        body.add_torque(to_vector(&moment), false);
        let with = [body.user_force(), body.user_torque()];
        let place = (vector(body.center_of_mass()), rotation(*body.rotation()));
        let velocity = [vector(body.linvel()), vector(body.angvel())];
        self.acting = Some(Acting { own, with, memory, place, velocity, balance, lead: input.lead / input.h, further });
    }

    /// Takes the force of the last step off a body, if it is still there: after the step, whose
    /// work it adds, or without one.
    pub(super) fn take_off(&mut self, body: Option<&mut RigidBody>, stepped: bool) {
        let Some(acting) = self.acting.take() else { return };
        let Acting { own, with, memory, place, velocity, balance, lead, further } = acting;
        if !stepped {
            self.memory = memory;
        }
        let Some(body) = body else { return };
        // what others added since stays
        let now = [body.user_force(), body.user_torque()];
        let [force, torque] = [0, 1].map(|i| if now[i] == with[i] { own[i] } else { now[i] - (with[i] - own[i]) });
        body.reset_forces(false);
        body.reset_torques(false);
        body.add_force(force, false);
        body.add_torque(torque, false);
        if stepped {
            let turn = (rotation(*body.rotation()) * place.1.inverse()).scaled_axis();
            let [force, torque] = [0, 1].map(|i| vector(with[i]) - vector(own[i]));
            let moved = vector(body.center_of_mass()) - place.0;
            self.work += (force - balance).dot(&moved) + torque.dot(&turn);
            let [dv, dw] = [vector(body.linvel()) - velocity[0], vector(body.angvel()) - velocity[1]];
            self.substeps += lead * (f64::from(body.mass()) * dv.norm_squared() + dw.dot(&(world_inertia(body) * dw)));
            if let Some(further) = further {
                let (force, moment) = (further.force, further.moment);
                self.work += further.work_of_current() - force.dot(&moved) - moment.dot(&turn);
                self.substeps -= lead * self.memory.step * (force.dot(&dv) + moment.dot(&dw));
                let attitude = rotation(*body.rotation());
                self.memory.carry = Some(match body.is_sleeping() {
                    true => Carry::at_rest(attitude, -self.memory.known),
                    false => further.ended([&dv, &dw], attitude),
                });
            }
        }
    }

    /// Returns the mean force over a step with the attitude in its middle, and what further mass
    /// adds to it, and remembers what the next step needs.
    fn force(&mut self, body: &RigidBody, input: &Input<'_>) -> (WaterForce, UnitQuaternion<f64>, Option<FurtherStep>) {
        let &Input { water, sea, gravity, time, h, lead } = input;
        let (rho, half) = (water.density, 0.5 * h);
        let (mass, velocity, spin) = (f64::from(body.mass()), vector(body.linvel()), vector(body.angvel()));
        let weight = gravity * ((mass - self.carried()) * f64::from(body.gravity_scale()));
        let known = weight + vector(body.user_force());
        let unknown = self.unknown(mass, &velocity);
        let turned = UnitQuaternion::from_scaled_axis(spin * half) * rotation(*body.rotation());
        let arm = turned * (self.hull.centre() - vector(body.local_center_of_mass()));
        let start = vector(body.center_of_mass()) - velocity * lead + arm;
        let up = sea.map_or(Vector3::zeros(), |sea| sea.up());
        let across = velocity - up * up.dot(&velocity);
        let place = Place { centre: start + across * half, rotation: turned };
        let mut step = self.further().map(|further| {
            let wave = sea.map_or(Vector3::zeros(), |sea| sea.at(time, &place.centre).velocity);
            let current = water.current(time, &place.centre) + wave;
            (further, further.at(&turned), FurtherStep::new(further, body, self.memory.carry.as_ref(), current, h))
        });
        let others = step.as_ref().map_or(known + unknown, |(.., step)| known + unknown + step.turning());
        let moments = symmetric_inertia(body).diagonal();
        let least = moments.iter().copied().filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min);
        // what a force at the centroid feels of the mass
        let felt = |mass: f64| 1.0 / (1.0 / mass + arm.norm_squared() / least);
        let to_body = |x: &Vector3<f64>| turned.inverse() * x;
        let masses = match &step {
            None => Vector3::repeat(felt(mass)),
            Some((further, ..)) => further.axes().map(|beyond| felt(mass + beyond)),
        };
        // the force in N by which all of the mass but Rapier's is accelerated
        let beyond = |acceleration: &Vector3<f64>| match &step {
            None => Vector3::zeros(),
            Some((_, beyond, _)) => beyond * acceleration,
        };
        // the way in m along up that a force moves the body in the step
        let lifted = |force: &Vector3<f64>| match &step {
            None => h * half / mass * up.dot(force),
            Some((.., step)) => h * half * up.dot(&(step.mobility * force)),
        };
        // all of it for a mean volume and a rise, with drag by its mean or, implicit, at the mean
        // velocity
        let acting = |(volume, rise): (f64, f64), implicit: bool| {
            let middle = place.centre + up * (0.5 * rise);
            let wet = self.wet(input, &middle, &turned);
            let at = sea.map(|sea| sea.at(time, &(middle + turned * (wet.centre - self.hull.centre()))));
            let acceleration = at.map_or(Vector3::zeros(), |at| at.acceleration);
            let share = if self.floating > 0.0 { (volume / self.floating).min(1.0) } else { 0.0 };
            let pressure = acceleration * (rho * wet.volume) - gravity * (rho * volume);
            let inertia = acceleration * (share * self.added) + beyond(&acceleration) * share;
            let wave = sea.map_or(Vector3::zeros(), |sea| sea.at(time, &middle).velocity);
            let relative = to_body(&(velocity + spin.cross(&arm) - water.current(time, &middle) - wave));
            let factor = 0.5 * rho * share;
            let coefficient = self.immersed.drag_area * factor;
            let forces = to_body(&(others + pressure + inertia - acceleration * mass - beyond(&acceleration)));
            let drag = if h <= 0.0 {
                -coefficient.component_mul(&relative) * relative.norm()
            } else if implicit {
                let gained = forces.component_mul(&masses.map(|felt| 0.5 * h / felt));
                midpoint(&masses, &coefficient, &(relative + gained), h)
            } else {
                mean_drag(&masses, &coefficient, &relative, &forces, h)
            };
            InStep { middle, wet, pressure, inertia, factor, drag: turned * drag }
        };
        let rising = self.rising(input, &place);
        let by_volume = match &step {
            None => h * half / mass * rho * -gravity.dot(&up),
            Some(_) => lifted(&(gravity * -rho)),
        };
        let without_buoyancy = |drag: &Vector3<f64>| h * up.dot(&velocity) + lifted(&(others + drag));
        let risen = |drag: &Vector3<f64>| {
            rising.as_ref().map_or((self.hull.volume(), 0.0), |rising| rising.solve(without_buoyancy(drag), by_volume))
        };
        let mut drag = self.memory.drag;
        let mut rounds = 0;
        let now = loop {
            let now = acting(risen(&drag), false);
            let change = now.drag - drag;
            // buoyancy depends on how far drag lets the body go
            if rising.is_none() || h <= 0.0 || change.norm() <= SAME_DRAG * (drag.norm() + weight.norm()) {
                break now;
            }
            rounds += 1;
            drag += change * if rounds < STEP_ROUNDS / 2 { 1.0 } else { 0.5 };
            if let Some(rising) = rising.as_ref().filter(|_| rounds > STEP_ROUNDS) {
                // the rise that drag and buoyancy give, which fall as it grows, by bisection
                // between what neither exceeds
                let wave = sea.map_or(Vector3::zeros(), |sea| sea.at(time, &place.centre).velocity);
                let still = h * up.dot(&(water.current(time, &place.centre) + wave));
                let free = without_buoyancy(&Vector3::zeros());
                let (low, high) =
                    (free.min(still).min(0.0), (free + by_volume * self.hull.volume()).max(still).max(0.0));
                let solved = |implicit: bool| {
                    let with = |rise: f64| acting((rising.mean_volume(rise), rise), implicit);
                    let excess = |rise: f64| {
                        let by_buoyancy = by_volume * rising.mean_volume(rise);
                        without_buoyancy(&with(rise).drag) + by_buoyancy - rise
                    };
                    let rise = bisect(low, high, excess);
                    (with(rise), excess(rise).abs() <= SAME_DRAG * (high - low))
                };
                // the mean of drag that does work jumps to that of the mean velocity: there may be
                // no root but by the latter
                let (decaying, found) = solved(false);
                break if found { decaying } else { solved(true).0 };
            }
        };
        let InStep { middle, wet, pressure, inertia, factor, drag } = now;
        let inertias = moments.map(|x| if x > 0.0 { x } else { f64::INFINITY });
        let torque = (turned * (wet.centre - vector(body.local_center_of_mass()))).cross(&pressure);
        let inertia_matrix = symmetric_inertia(body);
        let known = known + pressure + inertia + drag;
        let righting = self.righting(input, &(middle - arm), &turned, &inertia_matrix, body);
        let beside = match &mut step {
            None => righting,
            Some((.., step)) => {
                // without the lead of the substeps
                step.add_munk([known, unknown], UnitQuaternion::from_scaled_axis(-spin * lead) * turned);
                righting + step.moment
            }
        };
        let moments = torque + beside + arm.cross(&drag) + vector(body.user_torque());
        let torque = to_body(&moments);
        let spin_drag = mean_drag(&inertias, &(self.immersed.spin_drag * factor), &to_body(&spin), &torque, h);
        if let Some((.., step)) = &mut step {
            step.complete(body, &acceleration(body, &(moments + turned * spin_drag)), lead);
        }
        let carry = self.memory.carry;
        self.memory = Memory { velocity, step: h, known, unknown: self.memory.unknown, drag, carry };
        let force = WaterForce {
            pressure,
            pressure_point: wet.centre,
            drag,
            drag_point: self.hull.centre(),
            inertia,
            moment: turned * spin_drag + beside,
            wet: wet.volume / self.hull.volume(),
        };
        (force, turned, step.map(|(.., step)| step))
    }

    /// Returns by how much the mean righting moment over a step, that at the attitude in its middle
    /// to first order, exceeds that at the attitude of a uniform rotation: x - t with (I + h^2/4 K)
    /// I^-1 x = t, K the derivative of the moment t by the rotation.
    fn righting(
        &self,
        input: &Input<'_>,
        mass_centre: &Vector3<f64>,
        turned: &UnitQuaternion<f64>,
        inertia: &Matrix3<f64>,
        body: &RigidBody,
    ) -> Vector3<f64> {
        let Input { h, water, gravity, .. } = *input;
        if h <= 0.0 || *inertia == Matrix3::zeros() {
            return Vector3::zeros();
        }
        let local = vector(body.local_center_of_mass());
        let moment = |rotation: UnitQuaternion<f64>| {
            let wet = self.wet(input, &(mass_centre + rotation * (self.hull.centre() - local)), &rotation);
            (rotation * (wet.centre - local)).cross(&(gravity * (-water.density * wet.volume)))
        };
        let column = |axis: usize| {
            let by = |angle: f64| moment(UnitQuaternion::from_scaled_axis(Vector3::ith(axis, angle)) * turned);
            (by(-SMALL_ANGLE) - by(SMALL_ANGLE)) / (2.0 * SMALL_ANGLE)
        };
        let stiffness = Matrix3::from_columns(&[column(0), column(1), column(2)]);
        let rotation = turned.to_rotation_matrix();
        let inertia = rotation * inertia * rotation.transpose();
        let sum = inertia + (stiffness + stiffness.transpose()) * (0.125 * h * h);
        let uniform = moment(*turned);
        // a float that turns over within the step has no stiffness that counts
        sum.cholesky().map_or(Vector3::zeros(), |sum| inertia * sum.solve(&uniform) - uniform)
    }

    /// Returns what cables, contacts and joints are expected to do, in N: what they did in the last
    /// two steps, by the smaller of the two where they agree in sign.
    fn unknown(&mut self, mass: f64, velocity: &Vector3<f64>) -> Vector3<f64> {
        let memory = &mut self.memory;
        if memory.step <= 0.0 {
            memory.unknown = Vector3::zeros();
            return Vector3::zeros();
        }
        let last = match &memory.carry {
            Some(carry) => carry.others,
            None => (velocity - memory.velocity) * (mass / memory.step) - memory.known,
        };
        let before = core::mem::replace(&mut memory.unknown, last);
        lasting(&last, &before)
    }

    /// Returns what is below the surface with the centroid of the whole at a point.
    fn wet(&self, input: &Input<'_>, centre: &Vector3<f64>, rotation: &UnitQuaternion<f64>) -> Wet {
        let Some(sea) = input.sea else {
            return self.hull.below(&Vector3::y(), f64::INFINITY);
        };
        let normal = sea.normal(input.time, centre);
        // along up from the surface to the centre, across the plane that it is
        let depth = sea.depth(input.time, centre) * normal.dot(&sea.up());
        self.hull.below(&(rotation.inverse() * normal), depth)
    }

    /// Returns the body over the surface as it rises from where it is; `None` without a surface.
    fn rising(&self, input: &Input<'_>, place: &Place) -> Option<Rising<'_>> {
        let sea = input.sea?;
        let normal = sea.normal(input.time, &place.centre);
        let tilt = normal.dot(&sea.up());
        let depth = sea.depth(input.time, &place.centre) * tilt;
        Some(Rising::new(&self.hull, place.rotation.inverse() * normal, tilt, depth))
    }
}
