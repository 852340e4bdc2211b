//! What `lariat static` reports: of each cable stability, residual, peak tension, sag and reactions, of the bodies which were
//! moved, and which held.

use super::World;
use crate::error::Error;
use crate::physics::Settled;
use crate::scene::Scene;
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{Cable, EquilibriumReport, Vector3};
use serde::{Deserialize, Serialize};

/// Points of each element at which the sag is measured.
const POINTS: usize = 8;

/// The static equilibrium of a cable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct CableStatics {
    /// Name of the cable.
    pub name: String,
    /// True if the tangent stiffness is positive definite; false for an unstable or indifferent shape.
    pub stable: bool,
    /// Largest residual force in N.
    pub residual_n: f64,
    /// Newton iterations.
    pub iterations: usize,
    /// Largest tension in N.
    pub peak_tension_n: f64,
    /// Arc length of the largest tension in m.
    pub peak_tension_at_m: f64,
    /// Largest jump of the tension between elements in N, about its error; `None` if no node can judge.
    pub tension_jump_n: Option<f64>,
    /// Largest distance of a point below the straight line between the supports on both sides of it, along gravity, in m. `None`
    /// without gravity, or if no two supports lie at different horizontal positions.
    pub sag_m: Option<f64>,
    /// Largest difference of tensions along the cable in N that friction of what it rests on could hold: the shape is found without,
    /// so tensions may be off by as much. 0 without contact.
    #[serde(default)]
    pub friction_n: f64,
    /// Forces and moments on what holds the cable, by arc length; one for each point that is held.
    pub reactions: Vec<StaticReaction>,
}

/// Force and moment of a cable on what holds it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct StaticReaction {
    /// Name of the attachment or junction; at a knot those of all its junctions, between commas.
    pub name: String,
    /// Arc length in m.
    pub at_m: f64,
    /// Force in N.
    pub force_n: [f64; 3],
    /// Moment in N m.
    pub moment_nm: [f64; 3],
}

/// What statics did with the bodies of a scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BodyStatics {
    /// Dynamic bodies in equilibrium.
    pub moved: Vec<BodyPlace>,
    /// Names of attached bodies that were held where they are drawn: fixed and kinematic ones.
    pub held: Vec<String>,
    /// Names of dynamic bodies that no cable is attached to, left where they are drawn.
    pub unattached: Vec<String>,
    /// Host steps of 1/60 s in which all came to rest by its motion, where statics have no law for
    /// what touches: bodies that rest on others, cables that touch each other, themselves, or
    /// bodies that they move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation_steps: Option<u32>,
}

/// A body in equilibrium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct BodyPlace {
    /// Name of the body.
    pub name: String,
    /// Position of its origin in m.
    pub position_m: [f64; 3],
    /// Rotation vector in rad.
    pub rotation_rad: [f64; 3],
}

impl BodyStatics {
    pub(super) fn read(world: &World, settled: &Settled) -> Self {
        let name = |&i: &usize| world.scene.bodies[i].name.clone();
        let place = |i: &usize| {
            let state = world.body(*i)?;
            let (position_m, rotation_rad) = (state.position.into(), state.rotation.scaled_axis().into());
            Some(BodyPlace { name: name(i), position_m, rotation_rad })
        };
        BodyStatics {
            moved: settled.moved.iter().filter_map(place).collect(),
            held: settled.held.iter().map(name).collect(),
            unattached: settled.unattached.iter().map(name).collect(),
            relaxation_steps: settled.relaxation_steps,
        }
    }
}

impl CableStatics {
    /// Reads a cable in equilibrium, among `all` of the scene.
    ///
    /// # Errors
    /// [`Error::Mechanics`] if a reaction cannot be computed; not for an equilibrium.
    pub(super) fn read(
        scene: &Scene,
        index: usize,
        (cable, all): (&mut Cable, &[&Cable]),
        report: &EquilibriumReport,
    ) -> Result<Self, Error> {
        let attachments = scene.attachments.iter().filter(|a| a.cable == index);
        let mut held: Vec<(String, f64)> =
            attachments.map(|a| (a.name.clone(), scene.present(index, cable, a.arc_length))).collect();
        for junction in &scene.junctions {
            let points = junction.points.iter().filter(|(cable, _)| *cable == index);
            held.extend(
                points.map(|&(_, arc_length)| (junction.name.clone(), scene.present(index, cable, arc_length))),
            );
        }
        held.sort_by(|a, b| a.1.total_cmp(&b.1));
        // the cable pulls once at a knot, however many junctions tie it
        held.dedup_by(|next, first| {
            let is_same = cable.node(next.1).ok().is_some_and(|node| cable.node(first.1).ok() == Some(node));
            if is_same {
                first.0 = format!("{}, {}", first.0, next.0);
            }
            is_same
        });
        let (peak_tension_at_m, peak_tension_n) = cable.peak_tension();
        let supports: Vec<f64> = held.iter().map(|(_, arc_length)| *arc_length).collect();
        let sag_m = sag(cable, &supports, &scene.gravity)?;
        let mut reactions = Vec::new();
        for (name, at_m) in held {
            let (force, moment) = super::readings::pull(cable, at_m, all)?;
            reactions.push(StaticReaction { name, at_m, force_n: force.into(), moment_nm: moment.into() });
        }
        Ok(CableStatics {
            name: cable.name().to_string(),
            stable: report.stable,
            residual_n: report.residual,
            iterations: report.iterations,
            peak_tension_n,
            peak_tension_at_m,
            tension_jump_n: cable.tension_jump(),
            sag_m,
            friction_n: cable.friction_bound(),
            reactions,
        })
    }
}

/// Returns the largest sag of the spans between supports (arc lengths in m, ascending).
fn sag(cable: &Cable, supports: &[f64], gravity: &Vector3<f64>) -> Result<Option<f64>, Error> {
    let Some(down) = gravity.try_normalize(f64::MIN_POSITIVE) else { return Ok(None) };
    let level = |x: Vector3<f64>| x - down * x.dot(&down);
    let nodes = cable.node_arc_lengths();
    let mut largest: Option<f64> = None;
    for span in supports.windows(2) {
        let (from, to) = (cable.sample(span[0])?.position, cable.sample(span[1])?.position);
        let across = level(to - from);
        // a vertical span has no sag
        if across.norm() <= 1e-9 * cable.length() {
            continue;
        }
        let points =
            nodes.windows(2).flat_map(|s| (0..POINTS).map(move |k| s[0] + (s[1] - s[0]) * k as f64 / POINTS as f64));
        for s in points.filter(|s| (span[0]..=span[1]).contains(s)).chain([span[1]]) {
            let offset = cable.sample(s)?.position - from;
            let share = level(offset).dot(&across) / across.norm_squared();
            let below = (offset - (to - from) * share).dot(&down);
            largest = Some(largest.map_or(below, |sag| sag.max(below)));
        }
    }
    Ok(largest)
}
