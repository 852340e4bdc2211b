//! `view.html`: the run as an animated page that opens from disk, without network.
//!
//! The page contains its data and its program. Cables are drawn as the cubics of their elements: a frame has position, slope and
//! tension at each node and the tension in the middle of each element; along one with torsion runs a stripe, by which its twist is
//! seen. Bodies have position and rotation, loads and the forces of contacts are arrows. Probes
//! are plotted from the rows of their files. Nothing is interpolated in time: every picture is a state of the run.
//!
//! # Limits
//!
//! There is a frame for each host step, at most [`FRAMES`]: when this number is reached, every other frame is dropped and from then
//! on every other step recorded, and so on. A long run has 300 to 600 evenly spaced frames and the last state, and fewer where the
//! page would have more than [`NUMBERS`] numbers. A cable of more than [`NODES`] nodes is sampled at this many points. Probes are
//! decimated in the same way to at most [`ROWS`] rows; their files have all rows.
//!
//! # Cost
//!
//! [`Summary::cpu_s`](crate::run::Summary::cpu_s) and its wall time do not include the recording of frames. Frames are kept in
//! memory and written when the run ends, whether it fails or not.
//!
//! # Alternatives considered
//!
//! The scene is painted from far to near on a 2D canvas. WebGL, and three.js on it, was rejected: it is missing on many remote
//! desktops and virtual machines, and three.js 0.187 has 2.1 MB, this page 50 kB. Where large surfaces cross, painting by depth
//! shows the wrong one in front for a few pixels. The plots are by uPlot (MIT, `assets/uplot`).

mod cast;
mod decimator;
mod film;
mod frame;
mod page;
mod shape;
mod svg;
mod usd;

pub use film::{Film, Series};
pub use shape::capsule;

use crate::error::Error;
use crate::run::{Summary, World};
use crate::scene::{Engine, Scene};
use cast::Cast;
use cpu_time::ProcessTime;
use decimator::Decimator;
use frame::Frame;
use std::time::{Duration, Instant};

/// Largest number of frames of a page.
pub const FRAMES: usize = 600;
/// Largest number of numbers in the frames of a page, 4 bytes each: 11 MB of text.
pub const NUMBERS: usize = 2_000_000;
/// Largest number of nodes of a cable in a frame.
pub const NODES: usize = 201;
/// Numbers of a node: arc length, position, slope, tension there and halfway to the next.
const NODE: usize = 9;
/// Numbers of a stripe at a node.
const STRIPE: usize = 4;
/// Largest number of rows of a probe in a page.
pub const ROWS: usize = 2000;

/// Records a run for its page.
pub struct Recorder {
    frames: Decimator<Frame>,
    probes: Vec<Decimator<Vec<f64>>>,
    cpu: Duration,
    wall: Duration,
}

impl Recorder {
    /// Returns an empty recorder.
    pub fn new(scene: &Scene) -> Self {
        let of_node = if cast::is_twisted(scene) { NODE + STRIPE } else { NODE };
        let nodes: usize = scene.cables.iter().map(|cable| 2 + of_node * (cable.elements + 1).min(NODES)).sum();
        // a few contacts per element, if there are any
        let contacts = if cast::touches(scene) { 6 * nodes / 9 } else { 0 };
        let limit = (NUMBERS / (nodes + contacts + 7 * scene.bodies.len()).max(1)).clamp(2, FRAMES);
        Recorder {
            frames: Decimator::new(limit),
            probes: scene.probes.iter().map(|_| Decimator::new(ROWS)).collect(),
            cpu: Duration::ZERO,
            wall: Duration::ZERO,
        }
    }

    /// Records the present state as a frame, if one is due.
    ///
    /// # Errors
    /// [`Error::Mechanics`] if a cable cannot be read; not for a state that a step has reached.
    pub fn frame(&mut self, world: &World) -> Result<(), Error> {
        if self.frames.is_due() {
            let (cpu, wall) = (ProcessTime::now(), Instant::now());
            let frame = Frame::of(world)?;
            self.frames.push(frame);
            self.cpu += cpu.elapsed();
            self.wall += wall.elapsed();
        } else {
            self.frames.skip();
        }
        Ok(())
    }

    /// Records a row of a probe.
    pub fn row(&mut self, probe: usize, row: &[f64]) {
        self.probes[probe].offer(row);
    }

    /// Returns the CPU and wall time that recording took.
    pub fn spent(&self) -> (Duration, Duration) {
        (self.cpu, self.wall)
    }

    /// Records the present state as last frame, if all cables have reached the same time.
    pub fn close(&mut self, world: &World) {
        let time = world.time();
        let together =
            world.cables().iter().all(|cable| cable.time() == time || world.scene().engine == Engine::Rapier);
        let new = self.frames.kept().last().is_none_or(|last| last.time < time);
        if together
            && new
            && let Ok(frame) = Frame::of(world)
        {
            self.frames.append(frame);
        }
    }

    /// Returns the page.
    pub fn page(&self, world: &World, summary: &Summary) -> String {
        page::write(world.scene(), summary, self.frames.kept(), &self.probes)
    }

    /// Returns the motion as an animated SVG.
    pub fn svg(&self, world: &World) -> String {
        svg::write(&Cast::of(world.scene()), self.frames.kept())
    }

    /// Returns the motion as OpenUSD.
    pub fn usd(&self, world: &World) -> String {
        usd::write(world.scene(), self.frames.kept())
    }
}
