//! Plays a case: steps, and after each step what holds for all cases.

use super::{Bounds, Case, Play, Refusals, Stage, Strand, from, peers};
use crate::stability::host::{Host, Make};
use crate::stability::outcome::{Outcome, Reading, Row};
use cpu_time::ThreadTime;
use lariat_ancf::Vector3;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A rival whose rope is so many times its length, or whose bodies are so fast (m/s), has flown apart.
const LOST: f64 = 10.0;

/// What is followed through a run.
#[derive(Default)]
pub struct Trace {
    /// Energy when the account began, work put in since, and by attachment and cable what was accounted so far.
    start: f64,
    put_in: f64,
    worked: Vec<f64>,
    dissipated: f64,
    effects: f64,
    /// While a user's change works itself out nothing is asked.
    paused: bool,
    moved: bool,
    /// Extremes of the energy account.
    created: f64,
    change: f64,
    /// Largest kinetic and strain energy.
    scale: f64,
    pub gap: f64,
    pub constraint: f64,
    pub stretch: f64,
    pub fastest: f64,
    /// By attachment: greatest, mean force in N, over the run.
    pub peak: Vec<f64>,
    sum: Vec<Vector3<f64>>,
    count: f64,
}

impl Stage {
    /// Begins the account of energy anew: a user changed the world.
    pub fn rebase(&mut self) {
        let (energy, _) = self.energy();
        self.trace.put_in = 0.0;
        self.trace.change = 0.0;
        self.trace.start = energy;
        self.trace.worked = self.works();
        self.trace.effects = self.effect_work();
        self.trace.dissipated = self.dissipated();
        self.trace.paused = false;
        self.trace.moved = false;
    }

    /// Asks for nothing until [`rebase`](Self::rebase): a user changes the world, which does work and opens gaps.
    pub fn pause(&mut self) {
        self.trace.paused = true;
    }

    /// Follows gaps and all else, but not energy, until [`rebase`](Self::rebase): the work of a winch is accounted from the forces at the
    /// ends of Rapier's steps, and a stiff cable rings faster.
    pub fn trace_without_energy(&mut self) {
        self.trace.moved = true;
    }

    /// Adds work that a case put in, in J.
    pub fn put_in(&mut self, work: f64) {
        self.trace.put_in += work;
    }

    /// Mean force of an attachment in N.
    pub fn mean_force(&self, i: usize) -> Vector3<f64> {
        self.trace.sum.get(i).map_or(Vector3::repeat(f64::NAN), |s| s / self.trace.count.max(1.0))
    }

    /// Begins means and peaks of forces anew.
    pub fn restart_means(&mut self) {
        self.trace.count = 0.0;
        self.trace.sum.clear();
        self.trace.peak.clear();
    }

    /// Total energy, and its kinetic and strain part, in J.
    pub fn energy(&self) -> (f64, f64) {
        let Ok(e) = self.set.energy(&self.world) else { return (f64::NAN, f64::NAN) };
        let c = &e.cables;
        let soft: (f64, f64) = peers::soft_energy(self);
        (e.total() + soft.0, e.bodies_kinetic + c.kinetic + c.axial + c.bending + soft.1)
    }

    /// By attachment, work of the cable on its body so far, in J.
    fn works(&self) -> Vec<f64> {
        self.held.iter().map(|a| self.set.attachment(*a).map_or(0.0, |a| a.work())).collect()
    }

    /// Work of line loads and of a flow that drives, so far, in J.
    fn effect_work(&self) -> f64 {
        self.set.iter().map(|(_, c)| c.effect_work().line_loads + c.effect_work().drag.max(0.0)).sum()
    }

    /// What damping and drag took so far, in J.
    fn dissipated(&self) -> f64 {
        self.set.iter().map(|(_, c)| (-c.effect_work().drag).max(0.0) - c.effect_work().damping).sum()
    }

    /// Mass of all that moves, bodies and cables, in kg.
    pub fn mass(&self) -> f64 {
        let bodies = self.world.bodies.iter().filter(|(_, b)| b.is_dynamic()).map(|(_, b)| f64::from(b.mass()));
        // ledgers are no bodies of the scene
        let bodies: f64 = bodies.filter(|mass| *mass < 1e8).sum();
        let of =
            |c: &lariat_ancf::Cable| c.elements().iter().map(|e| e.length * e.section.mass_per_length).sum::<f64>();
        let cables: f64 = self.set.iter().map(|(_, c)| of(c)).sum();
        bodies + cables
    }

