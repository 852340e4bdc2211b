//! Drawing with Rapier's debug renderer.

use super::common::{add_cube, cable, soft};
use lariat_rapier::convert::vector;
use lariat_rapier::lariat_ancf::At;
use lariat_rapier::rapier::pipeline::{DebugColor, DebugRenderBackend, DebugRenderObject};
use lariat_rapier::rapier::prelude::*;
use lariat_rapier::{AttachmentKind, CableSet, DrawStyle};

#[derive(Default)]
struct Lines(Vec<(Vector, Vector, DebugColor)>);

impl DebugRenderBackend for Lines {
    fn draw_line(&mut self, _: DebugRenderObject, a: Vector, b: Vector, color: DebugColor) {
        self.0.push((a, b, color));
    }
}

/// Four lines per element from one end to the other; red at the tension of the style, blue at zero.
///
/// Reference: the contract.
#[test]
fn a_cable_is_drawn_along_its_length_and_coloured_by_tension() {
    let mut world = PhysicsWorld::new();
    let load = add_cube(&mut world, 10.0, 0.1, [0.0, -2.1, 0.0]);
    let mut set = CableSet::new();
    let taut = set.insert(cable([0.0; 3], [0.0, -2.0, 0.0], soft()).fix(At::Start).build().unwrap());
    set.insert(cable([1.0, 0.0, 0.0], [2.0, 0.0, 0.0], soft()).fix(At::Start).build().unwrap());
    set.attach(&world, taut, At::End, load, Vector::new(0.0, 0.1, 0.0), AttachmentKind::Ball).unwrap();
    for _ in 0..30 {
        set.step(&mut world).unwrap();
    }
    let mut lines = Lines::default();
    set.draw(&mut lines, &DrawStyle { red: Some(30.0), ..DrawStyle::default() });
    assert_eq!(lines.0.len(), 80);
    let (own, other) = lines.0.split_at(40);
    assert!(own.windows(2).all(|w| w[0].1 == w[1].0), "one line goes on where the last ended");
    assert!((vector(own[39].1) - set.get(taut).unwrap().node_position(10)).norm() < 1e-6);
    assert!(own.iter().all(|(_, _, c)| c[0] < 1.0), "some 100 N: red");
    assert!(other.last().unwrap().2[0] > 200.0, "a free end: blue");
}
