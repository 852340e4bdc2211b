//! The elements at the eyes of reels, as data of a step.

use super::law::Law;
use crate::Real;
use crate::effect::acts::ForceInput;
use crate::element::gram::Control;
use crate::element::kernel::Stiffness;
use crate::element::side::Side;
use crate::element::variable_length::{Extent, Table, VariableLength};
use crate::linalg::BlockTridiagonal;
use crate::model::Model;
use crate::reel::Feed;

/// The impulse of the inertia of an element at an eye over a step by the coordinates at its
/// beginning, their change, velocities there, and their change.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Impulse {
    /// Time and length of the step in s.
    pub(super) step: (f64, f64),
    pub(super) tables: [Table; 4],
}

/// The element at the eye of a reel during a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FeedElement {
    /// The end of the cable at which it is.
    pub side: Side,
    /// Time in s at which the extent is.
    pub start: f64,
    /// Extent at that time; the acceleration stays.
    pub extent: Extent,
    /// Length in m of its mass and weight in the equations as they are set.
    pub(super) weighed: f64,
    /// Lengths and stock in m to which the equations are set; `None` if they are not set.
    pub(super) set: Option<[f64; 4]>,
    /// Force of the loop over the elements on the eye in the last iterate of the discrete gradient,
    /// in N.
    pub(super) eye_force: [f64; 3],
    /// Rate in m/s with which the last step ended, where this one begins with that of a drum.
    pub left_rate: Option<f64>,
    /// Length in m at the beginning of the last step.
    pub length_before: f64,
    /// Whether an end of the cable stops it.
    pub stopped: bool,
    /// How material comes to the eye.
    pub kind: Feed,
    /// What drives it, if its rate is an unknown.
    pub law: Option<Law>,
    /// Length in m that a reel with a motor can take in beside this element, with the revision of
    /// the cable of which that is.
    pub beside: Option<(u64, f64)>,
    /// Acceleration of the iterate about which the equations of a step are linear.
    pub(super) linearised: f64,
    /// Force in N of effects at Gauss points on the length, in the last iterate of the discrete
    /// gradient.
    pub(super) of_points: f64,
    /// Force in N of torsion on the length, dU/dl, in the last iterate.
    pub of_twist: f64,
    /// Forces on the length in an iterate of the discrete gradient: of a reel with a motor in the
    /// last one.
    pub(super) on_length: OnLength,
    /// Mean pull of the winch over the last step of the discrete gradient in N.
    pub pull: Option<f64>,
    /// Where the material at the eye comes from and goes to.
    pub source: Source,
}

/// What is behind an eye.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Source {
    /// Stock that is no part of the system.
    #[default]
    Outside,
    /// Stock that rides with the body at the eye; length in m of stock and element together.
    Stock(f64),
    /// Another cable, over a sheave.
    Cable,
}

/// Mean forces in N on the length of an element at an eye over a step of the discrete gradient.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OnLength {
    /// All: B.
    pub(super) force: f64,
    /// Strain energies in J, axial and bending, at the beginning of the step, once they are known,
    /// and at its end.
    pub(super) begin: Option<(f64, f64)>,
    pub(super) end: (f64, f64),
}

/// The elements at eyes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Feeds {
    pub list: Vec<FeedElement>,
    /// Impulses of their inertia over the last step of the discrete gradient.
    pub(super) impulses: Vec<Impulse>,
    /// Velocities as internal damping sees them, and those of the material.
    pub(super) velocities: [Vec<f64>; 2],
}

impl FeedElement {
    /// A feed at rest.
    pub fn new(side: Side, length: f64) -> Self {
        let extent = Extent { length, ..Extent::default() };
        FeedElement {
            side,
            start: 0.0,
            extent,
            weighed: length,
            set: None,
            eye_force: [0.0; 3],
            left_rate: None,
            length_before: length,
            stopped: false,
            kind: Feed::Drum,
            law: None,
            beside: None,
            linearised: 0.0,
            of_points: 0.0,
            of_twist: 0.0,
            on_length: OnLength::default(),
            pull: None,
            source: Source::Outside,
        }
    }

    /// Returns the length in m of the stock that rides with the body at the eye, when the element
    /// has this length.
    #[inline(always)]
    pub(super) fn stock<T: Real>(&self, length: T) -> T {
        if let Source::Stock(both) = self.source { length.splat(both) - length } else { length.splat(0.0) }
    }

    /// Returns whether it stands, did so in the last step, and is not driven by an unknown force:
    /// it is then an element like others, if no stock rides at the eye.
    pub(super) fn stands(&self) -> bool {
        let Extent { length, rate, acceleration } = self.extent;
        let alone = self.law.is_none() && self.source == Source::Outside;
        alone && rate == 0.0 && acceleration == 0.0 && self.length_before == length
    }

    /// Returns the extent at a time in s.
    pub fn at(&self, time: f64) -> Extent {
        self.at_with(time, self.extent.acceleration)
    }

    /// Returns the extent at a time in s with another acceleration.
    #[inline(always)]
    pub(super) fn at_with<T: Real>(&self, time: f64, acceleration: T) -> Extent<T> {
        let (Extent { length, rate, .. }, t) = (self.extent, time - self.start);
        Extent { length: (acceleration * (0.5 * t) + rate) * t + length, rate: acceleration * t + rate, acceleration }
    }

    /// Returns the mean of a step from `time` of length `h` (s), and the lengths at both ends.
    pub(super) fn over(&self, time: f64, h: f64) -> (Extent, [f64; 2]) {
        let (mean, [first, last]) = self.over_with((time, h), self.extent.acceleration);
        (mean, [first.length, last.length])
    }

