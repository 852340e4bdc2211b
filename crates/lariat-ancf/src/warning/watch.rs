//! The worst readings of a cable over a run, and what they are worth a warning for.
//!
//! # Validity
//!
//! Limits of the error of position: 2e-3 of the length, and a tenth of the largest displacement.
//! Both were found on 30 scenes: what exceeds them was off by 0.2 to 11 % of the length, what does
//! not by less than 0.25 %. A mesh is judged as
//! [`Cable::mesh_indicator`](crate::coupling::Linearisation::mesh_indicator) says, steps as `steps`
//! says; the strain by the law of the material, which elongates a cable by 2 % less than Hooke's at
//! 1.4 % of EA, and by 7 % less at 5 %.

use super::advised::more;
use super::torsion::stiff_torsion;
use super::{Level, Warning, fold, less_elongation, sizes};
use crate::at::At;
use crate::cable::Cable;
use crate::effect::AxialLaw;
use crate::integrate::{Fidelity, OneStep};
use crate::reel::Feed;
use crate::scales::watch::{
    BREAKING, BREAKS, DEPTH, ELONGATION, ERROR, LARGEST_RATIO, MOST, MOTION, NOISE, REEL, ROUNDING, STRAIGHT, STRAIN,
    TURN,
};
use crate::strength::{Strength, Unseen};
use crate::support::Support;
use crate::watch::{Contacts, Estimate, Verdict, Watch};

/// A law that judges the readings; the error (m) that is asked for takes the place of its limit.
type Law = fn(&Watch, &Cable, Option<f64>) -> Option<Warning>;

/// Laws in the order of warnings; the flag says that one holds at every time, not for the whole run
/// only.
const LAWS: [(Law, bool); 34] = [
    (|watch, cable, _| watch.contacts.starts_inside(cable), true),
    (Watch::strain, true),
    (Watch::mesh, true),
    (Watch::small_motion, false),
    (Watch::single_elements, true),
    (Watch::long_steps, true),
    (Watch::fast_reel, true),
    (Watch::crossed, true),
    (Watch::energy, false),
    (Watch::rounded_ends, false),
    (|watch, cable, _| watch.contacts.sinks(cable), true),
    (|watch, cable, _| watch.contacts.coarse(cable), true),
    (|watch, cable, _| watch.contacts.touchdown(cable), true),
    (|watch, cable, _| watch.contacts.pried(cable), true),
    (|_, cable, _| Contacts::lags(cable), true),
    (|_, cable, _| unseen_load(cable), true),
    (|_, cable, _| breaks_again(cable, cable.snapshot.load.breaks()), true),
    (|_, cable, _| unresolved(cable), true),
    (|_, cable, _| cut_short(cable), true),
    (|_, cable, _| unsolved(cable), true),
    (Watch::twist, true),
    (Watch::kinks, true),
    (Watch::moment_along, true),
    (|_, cable, _| stiff_torsion(cable), true),
    (|_, cable, _| untouched(cable), true),
    (|watch, cable, _| watch.layers.moment(cable), true),
    (|_, cable, _| slow_reel(cable), true),
    (|_, cable, _| free_eye(cable), true),
    (|_, cable, _| rough_obstacle(cable), true),
    (|watch, cable, error| watch.layers.kink(cable).filter(|_| error.is_none()), true),
    (Watch::green_strain, true),
    (|watch, cable, _| watch.contacts.facets(cable), true),
    (|watch, cable, _| watch.contacts.runs_over(cable), true),
    (|_, cable, _| Contacts::bounces(cable), true),
];

/// Layout: the bit of warnings about sizes.
const SIZES: u64 = 1 << 63;

impl Watch {
    /// Begins with a cable as it is: displacements are counted from there.
    pub fn new(cable: &Cable) -> Self {
        Watch { start: Some(cable.positions().to_vec()), ..Watch::default() }
    }

