//! What a cable says about its own mesh: an indicator of the error of position, and the jump of the
//! tension between elements.
//!
//! # Equation
//!
//! The third derivative of a cubic is constant, `r''' = 12 (r_i - r_j)/h^3 + 6 (t_i + t_j)/h^2`,
//! and its jump at a node is `h r''''` to the leading order. The indicator is `eta = max
//! h^3 |[[r''']]|/96`, h the longer element at the node: four times the error of cubic Hermite
//! interpolation, `h^4 r''''/384`. On a circle of curvature kappa it is `h^4 kappa^3/96`.
//!
//! Nodes with a support, an attached body, a point load or a change of section are left out,
//! because r''' jumps there in the exact solution, too. An element between two such nodes or ends
//! of the cable has no node that judges it; for it the angle between its end slopes is read.
//!
//! # Validity
//!
//! In statics the indicator is within 0.25 to 4.1 of the largest error of position, for
//! cantilevers, arcs, catenaries and clamped boundary layers (`tests/mesh_indicator.rs`), and up to
//! ten times too large for a stiff catenary, five for a shallow one of four elements; near the
//! limit point of a column it is up to 20 times too small. In dynamics it is no bound: waves
//! accumulate errors which it does not see, and it is blind to axial waves.
//!
//! # References
//!
//! Error of Hermite interpolation: Prenter 1975, section 3.3. Jumps as indicators: Babuska and
//! Rheinboldt 1978. The factor 96 was measured against fine meshes.
//!
//! # Alternatives considered
//!
//! - Jumps of the curvature: zero on circles, and superconvergent on uniform meshes only.
//! - Recovery of the curvature (Zienkiewicz and Zhu): no relation to the error of position.
//! - One Newton step on the divided mesh: costs a factorisation, and the raw strain of the coarse
//!   shape appears as a load.

use super::Cable;
use crate::element::shape::combine;
use crate::error::Error;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// What the shape of a cable says about its mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct MeshIndicator {
    /// Estimate of the largest error of position in m; 0 if no node judges.
    pub position: f64,
    /// Largest angle in rad between the end slopes of an element that no node judges; 0 if there is
    /// none.
    pub turn: f64,
}

/// What a displacement says about the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct MotionIndicator {
    /// Estimate of the largest error of the displacement in m.
    pub error: f64,
    /// Largest displacement of a node in m.
    pub displacement: f64,
}

impl Cable {
    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn mesh_indicator(&self) -> MeshIndicator {
        let q = self.positions();
        let (mut turn, mut judged_before) = (0.0f64, false);
        let position = self.largest_jump(
            |e| self.third(q, e),
            |e, judged| {
                if !judged && !judged_before {
                    let [a, b] = [e, e + 1].map(|node| Vector3::from_column_slice(&q[6 * node + 3..6 * node + 6]));
                    turn = turn.max(a.cross(&b).norm().atan2(a.dot(&b)));
                }
                judged_before = judged;
            },
        );
        MeshIndicator { position, turn }
    }

    /// See [`Linearisation`](crate::coupling::Linearisation).
    pub(crate) fn motion_indicator(&self, start: &[f64]) -> Result<MotionIndicator, Error> {
        let q = self.positions();
        if start.len() != q.len() {
            let (cable, count) = (self.name().to_string(), start.len());
            return Err(Error::WrongCount { cable, what: "coordinates", count, expected: q.len() });
        }
        let error = self.largest_jump(|e| self.third(q, e) - self.third(start, e), |_, _| {});
        let moved = q.chunks_exact(6).zip(start.chunks_exact(6)).map(|(now, then)| {
            (Vector3::from_column_slice(&now[..3]) - Vector3::from_column_slice(&then[..3])).norm_squared()
        });
        Ok(MotionIndicator { error, displacement: moved.fold(0.0, f64::max).sqrt() })
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn tension_jump(&self) -> Option<f64> {
        let mut largest: Option<f64> = None;
        self.visit_elements(|e, judged| {
            if judged {
                let [before, behind] = [e, e + 1].map(|e| self.reading().ends(e));
                let jump = (before[1].tension - behind[0].tension).abs();
                largest = Some(largest.map_or(jump, |x| x.max(jump)));
            }
        });
        largest
    }

    /// Returns whether a node between the ends is held.
    pub(crate) fn is_held_between_ends(&self) -> bool {
        self.model.supports.iter().any(|(node, _)| 0 < *node && *node < self.elements().len())
    }

    /// Returns the elastic tension that is the largest share of EA, read at both ends of every
    /// element: the share, the tension in N, and EA in N there.
    pub(crate) fn largest_strain(&self) -> (f64, f64, f64) {
        let (q, mut largest, mut s) = (self.positions(), (0.0, 0.0, 0.0), 0.0);
        let rest = self.effects().rest_shape.as_ref();
        let is_green = self.effects().axial_law.is_none();
        for (e, element) in self.elements().iter().enumerate() {
            let stretch = rest.map_or(1.0, |rest| rest.at(s + 0.5 * element.length).0);
            s += element.length;
            let at = self.system.forces.elements.gram_state(e, q, &[]);
            for xi in [0.0, 1.0] {
                let strain = at.table.strain(&at.g, xi);
                let share = (strain - 0.5 * (stretch * stretch - 1.0)) * (1.0 + 2.0 * strain).max(0.0).sqrt();
                if share > largest.0 {
                    let stiffness = element.section.axial_stiffness;
                    let tension = match is_green && self.model.axial_stiffness(element) == stiffness {
                        true => share * stiffness,
                        false => self.reading().pull(e, xi, &at).tension,
                    };
                    // what a rope that does not push is stretched by at a kink pulls at nothing
                    if tension > 0.0 {
                        largest = (share, tension, stiffness);
                    }
                }
            }
        }
        largest
    }

    /// Calls `visit` for each element in order, with whether its last node judges the mesh.
    fn visit_elements(&self, mut visit: impl FnMut(usize, bool)) {
        let elements = self.elements();
        let mut s = 0.0;
        for (e, element) in elements.iter().enumerate() {
            let node = e + 1;
            s += element.length;
            visit(e, node < elements.len() && self.model.is_smooth_at(node, s));
        }
    }

    /// Returns h^3 r''' of an element in m.
    fn third(&self, q: &[f64], e: usize) -> Vector3<f64> {
        let h = self.elements()[e].length;
        combine(q, e, &[12.0, 6.0 * h, -12.0, 6.0 * h])
    }

    /// Returns the largest h^3 |[[r''']]|/96 in m at the nodes that judge, h^3 r''' being given by
    /// `third`; calls `visit` as [`visit_elements`](Self::visit_elements) does.
    fn largest_jump(&self, third: impl Fn(usize) -> Vector3<f64>, mut visit: impl FnMut(usize, bool)) -> f64 {
        let (mut square, mut next) = (0.0f64, None);
        self.visit_elements(|e, judged| {
            visit(e, judged);
            let known = next.take();
            if judged {
                let [a, b] = [e, e + 1].map(|e| self.elements()[e].length);
                let h = a.max(b);
                let scaled = |third: Vector3<f64>, l: f64| if l == h { third } else { third * (h / l).powi(3) };
                let (one, two) = (known.unwrap_or_else(|| third(e)), third(e + 1));
                square = square.max((scaled(two, b) - scaled(one, a)).norm_squared());
                next = Some(two);
            }
        });
        square.sqrt() / 96.0
    }
}
