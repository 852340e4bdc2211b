//! The errors of the scenes of assets/scenes: of their mesh and in time, as they are, and what it costs to ask for an error.
//!
//! Errors are largest distances of 33 points per cable and of the dynamic bodies at all host times, as `lariat run --error` has them.
//!
//! - *As it is.* The error in time is the distance of the scene from a run with the same mesh and error control at a quarter of the
//!   tolerance that a study would begin with for 1e-4 m; the error of the mesh is that of this run from one with twice the elements.
//! - *Asked for.* The true error is the distance from a run with twice the elements of the finest study and a quarter of its tolerance. The
//!   cheapest setting is that with the fewest element evaluations whose true error is below the one that is asked for, among numbers of
//!   elements and decades of tolerance: it is known only after the fact.
//!
//! Costs are element evaluations, which are the same on every machine.

use super::options::Options;
use crate::error::Error;
use crate::page::Section;
use crate::table::{Cell, Format, Table, hidden, shown};
use lariat_ancf::study::Resolution;
use lariat_ancf::{Integrator, Method};
use lariat_scene::run::{self, World};
use lariat_scene::scene::{Purpose, Scene};

/// A scene, and for how long in s it is run; `None` for its equilibrium.
type Case = (&'static str, &'static str, Option<f64>);

macro_rules! scene {
    ($name:literal) => {
        include_str!(concat!("../../../../assets/scenes/", $name, ".toml"))
    };
}

/// The scenes; those with long and stiff transients are cut short.
const SCENES: [Case; 15] = [
    ("falling_pendulum", scene!("falling_pendulum"), Some(2.0)),
    ("catenary", scene!("catenary"), None),
    ("elastica", scene!("elastica"), None),
    ("cantilever", scene!("cantilever"), None),
    ("cable_stayed", scene!("cable_stayed"), None),
    ("bridge", scene!("bridge"), None),
    ("cantilever", scene!("cantilever"), Some(1.0)),
    ("payload_pendulum", scene!("payload_pendulum"), Some(0.5)),
    ("towed_line", scene!("towed_line"), Some(2.0)),
    ("dumbbell", scene!("dumbbell"), Some(1.0)),
    ("hoist", scene!("hoist"), Some(1.0)),
    ("slung_load", scene!("slung_load"), Some(1.0)),
    ("tether_multibody", scene!("tether_multibody"), Some(0.5)),
    ("cable_stayed", scene!("cable_stayed"), Some(0.2)),
    ("elastica", scene!("elastica"), Some(1.0)),
];

/// Errors that are asked for, in m.
const ASKED: [f64; 3] = [1e-2, 1e-3, 1e-4];
/// Numbers of elements and tolerances (m) that the cheapest setting is looked for in.
const MESHES: [usize; 9] = [3, 4, 6, 8, 12, 16, 24, 32, 48];
const TOLERANCES: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
/// Points per cable.
const POINTS: usize = 33;

/// Positions of a run at all host times in m, and its element evaluations.
struct Trace {
    frames: Vec<Vec<[f64; 3]>>,
    evaluations: u64,
}

impl Trace {
    /// Runs a scene.
    fn of(scene: &Scene, purpose: Purpose) -> Result<Self, Error> {
        let mut world = World::build(scene)?;
        world.start(purpose)?;
        let mut frames = vec![places(&world)?];
        if purpose == Purpose::Run {
            let steps = (scene.duration / scene.dt - 1e-9).ceil() as usize;
            for step in 1..=steps {
                world.advance((step as f64 * scene.dt).min(scene.duration))?;
                frames.push(places(&world)?);
            }
        }
        let evaluations = world.cables().iter().map(|cable| cable.diagnostics().element_evaluations()).sum();
        Ok(Trace { frames, evaluations })
    }

    /// Returns the largest distance from another run of the scene in m.
    fn distance(&self, other: &Trace) -> f64 {
        let pairs = self.frames.iter().zip(&other.frames).flat_map(|(a, b)| a.iter().zip(b));
        let square = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
        pairs.map(square).fold(0.0, |largest: f64, x| if x.is_nan() { f64::NAN } else { largest.max(x) }).sqrt()
    }
}

fn places(world: &World) -> Result<Vec<[f64; 3]>, Error> {
    let mut places = Vec::new();
    for cable in world.cables() {
        for k in 0..POINTS {
            let sample = cable.sample(cable.length() * k as f64 / (POINTS - 1) as f64).map_err(Error::from)?;
            places.push(sample.position.into());
        }
    }
    places.extend(
        (0..world.scene().bodies.len()).filter_map(|i| world.body(i)).map(|body| <[f64; 3]>::from(body.position)),
    );
    Ok(places)
}

