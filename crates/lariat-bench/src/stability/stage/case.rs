//! What a case is: a name, how it is built and acted on, how long, and what must hold.

use super::{Fault, Stage};
use crate::stability::Family;
use crate::stability::host::{Host, Make};
use crate::stability::outcome::Reading;

/// What holds for every run, next to all numbers being finite.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Widest gap of an attachment in m. Default 1e-3, a tenth of the thinnest rope here.
    pub gap: f64,
    /// Energy made beyond the work put in, over the largest kinetic and strain energy. Default 1 %.
    pub created: f64,
    /// Energy lost beyond what damping and drag took, over the same. Default: no bound (contacts, impacts).
    pub lost: f64,
}

impl Default for Bounds {
    fn default() -> Self {
        Bounds { gap: 1e-3, created: 0.01, lost: f64::INFINITY }
    }
}

/// Whether a refused step is an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusals {
    /// No: the case can be done.
    Never,
    /// Yes, if the error names the cable or the body, and the last good state is intact.
    May,
    /// The error is what must come.
    Must,
}

type Act = Box<dyn FnMut(&mut Stage) -> Result<(), Fault>>;
type Judge = Box<dyn FnOnce(&Stage) -> Vec<Reading>>;

/// What happens during a run.
pub struct Play {
    /// Called before each host step.
    pub act: Act,
    /// Called at the end, for what is particular to the case.
    pub judge: Judge,
}

impl Play {
    /// Nothing happens, nothing particular is read.
    pub fn idle() -> Self {
        Play { act: Box::new(|_| Ok(())), judge: Box::new(|_| Vec::new()) }
    }

    /// What is done before each host step.
    pub fn acting(self, act: impl FnMut(&mut Stage) -> Result<(), Fault> + 'static) -> Self {
        Play { act: Box::new(act), ..self }
    }

    /// What is read at the end.
    pub fn judging(self, judge: impl FnOnce(&Stage) -> Vec<Reading> + 'static) -> Self {
        Play { judge: Box::new(judge), ..self }
    }
}

type Build = Box<dyn Fn(&mut Stage) -> Result<Play, Fault> + Send + Sync>;

/// A hard case.
pub struct Case {
    pub family: Family,
    pub name: String,
    /// Simulated time in s; at least one host step is done.
    pub duration: f64,
    pub bounds: Bounds,
    pub refusals: Refusals,
    /// Whether the same can be asked of Rapier's own ropes.
    pub rivals: bool,
    /// Whether it is run on a host.
    pub hosts: Box<dyn Fn(&Host) -> bool + Send + Sync>,
    /// CPU time for a run in s.
    pub budget: f64,
    pub build: Build,
}

/// A case with the default bounds, on all hosts, within 4 s of CPU time.
pub fn case(
    family: Family,
    name: impl Into<String>,
    duration: f64,
    build: impl Fn(&mut Stage) -> Result<Play, Fault> + Send + Sync + 'static,
) -> Case {
    Case {
        family,
        name: name.into(),
        duration,
        bounds: Bounds::default(),
        refusals: Refusals::Never,
        rivals: true,
        hosts: Box::new(|host| !host.effects || host.iterations == 4),
        budget: 4.0,
        build: Box::new(build),
    }
}

impl Case {
    /// A bound on gaps in m.
    pub fn gap(mut self, gap: f64) -> Self {
        self.bounds.gap = gap;
        self
    }

    /// Bounds on energy made and lost, as shares.
    pub fn energy(mut self, created: f64, lost: f64) -> Self {
        (self.bounds.created, self.bounds.lost) = (created, lost);
        self
    }

    /// Only Lariat can be asked.
    pub fn ours(mut self) -> Self {
        self.rivals = false;
        self
    }

    /// A refused step is an answer.
    pub fn may_refuse(mut self) -> Self {
        self.refusals = Refusals::May;
        self
    }

    /// Hosts that it is run on.
    pub fn on(mut self, hosts: fn(&Host) -> bool) -> Self {
        self.hosts = Box::new(hosts);
        self
    }

    /// CPU time for a run in s.
    pub fn budget(mut self, seconds: f64) -> Self {
        self.budget = seconds;
        self
    }

    /// Whether this way to make cables can be asked on this host.
    pub fn applies(&self, host: &Host, make: Make) -> bool {
        (self.hosts)(host) && (make == Make::Lariat || self.rivals && !host.effects)
    }
}