    /// What the weight of all that moves does over 1 mm, in J.
    fn least_scale(&self) -> f64 {
        9.81e-3 * self.mass()
    }

    /// Whether everything is a number.
    pub fn is_finite(&self) -> bool {
        let bodies = self.world.bodies.iter().all(|(_, b)| {
            [b.translation(), b.linvel(), b.angvel()].iter().all(|x| from(*x).iter().all(|x| x.is_finite()))
        });
        let cables = self.set.iter().all(|(_, c)| c.positions().iter().chain(c.velocities()).all(|x| x.is_finite()));
        bodies && cables && peers::soft_is_finite(self)
    }

    /// After a host step.
    pub fn observe(&mut self) {
        let (energy, lively) = self.energy();
        let works = self.works();
        for (i, handle) in self.held.iter().enumerate() {
            let Ok(a) = self.set.attachment(*handle) else { continue };
            let free = self.world.bodies.get(a.body()).is_some_and(|b| b.is_dynamic() && b.is_enabled());
            if !free {
                self.trace.put_in -= works[i] - self.trace.worked.get(i).copied().unwrap_or(0.0);
            }
        }
        let effects = self.effect_work();
        self.trace.put_in += effects - self.trace.effects;
        self.trace.effects = effects;
        self.trace.worked = works;
        let gained = energy - self.trace.start - self.trace.put_in;
        self.trace.change = gained + self.dissipated() - self.trace.dissipated;
        // f64::max would pass over one that is not a number
        if !self.trace.paused && !self.trace.moved && (gained > self.trace.created || gained.is_nan()) {
            self.trace.created = gained;
        }
        self.trace.scale = self.trace.scale.max(lively).max(self.least_scale());
        let gap = self.held.iter().filter_map(|a| self.set.attachment(*a).ok()).map(|a| a.gap());
        let gap = gap.fold(0.0, f64::max).max(peers::gap(self));
        if !self.trace.paused {
            self.trace.gap = self.trace.gap.max(gap);
        }
        self.trace.constraint = self.trace.constraint.max(self.joint_error());
        let stretch = (0..self.strands.len()).map(|i| self.stretch(i)).fold(f64::NEG_INFINITY, f64::max);
        self.trace.stretch = self.trace.stretch.max(stretch);
        let forces: Vec<Vector3<f64>> = (0..self.held.len()).map(|i| self.force(i)).collect();
        self.trace.peak.resize(forces.len(), 0.0);
        self.trace.sum.resize(forces.len(), Vector3::zeros());
        for (i, force) in forces.iter().enumerate() {
            self.trace.peak[i] = self.trace.peak[i].max(force.norm());
            self.trace.sum[i] += force;
        }
        self.trace.count += 1.0;
        let speeds = self.world.bodies.iter().map(|(_, b)| from(b.linvel()).norm());
        self.trace.fastest = speeds.fold(self.trace.fastest, f64::max);
    }

    /// Length of a rope through nodes, particles or joints over its rest length, less 1.
    pub fn stretch(&self, i: usize) -> f64 {
        match &self.strands[i] {
            Strand::Cable(handle) => self.set.get(*handle).map_or(0.0, |c| {
                let places: Vec<Vector3<f64>> = (0..c.nodes()).map(|k| c.node_position(k)).collect();
                places.windows(2).map(|p| (p[1] - p[0]).norm()).sum::<f64>() / c.length() - 1.0
            }),
            strand => peers::stretch(self, strand),
        }
    }

    /// Worst distance of the anchors of joints along the axes that they lock, in m; ledgers lock none.
    fn joint_error(&self) -> f64 {
        let joints = self.world.impulse_joints.iter().filter_map(|(_, j)| {
            let (a, b) = (self.world.bodies.get(j.body1())?, self.world.bodies.get(j.body2())?);
            let (one, two) = (*a.position() * j.data.local_frame1, *b.position() * j.data.local_frame2);
            let apart = from(one.rotation.inverse() * (two.translation - one.translation));
            let locked = j.data.locked_axes.bits();
            let along = (0..3).filter(|k| locked & (1 << k) != 0).map(|k| apart[k] * apart[k]).sum::<f64>();
            Some(along.sqrt())
        });
        joints.fold(0.0, f64::max)
    }

