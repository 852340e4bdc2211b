//! What a run of a study records: positions by time, and the meshes and the work of its cables.

use super::StudyError;
use super::forces::Forces;
use super::target::{Quantity, Target};
use crate::Sample;
use crate::SharpBend;
use crate::cable::Cable;
use crate::point::Point;
use crate::scales::study::{INDICATED, INDICATOR_ROUNDING, KINKS, RECORDED, SMOOTH, SURE};
use nalgebra::Vector3;

/// The positions that a run recorded.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// Recorded times in s.
    times: Vec<f64>,
    /// By time, the number of points up to it.
    ends: Vec<usize>,
    points: Vec<Vector3<f64>>,
    cables: Vec<CableRecord>,
    /// Cables of the present frame.
    present: usize,
    /// Largest [mesh indicator](crate::coupling::Linearisation::mesh_indicator) in m.
    indicator: f64,
    /// True if velocities jump in the motion.
    jumps: bool,
    /// True if a cable is held between its ends, and if one is not smooth there: held, loaded, or
    /// of several sections.
    held: bool,
    kinked: bool,
    /// What is asked for, and what cables carry if it is no position.
    target: Target,
    forces: Forces,
    /// Number of elements that the first mesh is to have, if the world says so.
    first: Option<usize>,
}

/// Mesh and work of a cable.
#[derive(Clone, Debug)]
struct CableRecord {
    /// Arc lengths of the nodes in m, as first recorded.
    nodes: Vec<f64>,
    steps: u64,
    evaluations: u64,
}

impl Record {
    /// Returns an empty record of a run that a target is asked of.
    pub(super) fn of(target: Target) -> Self {
        Record { target, ..Record::default() }
    }

    /// Begins a frame at a time in s; what is recorded next belongs to it.
    pub fn frame(&mut self, time: f64) -> &mut Self {
        self.times.push(time);
        self.ends.push(self.points.len());
        self.forces.frame();
        self.present = 0;
        self
    }

    /// Tells that velocities jump in the motion, where a cable is set in motion in no time: from
    /// then on waves with kinks travel along it, which meshes resolve slowly.
    pub fn velocities_jump(&mut self) -> &mut Self {
        self.jumps = true;
        self
    }

    /// Records 33 points of a cable, and how far twist turns its surface. Cables are recorded in
    /// the same order in each frame.
    pub fn cable(&mut self, cable: &Cable) -> &mut Self {
        let diagnostics = cable.diagnostics();
        let (steps, evaluations) = (diagnostics.steps, diagnostics.element_evaluations());
        match self.cables.get_mut(self.present) {
            Some(known) => (known.steps, known.evaluations) = (steps, evaluations),
            None => {
                let nodes = cable.node_arc_lengths();
                self.held |= cable.is_held_between_ends();
                self.kinked |= (1..cable.elements().len()).any(|node| !cable.model.is_smooth_at(node, nodes[node]));
                self.cables.push(CableRecord { nodes, steps, evaluations });
            }
        }
        if self.carries() {
            self.forces.cable(self.present, cable, self.target.quantity);
        }
        self.present += 1;
        self.indicator = self.indicator.max(cable.mesh_indicator().position);
        for k in 0..RECORDED {
            self.push(cable.position_at(cable.length() * k as f64 / (RECORDED - 1) as f64));
        }
        for turned in cable.turned_surfaces() {
            self.push(Vector3::new(turned, 0.0, 0.0));
        }
        self
    }

    /// Records a point, such as the centre of a body, in m.
    pub fn point(&mut self, position: impl Into<Point>) -> &mut Self {
        self.push(position.into().0);
        self
    }

    /// Records what a cable carries where it is read, in the order of [`cable`](Self::cable): if an
    /// error of tensions or moments is asked for.
    pub fn sample(&mut self, cable: usize, sample: &Sample) -> &mut Self {
        if self.carries() {
            self.forces.sample(cable, sample, self.target.quantity);
        }
        self
    }

    /// Tells with how many elements the first mesh begins, in place of 4: in the first run of a
    /// study of tensions or moments, by which a world chooses where its meshes are fine.
    pub fn begin_with(&mut self, elements: usize) -> &mut Self {
        self.first = Some(elements);
        self
    }

