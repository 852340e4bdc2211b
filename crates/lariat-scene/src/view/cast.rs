//! What frames show beside numbers: the names and looks of cables and bodies.

use super::NODES;
use crate::scene::Scene;
use crate::scene::body::{BodyKind, BodyShape};
use nalgebra::Vector3;

/// The cables and bodies of frames, in their order there.
#[derive(Clone, Debug, Default)]
pub struct Cast {
    pub name: String,
    /// In m/s^2.
    pub gravity: Vector3<f64>,
    pub cables: Vec<CableLook>,
    pub bodies: Vec<BodyLook>,
    /// Largest number of elements of a frame.
    pub elements: usize,
    /// Whether frames have contacts.
    pub touches: bool,
    /// Whether frames have stripes.
    pub is_twisted: bool,
}

/// A cable.
#[derive(Clone, Debug)]
pub struct CableLook {
    pub name: String,
    /// In m; unknown of a section that is given by its stiffness.
    pub diameter: Option<f64>,
}

/// A body, or a collider of one.
#[derive(Clone, Debug)]
pub struct BodyLook {
    pub name: String,
    pub kind: BodyKind,
    pub shape: BodyShape,
}

impl Cast {
    /// Returns that of a scene.
    pub fn of(scene: &Scene) -> Self {
        let whole = &scene.cables[..scene.parts.len()];
        let cables = whole.iter().map(|c| CableLook { name: c.name.clone(), diameter: c.sections.first().diameter });
        let bodies =
            scene.bodies.iter().map(|b| BodyLook { name: b.name.clone(), kind: b.kind, shape: b.shape.clone() });
        Cast {
            name: scene.name.clone(),
            gravity: scene.gravity,
            cables: cables.collect(),
            bodies: bodies.collect(),
            elements: scene.cables.iter().map(|cable| cable.elements.min(NODES)).sum(),
            touches: touches(scene),
            is_twisted: is_twisted(scene),
        }
    }
}

/// Returns whether frames of a scene have stripes.
pub fn is_twisted(scene: &Scene) -> bool {
    scene.cables.iter().any(|cable| cable.effects.torsion.is_some())
}

/// Returns whether frames of a scene have contacts.
pub fn touches(scene: &Scene) -> bool {
    scene.cables.iter().any(|cable| cable.effects.contact.is_some())
}
