//! A case: how a world is built, what happens in it, for how long, and what must hold.

use super::test_world::{Fault, TestWorld};
use crate::stability::family::Family;
use crate::stability::host::{CableModel, Host};
use crate::stability::outcome::Check;

/// Bounds on the energy balance of a run, as shares of its largest kinetic and strain energy.
#[derive(Clone, Copy, Debug)]
pub enum EnergyBounds {
    /// Energy made beyond the work from outside, and energy lost beyond what damping and drag
    /// dissipated.
    Within { made: f64, lost: f64 },
    /// None, for the reason given.
    NotChecked(&'static str),
}

/// What must hold in every run of a case, beside every number being finite.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Widest gap of an attachment in m. Default 1e-3, a tenth of the thickness of the ropes here.
    pub gap: f64,
    /// Energy balance. Default 1 % made and 1 % lost.
    pub energy: EnergyBounds,
}

impl Default for Bounds {
    fn default() -> Self {
        Bounds { gap: 1e-3, energy: EnergyBounds::Within { made: 0.01, lost: 0.01 } }
    }
}

/// What an error of a step means; the error must name the cable or the body, and leave the state as
/// it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepErrors {
    /// The case can be computed, so an error is a failure.
    Fail,
    /// An error is an answer.
    Allowed,
}

type BeforeStep = Box<dyn FnMut(&mut TestWorld) -> Result<(), Fault>>;
type Checks = Box<dyn FnOnce(&TestWorld) -> Vec<Check>>;

/// What happens during a run, and what is checked at its end.
pub struct Script {
    /// Called before each host step.
    pub before_step: BeforeStep,
    /// Called at the end, for what is particular to the case.
    pub checks: Checks,
}

impl Script {
    /// Returns a script in which nothing happens and nothing particular is checked.
    pub fn new() -> Self {
        Script { before_step: Box::new(|_| Ok(())), checks: Box::new(|_| Vec::new()) }
    }

    /// Sets what happens before each host step.
    pub fn before_step(self, action: impl FnMut(&mut TestWorld) -> Result<(), Fault> + 'static) -> Self {
        Script { before_step: Box::new(action), ..self }
    }

    /// Sets what is checked at the end.
    pub fn checks(self, checks: impl FnOnce(&TestWorld) -> Vec<Check> + 'static) -> Self {
        Script { checks: Box::new(checks), ..self }
    }
}

type Build = Box<dyn Fn(&mut TestWorld) -> Result<Script, Fault> + Send + Sync>;

/// A hard case.
pub struct Case {
    pub family: Family,
    pub name: String,
    /// Simulated time in s; at least one host step is done.
    pub duration: f64,
    pub bounds: Bounds,
    pub step_errors: StepErrors,
    /// Whether Rapier's own ropes can do the same.
    pub peers: bool,
    /// Whether it is run on a host.
    pub hosts: Box<dyn Fn(&Host) -> bool + Send + Sync>,
    /// Element evaluations that a run may take.
    pub budget: u64,
    /// Whether only the long tests run it.
    pub long: bool,
    pub build: Build,
}

/// Element evaluations that a run may take by default, in millions: about 4 s of CPU time.
const BUDGET: u64 = 20;

/// Returns a case with the default bounds, on all hosts, with the default budget.
pub fn case(
    family: Family,
    name: impl Into<String>,
    duration: f64,
    build: impl Fn(&mut TestWorld) -> Result<Script, Fault> + Send + Sync + 'static,
) -> Case {
    Case {
        family,
        name: name.into(),
        duration,
        bounds: Bounds::default(),
        step_errors: StepErrors::Fail,
        peers: true,
        hosts: Box::new(|host| !host.effects || host.iterations == 4),
        budget: BUDGET * 1_000_000,
        long: false,
        build: Box::new(build),
    }
}

impl Case {
    /// Sets the bound on gaps in m.
    pub fn gap(mut self, gap: f64) -> Self {
        self.bounds.gap = gap;
        self
    }

    /// Sets the bounds on energy made and lost, as shares.
    pub fn energy(mut self, made: f64, lost: f64) -> Self {
        self.bounds.energy = EnergyBounds::Within { made, lost };
        self
    }

    /// Leaves the energy balance unchecked, for a reason.
    pub fn energy_not_checked(mut self, reason: &'static str) -> Self {
        self.bounds.energy = EnergyBounds::NotChecked(reason);
        self
    }

    /// Excludes Rapier's own ropes, which cannot do the same.
    pub fn lariat_only(mut self) -> Self {
        self.peers = false;
        self
    }

    /// Accepts an error of a step as an answer.
    pub fn may_fail(mut self) -> Self {
        self.step_errors = StepErrors::Allowed;
        self
    }

    /// Sets the hosts that it is run on.
    pub fn on(mut self, hosts: fn(&Host) -> bool) -> Self {
        self.hosts = Box::new(hosts);
        self
    }

    /// Sets the budget in millions of element evaluations.
    pub fn budget(mut self, millions: u64) -> Self {
        self.budget = millions * 1_000_000;
        self
    }

    /// Leaves it to the long tests.
    pub fn long(mut self) -> Self {
        self.long = true;
        self
    }

    /// Returns whether this model of the cables can be run on this host.
    pub fn applies(&self, host: &Host, model: CableModel) -> bool {
        (self.hosts)(host) && (model == CableModel::Lariat || self.peers && !host.effects)
    }
}
