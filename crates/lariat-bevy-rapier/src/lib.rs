//! ANCF cables on the bodies of bevy_rapier3d.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_rapier3d::prelude::*;
//! use lariat_bevy_rapier::LariatRapierPlugin;
//! use lariat_bevy_rapier::lariat_bevy::{At, Attachment, Bending, Cable, Damping};
//!
//! fn main() {
//!     App::new()
//!         .add_plugins((MinimalPlugins, TransformPlugin, RapierPhysicsPlugin::<NoUserData>::default().in_fixed_schedule()))
//!         .add_plugins(LariatRapierPlugin::in_fixed_schedule())
//!         .insert_resource(TimestepMode::Fixed { dt: 1.0 / 64.0, substeps: 1 }) // as long as a fixed update
//!         .add_systems(Startup, |mut commands: Commands| {
//!             let box_ = (RigidBody::Dynamic, Collider::cuboid(0.1, 0.1, 0.1), Transform::from_xyz(0.0, -2.1, 0.0));
//!             let box_ = commands.spawn(box_).id();
//!             let rope = Cable::steel_rope(0.006).between([0.0, 0.0, 0.0], [0.0, -2.0, 0.0]);
//!             let rope = commands.spawn((rope, Bending, Damping::critical_fraction(0.2))).id();
//!             commands.spawn(Attachment::ball(rope, At::Start).to_world());
//!             commands.spawn(Attachment::ball(rope, At::End).to(box_).at([0.0, 0.1, 0.0]));
//!         })
//!         .run();
//! }
//! ```
//!
//! Cables, effects, attachments and events are those of [`lariat_bevy`]; bodies are bevy_rapier's
//! entities. Between [`PhysicsSet::SyncBackend`] and [`PhysicsSet::StepSimulation`] cables are
//! integrated together with the bodies attached to them; between that and [`PhysicsSet::Writeback`]
//! both are reconciled.
//!
//! # Limits
//!
//! - [`TimestepMode::Fixed`] and [`TimestepMode::Variable`] with one substep. Other modes step more
//!   than once between the two stages; with them every step fails
//!   ([`StepFailed`](lariat_bevy::event::StepFailed)), and bevy_rapier's pipeline is stopped for
//!   the frame.
//! - One Rapier step is one host step: with stiff cables on light bodies in contact choose a short
//!   one.
//! - Only bodies of the default context can be attached to.
//! - A length unit other than 1 is not supported.
//! - A [`Snapshot`](lariat_bevy::Snapshot) with attached cables is refused
//!   ([`Error::ForeignBodies`]), because the bodies are bevy_rapier's.
//! - The limits of [`lariat_bevy`](lariat_bevy#limits).

#[cfg(feature = "mesh")]
mod mesh;

use bevy::ecs::intern::Interned;
use bevy::ecs::schedule::ScheduleLabel;
use bevy::prelude::*;
use bevy_rapier3d::plugin::context::{
    DefaultRapierContext, RapierContextColliders, RapierContextEntityLink, RapierContextJoints,
    RapierContextSimulation, RapierRigidBodySet,
};
use bevy_rapier3d::prelude::{PhysicsSet, RapierConfiguration, RapierRigidBodyHandle, SimulationMode, TimestepMode};
use core::mem::swap;
pub use lariat_bevy;
use lariat_bevy::{AfterEngine, BeforeEngine, BodyHandle, Cables, Error, Physics, install_in};
#[cfg(feature = "mesh")]
pub use mesh::RopeMeshPlugin;

/// Attaches cables to the bodies of bevy_rapier, whose plugin must step in the same schedule.
#[derive(Clone, Debug)]
pub struct LariatRapierPlugin {
    schedule: Interned<dyn ScheduleLabel>,
}

impl Default for LariatRapierPlugin {
    /// Steps in `PostUpdate`, the default of bevy_rapier.
    fn default() -> Self {
        Self::in_schedule(PostUpdate)
    }
}

impl LariatRapierPlugin {
    /// Steps in `FixedUpdate`.
    pub fn in_fixed_schedule() -> Self {
        Self::in_schedule(FixedUpdate)
    }

    /// Steps in `schedule`.
    pub fn in_schedule(schedule: impl ScheduleLabel) -> Self {
        LariatRapierPlugin { schedule: schedule.intern() }
    }
}

/// The two halves of a step.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LariatSystems {
    /// Integrates cables together with their bodies, before [`PhysicsSet::StepSimulation`].
    BeforeStep,
    /// Reconciles them, after it.
    AfterStep,
}

/// The state of the step between its two halves.
#[derive(Resource, Default)]
struct Pending {
    /// Whether the first half ran.
    predicted: bool,
    /// Whether bevy_rapier's pipeline was stopped because the first half failed.
    stopped: bool,
}

