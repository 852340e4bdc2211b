//! The equilibrium of a cable by itself: the sequence of attempts, see [`statics`](crate::statics),
//! and with drag the search of an island without bodies.

use super::load::Loads;
use super::search::Search;
use crate::cable::Cable;
use crate::cable::Snapshot;
use crate::contact::Overlap;
use crate::error::{EquilibriumFailure, Error, require};
use crate::model::{LoadScale, Model};
use crate::scales::statics::{PULLS, SNAG};
use crate::state::ContactMemory;
use crate::statics::move_with_supports;
use crate::statics::{
    Budget, Continued, EquilibriumOptions, EquilibriumReport, Failure, find, first_fold, in_shares, lay_out, straighten,
};
use crate::support::SlopeSupport;
use nalgebra::Vector3;

impl Cable {
    /// Moves the cable to static equilibrium under gravity, its full point loads, its effects and
    /// its supports, and sets its velocities to zero. A flow is that of the cable's time.
    ///
    /// # Errors
    /// [`Error::NoEquilibrium`] if none is found; the cable is then as before. [`Error::Attached`]
    /// for a cable with [attached](crate::coupling::Coupling::attach) nodes.
    pub fn equilibrium(&mut self) -> Result<EquilibriumReport, Error> {
        self.equilibrium_with(EquilibriumOptions::default())
    }

    /// Moves the cable to static equilibrium as [`equilibrium`](Self::equilibrium) does, with
    /// options.
    ///
    /// # Errors
    /// As [`equilibrium`](Self::equilibrium).
    pub fn equilibrium_with(&mut self, options: EquilibriumOptions) -> Result<EquilibriumReport, Error> {
        let no_equilibrium = |cable: &Cable, failure: EquilibriumFailure, residual: f64, iterations: usize| {
            Error::NoEquilibrium { cable: cable.name().to_string(), time: cable.time(), failure, residual, iterations }
        };
        self.check_complete()?;
        require("equilibrium tolerance", options.tolerance, options.tolerance > 0.0, "> 0")?;
        if let Some(resultant) = unheld(&self.model) {
            return Err(no_equilibrium(self, EquilibriumFailure::NotHeld, resultant, 0));
        }
        self.system.static_time = self.time();
        self.begin_static_contact();
        let (before, revision, work) = (self.snapshot.clone(), self.revision, self.snapshot.work);
        let loads = self.model.loads.clone();
        // the point loads ramp with a time from 0 to 1 while statics are solved
        let now = self.time();
        for load in &mut self.model.loads {
            load.stay(now);
            (load.ramp, load.start) = (1.0, 0.0);
        }
        let start = self.system.forces.drive().then(|| self.snapshot.clone());
        let mut alone = Alone { cable: self, options, budget: Budget::new(&options), searched: 0, exact: false };
        let mut outcome = find(&mut alone);
        if let (Err(_), Some(start)) = (&outcome, start)
            && let Some(report) = alone.follow(start)
        {
            outcome = Ok(report);
        }
        let iterations = alone.searched + alone.budget.done;
        self.model.loads = loads;
        let snags = if outcome.is_ok() { self.snags() } else { None };
        let contacts = self.end_static_contact();
        match outcome {
            Ok(report) => {
                // the work of drag during the search is not part of the cable's history
                self.snapshot.work = work;
                self.set_at_rest();
                self.snapshot.state.memory.contacts = contacts;
                let pulls = PULLS
                    * report.residual.max(options.tolerance * LoadScale::new(&self.model, self.positions()).force);
                if let Some(failure) = self.crosses().or(snags).or_else(|| self.slips(pulls)) {
                    self.snapshot = before;
                    return Err(no_equilibrium(self, failure, 0.0, iterations));
                }
                Ok(EquilibriumReport { iterations, ..report })
            }
            Err(failure) => {
                let fold = failure.fold.or_else(|| first_fold(self, self.positions()));
                self.snapshot = before;
                self.revision = revision;
                let reason = match (failure.cause, fold) {
                    (Some(cause), _) => cause.into(),
                    (None, Some(element)) => EquilibriumFailure::Folded { element },
                    (None, None) => EquilibriumFailure::NotConverged,
                };
                Err(no_equilibrium(self, reason, failure.residual, iterations))
            }
        }
    }

    /// Lets statics see the obstacles.
    pub(crate) fn begin_static_contact(&mut self) {
        let (model, time) = (&self.model, self.snapshot.state.time);
        let mut q = self.snapshot.state.q.clone();
        for (node, support) in &model.supports {
            support.prescribe(time, &mut q[6 * node..6 * node + 6], &mut [0.0; 6]);
        }
        self.system.static_contact.begin(model, time, &q);
        if self.model.effects.torsion.is_some() {
            let torsion = self.system.torsion_forces.get_or_insert_default();
            torsion.begin(&self.model, &mut self.snapshot.state);
        }
    }

