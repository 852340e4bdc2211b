//! Whether cables passed through each other, or through bodies that they move, between the drawn
//! and the found shape.
//!
//! # Equation
//!
//! Statics compute no contact there, so a shape may be found on the other side of what was drawn
//! beside it. Every particle goes straight from its drawn to its found place. Cables that touch
//! cables are refused if the [senses](lariat_ancf::contact::crossed_on) of their passages on that
//! way do not cancel; a cable and a body, seen from the body, if the found line is in it, or a
//! particle enters it by one face and leaves it by an opposite one.
//!
//! What stays where it is does touch the cable in statics, at samples: what is thinner than their
//! spacing may be passed. There the cable may have slid along itself, so that particles say
//! nothing: each place of the drawn line goes to one of the found line, in their order, such that
//! the sum of the squares of the ways is least (dynamic time warping, Sakoe & Chiba, IEEE Trans.
//! ASSP 26 (1978) 43), and is refused if such a way enters a collider by one face and leaves it by
//! an opposite one.
//!
//! # Validity
//!
//! Of a pair whose way does not cross nothing is said: it may still rest a radius deep in each
//! other. Lines that stay in one plane pass unseen. A cable with a free end that came round the end
//! of another is refused, too.

use crate::contact::broad::Finder;
use crate::contents::Contents;
use crate::contents::rules::ContactRules;
use crate::convert::{rotation, to_vector, vector};
use crate::error::Error;
use crate::handle::CableHandle;
use crate::read::inside::{deepest_beside, depth, held_beside, passes};
use crate::scales::read::{MATCHED, POINTS};
use ::nalgebra::Vector3;
use lariat_ancf::Cable;
use lariat_ancf::contact::{Way, crossed_on};
use rapier::dynamics::RigidBodyHandle;
use rapier::geometry::{Aabb, BoundingVolume, Collider};
use rapier::math::Pose;
use rapier::pipeline::PhysicsWorld;

/// A cable as it was drawn and as it was found.
pub(crate) struct Moved<'a> {
    index: usize,
    drawn: &'a Cable,
    found: &'a Cable,
    way: Way,
}

