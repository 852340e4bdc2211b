//! `[cable.reel]`: a winch or a drum at the end of a cable.

use super::body::BodyKind;
use super::references::body;
use super::{Scene, integrator};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{ANY, Choose, Default, Key, Kind, NOT_NEGATIVE, POSITIVE, choice, table};
use lariat_ancf::{Feed, Reel, Vector3};

choice! {
    /// Where a reel is.
    enum ReelEnd {
        /// At the first point.
        Start = "start",
        /// At the last point.
        End = "end",
    }
}

choice! {
    /// How cable comes to the eye.
    enum Feeding {
        /// From a drum that turns with the rate.
        Drum = "drum",
        /// From a coil at rest, picked up inelastically: `m g = d(m v)/dt`.
        Coil = "coil",
        /// From a bag at rest, without loss.
        Bag = "bag",
    }
}

table! {
    /// A dynamic body whose spin is the rate of the reel and which feels the pull of the cable. It turns about an axis through its centre of
    /// mass, by a hinge to the world, a fixed or a kinematic body; another body or the world holds the eye. Positive spin, relative
    /// to what holds the eye, pays out.
    struct DrumTable("[cable.reel.drum]") {
        /// Name of the dynamic body.
        body: String = required, Kind::Text;
        /// Axis in the axes of the body, not zero.
        axis: Vector3<f64> = required, Kind::Numbers(&["x", "y", "z"], ANY.single());
        /// Radius at which the cable leaves.
        radius: f64 = required, Kind::Number(POSITIVE.single()), "m";
    }
}

table! {
    /// A reel through which cable is paid out and taken in. Only the element at the eye, the point of the reel, changes its length; attachments,
    /// loads and probes stay with their material, wherever its arc length is then. Hold the eye by an
    /// attachment at that end. On a dynamic body what is not out of the `stock` rides along, beside the body's own mass; that needs the
    /// integrator `discrete-gradient`.
    struct ReelTable("[cable.reel]") {
        /// The end that it is at.
        end: ReelEnd = "end", Kind::Choice(ReelEnd::names);
        /// Rate from a time on: positive pays out.
        rate: Option<Vec<[f64; 2]>> = (), Kind::Ascending(&["t", "rate"]), "s, m/s";
        /// The body on which the cable is wound, instead of `rate`, `to_length`, `acceleration`, `max_force` and `feed`. Needs the integrator
        /// `discrete-gradient`.
        drum: Option<DrumTable> = (), Kind::Table(&DrumTable::TABLE);
        /// Length of cable that is out, beyond sheaves along it too, when the reel stops: it comes there with the rates of `rate`, whatever their sign, and within
        /// `acceleration`. Not with a drum.
        to_length: Option<f64> = ("none, the rates are followed"), Kind::Number(POSITIVE), "m";
        /// Largest acceleration of the rate. What a table asks for in less time than that takes is told by the warning `slow_reel`.
        acceleration: f64 = 2.0, Kind::Number(POSITIVE), "m/s^2";
        /// Largest length of cable that can be out: the reel stops there, softly if its motor holds it, at once if it slips. Needed on a
        /// dynamic body.
        stock: Option<f64> = ("no limit"), Kind::Number(POSITIVE), "m";
        /// Largest force of the motor: the reel slips where the cable pulls more. A clutch; with a rate of 0 a brake, whose command
        /// comes to 0 by `acceleration`: give that a large number for a stop by the force alone; 0 is a free spool. Needs the integrator `discrete-gradient`.
        max_force: Option<f64> = ("as strong as it must be"), Kind::Number(NOT_NEGATIVE), "N";
        /// Inertia of the wheel over the square of its radius, where the reel slips; the stock on a drum is added, if `stock` is given.
        inertia: f64 = 0.0, Kind::Number(NOT_NEGATIVE), "kg";
        /// How cable comes to the eye while it is paid out.
        feed: Feeding = "drum", Kind::Choice(Feeding::names);
    }
    choose Choose::ExactlyOne(&["rate", "drum"]);
}

/// A checked drum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrumScene {
    /// Position of the body in [`Scene::bodies`].
    pub body: usize,
    /// Axis in the axes of the body.
    pub axis: Vector3<f64>,
    /// Radius in m.
    pub radius: f64,
}

/// A reel as a scene writes it.
pub(super) struct Written {
    pub reel: Reel,
    pub at_start: bool,
    pub drum: Option<DrumTable>,
}

/// The key of the table.
pub(super) const REEL: Key = Key {
    name: "reel",
    kind: Kind::Table(&ReelTable::TABLE),
    unit: "",
    default: Default::Absent("none"),
    meaning: "Change of the unstretched length at an end.",
};