    /// Begins with a cable whose shape is a guess, as that of a cable before statics: its
    /// displacement says nothing.
    pub fn from_guess() -> Self {
        Watch::default()
    }

    /// Reads the cable at a host time, once at each.
    pub fn note(&mut self, cable: &Cable) {
        let before = self.noted.replace(cable.time());
        if before == Some(cable.time()) {
            return;
        }
        if !self.leaves_coarse {
            self.note_coarse(cable);
        }
        self.note_reels(cable, before.map_or(0.0, |before| cable.time() - before));
        let (share, tension, stiffness) = cable.largest_strain();
        if share > self.tension[0] {
            self.tension = [share, tension, stiffness, cable.time()];
        }
        self.note_torsion(cable);
        if cable.end_noise > self.noise.0 && cable.is_straight() {
            self.noise = (cable.end_noise, cable.time());
        }
        self.contacts.note(cable);
    }

    fn note_coarse(&mut self, cable: &Cable) {
        let shape = cable.mesh_indicator();
        self.position = self.position.max(shape.position);
        self.turn = self.turn.max(shape.turn);
        // a cable that was cut or has another mesh is another one
        if self.start.as_ref().is_some_and(|start| start.len() != cable.positions().len()) {
            self.start = None;
        }
        if let Some(Ok(motion)) = self.start.as_ref().map(|start| cable.motion_indicator(start)) {
            self.motion = self.motion.max(motion.error.min(shape.position));
            self.displacement = self.displacement.max(motion.displacement);
        }
        self.steps.note(cable);
        self.layers.note(cable);
    }

    /// Returns the warnings about what was noted. If an error of positions (m) is asked for, that
    /// is the limit of the mesh, and only of its indicator: a [study](crate::study) judges what
    /// nodes cannot, and chooses the steps.
    pub fn warnings(&self, cable: &Cable, error: Option<f64>) -> Vec<Warning> {
        let mut warnings: Vec<Warning> = LAWS.iter().filter_map(|(law, _)| law(self, cable, error)).collect();
        fold::sort(&mut warnings);
        warnings
    }

    /// Calls `tell` with each warning that is due and was not told yet, about sizes first; those
    /// that only a whole run can judge are left to [`warnings`](Self::warnings).
    pub fn raise(&mut self, cable: &Cable, tell: impl FnMut(Warning)) {
        self.told |= self.due(cable, self.told, tell);
    }

    /// Returns the laws that are due beyond those that are `known`, by bit, and calls `tell` with
    /// their warnings.
    fn due(&self, cable: &Cable, known: u64, mut tell: impl FnMut(Warning)) -> u64 {
        let mut new = 0;
        if known & SIZES == 0 {
            new |= SIZES;
            cable.size_warnings().for_each(&mut tell);
        }
        for (k, (law, always)) in LAWS.iter().enumerate() {
            let bit = 1 << k;
            if *always
                && known & bit == 0
                && let Some(warning) = law(self, cable, None)
            {
                new |= bit;
                tell(warning);
            }
        }
        new
    }

    fn strain(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let [share, tension_n, axial_stiffness_n, time_s] = self.tension;
        let cable_name = || cable.name().to_string();
        // a law of one's own is meant as it is, as far as it was measured, or the make bears it
        match &cable.effects().axial_law {
            None => (share > STRAIN).then(|| Warning::LargeStrain {
                cable: cable_name(),
                time_s,
                tension_n,
                axial_stiffness_n,
            }),
            Some(AxialLaw::Curve(rows)) => {
                let &[strain, force_n] = rows.last()?;
                (tension_n > force_n).then(|| Warning::BeyondCurve {
                    cable: cable_name(),
                    time_s,
                    tension_n,
                    strain,
                    force_n,
                })
            }
            Some(_) if share <= BREAKING || cable.strength() != Strength::default() => None,
            Some(_) => {
                let bears = cable.elements().iter().filter_map(|element| element.section.bears());
                let bears_n = bears.fold(f64::INFINITY, f64::min);
                (tension_n > bears_n).then(|| Warning::Overloaded { cable: cable_name(), time_s, tension_n, bears_n })
            }
        }
    }