impl<'a> Moved<'a> {
    /// Returns a cable that was found by its index, from how it was `drawn`, which is as it is now
    /// if nothing else is known.
    pub fn of(
        contents: &'a Contents,
        drawn: &'a [(CableHandle, Cable)],
        (index, found): (usize, &'a Cable),
    ) -> Option<Self> {
        let known = drawn.iter().find(|(cable, _)| cable.0 as usize == index).map(|(_, cable)| cable);
        let start = known.or_else(|| contents.cables.get(index).map(|slot| &slot.cable))?;
        Some(Moved::new(index, start, found))
    }

    fn new(index: usize, drawn: &'a Cable, found: &'a Cable) -> Self {
        let chords = POINTS * drawn.elements().len().max(found.elements().len());
        // material runs over sheaves: particles are then those at the same share of the length
        let points = |cable: &Cable| {
            let at = |i: usize| cable.sample(cable.length() * i as f64 / chords as f64);
            (0..=chords).filter_map(|i| at(i).ok().map(|sample| sample.position)).collect()
        };
        Moved { index, drawn, found, way: Way { from: points(drawn), to: points(found) } }
    }

    /// Returns the arc length in m at which a chord begins.
    fn arc_length(&self, chord: usize) -> f64 {
        self.found.length() * chord as f64 / (self.way.to.len() - 1).max(1) as f64
    }
}

/// Refuses shapes that were found beyond what the cables touch, of cables by their index, with the
/// new poses of the bodies that were moved.
pub(crate) fn check_passed(
    contents: &Contents,
    finder: &Finder,
    world: &PhysicsWorld,
    mut moved: Vec<Moved<'_>>,
    poses: &[(RigidBodyHandle, Pose)],
) -> Result<(), Error> {
    moved.retain(|own| own.found.effects().contact.is_some());
    moved.sort_unstable_by_key(|own| own.index);
    for (i, own) in moved.iter().enumerate() {
        let itself = own.found.effects().contact.is_some_and(|contact| contact.itself);
        if let Some([chord, _]) = crossed_on(&own.way, None).filter(|_| itself) {
            return Err(crossed(own, own, chord));
        }
        for other in &moved[i + 1..] {
            if may_touch(contents, own, other)
                && let Some([chord, _]) = crossed_on(&own.way, Some(&other.way))
            {
                return Err(crossed(own, other, chord));
            }
        }
        for (handle, to) in poses {
            check_body(contents, finder, world, own, (*handle, to))?;
        }
        check_still(contents, finder, world, own, poses)?;
    }
    Ok(())
}

/// Refuses a cable that went through a collider that stays where it is.
fn check_still(
    contents: &Contents,
    finder: &Finder,
    world: &PhysicsWorld,
    own: &Moved<'_>,
    moved: &[(RigidBodyHandle, Pose)],
) -> Result<(), Error> {
    let (Some(slot), cable) = (contents.cables.get(own.index), CableHandle(own.index as u32)) else { return Ok(()) };
    let moves = |collider: &Collider| moved.iter().any(|(body, _)| collider.parent() == Some(*body));
    let mut swept = Aabb::new_invalid();
    own.way.from.iter().chain(&own.way.to).for_each(|x| swept.take_point(to_vector(x)));
    let mut ways = None;
    for (found, collider) in world.colliders.iter() {
        let touched = finder.touched(world, cable, &slot.rules, found).is_some() && !moves(collider);
        if !touched || !collider.compute_aabb().intersects(&swept) {
            continue;
        }
        let except = held_beside(contents, cable, own.drawn, collider);
        let held = |s: f64| except.iter().any(|[from, to]| (from..=to).contains(&&s));
        let through = |&[i, j]: &[usize; 2]| {
            let (from, to) = (&own.way.from[i], &own.way.to[j]);
            let outside = || !depth(collider, from).1 && !depth(collider, to).1;
            !held(own.arc_length(j)) && passes(collider, from, to) && outside()
        };
        let ways = ways.get_or_insert_with(|| matched(&own.way));
        let Some([_, j]) = ways.iter().find(|way| through(way)) else { continue };
        let (name, arc_length) = (own.found.name().to_string(), own.arc_length(*j));
        return Err(match collider.parent() {
            Some(body) => Error::CablePassesBodyInStatics { cable: name, body, arc_length, by_motion: false },
            None => Error::CableTouchesInStatics { cable: name, collider: found, arc_length, depth: 0.0 },
        });
    }
    Ok(())
}

/// Returns pairs of places of the drawn and the found line, in the order of both, for which the sum
/// of the squares of their distances is least.
fn matched(way: &Way) -> Vec<[usize; 2]> {
    let last = way.from.len() - 1;
    let stride = last.div_ceil(MATCHED).max(1);
    let places: Vec<usize> = (0..last).step_by(stride).chain([last]).collect();
    let n = places.len();
    let mut cost = vec![f64::INFINITY; n * n];
    for i in 0..n {
        for j in 0..n {
            let before = match (i, j) {
                (0, 0) => 0.0,
                (0, _) => cost[j - 1],
                (_, 0) => cost[(i - 1) * n],
                _ => cost[(i - 1) * n + j].min(cost[i * n + j - 1]).min(cost[(i - 1) * n + j - 1]),
            };
            cost[i * n + j] = before + (way.from[places[i]] - way.to[places[j]]).norm_squared();
        }
    }
    let (mut i, mut j) = (n - 1, n - 1);
    let mut pairs = vec![[places[i], places[j]]];
    while (i, j) != (0, 0) {
        let steps = [(1, 1), (1, 0), (0, 1)].map(|(a, b)| Some((i.checked_sub(a)?, j.checked_sub(b)?)));
        let cheapest = steps.into_iter().flatten().min_by(|a, b| cost[a.0 * n + a.1].total_cmp(&cost[b.0 * n + b.1]));
        let Some(next) = cheapest else { break };
        (i, j) = next;
        pairs.push([places[i], places[j]]);
    }
    pairs
}

fn crossed(one: &Moved<'_>, other: &Moved<'_>, chord: usize) -> Error {
    Error::CablesPassInStatics {
        cable: one.found.name().to_string(),
        other: other.found.name().to_string(),
        arc_length: one.arc_length(chord),
        by_motion: false,
    }
}

/// Returns whether two cables touch each other.
fn may_touch(contents: &Contents, one: &Moved<'_>, other: &Moved<'_>) -> bool {
    let of = |own: &Moved<'_>| {
        let contact = own.found.effects().contact.filter(|contact| contact.cables)?;
        Some((&contents.cables.get(own.index)?.rules, [contact.friction, contact.restitution]))
    };
    let (Some(mine), Some(theirs)) = (of(one), of(other)) else { return false };
    ContactRules::between(mine, theirs).is_some()
}

/// Refuses a cable that is in a body which was moved, or went through it.
fn check_body(
    contents: &Contents,
    finder: &Finder,
    world: &PhysicsWorld,
    own: &Moved<'_>,
    (handle, to): (RigidBodyHandle, &Pose),
) -> Result<(), Error> {
    let (Some(body), Some(slot)) = (world.bodies.get(handle), contents.cables.get(own.index)) else { return Ok(()) };
    for &found in body.colliders() {
        let cable = CableHandle(own.index as u32);
        let Some(collider) = finder.touched(world, cable, &slot.rules, found) else { continue };
        let Some(local) = collider.position_wrt_parent() else { continue };
        let except = held_beside(contents, cable, own.drawn, collider);
        let at = |pose: Pose| {
            let mut collider: Collider = collider.clone();
            collider.set_position(pose * *local);
            collider
        };
        let (before, after) = (at(*body.position()), at(*to));
        if deepest_beside(own.drawn, &before, &except).is_some() {
            // it starts inside, which is told by itself
            continue;
        }
        let seen = |x: &Vector3<f64>| {
            let local = rotation(before.rotation()).inverse() * (x - vector(before.translation()));
            vector(after.translation()) + rotation(after.rotation()) * local
        };
        let held = |s: f64| except.iter().any(|[from, to]| (from..=to).contains(&&s));
        let ways = own.way.from.iter().zip(&own.way.to).enumerate();
        let mut through = ways.filter(|(i, (from, to))| !held(own.arc_length(*i)) && passes(&after, &seen(from), to));
        let place = deepest_beside(own.found, &after, &except).map(|(s, _)| s);
        if let Some(arc_length) = place.or_else(|| through.next().map(|(i, _)| own.arc_length(i))) {
            return Err(Error::CablePassesBodyInStatics {
                cable: own.found.name().to_string(),
                body: handle,
                arc_length,
                by_motion: false,
            });
        }
    }
    Ok(())
}