    /// Ends it, and returns the contacts of the present shape.
    pub(crate) fn end_static_contact(&mut self) -> Vec<ContactMemory> {
        let mut contacts = Vec::new();
        self.system.static_contact.remember(&self.model, &self.snapshot.state.q, &mut contacts);
        self.system.static_contact.end();
        if let Some(mut torsion) = self.system.torsion_forces.take() {
            self.diagnostics.twist_slips += torsion.end(&self.model, &mut self.snapshot.state);
        }
        contacts
    }

    /// Returns the failure of an equilibrium that runs through an obstacle.
    pub(super) fn crosses(&self) -> Option<EquilibriumFailure> {
        let Overlap { obstacle, arc_length, depth, .. } = self.overlap().filter(|overlap| overlap.crosses)?;
        Some(EquilibriumFailure::Touches { obstacle, arc_length, depth })
    }

    /// Returns the failure of an equilibrium in which a sharp edge holds the cable along itself.
    pub(super) fn snags(&self) -> Option<EquilibriumFailure> {
        let (obstacle, arc_length, force) = self.system.static_contact.snag(&self.model, self.positions())?;
        let loads = LoadScale::new(&self.model, self.positions()).force;
        let is_held = force > SNAG * self.peak_tension().1.max(loads);
        is_held.then_some(EquilibriumFailure::Snags { obstacle, arc_length, force })
    }

    fn attempts(&mut self, budget: &mut Budget, exact: bool) -> Result<EquilibriumReport, Failure> {
        self.place_supports();
        if self.system.forces.drive() {
            return self.come_to_rest_in_flow(budget, exact);
        }
        let start = self.snapshot.clone();
        let moments = self.model.loads.iter().any(|load| load.moment != Vector3::zeros());
        let pure = moments
            && self.model.gravity == Vector3::zeros()
            && self.model.loads.iter().all(|load| load.force == Vector3::zeros());
        let loads = !self.model.loads.is_empty();
        let mut unstable = None;
        let mut last = Failure::default();
        for attempt in 0..5 {
            budget.begin_attempt();
            let outcome = match attempt {
                0 if moments => self.ramp_loads(budget),
                1 => self.minimise_energy(1.0, budget),
                2 if loads && !moments => self.ramp_loads(budget),
                3 => {
                    lay_out(&self.model, &mut self.snapshot.state.q);
                    let Cable { system, model, snapshot, .. } = &*self;
                    if system.static_contact.passes(model, &start.state.q, &snapshot.state.q) {
                        self.snapshot = start.clone();
                        continue;
                    }
                    self.minimise_energy(1.0, budget)
                }
                4 => {
                    let relaxed = self.relax(budget);
                    relaxed.and_then(|()| self.minimise_energy(1.0, budget))
                }
                _ => continue,
            };
            match outcome.and_then(|report| self.without_folds(report, budget)) {
                // the first minimum is accepted even if it is indifferent, and so is any shape
                // under moments alone
                Ok(report) if report.stable || attempt == 1 || pure => return Ok(report),
                Ok(report) => unstable = unstable.or(Some((report, self.snapshot.clone()))),
                Err(failure) => {
                    // an attempt without an iteration has no residual
                    let residual = if failure.residual.is_nan() { last.residual } else { failure.residual };
                    last = Failure { residual, fold: failure.fold.or(last.fold), ..failure };
                }
            }
            if budget.spent() {
                break;
            }
            if attempt < 4 {
                self.snapshot = start.clone();
            }
        }
        match unstable {
            Some((report, state)) => {
                self.snapshot = state;
                Ok(EquilibriumReport { iterations: budget.done, ..report })
            }
            None => Err(last),
        }
    }

    /// Comes to rest in a flow, or under a force of the user's own, which have no potential to
    /// minimise.
    fn come_to_rest_in_flow(&mut self, budget: &mut Budget, exact: bool) -> Result<EquilibriumReport, Failure> {
        let start = self.snapshot.clone();
        let found = self.come_to_rest(budget, exact);
        if found.is_ok() || self.effects().contact.is_some() || self.effects().torsion.is_some() {
            return found;
        }
        self.snapshot = start;
        budget.begin_attempt();
        self.follow_to_rest_in_flow(budget)
    }

    /// Comes to rest by the search of an island without bodies.
    fn come_to_rest(&mut self, budget: &mut Budget, exact: bool) -> Result<EquilibriumReport, Failure> {
        let loads = self.model.loads.clone();
        self.model.loads.iter_mut().for_each(|load| load.ramp = 0.0);
        let cables = &mut [&mut *self];
        let mut search = Search::new(cables, &[], (&[], &[], Loads::default()), budget.tolerance);
        search.exact = exact;
        let outcome = search.run(cables, budget.left());
        self.model.loads = loads;
        self.snapshot.state.q.copy_from_slice(&search.q);
        self.set_at_rest();
        budget.done += search.steps;
        let residual = search.residual;
        match outcome {
            Ok(stable) => Ok(EquilibriumReport { iterations: budget.done, residual, stable }),
            Err(EquilibriumFailure::Step(cause)) => Err(Failure { cause: Some(cause), residual, fold: None }),
            Err(EquilibriumFailure::Folded { element }) => Err(Failure { residual, fold: Some(element), cause: None }),
            Err(_) => Err(Failure { residual, fold: None, cause: None }),
        }
    }

