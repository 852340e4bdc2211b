//! What a program steps itself, recorded for a page and a picture.
//!
//! ```
//! use lariat_rapier::CableSet;
//! use lariat_rapier::rapier::pipeline::PhysicsWorld;
//! use lariat_scene::view::Film;
//!
//! let (mut world, mut cables) = (PhysicsWorld::new(), CableSet::new());
//! let mut film = Film::new("crane", [0.0, -9.81, 0.0]);
//! for step in 0..60 {
//!     film.take(f64::from(step) / 60.0, &world, &cables)?;
//!     cables.step(&mut world)?;
//! }
//! assert!(film.page(&[], &[]).contains("crane"));
//! # Ok::<(), lariat_rapier::Error>(())
//! ```
//!
//! # Limits
//!
//! At most [`FRAMES`] evenly spaced frames are kept, as of a [run](super). A body that is not there yet stands where it first
//! appears, one that is gone where it was last. Loads, reels and sheaves are not marked.

use super::cast::{BodyLook, CableLook, Cast};
use super::decimator::Decimator;
use super::frame::{Frame, pose, push_contacts, push_piece, push_stripe};
use super::page::{Plot, filled};
use super::shape::looks;
use super::{FRAMES, NODE, NUMBERS, ROWS, STRIPE, svg};
use crate::scene::body::{BodyKind, BodyShape};
use lariat_ancf::{Cable, Error};
use lariat_rapier::convert::{rotation, vector};
use lariat_rapier::rapier::dynamics::{RigidBody, RigidBodyHandle};
use lariat_rapier::rapier::geometry::ColliderHandle;
use lariat_rapier::rapier::math::Pose;
use lariat_rapier::rapier::pipeline::PhysicsWorld;
use lariat_rapier::{CableHandle, CableSet};
use nalgebra::{Isometry3, Vector3};
use serde_json::json;
use std::collections::HashMap;

/// A quantity that a program reads beside a film.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Its name.
    pub name: String,
    /// What a row holds; the first is the time in s.
    pub columns: Vec<String>,
    /// The numbers of all rows, one after the other.
    pub rows: Vec<f64>,
}

/// By what a cable is found again: that of a set by its handle, which another may have later, and its name.
#[derive(Clone, Debug, PartialEq)]
enum Key {
    Set(CableHandle, String),
    Alone(usize),
}

/// By what the looks of something solid are found again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Solid {
    Collider(ColliderHandle),
    Bare(RigidBodyHandle),
    Obstacle(usize),
}

/// A frame in parts, since how many bodies it has is known when the film ends.
#[derive(Default)]
struct Taken {
    time: f64,
    /// Number of pieces.
    pieces: usize,
    nodes: usize,
    cables: Vec<f32>,
    /// By index of the body.
    poses: Vec<(usize, [f32; 7])>,
    contacts: Vec<f32>,
    /// Empty if no cable has torsion.
    stripes: Vec<f32>,
}

/// Records cables and bodies.
pub struct Film {
    cast: Cast,
    cables: Vec<Key>,
    /// The bodies of the page, with their places on it.
    solids: HashMap<Solid, Vec<(usize, Isometry3<f64>)>>,
    /// By body, where it was first seen.
    first: Vec<[f32; 7]>,
    names: HashMap<RigidBodyHandle, String>,
    taken: Decimator<Taken>,
}

impl Film {
    /// Creates an empty film with a name, and gravity in m/s^2, which says where up is.
    pub fn new(name: impl Into<String>, gravity: impl Into<[f64; 3]>) -> Self {
        Film {
            cast: Cast { name: name.into(), gravity: Vector3::from(gravity.into()), ..Cast::default() },
            cables: Vec::new(),
            solids: HashMap::new(),
            first: Vec::new(),
            names: HashMap::new(),
            taken: Decimator::new(FRAMES),
        }
    }

    /// Sets what a body is called on the page, before it is first recorded. Others have no name there, and are not shown if they have no
    /// collider.
    pub fn name_body(&mut self, body: RigidBodyHandle, name: impl Into<String>) {
        self.names.insert(body, name.into());
    }

