//! A host step of a cable with a reel: in parts in which little material passes the eye.

use crate::cable::Cable;
use crate::error::Error;
use crate::integrate::{IntegratorRef, WorkLimit};

impl Cable {
    /// Advances a cable with a reel by `dt` (s).
    pub(crate) fn step_with_reel(&mut self, dt: f64, integrator: IntegratorRef<'_>) -> Result<(), Error> {
        let parts = self.reel_parts(dt)?;
        self.set_riding_stock(|_| false);
        let end = self.time() + dt;
        let before = (parts > 1).then(|| Box::new(self.clone()));
        if parts > 1 && !self.is_reel_planned(dt) {
            self.plan_reels(dt);
        }
        for part in 0..parts {
            let h = (end - self.time()) / (parts - part) as f64;
            self.begin_reel(h);
            let outcome = self.with_workspace(|cable| cable.step_in_workspace(h, integrator));
            if outcome.is_ok() && part + 1 == parts && !integrator.limit.is_some_and(WorkLimit::has_stopped) {
                self.snapshot.state.time = end;
            }
            self.end_reel(outcome.is_ok());
            if let Err(error) = outcome.and_then(|()| self.remesh_reel()) {
                if let Some(before) = before {
                    *self = *before;
                }
                return Err(error);
            }
            if integrator.limit.is_some_and(WorkLimit::has_stopped) {
                return Ok(());
            }
        }
        Ok(())
    }
}
