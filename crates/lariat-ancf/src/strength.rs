//! What a cable withstands before it breaks.

use crate::error::{Error, require};
use crate::scales::cable::OVERSHOOT;
use serde::{Deserialize, Serialize};

/// What a cable withstands; without limits, the default, it does not break. A number converts into
/// a limit of the tension.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Strength {
    /// Largest tension in N: the elastic one, without that of damping. Default: none.
    pub tension: Option<f64>,
    /// Largest strain, stretch over rest stretch less 1. Default: none.
    pub strain: Option<f64>,
}

impl Strength {
    /// Returns the strength of a cable that breaks above a tension in N.
    pub fn tension(limit: f64) -> Self {
        Strength { tension: Some(limit), strain: None }
    }

    /// Returns the strength of a cable that breaks above a strain.
    pub fn strain(limit: f64) -> Self {
        Strength { tension: None, strain: Some(limit) }
    }

    /// Returns whether there is a limit.
    pub fn is_limited(&self) -> bool {
        self.tension.is_some() || self.strain.is_some()
    }

    /// Returns the larger share of its limit that tension (N) and strain reach, and which of them
    /// it is.
    pub(crate) fn share(&self, tension: f64, strain: f64) -> (f64, BreakCause) {
        let share = |value: f64, limit: Option<f64>| limit.map_or(f64::NEG_INFINITY, |limit| value / limit);
        let (by_tension, by_strain) = (share(tension, self.tension), share(strain, self.strain));
        if by_tension >= by_strain { (by_tension, BreakCause::Tension) } else { (by_strain, BreakCause::Strain) }
    }

    /// Refuses limits that are not positive numbers.
    pub(crate) fn check(&self) -> Result<(), Error> {
        for (what, limit) in [("breaking tension (N)", self.tension), ("breaking strain", self.strain)] {
            limit.map_or(Ok(()), |limit| require(what, limit, limit > 0.0, "> 0"))?;
        }
        Ok(())
    }
}

impl From<Option<f64>> for Strength {
    fn from(tension: Option<f64>) -> Self {
        Strength { tension, strain: None }
    }
}

impl From<f64> for Strength {
    fn from(tension: f64) -> Self {
        Self::tension(tension)
    }
}

/// Why a cable became two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum BreakCause {
    /// The tension exceeded its limit.
    Tension,
    /// The strain exceeded its limit.
    Strain,
    /// It was cut by hand.
    Cut,
}

impl BreakCause {
    /// Returns the name: `tension`, `strain` or `cut`.
    pub fn name(self) -> &'static str {
        match self {
            BreakCause::Tension => "tension",
            BreakCause::Strain => "strain",
            BreakCause::Cut => "cut",
        }
    }
}

/// The largest load of a cable, beside what it withstands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Load {
    /// Share of the limit that it reaches: above 1 the cable breaks.
    pub share: f64,
    /// Which limit that is.
    pub cause: BreakCause,
    /// Arc length in m.
    pub arc_length: f64,
    /// Tension in N: the elastic one, without that of damping.
    pub tension: f64,
    /// Tension of damping in N beside it, which does not count.
    #[serde(default)]
    pub damping: f64,
    /// Strain, stretch over rest stretch less 1.
    pub strain: f64,
    /// Time in s.
    pub time: f64,
}

impl Default for Load {
    /// None.
    fn default() -> Self {
        let share = f64::NEG_INFINITY;
        Load { share, cause: BreakCause::Tension, arc_length: 0.0, tension: 0.0, damping: 0.0, strain: 0.0, time: 0.0 }
    }
}

/// What the integration steps saw of the load of a cable with limits.
///
/// # Equation
///
/// Between three readings x0, x1, x2 of the share of the limit, at equal distances, the load may
/// have come to
///
/// ```text
/// x1 + max(0, 2 x1 - x0 - x2)
/// ```
///
/// The parabola through them exceeds x1 by at most an eighth of the last term: that is what steps
/// miss which resolve the oscillation. A load that is applied at once, in a step that does not, is
/// the jump x1 - x0 with x2 = x1, and doubles at most (dynamic factor 2, a rope without mass and
/// damping): the term is then the jump. With unequal distances the second difference is that of the
/// longer one.
///
/// # References
///
/// Timoshenko & Young 1955, section 1 (suddenly applied load).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct LoadRecord {
    /// The largest since the cable was compared with its limits; its arc length is counted from the
    /// material that was at the start at first.
    worst: Option<Load>,
    /// Arc length in m on the cable of the material that was at the start at first, when the
    /// present host step began.
    origin: f64,
    /// Times in s and shares of the last two readings.
    recent: [Option<[f64; 2]>; 2],
    /// Of a part of a cable that broke.
    #[serde(default)]
    recoil: Option<Recoil>,
    /// What no reading saw, if that is above the limit.
    unseen: Option<Unseen>,
    /// Time in s of the first reading above the limit since the cable was compared with it, if the
    /// worst is.
    #[serde(default)]
    exceeded: f64,
    /// Time in s at which the load came to the limit, so far as readings tell.
    #[serde(default)]
    crossed: f64,
}

/// A load above the limit that there may have been between readings below it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Unseen {
    /// Time in s.
    pub time: f64,
    /// Share of the limit that was read, and that may have been reached.
    pub shares: [f64; 2],
    /// Time in s between readings.
    pub step: f64,
}