    /// Sets all velocities to zero.
    pub(crate) fn set_at_rest(&mut self) {
        self.snapshot.state.v.fill(0.0);
        self.disturb();
    }

    /// Moves the supports to their prescribed positions, and the cable with them.
    fn place_supports(&mut self) {
        let (equations, state) = self.equations();
        let before = state.q.clone();
        equations.prescribe(state.time, &mut state.q, &mut state.v);
        move_with_supports(equations.model, &before, &mut state.q);
    }

    /// Returns the report if no element is folded; else straightens the folds and minimises the
    /// energy again.
    fn without_folds(&mut self, report: EquilibriumReport, budget: &mut Budget) -> Result<EquilibriumReport, Failure> {
        if first_fold(self, self.positions()).is_none() {
            return Ok(report);
        }
        let mut q = self.positions().to_vec();
        straighten(self, &mut q);
        self.snapshot.state.q = q;
        let report = self.minimise_energy(1.0, budget)?;
        match first_fold(self, self.positions()) {
            None => Ok(report),
            fold => Err(Failure { cause: None, residual: report.residual, fold }),
        }
    }
}

/// The search for the equilibrium of a cable by itself.
struct Alone<'a> {
    cable: &'a mut Cable,
    options: EquilibriumOptions,
    budget: Budget,
    /// Iterations of the searches before the present one.
    searched: usize,
    /// Whether the part of the tangent that is not symmetric is solved with the rest.
    exact: bool,
}

impl Alone<'_> {
    /// Searches with the whole tangent, and if that fails too under what drives the cable as it
    /// grows from nothing. Without a shape the cable is as before.
    fn follow(&mut self, start: Snapshot) -> Option<EquilibriumReport> {
        if self.cable.effects().torsion.is_some() {
            return None;
        }
        self.exact = true;
        let (time, mut good) = (self.cable.time(), start);
        let end = self.cable.snapshot.clone();
        let mut at = |share: f64| {
            let cable = &mut *self.cable;
            cable.snapshot = good.clone();
            cable.system.forces.hold_share(&cable.model, time, share);
            cable.system.static_contact.end();
            cable.begin_static_contact();
            let found = find(self);
            if found.is_ok() {
                good = self.cable.snapshot.clone();
            }
            found
        };
        let found = at(1.0).ok().or_else(|| in_shares(at));
        self.cable.system.forces.release(&self.cable.model);
        if found.is_none() {
            // the shape in which it failed at first tells why
            self.cable.snapshot = end;
        }
        found
    }

    fn begin(&mut self) {
        self.searched += self.budget.done;
        self.budget = Budget::new(&self.options);
    }
}

impl Continued for Alone<'_> {
    type Found = EquilibriumReport;
    type Failure = Failure;
    type Shape = Snapshot;

    fn search(&mut self) -> Result<EquilibriumReport, Failure> {
        self.begin();
        let Alone { cable, budget, exact, .. } = self;
        cable.with_workspace(|cable| cable.attempts(budget, *exact))
    }

    fn improve(&mut self) -> Result<EquilibriumReport, Failure> {
        self.begin();
        let Alone { cable, budget, exact, .. } = self;
        cable.with_workspace(|cable| {
            if cable.system.forces.drive() {
                return cable.come_to_rest_in_flow(budget, *exact);
            }
            let report = cable.minimise_energy(1.0, budget)?;
            cable.without_folds(report, budget)
        })
    }

    fn shape(&self) -> Snapshot {
        self.cable.snapshot.clone()
    }

    fn restore(&mut self, shape: Snapshot) {
        self.cable.snapshot = shape;
    }

    fn for_each(&mut self, mut f: impl FnMut(&mut Cable, &[f64])) {
        let q = self.cable.positions().to_vec();
        f(self.cable, &q);
    }
}

/// Returns the resultant of the loads in N that no support can take, if there is one: a force on a
/// cable without a held position or a potential, which may hold, or moments alone (divided by the
/// length) on one that is free to rotate about its only held point.
fn unheld(model: &Model) -> Option<f64> {
    let (weight, size) = model.dead_resultant();
    let size = model.loads.iter().fold(size, |sum, load| sum + load.force.norm());
    let supports = model.supports.iter().filter(|(_, support)| support.holds_position()).count();
    let held = supports + model.potentials.list.len();
    let rotates = model.supports.iter().all(|(_, support)| support.slope == SlopeSupport::Free);
    let force = model.loads.iter().fold(weight, |sum, load| sum + load.force).norm();
    let moment = model.loads.iter().map(|load| load.moment).sum::<Vector3<f64>>().norm();
    match held {
        0 => (force > 1e-12 * size).then_some(force),
        1 => (rotates && size == 0.0 && moment > 0.0).then_some(moment / model.length()),
        _ => None,
    }
}