    /// What is told of a strain that is not large.
    fn green_strain(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let [share, tension_n, axial_stiffness_n, time_s] = self.tension;
        let has_law = cable.effects().axial_law.is_some();
        let is_off = 0.0 < share && share <= STRAIN && less_elongation(share) > ELONGATION;
        let cable = || cable.name().to_string();
        (is_off && !has_law).then(|| Warning::GreenStrain { cable: cable(), time_s, tension_n, axial_stiffness_n })
    }

    fn mesh(&self, cable: &Cable, error: Option<f64>) -> Option<Warning> {
        let (elements, limit) = (cable.elements().len(), error.unwrap_or(ERROR * cable.length()));
        (self.position > limit).then(|| {
            let enough = more(elements, self.position / (0.5 * limit));
            Warning::CoarseMesh { cable: cable.name().to_string(), error_m: self.position, elements, enough }
        })
    }

    fn small_motion(&self, cable: &Cable, error: Option<f64>) -> Option<Warning> {
        let (elements, limit) = (cable.elements().len(), MOTION * self.displacement);
        let judged = error.is_none() && self.position <= ERROR * cable.length();
        // where a cable touches, its place is known to a share of the radius of contact
        let touches = !cable.snapshot.state.memory.contacts.is_empty();
        let radius = if touches { cable.contact_radius() } else { 0.0 };
        let least = (ROUNDING * cable.length()).max(DEPTH * radius);
        (judged && self.motion > limit && self.motion > least).then(|| {
            let enough = more(elements, self.motion / (0.5 * limit));
            let (cable, displacement_m) = (cable.name().to_string(), self.displacement);
            Warning::CoarseMotion { cable, error_m: self.motion, displacement_m, elements, enough }
        })
    }

    fn single_elements(&self, cable: &Cable, error: Option<f64>) -> Option<Warning> {
        (error.is_none() && self.turn > TURN).then(|| {
            // an arc of this angle, divided into k elements, has the indicator h turn^3/(96 k^4), h
            // its length
            let parts = (self.turn.powi(3) / (96.0 * 0.5 * ERROR)).powf(0.25).max(2.0);
            let elements = cable.elements().len();
            let enough = (elements as f64 * parts).ceil().clamp(4.0, MOST) as usize;
            Warning::CoarseElement { cable: cable.name().to_string(), turn_rad: self.turn, elements, enough }
        })
    }

    fn long_steps(&self, cable: &Cable, error: Option<f64>) -> Option<Warning> {
        let Estimate { error: error_m, time: time_s, step: step_s } = self.steps.worst;
        let limit = ERROR * cable.length();
        (error.is_none() && error_m > limit).then(|| {
            let enough_s = step_s * (0.5 * limit / error_m).sqrt();
            Warning::LongSteps { cable: cable.name().to_string(), time_s, error_m, step_s, enough_s }
        })
    }

    /// Reads the reels, a time in s after the last reading. One is fast if it is so while a
    /// transverse wave crosses the cable: on a rope that is slack for a moment none does. A string
    /// that leaves an eye faster than its waves carries both of them with it: at the eye it needs a
    /// direction beside the place, as beams have it that no moment acts on, and none comes from
    /// elsewhere.
    fn note_reels(&mut self, cable: &Cable, passed: f64) {
        let fastest = |a: (At, f64, f64), b: (At, f64, f64)| if b.1 > a.1 { b } else { a };
        let reels = [At::Start, At::End].into_iter().filter_map(|at| Some((at, cable.reel(at)?)));
        let reels = reels.map(|(at, reel)| (at, reel.speed_ratio, reel.rate));
        let (at, ratio, rate) = reels.fold((At::Start, 0.0, 0.0), fastest);
        let undirected = ratio > 1.0 && rate > 0.0 && cable.is_undirected(at);
        if !(ratio > REEL && (ratio.is_finite() || undirected)) {
            self.crossings = 0.0;
            return;
        }
        // without tension it is infinite
        let ratio = ratio.min(LARGEST_RATIO);
        let wave = rate.abs() / ratio + if undirected { rate } else { 0.0 };
        self.crossings += passed * wave / cable.length();
        if self.crossings >= 1.0 && ratio > self.reel.0 {
            self.reel = (ratio, cable.time());
            self.undirected |= undirected;
        }
    }

