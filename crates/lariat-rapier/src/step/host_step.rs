//! The progress of a host step: its Rapier steps, equal ones but for those beside a break.
//!
//! # Scheme
//! A host step has `steps` equal pieces, and each is one Rapier step. One in which a cable breaks
//! is divided there: what is left of the piece is a Rapier step of its own.

use crate::body::prescribed_motion::PrescribedMotions;
use crate::scales::TIME_ROUNDING;
use rapier::math::Real;

/// A host step in progress; see [`CableSet::begin`](crate::CableSet::begin).
#[derive(Clone, Debug)]
pub struct HostStep {
    pub(super) dt: Real,
    /// Pieces in total, and those begun.
    pub(super) steps: u32,
    pub(super) done: u32,
    /// Share of the host step at which the present Rapier step begins and ends, 0 to 1.
    share: (f64, f64),
    /// Share at which what is left of a divided piece begins.
    rest: Option<f64>,
    /// Number of divided pieces, and whether the present Rapier step began with a break.
    divided: u32,
    began_broken: bool,
    pub(super) failed: bool,
    pub(super) motions: PrescribedMotions,
}

impl HostStep {
    /// Begins one of `dt` (s).
    pub(super) fn new(dt: Real) -> Self {
        let motions = PrescribedMotions::default();
        HostStep {
            dt,
            steps: 1,
            done: 0,
            share: (0.0, 1.0),
            rest: None,
            divided: 0,
            began_broken: false,
            failed: false,
            motions,
        }
    }

    /// Returns whether Rapier steps are left.
    pub fn is_unfinished(&self) -> bool {
        !self.failed && (self.done < self.steps || self.rest.is_some())
    }

    /// Returns whether all Rapier steps are done.
    pub(crate) fn is_complete(&self) -> bool {
        !self.failed && self.done == self.steps && self.rest.is_none() && self.dt > 0.0
    }

    /// Returns whether the host step failed as a whole: Rapier must not step. An island that cannot
    /// step does not count: see [`CableSet::failures`](crate::CableSet::failures).
    pub fn has_failed(&self) -> bool {
        self.failed
    }

    /// Begins the next Rapier step.
    pub(super) fn advance(&mut self) {
        let rest = self.rest.take();
        self.done += u32::from(rest.is_none());
        self.share = (rest.unwrap_or_else(|| self.reached(self.done - 1)), self.reached(self.done));
        self.began_broken = false;
    }

    /// Divides each piece that is left into equal parts; the present Rapier step becomes the first
    /// of them.
    pub(super) fn refine(&mut self, parts: u32) {
        let steps = self.steps * parts;
        let from = self.share.0 * f64::from(steps) + TIME_ROUNDING;
        // the first of the finer ones that ends beyond the beginning of the present one
        self.done = ((self.done - 1) * parts + 1..steps).find(|&done| f64::from(done) > from).unwrap_or(steps);
        (self.steps, self.rest) = (steps, None);
        self.share.1 = self.reached(self.done);
    }

    /// Ends the present Rapier step at a share of its length, and leaves the rest of its piece.
    pub(super) fn divide(&mut self, at: f64) {
        let (from, to) = self.share;
        self.share.1 = from + at * (to - from);
        (self.rest, self.divided) = (Some(self.share.1), self.divided + 1);
    }

    /// Breaks cables where the present Rapier step begins.
    pub(super) fn begin_broken(&mut self) {
        self.began_broken = true;
    }

    /// Returns whether cables may break where the present Rapier step begins: once.
    pub(super) fn may_break_at_start(&self) -> bool {
        !self.began_broken
    }

    /// Returns the number of Rapier steps of the host step, as far as it is known.
    pub(super) fn rapier_steps(&self) -> u32 {
        self.steps.saturating_add(self.divided)
    }

    /// Returns whether a Rapier step is left between the present one and the end of its piece.
    pub(super) fn is_divided(&self) -> bool {
        self.rest.is_some()
    }

    /// Returns the share of the host step at which the present Rapier step begins and ends.
    pub(super) fn share(&self) -> (f64, f64) {
        self.share
    }

    /// Returns the length in s of a piece, and of the present Rapier step.
    pub(super) fn lengths(&self) -> (Real, Real) {
        let piece = self.dt / self.steps as Real;
        let (from, to) = self.share;
        (piece, if self.is_whole() { piece } else { (f64::from(self.dt) * (to - from)) as Real })
    }

    /// Returns whether the present Rapier step is a whole piece.
    fn is_whole(&self) -> bool {
        self.share == (self.reached(self.done.saturating_sub(1)), self.reached(self.done))
    }

    /// Returns the share of the host step at the end of a number of pieces.
    fn reached(&self, pieces: u32) -> f64 {
        f64::from(pieces) / f64::from(self.steps)
    }
}
