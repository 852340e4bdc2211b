//! From bodies of a scene to bodies of Rapier.

use crate::scene::body::{BodyKind, BodyMass, BodyScene, BodyShape};
use lariat_rapier::convert::{rotation, to_pose, to_vector, vector};
use lariat_rapier::rapier::dynamics::{MassProperties, RigidBody as RapierBody, RigidBodyHandle};
use lariat_rapier::rapier::math::{Real, Vector};
use lariat_rapier::rapier::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder};

/// Returns the collider of a body, with its mass; `None` if it has no shape.
///
/// # Errors
/// In words, for a mesh that is not a shape, or a mass beyond single precision.
pub fn collider(body: &BodyScene) -> Result<Option<ColliderBuilder>, String> {
    let real = |x: f64| x as Real;
    let builder = match &body.shape {
        BodyShape::None => {
            let mass = match body.mass {
                Some(BodyMass::Mass(mass) | BodyMass::Density(mass)) => mass,
                None => return Ok(None),
            };
            let heavy = [mass].into_iter().chain(body.inertia.iter().flatten().copied());
            if !heavy.map(real).all(|x| x.recip().is_finite()) {
                return Err("its mass is beyond single precision".to_string());
            }
            return Ok(None);
        }
        BodyShape::Cuboid(half) => ColliderBuilder::cuboid(real(half.x), real(half.y), real(half.z)),
        BodyShape::Ball(radius) => ColliderBuilder::ball(real(*radius)),
        BodyShape::Cylinder([half, radius]) => ColliderBuilder::cylinder(real(*half), real(*radius)),
        BodyShape::Capsule([half, radius]) => ColliderBuilder::capsule_y(real(*half), real(*radius)),
        BodyShape::Plane(normal) => {
            ColliderBuilder::new(lariat_rapier::rapier::geometry::SharedShape::halfspace(to_vector(normal)))
        }
        BodyShape::Mesh(mesh) => {
            let corners: Vec<Vector> = mesh.vertices.iter().map(|x| to_vector(&(*x).into())).collect();
            if body.kind == BodyKind::Dynamic {
                ColliderBuilder::convex_hull(&corners).ok_or("the mesh has no convex hull")?
            } else {
                ColliderBuilder::trimesh(corners, mesh.triangles.clone()).map_err(|error| error.to_string())?
            }
        }
    };
    let builder = match body.friction {
        Some(friction) => builder.friction(real(friction)),
        None => builder,
    };
    let builder = builder.restitution(real(body.restitution));
    let builder = match body.mass {
        None => return Ok(Some(builder.density(0.0))),
        Some(BodyMass::Mass(mass)) => builder.mass(real(mass)),
        Some(BodyMass::Density(density)) => builder.density(real(density)),
    };
    let own = has_mass(&builder)?;
    match body.inertia {
        None => Ok(Some(builder)),
        Some(moments) => {
            let builder = builder.mass_properties(MassProperties::new(own.local_com, own.mass(), to_vector(&moments)));
            has_mass(&builder)?;
            Ok(Some(builder))
        }
    }
}

/// Returns the mass of a collider, if a body can move with it.
fn has_mass(builder: &ColliderBuilder) -> Result<MassProperties, String> {
    let of = |builder: ColliderBuilder| builder.build().mass_properties();
    let (solid, has) = (of(builder.clone().density(1.0)), of(builder.clone()));
    let inverse = has.inv_principal_inertia;
    let fine = |x: Real| x > 0.0 && x.is_finite();
    if [solid.inv_mass, has.inv_mass, inverse.x, inverse.y, inverse.z].into_iter().all(fine)
        && has.local_com.is_finite()
    {
        Ok(has)
    } else {
        Err("the shape encloses no volume, or its mass is beyond single precision".to_string())
    }
}

/// Inserts a body as drawn.
///
/// # Errors
/// As [`collider`]; not for a checked scene.
pub fn insert(world: &mut PhysicsWorld, body: &BodyScene) -> Result<RigidBodyHandle, String> {
    let builder = match body.kind {
        BodyKind::Dynamic => RigidBodyBuilder::dynamic(),
        BodyKind::Fixed => RigidBodyBuilder::fixed(),
        BodyKind::Kinematic => RigidBodyBuilder::kinematic_position_based(),
    };
    // a limit of 45 degrees in each step would change the motion silently
    let (position, rotation) = body.pose(0.0);
    let mut builder = builder.pose(to_pose(&position, &rotation)).allow_fast_rotation(true).can_sleep(false);
    let collider = collider(body)?;
    if let (None, Some(BodyMass::Mass(mass))) = (&collider, body.mass) {
        let moments = body.inertia.map_or(Vector::ZERO, |moments| to_vector(&moments));
        builder = builder.additional_mass_properties(MassProperties::new(Vector::ZERO, mass as Real, moments));
    }
    let handle = world.insert_body(builder);
    if let Some(collider) = collider {
        world.insert_collider(collider, Some(handle));
    }
    if body.kind == BodyKind::Dynamic {
        let inserted = &mut world.bodies[handle];
        inserted.recompute_mass_properties_from_colliders(&world.colliders);
        set_in_motion(inserted, body);
    }
    Ok(handle)
}

/// Sets a dynamic body in motion as the scene says.
pub fn set_in_motion(inserted: &mut RapierBody, body: &BodyScene) {
    let course = &body.course;
    // Rapier's velocity is that of the centre of mass
    let arm = rotation(*inserted.rotation()) * vector(inserted.local_center_of_mass());
    inserted.set_linvel(to_vector(&(course.velocity + course.angular_velocity.cross(&arm))), true);
    inserted.set_angvel(to_vector(&course.angular_velocity), true);
}
