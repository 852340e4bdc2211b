//! The bodies of a world that are in water.

use super::added_mass::Further;
use super::hull::Hull;
use super::immersed::Immersed;
use super::member::{Input, Member, WaterForce};
use super::still::StillWater;
use crate::convert::{rotation, to_vector, vector};
use crate::error::Error;
use ::nalgebra::{Matrix3, Vector3};
use lariat_ancf::Water;
use lariat_ancf::island::PlacedLoad;
use rapier::dynamics::{MassProperties, RigidBodyHandle};
use rapier::math::{Real, Vector};
use rapier::pipeline::PhysicsWorld;
use serde::{Deserialize, Serialize};

/// The bodies of a world that are in water, which a [set](crate::CableSet::set_water) steps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BodiesInWater {
    water: Water,
    members: Vec<Member>,
    /// In s.
    time: f64,
    /// Whether the water was changed, which wakes its bodies.
    #[serde(default)]
    changed: bool,
}

impl BodiesInWater {
    /// Creates water without bodies.
    ///
    /// # Errors
    /// [`Error::Cable`] for numbers out of range.
    pub fn new(water: Water) -> Result<Self, Error> {
        water.check()?;
        Ok(BodiesInWater { water, members: Vec::new(), time: 0.0, changed: false })
    }

    /// Returns the water.
    pub fn water(&self) -> &Water {
        &self.water
    }

    /// Changes the water for the coming steps; bodies wake up, and keep their added mass.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn set_water(&mut self, water: Water) -> Result<(), Error> {
        water.check()?;
        self.changed |= self.water != water;
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

    /// Returns what water does to a body that is in it.
    pub fn immersed(&self, body: RigidBodyHandle) -> Option<&Immersed> {
        self.members.iter().find(|m| m.body == body).map(|m| &m.immersed)
    }

    /// Returns the added mass in kg that is in the mass of a body now, the least of that along its
    /// axes: none of one in air, or in no water.
    pub fn added_mass(&self, body: RigidBodyHandle) -> f64 {
        self.volume_and_added_mass(body).map_or(0.0, |(_, added)| added)
    }

    /// Returns the added mass in kg along the axes of a body now: none of one in air, or in no
    /// water.
    pub fn added_mass_along(&self, body: RigidBodyHandle) -> Vector3<f64> {
        let of = |m: &Member| m.further().map_or(Vector3::zeros(), |further| further.axes()).add_scalar(m.carried());
        self.members.iter().find(|m| m.body == body).map_or(Vector3::zeros(), of)
    }

    /// Returns the added mass in kg beyond that in the mass of a body, as a matrix in world axes;
    /// it has momentum and kinetic energy beside the body's. `None` where it is alike along all
    /// axes.
    pub fn further_mass(&self, world: &PhysicsWorld, body: RigidBodyHandle) -> Option<Matrix3<f64>> {
        let further = self.members.iter().find(|m| m.body == body)?.further()?;
        Some(further.at(&rotation(*world.bodies.get(body)?.rotation())))
    }

    /// Lets an island carry the further mass of a body over the present step, or not. Returns it in
    /// kg, in world axes, and what the force on the body in N then exceeds that of the user by.
    pub(crate) fn carry(&mut self, body: RigidBodyHandle, carried: bool) -> Option<(Matrix3<f64>, Vector3<f64>)> {
        self.members.iter_mut().find(|m| m.body == body)?.carry(carried)
    }

    /// Returns the impulse of moments in N m s that the present step does not have, of a body in an
    /// island whose velocity changes by `change` (m/s).
    pub(crate) fn owed(&self, body: RigidBodyHandle, change: &Vector3<f64>) -> Option<Vector3<f64>> {
        self.members.iter().find(|m| m.body == body)?.owed(change)
    }

    /// Returns volume (m^3) and added mass (kg), as [`added_mass`](Self::added_mass), of a body.
    pub fn volume_and_added_mass(&self, body: RigidBodyHandle) -> Option<(f64, f64)> {
        self.members.iter().find(|m| m.body == body).map(|m| (m.volume(), m.carried()))
    }

