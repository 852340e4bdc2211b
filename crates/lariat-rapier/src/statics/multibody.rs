//! The generalised coordinates of multibodies whose links statics moved.
//!
//! # Equation
//! With the poses of a link and of the one before it, and the frames of the joint between them,
//!
//! ```text
//! T = (parent frame1)^-1 (link frame2)
//! ```
//!
//! T holds the coordinates along the free axes, and the rotation of the joint. Rapier moves joints
//! by displacements of their coordinates: those from the present T to that of the new poses.

use crate::convert::{rotation, vector};
use ::nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use rapier::dynamics::{MultibodyIndex, MultibodyLink, RigidBodyHandle};
use rapier::math::{Pose, Real};
use rapier::pipeline::PhysicsWorld;

/// Moves the multibodies of links to the poses that these have, at rest.
pub(super) fn follow(world: &mut PhysicsWorld, links: impl Iterator<Item = RigidBodyHandle>) {
    let mut moved: Vec<MultibodyIndex> = Vec::new();
    for link in links {
        let Some(index) = world.multibody_joints.rigid_body_link(link).map(|link| link.multibody) else { continue };
        if !moved.contains(&index) {
            moved.push(index);
        }
    }
    for index in moved {
        let Some(multibody) = world.multibody_joints.get_multibody(index) else { continue };
        let pose = |link: &MultibodyLink| world.bodies[link.rigid_body_handle()].position();
        let parents = multibody.links().map(|link| link.parent_id().and_then(|parent| multibody.link(parent)));
        let ways =
            multibody.links().zip(parents).map(|(link, parent)| displacement(link, pose(link), parent.map(pose)));
        let displacements: Vec<Real> = ways.flatten().collect();
        let PhysicsWorld { bodies, multibody_joints, .. } = world;
        let Some(multibody) = multibody_joints.get_multibody_mut(index) else { continue };
        if displacements.len() == multibody.ndofs() {
            multibody.apply_displacements(&displacements);
        }
        multibody.generalized_velocity_mut().fill(0.0);
        multibody.forward_kinematics(bodies, true);
        multibody.update_rigid_bodies(bodies, true);
    }
}

/// Returns the displacements of the coordinates of a link's joint from where they are to where its
/// pose and that of its parent are.
fn displacement(link: &MultibodyLink, pose: &Pose, parent: Option<&Pose>) -> Vec<Real> {
    let joint = link.joint();
    let isometry =
        |pose: &Pose| Isometry3::from_parts(Translation3::from(vector(pose.translation)), rotation(pose.rotation));
    let frame = |pose: &Pose, frame: &Pose| isometry(pose) * isometry(frame);
    let first = parent.map_or_else(|| isometry(&joint.data.local_frame1), |p| frame(p, &joint.data.local_frame1));
    let to = first.inverse() * frame(pose, &joint.data.local_frame2);
    let free = |axis: usize| joint.data.locked_axes.bits() & (1 << axis) == 0;
    let turn: UnitQuaternion<f64> = to.rotation * rotation(joint.joint_rot()).inverse();
    let turn: Vector3<f64> = turn.scaled_axis();
    let coordinates = joint.coords();
    let along = (0..3).filter(|&axis| free(axis)).map(|axis| to.translation.vector[axis] as Real - coordinates[axis]);
    let about = (3..6).filter(|&axis| free(axis)).map(|axis| turn[axis - 3] as Real);
    along.chain(about).collect()
}