    fn all_states(&self) -> Vec<f64> {
        self.set.iter().flat_map(|(_, c)| c.positions().iter().chain(c.velocities()).copied()).collect()
    }
}

/// Plays a case on a host. A panic is an outcome, and so is a budget that ran out.
pub fn play(case: &Case, host: Host, make: Make) -> Row {
    let clock = ThreadTime::now();
    let mut stage = Stage::new(host, make);
    let ran = catch_unwind(AssertUnwindSafe(|| run(case, &mut stage, &clock)));
    let outcome = ran.unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_string()));
        Outcome::Panicked(text.unwrap_or_default())
    });
    let seconds = clock.elapsed().as_secs_f64();
    let counts = stage.set.iter().map(|(_, c)| c.diagnostics()).max_by_key(|d| d.steps).copied().unwrap_or_default();
    let trace = &stage.trace;
    Row {
        family: case.family.name(),
        case: case.name.clone(),
        host,
        make,
        outcome,
        energy: trace.change / trace.scale.max(1e-9),
        gap: trace.gap,
        constraint: trace.constraint,
        stretch: trace.stretch,
        steps: counts.steps,
        rejected: counts.rejected_steps,
        micros: 1e6 * seconds / stage.k.max(1) as f64,
        seconds,
    }
}

fn run(case: &Case, stage: &mut Stage, clock: &ThreadTime) -> Outcome {
    let Play { mut act, judge } = match (case.build)(stage) {
        Ok(play) => play,
        Err(error) => return Outcome::Failed(error.to_string()),
    };
    stage.rebase();
    let steps = ((case.duration * f64::from(stage.host.rate)).round() as usize).max(1);
    while stage.k < steps {
        if let Err(error) = act(stage) {
            return Outcome::Failed(error.to_string());
        }
        let before = stage.all_states();
        if let Err(error) = stage.step() {
            return refused(case, stage, &before, &error.to_string());
        }
        stage.k += 1;
        stage.time += stage.dt();
        if !stage.is_finite() {
            return Outcome::NotFinite;
        }
        stage.observe();
        if stage.make != Make::Lariat && (stage.trace.stretch > LOST || stage.trace.gap > LOST) {
            return Outcome::Failed("flew apart".to_string());
        }
        if clock.elapsed().as_secs_f64() > case.budget && stage.k < steps {
            let missed = missed(universal(&case.bounds, stage));
            return if missed.is_empty() {
                Outcome::OverBudget(stage.k as f64 / steps as f64)
            } else {
                Outcome::Missed(missed)
            };
        }
    }
    if case.refusals == Refusals::Must {
        return Outcome::Failed("no step was refused".to_string());
    }
    let mut readings = universal(&case.bounds, stage);
    // what a case expects is reckoned without effects
    if !stage.host.effects && stage.make == Make::Lariat {
        readings.extend(judge(stage));
    }
    let missed = missed(readings);
    if missed.is_empty() { Outcome::Held } else { Outcome::Missed(missed) }
}

fn missed(readings: Vec<Reading>) -> Vec<Reading> {
    readings.into_iter().filter(|r| !r.holds()).collect()
}

fn universal(bounds: &Bounds, stage: &Stage) -> Vec<Reading> {
    let t = &stage.trace;
    if stage.make != Make::Lariat {
        return Vec::new();
    }
    let scale = t.scale.max(1e-9);
    vec![
        Reading::at_most("gap, m", t.gap, bounds.gap, "the contract of an attachment"),
        Reading::at_most("energy made", t.created / scale, bounds.created, "conservation of energy"),
        Reading::at_most("energy lost", -t.change / scale, bounds.lost, "conservation of energy"),
    ]
}

/// A refused step: is it an answer, does it say why, is the last good state intact?
fn refused(case: &Case, stage: &Stage, before: &[f64], error: &str) -> Outcome {
    let named = error.contains("rope") || error.contains("body");
    // a host step of several Rapier steps may end after some of them: then the state is a later one, but a good one
    let kept = stage.is_finite() && stage.all_states().len() == before.len();
    if case.refusals == Refusals::Never || !named || !kept {
        let complaint = if !kept {
            " (state not intact)"
        } else if !named {
            " (culprit not named)"
        } else {
            ""
        };
        return Outcome::Failed(format!("{error}{complaint}"));
    }
    Outcome::Refused(error.to_string())
}