    fn fast_reel(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let ((ratio, time_s), undirected) = (self.reel, self.undirected);
        (ratio > REEL).then(|| Warning::FastReel { cable: cable.name().to_string(), time_s, ratio, undirected })
    }

    fn rounded_ends(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let ((noise_n, time_s), tension_n) = (self.noise, self.tension[1]);
        let cable = || cable.name().to_string();
        (noise_n > NOISE * tension_n).then(|| Warning::RoundedEnds { cable: cable(), time_s, noise_n, tension_n })
    }

    fn crossed(&self, cable: &Cable, _: Option<f64>) -> Option<Warning> {
        let steps = cable.diagnostics().crossed_steps;
        let first = || cable.passage.as_deref().cloned();
        (steps > 0).then(|| Warning::PassedThrough { cable: cable.name().to_string(), steps, first: first() })
    }
}

/// Whether nothing holds the end at which a reel pays out.
fn free_eye(cable: &Cable) -> Option<Warning> {
    let ends = [(At::Start, 0), (At::End, cable.nodes() - 1)];
    let reeled = ends.into_iter().filter(|(at, _)| {
        // wheels hold the others
        cable.reel_description(*at).is_some_and(|reel| matches!(reel.feed, Feed::Drum | Feed::Coil | Feed::Bag))
    });
    let is_free = |node: usize| cable.model.support(node).is_none_or(|support| !support.holds_position());
    let (at, _) = reeled.into_iter().find(|(_, node)| is_free(*node))?;
    let arc_length_m = if at == At::Start { 0.0 } else { cable.length() };
    Some(Warning::FreeEye { cable: cable.name().to_string(), arc_length_m })
}

/// Whether an obstacle has a coefficient of friction that no materials have, where the cable's own,
/// which is told as a size, is none.
fn rough_obstacle(cable: &Cable) -> Option<Warning> {
    let own = cable.effects().contact?;
    if sizes::friction(cable.name(), own.friction).is_some() {
        return None;
    }
    let friction = cable.obstacles().iter().map(|obstacle| obstacle.friction).fold(0.0, f64::max);
    sizes::friction(cable.name(), friction)
}

/// Whether a table of rates asks for more than its acceleration gives.
fn slow_reel(cable: &Cable) -> Option<Warning> {
    let reels = [At::Start, At::End].into_iter().filter_map(|at| cable.reel_description(at));
    reels.filter_map(|reel| Some((reel.acceleration, reel.shortfall()?))).next().map(|(acceleration, lengths)| {
        let [asked_m, given_m, rate_m_s] = lengths;
        Warning::SlowReel {
            cable: cable.name().to_string(),
            asked_m,
            given_m,
            rate_m_s,
            acceleration_m_s2: acceleration,
        }
    })
}

/// Whether steps were accepted that the tolerance refuses.
fn unresolved(cable: &Cable) -> Option<Warning> {
    let steps = cable.diagnostics().unresolved_steps;
    (steps > 0).then(|| Warning::NotResolved { cable: cable.name().to_string(), steps })
}

/// Whether a limit to the work cut steps short.
fn cut_short(cable: &Cable) -> Option<Warning> {
    let steps = cable.diagnostics().cut_steps;
    (steps > 0).then(|| Warning::CutShort { cable: cable.name().to_string(), steps })
}

/// Whether steps were accepted whose iteration had not come to its end.
fn unsolved(cable: &Cable) -> Option<Warning> {
    let steps = cable.diagnostics().unsolved_steps;
    let hidden_j = cable.energy_law().unsolved;
    (steps > 0).then(|| Warning::UnsolvedSteps { cable: cable.name().to_string(), steps, hidden_j })
}

