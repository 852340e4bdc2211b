//! Warnings about cables in their world, beside those that a cable has by itself.
//!
//! Cables of a set are watched ([`Settings::watch`](crate::Settings::watch)): each warning of
//! [`lariat_ancf::warning`] is an [`Event::Warning`] once, after the host step in which it came up,
//! and is logged, for programs that do not look at events. What is wrong with how a cable or an
//! attachment begins is logged before its first host step.
//! [`CableSet::warnings`](crate::CableSet::warnings) returns all at any time. Both are told up to
//! the level of [`Settings::warn_level`](crate::Settings::warn_level), and but for what follows
//! from what is told of the same cable ([`lariat_ancf::warning::fold`]).

use crate::body::lost_spin::LostSpin;
use crate::body::unsettled::Unsettled;
use crate::contents::attachment::Attachment;
use crate::contents::gaps::OpenGap;
use crate::contents::{Contents, Slot};
use crate::convert::{rotation, to_vector, vector};
use crate::error::Error;
use crate::events::Event;
use crate::handle::{AttachmentHandle, CableHandle};
use crate::mechanism;
use crate::read::inside::{deepest_beside, held_beside};
use crate::scales::HOST_ROUNDING;
use crate::scales::read::{FAR_ANCHOR, JOLT, LIGHT_WATER};
use lariat_ancf::contact::LARGEST_RESTITUTION;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::warning::fold::{self, Judged, Sign};
use lariat_ancf::warning::{Interface, name_of};
use lariat_ancf::{Cable, Level};
use rapier::dynamics::RigidBodyType;
use rapier::geometry::ColliderHandle;
use rapier::math::Real;
use rapier::pipeline::PhysicsWorld;