/// A scene with another mesh, and for a motion another integrator.
fn at(scene: &Scene, resolution: &Resolution) -> Scene {
    let mut scene = scene.clone();
    let largest = scene.cables.iter().map(|cable| cable.elements).max().unwrap_or(1);
    for cable in &mut scene.cables {
        cable.elements = resolution.elements_of(cable.elements, largest);
        if resolution.tolerance.is_some() {
            cable.integrator = resolution.integrator().into();
        }
    }
    scene
}

struct Study {
    name: String,
    scene: Scene,
    purpose: Purpose,
}

impl Study {
    fn read((name, text, duration): &Case) -> Result<Self, Error> {
        let purpose = duration.map_or(Purpose::Static, |_| Purpose::Run);
        let overrides: Vec<String> = duration.iter().map(|duration| format!("duration={duration:?}")).collect();
        let scene = Scene::parse(name, text, &overrides, purpose)?;
        let name = duration.map_or(format!("{name}, static"), |duration| format!("{name}, {duration} s"));
        Ok(Study { name, scene, purpose })
    }

    /// Returns the tolerance in m that a study for an error begins with.
    fn tolerance(&self, error: f64) -> Option<f64> {
        let share = self.scene.dt / (4.0 * self.scene.duration);
        (self.purpose == Purpose::Run).then_some(error * share)
    }

    fn largest(&self) -> usize {
        self.scene.cables.iter().map(|cable| cable.elements).max().unwrap_or(1)
    }

    fn trace(&self, elements: usize, tolerance: Option<f64>) -> Result<Trace, Error> {
        Trace::of(&at(&self.scene, &Resolution { elements, tolerance, ..Resolution::default() }), self.purpose)
    }

    /// Returns the row of the scene as it is.
    fn as_it_is(&self) -> Result<Vec<Cell>, Error> {
        let own = Trace::of(&self.scene, self.purpose)?;
        let tight = self.tolerance(1e-4).map(|tolerance| tolerance / 4.0);
        let mut doubled = self.scene.clone();
        doubled.cables.iter_mut().for_each(|cable| cable.elements *= 2);
        let mut exact = self.scene.clone();
        if let Some(tolerance) = tight {
            let integrator = Integrator::tolerance(Method::Esdirk4, tolerance).map_err(Error::from)?;
            for cable in exact.cables.iter_mut().chain(&mut doubled.cables) {
                cable.integrator = integrator.into();
            }
        }
        let (exact, doubled) = (Trace::of(&exact, self.purpose)?, Trace::of(&doubled, self.purpose)?);
        let time = tight.map(|_| own.distance(&exact));
        let warnings = run::collect(&self.scene, self.purpose, &mut run::Options::default())?.summary.warnings.len();
        Ok(vec![
            self.name.clone().into(),
            self.largest().into(),
            exact.distance(&doubled).into(),
            time.into(),
            own.evaluations.into(),
            warnings.into(),
        ])
    }

    /// Returns the rows of the errors that are asked for.
    fn asked(&self, errors: &[f64]) -> Result<Vec<Vec<Cell>>, Error> {
        let mut rows = Vec::new();
        let mut studies = Vec::new();
        for &error in errors {
            let mut options = run::Options { error: Some(error.into()), ..run::Options::default() };
            match run::collect(&self.scene, self.purpose, &mut options) {
                Ok(recording) => match recording.summary.error {
                    Some(claim) => studies.push((error, claim.claim, recording.summary.element_evaluations)),
                    None => rows.push(self.failed(error, recording.summary.failed.unwrap_or_default())),
                },
                Err(refused) => rows.push(self.failed(error, refused.to_string())),
            }
        }
        let Some(finest) = studies.iter().map(|(_, claim, _)| claim.elements).max() else { return Ok(rows) };
        let tightest = studies.iter().filter_map(|(_, claim, _)| claim.tolerance_m).reduce(f64::min);
        let most = studies.iter().map(|(.., evaluations)| *evaluations).max().unwrap_or(0);
        let reference = self.trace(2 * finest, tightest.map(|tolerance| tolerance / 4.0))?;
        let settings = self.settings(finest, most, &reference);
        for (error, claim, evaluations) in studies {
            let there = self.trace(claim.elements, claim.tolerance_m)?;
            let cheapest = settings.iter().filter(|s| s.error <= error).min_by_key(|s| s.evaluations);
            let all = claim.cost * evaluations as f64;
            rows.push(vec![
                self.name.clone().into(),
                error.into(),
                claim.claimed_m.into(),
                there.distance(&reference).into(),
                claim.mesh_m.into(),
                claim.time_m.into(),
                claim.elements.into(),
                claim.tolerance_m.into(),
                evaluations.into(),
                claim.cost.into(),
                cheapest.map(|s| s.elements).into(),
                cheapest.and_then(|s| s.tolerance).into(),
                cheapest.map(|s| s.evaluations).into(),
                cheapest.map(|s| all / s.evaluations.max(1) as f64).into(),
                claim.horizon_s.map_or(String::new(), |time| format!("proven up to {time:.2} s")).into(),
            ]);
        }
        Ok(rows)
    }