/// Whether the load may have exceeded its limit between two integration steps.
fn unseen_load(cable: &Cable) -> Option<Warning> {
    let Unseen { time: time_s, shares: [share, reached], step: step_s } = cable.snapshot.load.unseen()?;
    Some(Warning::UnseenLoad { cable: cable.name().to_string(), time_s, share, reached, step_s })
}

/// Returns whether a part of a cable is one of a part of a part, by the number of
/// [breaks](crate::Break::breaks) that made it, and nothing damps it.
pub fn breaks_again(cable: &Cable, breaks: u32) -> Option<Warning> {
    let is_damped = cable.effects().damping.is_some_and(|damping| damping.axial > 0.0);
    (breaks >= BREAKS && !is_damped).then(|| Warning::BreaksAgain { cable: cable.name().to_string(), breaks })
}

impl Watch {
    fn energy(&self, own: &Cable, _: Option<f64>) -> Option<Warning> {
        let cable = || own.name().to_string();
        Some(match self.account.balance.verdict()? {
            Verdict::Made(time_s, made_j, scale_j) => {
                let discrete_gradient = own.integrator().method.uses_discrete_gradients();
                Warning::EnergyMade { cable: cable(), time_s, made_j, scale_j, discrete_gradient }
            }
            Verdict::Lost(time_s, lost_j, scale_j) => Warning::EnergyLost { cable: cable(), time_s, lost_j, scale_j },
        })
    }
}

fn untouched(cable: &Cable) -> Option<Warning> {
    let count = cable.obstacles().len();
    let name = || cable.name().to_string();
    (count > 0 && cable.effects().contact.is_none()).then(|| Warning::UntouchedObstacles { cable: name(), count })
}

impl Cable {
    /// Returns the warnings about the cable: those of all host steps since it is
    /// [watched](Self::set_watched); else those of its present shape and tension. Warnings about
    /// section and material are always among them. They are sorted by [`Level`].
    pub fn warnings(&self) -> Vec<Warning> {
        let noted = self.watch.as_deref().map(|watch| match watch.leaves_coarse {
            false => watch.warnings(self, None),
            true => {
                let mut watch = watch.clone();
                watch.note_coarse(self);
                watch.warnings(self, None)
            }
        });
        let noted = noted.unwrap_or_else(|| {
            let mut watch = Watch::from_guess();
            watch.note(self);
            watch.contacts.note_inside(self);
            watch.warnings(self, None)
        });
        let mut warnings: Vec<Warning> = self.size_warnings().chain(noted).collect();
        fold::sort(&mut warnings);
        warnings
    }

