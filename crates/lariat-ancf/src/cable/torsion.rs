//! Torque and twist of a cable with torsion.

use super::Cable;
use crate::effect::EndSpin;
use crate::effect::torsion::curve::Curve;
use crate::effect::torsion::lengths::Lengths;
use crate::effect::torsion::segment::{CurveChange, Segment};
use crate::effect::torsion::stranded::Strands;
use crate::element::side::Side;
use crate::error::Error;
use crate::state::SegmentTwist;
use crate::support::SlopeSupport;
use crate::system::project_vector;
use nalgebra::{DMatrix, DVector, Vector3};

/// Torsion of a cable between two neighbouring nodes that hold its spin.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TorsionReading {
    /// The two nodes, ascending.
    pub nodes: [usize; 2],
    /// Twist of the material in rad, right-handed positive, whole turns included.
    pub twist: f64,
    /// Elastic torque in N m about the axis in the direction of arc length, on what holds the first
    /// node; its opposite acts on what holds the last. That of damping is beside it.
    pub torque: f64,
    /// Twist per length in rad/m of unstretched cable; the mean of a rope whose tension makes
    /// torque.
    pub twist_rate: f64,
    /// Energy in J, that of [`Energy::torsion`](crate::Energy).
    pub energy: f64,
}

impl Cable {
    /// Returns torque and twist of each segment between nodes that hold the spin; none without
    /// [torsion](crate::Torsion), or where fewer than two clamps hold it.
    pub fn torsion(&self) -> Vec<TorsionReading> {
        let stiffness = self.model.effects.torsion.as_ref().map_or(f64::NAN, |torsion| torsion.stiffness);
        let reading = |(segment, twist): (Segment, SegmentTwist)| {
            let torque = self.torque_in(&segment, &twist);
            let twist_rate = match segment.strands {
                None => torque / stiffness,
                Some(_) => {
                    twist.twist
                        / self.elements()[segment.nodes[0]..segment.nodes[1]].iter().map(|e| e.length).sum::<f64>()
                }
            };
            let energy = 0.5 * torque * segment.loaded(self.elements(), self.positions(), twist.twist);
            TorsionReading { nodes: segment.nodes, twist: twist.twist, torque, twist_rate, energy }
        };
        self.segments().into_iter().map(reading).collect()
    }

    /// Returns the torque in N m of a segment.
    fn torque_in(&self, segment: &Segment, twist: &SegmentTwist) -> f64 {
        segment.torque(self.elements(), self.positions(), twist.twist)
    }

    /// Returns torque and twist at an arc length in m; `None` where no clamp on both sides holds
    /// the spin. At a clamp between two segments they are those of the first.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] beyond the cable.
    pub fn torsion_at(&self, arc_length: f64) -> Result<Option<TorsionReading>, Error> {
        let (element, _) = self.model.locate(self.on_cable(arc_length)?);
        let contains = |reading: &TorsionReading| (reading.nodes[0]..reading.nodes[1]).contains(&element);
        Ok(self.torsion().into_iter().find(contains))
    }

    /// Returns the sum of `f` over the segments with their twists, without an allocation while a
    /// run goes on.
    pub(crate) fn sum_of_segments(&self, f: impl Fn(&Segment, &SegmentTwist) -> f64) -> f64 {
        let known = self.snapshot.state.memory.torsion.as_deref().unwrap_or_default();
        let is_right = |(segment, twist): (Segment, &SegmentTwist)| segment.nodes == twist.nodes;
        if self.model.segments().count() == known.len() && self.model.segments().zip(known).all(is_right) {
            return self.model.segments().zip(known).map(|(segment, twist)| f(&segment, twist)).sum();
        }
        self.segments().iter().map(|(segment, twist)| f(segment, twist)).sum()
    }

    /// Returns the segments with their twists.
    pub(crate) fn segments(&self) -> Vec<(Segment, SegmentTwist)> {
        let mut segments = Vec::new();
        self.model.find_segments(&mut segments);
        if segments.is_empty() {
            return Vec::new();
        }
        let mut twists = self.snapshot.state.memory.torsion.clone();
        self.model.follow_holds(&segments, &mut twists);
        segments.into_iter().zip(twists.into_iter().flatten()).collect()
    }

