//! What the coupling must show beside costs and hard scenes: jams, friction, joints, free flight, and its size.

use super::model::{CableModel, SPLITS};
use super::scene::Scene;
use super::world::{World, host_steps};
use crate::error::Error;
use crate::table::{Cell, Format, Table, shown};
use lariat_ancf::{At, Cable, Damping, Fidelity, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};
use std::path::Path;

const FIDELITIES: [Fidelity; 2] = [Fidelity::Game, Fidelity::Engineering];
/// Files of the folders below in which no body and no cable is moved or held: the order of a host step, its settings and its budget, readings, and
/// what is done about a step that is refused.
const NO_PHYSICS: [&str; 7] = [
    "step/mod.rs",
    "step/budget.rs",
    "step/energy.rs",
    "step/reels.rs",
    "step/refused.rs",
    "step/settings.rs",
    "body/unsettled.rs",
];
/// Folders of lariat-rapier that are physics. The others are its interface, the search of islands, contact of cables with colliders,
/// statics and warnings.
const PHYSICS: [&str; 3] = ["step", "mechanism", "body"];

/// Those of them that are for bodies on joints.
const JOINTS: [&str; 2] = ["mechanism", "step/groups.rs"];

/// A world with cables and a winch.
struct Rig {
    world: PhysicsWorld,
    set: CableSet,
    winch: RigidBodyHandle,
    fidelity: Fidelity,
    /// Of the wires in s.
    damping: f64,
}

impl Rig {
    /// A world without gravity but for `gravity` (m/s^2), a winch at height `y` (m).
    fn new(fidelity: Fidelity, gravity: f64, y: f64) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -gravity as Real, 0.0);
        let winch = RigidBodyBuilder::kinematic_velocity_based().translation(Vector::new(0.0, y as Real, 0.0));
        let winch = world.insert_body(winch);
        Rig { world, set: CableSet::new(), winch, fidelity, damping: 1e-3 }
    }

    fn cube(&mut self, mass: f64, x: f64, y: f64) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(x as Real, y as Real, 0.0)).can_sleep(false);
        self.world.insert(body, ColliderBuilder::cuboid(0.1, 0.1, 0.1).mass(mass as Real).friction(0.5)).0
    }

    /// Two posts, in front of which a cube of 1 kg stands that moves along x towards `x` (m).
    fn jammed_cube(&mut self, x: f64) -> RigidBodyHandle {
        for y in [-0.35, 0.35] {
            let post = RigidBodyBuilder::fixed().translation(Vector::new(x as Real, y, 0.0));
            self.world.insert(post, ColliderBuilder::cuboid(0.1, 0.3, 1.0));
        }
        self.cube(1.0, x - 0.25, 0.0)
    }

    /// A steel wire of 3 mm and 2 m between two bodies.
    fn wire(&mut self, from: RigidBodyHandle, to: RigidBodyHandle, x: f64, y: f64) -> Result<CableHandle, Error> {
        let wire = Cable::builder()
            .points([Vector3::new(x, y, 0.0), Vector3::new(x - 2.0, y, 0.0)])
            .section(Section::round(0.003, 2e11, 7850.0)?)
            .damping(Damping { axial: self.damping, bending: self.damping })
            .gravity(Vector3::zeros())
            .fidelity(self.fidelity)
            .elements(10);
        let wire = self.set.insert(wire.build()?);
        self.set.attach_here(&self.world, wire, At::Start, from, AttachmentKind::Ball)?;
        self.set.attach_here(&self.world, wire, At::End, to, AttachmentKind::Ball)?;
        Ok(wire)
    }

    fn tension(&self, cable: CableHandle) -> Result<f64, Error> {
        Ok(self.set.get(cable)?.sample(1.0)?.tension)
    }

    /// Lets the winch draw a cable for 10 s until it carries `pull` (N) and stop; returns the lowest and the highest tension of all cables in the
    /// 2 s after, and the largest gap.
    fn draw(&mut self, pull: f64, compliance: f64) -> Result<[f64; 3], Error> {
        let cables: Vec<CableHandle> = self.set.iter().map(|(handle, _)| handle).collect();
        let mut seen = [f64::INFINITY, f64::NEG_INFINITY, 0.0];
        for k in 0..720 {
            let missing = (pull - self.tension(cables[0])?) * compliance;
            let speed = if k < 60 { 0.05 } else { (5.0 * missing).clamp(-0.05, 0.05) };
            let speed = if k < 600 { speed } else { 0.0 };
            self.world.bodies[self.winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
            self.set.step(&mut self.world)?;
            if k < 600 {
                continue;
            }
            seen[2] = self.set.attachments().map(|(_, a)| a.gap()).fold(seen[2], f64::max);
            for &cable in &cables {
                let tension = self.tension(cable)?;
                seen = [seen[0].min(tension), seen[1].max(tension), seen[2]];
            }
        }
        Ok(seen)
    }
}

