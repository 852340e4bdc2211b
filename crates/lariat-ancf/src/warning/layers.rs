//! Moments and positions at clamps, loads and held points, beside which the elements are longer
//! than what bends there.
//!
//! # Validity
//!
//! By the layer of an elastica, as `cable/carried.rs` has it: the moment of a clamp is told where
//! the mesh has it 10 % larger, and bending strains the cable by a tenth of what tension does, `d/2
//! M/EI = 2 theta sqrt(F/EA)` of a solid round section; the position where it is off by 2e-3 of the
//! length. Both errors are of first order in the length of the elements beside the point, and in
//! nothing else: a [graded](crate::CableBuilder::finest) mesh takes them away. The moment at a load
//! or a held point whose slope is free is read as that of the elastica, on every mesh, and there is
//! nothing to tell of it; at a load inside an element it is that of the mesh, and is told where it
//! is 10 % off.

use super::Warning;
use super::advised::AdvisedMesh;
use crate::at::At;
use crate::cable::{Cable, Layer};
use crate::scales::cable::AT_NODE;
use crate::scales::watch::{BENDS, ERROR, FINEST, GROWTH, MOMENT, MOST, SMEARED};
use crate::watch::{CoarseKink, CoarseMoment, Layers};

impl Layers {
    /// Reads a cable.
    pub(super) fn note(&mut self, cable: &Cable) {
        let limit = ERROR * cable.length();
        let mut note = |layer: Layer| {
            let Layer { arc_length: at, element, scale, moments, strain, angle, held, inside, .. } = layer;
            let [_, elastica] = moments;
            let bends = (held || inside) && 2.0 * (0.5 * angle).sin() > BENDS * strain.sqrt();
            // at a load inside an element the mesh has less
            let ratio =
                |[mesh, elastica]: [f64; 2]| if inside && mesh < elastica { elastica / mesh } else { mesh / elastica };
            let worse = |other: CoarseMoment| ratio(moments) > ratio(other.moments);
            if elastica > 0.0 && ratio(moments) > 1.0 + MOMENT && bends && self.moment.is_none_or(worse) {
                self.moment = Some(CoarseMoment { at, moments, scale });
            }
            let error = SMEARED * layer.lever();
            if error > limit && self.kink.is_none_or(|other| error > other.error) {
                self.kink = Some(CoarseKink { at, error, element });
            }
        };
        cable.visit_layers(&mut note);
        cable.visit_inner_layers(&mut note);
    }

    /// Returns the warning about a moment.
    pub(super) fn moment(&self, cable: &Cable) -> Option<Warning> {
        let CoarseMoment { at, moments: [moment_nm, elastica_nm], scale } = self.moment?;
        Some(Warning::CoarseMoment {
            cable: cable.name().to_string(),
            arc_length_m: at,
            moment_nm,
            elastica_nm,
            layer_m: scale,
            elements: cable.elements().len(),
            enough: advised(cable, at, FINEST * scale),
        })
    }

    /// Returns the warning about a position.
    pub(super) fn kink(&self, cable: &Cable) -> Option<Warning> {
        let CoarseKink { at, error: error_m, element } = self.kink?;
        // of first order, to half the limit
        let finest = element * 0.5 * ERROR * cable.length() / error_m;
        Some(Warning::CoarseKink {
            cable: cable.name().to_string(),
            arc_length_m: at,
            error_m,
            elements: cable.elements().len(),
            enough: advised(cable, at, finest),
        })
    }
}

/// Returns a mesh with elements of a length in m at a point and at all others that have layers, and
/// elsewhere no longer ones than now.
fn advised(cable: &Cable, at: f64, finest: f64) -> AdvisedMesh {
    let (mut points, mut more) = (vec![at], 0.0);
    let mut add = |element: f64| more += (element / finest).ln().max(0.0) / GROWTH.ln();
    let mut add_layer = |layer: Layer| {
        points.push(layer.arc_length);
        add(layer.element);
    };
    cable.visit_layers(&mut add_layer);
    cable.visit_inner_layers(&mut add_layer);
    if points.len() == 1 {
        let mean = cable.length() / cable.elements().len() as f64;
        add(mean);
        add(mean);
    }
    points.sort_by(f64::total_cmp);
    points.dedup();
    let elements = (cable.elements().len() as f64 + more).ceil();
    let even = (cable.length() / finest).ceil();
    if even <= elements {
        return AdvisedMesh { elements: even as usize, ..AdvisedMesh::default() };
    }
    AdvisedMesh {
        elements: elements.min(MOST) as usize,
        finest_m: Some(finest),
        at: points.into_iter().map(|s| place(cable, s)).collect(),
    }
}

/// Returns a point at an arc length in m of a cable.
fn place(cable: &Cable, s: f64) -> At {
    let near = AT_NODE * cable.length();
    match s {
        s if s <= near => At::Start,
        s if s >= cable.length() - near => At::End,
        s => At::ArcLength(s),
    }
}