/// A warning about a cable of a set; its text says what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// What the cable says about itself.
    #[error("{warning}")]
    Cable {
        /// The cable.
        cable: CableHandle,
        /// Its warning.
        warning: lariat_ancf::Warning,
    },
    /// A cable runs through a collider of a body that it is not attached to, or, with contact, of
    /// one that it is attached to, beyond what the attachment itself needs.
    #[error(
        "cable {name:?}: at {arc_length:.4} m it is {depth:.2e} m inside a collider{}; begin in its equilibrium among what it can touch (`equilibrium_among`), or check \
         its points and the place of the collider",
        if *.own {
            " of a body that it is attached to: contact holds it there, squeezed, and with any force until it is out"
        } else {
            ": contact does not push it out, and without contact it passes through; where it is fastened in there, attach it to that body"
        }
    )]
    InCollider {
        /// The cable.
        cable: CableHandle,
        /// Its name.
        name: String,
        /// The collider.
        collider: ColliderHandle,
        /// Arc length of the deepest place in m.
        arc_length: f64,
        /// Its distance from the surface in m; where no point that is tested is inside, half the
        /// length inside.
        depth: f64,
        /// Whether the cable is attached to the body of the collider.
        own: bool,
    },
    /// An attachment whose two sides are apart.
    #[error(
        "cable {name:?}: at {:.4} s it is {:.1e} m off the anchor of an attachment{}", gap.time, gap.gap,
        if gap.closed { ": take shorter steps, or find what holds the body back; what is moved at once is moved with its cables by `CableSet::move_bodies`" } else { ", and they never met: start them together, or wait" }
    )]
    OpenGap {
        /// The attachment.
        attachment: AttachmentHandle,
        /// Name of its cable.
        name: String,
        /// The gap.
        gap: OpenGap,
    },
    /// What joints, limits and contacts do to a body on joints changed from step to step, or the
    /// joints came apart.
    #[error(
        "cable {name:?}: the body of an attachment is on joints that did not hold it as predicted: {}; do not trust its position and forces: take shorter \
         host steps, more `Settings::rapier_steps` or solver iterations, weld links into one body, or keep heavy links away from light ones", how.text()
    )]
    Unsettled {
        /// The attachment.
        attachment: AttachmentHandle,
        /// Name of its cable.
        name: String,
        /// When, and by how much.
        how: Unsettled,
    },
    /// Cable and body of an attachment that has not been stepped have different velocities.
    #[error(
        "cable {name:?}: cable and body start with velocities {difference:.3e} m/s apart where they are attached, a shock of {force:.1e} N: give both the \
         same velocity there"
    )]
    VelocityJump {
        /// The attachment.
        attachment: AttachmentHandle,
        /// Name of its cable.
        name: String,
        /// Difference of the velocities in m/s.
        difference: f64,
        /// Force in N of the wave that it makes in the cable.
        force: f64,
    },
    /// An anchor far from all colliders of its body.
    #[error(
        "cable {name:?}: the anchor of an attachment is {distance:.3e} m from the origin of its body, whose colliders reach {radius:.3e} m: an anchor is in the axes of the body, \
         and the points of a rope are in those of the world; was the other meant?"
    )]
    FarAnchor {
        /// The attachment.
        attachment: AttachmentHandle,
        /// Name of its cable.
        name: String,
        /// Distance of the anchor from the origin of the body in m.
        distance: f64,
        /// Radius of a sphere about the origin that holds the colliders in m.
        radius: f64,
    },
    /// A body that moves with others by impulse joints and by those of a multibody at once.
    #[error(
        "cable {name:?}: the body of an attachment is held by impulse joints and by those of a multibody at once, and how that answers a cable is not predicted: its motion \
         and forces may be far off; make all joints of its mechanism of one kind"
    )]
    MixedJoints {
        /// The attachment.
        attachment: AttachmentHandle,
        /// Name of its cable.
        name: String,
    },
    /// A dynamic body that has no mass: Rapier does not move it.
    #[error(
        "cable {name:?}: the body of an attachment is dynamic and has no mass, so that Rapier moves it by no force: give it a collider or a mass, or make it fixed"
    )]
    NoMass {
        /// The attachment.
        attachment: AttachmentHandle,
        /// Name of its cable.
        name: String,
    },
    /// A kinematic body that Rapier turns at another angular velocity than its own.
    #[error(
        "cable {name:?}: the body of an attachment has an angular velocity of {asked:.4} rad/s, and Rapier turns it by {turned:.4} rad/s: by pi/4 in a step at most unless it is \
         allowed to rotate fast, by less in each solver iteration the farther that turns, and beyond half a turn the shorter way; take more `Settings::rapier_steps`"
    )]
    LostSpin {
        /// The attachment.
        attachment: AttachmentHandle,
        /// Name of its cable.
        name: String,
        /// Angular velocity of the body in rad/s.
        asked: f64,
        /// That with which Rapier turned it, in rad/s.
        turned: f64,
    },
    /// The world is in another unit than m.
    #[error(
        "Rapier's `length_unit` is {unit}: cables are in m, kg and s, and so are the limits by which their contacts, steps and warnings are judged; scale the world to m"
    )]
    LengthUnit {
        /// `IntegrationParameters::length_unit`.
        unit: f64,
    },
    /// Water that is lighter than any liquid.
    #[error(
        "the water has a density of {density} kg/m^3, less than that of any liquid: it is in kg/m^3; was {density} g/cm^3 or t/m^3 meant?"
    )]
    LightWater {
        /// Density in kg/m^3.
        density: f64,
    },
    /// A cable that touches bodies would bounce off a collider with more of its velocity than it
    /// can.
    #[error(
        "cable {name:?}: with a collider that it may touch it has a coefficient of restitution of {restitution}, and impacts of cables have at \
         most 15/17: it leaves with less"
    )]
    HighRestitution {
        /// The cable.
        cable: CableHandle,
        /// Its name.
        name: String,
        /// The collider with which it is largest.
        collider: ColliderHandle,
        /// Their coefficient of restitution.
        restitution: f64,
    },
}

impl Warning {
    /// Returns how much depends on it.
    pub fn level(&self) -> Level {
        match self {
            Warning::Cable { warning, .. } => warning.level(),
            Warning::InCollider { .. }
            | Warning::VelocityJump { .. }
            | Warning::FarAnchor { .. }
            | Warning::MixedJoints { .. }
            | Warning::NoMass { .. }
            | Warning::LostSpin { .. }
            | Warning::LengthUnit { .. }
            | Warning::LightWater { .. }
            | Warning::HighRestitution { .. } => Level::Setup,
            Warning::OpenGap { .. } | Warning::Unsettled { .. } => Level::Wrong,
        }
    }

