//! The bodies of a world that are in water, and the forces on them in a host step.

use super::drag::{mean_drag, midpoint};
use super::hull::{Hull, Wet};
use crate::convert::{rotation, symmetric_inertia, to_vector, vector};
use crate::error::Error;
use crate::scales::water::{HEIGHT_ROUNDS, SAME_DRAG, SMALL_ANGLE, SMALLEST_RISE, STEP_ROUNDS};
use crate::set::CableSet;
use ::nalgebra::{Matrix3, UnitQuaternion, Vector3};
use lariat_ancf::{Sea, Water};
use rapier::dynamics::{MassProperties, RigidBody, RigidBodyHandle};
use rapier::math::{Real, Vector};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// What water does to a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Immersed {
    /// Displaced volume in m^3, > 0. Default: that of its colliders.
    pub volume: Option<f64>,
    /// Drag coefficient times area in m^2, along the axes of the body, >= 0. Default: none.
    pub drag_area: Vector3<f64>,
    /// Coefficient of the quadratic drag of rotation in m^5, about the axes of the body, >= 0.
    /// Default: none.
    pub spin_drag: Vector3<f64>,
    /// Coefficient of added mass C_a, >= 0, on the mass that the body displaces when it floats, or
    /// all of it if it sinks: 0.5 of a sphere, 1 of a long cylinder across. Default: none.
    pub added_mass: f64,
}

impl Immersed {
    /// Creates buoyancy and drag of a body, by drag coefficient times area (m^2) along its axes.
    pub fn with_drag_area(drag_area: impl Into<[f64; 3]>) -> Self {
        Immersed { drag_area: drag_area.into().into(), ..Immersed::default() }
    }

    /// Returns the same with a coefficient of added mass.
    pub fn with_added_mass(mut self, coefficient: f64) -> Self {
        self.added_mass = coefficient;
        self
    }

    /// Returns the same with a displaced volume in m^3.
    pub fn with_volume(mut self, volume: f64) -> Self {
        self.volume = Some(volume);
        self
    }

    fn check(&self, body: RigidBodyHandle) -> Result<(), Error> {
        let numbers = [("volume (m^3)", self.volume.unwrap_or(1.0), self.volume.is_none_or(|v| v > 0.0))];
        let areas = self.drag_area.iter().map(|&x| ("drag area (m^2)", x, x >= 0.0));
        let spins = self.spin_drag.iter().map(|&x| ("drag of rotation (m^5)", x, x >= 0.0));
        let added = [("coefficient of added mass", self.added_mass, self.added_mass >= 0.0)];
        let wrong = |&(_, x, fine): &(&str, f64, bool)| !(x.is_finite() && fine);
        match numbers.into_iter().chain(areas).chain(spins).chain(added).find(wrong) {
            None => Ok(()),
            Some((what, value, _)) => Err(Error::WaterValue { body, what, value }),
        }
    }
}

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
}

/// A body in water.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Member {
    body: RigidBodyHandle,
    hull: Hull,
    immersed: Immersed,
    /// Added mass in kg, part of that of the body.
    added: f64,
    /// Volume in m^3 that it displaces when it floats.
    floating: f64,
    memory: Memory,
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
    /// Moment in N m beside that of the forces, world axes: drag of rotation, and what makes the
    /// righting moment that of the middle of the step.
    pub moment: Vector3<f64>,
    /// Share of the volume that is wet.
    pub wet: f64,
}

/// The bodies of a world that are in water.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BodiesInWater {
    water: Water,
    members: Vec<Member>,
}

impl BodiesInWater {
    /// Creates water without bodies.
    ///
    /// # Errors
    /// [`Error::Cable`] for numbers out of range.
    pub fn new(water: Water) -> Result<Self, Error> {
        water.check()?;
        Ok(BodiesInWater { water, members: Vec::new() })
    }

    /// Returns the water.
    pub fn water(&self) -> &Water {
        &self.water
    }

