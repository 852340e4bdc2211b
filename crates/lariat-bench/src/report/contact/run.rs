//! A scene of assets/contact that runs, and what is read from it.

use crate::error::Error;
use crate::numbers::largest;
use cpu_time::ProcessTime;
use lariat_ancf::{Cable, Vector3};
use lariat_scene::run::World;
use lariat_scene::scene::{Purpose, Scene};
use std::path::Path;

/// Times in s between which loads over a drum accelerate steadily.
const STEADY: [f64; 2] = [0.3, 0.6];

/// A scene that runs.
pub(super) struct Run {
    pub world: World,
    pub dt: f64,
    pub steps: u32,
    /// Largest depth of a contact at a host time in m, and largest growth of the energy from the start in J.
    pub deepest: f64,
    pub made: f64,
    pub start: f64,
    /// CPU time of all host steps, and of the longest, in s.
    pub seconds: f64,
    pub longest: f64,
}

impl Run {
    /// Starts a scene of assets/contact with other values (`key=value`).
    pub fn start(name: &str, overrides: &[String]) -> Result<Run, Error> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/contact/{name}.toml"));
        let scene = Scene::read(&path, overrides, Purpose::Run)?;
        let mut world = World::build(&scene)?;
        world.start(Purpose::Run)?;
        let start = world.energy(None).total();
        Ok(Run { world, dt: scene.dt, steps: 0, deepest: 0.0, made: 0.0, start, seconds: 0.0, longest: 0.0 })
    }

    pub fn time(&self) -> f64 {
        f64::from(self.steps) * self.dt
    }

    /// Advances to a time in s, and calls `note` after each host step.
    pub fn advance(&mut self, time: f64, mut note: impl FnMut(&Run)) -> Result<(), Error> {
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

    pub fn rope(&self) -> &Cable {
        self.world.cables()[0]
    }

    /// Returns the position of a body in m.
    pub fn body(&self, body: usize) -> Vector3<f64> {
        self.world.body(body).map_or(Vector3::from_element(f64::NAN), |body| body.position)
    }

    /// Returns the velocity of the rope's centre of mass in m/s.
    pub fn velocity(&self) -> Vector3<f64> {
        let mass = |e: &lariat_ancf::Element| e.section.mass_per_length * e.length;
        self.rope().momentum().linear / self.rope().elements().iter().map(mass).sum::<f64>()
    }

    /// Returns the largest speed of a node in m/s.
    pub fn fastest(&self) -> f64 {
        self.rope().velocities().chunks_exact(6).map(|v| v[0].hypot(v[1]).hypot(v[2])).fold(0.0, largest)
    }

    /// Returns the acceleration in m/s^2 of a body downwards between the times of [`STEADY`]: the slope of the line through its speeds, in which it
    /// also vibrates on the rope, by least squares.
    pub fn fall(&mut self, body: usize) -> Result<f64, Error> {
        let [from, to] = STEADY;
        let (mut product, mut square) = (0.0, 0.0);
        self.advance(from, |_| ())?;
        self.advance(to, |run| {
            let time = run.time() - 0.5 * (from + to + run.dt);
            product += time * run.world.body(body).map_or(f64::NAN, |body| -body.velocity.y);
            square += time * time;
        })?;
        Ok(product / square)
    }
}
