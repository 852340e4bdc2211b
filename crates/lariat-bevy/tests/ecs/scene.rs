//! A scene with one of everything that a snapshot holds.

use super::common::{cube, pin, soft};
use bevy_ecs::entity_disabling::Disabled;
use bevy_ecs::name::Name;
use bevy_ecs::prelude::*;
use lariat_ancf::{Surface, Vector3, Water};
use lariat_bevy::rapier::prelude::{ColliderBuilder, LockedAxes, MassProperties, RigidBodyBuilder, Vector};
use lariat_bevy::{
    At, Attachment, Bending, Body, BreakForce, BreakTension, Buoyancy, Cable, Contact, Damping, Drag, Drum, Gap,
    InWater, Interpolate, Junction, KinematicTarget, KinkAlong, LineLoads, PointLoads, Reel, RestShape, RopeMesh, Sea,
    Sheave, SheaveAlong, lariat_ancf,
};

/// The entities of a scene that a test asks for.
pub struct Scene {
    pub hoist: Entity,
    pub load: Entity,
    pub crane: Entity,
    pub reeled: Entity,
    pub wheel: Entity,
    pub wound: Entity,
    pub float: Entity,
    pub far: Entity,
    pub not_built: [Entity; 2],
}

pub fn damped() -> (Bending, Damping) {
    (Bending, Damping::critical_fraction(0.3))
}

/// A body about an axis along z.
fn wheel(at: [f64; 3]) -> Body {
    let own = MassProperties::new(Vector::ZERO, 4.0, Vector::new(0.4, 0.4, 0.4));
    let axes = LockedAxes::TRANSLATION_LOCKED | LockedAxes::ROTATION_LOCKED_X | LockedAxes::ROTATION_LOCKED_Y;
    Body::new(RigidBodyBuilder::dynamic().additional_mass_properties(own).locked_axes(axes)).at(at)
}