    /// Records a world and its cables at a time in s, if a frame is due.
    ///
    /// # Errors
    /// [`lariat_rapier::Error::Cable`] if a cable cannot be read; not after a step that succeeded.
    pub fn take(&mut self, time: f64, world: &PhysicsWorld, cables: &CableSet) -> Result<(), lariat_rapier::Error> {
        if !self.taken.is_due() {
            self.taken.skip();
            return Ok(());
        }
        let mut taken = Taken { time, ..Taken::default() };
        let of_set = |(handle, cable): (CableHandle, _)| (Key::Set(handle, Cable::name(cable).to_string()), cable);
        self.show(&mut taken, cables.iter().map(of_set))?;
        let placed = |at: &Pose| Isometry3::from_parts(vector(at.translation).into(), rotation(at.rotation));
        for (handle, collider) in world.colliders.iter() {
            let body = collider.parent();
            let kind = body.and_then(|body| world.bodies.get(body)).map_or(BodyKind::Fixed, kind);
            let first = body.is_some_and(|body| world.bodies[body].colliders().first() == Some(&handle));
            let name = body.filter(|_| first).and_then(|body| self.names.get(&body)).cloned().unwrap_or_default();
            let shapes = || (name, kind, looks(collider.shape()));
            self.stand(&mut taken, Solid::Collider(handle), &placed(collider.position()), shapes);
        }
        // bodies of Lariat's own have neither
        for (handle, body) in world.bodies.iter().filter(|(_, body)| body.colliders().is_empty()) {
            let Some(name) = self.names.get(&handle).cloned() else { continue };
            let look = || (name, kind(body), vec![(Isometry3::identity(), BodyShape::None)]);
            self.stand(&mut taken, Solid::Bare(handle), &placed(body.position()), look);
        }
        self.taken.push(taken);
        Ok(())
    }