/// Compliance in m/N of the wire, and of Rapier's contact with 1 kg.
const WIRE: f64 = 2.0 / 1.41e6;
const CONTACT: f64 = 3e-6;

/// Returns the largest deviation of the tension from `pull` (N), as a share of it.
fn deviation(pull: f64, [low, high, _]: [f64; 3]) -> f64 {
    (high / pull - 1.0).max(1.0 - low / pull)
}

fn jam(fidelity: Fidelity) -> Result<f64, Error> {
    let mut rig = Rig::new(fidelity, 0.0, 0.0);
    let load = rig.jammed_cube(-1.85);
    rig.wire(rig.winch, load, 0.0, 0.0)?;
    Ok(deviation(5e3, rig.draw(5e3, WIRE + CONTACT)?))
}

fn two_bodies(fidelity: Fidelity, damping: f64) -> Result<f64, Error> {
    let mut rig = Rig { damping, ..Rig::new(fidelity, 0.0, 0.0) };
    let (near, far) = (rig.cube(1.0, -2.1, 0.0), rig.jammed_cube(-4.05));
    rig.wire(rig.winch, near, 0.0, 0.0)?;
    rig.wire(near, far, -2.2, 0.0)?;
    Ok(deviation(1e3, rig.draw(1e3, 2.0 * WIRE + CONTACT)?))
}

fn fixed_joint(fidelity: Fidelity) -> Result<f64, Error> {
    let mut rig = Rig::new(fidelity, 0.0, 0.0);
    let load = rig.cube(1.0, -2.1, 0.0);
    let anchor = rig.world.insert_body(RigidBodyBuilder::fixed().translation(Vector::new(-2.1, 0.0, 0.0)));
    rig.world.insert_impulse_joint(anchor, load, FixedJointBuilder::new());
    rig.wire(rig.winch, load, 0.0, 0.0)?;
    Ok(rig.draw(5e3, WIRE)?[2])
}

/// Returns the largest pull on a cube of 20 kg on the ground, with a coefficient of friction of 0.5, by 1 N more in each host step.
fn friction(fidelity: Fidelity) -> Result<f64, Error> {
    let mut rig = Rig::new(fidelity, 9.81, 0.1);
    let ground = RigidBodyBuilder::fixed().translation(Vector::new(0.0, -0.5, 0.0));
    rig.world.insert(ground, ColliderBuilder::cuboid(20.0, 0.5, 5.0).friction(0.5));
    let load = rig.cube(20.0, -2.1, 0.1);
    let wire = rig.wire(rig.winch, load, 0.0, 0.1)?;
    let mut peak = 0.0f64;
    for k in 0..360 {
        let speed = if k < 60 { 0.0 } else { 60.0 * WIRE };
        rig.world.bodies[rig.winch].set_linvel(Vector::new(speed as Real, 0.0, 0.0), true);
        rig.set.step(&mut rig.world)?;
        peak = peak.max(rig.tension(wire)?);
    }
    Ok(peak)
}

/// Returns the share of the angular momentum that balls of 1 and 10 kg on a wire lose in 10 s at 5 rad/s.
fn dumbbell(fidelity: Fidelity) -> Result<f64, Error> {
    const SPIN: f64 = 5.0;
    // distance of the common centre of mass from the origin
    const CENTRE: f64 = 1.891;
    let mut rig = Rig::new(fidelity, 0.0, 0.0);
    let balls = [(1.0, 0.1), (10.0, -2.1)].map(|(mass, x)| {
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(x as Real, 0.0, 0.0))
            .linvel(Vector::new(0.0, (SPIN * (x + CENTRE)) as Real, 0.0))
            .angvel(Vector::new(0.0, 0.0, SPIN as Real));
        rig.world.insert(body, ColliderBuilder::ball(0.1).mass(mass)).0
    });
    let wire = rig.wire(balls[0], balls[1], 0.0, 0.0)?;
    let cable = rig.set.get_mut(wire)?;
    let q = cable.positions().to_vec();
    let (nodes, _) = q.as_chunks::<6>();
    let turn = |n: &[f64; 6]| [-SPIN * n[1], SPIN * (n[0] + CENTRE), 0.0, -SPIN * n[4], SPIN * n[3], 0.0];
    cable.set_coordinates(&q, &nodes.iter().flat_map(turn).collect::<Vec<_>>())?;
    let before = rig.set.momentum(&rig.world)?.angular;
    for _ in 0..600 {
        rig.set.step(&mut rig.world)?;
    }
    Ok((rig.set.momentum(&rig.world)?.angular - before).norm() / before.norm())
}