/// One of everything, each in its own place along z.
pub fn scene(world: &mut World) -> Scene {
    world.insert_resource(Sea(Water::new(1000.0).with_surface(Surface::at(-6.0, Vector3::new(0.0, -9.81, 0.0)))));
    world.spawn(Body::fixed().at([0.0, -2.8, 0.0]).with(ColliderBuilder::cuboid(10.0, 0.5, 1.0)));
    // a load that swings from the world, and touches the ground with its rope
    let load = world.spawn(cube(0.1, 20.0, [1.6, -0.1, 0.0])).id();
    let effects = (Drag::air(), Contact::with_friction(0.3), LineLoads::uniform([0.0, 0.0, 0.1]), Buoyancy::water());
    let drawn = (Name::new("hoist"), Interpolate::default(), RopeMesh::new(0.005), RestShape::from(Vec::new()));
    let loads = PointLoads::force(0.8, [0.0, -3.0, 0.0]);
    let hoist = world.spawn((soft([0.0; 3], [1.6, 0.0, 0.0]).elements(16), damped(), effects, drawn, loads)).id();
    world.spawn(pin(hoist));
    world.spawn((Attachment::ball(hoist, At::End).to(load).at([0.0, 0.1, 0.0]), BreakForce(1e6)));
    // one on a kinematic body, and one that hangs on it in a bridle
    let crane = world.spawn((Body::kinematic().at([0.0, 0.0, 3.0]), KinematicTarget::at([0.0, 0.0, 3.0]))).id();
    let knot = [0.0, -1.0, 3.0];
    let mut rope = |from, to| world.spawn((soft(from, to), damped())).id();
    let ropes = [rope([0.0, 0.0, 3.0], knot), rope([1.0, 0.0, 3.0], knot), rope(knot, [0.0, -2.0, 3.0])];
    world.spawn(Attachment::clamp(ropes[0], At::Start).to(crane).at([0.0, 0.0, 0.0]));
    world.spawn(pin(ropes[1]));
    let weight = world.spawn(cube(0.1, 5.0, [0.0, -2.1, 3.0])).id();
    world.spawn(Attachment::ball(ropes[2], At::End).to(weight).at([0.0, 0.1, 0.0]));
    world.spawn(Junction::between((ropes[0], At::End), (ropes[1], At::End)).and((ropes[2], At::Start)));
    // over a sheave
    let up = world.spawn((soft([0.0, -2.0, 6.0], [0.0, 0.0, 6.0]), damped())).id();
    let down = world.spawn((soft([0.0, 0.0, 6.0], [0.0, -3.0, 6.0]), damped())).id();
    world.spawn(Attachment::ball(up, At::End).to_world());
    world.spawn(Attachment::ball(down, At::Start).to_world());
    world.spawn(Sheave::between((up, At::End), (down, At::Start)).friction(0.1));
    // from a reel, and from a drum
    let reeled = world.spawn((soft([0.0, -2.0, 9.0], [0.0, 0.0, 9.0]), damped(), Reel::with_rate(0.4))).id();
    world.spawn(Attachment::ball(reeled, At::End).to_world());
    let wheel = world.spawn(wheel([0.2, 0.0, 12.0])).id();
    let drum = Drum::at_end(wheel, [0.0, 0.0, 1.0], 0.2).with_stock(5.0);
    let wound = world.spawn((soft([0.0, -2.0, 12.0], [0.0, 0.0, 12.0]), damped(), drum)).id();
    world.spawn(Attachment::ball(wound, At::End).to_world());
    // in water
    let ball = Body::new(RigidBodyBuilder::dynamic().translation(Vector::new(0.0, -6.0, 15.0)));
    let ball = ball.with(ColliderBuilder::ball(0.2).density(500.0));
    let float = world.spawn((ball, InWater::with_drag_area([0.06; 3]).with_added_mass(0.5))).id();
    let stone = Body::fixed().at([3.0, -6.0, 15.0]).with(ColliderBuilder::ball(0.2));
    world.spawn((stone, InWater::default()));
    // too weak for what swings down on it, in some steps
    let weak = world.spawn((soft([0.0, 0.0, 18.0], [2.0, 0.0, 18.0]), damped(), BreakTension(145.0))).id();
    world.spawn(pin(weak));
    let bucket = world.spawn(cube(0.1, 5.0, [2.1, 0.0, 18.0])).id();
    world.spawn(Attachment::ball(weak, At::End).to(bucket).at([-0.1, 0.0, 0.0]));
    // what cannot be
    let pendulum = world.spawn((soft([0.0, 0.0, 21.0], [1.0, 0.0, 21.0]), damped())).id();
    world.spawn(pin(pendulum));
    // it falls past this point, where no attachment catches it: its gap was too long when it was tried
    world.spawn(Attachment::ball(pendulum, At::End).to_world().at([0.0, -1.0, 21.0]).gap(Gap::Refuse(0.05)));
    let far = world.spawn(SheaveAlong::of(pendulum, At::ArcLength(0.5)).to_world([0.0, 9.0, 21.0])).id();
    let not_built = [Cable::steel_rope(-1.0).between([0.0; 3], [1.0, 0.0, 0.0]), Cable::steel_rope(0.01)];
    let not_built = not_built.map(|cable| world.spawn(cable).id());
    // an attachment that no step looks at
    world.spawn((Attachment::ball(hoist, At::ArcLength(0.8)).to_world().gap(Gap::Close), Disabled));
    Scene { hoist, load, crane, reeled, wheel, wound, float, far, not_built }
}

/// Spawns what is to be made in the next step.
pub fn ask(world: &mut World) {
    let rope = soft([0.0, -2.0, 24.0], [0.0; 3]).through([[0.0, -2.0, 24.0], [0.0, 0.0, 24.0], [0.0, -3.0, 24.0]]);
    let rope = world.spawn((rope.node_at(2.0), damped())).id();
    world.spawn(SheaveAlong::of(rope, At::ArcLength(2.0)).to_world([0.0, 0.0, 24.0]));
    let limp = world.spawn((soft([0.0, 0.0, 27.0], [2.0, 0.0, 27.0]), Damping::time(2e-3))).id();
    world.spawn(pin(limp));
    world.spawn(Attachment::ball(limp, At::End).to_world());
    world.spawn(KinkAlong::of(limp, At::ArcLength(1.4)));
    let body = RigidBodyBuilder::dynamic().angvel(Vector::new(0.0, 1.0, 2.0)).linear_damping(0.1).user_data(1 << 100);
    let late = Body::new(body).at([2.0, -2.1, 27.0]).velocity([0.1, 0.0, 0.0]);
    let late = late.with(ColliderBuilder::cuboid(0.1, 0.2, 0.3).mass(3.0).friction(0.1));
    let late = world.spawn((late, Name::new("late"))).id();
    let rope = world.spawn((soft([2.0, 0.0, 27.0], [2.0, -2.0, 27.0]), damped())).id();
    world.spawn(pin(rope));
    world.spawn(Attachment::ball(rope, At::End).to(late).at([0.0, 0.1, 0.0]));
}
