//! Cables that touch: the scenes of assets/contact against friction laws, rigid bodies and the energy law.
//!
//! # Measures
//!
//! *Exact* values are formulas: the tensions on both sides of a drum differ by `exp(mu angle)` (Euler, Eytelwein); loads over a drum
//! accelerate with `(m1 - m2) g/(m1 + m2 + m_rope + I/(R + r)^2)`; on a slope of angle a a rope stays if `tan a <= mu`, else it
//! slides with `g (sin a - mu cos a)`. *Bounds* without an exact value are what contact must keep: depths as shares of the
//! rope's radius, energy made as a share of that at the start.

use super::options::Options;
use crate::error::Error;
use crate::numbers::largest;
use crate::page::Section;
use crate::table::{Cell, Format, Table, hidden, shown};
use cpu_time::ProcessTime;
use lariat_ancf::{Cable, Vector3};
use lariat_scene::run::World;
use lariat_scene::scene::{Purpose, Scene};
use std::path::Path;

/// Standard gravity in m/s^2, as in scenes.
const G: f64 = 9.80665;
/// Distance in m of the rope's centre line from the axis of the drum, and the mass of the rope in kg in the scenes with two loads.
const LEVER: f64 = 0.105;
const ROPE: f64 = 0.0153;
/// Times in s between which loads over a drum accelerate steadily.
const STEADY: [f64; 2] = [0.3, 0.6];

/// A scene that runs.
pub struct Run {
    world: World,
    dt: f64,
    steps: u32,
    /// Largest depth of a contact at a host time in m, and largest growth of the energy from the start in J.
    deepest: f64,
    made: f64,
    start: f64,
    /// CPU time of all host steps, and of the longest, in s.
    seconds: f64,
    longest: f64,
}

impl Run {
    /// Starts a scene of assets/contact with other values (`key=value`).
    fn start(name: &str, overrides: &[String]) -> Result<Run, Error> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/contact/{name}.toml"));
        let scene = Scene::read(&path, overrides, Purpose::Run)?;
        let mut world = World::build(&scene)?;
        world.start(Purpose::Run)?;
        let start = world.energy(None).total();
        Ok(Run { world, dt: scene.dt, steps: 0, deepest: 0.0, made: 0.0, start, seconds: 0.0, longest: 0.0 })
    }

    fn time(&self) -> f64 {
        f64::from(self.steps) * self.dt
    }

    /// Advances to a time in s, and calls `note` after each host step.
    fn advance(&mut self, time: f64, mut note: impl FnMut(&Run)) -> Result<(), Error> {
        while self.time() < time - 0.5 * self.dt {
            self.steps += 1;
            let clock = ProcessTime::now();
            self.world.advance(self.time())?;
            let spent = clock.elapsed().as_secs_f64();
            self.seconds += spent;
            self.longest = self.longest.max(spent);
            let depths = self.world.cables().into_iter().flat_map(|cable| cable.contacts()).map(|touch| touch.depth);
            self.deepest = depths.fold(self.deepest, largest);
            self.made = largest(self.made, self.world.energy(None).total() - self.start);
            note(self);
        }
        Ok(())
    }

    fn rope(&self) -> &Cable {
        self.world.cables()[0]
    }

    /// Returns the velocity of the rope's centre of mass in m/s.
    fn velocity(&self) -> Vector3<f64> {
        let mass = |e: &lariat_ancf::Element| e.section.mass_per_length * e.length;
        self.rope().momentum().linear / self.rope().elements().iter().map(mass).sum::<f64>()
    }

    /// Returns the largest speed of a node in m/s.
    fn fastest(&self) -> f64 {
        self.rope().velocities().chunks_exact(6).map(|v| v[0].hypot(v[1]).hypot(v[2])).fold(0.0, largest)
    }

    /// Returns the acceleration in m/s^2 of a body downwards between the times of [`STEADY`].
    fn fall(&mut self, body: usize) -> Result<f64, Error> {
        let mut speeds = [0.0; 2];
        for (speed, time) in speeds.iter_mut().zip(STEADY) {
            self.advance(time, |_| ())?;
            *speed = self.world.body(body).map_or(f64::NAN, |body| -body.velocity.y);
        }
        Ok((speeds[1] - speeds[0]) / (STEADY[1] - STEADY[0]))
    }
}