    /// Changes the water for the coming steps; bodies keep their added mass.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn set_water(&mut self, water: Water) -> Result<(), Error> {
        water.check()?;
        self.water = water;
        Ok(())
    }

    /// Returns whether there are no bodies.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// Returns the bodies.
    pub fn bodies(&self) -> impl Iterator<Item = RigidBodyHandle> {
        self.members.iter().map(|member| member.body)
    }

    /// Returns volume (m^3) and added mass (kg) of a body.
    pub fn volume_and_added_mass(&self, body: RigidBodyHandle) -> Option<(f64, f64)> {
        self.members.iter().find(|m| m.body == body).map(|m| (m.hull.volume(), m.added))
    }

    /// Puts a dynamic body into the water, with its present mass and colliders, and adds its added
    /// mass to that of the body, at its centre of mass. One that is in it already is taken out
    /// first.
    ///
    /// # Errors
    /// [`Error::NoBody`]; [`Error::NotDynamic`]; [`Error::WaterValue`]; [`Error::NoVolume`] for a
    /// body without a collider that encloses one, and without a volume of its own.
    pub fn insert(&mut self, world: &mut PhysicsWorld, body: RigidBodyHandle, immersed: Immersed) -> Result<(), Error> {
        immersed.check(body)?;
        let own = world.bodies.get(body).ok_or(Error::NoBody(body))?;
        if !own.is_dynamic() {
            return Err(Error::NotDynamic(body));
        }
        let solid = own.colliders().iter().filter_map(|&c| world.colliders.get(c)).filter(|c| !c.is_sensor());
        let shapes = solid.map(|collider| {
            let pose = collider.position_wrt_parent().copied().unwrap_or_default();
            (collider.shape(), vector(pose.translation), rotation(pose.rotation))
        });
        let hull = match (Hull::of_shapes(shapes), immersed.volume) {
            (Some(hull), None) => hull,
            (Some(hull), Some(volume)) => hull.with_volume(volume),
            (None, Some(volume)) => {
                let centre = vector(own.local_center_of_mass());
                Hull::ball(volume, centre).ok_or(Error::NoVolume(body))?
            }
            (None, None) => return Err(Error::NoVolume(body)),
        };
        self.remove(world, body);
        let density = self.water.density;
        crate::body::give_mass(world, body);
        crate::body::update_mass(world, body);
        let mass = f64::from(world.bodies[body].mass());
        let floating = hull.volume().min(mass / density);
        let added = f64::from((immersed.added_mass * density * floating) as Real);
        add_mass(world, body, added);
        self.members.push(Member { body, hull, immersed, added, floating, memory: Memory::default() });
        Ok(())
    }

    /// Takes a body out of the water, and its added mass from it; returns whether it was in it.
    pub fn remove(&mut self, world: &mut PhysicsWorld, body: RigidBodyHandle) -> bool {
        let Some(i) = self.members.iter().position(|m| m.body == body) else { return false };
        let member = self.members.remove(i);
        if world.bodies.contains(body) {
            add_mass(world, body, -member.added);
        }
        true
    }

    /// Adds the forces of the water over a host step from `time` (s), of length `dt` (s), to the
    /// forces of all bodies; reset those of the last step before, and step `cables` after. Bodies
    /// that are no longer in the world are left out; those that sleep in water without a wave sleep
    /// on.
    pub fn apply(&mut self, world: &mut PhysicsWorld, cables: &CableSet, time: f64, dt: f64) {
        if dt <= 0.0 {
            return;
        }
        let gravity = vector(world.gravity);
        let BodiesInWater { water, members } = self;
        let sea = water.flow.surface.as_ref().map(|surface| surface.sea());
        let moves = water.wave().is_some() || !water.flow.history.is_empty();
        let substeps =
            world.integration_parameters.num_solver_iterations.max(1) as f64 * cables.rapier_steps(world, dt);
        for member in members {
            let Some(body) = world.bodies.get_mut(member.body) else { continue };
            if !body.is_dynamic() || !body.is_enabled() || (body.is_sleeping() && !moves) {
                member.memory = Memory::default();
                continue;
            }
            // Rapier's substeps move a body further by a constant force than the force would
            let lead = if cables.moves(member.body) { 0.0 } else { 0.5 * dt / substeps };
            let input = Input { water, sea: sea.as_ref(), gravity, time: time + 0.5 * dt, h: dt, lead };
            let (force, turned) = member.force(body, &input);
            let (centre, scale) = (vector(body.local_center_of_mass()), f64::from(body.gravity_scale()));
            let sum = force.pressure + force.drag + force.inertia - gravity * (scale * member.added);
            let moment = (turned * (force.pressure_point - centre)).cross(&force.pressure)
                + (turned * (force.drag_point - centre)).cross(&force.drag)
                + force.moment;
            body.add_force(to_vector(&sum), moves);
            body.add_torque(to_vector(&moment), moves);
        }
    }

    /// Returns the force of the water on a body as it is at a time in s, without a wave and with
    /// drag as of a body at rest: what statics take. `None` for a body that is not in it.
    pub fn at_rest(&self, world: &PhysicsWorld, body: RigidBodyHandle, time: f64) -> Option<WaterForce> {
        let member = self.members.iter().find(|m| m.body == body)?;
        let mut water = self.water.clone();
        if let Some(surface) = &mut water.flow.surface {
            surface.wave = None;
        }
        let sea = water.flow.surface.as_ref().map(|surface| surface.sea());
        let gravity = vector(world.gravity);
        let input = Input { water: &water, sea: sea.as_ref(), gravity, time, h: 0.0, lead: 0.0 };
        let mut still = world.bodies.get(body)?.clone();
        still.set_linvel(Vector::ZERO, false);
        still.set_angvel(Vector::ZERO, false);
        Some(Member { memory: Memory::default(), ..member.clone() }.force(&still, &input).0)
    }
}

