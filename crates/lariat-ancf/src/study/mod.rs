//! Runs to a given error: mesh and tolerance are chosen by runs that check each other.
//!
//! # Equation
//!
//! A program states an error `e` in m of all recorded positions at all recorded times. The study
//! runs it with `n_A < n_B` elements at the tolerance `tau = e dt/(4 T)` per host step `dt` of the
//! duration `T`, beginning with 4 and 8, and takes
//!
//! - `e_mesh = d max(1, 1/(f^p - 1))` for the error of the mesh, with the largest distance `d`
//!   between the two runs and the least ratio `f` of their element lengths, found on the meshes
//!   themselves. The order p is 1: the whole difference of a mesh and its half. Where the last two
//!   distances or the [mesh indicator](crate::coupling::Linearisation::mesh_indicator) of both runs
//!   show less than the first order, it is what they show, at least 1/4. It is 2/3 at most with two
//!   meshes alone of a motion, where [velocities jump](Record::velocities_jump), and for an
//!   equilibrium that is held between the ends of a cable; for one that is smooth there it is what
//!   both show, up to 2, with two meshes what the indicator shows, as far as the claim is at least
//!   four times the indicator of the finer one;
//! - `e_time` from runs at `8 tau` and `tau` or, where the host step limits their steps, from one
//!   in shorter equal steps: see `time`. Where the world has what only the discrete gradient steps
//!   ([`Study::coupled`]), from whole runs whose steps and host steps are halved: see `halving`.
//!   The order p is 2/3 at most there, a claim rests on two distances between meshes at least,
//!   which show the order 1/2, and the error in time is measured on the last mesh again.
//!
//! The study ends with the finer of the two runs when `e_mesh + e_time <= e`; else the next run has
//! 1.5 to 3 times as many elements, after the difference and an order of 2.5. Where refining does
//! not help (the difference is above 0.6 of that of two meshes before, and was so at one of the
//! last two meshes), the motion is not determined by its start within `e`, as that of a chaotic
//! pendulum: the study reports the time up to which `e` holds, in a coupled one by the last three
//! meshes; the first recorded time where the runs say nothing about it. Where meshes are apart from
//! the first tenth of the motion on, which is no chaos, the order is that of the last three
//! differences; and where by it half as many elements again as are allowed would be needed, the
//! study ends at once and reports how many: that number is an extrapolation, and no claim rests on
//! it. A first run that fails is repeated with twice and four times as many elements. One that
//! fails later, on a finer mesh or at a tighter tolerance, ends the study, which reports up to when
//! those before it prove the error, and [which run](Claim::failed) it was; where none could be
//! compared, the last one that worked is run again, and nothing is proven.
//!
//! Asked for an error of tensions or moments ([`Target`]), the study runs the world once at first,
//! for what its cables carry, and then compares that: at the nodes that are held, loaded or ends,
//! and the largest along each cable. Tolerances begin with the error of positions that belongs to
//! it, which is also what a tolerance counts as (`forces.rs`). The mesh indicator is about
//! positions and says nothing; of an equilibrium the order is half an order below what two
//! distances show, 2/3 to 2, 1 of a single distance, on which a claim rests only where finer meshes
//! are not allowed. No distance counts as smaller than at the order 2.5 after the one before: on a
//! seabed two meshes agree by chance to a 40th of their error.
//!
//! # Validity
//!
//! The claim is about the equations of the rod with its rule, law and effects. Their own error is
//! not part of it, nor is what the runs have in common: the host step of a physics engine with its
//! contacts and joints, single precision, sampled flows, an equilibrium that both meshes find
//! though another is meant. A cable whose elements are not refined proves nothing, and the study
//! goes on.
//!
//! The first order is what a cable shows that a load bends within `sqrt(EI/T)`, shorter than its
//! elements: on the bridge of `assets/scenes` 9 mm at each hanger. Errors that change their sign
//! between two meshes are not bounded, nor are orders below the first that neither distances nor
//! indicator show: of 282 random equilibria with one claimed error each, one that is held between
//! its ends was off by 1.13 of it, and of another all meshes up to 120 elements find an equilibrium
//! that finer ones do not. Unless the study is coupled, the error in time of finer meshes is taken
//! to be that of the first one.
//!
//! # References
//!
//! Roache 1998, *Verification and validation in computational science and engineering*, chapter 5
//! (grid convergence; here with the safety factor of an order of 1 or more that is not relied on).
//! Tolerance proportionality: Hairer, Norsett, Wanner 1993, section II.4.
//!
//! # Alternatives considered
//!
//! What was tried, and what it gave: docs/decisions/study.md.

mod claim;
mod forces;
mod halving;
mod order;
mod record;
mod runs;
mod target;
mod time;