/// Reads the table at a path from the keys of its cable.
pub(super) fn read(doc: &Document<'_>, at: &KeyPath, rows: &mut toml::Table) -> Result<Option<Written>, Error> {
    let Some(value) = rows.remove(REEL.name) else { return Ok(None) };
    let at = at.key(REEL.name);
    let ReelTable { end, rate, drum, to_length, acceleration, stock, max_force, inertia, feed } =
        doc.typed(&at, value)?;
    if drum.is_some() {
        for key in ["to_length", "acceleration", "max_force", "feed"].map(|key| at.key(key)) {
            if doc.contains(&key) {
                return Err(doc.conflict(&key, "the motion of a drum is that of its body"));
            }
        }
    }
    let feed = match feed {
        _ if drum.is_some() => Feed::BodyDrum,
        Feeding::Drum => Feed::Drum,
        Feeding::Coil => Feed::Coil,
        Feeding::Bag => Feed::Bag,
    };
    let reel = Reel { rate: rate.unwrap_or_default(), to_length, acceleration, stock, max_force, inertia, feed };
    Ok(Some(Written { reel, at_start: end == ReelEnd::Start, drum }))
}

/// Gives a cable its drum, once bodies, joints and attachments are known.
pub(super) fn put_on_drum(doc: &Document<'_>, scene: &mut Scene, cable: usize, row: &DrumTable) -> Result<(), Error> {
    let at = KeyPath::root("cable").item(cable).key(REEL.name).key("drum");
    let drum = body(doc, &at.key("body"), scene, &row.body)?;
    if scene.bodies[drum].kind != BodyKind::Dynamic {
        return Err(doc.conflict(&at.key("body"), format!("{:?} is not dynamic, no cable turns it", row.body)));
    }
    let axis = row.axis.try_normalize(f64::MIN_POSITIVE);
    let axis =
        axis.ok_or_else(|| doc.conflict(&at.key("axis"), format!("{:?} has no direction", row.axis.as_slice())))?;
    let part = scene.reel_part(cable).unwrap_or(cable);
    let own = &scene.cables[part];
    let here = |a: &&super::AttachmentScene| is_at_eye(scene, part, (a.cable, a.arc_length));
    let Some(holder) = scene.attachments.iter().find(here).map(|attachment| attachment.body) else {
        let problem = Problem::Conflict("no attachment holds the end of the cable on it".to_string());
        return Err(doc.error_accepting(
            &at,
            problem,
            "a drum, and an attachment of that end to what the drum turns in",
        ));
    };
    if holder == Some(drum) {
        let problem = Problem::Conflict("the drum holds the end of the cable itself".to_string());
        return Err(doc.error_accepting(&at.key("body"), problem, "an end attached to what the drum turns in"));
    }
    let dynamic = |body: Option<usize>| body.is_some_and(|body| scene.bodies[body].kind == BodyKind::Dynamic);
    let beside = |joint: &super::JointScene| {
        joint.body == drum && dynamic(joint.to) || joint.to == Some(drum) && dynamic(Some(joint.body))
    };
    if let Some(joint) = scene.joints.iter().find(|joint| beside(joint)) {
        let problem = Problem::Conflict(format!("joint {:?} holds it to a dynamic body", joint.name));
        let accepted = "a drum on a hinge to the world, a fixed or a kinematic body";
        return Err(doc.error_accepting(&at.key("body"), problem, accepted));
    }
    let key = KeyPath::root("cable").item(cable).key("integrator");
    let chosen = integrator::by_discrete_gradient(doc, &key, own.integrator, "a cable on a drum")?;
    for &part in &scene.parts[cable] {
        scene.cables[part].integrator = chosen;
    }
    scene.cables[part].drum = Some(DrumScene { body: drum, axis, radius: row.radius });
    Ok(())
}

/// Returns whether a point of a part is the eye of its reel.
pub(super) fn is_at_eye(scene: &Scene, part: usize, (cable, s): (usize, f64)) -> bool {
    let own = &scene.cables[part];
    let eye = if own.reel_at_start { 0.0 } else { own.length };
    cable == part && (s - eye).abs() <= 1e-9 * own.length
}

/// Refuses reels at ends that nothing holds, once attachments and junctions are known: cable would come from nowhere, and nothing would
/// take what it pulls.
pub(super) fn check_eyes(doc: &Document<'_>, scene: &Scene) -> Result<(), Error> {
    for cable in 0..scene.parts.len() {
        let Some(part) = scene.reel_part(cable) else { continue };
        let attached = scene.attachments.iter().map(|a| (a.cable, a.arc_length));
        let tied = scene.junctions.iter().flat_map(|junction| junction.points);
        if !attached.chain(tied).any(|point| is_at_eye(scene, part, point)) {
            let at = KeyPath::root("cable").item(cable).key(REEL.name);
            let problem = Problem::Conflict("nothing holds the end of the cable at it".to_string());
            return Err(doc.error_accepting(
                &at,
                problem,
                "a reel, and an attachment of that end to the world or a body",
            ));
        }
    }
    Ok(())
}