/// Adds a mass (kg) at the centre of mass of a body, which is not felt by gravity.
fn add_mass(world: &mut PhysicsWorld, handle: RigidBodyHandle, mass: f64) {
    if mass == 0.0 {
        return;
    }
    let PhysicsWorld { bodies, colliders, .. } = world;
    let Some(body) = bodies.get_mut(handle) else { return };
    let before = body.mass_properties().local_mprops;
    // what colliders give, to know what is beside them
    body.set_additional_mass_properties(MassProperties::default(), false);
    body.recompute_mass_properties_from_colliders(colliders);
    let of_colliders = body.mass_properties().local_mprops;
    let point = |mass: Real| MassProperties::new(before.local_com, mass, Vector::ZERO);
    let beside = if of_colliders.inv_mass > 0.0 { before - of_colliders } else { before };
    let beside = if of_colliders == before { MassProperties::default() } else { beside };
    let with = if mass > 0.0 { beside + point(mass as Real) } else { beside - point(-mass as Real) };
    body.set_additional_mass_properties(with, true);
    body.recompute_mass_properties_from_colliders(colliders);
}

/// What the force of a step depends on.
struct Input<'a> {
    water: &'a Water,
    sea: Option<&'a Sea>,
    gravity: Vector3<f64>,
    /// Middle of the step in s.
    time: f64,
    h: f64,
    /// Time in s by which the position is ahead of one that a constant force moves exactly.
    lead: f64,
}

/// A body in a step.
struct Place {
    /// Centroid of its volume in m, in the middle of the step but for the height, at its beginning.
    centre: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
    mass: f64,
    velocity: Vector3<f64>,
}

impl Member {
    /// Returns the mean force over a step with the attitude in its middle, and remembers what the
    /// next one needs.
    fn force(&mut self, body: &RigidBody, input: &Input<'_>) -> (WaterForce, UnitQuaternion<f64>) {
        let &Input { water, sea, gravity, time, h, lead } = input;
        let (rho, half) = (water.density, 0.5 * h);
        let (mass, velocity, spin) = (f64::from(body.mass()), vector(body.linvel()), vector(body.angvel()));
        let weight = gravity * ((mass - self.added) * f64::from(body.gravity_scale()));
        let known = weight + vector(body.user_force());
        let others = known + self.unknown(mass, &velocity);
        let turned = UnitQuaternion::from_scaled_axis(spin * half) * rotation(*body.rotation());
        let arm = turned * (self.hull.centre() - vector(body.local_center_of_mass()));
        let start = vector(body.center_of_mass()) - velocity * lead + arm;
        let up = sea.map_or(Vector3::zeros(), |sea| sea.up());
        let across = velocity - up * up.dot(&velocity);
        let place = Place { centre: start + across * half, rotation: turned, mass, velocity };
        let moments = symmetric_inertia(body).diagonal();
        let least = moments.iter().copied().filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min);
        // what a force at the centroid feels of the mass
        let felt = 1.0 / (1.0 / mass + arm.norm_squared() / least);
        let to_body = |x: &Vector3<f64>| turned.inverse() * x;
        let mut drag = self.memory.drag;
        let mut rounds = 0;
        loop {
            let (volume, rise) = self.displaced(input, &place, up.dot(&(others + drag)));
            let middle = place.centre + up * (0.5 * rise);
            let wet = self.wet(input, &middle, &turned);
            let at = sea.map(|sea| sea.at(time, &(middle + turned * (wet.centre - self.hull.centre()))));
            let acceleration = at.map_or(Vector3::zeros(), |at| at.acceleration);
            let share = if self.floating > 0.0 { (wet.volume / self.floating).min(1.0) } else { 0.0 };
            let pressure = acceleration * (rho * wet.volume) - gravity * (rho * volume);
            let inertia = acceleration * (share * self.added);
            let wave = sea.map_or(Vector3::zeros(), |sea| sea.at(time, &middle).velocity);
            let relative = to_body(&(velocity + spin.cross(&arm) - water.current(time, &middle) - wave));
            let factor = 0.5 * rho * share;
            let coefficient = self.immersed.drag_area * factor;
            let forces = to_body(&(others + pressure + inertia - acceleration * mass));
            let masses = Vector3::repeat(felt);
            let mean = if h <= 0.0 {
                -coefficient.component_mul(&relative) * relative.norm()
            } else if rounds < STEP_ROUNDS / 4 {
                mean_drag(&masses, &coefficient, &relative, &forces, h)
            } else {
                midpoint(&masses, &coefficient, &(relative + forces * (0.5 * h / felt)), h)
            };
            let change = turned * mean - drag;
            // buoyancy depends on how far drag lets the body go
            let settled = sea.is_none() || change.norm() <= SAME_DRAG * (drag.norm() + weight.norm());
            if rounds > STEP_ROUNDS {
                // buoyancy is now that with this drag; one that would drive the body is none
                let actual = relative + (forces + to_body(&drag)) * (0.5 * h / felt);
                if to_body(&drag).dot(&actual) > 0.0 {
                    drag = Vector3::zeros();
                    continue;
                }
            } else if settled || h <= 0.0 {
                drag += change;
            } else {
                rounds += 1;
                drag += change * if rounds < STEP_ROUNDS / 2 { 1.0 } else { 0.5 };
                continue;
            }
            let inertias = moments.map(|x| if x > 0.0 { x } else { f64::INFINITY });
            let torque = (turned * (wet.centre - vector(body.local_center_of_mass()))).cross(&pressure);
            let inertia_matrix = symmetric_inertia(body);
            let righting = self.righting(input, &(middle - arm), &turned, &inertia_matrix, body);
            let torque = to_body(&(torque + righting + arm.cross(&drag) + vector(body.user_torque())));
            let spin_drag = mean_drag(&inertias, &(self.immersed.spin_drag * factor), &to_body(&spin), &torque, h);
            let known = known + pressure + inertia + drag;
            self.memory = Memory { velocity, step: h, known, unknown: self.memory.unknown, drag };
            let force = WaterForce {
                pressure,
                pressure_point: wet.centre,
                drag,
                drag_point: self.hull.centre(),
                inertia,
                moment: turned * spin_drag + righting,
                wet: wet.volume / self.hull.volume(),
            };
            return (force, turned);
        }
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
        let last = (velocity - memory.velocity) * (mass / memory.step) - memory.known;
        let before = core::mem::replace(&mut memory.unknown, last);
        last.zip_map(&before, |a, b| if a * b <= 0.0 { 0.0 } else { a.abs().min(b.abs()).copysign(a) })
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

