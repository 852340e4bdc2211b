//! What a cable pulls at a node, with the contacts that other cables keep.

use crate::contents::Contents;
use ::nalgebra::Vector3;
use lariat_ancf::coupling::Coupling;

/// Returns force (N) and moment (N m) of a cable of a set, by its index, on what holds a node.
/// Allocates nothing.
pub(crate) fn pull(contents: &mut Contents, index: usize, node: usize) -> (Vector3<f64>, Vector3<f64>) {
    let Some(slot) = contents.cables.get_mut(index) else { return Default::default() };
    let (own, touches) = (slot.cable.pull(node), slot.cable.effects().contact.is_some_and(|contact| contact.cables));
    if touches { plus(own, of_others(contents, index, node)) } else { own }
}

/// Returns what the contacts that other cables keep add to the pull of a cable at a node.
pub(crate) fn of_others(contents: &Contents, index: usize, node: usize) -> (Vector3<f64>, Vector3<f64>) {
    let Some(slot) = contents.cables.get(index) else { return Default::default() };
    let key = slot.cable.contact_key();
    let others = contents.cables.iter().filter(|(other, _)| *other != index);
    let touches = others.flat_map(|(_, other)| {
        let kept = other.cable.cable_contacts().filter(|touch| touch.other == key);
        kept.map(|touch| touch.mirrored(other.cable.contact_key()))
    });
    touches.map(|touch| slot.cable.share_of_contact(node, &touch)).fold(Default::default(), plus)
}

fn plus(a: (Vector3<f64>, Vector3<f64>), b: (Vector3<f64>, Vector3<f64>)) -> (Vector3<f64>, Vector3<f64>) {
    (a.0 + b.0, a.1 + b.1)
}
