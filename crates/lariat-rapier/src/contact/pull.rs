//! What a cable pulls at a node, with the contacts that other cables keep.

use crate::contents::Contents;
use ::nalgebra::Vector3;
use lariat_ancf::contact::PairTouch;
use lariat_ancf::coupling::Coupling;

/// Returns force (N) and moment (N m) of a cable of a set, by its index, on what holds a node;
/// `among` are the indices of the cables that it may touch. Allocates nothing.
pub(crate) fn pull(
    contents: &mut Contents,
    among: impl Iterator<Item = usize>,
    (index, node): (usize, usize),
) -> (Vector3<f64>, Vector3<f64>) {
    let Some(slot) = contents.cables.get_mut(index) else { return Default::default() };
    let own = slot.cable.pull(node);
    if !slot.cable.effects().contact.is_some_and(|contact| contact.cables) {
        return own;
    }
    let Some(slot) = contents.cables.get(index) else { return own };
    let shares = kept_by_others(contents, among, index).map(|(_, touch)| slot.cable.share_of_contact(node, &touch));
    shares.fold(own, |(force, moment), share| (force + share.0, moment + share.1))
}

/// Returns the contacts of a cable that others keep, as it has them, each with the index of the
/// other.
pub(crate) fn kept_by_others(
    contents: &Contents,
    among: impl Iterator<Item = usize>,
    index: usize,
) -> impl Iterator<Item = (usize, PairTouch)> {
    let key = contents.cables.get(index).map(|slot| slot.cable.contact_key());
    let others = among.filter(move |other| *other != index);
    others.filter_map(|other| Some((other, &contents.cables.get(other)?.cable))).flat_map(move |(other, cable)| {
        let kept = cable.cable_contacts().filter(move |touch| Some(touch.other) == key);
        kept.map(move |touch| (other, touch.mirrored(cable.contact_key())))
    })
}
