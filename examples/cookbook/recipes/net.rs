//! A net that catches a ball.

use super::{Outcome, Stage};
use lariat_rapier::lariat_ancf::{At, Cable, Contact, Damping, Section, Vector3};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableHandle, CableSet};

const MESH: f64 = 0.4; // m
const SIZE: usize = 4; // meshes on a side
const MASS: f64 = 5.0; // kg

/// A net of 16 meshes, held at its corners; a ball of 5 kg falls 1 m into it.
pub struct Net {
    world: PhysicsWorld,
    cables: CableSet,
    twines: Vec<CableHandle>,
    ball: RigidBodyHandle,
    lowest: f64,
}

impl Net {
    pub fn new() -> Outcome<Self> {
        let mut world = PhysicsWorld::new();
        let posts = world.insert_body(RigidBodyBuilder::fixed());
        let ball = RigidBodyBuilder::dynamic().translation(Vector::new(0.05, 1.3, 0.03)).can_sleep(false);
        let (ball, _) = world.insert(ball, ColliderBuilder::ball(0.3).mass(MASS as Real).friction(0.5));
        let mut cables = CableSet::new();
        let twine = Section::from_stiffness(1.0e5, 0.01, 0.05)?; // EA N, EI N m^2, kg/m
        let knot = |i: usize, j: usize| Vector3::new(i as f64 - 2.0, 0.0, j as f64 - 2.0) * MESH;
        // the ends at each knot
        let mut ends = vec![Vec::new(); (SIZE + 1) * (SIZE + 1)];
        let mut twines = Vec::new();
        for (from, to) in
            (0..=SIZE).flat_map(|i| (0..SIZE).flat_map(move |j| [((i, j), (i, j + 1)), ((j, i), (j + 1, i))]))
        {
            let cable = Cable::builder()
                .points([knot(from.0, from.1), knot(to.0, to.1)])
                .section(twine)
                .elements(4)
                .damping(Damping { axial: 5e-3, bending: 1e-2 }) // s
                .build()?;
            let cable = cables.insert(cable);
            cables.set_contact(cable, Contact::with_friction(0.5).with_radius(0.005))?;
            twines.push(cable);
            for ((i, j), end) in [(from, At::Start), (to, At::End)] {
                ends[(SIZE + 1) * i + j].push((cable, end));
            }
        }
        for (n, knot) in ends.iter().enumerate() {
            let (i, j) = (n / (SIZE + 1), n % (SIZE + 1));
            if i % SIZE == 0 && j % SIZE == 0 {
                let at = Vector::new((i as Real - 2.0) * MESH as Real, 0.0, (j as Real - 2.0) * MESH as Real);
                for &(cable, end) in knot {
                    cables.attach(&world, cable, end, posts, at, AttachmentKind::Ball)?;
                }
            } else {
                for pair in knot.windows(2) {
                    cables.join(pair[0], pair[1])?;
                }
            }
        }
        Ok(Net { world, cables, twines, ball, lowest: f64::INFINITY })
    }
}

impl Stage for Net {
    fn step(&mut self) -> Outcome<()> {
        self.cables.step(&mut self.world)?;
        self.lowest = self.lowest.min(f64::from(self.world.bodies[self.ball].translation().y));
        Ok(())
    }

    fn check(&mut self) -> Outcome<String> {
        // in the net, and what the twines carry is of the size of its weight
        let place = self.world.bodies[self.ball].translation();
        let touches: usize =
            self.twines.iter().map(|&twine| self.cables.get(twine).map_or(0, |cable| cable.contacts().count())).sum();
        let line =
            format!("the ball came down to {:.2} m and is at {:.2} m on {touches} contacts", self.lowest, place.y);
        // where it comes to rest depends on how it rolls
        let stays = f64::from(place.x.hypot(place.z)) < 0.5 * MESH * SIZE as f64 && self.lowest > -1.5;
        if stays && touches > 2 { Ok(line) } else { Err(line.into()) }
    }
}