    /// Returns up to which level the cable is warned of by default: not of what is coarse with the
    /// steps of fidelity game, which is for a bounded cost and not for accuracy.
    pub fn warn_level(&self) -> Level {
        if self.integrator() == Fidelity::Game.integrator(f64::INFINITY) { Level::Wrong } else { Level::Coarse }
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn set_end_rounding(&mut self, rounding: f64, h: f64) {
        if rounding == 0.0 {
            self.end_noise = 0.0;
            return;
        }
        let compliance: f64 = self.elements().iter().map(|e| e.length / e.section.axial_stiffness).sum();
        let retardation = self.effects().damping.map_or(0.0, |damping| damping.axial);
        let force = rounding / compliance * (1.0 + retardation / h);
        self.end_noise = if force.is_finite() { force } else { 0.0 };
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn watch_up_to(&mut self, level: Level) {
        if let Some(watch) = &mut self.watch {
            watch.leaves_coarse = level < Level::Coarse;
        }
    }

    /// Returns whether neither a clamp nor bending stiffness gives the cable a direction at an end.
    fn is_undirected(&self, at: At) -> bool {
        let elements = self.elements();
        let (node, element) = if at == At::Start { (0, 0) } else { (self.nodes() - 1, elements.len() - 1) };
        let is_held = self.model.support(node).is_some_and(Support::holds_slope);
        elements[element].section.bending_stiffness == 0.0 && !is_held
    }

    /// Returns whether the cable is straight and taut.
    fn is_straight(&self) -> bool {
        let nodes = || (0..self.nodes()).map(|node| self.node_position(node));
        let length: f64 = nodes().zip(nodes().skip(1)).map(|(a, b)| (b - a).norm()).sum();
        let chord = (self.node_position(self.nodes() - 1) - self.node_position(0)).norm();
        chord > (1.0 - STRAIGHT) * length && chord > self.length()
    }

    /// Returns the warnings about sections and materials.
    fn size_warnings(&self) -> impl Iterator<Item = Warning> {
        let mut last = None;
        let other = move |element: &&crate::Element| last.replace(element.section) != Some(element.section);
        let sections = self.elements().iter().filter(other);
        let shapes = sections.flat_map(|element| sizes::warnings(self.name(), &element.section, self.length()));
        let (name, length) = (self.name(), self.length());
        // a reel pays out more than was drawn
        let drawn = self.model.drawn_length.filter(|_| !self.has_reel());
        let slack = drawn.and_then(|drawn| sizes::slack(name, length, drawn));
        let elements = || self.elements().iter();
        let thickness = |element: &crate::Element| element.section.diameter.unwrap_or(0.0) / element.length;
        let thickest = elements().max_by(|a, b| thickness(a).total_cmp(&thickness(b)));
        let thick = thickest.and_then(|e| sizes::elements(name, &e.section, length, e.length));
        // of a cable with a curve it is the same everywhere
        let stiffness = self.elements()[0].section.axial_stiffness;
        let (first, contact) = (&self.elements()[0].section, self.effects().contact.as_ref());
        let others = [
            sizes::strength(name, &self.strength(), first),
            sizes::contact_radius(name, contact, first, length),
            sizes::gravity(name, self.gravity().norm()),
            sizes::tolerance(name, self.integrator().control, length),
        ];
        let of_effects = sizes::of_effects(name, self.effects(), stiffness);
        shapes.chain(slack).chain(thick).chain(of_effects).chain(others.into_iter().flatten())
    }

    /// Lets the cable read itself after each of its host steps, or no longer:
    /// [`warnings`](Self::warnings) are then those of all of them, and
    /// [`Diagnostics::warnings`](crate::Diagnostics::warnings) counts them. Displacements are
    /// counted from now. Default: not, which costs nothing; a `CableSet` of lariat-rapier watches
    /// its cables, and reads how coarse they are where it tells of that.
    pub fn set_watched(&mut self, watched: bool) {
        self.watch = watched.then(|| {
            let mut watch = Watch::new(self);
            watch.account.note(self);
            Box::new(watch)
        });
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn is_watched(&self) -> bool {
        self.watch.is_some()
    }

    /// Reads the cable at the end of one of its own steps, if it is watched, and counts the
    /// warnings that are new.
    pub(crate) fn note_step(&mut self) {
        self.note_with(true);
    }

    fn note_with(&mut self, alone: bool) {
        let Some(mut watch) = self.watch.take() else { return };
        if watch.noted != Some(self.time()) {
            match alone {
                true => watch.account.note(self),
                false => watch.account.interrupt(),
            }
        }
        watch.note(self);
        let mut new = 0;
        watch.counted |= watch.due(self, watch.counted, |_| new += 1);
        self.diagnostics_mut().warnings += new;
        self.watch = Some(watch);
    }

    /// See [`Coupling`](crate::coupling::Coupling).
    pub(crate) fn note_host_step(&mut self, alone: bool, tell: impl FnMut(Warning)) {
        self.note_with(alone);
        if let Some(mut watch) = self.watch.take() {
            watch.raise(self, tell);
            self.watch = Some(watch);
        }
    }
}