    /// Returns where a cable, in the order of [`cable`](Self::cable), bends within a piece that is
    /// shorter than its elements; nothing in a study of positions.
    pub fn sharp_bends(&self, cable: usize) -> &[SharpBend] {
        self.forces.bends(cable)
    }

    /// Returns with how many elements the first mesh begins.
    pub(super) fn first_elements(&self) -> Option<usize> {
        self.first
    }

    /// Returns the error of positions in m that has the error that is asked for as its
    /// consequence.
    pub(super) fn as_position(&self) -> Option<f64> {
        self.forces.as_position(&self.target)
    }

    /// Returns whether what cables carry is compared.
    pub(super) fn carries(&self) -> bool {
        self.target.quantity != Quantity::Position
    }

    fn push(&mut self, position: Vector3<f64>) {
        self.points.push(position);
        if let Some(end) = self.ends.last_mut() {
            *end = self.points.len();
        }
    }

    /// Returns whether nothing is recorded.
    pub(super) fn is_empty(&self) -> bool {
        self.times.is_empty() || self.points.is_empty()
    }

    /// Returns the number of integration steps, all cables together.
    pub(super) fn steps(&self) -> u64 {
        self.cables.iter().map(|cable| cable.steps).sum()
    }

    /// Returns the number of integration steps of a cable in the mean; 1 without cables.
    pub(super) fn steps_of_one(&self) -> f64 {
        if self.cables.is_empty() { 1.0 } else { (self.steps() as f64 / self.cables.len() as f64).max(1.0) }
    }

    /// Returns the number of elements evaluated.
    pub(super) fn evaluations(&self) -> u64 {
        self.cables.iter().map(|cable| cable.evaluations).sum()
    }

    /// Returns the length of the longest cable in m.
    pub(super) fn longest(&self) -> f64 {
        self.cables.iter().filter_map(|cable| cable.nodes.last()).fold(0.0, |longest, &s| longest.max(s))
    }

    /// Returns the order that the mesh indicator shows between this mesh and a finer one of element
    /// lengths shorter by `ratio`; `None` for cables whose indicator is rounding, as that of
    /// straight ones.
    pub(super) fn indicated_order(&self, finer: &Record, ratio: f64) -> Option<f64> {
        if self.carries() {
            return None;
        }
        let order = (self.indicator / finer.indicator).ln() / ratio.ln();
        Some(order).filter(|order| order.is_finite() && finer.indicator > INDICATOR_ROUNDING * finer.longest())
    }

    /// Returns the largest order of convergence that the motion, or the equilibrium, allows after a
    /// number of distances between meshes, of which one shows no order; `seen` is the least that
    /// distances and indicator both show, of one distance that of the indicator.
    pub(super) fn largest_order(&self, equilibrium: bool, distances: usize, seen: Option<f64>) -> f64 {
        if equilibrium && self.carries() {
            return seen.map_or(1.0, |seen| (seen - SURE).clamp(KINKS, SMOOTH));
        }
        let smooth = equilibrium && !self.held && !self.kinked && !self.jumps;
        match seen {
            Some(seen) if smooth && distances == 1 => seen.clamp(KINKS, SMOOTH),
            _ if distances == 1 || self.jumps || equilibrium && self.held => KINKS,
            Some(seen) if smooth => seen.clamp(1.0, SMOOTH),
            _ => 1.0,
        }
    }

    /// Returns what the mesh indicator allows to claim of an equilibrium, in m: the most by which
    /// it was found to fall below the error.
    pub(super) fn indicated_error(&self) -> f64 {
        INDICATED * self.indicator
    }

    /// Returns the largest difference of two runs at a frame, of what is asked for; infinite if
    /// they have not the same parts, or are not numbers.
    fn apart(&self, other: &Record, frame: usize) -> f64 {
        match self.carries() {
            true => self.forces.apart(&other.forces, frame, self.target.relative),
            false => self.positions_apart(other, frame),
        }
    }

    /// Returns the largest distance between the points of two runs in m.
    pub(super) fn largest_distance(&self, other: &Record) -> f64 {
        let frames = 0..self.times.len().min(other.times.len());
        frames.map(|frame| self.positions_apart(other, frame)).fold(0.0, f64::max)
    }

