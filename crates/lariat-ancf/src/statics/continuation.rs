//! Continuation of contact: from a soft law of contact to the law itself.
//!
//! # Scheme
//!
//! The law is stiff, and which samples touch is not known. A search that begins deep in an
//! obstacle, or that finds no shape, begins with a law so soft that the loads per length have the
//! depth in which the cables are, or a share of it, where that lets them through what they press
//! on; then the law is made up to ten times as stiff, less where that fails, and so on up to the
//! law itself. Without contact there is one search.
//!
//! # References
//!
//! Allgower & Georg 1990 (continuation); Wriggers 2006, section 6.3 (penalty).

use crate::cable::Cable;
use crate::contact::Growth;
use crate::scales::statics::SOFTNESS;

/// A search for equilibrium, over the law of contact of its cables.
pub(crate) trait Continued {
    /// What is found.
    type Found;
    /// Why nothing is.
    type Failure;
    /// A shape to return to.
    type Shape: Clone;

    /// Searches from the present shape.
    fn search(&mut self) -> Result<Self::Found, Self::Failure>;

    /// Searches from the present shape, that of a law that was a little softer.
    fn improve(&mut self) -> Result<Self::Found, Self::Failure>;

    /// Returns the present shape.
    fn shape(&self) -> Self::Shape;

    /// Returns to a shape.
    fn restore(&mut self, shape: Self::Shape);

    /// Calls `f` with each cable and its coordinates.
    fn for_each(&mut self, f: impl FnMut(&mut Cable, &[f64]));
}

/// Searches for an equilibrium under the law of contact as it is. Cables whose axial law cannot
/// push are searched with one that can first: elements that are half slack cost no energy, and a
/// search that crumples them on its way ends in shapes that no rope has.
fn search_by_laws<S: Continued>(search: &mut S) -> Result<S::Found, S::Failure> {
    let push = |search: &mut S, pushes: bool| {
        let mut limp = false;
        search.for_each(|cable, _| limp |= cable.system.forces.push(pushes));
        limp
    };
    if !push(search, true) {
        return search.search();
    }
    let start = search.shape();
    let found = search.search();
    push(search, false);
    if found.is_ok()
        && let Ok(found) = search.improve()
    {
        return Ok(found);
    }
    search.restore(start);
    search.search()
}

/// Searches for an equilibrium under the law of contact itself.
pub(crate) fn find<S: Continued>(search: &mut S) -> Result<S::Found, S::Failure> {
    let mut deep = false;
    search.for_each(|cable, q| deep |= cable.system.static_contact.is_deep(&cable.model, q));
    let start = search.shape();
    let mut outcome = (!deep).then(|| search_by_laws(search));
    let mut end = None;
    for share in SOFTNESS {
        if matches!(outcome, Some(Ok(_))) {
            break;
        }
        end.get_or_insert_with(|| search.shape());
        search.restore(start.clone());
        let mut softened = false;
        search.for_each(|cable, q| softened |= cable.system.static_contact.soften(&cable.model, q, share));
        if !softened && outcome.is_some() {
            break;
        }
        outcome = Some(search_by_laws(search));
    }
    let mut found = match outcome.unwrap_or_else(|| search_by_laws(search)) {
        Ok(found) => found,
        Err(failure) => {
            // the shape in which it failed first tells why
            end.into_iter().for_each(|end| search.restore(end));
            return Err(failure);
        }
    };
    let mut growth = Growth::default();
    loop {
        let mut depths = Vec::new();
        search.for_each(|cable, _| depths.push(cable.system.static_contact.harden(&cable.model, &growth)));
        if depths.iter().all(Option::is_none) {
            return Ok(found);
        }
        let good = search.shape();
        let harder = search.improve();
        if growth.adapt(harder.is_ok()) {
            search.restore(good);
            let mut depths = depths.into_iter();
            search.for_each(|cable, _| {
                if let Some(depth) = depths.next().flatten() {
                    cable.system.static_contact.retreat(depth);
                }
            });
        } else {
            found = harder?;
        }
    }
}