    /// Returns the name of its kind, of a warning about a cable that of the cable's, as
    /// `CoarseMesh`.
    pub fn name(&self) -> String {
        match self {
            Warning::Cable { warning, .. } => name_of(warning),
            warning => name_of(warning),
        }
    }

    /// Returns the cable that it is about.
    fn cable(&self, contents: &Contents) -> Option<CableHandle> {
        match self {
            Warning::Cable { cable, .. }
            | Warning::InCollider { cable, .. }
            | Warning::HighRestitution { cable, .. } => Some(*cable),
            Warning::OpenGap { attachment, .. }
            | Warning::Unsettled { attachment, .. }
            | Warning::FarAnchor { attachment, .. }
            | Warning::MixedJoints { attachment, .. }
            | Warning::NoMass { attachment, .. }
            | Warning::LostSpin { attachment, .. }
            | Warning::VelocityJump { attachment, .. } => Some(contents.attachment(*attachment).ok()?.cable),
            Warning::LengthUnit { .. } | Warning::LightWater { .. } => None,
        }
    }
}

impl Judged for Warning {
    fn level(&self) -> Level {
        self.level()
    }

    fn sign(&self) -> Option<Sign> {
        match self {
            Warning::Cable { warning, .. } => warning.sign(),
            Warning::InCollider { .. } => Some(Sign::Inside),
            Warning::OpenGap { .. } | Warning::FarAnchor { .. } => Some(Sign::Gap),
            Warning::VelocityJump { .. } => Some(Sign::Shock),
            Warning::Unsettled { .. }
            | Warning::MixedJoints { .. }
            | Warning::NoMass { .. }
            | Warning::LostSpin { .. }
            | Warning::LengthUnit { .. }
            | Warning::LightWater { .. }
            | Warning::HighRestitution { .. } => None,
        }
    }

    fn same_kind(&self, other: &Self) -> bool {
        match (self, other) {
            (Warning::Cable { warning: a, .. }, Warning::Cable { warning: b, .. }) => a.same_kind(b),
            _ => core::mem::discriminant(self) == core::mem::discriminant(other),
        }
    }

    fn time(&self) -> Option<f64> {
        match self {
            Warning::Cable { warning, .. } => warning.time(),
            // of a gap the time is that of the largest one, which its consequences may precede
            _ => None,
        }
    }

    fn severity(&self) -> f64 {
        match self {
            Warning::Cable { warning, .. } => warning.severity(),
            Warning::InCollider { depth, .. } => *depth,
            Warning::OpenGap { gap, .. } => gap.gap,
            Warning::Unsettled { how, .. } => how.force,
            Warning::VelocityJump { force, .. } => *force,
            Warning::HighRestitution { restitution, .. } => *restitution,
            Warning::FarAnchor { distance, radius, .. } => distance / radius,
            Warning::LengthUnit { unit } => *unit,
            Warning::LightWater { density } => -density,
            Warning::LostSpin { asked, .. } => *asked,
            Warning::MixedJoints { .. } | Warning::NoMass { .. } => 0.0,
        }
    }
}

/// Returns what is told of all cables of a set, by level, up to the level that is asked for.
pub(crate) fn told(contents: &Contents, world: &PhysicsWorld, asked: Option<Level>) -> Vec<Warning> {
    let mut warnings = all(contents, world);
    fold::sort(&mut warnings);
    let cable = |warning: &Warning| warning.cable(contents);
    let own = |warning: &Warning| Some(contents.cable(cable(warning)?).ok()?.warn_level());
    let most = |warning: &Warning| asked.or_else(|| own(warning)).unwrap_or(Level::Coarse);
    warnings.retain(|warning| warning.level() <= most(warning));
    let explained = fold::explained(&warnings, cable, |_| true);
    warnings.into_iter().zip(explained).filter_map(|(warning, cause)| cause.is_none().then_some(warning)).collect()
}