    /// Returns the largest distance between the points of two runs at a frame in m; infinite if
    /// they have not the same parts, or are not numbers.
    fn positions_apart(&self, other: &Record, frame: usize) -> f64 {
        let points = |record: &Record| {
            let start = frame.checked_sub(1).map_or(0, |before| record.ends[before]);
            start..record.ends[frame]
        };
        let (a, b) = (&self.points[points(self)], &other.points[points(other)]);
        if a.len() != b.len() {
            return f64::INFINITY;
        }
        let distances = a.iter().zip(b).map(|(a, b)| (a - b).norm());
        distances.fold(0.0, |largest, x| {
            if x <= largest {
                largest
            } else if x.is_nan() {
                f64::INFINITY
            } else {
                x
            }
        })
    }

    /// Returns the largest difference of two runs, of what is asked for.
    ///
    /// # Errors
    /// [`StudyError::DifferentTimes`].
    pub(super) fn distance<E>(&self, other: &Record) -> Result<f64, StudyError<E>> {
        let frames = self.times.len().max(other.times.len());
        let mut largest: f64 = 0.0;
        for frame in 0..frames {
            let [time, there] = [self, other].map(|record| record.times.get(frame).copied().unwrap_or(f64::NAN));
            let same = (time - there).abs() <= 1e-9 * (1.0 + time.abs());
            if !same {
                return Err(StudyError::DifferentTimes { time, other: there });
            }
            largest = largest.max(self.apart(other, frame));
        }
        Ok(largest)
    }

    /// Returns the first time in s at which two runs differ by more than `distance`.
    pub(super) fn first_beyond(&self, other: &Record, distance: f64) -> Option<f64> {
        let frames = 0..self.times.len().min(other.times.len());
        frames.into_iter().find(|&frame| self.apart(other, frame) > distance).map(|frame| self.times[frame])
    }

    /// Returns the first time that was recorded, in s.
    pub(super) fn first_time(&self) -> Option<f64> {
        self.times.first().copied()
    }

    /// Returns the least ratio of the element lengths of this mesh to those of a finer one, of
    /// `elements` and `finer_elements` elements, over all places whose elements are not as short as
    /// the finer mesh would have them already; 1 for other cables, and if a cable has no such
    /// place, because it is the same in both. Without cables, the ratio of the numbers of elements.
    pub(super) fn refinement(&self, finer: &Record, elements: usize, finer_elements: usize) -> f64 {
        if self.cables.len() != finer.cables.len() {
            return 1.0;
        }
        let ratios =
            self.cables.iter().zip(&finer.cables).map(|(coarse, fine)| coarse.refinement(fine, finer_elements));
        ratios.reduce(f64::min).unwrap_or(finer_elements as f64 / elements as f64)
    }
}

impl CableRecord {
    fn refinement(&self, finer: &CableRecord, elements: usize) -> f64 {
        let length = self.nodes.last().copied().unwrap_or(0.0);
        let short = length / elements as f64 * (1.0 + 1e-9);
        let mut least = f64::INFINITY;
        let mut k = 1;
        for ends in finer.nodes.windows(2) {
            let middle = 0.5 * (ends[0] + ends[1]);
            while k + 1 < self.nodes.len() && self.nodes[k] < middle {
                k += 1;
            }
            let here = self.nodes[k] - self.nodes[k - 1];
            if here > short {
                least = least.min(here / (ends[1] - ends[0]));
            }
        }
        if least.is_finite() { least } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{At, Effects, Section, Torsion};

    /// Runs of straight cables that differ in their twist alone differ by what it turns their
    /// surface.
    ///
    /// *Source.* r Phi; a solid round section has EI/EA = r^2/4.
    #[test]
    fn runs_that_differ_in_twist_differ() {
        let record = |turns: f64| {
            let torsion = Torsion { initial_twist: turns, ..Torsion::new(0.02) };
            let cable = Cable::builder()
                .points([Vector3::zeros(), Vector3::x()])
                .section(Section::from_stiffness(1e4, 2.5e-3, 0.1).unwrap())
                .elements(4)
                .clamp(At::Start)
                .clamp(At::End)
                .gravity(Vector3::zeros())
                .effects(Effects { torsion: Some(torsion), ..Effects::default() })
                .build()
                .unwrap();
            let mut record = Record::default();
            record.frame(0.0).cable(&cable);
            record
        };
        let apart = record(0.0).distance::<()>(&record(0.25)).unwrap();
        assert!((apart - 1e-3 * std::f64::consts::FRAC_PI_2).abs() < 1e-12, "{apart}");
    }
}