impl Plugin for LariatRapierPlugin {
    fn build(&self, app: &mut App) {
        install_in(app);
        app.init_resource::<Pending>().add_observer(add_handle).add_observer(remove_handle);
        app.configure_sets(
            self.schedule,
            (
                PhysicsSet::SyncBackend,
                LariatSystems::BeforeStep,
                PhysicsSet::StepSimulation,
                LariatSystems::AfterStep,
                PhysicsSet::Writeback,
            )
                .chain(),
        );
        app.add_systems(self.schedule, before.in_set(LariatSystems::BeforeStep));
        app.add_systems(self.schedule, after.in_set(LariatSystems::AfterStep));
    }
}

/// Lets cables be attached to a body of the default context.
fn add_handle(
    added: On<Add<RapierRigidBodyHandle>>,
    bodies: Query<(&RapierRigidBodyHandle, Option<&RapierContextEntityLink>)>,
    default: Query<(), With<DefaultRapierContext>>,
    mut commands: Commands,
) {
    let Ok((handle, link)) = bodies.get(added.entity) else { return };
    if link.is_none_or(|link| default.contains(link.0)) {
        commands.entity(added.entity).try_insert(BodyHandle::external(handle.0));
    }
}

/// Ends that when the body is removed.
fn remove_handle(removed: On<Remove<RapierRigidBodyHandle>>, mut commands: Commands) {
    if let Ok(mut entity) = commands.get_entity(removed.entity) {
        entity.try_remove::<BodyHandle>();
    }
}

type Context = (
    &'static mut RapierContextSimulation,
    &'static mut RapierContextColliders,
    &'static mut RapierContextJoints,
    &'static mut RapierRigidBodySet,
    &'static mut RapierConfiguration,
);

/// Runs `action` while [`Physics`] is bevy_rapier's world, without copying it.
fn with_physics(world: &mut World, action: impl FnOnce(&mut World)) {
    exchange(world);
    action(world);
    exchange(world);
}

/// Swaps the parts of bevy_rapier's default context with those of [`Physics`].
fn exchange(world: &mut World) {
    let mut contexts = world.query_filtered::<Context, With<DefaultRapierContext>>();
    world.resource_scope(|world, mut physics: Mut<Physics>| {
        let Ok((mut simulation, mut colliders, mut joints, mut bodies, config)) = contexts.single_mut(world) else {
            return;
        };
        let physics = &mut physics.0;
        physics.gravity = config.gravity;
        swap(&mut physics.islands, &mut simulation.islands);
        swap(&mut physics.broad_phase, &mut simulation.broad_phase);
        swap(&mut physics.narrow_phase, &mut simulation.narrow_phase);
        swap(&mut physics.ccd_solver, &mut simulation.ccd_solver);
        swap(&mut physics.integration_parameters, &mut simulation.integration_parameters);
        swap(&mut physics.bodies, &mut bodies.bodies);
        swap(&mut physics.soft_bodies, &mut bodies.soft_bodies);
        swap(&mut physics.colliders, &mut colliders.colliders);
        swap(&mut physics.impulse_joints, &mut joints.impulse_joints);
        swap(&mut physics.multibody_joints, &mut joints.multibody_joints);
    });
}

/// Returns the step that bevy_rapier is about to make, in s.
fn step(mode: TimestepMode, time: &Time) -> Result<f32, Error> {
    match mode {
        TimestepMode::Fixed { dt, substeps: 1 } => Ok(dt),
        TimestepMode::Variable { max_dt, time_scale, substeps: 1 } => Ok((time.delta_secs() * time_scale).min(max_dt)),
        TimestepMode::Interpolated { .. } => Err(Error::VaryingSteps),
        TimestepMode::Fixed { substeps, .. } | TimestepMode::Variable { substeps, .. } => {
            Err(Error::Substeps { substeps })
        }
    }
}

/// The first half of a step.
fn before(world: &mut World) {
    let mut configs = world.query_filtered::<&RapierConfiguration, With<DefaultRapierContext>>();
    let active = configs
        .single(world)
        .is_ok_and(|config| config.physics_pipeline_active && config.simulation_mode == SimulationMode::Full);
    if !active {
        return;
    }
    let dt = step(*world.resource::<TimestepMode>(), world.resource::<Time>());
    let failed = match dt {
        Ok(0.0) => return,
        Ok(dt) => {
            with_physics(world, |world| {
                world.resource_mut::<Physics>().integration_parameters.dt = dt;
                world.run_schedule(BeforeEngine);
            });
            world.resource::<Cables>().has_failed()
        }
        Err(error) => {
            world.resource_mut::<Cables>().report_failure(error);
            true
        }
    };
    *world.resource_mut::<Pending>() = Pending { predicted: true, stopped: failed };
    if failed {
        set_active(world, false);
    }
}

/// The second half of a step.
fn after(world: &mut World) {
    let pending = core::mem::take(&mut *world.resource_mut::<Pending>());
    if pending.stopped {
        set_active(world, true);
    }
    if pending.predicted {
        with_physics(world, |world| world.run_schedule(AfterEngine));
    }
}

fn set_active(world: &mut World, active: bool) {
    let mut configs = world.query_filtered::<&mut RapierConfiguration, With<DefaultRapierContext>>();
    if let Ok(mut config) = configs.single_mut(world) {
        config.physics_pipeline_active = active;
    }
}