    fn failed(&self, error: f64, why: String) -> Vec<Cell> {
        let mut row: Vec<Cell> = vec![self.name.clone().into(), error.into()];
        row.extend(vec![Cell::Empty; COLUMNS - 3]);
        row.push(why.into());
        row
    }

    /// Returns all settings up to a number of elements that cost no more than `most` evaluations.
    fn settings(&self, finest: usize, most: u64, reference: &Trace) -> Vec<Setting> {
        let mut settings = Vec::new();
        for elements in MESHES.into_iter().filter(|n| *n <= finest) {
            let tolerances: Vec<Option<f64>> = match self.purpose {
                Purpose::Run | Purpose::Resume => TOLERANCES.into_iter().map(Some).collect(),
                Purpose::Static => vec![None],
            };
            for tolerance in tolerances {
                // a setting that fails is none
                let Ok(trace) = self.trace(elements, tolerance) else { continue };
                if trace.evaluations > most {
                    break;
                }
                let (error, evaluations) = (trace.distance(reference), trace.evaluations);
                settings.push(Setting { elements, tolerance, error, evaluations });
            }
        }
        settings
    }
}

/// A setting that was searched.
struct Setting {
    elements: usize,
    tolerance: Option<f64>,
    error: f64,
    evaluations: u64,
}

/// Columns of the table of errors that are asked for.
const COLUMNS: usize = 15;

/// Title of the section.
pub const TITLE: &str = "Errors of the scenes, and what it costs to ask for one";

/// Measures the section.
///
/// # Errors
/// [`Error::Scene`]; not for an error that is refused or not proven, which is a row.
pub fn section(options: &Options) -> Result<Section, Error> {
    let (mut own, mut asked) = (Vec::new(), Vec::new());
    for case in options.rungs(&SCENES) {
        let case = Study::read(case)?;
        own.push(case.as_it_is()?);
        asked.extend(case.asked(options.rungs(&ASKED))?);
    }
    let mut section = Section::new(TITLE);
    section.text(
        "The scenes of assets/scenes, some cut short, as they are: the largest error of 33 points per cable and of the bodies at all host times, \
         of the mesh (against twice the elements) and in time (against error control at a tight tolerance) apart.",
    );
    let (n, e1) = (Format::Plain, Format::Scientific(1));
    let columns = vec![
        shown("scene", "scene", n),
        shown("elements", "elements", n),
        shown("mesh_m", "error of the mesh m", e1),
        shown("time_m", "error in time m", e1),
        shown("element_evaluations", "element evaluations", n),
        shown("warnings", "warnings", n),
    ];
    section.table(Table { name: "scene_errors", columns, rows: own });
    section.text(
        "With `--error`: what is claimed, what is true (against twice the elements and a quarter of the tolerance), and the cost in element \
         evaluations, of the last run and of all runs over that. *Cheapest* is the setting with the fewest evaluations that reaches the error, \
         found by search when the true error is known; *over it* is the cost of all runs of the study over that of this one run.",
    );
    let columns = vec![
        shown("scene", "scene", n),
        shown("asked_m", "asked m", Format::Scientific(0)),
        shown("claimed_m", "claimed m", e1),
        shown("true_m", "true m", e1),
        hidden("mesh_m"),
        hidden("time_m"),
        shown("elements", "elements", n),
        shown("tolerance_m", "tolerance m", e1),
        shown("element_evaluations", "evaluations", n),
        shown("all_over_last", "all over last", Format::Fixed(1)),
        shown("cheapest_elements", "cheapest", n),
        shown("cheapest_tolerance_m", "its tolerance m", Format::Scientific(0)),
        shown("cheapest_evaluations", "its evaluations", n),
        shown("all_over_cheapest", "over it", Format::Fixed(1)),
        shown("note", "note", n),
    ];
    section.table(Table { name: "claims", columns, rows: asked });
    Ok(section)
}
