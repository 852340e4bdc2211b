//! Ranges and references of `[[joint]]`: bodies that hold to each other or to the world.

use super::body::BodyKind;
use super::check::{find_body, missing, unique};
use super::check_body::reals;
use super::document::{Document, KeyPath};
use super::table::JointTable;
use super::{JointKind, JointScene, Scene};
use crate::error::Error;

pub(super) fn joint(doc: &Document<'_>, scene: &Scene, i: usize, row: JointTable) -> Result<JointScene, Error> {
    let at = KeyPath::root("joint").item(i);
    let body = find_body(doc, scene, &at.key("body"), &row.body)?;
    if scene.bodies[body].kind != BodyKind::Dynamic {
        return Err(doc.error(&at.key("body"), format!("no joint moves {:?}, which is not dynamic", row.body)));
    }
    let to = match row.to.as_str() {
        "world" => None,
        name => Some(find_body(doc, scene, &at.key("to"), name)?),
    };
    if to == Some(body) {
        return Err(doc.error_accepting(&at.key("to"), "a body on a joint to itself", "another body | \"world\""));
    }
    let axis = |name: &str| {
        let at = at.key("axis");
        let Some(axis) = row.axis else { return Err(missing(doc, &at)) };
        let none = || doc.error(&at, format!("{axis:?} is no direction of a {name}"));
        reals(doc, &at, axis)?.try_normalize(f64::MIN_POSITIVE).ok_or_else(none)
    };
    let kind = match row.kind.as_str() {
        "hinge" => JointKind::Hinge(axis("hinge")?),
        "slider" => JointKind::Slider(axis("slider")?),
        "ball" => JointKind::Ball,
        "fixed" => JointKind::Fixed,
        other => return Err(doc.error(&at.key("kind"), format!("unknown kind {other:?}"))),
    };
    if row.axis.is_some() && matches!(kind, JointKind::Ball | JointKind::Fixed) {
        return Err(doc.error(&at.key("axis"), format!("a {} joint has no axis", row.kind)));
    }
    let point = reals(doc, &at.key("at"), row.at)?;
    let name = row.name.unwrap_or_else(|| format!("joint-{i}"));
    unique(doc, &at.key("name"), &name, scene.joints.iter().map(|j| j.name.as_str()))?;
    let joint = JointScene { name, body, to, point, kind, multibody: row.multibody.unwrap_or(false) };
    if joint.multibody {
        chain(doc, scene, &at, &joint)?;
    }
    Ok(joint)
}

/// A link of a multibody has one joint to what is before it, there are no rings, and it starts at rest.
fn chain(doc: &Document<'_>, scene: &Scene, at: &KeyPath, joint: &JointScene) -> Result<(), Error> {
    let before = |body: usize| scene.joints.iter().find(|j| j.multibody && j.body == body);
    if let Some(first) = before(joint.body) {
        let problem = format!("it is a link after joint {:?} already", first.name);
        return Err(doc.error_accepting(&at.key("body"), problem, "one multibody joint before each link"));
    }
    let mut here = joint.to;
    while let Some(body) = here {
        if body == joint.body {
            return Err(doc.error_accepting(
                &at.key("to"),
                "the links close a ring",
                "a tree; close it with multibody = false",
            ));
        }
        here = before(body).and_then(|j| j.to);
    }
    let link = &scene.bodies[joint.body];
    if link.velocity.norm() + link.angular_velocity.norm() > 0.0 {
        let problem = format!("body {:?} has a velocity, and links of a multibody start at rest", link.name);
        return Err(doc.error_accepting(&at.key("body"), problem, "a body without velocity and angular_velocity"));
    }
    Ok(())
}