/// Returns all warnings about the cables of a set.
fn all(contents: &Contents, world: &PhysicsWorld) -> Vec<Warning> {
    let mut warnings = Vec::new();
    warnings.extend(length_unit(world));
    warnings.extend(light_water(contents));
    for (cable, slot) in contents.cables.iter() {
        let handle = CableHandle(cable as u32);
        warnings.extend(slot.cable.warnings().into_iter().map(|warning| Warning::Cable { cable: handle, warning }));
        warnings.extend(at_start(contents, world, handle, slot));
    }
    let attachments = contents.attachments.iter();
    for (i, a) in attachments {
        let attachment = AttachmentHandle(i as u32);
        warnings.extend(of_attachment(contents, attachment, a, world));
        warnings.extend(far_anchor(contents, attachment, a, world));
        warnings.extend(mixed_joints(contents, attachment, a, world));
        warnings.extend(no_mass(contents, attachment, a, world));
        if let (Ok(Some(how)), Ok(cable)) = (unsettled(contents, attachment), contents.cable(a.cable)) {
            warnings.push(Warning::Unsettled { attachment, name: cable.name().to_string(), how });
        }
        if let (Some(record), Ok(cable)) = (contents.records.get(a.body), contents.cable(a.cable)) {
            warnings.extend(record.spin.worst().map(|lost| lost_spin(attachment, cable.name(), lost)));
        }
    }
    warnings
}

/// Returns whether a world is in another unit than m.
fn length_unit(world: &PhysicsWorld) -> Option<Warning> {
    let unit = f64::from(world.integration_parameters.length_unit);
    (unit != 1.0).then_some(Warning::LengthUnit { unit })
}

/// Returns whether the water of a set is lighter than any liquid.
fn light_water(contents: &Contents) -> Option<Warning> {
    let density = contents.water.as_ref()?.water().density;
    (density < LIGHT_WATER).then_some(Warning::LightWater { density })
}

/// Returns what is to be said about a cable where it is, before it is stepped.
fn at_start(contents: &Contents, world: &PhysicsWorld, handle: CableHandle, slot: &Slot) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for (collider, shape) in world.colliders.iter().filter(|(_, collider)| !collider.is_sensor()) {
        let except = held_beside(contents, handle, &slot.cable, shape);
        let own = !except.is_empty();
        let touches = slot.cable.effects().contact.is_some() && slot.rules.allow(shape);
        if own && !touches {
            continue;
        }
        if let Some((arc_length, depth)) = deepest_beside(&slot.cable, shape, &except) {
            let name = slot.cable.name().to_string();
            warnings.push(Warning::InCollider { cable: handle, name, collider, arc_length, depth, own });
        }
    }
    if let Some(contact) = slot.cable.effects().contact {
        let allowed = world.colliders.iter().filter(|(_, collider)| slot.rules.allow(collider));
        let bounces = allowed.map(|(h, collider)| (h, slot.rules.restitution(contact.restitution, collider)));
        let largest = bounces.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|found| found.1 > LARGEST_RESTITUTION);
        if let Some((collider, restitution)) = largest {
            let name = slot.cable.name().to_string();
            warnings.push(Warning::HighRestitution { cable: handle, name, collider, restitution });
        }
    }
    warnings
}

/// Returns the gap of an attachment if it is longer than its limit.
pub(crate) fn open_gap(contents: &Contents, attachment: AttachmentHandle) -> Result<Option<OpenGap>, Error> {
    let own = contents.attachment(attachment)?;
    Ok(own.watch.open(contents.cable(own.cable)?.length()))
}

/// Returns the worst half second of the body of an attachment, if there was one.
pub(crate) fn unsettled(contents: &Contents, attachment: AttachmentHandle) -> Result<Option<Unsettled>, Error> {
    let own = contents.attachment(attachment)?;
    Ok(contents.records.get(own.body).and_then(|record| record.settling.worst()))
}

