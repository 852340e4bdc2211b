//! Where meshes are fine: those of a run to an error of moments or tensions, and those that statics choose.
//!
//! # Equation
//!
//! A cable of stiffness EI under a tension T bends within `b = sqrt(EI/T)` of clamps, loads and held
//! points. The first mesh of a cable has elements of `f = 4 b` there, by the largest tension that a
//! first run finds, and as many as they need to grow from there by a ratio of 1.9; each further
//! mesh of n times as many has elements of `f/n`, so that all elements are refined alike. `finest = "auto"` has elements of `2 b`
//! by the tension in the equilibrium of an even mesh, and at least a thousandth of the even ones, which do where b is 0 and no kink can be.
//!
//! # Validity
//!
//! Not where material runs through an end, and not where the first run found elements that are
//! shorter than b already.

use super::World;
use crate::error::Error;
use crate::scene::elements::{Fine, Grading};
use crate::scene::{Purpose, Scene};
use lariat_ancf::SharpBend;
use lariat_ancf::study::{Record, Resolution};
use std::borrow::Cow;

/// Largest elements of the first mesh at a point, over the length within which the cable bends there. Measured: a moment is read
/// within 5 % beside such elements and within 2 % beside those of the next mesh (tests/error_forces.rs).
const FIRST_FINEST: f64 = 4.0;
/// The same of a mesh that statics choose. Measured: points are at most 2.5e-3 m off on a cable of 11 m with 4 elements (docs/accuracy/kinks.csv).
const CHOSEN_FINEST: f64 = 2.0;
/// Least elements at a point over the even ones. Derived: what a corner without a hinge takes of the length is of the first order in
/// them, and so a thousandth of what even ones take.
const LEAST_FINEST: f64 = 1e-3;
/// Ratio of neighbouring elements of the first mesh. Derived: builders accept a factor of 2, which rounding is not to exceed.
const GROWTH: f64 = 1.9;

/// The first meshes of the cables.
pub(super) struct Meshes {
    /// Elements of the cable that has most in the first mesh.
    first: usize,
    /// By cable, its elements in the first mesh and where they are fine.
    cables: Vec<(usize, Fine)>,
}

impl Meshes {
    /// Chooses the meshes by a first run, and tells the study with how many elements they begin.
    pub fn chosen(scene: &Scene, record: &mut Record) -> Self {
        // parts that a break left come behind the cables of the scene
        let least = Resolution { elements: 4, ..Resolution::default() };
        let largest = scene.cables.iter().map(|cable| cable.elements).max().unwrap_or(1);
        let of = |index: usize| {
            let even = least.elements_of(scene.cables[index].elements, largest);
            mesh(scene, index, record.sharp_bends(index), even, |length| FIRST_FINEST * length)
        };
        let cables: Vec<_> = (0..scene.cables.len()).map(of).collect();
        let first = cables.iter().map(|(elements, _)| *elements).max().unwrap_or(4);
        record.begin_with(first);
        Meshes { first, cables }
    }

    /// Gives a cable of a scene its mesh at a resolution.
    pub fn give(&self, scene: &mut Scene, resolution: &Resolution) {
        for (cable, (elements, fine)) in scene.cables.iter_mut().zip(&self.cables) {
            let share = resolution.elements as f64 / self.first as f64;
            cable.elements = (*elements as f64 * share).ceil() as usize;
            cable.fine = match fine {
                Fine::At(Grading { finest, points }) => {
                    Fine::At(Grading { finest: finest / share, points: points.clone() })
                }
                other => other.clone(),
            };
        }
    }
}

/// Returns a scene with the meshes that statics choose, if there are any.
///
/// # Errors
/// [`Error::NoChosenMesh`] of a scene without equilibrium, and those of [`World::drawn`].
pub(super) fn with_chosen(scene: &Scene) -> Result<Cow<'_, Scene>, Error> {
    let chosen = |index: usize| scene.cables[index].fine == Fine::ByStatics;
    let Some(first) = (0..scene.cables.len()).find(|&index| chosen(index)) else {
        return Ok(Cow::Borrowed(scene));
    };
    let name = scene.cables[first].name.clone();
    let mut scene = scene.clone();
    scene.cables.iter_mut().filter(|cable| cable.fine == Fine::ByStatics).for_each(|cable| cable.nodes_at_loads = true);
    let mut world = World::drawn(&scene)?;
    let started = world.start(Purpose::Static);
    started.map_err(|source| Error::NoChosenMesh { cable: name, source: Box::new(source) })?;
    Ok(Cow::Owned(refined(&world, chosen)))
}

/// Returns the scene of a world in equilibrium with meshes of some of its cables that are fine where they bend sharply.
pub(super) fn refined(world: &World, chosen: impl Fn(usize) -> bool) -> Scene {
    let mut scene = world.scene.clone();
    for (index, cable) in world.cables().into_iter().enumerate().filter(|(index, _)| chosen(*index)) {
        let own = &scene.cables[index];
        let least = LEAST_FINEST * own.length / own.elements as f64;
        let finest = |length: f64| (CHOSEN_FINEST * length).max(least);
        let (elements, fine) = mesh(&scene, index, &cable.sharp_bends(), own.elements, finest);
        let own = &mut scene.cables[index];
        (own.elements, own.fine, own.nodes_at_loads) = (elements, fine, true);
    }
    scene
}

/// Returns the number of elements of a cable, at least `even`, and where they are fine: where it bends sharply, with the length that
/// `finest` makes of that of the sharpest bend.
fn mesh(scene: &Scene, index: usize, bends: &[SharpBend], even: usize, finest: impl Fn(f64) -> f64) -> (usize, Fine) {
    let length = scene.cables[index].length;
    let eyes = scene.eyes(index);
    let open = |s: f64| !(eyes[0] && s <= 1e-9 * length || eyes[1] && s >= (1.0 - 1e-9) * length);
    let bends: Vec<_> = bends.iter().filter(|bend| open(bend.arc_length)).collect();
    let Some(finest) = bends.iter().map(|bend| finest(bend.length)).reduce(f64::min) else {
        return (even, Fine::Nowhere);
    };
    let mut points: Vec<f64> = bends.iter().map(|bend| bend.arc_length).collect();
    points.sort_by(f64::total_cmp);
    let elements = needed(&points, length, finest).max(even);
    // an even mesh is as fine
    let graded = finest * (elements as f64) < length;
    (elements, if graded { Fine::At(Grading { finest, points }) } else { Fine::Nowhere })
}

/// Returns the number of elements that grow from `finest` (m) at points of a cable of a length in m.
fn needed(points: &[f64], length: f64, finest: f64) -> usize {
    let c = GROWTH.ln();
    let a = finest * c / c.exp_m1();
    let count = |distance: f64| (c * distance / a).ln_1p() / c;
    let between = points.windows(2).map(|ends| 2.0 * count(0.5 * (ends[1] - ends[0])));
    let outer = points.first().into_iter().copied().chain(points.last().map(|last| length - last)).map(count);
    between.chain(outer).sum::<f64>().ceil() as usize
}