pub use crate::SharpBend;
pub use claim::{Claim, FailedRun, ForceClaim, Outcome, Proof, StudyError};
pub use record::Record;
pub use runs::Resolution;
pub use target::{InvalidTarget, Quantity, Target};

use crate::scales::study::{
    AGREED, BRANCH, FIRST, KINKS, LAST_FIRST, LEAST, LIMIT, MESHES, MOST_LENGTH, REFINED, SMALL,
};
use order::Difference;
use runs::{Run, Runs, Span};
use time::{Pilots, Time};

/// A program that builds a world at a resolution and runs it, and the error that is asked of it.
///
/// ```
/// use lariat_ancf::study::{Outcome, Study};
/// use lariat_ancf::{At, Cable, Error, Section, Vector3};
///
/// let section = Section::square(0.01, 1.0e8, 4000.0)?;
/// let pendulum = Study::new(0.5, 0.01, |resolution, record| {
///     let mut cable = Cable::builder()
///         .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
///         .section(section)
///         .fix(At::Start)
///         .elements(resolution.elements)
///         .integrator(resolution.integrator())
///         .build()?;
///     for _ in 0..50 {
///         cable.step(0.01)?;
///         record.frame(cable.time()).cable(&cable);
///     }
///     Ok::<_, Error>(cable)
/// });
/// let proof = pendulum.error(1e-2).run()?;
/// assert_eq!(proof.claim.outcome, Outcome::Proven);
/// assert!(proof.claim.claimed_m.unwrap() <= 1e-2);
/// let tip = proof.world.sample(2.0)?.position; // within 1e-2 m
/// assert!((tip - Vector3::new(1.3108, -1.2034, 0.0)).norm() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Study<F> {
    /// `None` for an equilibrium.
    span: Option<Span>,
    run: F,
    target: Target,
    limit: usize,
    coupled: bool,
}