/// Returns what is to be said about an attachment.
fn of_attachment(
    contents: &Contents,
    attachment: AttachmentHandle,
    own: &Attachment,
    world: &PhysicsWorld,
) -> Option<Warning> {
    let (cable, body) = (contents.cable(own.cable).ok()?, world.bodies.get(own.body)?);
    let name = cable.name().to_string();
    if own.watch.is_read() {
        return Some(Warning::OpenGap { attachment, name, gap: own.watch.open(cable.length())? });
    }
    // how a body whose positions are prescribed moves is known only within a step
    if body.body_type() == RigidBodyType::KinematicPositionBased {
        return None;
    }
    let anchor = vector(body.translation()) + rotation(*body.rotation()) * own.anchor;
    let there = vector(body.velocity_at_point(to_vector(&anchor)));
    let difference = cable.sample(own.arc_length).ok()?.velocity - there;
    let rounding = HOST_ROUNDING * f64::from(Real::EPSILON) * there.amax();
    let carried = contents.attachments.values().filter(|other| other.cable == own.cable);
    let bodies = carried.filter_map(|other| world.bodies.get(other.body)).filter(|body| body.is_dynamic());
    let mass: f64 = bodies.map(|body| f64::from(body.mass())).sum();
    let shock = cable.shock(own.arc_length, &difference, mass * vector(world.gravity).norm()).ok()?;
    let (difference, force) = (difference.norm(), shock.force);
    let due = difference > JOLT + rounding && shock.is_large();
    due.then_some(Warning::VelocityJump { attachment, name, difference, force })
}

/// Returns whether an anchor is far outside of the colliders of its dynamic body.
fn far_anchor(
    contents: &Contents,
    attachment: AttachmentHandle,
    own: &Attachment,
    world: &PhysicsWorld,
) -> Option<Warning> {
    let body = world.bodies.get(own.body).filter(|body| body.is_dynamic())?;
    let reach = |handle: &ColliderHandle| {
        let collider = world.colliders.get(*handle)?;
        let sphere = collider.shape().compute_local_bounding_sphere();
        let place = collider.position_wrt_parent().copied().unwrap_or_default();
        let centre = vector(place.translation) + rotation(place.rotation) * vector(sphere.center);
        Some(centre.norm() + f64::from(sphere.radius))
    };
    let radius = body.colliders().iter().filter_map(reach).fold(0.0, f64::max);
    let distance = own.anchor.norm();
    let name = contents.cable(own.cable).ok()?.name().to_string();
    let far = radius > 0.0 && distance > FAR_ANCHOR * radius;
    far.then_some(Warning::FarAnchor { attachment, name, distance, radius })
}

/// Returns whether the joints of the body of an attachment are of two kinds.
fn mixed_joints(
    contents: &Contents,
    attachment: AttachmentHandle,
    own: &Attachment,
    world: &PhysicsWorld,
) -> Option<Warning> {
    let name = contents.cable(own.cable).ok()?.name().to_string();
    mechanism::is_mixed(world, own.body).then_some(Warning::MixedJoints { attachment, name })
}

/// Returns whether the body of an attachment is dynamic without a mass that moves it.
fn no_mass(
    contents: &Contents,
    attachment: AttachmentHandle,
    own: &Attachment,
    world: &PhysicsWorld,
) -> Option<Warning> {
    let body = world.bodies.get(own.body).filter(|body| body.is_dynamic() && body.is_enabled())?;
    let name = contents.cable(own.cable).ok()?.name().to_string();
    // what colliders and the user add counts from the next step on only
    let added = body.mass_properties().additional_local_mprops.is_some();
    let has_mass = |handle: &ColliderHandle| world.colliders.get(*handle).is_some_and(|collider| collider.mass() > 0.0);
    let moves = body.mass() > 0.0 || added || body.is_translation_locked() || body.colliders().iter().any(has_mass);
    (!moves).then_some(Warning::NoMass { attachment, name })
}

/// Returns what is to be said where Rapier does not turn the body of an attachment as it was asked.
fn lost_spin(attachment: AttachmentHandle, name: &str, LostSpin { asked, turned }: LostSpin) -> Warning {
    Warning::LostSpin { attachment, name: name.to_string(), asked, turned }
}

