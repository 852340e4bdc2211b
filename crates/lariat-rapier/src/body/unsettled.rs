//! Whether Rapier does with bodies on joints what was predicted for them.
//!
//! # Equation
//! ```text
//! |v_after - v0| > 0.05 (|p| + |m g h| + |v1 - v|)               in more than a quarter of the Rapier steps
//! |sum ((F0 + F) h/2 - p)| > 0.05 sum |p|                        over the time
//! g or g_e > max(0.1 s, 2e-3 a)                                  for 0.05 s and three steps
//! ```
//! Either of the first two tells if it holds in half a second, and in the next, the third at once.
//! v0 is the velocity that Rapier was given, p = L (v1 - v - a0 h) - (m g + r) h the impulse of the
//! cables by the predicted change of velocity, and F0 and F the forces that are read at the ends of
//! the step before and of this one. All are spatial vectors of a body, in the norm of its kinetic
//! energy. The first says that what joints, limits and contacts do changes from step to step, so
//! that the cables are jerked at each; the second that forces at the ends of steps are not those
//! that move the body. Blows, a start with a jolt and a joint that comes to its limit do not last
//! so long. Where cables pull with less than a twentieth of the body's weight the first two tell
//! nothing.
//!
//! g is the largest [gap](JointGap) of the joints that the body moves with, a the
//! arm of that joint, and s the way of the body since the last half second began: joints that
//! Rapier does not solve let the body sink, and by that much its position is wrong, whatever the
//! cable does. g_e is the gap to which they are [to open](crate::mechanism) by the motion that they
//! hold, known before the body has sunk.
//!
//! # Validity
//! Random chains of 2 to 14 links on one or two ropes, near a body or not, 30 to 240 Hz, both
//! fidelities: where the force is right to 1 % and does not ripple, the first ratio is below 1e-2
//! in nine steps of ten, in most chains below 1e-4; where it is wrong by more than that or ripples
//! by more than 10 %, either of the two holds (tests, chains.rs). The third of a link of 5 g to 10
//! kg that carries 95 kg, 30 to 120 Hz: tests, light_links.rs.

use crate::body::spatial::split_spatial;
use crate::scales::TIME_ROUNDING;
use crate::scales::body::{JOINT_GAP, JOINT_STEPS, JOINT_TIME, JOINT_WAY};
use crate::scales::body::{SETTLE_SHARE, SETTLE_SPEED, SETTLE_SPEED_SHARE, SETTLE_STEPS, SETTLE_WINDOW};
use ::nalgebra::{Matrix6, Vector3, Vector6};
use lariat_ancf::island::RigidBody;
use serde::{Deserialize, Serialize};

/// A body on joints whose motion was not the predicted one for half a second, or whose joints came
/// apart, so that forces and tensions of its cables are not to be trusted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Unsettled {
    /// Time of the cable in s at the end of the worst half second, or of the largest gap.
    pub time: f64,
    /// Share of its Rapier steps in which the body deviated from its prediction, 0 to 1.
    pub steps: f64,
    /// Difference between the forces that were read and those that moved the body, as a share of
    /// these.
    pub force: f64,
    /// Distance in m by which a joint of the body came apart; 0 where all of them hold.
    #[serde(default)]
    pub gap: f64,
    /// Whether that gap has not shown yet: the joints are to open so far by what they carry.
    #[serde(default)]
    pub foreseen: bool,
}

impl Unsettled {
    /// Creates one of half a second from its fields: s, two shares.
    pub fn new(time: f64, steps: f64, force: f64) -> Self {
        Unsettled { time, steps, force, ..Unsettled::default() }
    }

    /// Returns it with joints that came apart by `gap` (m), or are to do so.
    pub fn with_gap(self, gap: f64, foreseen: bool) -> Self {
        Unsettled { gap, foreseen, ..self }
    }

    /// Returns in words what is wrong.
    pub fn text(&self) -> String {
        let Unsettled { time, steps, force, gap, foreseen } = self;
        if *foreseen {
            return format!("by what they carry at {time:.3} s Rapier lets one of them open by {gap:.1e} m");
        }
        if *gap > 0.0 {
            return format!("at {time:.3} s one of them is {gap:.1e} m apart");
        }
        let (steps, force) = (100.0 * steps, 100.0 * force);
        format!(
            "in {steps:.0} % of the steps before {time:.3} s, and its forces are {force:.1} % off those that moved it"
        )
    }
}

/// The largest gap of the joints of a mechanism.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct JointGap {
    /// Distance of the anchors in m along the locked axes, above rounding.
    pub gap: f64,
    /// Largest distance in m of an anchor of that joint from the centre of its body.
    pub arm: f64,
}

/// Whether the joints that a body moves with hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct JointWatch {
    /// Where the body was when this half second began.
    from: Option<Vector3<f64>>,
    /// Its way in m in the half second before, and in this one.
    way: [f64; 2],
    /// How long a gap has been beyond its limit: in s, and in steps.
    lasting: (f64, u32),
}