    /// Returns whether torsion does nothing, because no two nodes hold the spin, nor ever did: not
    /// of the parts of a cable that was cut, or one that was let go.
    pub(crate) fn has_idle_torsion(&self) -> bool {
        let knows = self.snapshot.state.memory.torsion.is_some();
        self.model.effects.torsion.is_some() && !knows && self.model.segments().next().is_none()
    }

    /// Returns the nodes and the torque in N m, without its sign, of each segment, by the twists of
    /// the last step.
    fn torques(&self) -> impl Iterator<Item = ([usize; 2], f64)> + '_ {
        let torsion = self.model.effects.torsion.as_ref();
        let known = self.snapshot.state.memory.torsion.iter().flatten();
        let (elements, mut known) =
            (&self.model.elements, known.filter(|twist| twist.nodes[1] <= self.elements().len()));
        core::iter::from_fn(move || {
            let (torsion, twist) = (torsion?, known.next()?);
            let torque = match Strands::of(torsion) {
                None => {
                    let own = elements[twist.nodes[0]..twist.nodes[1]].iter();
                    torsion.stiffness * twist.twist / own.map(|element| element.length).sum::<f64>()
                }
                Some(_) => self.torque_in(
                    &Segment::between(torsion, self.model.effects.rest_shape.as_ref(), elements, twist.nodes),
                    twist,
                ),
            };
            Some((twist.nodes, torque.abs()))
        })
    }

    /// Returns the largest |M| l/EI of an element, by the twists of the last step.
    pub(crate) fn largest_twist(&self) -> f64 {
        let of = |([first, last], torque): ([usize; 2], f64)| {
            let own = self.elements()[first..last].iter();
            own.map(|e| torque * e.length / e.section.bending_stiffness).fold(0.0, f64::max)
        };
        self.torques().map(of).fold(0.0, f64::max)
    }

    /// Returns the torque in N m, the least tension in N and `int sqrt(M^2/4 EI^2 - T/EI) ds/pi` of
    /// the segment where that is largest: above 1 a straight one would go into a loop
    /// ([`warning`](crate::warning)).
    pub(crate) fn kinks(&self) -> [f64; 3] {
        let q = self.positions();
        let of = |([first, last], torque): ([usize; 2], f64)| {
            let mut least = f64::INFINITY;
            let wave = |e: usize| {
                let element = &self.elements()[e];
                let bending = element.section.bending_stiffness;
                let tension = self.reading().pull(e, 0.5, &self.system.forces.elements.gram_state(e, q, &[])).tension;
                least = least.min(tension);
                let square = (0.5 * torque / bending).powi(2) - tension.max(0.0) / bending;
                element.length * square.max(0.0).sqrt()
            };
            let share = (first..last).map(wave).sum::<f64>() / core::f64::consts::PI;
            [torque, least, share]
        };
        let all = self.torques().filter(|(_, torque)| *torque > 0.0).map(of);
        all.fold([0.0; 3], |most, own| if own[2] > most[2] { own } else { most })
    }

    /// Returns the largest GJ/EI of an element; not of a stranded rope, whose wires slide as it
    /// bends.
    pub(crate) fn largest_stiffness_ratio(&self) -> f64 {
        let Some(torsion) = self.model.effects.torsion.as_ref().filter(|own| own.torque_per_tension == 0.0) else {
            return 0.0;
        };
        self.elements().iter().map(|e| torsion.stiffness / e.section.bending_stiffness).fold(0.0, f64::max)
    }

    /// Returns whether a moment about the tangent at an arc length in m is held by what clamps the
    /// section there.
    pub(crate) fn holds_moment(&self, arc_length: f64) -> bool {
        let (element, xi) = self.model.locate(arc_length);
        let node = if xi == 0.0 { element } else { element + 1 };
        let clamped = self.model.support(node).is_some_and(|support| support.slope != SlopeSupport::Free);
        let spin = self.model.effects.torsion.as_ref().map(|torsion| self.model.end_spin(torsion, node));
        (xi == 0.0 || xi == 1.0) && clamped && spin != Some(&EndSpin::Swivel)
    }

    /// Returns by segment how far in m its twist turns the surface at its end: that of a solid
    /// round section of the same EA and EI.
    pub(crate) fn turned_surfaces(&self) -> Vec<f64> {
        let turned = |(segment, twist): (Segment, SegmentTwist)| {
            let section = &self.elements()[segment.nodes[0]].section;
            2.0 * (section.bending_stiffness / section.axial_stiffness).sqrt() * twist.twist
        };
        self.segments().into_iter().map(turned).collect()
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn spin_rate(&self) -> f64 {
        let (memory, fastest) =
            (&self.snapshot.state.memory, |most: f64, own: &SegmentTwist| most.max(own.change.abs()));
        let step = memory.differences.step;
        if step > 0.0 { memory.torsion.iter().flatten().fold(0.0, fastest) / step } else { 0.0 }
    }

    /// Returns whether no motor turns from now on.
    pub(crate) fn is_spin_still(&self) -> bool {
        self.model.effects.torsion.as_ref().is_none_or(|torsion| torsion.is_still(self.time()))
    }

    /// Calls `f` with forces as functions of the coordinates that have torsion in them.
    pub(crate) fn with_torsion<T>(&mut self, f: impl FnOnce(&mut Self) -> T) -> T {
        if self.model.effects.torsion.is_none() {
            return f(self);
        }
        let known = self.snapshot.state.memory.torsion.clone();
        self.system.torsion_forces.get_or_insert_default().begin(&self.model, &mut self.snapshot.state);
        self.snapshot.state.memory.torsion = known;
        let outcome = f(self);
        self.system.torsion_forces = None;
        outcome
    }

    /// Returns by which frequency in rad/s torsion raises the bound of all, squares added.
    pub(super) fn torsion_frequency(&self) -> f64 {
        let of = |(segment, twist): (Segment, SegmentTwist)| {
            let shape = (self.positions(), twist.twist);
            segment.frequency_square(self.elements(), shape, |element| self.model.inertia(element))
        };
        self.segments().into_iter().map(of).fold(0.0f64, f64::max).sqrt()
    }

    /// Begins a host step of a method that evaluates forces.
    pub(crate) fn begin_torsion(&mut self) {
        let Cable { model, snapshot, before, buffers, system, diagnostics, .. } = self;
        if model.effects.torsion.is_some() {
            let torsion = system.torsion_forces.insert(buffers.torsion.take().unwrap_or_default());
            diagnostics.twist_slips += torsion.begin_motion(model, &before.q, &mut snapshot.state);
        }
    }

    /// Returns the part of the stiffness that couples all coordinates of a segment, supports in
    /// place.
    pub(crate) fn torsion_stiffness(&self) -> DMatrix<f64> {
        let size = self.positions().len();
        let mut stiffness = DMatrix::zeros(size, size);
        for border in self.twist_borders() {
            let mut column = DVector::from_vec(border.gradient);
            project_vector(&self.model, column.as_mut_slice());
            stiffness += &column * column.transpose() * border.stiffness;
        }
        stiffness
    }

    /// Returns the torque in N m of torsion on what holds a node, with that of damping: the mean
    /// one of the last step.
    pub(crate) fn torsion_moment(&self, node: usize) -> Vector3<f64> {
        let step = self.snapshot.state.memory.differences.step;
        let retardation = self.model.effects.torsion.as_ref().map_or(0.0, |torsion| torsion.damping);
        let share = if step > 0.0 { retardation / step } else { 0.0 };
        let own = |(segment, twist): (Segment, SegmentTwist)| {
            let side = segment.nodes.iter().position(|held| *held == node)?;
            let damped = share * segment.stiffness * twist.change;
            Some([1.0, -1.0][side] * (self.torque_in(&segment, &twist) + damped))
        };
        let torque: f64 = self.segments().into_iter().filter_map(own).sum();
        let slope = Vector3::from_column_slice(&self.positions()[6 * node + 3..6 * node + 6]);
        slope.try_normalize(0.0).map_or_else(Vector3::zeros, |axis| axis * torque)
    }

    /// Returns the force dU/dl in N of torsion on the length of the element at the eye of an end,
    /// at rest.
    pub(crate) fn torsion_on_length(&self, side: Side) -> f64 {
        let (elements, q) = (self.elements(), self.positions());
        let e = side.element(elements.len());
        let Some((segment, twist)) = self.segments().into_iter().find(|(segment, _)| segment.contains(e)) else {
            return 0.0;
        };
        let Some(torsion) = &self.model.effects.torsion else { return 0.0 };
        let torque = segment.stiffness * twist.twist;
        let by_length = self.change_of_curve(&segment, side, elements[e].length, q).by_lengths[side as usize];
        torque * (by_length - 0.5 * torque / torsion.stiffness)
    }

    /// Returns what the curve adds to the twist of a segment if the element at the eye of an end
    /// had another length in m before.
    fn change_of_curve(&self, segment: &Segment, side: Side, before: f64, q: &[f64]) -> CurveChange {
        let length = self.elements()[side.element(self.elements().len())].length;
        let mut at_eyes = [None; 2];
        at_eyes[side as usize] = Some([before, length]);
        let lengths = Lengths::with_eyes(self.elements(), at_eyes);
        segment.change(&lengths, q, &vec![0.0; q.len()], &mut Vec::new())
    }

    /// Advances the twists by a change of the length in m of the element at the eye of an end, at
    /// rest.
    pub(super) fn follow_feed(&mut self, side: Side, before: f64) {
        let e = side.element(self.elements().len());
        let segments = self.follow_holds();
        for (number, segment) in segments.iter().enumerate().filter(|(_, segment)| segment.contains(e)) {
            let CurveChange { angle, slips, .. } = self.change_of_curve(segment, side, before, self.positions());
            self.diagnostics.twist_slips += slips;
            let twists = self.snapshot.state.memory.torsion.iter_mut().flatten();
            twists.skip(number).take(1).for_each(|twist| twist.twist += angle);
        }
    }

    /// Makes the twists those of the present holds, and returns the curves of the segments, to be
    /// given to [`follow_mesh`](Self::follow_mesh).
    pub(super) fn twisted_curves(&mut self) -> Vec<Curve> {
        self.follow_holds();
        let known = self.snapshot.state.memory.torsion.iter().flatten();
        known.map(|twist| Curve::between(twist.nodes, self.elements(), self.positions())).collect()
    }

    /// Advances the twists by a change of the mesh from other curves.
    pub(super) fn follow_mesh(&mut self, before: &[Curve]) {
        let changes: Vec<f64> =
            self.twisted_curves().iter().zip(before).map(|(now, then)| then.change_to(now)).collect();
        let twists = self.snapshot.state.memory.torsion.iter_mut().flatten();
        twists.zip(changes).for_each(|(twist, change)| twist.twist += change);
    }

    /// Makes the twists those of the present holds, and returns the segments: what lost a hold has
    /// lost its twist. As built the cable is not twisted, whatever its shape and holds.
    pub(crate) fn follow_holds(&mut self) -> Vec<Segment> {
        let mut segments = Vec::new();
        if self.snapshot.state.memory.torsion.is_some() {
            self.model.find_segments(&mut segments);
            self.model.follow_holds(&segments, &mut self.snapshot.state.memory.torsion);
        }
        segments
    }

    /// Advances the twists by a change of the coordinates from `before` that no step made, along
    /// great circles, and counts what slips.
    pub(crate) fn follow_twist(&mut self, before: &[f64]) {
        let segments = self.follow_holds();
        if segments.is_empty() {
            return;
        }
        let state = &mut self.snapshot.state;
        for (segment, twist) in segments.iter().zip(state.memory.torsion.iter_mut().flatten()) {
            let (angle, slips) = segment.follow(&self.model.elements, [before, &state.q]);
            twist.twist += angle;
            self.diagnostics.twist_slips += slips;
        }
    }
}