    /// Returns the mean volume displaced over a step and the rise in it, in m: the root r of
    /// r = h v + h^2/2m (f + rho g V(r)), V(r) the mean over the rise, which falls with it.
    fn displaced(&self, input: &Input<'_>, place: &Place, others: f64) -> (f64, f64) {
        let whole = self.hull.volume();
        let Some(sea) = input.sea else { return (whole, 0.0) };
        let up = sea.up();
        let Input { h, water, gravity, .. } = input;
        let (factor, weight) = (h * h / (2.0 * place.mass), water.density * -gravity.dot(&up));
        let normal = sea.normal(input.time, &place.centre);
        let tilt = normal.dot(&up);
        let depth = sea.depth(input.time, &place.centre) * tilt;
        let normal = place.rotation.inverse() * normal;
        let below = |rise: f64| self.hull.below(&normal, depth - rise * tilt);
        // volume times the depth of its centroid: its derivative by the depth is the volume
        let moment = |wet: &Wet, rise: f64| {
            wet.volume * (depth / tilt - rise - normal.dot(&(wet.centre - self.hull.centre())) / tilt)
        };
        let first = below(0.0);
        let start = moment(&first, 0.0);
        let mean = |rise: f64| {
            let last = below(rise);
            if first.volume == last.volume && (first.volume == whole || first.volume == 0.0) {
                first.volume
            } else if rise.abs() < SMALLEST_RISE * self.hull.radius() {
                below(0.5 * rise).volume
            } else {
                ((start - moment(&last, rise)) / rise).clamp(0.0, whole)
            }
        };
        let uniform = h * up.dot(&place.velocity) + factor * others;
        let excess = |rise: f64, volume: f64| uniform + factor * weight * volume - rise;
        let (mut low, mut high) = (uniform, uniform + factor * weight.max(0.0) * whole);
        if low >= high {
            return (mean(low), low);
        }
        let [dry, wet] = [mean(low), mean(high)];
        let [mut at_low, mut at_high] = [excess(low, dry), excess(high, wet)];
        if at_low <= 0.0 {
            return (dry, low);
        }
        if at_high >= 0.0 {
            return (wet, high);
        }
        // false position after Illinois
        let (mut side, mut found) = (0, (dry, low));
        for _ in 0..HEIGHT_ROUNDS {
            let rise = low + (high - low) * (at_low / (at_low - at_high));
            let volume = mean(rise);
            let here = excess(rise, volume);
            found = (volume, rise);
            if here.abs() <= f64::EPSILON * self.hull.radius() {
                break;
            }
            if here > 0.0 {
                (low, at_low) = (rise, here);
                at_high *= if side == 1 { 0.5 } else { 1.0 };
                side = 1;
            } else {
                (high, at_high) = (rise, here);
                at_low *= if side == -1 { 0.5 } else { 1.0 };
                side = -1;
            }
        }
        found
    }
}