/// Logs, before a host step, what is wrong with how cables and attachments begin that have not been
/// stepped: where they lie and how they move is what the user gave. Chooses what is read of cables
/// by the level that is `asked` for, and their names by the `interface`.
pub(crate) fn introduce(contents: &mut Contents, world: &PhysicsWorld, (asked, interface): (Option<Level>, Interface)) {
    let mut of_world = length_unit(world).filter(|_| !contents.cables.values().any(|slot| slot.introduced));
    for index in 0..contents.cables.len() {
        let Some(slot) = contents.cables.get_mut(index).filter(|slot| slot.cable.is_watched()) else { continue };
        slot.cable.watch_up_to(asked.unwrap_or_else(|| slot.cable.warn_level()));
        if core::mem::replace(&mut slot.introduced, true) {
            continue;
        }
        if let Some(warning) = of_world.take() {
            log::warn!("{}", interface.text(&warning));
        }
        if let Some(slot) = contents.cables.get(index) {
            let warnings = at_start(contents, world, CableHandle(index as u32), slot);
            warnings.iter().for_each(|warning| log::warn!("{}", interface.text(warning)));
        }
    }
    for index in 0..contents.attachments.len() {
        let is_new = contents.attachments.get_mut(index).is_some_and(|attachment| attachment.watch.introduce());
        let Some(own) = contents.attachments.get(index).filter(|_| is_new) else { continue };
        let is_watched = contents.cable(own.cable).is_ok_and(Cable::is_watched);
        let of = [of_attachment, far_anchor, mixed_joints, no_mass]
            .map(|of| of(contents, AttachmentHandle(index as u32), own, world));
        of.iter().flatten().filter(|_| is_watched).for_each(|warning| log::warn!("{}", interface.text(warning)));
    }
}

/// Reads the cables at the end of a host step, and tells them first whether nothing else acts on
/// them and by how much what holds them was rounded; what is new is an event.
pub(crate) fn note(
    contents: &mut Contents,
    world: &PhysicsWorld,
    (asked, interface): (Option<Level>, Interface),
    events: &mut Vec<Event>,
) {
    let dt = f64::from(world.integration_parameters.dt);
    let Contents { cables, attachments, junctions, wheels, records, .. } = contents;
    for slot in cables.values_mut() {
        (slot.alone, slot.parted, slot.rounding) = (slot.cable.effects().contact.is_none(), false, 0.0);
    }
    let at_junctions = junctions.values().flat_map(|junction| &junction.nodes).map(|(cable, _)| *cable);
    for cable in at_junctions.chain(wheels.cables()) {
        if let Some(slot) = cables.get_mut(cable.0 as usize) {
            slot.alone = false;
        }
    }
    for index in 0..attachments.len() {
        let Some(attachment) = attachments.get_mut(index) else { continue };
        let Some(slot) = cables.get_mut(attachment.cable.0 as usize) else { continue };
        slot.alone &= !world.bodies.get(attachment.body).is_some_and(|body| body.is_dynamic());
        slot.rounding = records.rounding(world, attachment.body, &attachment.anchor).max(slot.rounding);
        if slot.asleep {
            continue;
        }
        let opened = attachment.watch.note(attachment.gap(), slot.cable.time(), slot.cable.length());
        slot.parted |= attachment.watch.open(slot.cable.length()).is_some();
        if let Some(gap) = opened.filter(|_| slot.cable.is_watched()) {
            let attachment = AttachmentHandle(index as u32);
            let warning = Warning::OpenGap { attachment, name: slot.cable.name().to_string(), gap };
            log::warn!("{}", interface.text(&warning));
            events.push(Event::GapOpened { attachment, gap });
        }
        let how = records.get(attachment.body).and_then(|record| record.settling.due());
        if let Some(how) = how.filter(|_| slot.cable.is_watched()) {
            let attachment = AttachmentHandle(index as u32);
            let warning = Warning::Unsettled { attachment, name: slot.cable.name().to_string(), how };
            log::warn!("{}", interface.text(&warning));
            events.push(Event::Unsettled { attachment, how });
        }
        let lost = records.get(attachment.body).and_then(|record| record.spin.due());
        if let Some(lost) = lost.filter(|_| slot.cable.is_watched()) {
            let warning = lost_spin(AttachmentHandle(index as u32), slot.cable.name(), lost);
            log::warn!("{}", interface.text(&warning));
        }
    }
    records.set_told();
    for index in 0..cables.len() {
        let Some(slot) = cables.get_mut(index).filter(|slot| !slot.asleep) else { continue };
        let cable = CableHandle(index as u32);
        slot.cable.set_end_rounding(slot.rounding, dt);
        let (most, parted) = (asked.unwrap_or_else(|| slot.cable.warn_level()), slot.parted);
        slot.cable.note_host_step(slot.alone, |warning| {
            if warning.level() <= most && !(parted && fold::explains(Sign::Gap, &warning)) {
                log::warn!("{}", interface.text(&warning));
                events.push(Event::Warning { cable, warning });
            }
        });
    }
}
