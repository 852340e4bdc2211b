//! A tractor pulls a trailer by a slack rope.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Damping, Integrator, Section, StepControl, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentHandle, AttachmentKind, CableSet};

/// A tractor of 2 t pulls a trailer of 1 t with 3 kN, by 4.1 m of polyester rope between hooks 4 m apart.
pub struct TowRope {
    world: PhysicsWorld,
    cables: CableSet,
    trailer: RigidBodyHandle,
    hook: AttachmentHandle,
    steps: u32,
    pull: f64,
}

impl TowRope {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let ground = ColliderBuilder::cuboid(100.0, 0.5, 10.0).translation(Vector::new(0.0, -0.5, 0.0)).friction(0.0);
        world.insert_collider(ground, None);
        let mut vehicle = |x: Real, mass: Real| {
            let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, 0.5, 0.0)).can_sleep(false);
            world.insert(body, ColliderBuilder::cuboid(1.0, 0.5, 0.5).mass(mass).friction(0.0)).0
        };
        let (trailer, tractor) = (vehicle(0.0, 1000.0), vehicle(6.0, 2000.0));
        world.bodies[tractor].add_force(Vector::new(3000.0, 0.0, 0.0), true); // N, until it is reset

        let rope = Cable::builder()
            .name("tow rope")
            .points([Vector3::new(1.0, 0.5, 0.0), Vector3::new(5.0, 0.5, 0.0)]) // m
            .length(4.1) // m: slack, it sags
            .section(Section::from_stiffness(4.0e5, 0.5, 0.4)?) // EA N, EI N m^2, kg/m
            .elements(10)
            .damping(Damping { axial: 0.02, bending: 0.01 }) // s
            // damps what the jerk excites beyond 1/240 s
            .integrator(Integrator {
                method: "generalised-alpha-0".parse()?,
                control: StepControl::MaxStep(1.0 / 240.0),
            })
            .build()?;
        let mut cables = CableSet::new();
        let rope = cables.insert(rope);
        let hook = cables.attach(&world, rope, At::Start, trailer, Vector::new(1.0, 0.0, 0.0), AttachmentKind::Ball)?;
        cables.attach(&world, rope, At::End, tractor, Vector::new(-1.0, 0.0, 0.0), AttachmentKind::Ball)?;
        Ok(TowRope { world, cables, trailer, hook, steps: 0, pull: 0.0 })
    }
}

impl Stage for TowRope {
    fn step(&mut self) -> Outcome<()> {
        self.cables.step(&mut self.world)?;
        self.steps += 1;
        if self.steps > 240 {
            self.pull += self.cables.attachment(self.hook)?.force().x / 60.0; // mean over the last 1 s
        }
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // F = m a for all, and for the trailer alone
        let expected = 3000.0 * 1000.0 / (3000.0 + 4.1 * 0.4);
        let pull = self.pull;
        let speed = self.world.bodies[self.trailer].linvel().x;
        let line = format!("the rope pulls the trailer with {pull:.1} N, by hand {expected:.1} N; {speed:.2} m/s");
        if (pull / expected - 1.0).abs() < 0.01 { Ok(line) } else { Err(line.into()) }
    }
}