    /// Puts a dynamic body into the water, with its present mass and colliders, and adds its added
    /// mass to that of the body, at its centre of mass: the least of that along its axes, while the
    /// rest acts as a [force](super::added_mass). One that is in it already is taken out first.
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
        let added = immersed.added_mass.map(|c| f64::from((c * density * floating) as Real));
        let (least, further) = Further::split(&added);
        add_mass(world, body, least);
        self.members.push(Member::new(body, hull, immersed, (least, further), floating));
        Ok(())
    }

    /// Takes a body out of the water, and its added mass from it; returns whether it was in it.
    pub fn remove(&mut self, world: &mut PhysicsWorld, body: RigidBodyHandle) -> bool {
        let Some(i) = self.members.iter().position(|m| m.body == body) else { return false };
        let member = self.members.remove(i);
        if world.bodies.contains(body) {
            add_mass(world, body, -member.carried());
        }
        true
    }

    /// Returns whether the water moves as now for a time of `h` (s).
    pub(crate) fn is_steady(&self, h: f64) -> bool {
        self.water.flow.is_steady(self.time, self.time + h)
    }

    /// Returns the time of the water in s: that of the set's cables, and without cables the length
    /// of the steps since the set has the water, from 0.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Sets the time of the water in s; it becomes that of the set's cables where there are some.
    pub fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    /// Returns the work in J of the water on a body since it is in it: that of buoyancy, wave and
    /// drag, and what the body gained as it took up or left its added mass. What balances the
    /// weight of the added mass is no force of the water, and the kinetic energy of its
    /// [further mass](Self::further_mass) is the body's.
    pub fn work(&self, body: RigidBodyHandle) -> Option<f64> {
        self.members.iter().find(|m| m.body == body).map(|m| m.work)
    }

    /// Returns the energy in J that the substeps of Rapier took from a body since it is in water:
    ///
    /// ```text
    /// kinetic energy + m g y - work of water and loads + lost = constant
    /// lost = sum over Rapier steps of (m |dv|^2 + dw.I dw)/(2 n)
    /// ```
    ///
    /// A Rapier step of length h with a constant force moves a body in n substeps of the symplectic
    /// Euler method by h (v + (n + 1)/(2 n) dv), with the change of velocity dv; the mean velocity
    /// would move it by h (v + dv/2), and the force does work m |dv|^2/(2 n) over the rest. The law
    /// is exact for a body that nothing else acts on, but for the gyroscopic part of a rotation;
    /// with added mass that differs by axis it is of first order in the step, and m dv and I dw are
    /// less by what that adds to them. Of a body with cables it is 0: its motion is that of the
    /// constant force.
    pub fn lost_in_substeps(&self, body: RigidBodyHandle) -> Option<f64> {
        self.members.iter().find(|m| m.body == body).map(|m| m.substeps)
    }

    /// Returns the largest angular frequency in rad/s with which a body heaves that the surface
    /// reaches in a step of `dt` (s), that of its area through the centroid, or swings across its
    /// way.
    pub(crate) fn fastest_motion(&self, world: &PhysicsWorld, dt: f64) -> f64 {
        let (sea, gravity) = (self.water.flow.surface.as_ref().map(|s| s.sea()), vector(world.gravity).norm());
        let of = |member: &Member| {
            let body = world.bodies.get(member.body).filter(|body| body.is_dynamic() && !body.is_sleeping());
            let Some(body) = body else { return 0.0 };
            let swing = member.swing(body, &self.water, self.time);
            let heave = |sea| member.heave(body, sea, (self.time, dt), (self.water.density, gravity));
            sea.as_ref().map_or(swing, |sea| swing.max(heave(sea)))
        };
        self.members.iter().map(of).fold(0.0, f64::max)
    }

    /// Adds the forces of the water over a Rapier step to those of the user, from `from` (s) after
    /// the time of the water, of length `h` (s). `coupled` says which bodies are integrated with
    /// cables; a body that moves faster than `sleep_speed` (m/s) does not fall asleep. Bodies that
    /// are no longer in the world are left out; those that sleep in water without a wave sleep on.
    pub(crate) fn put_on(
        &mut self,
        world: &mut PhysicsWorld,
        (from, h): (f64, f64),
        sleep_speed: f64,
        coupled: impl Fn(RigidBodyHandle) -> bool,
    ) {
        if h <= 0.0 {
            return;
        }
        let gravity = vector(world.gravity);
        let BodiesInWater { water, members, time, changed } = self;
        let changed = core::mem::take(changed);
        let sea = water.flow.surface.as_ref().map(|surface| surface.sea());
        let moves = water.wave().is_some() || !water.flow.history.is_empty();
        // Rapier's substeps move a body further by a constant force than the force would
        let further = 0.5 * h / world.integration_parameters.num_solver_iterations.max(1) as f64;
        for member in members {
            let Some(body) = world.bodies.get_mut(member.body) else { continue };
            if !body.is_dynamic() || !body.is_enabled() {
                member.forget();
                continue;
            }
            if changed {
                body.wake_up(true);
            }
            if body.is_sleeping() && !moves {
                continue;
            }
            let lead = if coupled(member.body) { 0.0 } else { further };
            let input = Input { water, sea: sea.as_ref(), gravity, time: *time + from + 0.5 * h, h, lead };
            if let Some((mass, velocity)) = member.meet(body, &input) {
                body.set_linvel(to_vector(&velocity), true);
                add_mass(world, member.body, mass);
            }
            let Some(body) = world.bodies.get_mut(member.body) else { continue };
            let fast = member.fastest(body) > sleep_speed;
            member.put_on(body, &input);
            if moves || fast {
                body.wake_up(true);
            }
        }
    }

    /// Takes the forces of the water off after a Rapier step, so that those of the user are left,
    /// or without one, if it is to be predicted anew.
    pub(crate) fn take_off(&mut self, world: &mut PhysicsWorld, stepped: bool) {
        for member in &mut self.members {
            member.take_off(world.bodies.get_mut(member.body), stepped);
        }
    }

    /// Returns the load of the water at rest on a body, wherever this is, as of now; `None` for one
    /// that is not in it.
    pub(crate) fn still(&self, world: &PhysicsWorld, body: RigidBodyHandle) -> Option<StillWater> {
        let member = self.members.iter().find(|m| m.body == body)?.clone();
        let own = world.bodies.get(body)?;
        let water = self.without_wave();
        let sea = water.flow.surface.as_ref().map(|surface| surface.sea());
        let (centre, scale) = (vector(own.local_center_of_mass()), f64::from(own.gravity_scale()));
        Some(StillWater { member, water, sea, gravity: vector(world.gravity), time: self.time, centre, scale })
    }

    /// Remembers that a body is at rest at its place under these forces, those of the user, and
    /// `further` (N): the cables balance them.
    pub(crate) fn rest(&mut self, world: &PhysicsWorld, handle: RigidBodyHandle, further: &Vector3<f64>) {
        let Some(load) = self.still(world, handle) else { return };
        let Some(body) = world.bodies.get(handle) else { return };
        let place = (vector(body.center_of_mass()), rotation(*body.rotation()));
        let known = load.at(&place.0, &place.1).force
            + vector(world.gravity) * (f64::from(body.mass()) * load.scale)
            + vector(body.user_force())
            + further;
        let drag = self.at_rest(world, handle, self.time).map_or(Vector3::zeros(), |force| force.drag);
        let of = |member: &&mut Member| member.body == handle;
        self.members.iter_mut().find(of).into_iter().for_each(|member| member.rest(known, drag, place.1));
    }

    fn without_wave(&self) -> Water {
        let mut water = self.water.clone();
        if let Some(surface) = &mut water.flow.surface {
            surface.wave = None;
        }
        water
    }

    /// Returns the force of the water on a body as it is at a time in s, without a wave and with
    /// drag as of a body at rest: what statics take. `None` for a body that is not in it.
    pub fn at_rest(&self, world: &PhysicsWorld, body: RigidBodyHandle, time: f64) -> Option<WaterForce> {
        let member = self.members.iter().find(|m| m.body == body)?;
        let water = self.without_wave();
        let sea = water.flow.surface.as_ref().map(|surface| surface.sea());
        let gravity = vector(world.gravity);
        let input = Input { water: &water, sea: sea.as_ref(), gravity, time, h: 0.0, lead: 0.0 };
        let mut still = world.bodies.get(body)?.clone();
        still.set_linvel(Vector::ZERO, false);
        still.set_angvel(Vector::ZERO, false);
        Some(member.at_rest(&still, &input))
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
