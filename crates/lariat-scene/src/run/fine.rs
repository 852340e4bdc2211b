//! Where the meshes of a run to an error of moments or tensions are fine.
//!
//! # Equation
//!
//! A cable of stiffness EI under a tension T bends within `b = sqrt(EI/T)` of clamps, loads and held
//! points. The first mesh of a cable has elements of `f = 4 b` there, by the largest tension that a
//! first run finds, and as many as they need to grow from there by a ratio of 1.9; each further
//! mesh of n times as many has elements of `f/n`, so that all elements are refined alike.
//!
//! # Validity
//!
//! Not where material runs through an end, and not where the first run found elements that are
//! shorter than b already.

use crate::scene::Scene;
use crate::scene::elements::Grading;
use lariat_ancf::study::{Record, Resolution};

/// Largest elements of the first mesh at a point, over the length within which the cable bends there. Measured: a moment is read
/// within 5 % beside such elements and within 2 % beside those of the next mesh (tests/error_forces.rs).
const FIRST_FINEST: f64 = 4.0;
/// Ratio of neighbouring elements of the first mesh. Derived: builders accept a factor of 2, which rounding is not to exceed.
const GROWTH: f64 = 1.9;

/// The first meshes of the cables.
pub(super) struct Meshes {
    /// Elements of the cable that has most in the first mesh.
    first: usize,
    /// By cable, its elements in the first mesh and where they are fine.
    cables: Vec<(usize, Option<Grading>)>,
}

impl Meshes {
    /// Chooses the meshes by a first run, and tells the study with how many elements they begin.
    pub fn chosen(scene: &Scene, record: &mut Record) -> Self {
        // parts that a break left come behind the cables of the scene
        let least = Resolution { elements: 4, ..Resolution::default() };
        let largest = scene.cables.iter().map(|cable| cable.elements).max().unwrap_or(1);
        let cables: Vec<_> = scene
            .cables
            .iter()
            .enumerate()
            .map(|(index, cable)| {
                let even = least.elements_of(cable.elements, largest);
                let eyes = scene.eyes(index);
                let open =
                    |s: f64| !(eyes[0] && s <= 1e-9 * cable.length || eyes[1] && s >= (1.0 - 1e-9) * cable.length);
                let bends: Vec<_> = record.sharp_bends(index).iter().filter(|bend| open(bend.arc_length)).collect();
                let Some(finest) = bends.iter().map(|bend| FIRST_FINEST * bend.length).reduce(f64::min) else {
                    return (even, None);
                };
                let mut points: Vec<f64> = bends.iter().map(|bend| bend.arc_length).collect();
                points.sort_by(f64::total_cmp);
                let elements = needed(&points, cable.length, finest).max(even);
                // an even mesh is as fine
                let graded = finest * (elements as f64) < cable.length;
                (elements, graded.then_some(Grading { finest, points }))
            })
            .collect();
        let first = cables.iter().map(|(elements, _)| *elements).max().unwrap_or(4);
        record.begin_with(first);
        Meshes { first, cables }
    }

    /// Gives a cable of a scene its mesh at a resolution.
    pub fn give(&self, scene: &mut Scene, resolution: &Resolution) {
        for (cable, (elements, grading)) in scene.cables.iter_mut().zip(&self.cables) {
            let share = resolution.elements as f64 / self.first as f64;
            cable.elements = (*elements as f64 * share).ceil() as usize;
            let finer = |grading: &Grading| Grading { finest: grading.finest / share, points: grading.points.clone() };
            cable.grading = grading.as_ref().map(finer);
        }
    }
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