/// What a part of a cable recoils by after a break: the strain energy that it had. No wave of the
/// break, and no snap at the end of its flight, strains it by more, until others do work on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Recoil {
    /// Strain energy in J that it can still give: what was dissipated does not come back.
    pub energy: f64,
    /// Time in s by which waves and flight are over; of a part that nothing holds or loads, never.
    pub until: f64,
    /// Time in s at which the wave of the break has been everywhere: what is overloaded until then
    /// was so at the break.
    #[serde(default)]
    pub relieved: f64,
    /// Number of breaks by which it became what it is.
    #[serde(default)]
    pub breaks: u32,
}

impl Recoil {
    /// Returns whether a load at a time in s is that of the recoil, by the strain energy in J that
    /// strains the part then.
    pub fn explains(&self, time: f64, energy: f64) -> bool {
        time <= self.relieved || energy <= self.energy
    }
}

impl LoadRecord {
    /// Returns whether the last reading is of a time in s.
    pub fn is_at(&self, time: f64) -> bool {
        self.recent[1].is_some_and(|[last, _]| last == time)
    }

    /// Begins a host step of a cable on which the material that was at its start is at `origin`
    /// (m).
    pub fn begin(&mut self, origin: f64) {
        self.origin = origin;
    }

    /// Notes the energy in J by which the cable can recoil at most from now on.
    pub fn lower_recoil(&mut self, energy: f64) {
        if let Some(recoil) = &mut self.recoil {
            recoil.energy = recoil.energy.min(energy);
        }
    }

    /// Adds a reading; that of a [recoil](Recoil) is compared with no limit.
    pub fn note(&mut self, load: Load, is_recoil: bool) {
        if let [Some([t0, x0]), Some([t1, x1])] = self.recent {
            let (t2, x2) = (load.time, load.share);
            let step = (t1 - t0).max(t2 - t1);
            let bend = step * ((x1 - x0) / (t1 - t0) - (x2 - x1) / (t2 - t1));
            let reached = x1 + bend.max(0.0);
            if x1 <= 1.0 && x2 <= 1.0 && reached > self.unseen.map_or(1.0, |unseen| unseen.shares[1]) {
                self.unseen = Some(Unseen { time: t1, shares: [x1, reached], step });
            }
        }
        let before = self.recent[1];
        self.recent = [before, Some([load.time, load.share])];
        if load.share > 1.0 && is_recoil {
            return;
        }
        if load.share > 1.0 && self.exceeded().is_none() {
            self.exceeded = load.time;
            // between two readings far apart the load is taken for linear
            let passes = |[time, share]: &[f64; 2]| *time < load.time && *share <= 1.0 && load.share > OVERSHOOT;
            let crossed = |[time, share]: [f64; 2]| {
                time + (load.time - time) * (0.5 * (1.0 + OVERSHOOT) - share) / (load.share - share)
            };
            self.crossed = before.filter(passes).map_or(load.time, crossed);
        }
        if self.worst.is_none_or(|worst| load.share > worst.share) {
            self.worst = Some(Load { arc_length: load.arc_length - self.origin, ..load });
        }
    }

    /// Begins that of a part of a cable that broke, with what it recoils by.
    pub fn of_part(recoil: Recoil) -> Self {
        LoadRecord { recoil: Some(recoil), ..LoadRecord::default() }
    }

    /// Returns what the cable recoils by, if it is a part of one that broke, at a time in s.
    pub fn recoil(&self, time: f64) -> Option<Recoil> {
        self.recoil.filter(|recoil| time < recoil.until)
    }

    /// Returns by how many breaks the cable became what it is.
    pub fn breaks(&self) -> u32 {
        self.recoil.map_or(0, |recoil| recoil.breaks)
    }

    /// Forgets the readings between which the load is judged, because a program changes the state.
    pub fn interrupt(&mut self) {
        self.recent = [None; 2];
    }

    /// Returns the largest load since it was taken last, and forgets it.
    pub fn take(&mut self) -> Option<Load> {
        self.worst.take()
    }

    /// Returns the time in s of the first reading above the limit since the largest was taken last.
    pub fn exceeded(&self) -> Option<f64> {
        self.worst.filter(|worst| worst.share > 1.0).map(|_| self.exceeded)
    }

    /// Returns the time in s at which the load came to the limit before that, which is between
    /// readings where the first one above it is far above.
    pub fn crossed(&self) -> Option<f64> {
        self.exceeded().map(|_| self.crossed)
    }

    /// Returns the largest load since it was taken last.
    pub fn worst(&self) -> Option<Load> {
        self.worst
    }

    /// Returns what no reading saw.
    pub fn unseen(&self) -> Option<Unseen> {
        self.unseen
    }
}

/// Where, why and under which load a cable became two. Of a part of a cable that broke before it is
/// a load of its own: one that strains it by more energy than it had at that break, as long as it
/// recoils of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Break {
    /// Why.
    pub cause: BreakCause,
    /// Arc length of the break in m, unstretched: the new length of the part before it.
    pub arc_length: f64,
    /// Largest elastic tension in N since the cable was compared with its limits last; of a cut,
    /// the whole tension at it.
    pub tension: f64,
    /// Tension of damping in N that was there at that time, too, and does not count; zero for a
    /// cut.
    pub damping: f64,
    /// Strain there, stretch over rest stretch less 1.
    pub strain: f64,
    /// Time in s of that load, which may lie within the last host step; of a cut, that of the cut.
    pub time: f64,
    /// Strain energy in J of both parts at the break. No more than this, and their weight, is set
    /// free as motion.
    pub strain_energy: f64,
    /// Change of the total energy in J by the edit itself: zero at a node, else what a node placed
    /// there [adds](crate::coupling::Coupling::inserted_energy).
    pub inserted_energy: f64,
    /// Breaks by loads, one after another, that made the parts: 1 of a cable that was whole, 0 of a
    /// cut of one.
    #[serde(default)]
    pub breaks: u32,
}
