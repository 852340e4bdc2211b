//! A length that runs through an eye while the cable is at rest: for statics.

use crate::cable::Cable;
use crate::element::side::Side;
use crate::error::{EquilibriumFailure, Error};
use crate::reel::Feed;
use crate::scales::reel::{ALL, PASSING};

impl Cable {
    /// Returns the pull in N at the eye of an end, with the cable at rest; 0 without a reel.
    pub(crate) fn pull_at_rest(&self, side: Side) -> f64 {
        let Some(feed) = self.system.feeds.at_side(side) else { return 0.0 };
        let q = side.gather(self.positions());
        let pull = self.system.feed_force(&self.model, feed, self.time(), [&q, &[0.0; 12], &[0.0; 12]]).pull;
        pull - self.torsion_on_length(side)
    }

    /// Returns the failure of an equilibrium in which a reel slips, with pulls that are right to
    /// `tolerance` (N): in statics a reel holds its length by a force of at most its largest. At
    /// the end of its stock it holds any pull.
    pub(crate) fn slips(&self, tolerance: f64) -> Option<EquilibriumFailure> {
        self.model.reels.sides().find_map(|side| {
            let reel = self.model.reels.get(side).filter(|reel| reel.feed != Feed::Sheave)?;
            let (pull, largest) = (self.pull_at_rest(side), reel.max_force?);
            let stopped = pull > 0.0 && reel.stock.is_some_and(|stock| self.out(side) >= ALL * stock);
            (pull.abs() > largest + tolerance && !stopped).then_some(EquilibriumFailure::Slips { pull, largest })
        })
    }

    /// Returns the tangent at the eye of an end, towards the eye.
    pub(crate) fn tangent_at_eye(&self, side: Side) -> [f64; 3] {
        let q = side.gather(self.positions());
        [q[9], q[10], q[11]]
    }

    /// Lets a length in m in through the eye of an end, out if it is negative, in parts between
    /// which elements are split and merged. Returns whether there was enough to let out.
    ///
    /// # Errors
    /// As [`remesh_reel`](Self::remesh_reel).
    pub(crate) fn feed_at_rest(&mut self, side: Side, length: f64) -> Result<bool, Error> {
        let parts = (length.abs() / (PASSING * self.model.reels.least_length())).ceil().max(1.0);
        for _ in 0..parts as usize {
            let e = side.element(self.elements().len());
            let before = self.elements()[e].length;
            let own = before + length / parts;
            let Some(winding) = self.snapshot.windings[side as usize].as_mut().filter(|_| own > 0.0) else {
                return Ok(false);
            };
            winding.passed += length / parts;
            (winding.extent, winding.length_before) = ([own, 0.0, 0.0], own);
            (winding.pull, winding.motor, winding.plan) = (None, None, None);
            self.model.elements[e].length = own;
            if self.model.pulled_points().next().is_some() {
                self.model.move_loads(self.snapshot.passed_at_start());
                self.system.loads.locate(&self.model);
                self.system.potentials.locate(&self.model);
            }
            self.follow_feed(side, before);
            self.sync_reel();
            self.remesh_reel()?;
        }
        Ok(true)
    }
}
