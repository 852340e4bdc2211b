//! What the cables of a run carry: tensions or moments by time, and where they bend sharply.
//!
//! # Equation
//!
//! Recorded are, on both sides, the values at the nodes that are held, loaded or ends, as probes
//! have them, and the largest value of all nodes, both by nodal equilibrium, and what probes read.
//! Two runs differ at a time by the largest difference of these; if a share is asked for, of each
//! cable as a share of the largest value that it has in the finer run.
//!
//! An error `e` of what is carried is an error of positions
//!
//! ```text
//! x = e L/(pi EA)  of a tension        x = e L^2/(pi^2 EI)  of a moment
//! ```
//!
//! in the slowest vibration of the cable that changes it, at most [`MOST_LENGTH`] of its length.
//! Tolerances of steps begin with the least x, as they do with an error of positions: vibrations
//! that are smaller than the tolerance are in no run.
//!
//! # Validity
//!
//! A front of tension that runs along a cable is at another place in another mesh, and no mesh
//! proves the tension at a time when it is near a point. A largest value counts as at least
//! [`LEAST_LARGEST`] of that of all cables, and a largest tension as the largest moment over the
//! length of the cable, which is a force across it: a bar that is bent alone has no tension but
//! that of its mesh.

use super::target::{Quantity, Target};
use crate::cable::{Cable, SharpBend};
use crate::scales::study::{LEAST_LARGEST, MOST_LENGTH};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// Values of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Forces {
    /// The values of all frames, with the cable of each.
    values: Vec<(usize, Vector3<f64>)>,
    /// By frame, the number of values up to it.
    ends: Vec<usize>,
    cables: Vec<Carrier>,
}

/// What is known of a cable.
#[derive(Clone, Debug)]
struct Carrier {
    /// Largest value in N or N m, or what it counts as.
    largest: f64,
    length: f64,
    axial_stiffness: f64,
    bending_stiffness: f64,
    bends: Vec<SharpBend>,
}

impl Forces {
    pub fn frame(&mut self) {
        self.ends.push(self.values.len());
    }

    /// Records what a cable carries.
    pub fn cable(&mut self, index: usize, cable: &Cable, quantity: Quantity) {
        while self.cables.len() <= index {
            let of = |stiffness: fn(&crate::Section) -> f64| {
                cable.elements().iter().map(|element| stiffness(&element.section)).fold(0.0, f64::max)
            };
            self.cables.push(Carrier {
                largest: 0.0,
                length: cable.length(),
                axial_stiffness: of(|section| section.axial_stiffness),
                bending_stiffness: of(|section| section.bending_stiffness),
                bends: Vec::new(),
            });
        }
        let (mut most, mut across): (f64, f64) = (0.0, 0.0);
        let (last, mut from) = (cable.elements().len() - 1, 0.0);
        for (e, element) in cable.elements().iter().enumerate() {
            let ends = [from, from + element.length];
            let carried = cable.carried(e);
            for k in [0, 1] {
                let value = match &carried {
                    Some(carried) => [Vector3::new(carried[k].tension, 0.0, 0.0), carried[k].moment],
                    None => {
                        let sample = cable.smooth_in(e, k as f64);
                        [Vector3::new(sample.tension, 0.0, 0.0), sample.moment]
                    }
                };
                across = across.max(value[1].norm() / cable.length());
                let value = value[usize::from(quantity == Quantity::Moment)];
                most = most.max(value.norm());
                let (outer, node) = (if k == 0 { e == 0 } else { e == last }, e + k);
                if outer || !cable.model.is_smooth_at(node, ends[k]) {
                    self.push(index, value);
                }
            }
            from = ends[1];
        }
        self.push(index, Vector3::new(most, 0.0, 0.0));
        if quantity == Quantity::Tension {
            self.cables[index].largest = self.cables[index].largest.max(across);
        }
        cable.sharp_bends().into_iter().for_each(|bend| bend.add_to(&mut self.cables[index].bends));
    }

    /// Records what a cable carries at a point that is read.
    pub fn sample(&mut self, index: usize, sample: &crate::Sample, quantity: Quantity) {
        let value = self.value(sample, quantity);
        self.push(index, value);
    }

    fn value(&self, sample: &crate::Sample, quantity: Quantity) -> Vector3<f64> {
        match quantity {
            Quantity::Position | Quantity::Tension => Vector3::new(sample.tension, 0.0, 0.0),
            Quantity::Moment => sample.moment,
        }
    }

    fn push(&mut self, index: usize, value: Vector3<f64>) {
        if let Some(cable) = self.cables.get_mut(index) {
            cable.largest = cable.largest.max(value.norm());
        }
        self.values.push((index, value));
        if let Some(end) = self.ends.last_mut() {
            *end = self.values.len();
        }
    }

    /// Returns the largest difference of two runs at a frame, as shares of what the other one
    /// carries if `relative`; infinite if they have not the same parts, or are not numbers.
    pub fn apart(&self, other: &Forces, frame: usize, relative: bool) -> f64 {
        let of = |forces: &Forces| {
            let start = frame.checked_sub(1).map_or(0, |before| forces.ends[before]);
            start..forces.ends[frame]
        };
        let (a, b) = (&self.values[of(self)], &other.values[of(other)]);
        if a.len() != b.len() {
            return f64::INFINITY;
        }
        let least = LEAST_LARGEST * other.largest();
        a.iter().zip(b).fold(0.0, |largest: f64, ((index, a), (_, b))| {
            let scale = if relative { other.cables[*index].largest.max(least) } else { 1.0 };
            let difference = (a - b).norm();
            let share = if difference == 0.0 { 0.0 } else { difference / scale };
            if share.is_nan() { f64::INFINITY } else { largest.max(share) }
        })
    }

    /// Returns the largest value of all cables in N or N m.
    pub fn largest(&self) -> f64 {
        self.cables.iter().fold(0.0, |largest, cable| largest.max(cable.largest))
    }

    /// Returns the places where a cable bends sharply.
    pub fn bends(&self, index: usize) -> &[SharpBend] {
        self.cables.get(index).map_or(&[], |cable| &cable.bends)
    }

    /// Returns the error of positions in m that has an error of what is carried as its
    /// consequence; `None` where nothing is carried.
    pub fn as_position(&self, target: &Target) -> Option<f64> {
        let least = LEAST_LARGEST * self.largest();
        let of_cable = |cable: &Carrier| {
            let error = if target.relative { target.error * cable.largest.max(least) } else { target.error };
            let length = match target.quantity {
                Quantity::Position => target.error,
                Quantity::Tension => error * cable.length / (PI * cable.axial_stiffness),
                Quantity::Moment => error * (cable.length / PI).powi(2) / cable.bending_stiffness,
            };
            let length = length.min(MOST_LENGTH * cable.length);
            (length.is_finite() && length > 0.0).then_some(length)
        };
        self.cables.iter().filter_map(of_cable).reduce(f64::min)
    }
}