impl JointWatch {
    /// Reads a Rapier step; returns the gap in m if it has lasted, and whether it is only foreseen.
    fn note(&mut self, step: &SettleStep) -> Option<(f64, bool)> {
        let position = step.body.position;
        let from = *self.from.get_or_insert(position);
        self.way[1] = self.way[1].max((position - from).norm());
        let limit = |joints: &JointGap| (JOINT_WAY * self.way[0].max(self.way[1])).max(JOINT_GAP * joints.arm);
        let is_beyond = |joints: &JointGap| joints.gap > limit(joints);
        let found = match (is_beyond(&step.joints), is_beyond(&step.opening)) {
            (true, _) => Some((step.joints.gap, false)),
            // the law is one of gaps small beside the arm
            (false, true) => Some((step.opening.gap.min(step.opening.arm), true)),
            (false, false) => None,
        };
        self.lasting = match found {
            Some(_) => (self.lasting.0 + step.h, self.lasting.1 + 1),
            None => (0.0, 0),
        };
        let (time, steps) = self.lasting;
        found.filter(|_| time >= JOINT_TIME * (1.0 - TIME_ROUNDING) && steps >= JOINT_STEPS)
    }

    /// Begins another half second.
    fn roll(&mut self) {
        (self.from, self.way) = (None, [self.way[1], 0.0]);
    }
}

/// What Rapier made of the predictions for a body on joints so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SettleWatch {
    time: f64,
    steps: u32,
    deviating: u32,
    /// Sum of the norms of the impulses of cables, and sum of the differences to what is read of
    /// them.
    pull: f64,
    difference: Vector6<f64>,
    joints: JointWatch,
    /// What was read in the last step.
    last: Option<Vector6<f64>>,
    /// Whether the last half second was unsettled, and the worst one after such a one.
    before: bool,
    worst: Option<Unsettled>,
    /// Whether it is to be told, and whether it has been.
    due: bool,
    told: bool,
}

/// A Rapier step of a body on joints.
pub(crate) struct SettleStep<'a> {
    /// The body after the step.
    pub body: &'a RigidBody,
    pub inertia: &'a Matrix6<f64>,
    /// Change of velocity in the step, and what of it was not predicted.
    pub gained: Vector6<f64>,
    pub deviation: Vector6<f64>,
    /// Impulse of its cables, and what is read of it.
    pub pull: Vector6<f64>,
    pub read: Vector6<f64>,
    /// Of the joints that it moves with, the largest gap, and that to which they are to open.
    pub joints: JointGap,
    pub opening: JointGap,
    /// What gravity gives to a mass in the step, in m/s.
    pub gravity: f64,
    /// Time step, and time of the cables after it, in s.
    pub h: f64,
    pub time: f64,
}

impl SettleWatch {
    /// Reads a Rapier step.
    pub fn note(&mut self, step: &SettleStep) {
        if let Some((gap, foreseen)) = self.joints.note(step) {
            let worst = self.worst.unwrap_or_default();
            // what shows counts more than what is foreseen
            if (worst.gap > 0.0, !worst.foreseen, worst.gap) < (true, !foreseen, gap) {
                self.worst = Some(Unsettled { time: step.time, ..worst.with_gap(gap, foreseen) });
                self.due = !self.told;
            }
        }
        let Some(inverse) = step.inertia.try_inverse() else { return };
        let of_velocity = |v: &Vector6<f64>| v.dot(&(step.inertia * v)).max(0.0).sqrt();
        let of_impulse = |p: &Vector6<f64>| p.dot(&(inverse * p)).max(0.0).sqrt();
        let root = step.body.mass.sqrt();
        let (pull, weight) = (of_impulse(&step.pull), root * step.gravity);
        let speed = split_spatial(&step.gained).0.norm().max(step.body.velocity.norm());
        let scale = pull + weight + of_velocity(&step.gained);
        let rounding = root * (SETTLE_SPEED + SETTLE_SPEED_SHARE * speed);
        let deviates = pull > SETTLE_SHARE * weight && of_velocity(&step.deviation) > SETTLE_SHARE * scale + rounding;
        self.deviating += u32::from(deviates);
        self.steps += 1;
        self.pull += pull.max(SETTLE_SHARE * weight);
        self.difference += (step.read + self.last.unwrap_or(step.read)) * 0.5 - step.pull;
        self.last = Some(step.read);
        self.time += step.h;
        if self.time >= SETTLE_WINDOW * (1.0 - TIME_ROUNDING) {
            let steps = f64::from(self.deviating) / f64::from(self.steps);
            let force = if self.pull > 0.0 { of_impulse(&self.difference) / self.pull } else { 0.0 };
            let gap = self.worst.unwrap_or_default();
            let found = Unsettled::new(step.time, steps, force).with_gap(gap.gap, gap.foreseen);
            let kept = self.worst.is_some_and(|worst| worst.steps.max(worst.force) >= steps.max(force));
            let unsettled = steps > SETTLE_STEPS || force > SETTLE_SHARE;
            if unsettled && self.before && !kept {
                (self.worst, self.due) = (Some(found), !self.told);
            }
            self.joints.roll();
            let SettleWatch { joints, last, worst, due, told, .. } = *self;
            *self = SettleWatch { joints, last, worst, due, told, before: unsettled, ..SettleWatch::default() };
        }
    }

    /// Returns the worst half second, if the body was not settled in it.
    pub fn worst(&self) -> Option<Unsettled> {
        self.worst
    }

    /// Returns what is to be told.
    pub fn due(&self) -> Option<Unsettled> {
        self.worst.filter(|_| self.due)
    }

    /// What was due has been told.
    pub fn set_told(&mut self) {
        self.told |= core::mem::take(&mut self.due);
    }
}
