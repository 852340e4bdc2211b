//! What a reel does now.

use crate::at::At;
use crate::cable::Cable;
use crate::element::side::Side;
use crate::reel::Reel;
use crate::scales::SAME;

/// What a reel does now.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReelReading {
    /// Unstretched length of cable that is out, in m, with what is beyond sheaves along it.
    pub length_out: f64,
    /// Rate in m/s: positive pays out.
    pub rate: f64,
    /// Pull of the winch on the cable along itself in N: with the discrete gradient the mean over
    /// its last step, but that at its end where [`max_force`](Reel::max_force) was lowered, which a
    /// motor that slips follows linearly over a host step; else that at the present state.
    pub force: f64,
    /// Tension of the cable at the eye in N, from the pull: `T f - u = pull + 1/2 rho A rate^2
    /// (f^2 - 1)`, u the strain energy per length. Smoother than what [`Cable::sample`] reads
    /// there, which depends on the length of the element.
    pub tension: f64,
    /// Work of the winch on the cable so far in J, with the kinetic and the potential energy of the
    /// material that entered: the energy of the cable changes by this, by the work of all else, and
    /// by `remeshed`.
    pub work: f64,
    /// Energy in J that merging and splitting elements added so far.
    pub remeshed: f64,
    /// Elements split so far.
    pub splits: u64,
    /// Elements merged so far.
    pub merges: u64,
    /// Whether it slows down or stands at the end of its stock, at a held node or a load.
    pub stopped: bool,
    /// Rate over the speed of transverse waves at the eye: above 0.3, give the cable internal
    /// damping. Infinite without tension.
    pub speed_ratio: f64,
}

impl Cable {
    /// Returns what the reel at an end does now; `None` without one.
    pub fn reel(&self, at: impl Into<At>) -> Option<ReelReading> {
        self.reel_at(self.side(at.into())?)
    }

    pub(super) fn reel_at(&self, side: Side) -> Option<ReelReading> {
        let winding = self.snapshot.windings[side as usize]?;
        let feed = self.system.feeds.list.iter().find(|feed| feed.side == side)?;
        let memory = &self.snapshot.state.memory;
        let acceleration = if memory.valid { side.gather(&memory.acceleration) } else { [0.0; 12] };
        let element = &self.elements()[side.element(self.elements().len())];
        let (q, v) = (side.gather(self.positions()), side.gather(self.velocities()));
        let inertia = self.model.inertia(element);
        let present = || {
            let pull = self.system.feed_force(&self.model, feed, self.time(), [&q, &v, &acceleration]).pull;
            pull - self.torsion_on_length(side)
        };
        let excess = winding.motor.map_or(0.0, |motor| motor.excess);
        let force = winding.pull.map_or_else(present, |pull| pull - excess);
        let rate = winding.extent[1];
        let stiffness = element.section.axial_stiffness;
        let square: f64 = (9..12).map(|i| q[i] * q[i]).sum();
        let eye = force + 0.5 * inertia * rate * rate * (square - 1.0);
        let tension = stiffness * self.system.tension_of_pull(side.element(self.elements().len()), eye / stiffness);
        Some(ReelReading {
            length_out: self.out(side),
            rate,
            force,
            tension,
            work: winding.work,
            remeshed: winding.remeshed,
            splits: winding.splits,
            merges: winding.merges,
            stopped: winding.stopped,
            speed_ratio: if rate == 0.0 { 0.0 } else { rate.abs() / (tension.max(0.0) / inertia).sqrt() },
        })
    }

    /// Returns what the reels of the cable do now.
    pub fn reels(&self) -> impl Iterator<Item = ReelReading> {
        self.model.reels.sides().filter_map(|side| self.reel_at(side))
    }

    /// Returns the reel of an end as it was described; `None` without one.
    pub fn reel_description(&self, at: impl Into<At>) -> Option<&Reel> {
        self.model.reels.get(self.side(at.into())?)
    }

    /// Returns the length in m of cable that is out at the reel of an end: all of it, with what is
    /// beyond a sheave at the other end, where that runs on as the same cable.
    pub(super) fn out(&self, side: Side) -> f64 {
        let other = self.snapshot.windings[1 - side as usize].filter(|other| other.beyond > 0.0);
        self.length() + other.map_or(0.0, |other| other.beyond - other.passed)
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn set_beyond(&mut self, start: bool, length: f64) {
        let side = if start { Side::Start } else { Side::End };
        if let Some(winding) = &mut self.snapshot.windings[side as usize] {
            let beyond = if length > 0.0 { length + winding.passed } else { 0.0 };
            // what is the same but for rounding stays, bit for bit
            if (beyond - winding.beyond).abs() > SAME * beyond.max(winding.beyond) {
                winding.beyond = beyond;
                // what of the stock rides at the other end
                self.sync_reel();
            }
        }
    }

    /// Returns whether the cable has a reel.
    pub fn has_reel(&self) -> bool {
        !self.model.reels.is_empty()
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn nodes_from_start(&self) -> i64 {
        self.snapshot.nodes_from_start()
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn length_from_start(&self) -> f64 {
        self.snapshot.passed_at_start()
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn is_reel_still(&self) -> bool {
        self.model.reels.sides().all(|side| {
            let (reel, winding) = (self.model.reels.get(side), &self.snapshot.windings[side as usize]);
            let (Some(reel), Some(winding)) = (reel, winding) else { return true };
            winding.extent[1] == 0.0 && (reel.asked(self.time(), self.way(side, reel)) == 0.0 || winding.stopped)
        })
    }

    /// Returns whether an end is at a sheave or on a drum, which only an island has.
    pub(crate) fn needs_island(&self, side: Side) -> bool {
        self.model.reels.get(side).is_some_and(Reel::needs_island)
    }

    /// Returns the end at a point.
    pub(in crate::cable) fn side(&self, at: At) -> Option<Side> {
        let node = self.node(at).ok()?;
        Side::BOTH.into_iter().find(|side| side.nodes(self.nodes())[1] == node)
    }
}
