//! The bodies of a world that are in water, and the forces on them in a host step.

use super::drag::mean_drag;
use super::hull::{Hull, Wet};
use crate::convert::{rotation, symmetric_inertia, to_vector, vector};
use crate::error::Error;
use crate::scales::water::HEIGHT_ROUNDS;
use ::nalgebra::{UnitQuaternion, Vector3};
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

/// Force and moment of the water on a body about its centre of mass, without what balances the
/// weight of the added mass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct WaterForce {
    /// Buoyancy and the pressure of the wave in N.
    pub pressure: Vector3<f64>,
    /// Where it acts in m, in world axes.
    pub centre: Vector3<f64>,
    /// Drag in N.
    pub drag: Vector3<f64>,
    /// Where it acts in m.
    pub drag_point: Vector3<f64>,
    /// Force of the wave on the added mass, in N, through the centre of mass.
    pub inertia: Vector3<f64>,
    /// Moment of the drag of rotation in N m.
    pub spin_drag: Vector3<f64>,
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
    /// [`Error::NoBody`]; [`Error::NotDynamic`]; [`Error::WaterValue`]; [`Error::NoVolume`] for a body
    /// without a collider that encloses one, and without a volume of its own.
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
    /// forces of all bodies; reset those of the last step before. Bodies that are no longer in the
    /// world are left out; those that sleep in water without a wave sleep on.
    pub fn apply(&mut self, world: &mut PhysicsWorld, time: f64, dt: f64) {
        let gravity = vector(world.gravity);
        let BodiesInWater { water, members } = self;
        let sea = water.flow.surface.as_ref().map(|surface| surface.sea());
        let moves = water.wave().is_some() || !water.flow.history.is_empty();
        for member in members {
            let Some(body) = world.bodies.get_mut(member.body) else { continue };
            if !body.is_dynamic() || !body.is_enabled() || dt <= 0.0 || (body.is_sleeping() && !moves) {
                member.memory = Memory::default();
                continue;
            }
            let input = Input { water, sea: sea.as_ref(), gravity, time: time + 0.5 * dt, h: dt };
            let force = member.force(body, &input);
            let centre = vector(body.center_of_mass()) + vector(body.linvel()) * (0.5 * dt);
            let scale = f64::from(body.gravity_scale());
            let sum = force.pressure + force.drag + force.inertia - gravity * (scale * member.added);
            let moment = (force.centre - centre).cross(&force.pressure)
                + (force.drag_point - centre).cross(&force.drag)
                + force.spin_drag;
            body.add_force(to_vector(&sum), true);
            body.add_torque(to_vector(&moment), true);
        }
    }

    /// Returns the force of the water on a body as it is at a time in s, without a wave and with drag
    /// as of a body at rest: what statics take. `None` for a body that is not in it.
    pub fn at_rest(&self, world: &PhysicsWorld, body: RigidBodyHandle, time: f64) -> Option<WaterForce> {
        let member = self.members.iter().find(|m| m.body == body)?;
        let mut water = self.water.clone();
        if let Some(surface) = &mut water.flow.surface {
            surface.wave = None;
        }
        let sea = water.flow.surface.as_ref().map(|surface| surface.sea());
        let input = Input { water: &water, sea: sea.as_ref(), gravity: vector(world.gravity), time, h: 0.0 };
        let mut still = world.bodies.get(body)?.clone();
        still.set_linvel(Vector::ZERO, false);
        still.set_angvel(Vector::ZERO, false);
        Some(Member { memory: Memory::default(), ..member.clone() }.force(&still, &input))
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
}

/// A body in the middle of a step.
struct Place {
    /// Centroid of its volume in m.
    centre: Vector3<f64>,
    rotation: UnitQuaternion<f64>,
}

