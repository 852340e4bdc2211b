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

mod decimator;
mod page;
mod svg;
mod usd;

use crate::error::Error;
use crate::run::{Summary, World};
use crate::scene::{Engine, Scene};
use cpu_time::ProcessTime;
use decimator::Decimator;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use std::time::{Duration, Instant};

/// Largest number of frames of a page.
pub const FRAMES: usize = 600;
/// Largest number of numbers in the frames of a page, 4 bytes each: 11 MB of text.
pub const NUMBERS: usize = 2_000_000;
/// Largest number of nodes of a cable in a frame.
pub const NODES: usize = 201;
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

/// The cables and bodies at a time in s; numbers in the order that `data.js` reads.
#[derive(Default)]
struct Frame {
    time: f64,
    numbers: Vec<f32>,
}

impl Recorder {
    /// Returns an empty recorder.
    pub fn new(scene: &Scene) -> Self {
        let of_node = if is_twisted(scene) { 9 + STRIPE } else { 9 };
        let nodes: usize = scene.cables.iter().map(|cable| 2 + of_node * (cable.elements + 1).min(NODES)).sum();
        // a few contacts per element, if there are any
        let contacts = if touches(scene) { 6 * nodes / 9 } else { 0 };
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
        svg::write(world.scene(), self.frames.kept())
    }

    /// Returns the motion as OpenUSD.
    pub fn usd(&self, world: &World) -> String {
        usd::write(world.scene(), self.frames.kept())
    }
}

impl Frame {
    fn of(world: &World) -> Result<Self, Error> {
        let mut numbers = Vec::new();
        numbers.push(world.pieces().len() as f32);
        let mut stripes = Vec::new();
        for (cable, piece) in world.cables().into_iter().zip(world.pieces()) {
            let mut places = cable.node_arc_lengths();
            if places.len() > NODES {
                let step = cable.length() / (NODES - 1) as f64;
                places = (0..NODES).map(|k| (k as f64 * step).min(cable.length())).collect();
            }
            numbers.extend([piece.cable as f32, places.len() as f32]);
            for (i, &s) in places.iter().enumerate() {
                let here = cable.sample(s)?;
                let next = places.get(i + 1).map(|next| cable.sample(0.5 * (s + next))).transpose()?;
                numbers.push((piece.from + s) as f32);
                numbers.extend(here.position.iter().chain(here.slope.iter()).map(|&x| x as f32));
                numbers.extend([here.tension as f32, next.unwrap_or(here).tension as f32]);
            }
            if is_twisted(world.scene()) {
                for (direction, &s) in cable.stripe(&places)?.into_iter().zip(&places) {
                    let rate = cable.torsion_at(s)?.map_or(0.0, |reading| reading.twist_rate);
                    stripes.extend(direction.unwrap_or_default().iter().chain(&[rate]).map(|&x| x as f32));
                }
            }
        }
        for i in 0..world.scene().bodies.len() {
            if let Some(body) = world.body(i) {
                let q = body.rotation;
                numbers.extend(body.position.iter().chain(&[q.i, q.j, q.k, q.w]).map(|&x| x as f32));
            }
        }
        if touches(world.scene()) {
            let count = numbers.len();
            numbers.push(0.0);
            for cable in world.cables() {
                let on_bodies = cable
                    .contacts()
                    .map(|touch| (touch.arc_length, touch.normal * touch.normal_force + touch.friction));
                let on_cables = cable
                    .cable_contacts()
                    .map(|touch| (touch.arc_length, touch.normal * touch.normal_force + touch.friction));
                for (s, force) in on_bodies.chain(on_cables) {
                    let place = cable.sample(s)?.position;
                    numbers.extend(place.iter().chain(force.iter()).map(|&x| x as f32));
                    numbers[count] += 1.0;
                }
            }
        }
        numbers.extend(stripes);
        Ok(Frame { time: world.time(), numbers })
    }
}

impl Frame {
    /// Returns where the numbers of the pieces of each cable begin, and where those of the bodies do.
    fn places(&self, cables: usize) -> (Vec<Vec<usize>>, usize) {
        let (mut pieces, mut at) = (vec![Vec::new(); cables], 1);
        for _ in 0..self.numbers[0] as usize {
            pieces[self.numbers[at] as usize].push(at + 1);
            at += 2 + 9 * self.numbers[at + 1] as usize;
        }
        (pieces, at)
    }

    /// Returns the numbers of the nodes of the piece that begins at a place: arc length, position, slope, tension there and halfway to
    /// the next.
    fn nodes(&self, at: usize) -> impl ExactSizeIterator<Item = &[f32]> {
        self.numbers[at + 1..][..9 * self.numbers[at] as usize].chunks_exact(9)
    }

    /// Returns the vertices of the cubic Bezier pieces of the elements of the piece that begins at a place.
    fn vertices(&self, at: usize) -> Vec<[f32; 3]> {
        let nodes: Vec<&[f32]> = self.nodes(at).collect();
        let mut points = Vec::with_capacity(3 * nodes.len());
        for (i, here) in nodes.iter().enumerate() {
            let beside = |share: f32| [1, 2, 3].map(|k| here[k] + share * here[k + 3]);
            if i > 0 {
                points.push(beside(-(here[0] - nodes[i - 1][0]) / 3.0));
            }
            points.push(beside(0.0));
            if let Some(next) = nodes.get(i + 1) {
                points.push(beside((next[0] - here[0]) / 3.0));
            }
        }
        points
    }

    /// Returns position and rotation of a body, of which the bodies begin at a place.
    fn pose(&self, bodies: usize, body: usize) -> Isometry3<f32> {
        let x = &self.numbers[bodies + 7 * body..][..7];
        let rotation = UnitQuaternion::new_unchecked(Quaternion::new(x[6], x[3], x[4], x[5]));
        Isometry3::from_parts(Translation3::new(x[0], x[1], x[2]), rotation)
    }
}

/// Returns whether frames have stripes.
fn is_twisted(scene: &Scene) -> bool {
    scene.cables.iter().any(|cable| cable.effects.torsion.is_some())
}

/// Returns whether frames have contacts.
fn touches(scene: &Scene) -> bool {
    scene.cables.iter().any(|cable| cable.effects.contact.is_some())
}
