//! Cables on bevy_rapier's bodies, in an app without a window.

use bevy::prelude::*;
use bevy::time::TimeUpdateStrategy;
use bevy_rapier3d::prelude::*;
use lariat_bevy_rapier::LariatRapierPlugin;
use lariat_bevy_rapier::lariat_bevy::event::{AttachmentEnded, EndReason, StepFailed};
use lariat_bevy_rapier::lariat_bevy::lariat_ancf::Section;
use lariat_bevy_rapier::lariat_bevy::{
    At, Attachment, AttachmentReading, Bending, Cable, Cables, Damping, Error, Rule,
};
use std::time::Duration;

/// One update is one step of `dt` (s).
fn app(dt: f32, substeps: usize) -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin, RapierPhysicsPlugin::<NoUserData>::default()))
        .add_plugins(LariatRapierPlugin::default())
        .insert_resource(TimestepMode::Fixed { dt, substeps })
        .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f32(dt)));
    app.finish();
    app.cleanup();
    app
}

fn crate_at(app: &mut App, position: Vec3, mass: f32) -> Entity {
    let collider = (Collider::cuboid(0.1, 0.1, 0.1), ColliderMassProperties::Mass(mass));
    app.world_mut().spawn((RigidBody::Dynamic, collider, Transform::from_translation(position))).id()
}

/// 50 kg on a 0.8 kg cable, let go from horizontal, host step 1/240 s: the crate's centre after 0.5
/// s.
///
/// *Source.* A fine run of an independent monolithic code, good to 2e-5 m.
#[test]
fn the_payload_pendulum_follows_the_reference() {
    let mut app = app(1.0 / 240.0, 1);
    let load = crate_at(&mut app, Vec3::new(2.0, -0.1, 0.0), 50.0);
    let sling = Cable::new(Section::square(0.01, 1.0e9, 4000.0).unwrap()).between([0.0; 3], [2.0, 0.0, 0.0]);
    let sling = app.world_mut().spawn((sling, Bending, Rule::G5_3)).id();
    app.world_mut().spawn(Attachment::ball(sling, At::Start).to_world());
    let hook = app.world_mut().spawn(Attachment::ball(sling, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    // the first update has no time step behind it yet
    let time = |app: &App| app.world().resource::<Cables>().get(sling).unwrap().time();
    while time(&app) < 0.5 - 1e-4 {
        app.update();
    }
    let position = app.world().get::<Transform>(load).unwrap().translation;
    let off = (f64::from(position.x) - 1.70292).hypot(f64::from(position.y) + 1.21801);
    assert!(off < 6e-3, "{off:.1e} m at {}", time(&app));
    assert!(app.world().get::<AttachmentReading>(hook).unwrap().gap.norm() < 1e-5);
}

#[test]
fn the_attachment_of_a_hanging_crate_reads_its_weight_and_ends_when_the_crate_is_despawned() {
    let mut app = app(1.0 / 60.0, 1);
    let load = crate_at(&mut app, Vec3::new(0.0, -2.1, 0.0), 5.0);
    let rope = Cable::round(0.01, 1e9, 4000.0).between([0.0; 3], [0.0, -2.0, 0.0]);
    let rope = app.world_mut().spawn((rope, Bending, Damping::critical_fraction(0.5))).id();
    app.world_mut().spawn(Attachment::ball(rope, At::Start).to_world());
    let hook = app.world_mut().spawn(Attachment::ball(rope, At::End).to(load).at([0.0, 0.1, 0.0])).id();
    for _ in 0..180 {
        app.update();
    }
    let force = app.world().get::<AttachmentReading>(hook).unwrap().force.y;
    assert!((force - 5.0 * 9.81).abs() < 0.05, "{force} N");
    app.world_mut().despawn(load);
    for _ in 0..2 {
        app.update();
    }
    let ended: Vec<AttachmentEnded> = app.world_mut().resource_mut::<Messages<AttachmentEnded>>().drain().collect();
    assert_eq!(ended, [AttachmentEnded { entity: hook, cable: rope, body: Some(load), reason: EndReason::BodyGone }]);
    assert_eq!(app.world().resource::<Cables>().attachments(), 1);
}

#[test]
fn with_substeps_every_step_fails_and_nothing_moves() {
    let mut app = app(1.0 / 60.0, 2);
    let load = crate_at(&mut app, Vec3::new(0.0, -2.1, 0.0), 5.0);
    for _ in 0..5 {
        app.update();
    }
    let failures: Vec<StepFailed> = app.world_mut().resource_mut::<Messages<StepFailed>>().drain().collect();
    assert!(
        !failures.is_empty() && failures.iter().all(|f| f.error == Error::Substeps { substeps: 2 }),
        "{failures:?}"
    );
    assert_eq!(app.world().get::<Transform>(load).unwrap().translation.y, -2.1);
    app.insert_resource(TimestepMode::Fixed { dt: 1.0 / 60.0, substeps: 1 });
    for _ in 0..5 {
        app.update();
    }
    assert!(app.world().get::<Transform>(load).unwrap().translation.y < -2.1);
}