impl<F> Study<F> {
    /// Returns a study of a motion of a duration in s, in host steps in s. `run` builds the world
    /// with the elements and the integrator that it is given, runs it, and records the positions at
    /// host times; what it returns for the last run, the study returns.
    pub fn new<W, E>(duration: f64, host_step: f64, run: F) -> Self
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        Study { span: Some(Span { steps: duration / host_step, host_step }), ..Self::of_equilibrium(run) }
    }

    /// Returns a study of an equilibrium: `run` records one frame, and the tolerance is `None`.
    pub fn of_equilibrium<W, E>(run: F) -> Self
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        Study { span: None, run, target: Target::default(), limit: LIMIT, coupled: false }
    }

    /// Sets the error that is asked for: a number is one of positions in m. Default 1e-3 m.
    ///
    /// For tensions and moments the world is run once more at first, with 8 elements and the
    /// default integrator, which says how large they are.
    pub fn error(self, target: impl Into<Target>) -> Self {
        Study { target: target.into(), ..self }
    }

    /// Sets the largest number of elements of a cable. Default 160.
    pub fn limit(self, elements: usize) -> Self {
        Study { limit: elements, ..self }
    }

    /// Tells whether the world has what only the discrete gradient steps: contact, torsion, a
    /// clutch, a brake, a drum, a sheave. Its runs then differ in the number of
    /// [parts](Resolution::parts) of a host step, too. Default false.
    pub fn coupled(self, coupled: bool) -> Self {
        Study { coupled, ..self }
    }

    /// Runs the world until its error is proven, or until refining does not help;
    /// [`Claim::outcome`] says which.
    ///
    /// # Errors
    /// [`StudyError::Run`] if no run works, [`StudyError::InvalidError`],
    /// [`StudyError::InvalidSpan`], [`StudyError::NothingRecorded`],
    /// [`StudyError::DifferentTimes`].
    pub fn run<W, E>(self) -> Result<Proof<W>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let Study { span, run, target, limit, coupled } = self;
        let error = target.error;
        if !(error.is_finite() && error > 0.0) {
            return Err(StudyError::InvalidError { value: error });
        }
        if let Some(Span { steps, host_step }) = span
            && !(steps.is_finite() && steps > 0.0 && host_step > 0.0)
        {
            return Err(StudyError::InvalidSpan { steps, host_step });
        }
        let span = span.map(|span| Span { steps: (span.steps - 1e-9).ceil().max(1.0), ..span });
        let coupled = coupled && span.is_some();
        let mut runs = Runs {
            run,
            target,
            error,
            length: error,
            span,
            coupled,
            count: 0,
            evaluations: 0,
            worked: None,
            failed: None,
        };
        let mut first = FIRST;
        if target.of_positions().is_none() {
            first = runs.measured()?.unwrap_or(first);
        }
        let last_first = LAST_FIRST.max(4 * first);
        // those of a mesh of which a run at a tighter tolerance failed
        let mut kept = None;
        let (mut coarse, mut fine, mut time) = loop {
            match runs.pilots(first) {
                Ok(pilots) if pilots.2.failed.is_some() && first < last_first => kept = Some(pilots),
                Err(StudyError::Run { .. }) if first < last_first => {}
                Err(StudyError::Run { elements, tolerance, source }) => match (kept, runs.worked) {
                    (Some(pilots), _) => break pilots,
                    (None, Some(resolution)) => return runs.nothing_proven(resolution),
                    (None, None) => return Err(StudyError::Run { elements, tolerance, source }),
                },
                outcome => break outcome?,
            }
            first *= 2;
        };
        let mut differences = Vec::new();
        // the mesh whose error in time is known, where that of another one may be larger
        let mut confirmed = fine.elements;
        let mut apart_before = None;
        // the first of the meshes that do not come closer
        let mut doubted: Option<usize> = None;
        loop {
            // where the error in time is not known, the meshes say from when on
            let left = if time.stuck { 0.6 * error } else { error - time.error };
            let difference = coarse.record.distance(&fine.record)?;
            let ratio = coarse.record.refinement(&fine.record, coarse.elements, fine.elements);
            let refined = ratio >= REFINED;
            if refined {
                differences.push(Difference { distance: difference, ratio });
            }
            let indicated = coarse.record.indicated_order(&fine.record, ratio);
            let shown = match differences.len() {
                1 => indicated,
                _ if fine.record.carries() => order::shown(&differences),
                _ => order::shown_by_both(&differences, indicated),
            };
            let shown = shown.filter(|_| refined);
            let largest = fine.record.largest_order(span.is_none(), differences.len(), shown);
            let largest = if coupled { largest.min(KINKS) } else { largest };
            let factor = if refined { order::factor(&differences, indicated, largest) } else { f64::INFINITY };
            // an order that no distances show is believed as far as the indicator agrees with the
            // claim
            let believed = differences.len() == 1 && largest > KINKS;
            let mesh = match refined {
                true if believed => {
                    let of_waves = order::factor(&differences, indicated, KINKS) * difference;
                    (factor * difference).max(fine.record.indicated_error()).min(of_waves)
                }
                true if coupled || span.is_none() && fine.record.carries() => {
                    factor * difference.max(order::least_distance(&differences))
                }
                true => factor * difference,
                false => f64::INFINITY,
            };
            let apart = coarse.record.first_beyond(&fine.record, left / factor);
            let early = span.is_none_or(|span| apart.is_some_and(|time| time <= 0.1 * span.steps * span.host_step));
            let growth = if refined { order::growth(&differences, left, early) } else { 1.5 };
            // what parts with time says nothing about the next mesh
            let growth = if time.stuck { growth.min(2.0) } else { growth };
            // distances that do not fall do not say by how much either
            let growth = if order::stuck(&differences) { growth.min(LEAST) } else { growth };
            let next = ((fine.elements as f64 * growth).ceil() as usize).min(limit);
            let needed = order::needed(&differences, left).filter(|_| early);
            let needed = needed.map(|share| (share * fine.elements as f64).ceil());
            let at_limit = (next as f64) < 1.5 * fine.elements as f64;
            let settled = match span {
                // two meshes of an equilibrium agree about a force by chance, while they are coarse
                None if fine.record.carries() => differences.len() > 1 || at_limit,
                _ => !coupled || order::converge(&differences, MESHES, error),
            };
            let proven = mesh + time.error <= error && !time.stuck && settled;
            if proven && coupled && confirmed != fine.elements {
                confirmed = fine.elements;
                differences.pop();
                (coarse, fine, time) = runs.confirmed((coarse, fine, time), error - mesh)?;
                continue;
            }
            let beyond_by_one = |coarse: &Run<W>, fine: &Run<W>| {
                let factor = order::factor(order::tail(&differences, 1), None, largest);
                coarse.record.first_beyond(&fine.record, left / factor)
            };
            // before meshes resolve a motion several of them may not come closer: one that is so
            // much finer must agree
            let is_stuck = order::stuck_for_good(&differences, at_limit);
            doubted = is_stuck.then(|| doubted.unwrap_or(fine.elements));
            let agreed = doubted.is_some_and(|first| fine.elements >= AGREED * first);
            let mut failed = time.failed;
            let outcome = if proven {
                Outcome::Proven
            } else if is_stuck && (agreed || at_limit) || time.stuck && differences.len() > 2 {
                Outcome::NoConvergence
            } else if at_limit || needed.is_some_and(|n| n > 1.5 * limit as f64) {
                Outcome::ElementLimit
            } else if let Some(finer) = runs.attempt(time.resolution(next))? {
                // of runs with impacts two may agree by chance where all others are apart
                apart_before = beyond_by_one(&coarse, &fine).filter(|_| coupled && refined);
                (coarse, fine) = (fine, finer);
                continue;
            } else {
                failed = runs.failed;
                Outcome::NoConvergence
            };
            // distances at the end of a motion that no mesh determines show no order of what is
            // before
            let by_one = outcome == Outcome::NoConvergence && failed.is_none();
            let apart = if by_one { beyond_by_one(&coarse, &fine) } else { apart };
            let horizon = [apart, apart_before, time.horizon].into_iter().flatten().reduce(f64::min);
            // runs that are near each other and come no closer
            let horizon =
                horizon.or_else(|| coarse.record.first_beyond(&fine.record, SMALL * error).filter(|_| coupled));
            // and of runs that say nothing about each other nothing is proven
            let horizon = horizon.or_else(|| fine.record.first_time());
            let claimed = proven.then_some(mesh + time.error);
            let finite = Some(mesh).filter(|mesh| mesh.is_finite());
            let of_positions = !fine.record.carries();
            let forces = (!of_positions).then_some(ForceClaim {
                quantity: target.quantity,
                relative: target.relative,
                asked: error,
                claimed,
                mesh: finite,
                time: time.error,
            });
            let claim = Claim {
                asked_m: target.of_positions(),
                claimed_m: claimed.filter(|_| of_positions),
                mesh_m: finite.filter(|_| of_positions),
                time_m: Some(time.error).filter(|_| of_positions),
                forces,
                outcome,
                horizon_s: horizon.filter(|_| !proven && span.is_some()),
                other_branch: !proven
                    && match of_positions {
                        true => difference,
                        false => coarse.record.largest_distance(&fine.record),
                    } > BRANCH * fine.record.longest(),
                host_step_limits: time.saturated,
                steps_apart: time.stuck && !proven,
                elements: fine.elements,
                elements_needed: needed.filter(|_| outcome == Outcome::ElementLimit).map(|needed| needed as usize),
                tolerance_m: time.tolerance,
                parts: time.resolution(fine.elements).parts,
                failed: failed.filter(|_| !proven),
                runs: runs.count,
                cost: runs.evaluations as f64 / fine.record.evaluations().max(1) as f64,
            };
            return Ok(Proof { world: fine.world, claim });
        }
    }
}

