//! From joints of a scene to joints of Rapier.

use crate::scene::{JointKind, Scene};
use lariat_ancf::Vector3;
use lariat_rapier::convert::to_pose;
use lariat_rapier::rapier::dynamics::{GenericJoint, GenericJointBuilder, JointAxesMask, RigidBodyHandle};
use lariat_rapier::rapier::prelude::{PhysicsWorld, RigidBodyBuilder};
use nalgebra::UnitQuaternion;

/// Inserts the joints of a scene between its bodies as drawn.
///
/// # Errors
/// Name of the body and a reason, for a joint that Rapier rejects; not for a checked scene.
pub fn insert(world: &mut PhysicsWorld, scene: &Scene, bodies: &[RigidBodyHandle]) -> Result<(), (String, String)> {
    let mut ground = None;
    for joint in &scene.joints {
        let (first, pose) = match joint.to {
            Some(body) => (bodies[body], scene.bodies[body].pose(0.0)),
            None => {
                let ground = *ground.get_or_insert_with(|| world.insert_body(RigidBodyBuilder::fixed()));
                (ground, (Vector3::zeros(), UnitQuaternion::identity()))
            }
        };
        let (axes, axis) = match joint.kind {
            JointKind::Hinge(axis) => (JointAxesMask::LOCKED_REVOLUTE_AXES, axis),
            JointKind::Slider(axis) => (JointAxesMask::LOCKED_PRISMATIC_AXES, axis),
            JointKind::Ball => (JointAxesMask::LOCKED_SPHERICAL_AXES, Vector3::x()),
            JointKind::Fixed => (JointAxesMask::LOCKED_FIXED_AXES, Vector3::x()),
        };
        // the free axis of Rapier's joints is the x axis of the joint frame
        let to_axis = UnitQuaternion::rotation_between(&Vector3::x(), &axis)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::PI));
        let local = |(position, rotation): (Vector3<f64>, UnitQuaternion<f64>)| {
            let back = rotation.inverse();
            to_pose(&(back * (joint.point - position)), &(back * to_axis))
        };
        let built: GenericJoint = GenericJointBuilder::new(axes)
            .local_frame1(local(pose))
            .local_frame2(local(scene.bodies[joint.body].pose(0.0)))
            .contacts_enabled(false)
            .build();
        let second = bodies[joint.body];
        if !joint.multibody {
            world.insert_impulse_joint(first, second, built);
            continue;
        }
        let Some(handle) = world.multibody_joints.insert(first, second, built, true) else {
            return Err((scene.bodies[joint.body].name.clone(), format!("Rapier rejects the joint {:?}", joint.name)));
        };
        // Rapier's own damping of 0.1 N m s would make it another joint than without `multibody`
        if let Some((multibody, _)) = world.multibody_joints.get_mut(handle) {
            multibody.damping_mut().fill(0.0);
        }
    }
    Ok(())
}
