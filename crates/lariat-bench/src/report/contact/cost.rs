//! What contacts cost: a rope of 50 elements that touches a floor with all of its 201 samples, at rest, dragged, and falling on it.
//!
//! # Measures
//!
//! CPU time of a host step of 1/60 s, four steps of fidelity game: the mean of two seconds at rest and while it is dragged, and the longest in the two seconds in which it
//! falls 0.5 m. Each is the least of some runs; iterations of those two seconds are the same in each.

use crate::error::Error;
use crate::table::{Cell, Format, Table, shown};
use cpu_time::ProcessTime;
use lariat_ancf::contact::{HalfSpace, Obstacle};
use lariat_ancf::{At, Cable, Contact, Damping, Integrator, Method, Motion, Section, StepControl, Support, Vector3};

/// Radius of the rope in m, its length, and the number of its elements.
const RADIUS: f64 = 5e-3;
const LENGTH: f64 = 5.0;
const ELEMENTS: usize = 50;
/// Host steps that are measured, and runs.
const HOSTS: u32 = 120;
const RUNS: usize = 5;

/// How the rope begins.
#[derive(Clone, Copy)]
struct Start {
    name: &'static str,
    /// Height in m of its surface over the floor, and its tilt in rad.
    height: f64,
    tilt: f64,
    /// Speed in m/s with which its first node is dragged.
    drag: f64,
    /// Host steps before the measurement.
    before: u32,
}

const STARTS: [Start; 4] = [
    Start { name: "at rest", height: 0.0, tilt: 0.0, drag: 0.0, before: 60 },
    Start { name: "dragged at 0.5 m/s", height: 0.0, tilt: 0.0, drag: 0.5, before: 60 },
    Start { name: "falls flat", height: 0.5, tilt: 0.0, drag: 0.0, before: 0 },
    Start { name: "falls tilted by 0.1 rad", height: 0.5, tilt: 0.1, drag: 0.0, before: 0 },
];

impl Start {
    fn cable(self) -> Result<Cable, Error> {
        let first = Vector3::y() * (RADIUS + self.height);
        let along = Vector3::new(self.tilt.cos(), self.tilt.sin(), 0.0);
        let game = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(1.0 / 240.0) };
        let mut cable = Cable::builder()
            .points([first, first + along * LENGTH])
            .section(Section::from_stiffness(1e6, 0.1, 0.14)?)
            .elements(ELEMENTS)
            .rule("projected-T1".parse()?)
            .damping(Damping { axial: 1e-3, bending: 1e-3 })
            .gravity(Vector3::new(0.0, -9.81, 0.0))
            .integrator(game)
            .build()?;
        if self.drag > 0.0 {
            let motion = Motion::uniform(0.0, first, Vector3::new(-0.8, 0.0, 0.6) * self.drag);
            cable.set_support(At::Start, Support { position: Some(motion), ..Support::default() })?;
        }
        cable.set_contact(Contact::with_friction(0.3).with_radius(RADIUS))?;
        cable.set_obstacles(vec![Obstacle::new(1, HalfSpace { normal: Vector3::y() }, Vector3::zeros(), 0.3)])?;
        Ok(cable)
    }

    /// Runs it; returns the mean and the longest time of a host step in s, and the number of iterations, of which the most in one host step.
    fn run(self) -> Result<([f64; 2], [u64; 2], usize), Error> {
        let mut cable = self.cable()?;
        for _ in 0..self.before {
            cable.step(1.0 / 60.0)?;
        }
        let (mut times, mut iterations, mut contacts) = ([0.0, 0.0f64], [0; 2], 0);
        for _ in 0..HOSTS {
            let before = cable.diagnostics().newton_iterations;
            let clock = ProcessTime::now();
            cable.step(1.0 / 60.0)?;
            let spent = clock.elapsed().as_secs_f64();
            let taken = cable.diagnostics().newton_iterations - before;
            times = [times[0] + spent / f64::from(HOSTS), times[1].max(spent)];
            iterations = [iterations[0] + taken, iterations[1].max(taken)];
            contacts = contacts.max(cable.contacts().count());
        }
        Ok((times, iterations, contacts))
    }
}

/// Measures the table.
///
/// # Errors
/// [`Error::Mechanics`] if a run fails.
pub fn table() -> Result<Table, Error> {
    let columns = vec![
        shown("start", "rope of 50 elements on a floor", Format::Plain),
        shown("contacts", "most contacts", Format::Plain),
        shown("iterations", "iterations per host step", Format::Short),
        shown("most_iterations", "most of them", Format::Plain),
        shown("mean_us", "us per host step", Format::Short),
        shown("longest_us", "longest, us", Format::Short),
    ];
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for start in STARTS {
        let (mut least, mut counts, mut contacts) = ([f64::INFINITY; 2], [0; 2], 0);
        for _ in 0..RUNS {
            let (times, iterations, most) = start.run()?;
            (least, counts, contacts) = ([0, 1].map(|k| least[k].min(times[k])), iterations, most);
        }
        rows.push(vec![
            start.name.into(),
            contacts.into(),
            (counts[0] as f64 / f64::from(HOSTS)).into(),
            counts[1].into(),
            (1e6 * least[0]).into(),
            (1e6 * least[1]).into(),
        ]);
    }
    Ok(Table { name: "contact_cost", columns, rows })
}