impl<F> Runs<F> {
    /// Runs the world once for what its cables carry, and returns how many elements the first mesh
    /// has, if the world says so.
    fn measured<W, E>(&mut self) -> Result<Option<usize>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let mut elements = 2 * FIRST;
        let record = loop {
            match self.run(Resolution { elements, coupled: self.coupled, ..Resolution::default() }) {
                Err(StudyError::Run { .. }) if elements < 2 * LAST_FIRST => elements *= 2,
                outcome => break outcome?.record,
            }
        };
        self.length = record.as_position().unwrap_or(MOST_LENGTH * record.longest());
        Ok(record.first_elements())
    }

    /// Runs the world again as it worked, where all that it could be compared with failed.
    fn nothing_proven<W, E>(mut self, resolution: Resolution) -> Result<Proof<W>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        let failed = self.failed;
        let Run { world, record, elements } = self.run(resolution)?;
        let Target { quantity, relative, error } = self.target;
        let of_forces = ForceClaim { quantity, relative, asked: error, claimed: None, mesh: None, time: 0.0 };
        let claim = Claim {
            asked_m: self.target.of_positions(),
            claimed_m: None,
            mesh_m: None,
            time_m: None,
            forces: self.target.of_positions().is_none().then_some(of_forces),
            outcome: Outcome::NoConvergence,
            horizon_s: record.first_time().filter(|_| self.span.is_some()),
            other_branch: false,
            host_step_limits: false,
            steps_apart: false,
            elements,
            elements_needed: None,
            tolerance_m: resolution.tolerance,
            parts: resolution.parts,
            failed,
            runs: self.count,
            cost: self.evaluations as f64 / record.evaluations().max(1) as f64,
        };
        Ok(Proof { world, claim })
    }

    /// Returns the runs with `first` and twice as many elements, and the error in time.
    fn pilots<W, E>(&mut self, first: usize) -> Result<Pilots<W>, StudyError<E>>
    where
        F: FnMut(&Resolution, &mut Record) -> Result<W, E>,
    {
        if let Some(span) = self.span {
            return if self.coupled { self.in_halves(first, span) } else { self.in_time(first, span) };
        }
        let [coarse, fine] =
            [first, 2 * first].map(|elements| self.run(Resolution { elements, ..Resolution::default() }));
        Ok((coarse?, fine?, Time::default()))
    }
}