/// What is measured of a scene.
pub struct Case {
    /// Name of the file in assets/contact.
    pub scene: &'static str,
    /// What is measured, with its unit.
    pub quantity: &'static str,
    /// What is changed in the scene: in words, and `key=value`.
    changed: String,
    overrides: Vec<String>,
    /// What it must be, if there is a formula.
    exact: Option<f64>,
    /// Largest deviation from it as a share; without, the largest value.
    bound: f64,
    measure: fn(&mut Run) -> Result<f64, Error>,
}

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Scene and quantity.
    pub name: String,
    /// What was measured.
    pub value: f64,
    /// Deviation from the exact value as a share, or the value itself.
    pub deviation: f64,
    /// Its bound.
    pub bound: f64,
    exact: Option<f64>,
    mean: f64,
    longest: f64,
}

fn tension_over_weight(run: &mut Run) -> Result<f64, Error> {
    let (mut sum, mut count) = (0.0, 0.0);
    run.advance(3.0, |run| {
        if run.time() > 1.5 {
            sum += run.rope().sample(run.rope().length()).map_or(f64::NAN, |place| place.tension);
            count += 1.0;
        }
    })?;
    Ok(sum / count / (5.0 * G))
}

fn speed_of_rope(run: &mut Run) -> Result<f64, Error> {
    run.advance(1.5, |_| ())?;
    Ok(run.velocity().x)
}

fn slide(run: &mut Run) -> Result<f64, Error> {
    run.advance(0.1, |_| ())?;
    let before = run.velocity().norm();
    run.advance(0.5, |_| ())?;
    Ok((run.velocity().norm() - before) / 0.4)
}

fn creep(run: &mut Run) -> Result<f64, Error> {
    run.advance(1.0, |_| ())?;
    let before = run.rope().positions().to_vec();
    run.advance(61.0, |_| ())?;
    let moved = run.rope().positions().iter().zip(&before).map(|(now, before)| (now - before).abs());
    Ok(moved.fold(0.0, largest))
}

fn depth(run: &mut Run) -> Result<f64, Error> {
    run.advance(2.0, |_| ())?;
    let radius = run.rope().effects().contact.and_then(|contact| contact.radius).unwrap_or(f64::NAN);
    Ok(run.deepest / radius)
}

fn speed_after_two_seconds(run: &mut Run) -> Result<f64, Error> {
    run.advance(2.0, |_| ())?;
    Ok(run.fastest())
}

fn made(run: &mut Run) -> Result<f64, Error> {
    run.advance(1.25, |_| ())?;
    Ok(run.made / run.start.abs())
}

fn speed_after_a_second(run: &mut Run) -> Result<f64, Error> {
    run.advance(1.25, |_| ())?;
    Ok(run.fastest())
}

/// The largest x that a place of the rope reached, beyond where it touches the wall.
fn beyond_the_wall(run: &mut Run) -> Result<f64, Error> {
    let mut farthest = f64::NEG_INFINITY;
    run.advance(0.5, |run| {
        let rope = run.rope();
        let places = (0..=200).filter_map(|k| rope.sample(rope.length() * f64::from(k) / 200.0).ok());
        farthest = places.map(|place| place.position.x).fold(farthest, largest);
    })?;
    Ok((farthest - (1.0 - 0.0005 - 0.005)) / 0.005)
}