/// Returns the distance of the box of the payload pendulum after 1 s from where an independent code has it.
fn payload(scene: &Scene, centre: &Vector3<f64>, fidelity: Fidelity) -> Result<f64, Error> {
    let mut world = World::new(scene, CableModel::Lariat(fidelity), SPLITS[0])?;
    for _ in 0..host_steps(1.0) {
        world.step()?;
    }
    Ok((world.centre() - centre).norm())
}

/// Returns the lines of a file of lariat-rapier, or of all in a folder, comments included.
fn lines(name: &str) -> Result<usize, Error> {
    if NO_PHYSICS.contains(&name) {
        return Ok(0);
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lariat-rapier/src").join(name);
    let failed = |source| Error::Read { path: path.clone(), source };
    if path.is_dir() {
        let files = std::fs::read_dir(&path).map_err(failed)?.flatten();
        return files.map(|file| lines(&format!("{name}/{}", file.file_name().display()))).sum();
    }
    Ok(std::fs::read_to_string(&path).map_err(failed)?.lines().count())
}

/// Returns the table of what the coupling must show; `progress` is called with a line for each row.
///
/// # Errors
/// [`Error::Mechanics`], [`Error::Coupling`] if a run fails; [`Error::Read`] without the sources of lariat-rapier.
pub fn table(scene: &Scene, centre: &Vector3<f64>, progress: &mut dyn FnMut(&str)) -> Result<Table, Error> {
    type Measure<'a> = &'a dyn Fn(Fidelity) -> Result<f64, Error>;
    let cases: [(&str, &str, &str, Measure<'_>); 7] = [
        ("payload, distance from the reference after 1 s in m", "1e-2 game, 1.5e-3 engineering", "1.2e-3", &|f| {
            payload(scene, centre, f)
        }),
        ("dumbbell, angular momentum lost in 10 s, relative", "1e-4 game, 5e-7 engineering", "4.3e-7", &dumbbell),
        ("jam of 1 kg at 5 kN, largest deviation, relative", "1e-3", "1.4e-4", &jam),
        ("two bodies of 1 kg at 1 kN, one jammed, undamped wires, largest deviation, relative", "5e-4", "2e-4", &|f| {
            two_bodies(f, 0.0)
        }),
        ("the same on wires damped by 1 ms", "5e-4", "", &|f| two_bodies(f, 1e-3)),
        ("body of 1 kg on a fixed joint at 5 kN, gap in m", "1e-5", "4.3e-6", &fixed_joint),
        ("friction of 98.1 N, largest pull in N", "98.0 to 99.5", "98.59", &friction),
    ];
    let mut rows = Vec::new();
    for (name, asked, before, measure) in cases {
        let [game, engineering] = FIDELITIES.map(measure);
        let (game, engineering) = (game?, engineering?);
        progress(&format!("{name}: {game:.3e}, {engineering:.3e}"));
        rows.push(vec![name.into(), asked.into(), before.into(), game.into(), engineering.into()]);
    }
    for (name, asked, before, files) in [
        ("lines of physics in lariat-rapier, comments included", "1500", "2109", &PHYSICS[..]),
        ("of them for bodies on joints", "", "716", &JOINTS[..]),
    ] {
        let lines = files.iter().map(|file| lines(file)).sum::<Result<usize, Error>>()?;
        rows.push(vec![name.into(), asked.into(), before.into(), lines.into(), Cell::Empty]);
    }
    let columns = vec![
        shown("quantity", "quantity", Format::Plain),
        shown("asked", "asked", Format::Plain),
        shown("before", "version 0.1", Format::Plain),
        shown("game", "game", Format::Short),
        shown("engineering", "engineering", Format::Short),
    ];
    Ok(Table { name: "coupling_targets", columns, rows })
}
