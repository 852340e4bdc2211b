//! `[[joint]]`: bodies that hold to each other or to the world.

use super::Scene;
use super::body::BodyKind;
use super::references::{body, body_or_world, unique};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{ANY, Kind, choice, table};
use lariat_ancf::Vector3;

choice! {
    /// What a joint leaves free.
    enum JointType {
        /// Rotation about an axis.
        Hinge = "hinge",
        /// Motion along an axis.
        Slider = "slider",
        /// Rotation about a point.
        Ball = "ball",
        /// Nothing.
        Fixed = "fixed",
    }
}

table! {
    /// Joins a dynamic body to another body or to the world. The two do not collide with each other. Point and axis are given in
    /// the world at t = 0, so that a joint starts closed.
    struct JointTable("[[joint]]") {
        /// No other joint has it.
        name: Option<String> = ("`joint-N`, counted from 0"), Kind::Name(&[]);
        /// `"hinge"` rotates about `axis`, `"slider"` moves along it, `"ball"` rotates about the point, `"fixed"` does neither.
        kind: JointType = required, Kind::Choice(JointType::names);
        /// Name of a dynamic body.
        body: String = required, Kind::Text;
        /// Name of another body, or `"world"`.
        to: String = required, Kind::Text;
        /// Point of the joint, in the world at t = 0.
        at: Vector3<f64> = required, Kind::Numbers(&["x", "y", "z"], ANY.single()), "m";
        /// Direction, not zero, in the world at t = 0, for a hinge or a slider.
        axis: Option<Vector3<f64>> = ("required by hinge and slider"), Kind::Numbers(&["x", "y", "z"], ANY.single());
        /// `true` makes the body a link of a multibody, in reduced coordinates. Such a link has one such joint before it, closes no ring
        /// and starts at rest. Rapier's other joints yield under load. Neither has friction or damping.
        multibody: bool = false, Kind::Flag;
    }
}

/// What a joint leaves free; directions are unit vectors in world axes at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Rotation about an axis.
    Hinge(Vector3<f64>),
    /// Motion along an axis.
    Slider(Vector3<f64>),
    /// Rotation about a point.
    Ball,
    /// Nothing.
    Fixed,
}

/// A checked joint between bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct JointScene {
    /// Name.
    pub name: String,
    /// Position in [`Scene::bodies`] of the body that it holds.
    pub body: usize,
    /// Position of the body that it holds to; `None` = the world.
    pub to: Option<usize>,
    /// Point at t = 0, in m.
    pub point: Vector3<f64>,
    /// What it leaves free.
    pub kind: JointKind,
    /// True for a link of a multibody.
    pub multibody: bool,
}

/// Reads the joint in row `i`.
pub(super) fn read(doc: &Document<'_>, scene: &Scene, i: usize, row: JointTable) -> Result<JointScene, Error> {
    let at = KeyPath::root("joint").item(i);
    let body = body(doc, &at.key("body"), scene, &row.body)?;
    if scene.bodies[body].kind != BodyKind::Dynamic {
        return Err(doc.conflict(&at.key("body"), format!("{:?} is not dynamic, no joint moves it", row.body)));
    }
    let to = body_or_world(doc, &at.key("to"), scene, &row.to)?;
    if to == Some(body) {
        let problem = Problem::Conflict("the body would be joined to itself".to_string());
        return Err(doc.error_accepting(&at.key("to"), problem, "another body | \"world\""));
    }
    let axis = || {
        let at = at.key("axis");
        let axis = row.axis.ok_or_else(|| doc.missing(&at))?;
        let zero = || doc.conflict(&at, format!("{:?} has no direction", axis.as_slice()));
        axis.try_normalize(f64::MIN_POSITIVE).ok_or_else(zero)
    };
    let kind = match row.kind {
        JointType::Hinge => JointKind::Hinge(axis()?),
        JointType::Slider => JointKind::Slider(axis()?),
        JointType::Ball => JointKind::Ball,
        JointType::Fixed => JointKind::Fixed,
    };
    if row.axis.is_some() && matches!(kind, JointKind::Ball | JointKind::Fixed) {
        return Err(doc.conflict(&at.key("axis"), format!("a {} joint has no axis", row.kind.name())));
    }
    let name = row.name.unwrap_or_else(|| format!("joint-{i}"));
    unique(doc, &at, &name, scene.joints.iter().map(|j| j.name.as_str()))?;
    let joint = JointScene { name, body, to, point: row.at, kind, multibody: row.multibody };
    if joint.multibody {
        check_link(doc, scene, &at, &joint)?;
    }
    Ok(joint)
}

/// Checks that a link of a multibody has one joint before it, closes no ring and starts at rest.
fn check_link(doc: &Document<'_>, scene: &Scene, at: &KeyPath, joint: &JointScene) -> Result<(), Error> {
    let before = |body: usize| scene.joints.iter().find(|j| j.multibody && j.body == body);
    let invalid = |key: &str, problem: String, accepted: &str| {
        Err(doc.error_accepting(&at.key(key), Problem::Conflict(problem), accepted))
    };
    if let Some(first) = before(joint.body) {
        let problem = format!("it is already a link after joint {:?}", first.name);
        return invalid("body", problem, "one multibody joint before each link");
    }
    let mut here = joint.to;
    while let Some(body) = here {
        if body == joint.body {
            return invalid(
                "to",
                "the links close a ring".to_string(),
                "a tree; close the ring with multibody = false",
            );
        }
        here = before(body).and_then(|j| j.to);
    }
    let link = &scene.bodies[joint.body];
    if link.course.velocity.norm() + link.course.angular_velocity.norm() > 0.0 {
        let problem = format!("body {:?} has a velocity, and links of a multibody start at rest", link.name);
        return invalid("body", problem, "a body without velocity and angular_velocity");
    }
    Ok(())
}