impl Member {
    /// Returns the mean force over a step, and remembers what the next one needs.
    fn force(&mut self, body: &RigidBody, input: &Input<'_>) -> WaterForce {
        let &Input { water, sea, gravity, time, h } = input;
        let (rho, half) = (water.density, 0.5 * h);
        let (mass, velocity, spin) = (f64::from(body.mass()), vector(body.linvel()), vector(body.angvel()));
        let own = mass - self.added;
        let weight = gravity * (own * f64::from(body.gravity_scale()));
        let user = vector(body.user_force());
        let unknown = self.unknown(mass, &velocity);
        let turned = UnitQuaternion::from_scaled_axis(spin * half) * rotation(*body.rotation());
        let mass_centre = vector(body.center_of_mass()) + velocity * half;
        let arm = turned * (self.hull.centre() - vector(body.local_center_of_mass()));
        let mut place = Place { centre: mass_centre + arm, rotation: turned };
        let others = weight + user + unknown + self.memory.drag;
        let rise = sea.map_or(0.0, |sea| self.rise(input, sea, &place, others.dot(&sea.up()), mass));
        let shift = sea.map_or(Vector3::zeros(), |sea| sea.up() * rise);
        place.centre += shift;
        let wet = self.wet(input, &place);
        let pressed = place.centre + turned * (wet.centre - self.hull.centre());
        let at = sea.map(|sea| sea.at(time, &pressed));
        let acceleration = at.map_or(Vector3::zeros(), |at| at.acceleration);
        let share = if self.floating > 0.0 { (wet.volume / self.floating).min(1.0) } else { 0.0 };
        let pressure = (acceleration - gravity) * (rho * wet.volume);
        let inertia = acceleration * (share * self.added);
        let wave = sea.map_or(Vector3::zeros(), |sea| sea.at(time, &place.centre).velocity);
        let flow = water.current(time, &place.centre) + wave;
        // drag, in axes of the body
        let to_body = |x: &Vector3<f64>| turned.inverse() * x;
        let relative = to_body(&(velocity + spin.cross(&arm) - flow));
        let moments = symmetric_inertia(body).diagonal();
        let least = moments.iter().copied().filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min);
        let felt = 1.0 / (1.0 / mass + arm.norm_squared() / least);
        let forces = weight + user + unknown + pressure + inertia - acceleration * mass;
        let factor = 0.5 * rho * share;
        let (drag, spin_drag) = if h > 0.0 {
            let drag =
                mean_drag(&Vector3::repeat(felt), &(self.immersed.drag_area * factor), &relative, &to_body(&forces), h);
            let torque = vector(body.user_torque()) + (pressed - shift - mass_centre).cross(&pressure);
            let inertias = moments.map(|x| if x > 0.0 { x } else { f64::INFINITY });
            let coefficient = self.immersed.spin_drag * factor;
            (drag, mean_drag(&inertias, &coefficient, &to_body(&spin), &to_body(&torque), h))
        } else {
            (-self.immersed.drag_area.component_mul(&relative) * (factor * relative.norm()), Vector3::zeros())
        };
        let drag = turned * drag;
        let known = weight + user + pressure + inertia + drag;
        self.memory = Memory { velocity, step: h, known, unknown: self.memory.unknown, drag };
        WaterForce {
            pressure,
            // forces are given to the body without the rise, which is part of the step
            centre: pressed - shift,
            drag,
            drag_point: place.centre - shift,
            inertia,
            spin_drag: turned * spin_drag,
            wet: wet.volume / self.hull.volume(),
        }
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

    /// Returns what is below the surface at a place.
    fn wet(&self, input: &Input<'_>, place: &Place) -> Wet {
        let Some(sea) = input.sea else {
            return self.hull.below(&Vector3::y(), f64::INFINITY);
        };
        let normal = sea.normal(input.time, &place.centre);
        // along up from the surface to the centre, across the plane that it is
        let depth = sea.depth(input.time, &place.centre) * normal.dot(&sea.up());
        self.hull.below(&(place.rotation.inverse() * normal), depth)
    }

    /// Returns by how much the middle of the step is above that of a uniform motion, in m: the root
    /// of r = h^2/4m (f + rho g V_s(r)), which has one, since V_s falls.
    fn rise(&self, input: &Input<'_>, sea: &Sea, place: &Place, others: f64, mass: f64) -> f64 {
        let factor = input.h * input.h / (4.0 * mass);
        let weight = input.water.density * -input.gravity.dot(&sea.up());
        let excess = |r: f64| {
            let at = Place { centre: place.centre + sea.up() * r, rotation: place.rotation };
            factor * (others + weight * self.wet(input, &at).volume) - r
        };
        let [mut low, mut high] = [factor * others, factor * (others + weight.max(0.0) * self.hull.volume())];
        let [mut at_low, mut at_high] = [excess(low), excess(high)];
        if at_low <= 0.0 || low >= high {
            return low;
        }
        if at_high >= 0.0 {
            return high;
        }
        // false position after Illinois
        let mut side = 0;
        let mut root = low;
        for _ in 0..HEIGHT_ROUNDS {
            root = low + (high - low) * (at_low / (at_low - at_high));
            let here = excess(root);
            if here == 0.0 || (high - low).abs() <= f64::EPSILON * self.hull.radius() {
                break;
            }
            if here > 0.0 {
                (low, at_low) = (root, here);
                at_high *= if side == 1 { 0.5 } else { 1.0 };
                side = 1;
            } else {
                (high, at_high) = (root, here);
                at_low *= if side == -1 { 0.5 } else { 1.0 };
                side = -1;
            }
        }
        root
    }
}
