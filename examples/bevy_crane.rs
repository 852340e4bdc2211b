//! A crane made of bevy_ecs entities lifts a crate and turns: `cargo run --release --example bevy_crane`.
//!
//! A kinematic boom stands over a crate of 200 kg that lies on the ground, attached by a slack steel rope of 8 mm. The boom rises by 3 m and
//! turns by 90 degrees. The example checks that the crate does not move while the rope is slack, that it hangs below the tip of the boom in the
//! end, and that the force on it is its weight.

use bevy_ecs::prelude::*;
use lariat_bevy::event::StepFailed;
use lariat_bevy::rapier::prelude::ColliderBuilder;
use lariat_bevy::{
    At, Attachment, AttachmentReading, Bending, Body, BodyPose, Cable, CableStep, Damping, Diagnostics, Drag,
    KinematicTarget,
};
use nalgebra::{UnitQuaternion, Vector3};

/// Boom, crate and hook.
#[derive(Resource, Clone, Copy)]
struct Crane(Entity, Entity, Entity);

const ARM: f64 = 4.0; // m
const HEIGHT: f64 = 5.0; // m
const MASS: f32 = 200.0; // kg

/// Height (m) and angle (rad) of the boom above its start: it rises within 6 s, then turns within 12 s, both smoothly.
fn boom(time: f64) -> (f64, f64) {
    let smooth = |x: f64| x.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * x.clamp(0.0, 1.0));
    (3.0 * smooth(time / 6.0), std::f64::consts::FRAC_PI_2 * smooth((time - 6.0) / 12.0))
}

fn spawn(mut commands: Commands) {
    commands.spawn(Body::fixed().at([0.0, -0.5, 0.0]).with(ColliderBuilder::cuboid(20.0, 0.5, 20.0)));
    let boom = commands.spawn((Name::new("boom"), Body::kinematic().at([0.0, HEIGHT, 0.0]))).id();
    let crate_ = Body::dynamic().at([ARM, 0.3, 0.0]).with(ColliderBuilder::cuboid(0.3, 0.3, 0.3).mass(MASS));
    let crate_ = commands.spawn((Name::new("crate"), crate_)).id();
    let rope = Cable::steel_rope(0.008).between([ARM, HEIGHT, 0.0], [ARM, 0.6, 0.0]).length(5.0).elements(12).hanging();
    let rope = commands.spawn((Name::new("rope"), rope, Bending, Damping::critical_fraction(1.0), Drag::air())).id();
    commands.spawn(Attachment::ball(rope, At::Start).to(boom).at([ARM, 0.0, 0.0]));
    let hook = commands.spawn(Attachment::ball(rope, At::End).to(crate_).at([0.0, 0.3, 0.0])).id();
    commands.insert_resource(Crane(boom, crate_, hook));
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::new();
    lariat_bevy::install(&mut world);
    world.add_observer(|event: On<StepFailed>| panic!("{}", event.error));
    let system = world.register_system(spawn);
    world.run_system(system)?;
    let Crane(boom_, crate_, hook) = *world.resource::<Crane>();
    let weight = f64::from(MASS) * 9.81;
    println!("  t, s   boom, m   crate x, y, z, m          pull, N");
    for step in 1..=1500 {
        let time = f64::from(step) / 60.0;
        let (up, round) = boom(time);
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -round);
        world.entity_mut(boom_).insert(KinematicTarget { position: Vector3::new(0.0, HEIGHT + up, 0.0), rotation });
        world.run_schedule(CableStep); // one host step of 1/60 s
        let (crate_, pull) = (world.get::<BodyPose>(crate_), world.get::<AttachmentReading>(hook));
        let (Some(crate_), Some(pull)) = (crate_, pull) else { return Err("no crate".into()) };
        let (p, pull) = (crate_.position, pull.force.norm());
        if step % 150 == 0 {
            println!("  {time:4.1}   {:6.3}    {:6.3} {:6.3} {:6.3}    {pull:8.1}", HEIGHT + up, p.x, p.y, p.z);
        }
        if step == 60 && (p - Vector3::new(ARM, 0.3, 0.0)).norm() > 5e-3 {
            return Err(format!("the crate moved while the rope was slack: {p}").into());
        }
        if step == 1500 {
            let under = Vector3::new(0.0, 0.0, ARM);
            let off = (p.x - under.x).hypot(p.z - under.z);
            println!("the crate hangs {off:.2} m off the point below the tip; force {pull:.0} N, weight {weight:.0} N");
            if off > 0.5 || (pull / weight - 1.0).abs() > 0.05 || p.y < 2.5 {
                return Err("position or force of the hanging crate is wrong".into());
            }
        }
    }
    let done = world.resource::<Diagnostics>();
    println!(
        "{} integration steps, {} rejected, {} Newton iterations; work of the cables on bodies {:.0} J",
        done.cables.steps, done.cables.rejected_steps, done.cables.newton_iterations, done.interface_work
    );
    println!(
        "time per host step: predict {:.0} us, Rapier {:.0} us, other {:.0} us",
        done.times.predict.as_secs_f64() / 1500.0 * 1e6,
        done.times.engine.as_secs_f64() / 1500.0 * 1e6,
        (done.times.prepare + done.times.reconcile + done.times.publish).as_secs_f64() / 1500.0 * 1e6
    );
    Ok(())
}
