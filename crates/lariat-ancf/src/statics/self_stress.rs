//! Elements that strain themselves: numerical equilibria whose tension nothing pulls.
//!
//! # Equation
//!
//! The tension at a point of a cable at rest is the component along it of the sum of all forces on
//! one side of the point. Without friction contacts turn it and do not change it. So it is not more
//! than the sizes of the loads and of the forces of what holds nodes, which are those that elements
//! have on them:
//!
//! ```text
//! |N| <= sum |loads| + sum_held |F_i|        F_i = forces of the elements on node i, N at the Gauss points of an element
//! ```
//!
//! An element that holds far more is folded in a way that no slope shows: its halves pull against
//! each other, or against a contact that a sample is in on the wrong side.
//!
//! # Validity
//!
//! Friction lets the tension grow by exp(mu theta), and at a sharp bend that a mesh does not
//! resolve the points of an element differ by some times the tension, so a multiple counts. Not at
//! a reel, where the element at the eye has its own law.
//!
//! # References
//!
//! Equilibrium of a part of a line (Irvine 1981, chapter 1).

use crate::cable::Cable;
use crate::effect::acts::ForceInput;
use crate::effect::work::POINTS;
use crate::model::LoadScale;
use crate::scales::statics::{SELF_STRAIN, SELF_STRESS};

/// Returns the first element whose tension at rest, at coordinates `q`, is far above what pulls.
pub(super) fn first_self_stress(cable: &Cable, q: &[f64]) -> Option<usize> {
    if cable.has_reel() {
        return None;
    }
    let (model, system) = (&cable.model, &cable.system);
    let mut forces = vec![0.0; q.len()];
    let input = ForceInput { time: cable.time(), q, v: &[], dv_dq: 0.0, scale: 1.0 };
    system.forces.elements.add_force(system.level, system.forces.in_element.as_ref(), input, &mut forces);
    let size = |f: &[f64]| (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]).sqrt();
    let held: f64 = model.supports.iter().map(|(node, _)| size(&forces[6 * node..])).sum();
    let pulls = LoadScale::new(model, q).force + held;
    let reading = cable.reading_at(q);
    (0..model.elements.len()).find(|&e| {
        let least = SELF_STRAIN * model.elements[e].section.axial_stiffness;
        let tension = reading.tensions(e, POINTS).into_iter().fold(0.0, |most: f64, n| most.max(n.abs()));
        tension > (SELF_STRESS * pulls).max(least)
    })
}