/// Returns the cases.
pub fn cases() -> Vec<Case> {
    let atwood = |inertia: f64| G / (5.0 + ROPE + inertia / (LEVER * LEVER));
    let case = |scene, quantity, exact, bound, measure| {
        let (changed, overrides) = (String::new(), Vec::new());
        Case { scene, quantity, changed, overrides, exact, bound, measure }
    };
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let mut cases = Vec::new();
    for mu in [0.1, 0.3, 0.5] {
        let exact = Some((mu * std::f64::consts::PI).exp());
        let capstan = case("capstan", "tension over the weight", exact, 0.05, tension_over_weight);
        let overrides = vec![format!("body.drum.friction={mu}"), format!("cable.rope.contact.friction={mu}")];
        cases.push(Case { changed: format!(", friction {mu}"), overrides, ..capstan });
    }
    cases.push(case("atwood", "acceleration, m/s^2", Some(atwood(0.0)), 0.01, |run| run.fall(1)));
    cases.push(case("free_drum", "acceleration, m/s^2", Some(atwood(0.02)), 0.02, |run| run.fall(1)));
    cases.push(case("conveyor", "speed of the rope, m/s", Some(1.0), 0.01, speed_of_rope));
    cases.push(case("slide", "acceleration, m/s^2", Some(G * (sin - 0.3 * cos)), 0.01, slide));
    cases.push(case("stick", "creep in 60 s, m", None, 1e-6, creep));
    cases.push(case("cylinder", "depth, share of the radius", None, 0.05, depth));
    cases.push(case("cylinder", "speed after 2 s, m/s", None, 1e-3, speed_after_two_seconds));
    cases.push(case("drop", "energy made, share of the first", None, 1e-6, made));
    cases.push(case("drop", "speed a second after it lands, m/s", None, 1e-3, speed_after_a_second));
    for speed in [10.0, 100.0, 200.0] {
        let wall = case("wall", "way into the wall, share of the radius", None, 1.0, beyond_the_wall);
        let overrides = vec![format!("cable.rope.velocity=[{speed:?}, 0.0, 0.0]")];
        cases.push(Case { changed: format!(" at {speed} m/s"), overrides, ..wall });
    }
    cases.push(case("catch", "depth, share of the radius", None, 0.1, depth));
    cases.push(case("catch", "energy made, share of the first", None, 1e-6, made));
    cases
}

impl Case {
    /// Runs it.
    ///
    /// # Errors
    /// [`Error::Scene`], [`Error::Mechanics`] if the run fails.
    pub fn run(&self) -> Result<Outcome, Error> {
        let mut run = Run::start(self.scene, &self.overrides)?;
        let value = (self.measure)(&mut run)?;
        let deviation = self.exact.map_or(value, |exact| (value / exact - 1.0).abs());
        let name = format!("{}{}: {}", self.scene, self.changed, self.quantity);
        let mean = run.seconds / f64::from(run.steps);
        Ok(Outcome { name, value, deviation, bound: self.bound, exact: self.exact, mean, longest: run.longest })
    }
}

/// Title of the section.
pub const TITLE: &str = "Cables that touch";

/// Measures the section.
///
/// # Errors
/// As [`Case::run`].
pub fn section(_: &Options) -> Result<Section, Error> {
    let columns = vec![
        shown("case", "scene: quantity", Format::Plain),
        shown("value", "value", Format::Short),
        shown("exact", "exact", Format::Short),
        shown("deviation", "deviation", Format::Scientific(1)),
        shown("bound", "bound", Format::Scientific(0)),
        shown("mean_us", "us per host step", Format::Short),
        hidden("longest_us"),
    ];
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for case in cases() {
        let outcome = case.run()?;
        rows.push(vec![
            outcome.name.into(),
            outcome.value.into(),
            outcome.exact.into(),
            outcome.deviation.into(),
            outcome.bound.into(),
            (1e6 * outcome.mean).into(),
            (1e6 * outcome.longest).into(),
        ]);
    }
    let mut section = Section::new(TITLE);
    section.text(
        "The scenes of `assets/contact` in fidelity game, host steps of 1/60 s. *Deviation* is that from the exact value as a share; without \
         one, the value itself. Tension over the weight is a mean of 1.5 s while the rope slips over the drum. CPU time is that of the whole \
         scene with Rapier; the file has that of the longest host step, too.",
    );
    section.table(Table { name: "contact", columns, rows });
    Ok(section)
}
