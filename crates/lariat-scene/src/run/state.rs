//! The state of a world in equilibrium, which a run of the same scene can start from, bit for bit.
//!
//! # Format
//!
//! Text of two lines. The first says what it is: the version of the program, the checksum of the second line, and of each
//! part of the scene (each cable, body, attachment and so on) its name and a checksum of all that the scene says of it, so that the
//! state of another scene is refused, by the name of what differs. Duration, step, probes and the name of the scene may differ. The
//! second line is cables, bodies and contacts as JSON, whose numbers read back to the same bits.

use super::World;
use super::output::STATE;
use crate::error::Error;
use crate::physics::Physics;
use crate::scene::Scene;
use crate::text::read_text;
use lariat_ancf::Cable;
use lariat_ancf::seal::Checksum;
use serde::{Deserialize, Serialize};
use std::fmt::Debug;
use std::path::Path;

/// The state of a world that is at rest, as [`statics`](super::statics) writes it to `DIR/state`; also [of](State::of)
/// [`Recording::world`](super::Recording::world) of [`collect`](super::collect).
#[derive(Clone, Debug)]
pub struct State {
    head: Head,
    body: String,
}

/// Name by which Rapier writes that.
const RECYCLED: &str = "\"recycle_state\":";

/// What the state belongs to.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Head {
    /// Version of the program.
    lariat: String,
    /// Checksum of the body.
    check: String,
    /// The parts of the scene: what each is called, and its checksum.
    scene: Vec<(String, String)>,
}

/// What is kept of a world.
#[derive(Serialize)]
struct Kept<'a> {
    alone: &'a [Cable],
    physics: Option<&'a Physics>,
}

/// What is read of it.
#[derive(Deserialize)]
struct Read {
    alone: Vec<Cable>,
    physics: Option<Box<Physics>>,
}

impl State {
    /// Takes the state of a world in equilibrium.
    ///
    /// # Errors
    /// [`Error::State`] if it has numbers that cannot be written.
    pub fn of(world: &World) -> Result<Self, Error> {
        let kept = Kept { alone: &world.alone, physics: world.physics.as_deref() };
        let wrong = |error: serde_json::Error| Error::State { problem: error.to_string() };
        let body = without_infinite_extents(&serde_json::to_string(&kept).map_err(wrong)?);
        // JSON has no numbers that are not finite, which would be found only when the state is needed
        serde_json::from_str::<Read>(&body).map_err(wrong)?;
        let lariat = env!("CARGO_PKG_VERSION").to_string();
        Ok(State { head: Head { lariat, check: checksum(&body), scene: parts(&world.scene) }, body })
    }

    /// Reads the state that statics wrote to a folder.
    ///
    /// # Errors
    /// [`Error::Read`]; [`Error::State`] for a file that is damaged, or of another version of the program.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(STATE);
        Self::parse(&read_text(&path)?, &path.display().to_string())
    }

    /// Reads a state from its [text](Self::to_text); `source` names it in errors.
    ///
    /// # Errors
    /// [`Error::State`] as [`read`](Self::read).
    pub fn parse(text: &str, source: &str) -> Result<Self, Error> {
        let wrong = |problem: &str| Error::State { problem: format!("{source}: {problem}") };
        let (head, body) = text.split_once('\n').ok_or_else(|| wrong("it is no state that `lariat static` wrote"))?;
        let head: Head = serde_json::from_str(head).map_err(|_| wrong("it is no state that `lariat static` wrote"))?;
        if head.lariat != env!("CARGO_PKG_VERSION") {
            let problem = format!("version {} wrote it, this is {}", head.lariat, env!("CARGO_PKG_VERSION"));
            return Err(wrong(&(problem + ": run `lariat static` again")));
        }
        if checksum(body) != head.check {
            return Err(wrong("it is damaged: run `lariat static` again"));
        }
        Ok(State { body: body.to_string(), head })
    }

    /// Returns the text of the file.
    pub fn to_text(&self) -> String {
        serde_json::to_string(&self.head).unwrap_or_default() + "\n" + &self.body
    }

    /// Puts the state into the world of the same scene.
    ///
    /// # Errors
    /// [`Error::State`] for the state of another scene.
    pub(super) fn put(&self, world: &mut World) -> Result<(), Error> {
        let own = parts(&world.scene);
        let differs = |part: &&(String, String)| !self.head.scene.contains(part);
        let gone = || self.head.scene.iter().find(|part| !own.contains(part));
        if let Some((name, _)) = own.iter().find(differs).or_else(gone) {
            return Err(Error::State { problem: format!("it is that of another scene: {name} differs") });
        }
        if own != self.head.scene {
            return Err(Error::State {
                problem: "it is that of another scene: its tables are in another order".into(),
            });
        }
        let read = serde_json::from_str(&self.body).map_err(|error| Error::State { problem: error.to_string() })?;
        let Read { alone, physics } = read;
        (world.alone, world.physics) = (alone, physics);
        Ok(())
    }
}

/// Leaves out by what Rapier tells whether a contact is still that of the step before, of contacts with a plane: its extent is
/// infinite, so that Rapier finds them anew in any case, and JSON has no such number.
fn without_infinite_extents(body: &str) -> String {
    let (mut out, mut rest) = (String::with_capacity(body.len()), body);
    while let Some((before, state)) = rest.split_once(RECYCLED) {
        out += before;
        out += RECYCLED;
        let mut depth = 0usize;
        let closes = |c: char| {
            depth = if c == '{' { depth + 1 } else { depth - usize::from(c == '}') };
            depth == 0
        };
        let end = state.find(closes).filter(|_| state.starts_with('{')).map_or(0, |end| end + 1);
        let (state, after) = state.split_at(end);
        out += if state.contains("\"max_extent\":null") { "null" } else { state };
        rest = after;
    }
    out + rest
}

/// Returns the parts of a scene that its equilibrium depends on.
fn parts(scene: &Scene) -> Vec<(String, String)> {
    // all fields, so that a new one cannot be forgotten
    let Scene {
        name: _,
        duration: _,
        dt: _,
        probes: _,
        equilibrium: _,
        gravity,
        water,
        engine,
        solver_iterations,
        bodies,
        cables,
        parts,
        attachments,
        joints,
        junctions,
        kinks: _,
        sheaves,
        loads,
        body_loads,
    } = scene;
    let mut out = Vec::new();
    let mut add = |what: String, part: &dyn Debug| out.push((what, checksum(&format!("{part:?}"))));
    add("`gravity`".into(), gravity);
    if let Some(water) = water {
        add("`water`".into(), water);
    }
    add("`engine`".into(), engine);
    add("`solver_iterations`".into(), solver_iterations);
    cables.iter().for_each(|x| add(format!("cable {:?}", x.name), x));
    bodies.iter().for_each(|x| add(format!("body {:?}", x.name), x));
    attachments.iter().for_each(|x| add(format!("attachment {:?}", x.name), x));
    joints.iter().enumerate().for_each(|(i, x)| add(format!("joint {i}"), x));
    junctions.iter().for_each(|x| add(format!("junction {:?}", x.name), x));
    sheaves.iter().for_each(|x| add(format!("sheave {:?}", x.name), x));
    loads.iter().enumerate().for_each(|(i, x)| add(format!("load {i} on a cable"), x));
    body_loads.iter().enumerate().for_each(|(i, x)| add(format!("load {i} on a body"), x));
    add("the number of cables' parts".into(), parts);
    out
}

/// Returns a checksum.
fn checksum(text: &str) -> String {
    Checksum::of(text.as_bytes()).digits()
}