    /// Returns the mean of a step from a time of a length in s with another acceleration, and the
    /// extents at both ends.
    #[inline(always)]
    pub(super) fn over_with<T: Real>(&self, (time, h): (f64, f64), acceleration: T) -> (Extent<T>, [Extent<T>; 2]) {
        let [first, last] = [self.at_with(time, acceleration), self.at_with(time + h, acceleration)];
        let mean = Extent {
            length: (first.length + last.length) * 0.5,
            rate: (last.length - first.length) / acceleration.splat(h),
            acceleration,
        };
        (mean, [first, last])
    }

    /// Returns the number of the element.
    pub(crate) fn element(&self, model: &Model) -> usize {
        self.side.element(model.elements.len())
    }

    /// Returns the element with an extent.
    #[inline(always)]
    pub(super) fn with<T>(&self, model: &Model, extent: Extent<T>) -> VariableLength<T> {
        VariableLength { inertia: model.inertia(&model.elements[self.element(model)]), extent }
    }

    /// Returns the weight per length of the element in N/m.
    pub(super) fn weight(&self, model: &Model) -> [f64; 3] {
        model.weight(&model.elements[self.element(model)]).into()
    }

    /// Returns the stiffness of the element at a length in m.
    pub(super) fn stiffness(&self, model: &Model, length: f64) -> Stiffness<f64> {
        let section = &model.elements[self.element(model)].section;
        Stiffness { axial: 0.25 * section.axial_stiffness * length, bending: 2.0 * section.bending_stiffness / length }
    }

    /// Adds the forces of the feed to `out`, and their negative derivatives to the matrix.
    pub(super) fn add(
        &self,
        model: &Model,
        at: &ForceInput<'_>,
        out: &mut [f64],
        matrix: Option<&mut BlockTridiagonal>,
    ) {
        let element = self.with(model, self.at(at.time));
        let mut force = [0.0; 12];
        element.add_force(at.scale, &self.side.gather(at.q), &self.side.gather(at.v), &mut force);
        self.side.add(&force, out);
        if let Some(matrix) = matrix {
            let [by_velocity, by_position] = element.matrices();
            let entry = |r: usize, c: usize| at.scale * (at.dv_dq * by_velocity[r][c] + by_position[r][c]);
            self.add_symmetric(model, matrix, entry);
        }
    }

    /// Adds the symmetric part of a 4x4 table to the blocks of the element.
    pub(super) fn add_symmetric(
        &self,
        model: &Model,
        matrix: &mut BlockTridiagonal,
        local: impl Fn(usize, usize) -> f64,
    ) {
        let e = self.element(model);
        for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
            let value = 0.5 * (self.side.entry(&local, a, b) + self.side.entry(&local, b, a));
            // rows of coordinate a, columns of coordinate b; only one triangle of blocks is stored
            let block = match (a / 2, b / 2) {
                (0, 0) => &mut matrix.diag[e],
                (1, 1) => &mut matrix.diag[e + 1],
                (1, 0) => &mut matrix.lower[e],
                _ => continue,
            };
            for x in 0..3 {
                block.0[3 * (b % 2) + x][3 * (a % 2) + x] += value;
            }
        }
    }
}

impl Feeds {
    /// The feeds of the reels of a cable, at rest.
    pub fn new(model: &Model) -> Self {
        let length = |side: Side| model.elements[side.element(model.elements.len())].length;
        let list = model.reels.sides().map(|side| FeedElement::new(side, length(side))).collect();
        Feeds { list, ..Feeds::default() }
    }

    /// Returns whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Returns whether what is behind an eye is a part of the system.
    pub fn are_closed(&self) -> bool {
        self.list.iter().any(|feed| feed.source != Source::Outside)
    }

    /// Returns whether all stand still.
    pub fn are_still(&self) -> bool {
        self.list.iter().all(|feed| feed.extent.rate == 0.0 && feed.extent.acceleration == 0.0)
    }

    /// Returns the lengths in m of the elements at eyes at both ends of a step from `time` of
    /// length `h` (s), of the start and of the end of the cable.
    pub fn lengths_over(&self, time: f64, h: f64) -> [Option<[f64; 2]>; 2] {
        Side::BOTH.map(|side| self.at_side(side).map(|feed| feed.over(time, h).1))
    }

    /// Makes the equations be set anew, whatever their lengths.
    pub fn forget_lengths(&mut self) {
        self.list.iter_mut().for_each(|feed| feed.set = None);
    }

    /// Makes of velocities those that internal damping sees, at `time` (s).
    pub(super) fn strain_velocity(&self, time: f64, q: &[f64], v: &mut [f64]) {
        for feed in &self.list {
            let Extent { length, rate, .. } = feed.at(time);
            let [far, eye] = feed.side.nodes(v.len() / 6);
            for x in 0..3 {
                v[6 * eye + x] -= (q[6 * eye + x] - q[6 * far + x]) * rate / length;
            }
        }
    }

    /// Adds the forces of all feeds to `out`, and their negative derivatives to the matrix; at rest
    /// there are none.
    pub fn add(&self, model: &Model, at: &ForceInput<'_>, out: &mut [f64], mut matrix: Option<&mut BlockTridiagonal>) {
        for feed in self.list.iter().filter(|_| !at.v.is_empty()) {
            feed.add(model, at, out, matrix.as_deref_mut());
        }
    }
}

/// Control vectors of an element with 12 coordinates.
pub(super) fn control(q: &[f64; 12], length: f64) -> Control<f64> {
    let s = 3.0 / length;
    [[q[3], q[4], q[5]], core::array::from_fn(|x| s * (q[6 + x] - q[x])), [q[9], q[10], q[11]]]
}