    /// Records cables without a world at a time in s, if a frame is due, and obstacles: always the same ones, where they are now.
    ///
    /// # Errors
    /// [`Error`] if a cable cannot be read; not after a step that succeeded.
    pub fn take_cables<'a>(
        &mut self,
        time: f64,
        cables: impl IntoIterator<Item = &'a Cable>,
        obstacles: &[(Isometry3<f64>, BodyShape)],
    ) -> Result<(), Error> {
        if !self.taken.is_due() {
            self.taken.skip();
            return Ok(());
        }
        let mut taken = Taken { time, ..Taken::default() };
        self.show(&mut taken, cables.into_iter().enumerate().map(|(i, cable)| (Key::Alone(i), cable)))?;
        for (i, (at, shape)) in obstacles.iter().enumerate() {
            let look = || (String::new(), BodyKind::Fixed, vec![(Isometry3::identity(), shape.clone())]);
            self.stand(&mut taken, Solid::Obstacle(i), at, look);
        }
        self.taken.push(taken);
        Ok(())
    }

    /// Appends cables to a frame.
    fn show<'a>(&mut self, taken: &mut Taken, cables: impl Iterator<Item = (Key, &'a Cable)>) -> Result<(), Error> {
        let cables: Vec<_> = cables.collect();
        let twisted = cables.iter().any(|(_, cable)| cable.effects().torsion.is_some());
        for (key, cable) in &cables {
            let index = self.cables.iter().position(|own| own == key).unwrap_or_else(|| {
                self.cables.push(key.clone());
                let diameter = cable.elements().first().and_then(|element| element.section.diameter);
                self.cast.cables.push(CableLook { name: cable.name().to_string(), diameter });
                self.cables.len() - 1
            });
            let places = push_piece(&mut taken.cables, cable, index, 0.0)?;
            (taken.pieces, taken.nodes) = (taken.pieces + 1, taken.nodes + places.len());
            if twisted {
                push_stripe(&mut taken.stripes, cable, &places)?;
            }
            self.cast.touches |= cable.effects().contact.is_some();
        }
        self.cast.is_twisted |= twisted;
        push_contacts(&mut taken.contacts, cables.into_iter().map(|(_, cable)| cable))
    }

    /// Appends something solid to a frame; `look` says its name, kind and shapes when it is first seen.
    fn stand(
        &mut self,
        taken: &mut Taken,
        solid: Solid,
        at: &Isometry3<f64>,
        look: impl FnOnce() -> (String, BodyKind, Vec<(Isometry3<f64>, BodyShape)>),
    ) {
        let (bodies, first) = (&mut self.cast.bodies, &mut self.first);
        let parts = self.solids.entry(solid).or_insert_with(|| {
            let (name, kind, shapes) = look();
            let part = |(i, (own, shape)): (usize, (Isometry3<f64>, BodyShape))| {
                bodies.push(BodyLook { name: if i == 0 { name.clone() } else { String::new() }, kind, shape });
                first.push(pose(&(at * own)));
                (bodies.len() - 1, own)
            };
            shapes.into_iter().enumerate().map(part).collect()
        });
        taken.poses.extend(parts.iter().map(|(index, own)| (*index, pose(&(at * own)))));
    }

    /// Returns the frames as a page reads them, and what they show.
    fn frames(&self) -> (Cast, Vec<Frame>) {
        let (mut cast, all) = (self.cast.clone(), self.taken.kept());
        let nodes = all.iter().map(|taken| taken.nodes).max().unwrap_or(0);
        cast.elements = nodes;
        let of_frame = (NODE + STRIPE) * nodes + 7 * cast.bodies.len();
        let every = (of_frame * all.len()).div_ceil(NUMBERS).max(1);
        let mut poses = self.first.clone();
        let mut frames = Vec::with_capacity(all.len() / every + 1);
        for (k, taken) in all.iter().enumerate() {
            for (index, pose) in &taken.poses {
                poses[*index] = *pose;
            }
            if k % every != 0 && k + 1 != all.len() {
                continue;
            }
            let mut numbers = vec![taken.pieces as f32];
            numbers.extend(&taken.cables);
            numbers.extend(poses.iter().flatten());
            if cast.touches {
                numbers.extend(&taken.contacts);
            }
            if cast.is_twisted {
                numbers.extend(&taken.stripes);
                numbers.resize(numbers.len() + STRIPE * taken.nodes - taken.stripes.len(), 0.0);
            }
            frames.push(Frame { time: taken.time, numbers });
        }
        (cast, frames)
    }

    /// Returns the page that plays the motion, with plots of what a program read and lines of warnings.
    pub fn page(&self, series: &[Series], told: &[String]) -> String {
        let (cast, frames) = self.frames();
        let simulated = frames.last().map_or(0.0, |last| last.time) - frames.first().map_or(0.0, |first| first.time);
        let summary = json!({ "simulated_s": simulated, "told": told, "warnings": [] });
        let marks = json!({ "attachments": [], "sheaves": [], "junctions": [], "loads": [] });
        let plots: Vec<_> = series.iter().map(plot).collect();
        filled(&cast, &summary, &marks, &frames, &plots)
    }

    /// Returns the motion as an animated SVG.
    pub fn svg(&self) -> String {
        let (cast, frames) = self.frames();
        svg::write(&cast, &frames)
    }
}

/// Returns the plot of what a program read, decimated.
fn plot(series: &Series) -> Plot<'_, &[String]> {
    let mut rows = Decimator::new(ROWS);
    series.rows.chunks_exact(series.columns.len().max(1)).for_each(|row| rows.offer(row));
    let rows = rows.rows().flatten().copied().collect();
    Plot { name: &series.name, about: String::new(), columns: &series.columns, rows }
}

fn kind(body: &RigidBody) -> BodyKind {
    if body.is_dynamic() {
        BodyKind::Dynamic
    } else if body.is_kinematic() {
        BodyKind::Kinematic
    } else {
        BodyKind::Fixed
    }
}
