//! Rays and points against the colliders of a world, and what its cables touch.

use super::World;
use super::bodies::{Handle, collider_handle, positive, single};
use crate::cable::{Cable, contact};
use crate::convert::{Vector, result, vector};
use crate::error::{Raise, raise};
use lariat_rapier::convert::vector as double;
use lariat_rapier::rapier::dynamics::CoefficientCombineRule;
use lariat_rapier::rapier::geometry::{ColliderHandle, Group, InteractionGroups, InteractionTestMode, Ray};
use lariat_rapier::rapier::math::Real;
use lariat_rapier::rapier::pipeline::QueryFilter;
use lariat_rapier::{ContactRules, Error};
use pyo3::prelude::*;

/// Returns groups from (memberships, filter).
pub fn groups((memberships, filter): (u32, u32)) -> InteractionGroups {
    let [memberships, filter] = [memberships, filter].map(Group::from_bits_retain);
    InteractionGroups::new(memberships, filter, InteractionTestMode::And)
}

/// Returns a rule of combination by its name.
pub fn combine_rule(name: &str) -> PyResult<CoefficientCombineRule> {
    Ok(match name {
        "average" => CoefficientCombineRule::Average,
        "min" => CoefficientCombineRule::Min,
        "multiply" => CoefficientCombineRule::Multiply,
        "max" => CoefficientCombineRule::Max,
        _ => {
            let message = format!("expected \"average\", \"min\", \"multiply\" or \"max\", got {name:?}");
            return Err(raise(Raise::new("BuilderError", message)));
        }
    })
}

fn filter(exclude: Option<Handle>) -> QueryFilter<'static> {
    exclude.map_or(QueryFilter::default(), |body| QueryFilter::default().exclude_rigid_body(body.0))
}

/// Returns a ray and its largest time of impact.
fn ray(origin: Vector, direction: Vector, max_toi: f64) -> PyResult<(Ray, Real)> {
    let ray = Ray::new(single("origin (m)", origin.0)?, single("direction", direction.0)?);
    Ok((ray, positive("max_toi", max_toi)?))
}

fn handle<'py>(py: Python<'py>, handle: ColliderHandle) -> PyResult<Bound<'py, PyAny>> {
    result(py, "ColliderHandle", handle.into_raw_parts())
}

#[pymethods]
impl World {
    /// Lets a cable touch the colliders, and other cables and itself if the contact says so, or no
    /// longer with None; it gets the integrator "discrete-gradient" if nobody chose one. Raises
    /// InvalidValueError, MissingForEffectError (no diameter and no radius), ContactMethodError,
    /// NoCableError.
    #[pyo3(signature = (cable, contact))]
    fn set_contact(&self, py: Python<'_>, cable: &Cable, contact: &Bound<'_, PyAny>) -> PyResult<()> {
        let (handle, contact) = (cable.handle_in(&self.0)?, contact::effect(contact)?);
        self.0.compute(py, |contents| contents.set.set_contact(handle, contact)).map_err(raise)
    }

    /// Sets the groups of a cable as bits (memberships, filter), None: all; and how its friction
    /// and restitution are combined with those of colliders. Raises OtherWorldError, NoCableError.
    #[pyo3(signature = (cable, *, collision_groups=None, solver_groups=None, friction_combine_rule="average", restitution_combine_rule="average"))]
    fn set_contact_rules(
        &self,
        py: Python<'_>,
        cable: &Cable,
        collision_groups: Option<(u32, u32)>,
        solver_groups: Option<(u32, u32)>,
        friction_combine_rule: &str,
        restitution_combine_rule: &str,
    ) -> PyResult<()> {
        let handle = cable.handle_in(&self.0)?;
        let rules = ContactRules {
            collision_groups: collision_groups.map_or(InteractionGroups::all(), groups),
            solver_groups: solver_groups.map_or(InteractionGroups::all(), groups),
            friction_combine_rule: combine_rule(friction_combine_rule)?,
            restitution_combine_rule: combine_rule(restitution_combine_rule)?,
        };
        self.0.compute(py, |contents| contents.set.set_contact_rules(handle, rules)).map_err(raise)
    }

    /// Returns what a cable touched at the end of the last step, each with its collider. Raises
    /// OtherWorldError, NoCableError.
    fn contacts<'py>(&self, py: Python<'py>, cable: &Cable) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let of = cable.handle_in(&self.0)?;
        let touches = self.0.with(py, |contents| Ok(contents.set.contacts(of)?.collect::<Vec<_>>()));
        let touches = touches.map_err(raise::<Error>)?;
        touches.iter().map(|(collider, touch)| contact::touch(py, touch, handle(py, *collider)?)).collect()
    }

    /// Returns the body of a collider; None for one without. Raises NoColliderError.
    fn collider_parent<'py>(&self, py: Python<'py>, collider: (u32, u32)) -> PyResult<Option<Bound<'py, PyAny>>> {
        let collider = collider_handle(collider);
        let parent = self.0.with(py, |contents| contents.world.colliders.get(collider).map(|found| found.parent()));
        let none = || raise(Raise::new("NoColliderError", format!("no collider {collider:?} in this world")));
        parent.ok_or_else(none)?.map(|body| result(py, "RigidBodyHandle", body.into_raw_parts())).transpose()
    }

    /// Returns the first collider on the ray ``origin + t direction`` (m), and its t up to
    /// ``max_toi``; None if there is none. With ``solid`` a ray from inside meets it at 0, else its
    /// far side. Queries see colliders as of the last step. Raises InvalidValueError.
    #[pyo3(signature = (origin, direction, max_toi, solid=true, *, exclude_rigid_body=None))]
    fn cast_ray<'py>(
        &self,
        py: Python<'py>,
        origin: Vector,
        direction: Vector,
        max_toi: f64,
        solid: bool,
        exclude_rigid_body: Option<Handle>,
    ) -> PyResult<Option<(Bound<'py, PyAny>, f64)>> {
        let (ray, most) = ray(origin, direction, max_toi)?;
        let found = self.0.with(py, |contents| contents.world.cast_ray(&ray, most, solid, filter(exclude_rigid_body)));
        found.map(|(collider, toi)| Ok((handle(py, collider)?, f64::from(toi)))).transpose()
    }

    /// As ``cast_ray``, with the normal. Raises InvalidValueError.
    #[pyo3(signature = (origin, direction, max_toi, solid=true, *, exclude_rigid_body=None))]
    fn cast_ray_and_get_normal<'py>(
        &self,
        py: Python<'py>,
        origin: Vector,
        direction: Vector,
        max_toi: f64,
        solid: bool,
        exclude_rigid_body: Option<Handle>,
    ) -> PyResult<Option<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
        let (ray, most) = ray(origin, direction, max_toi)?;
        let found = self
            .0
            .with(py, |contents| contents.world.cast_ray_and_get_normal(&ray, most, solid, filter(exclude_rigid_body)));
        found
            .map(|(collider, hit)| {
                let hit = (f64::from(hit.time_of_impact), vector(py, &double(hit.normal)));
                Ok((handle(py, collider)?, result(py, "RayIntersection", hit)?))
            })
            .transpose()
    }

    /// Returns the collider nearest to a point (m) within ``max_dist``, and its nearest point; None
    /// if there is none. With ``solid`` a point inside is its own projection. Raises ShapeError,
    /// InvalidValueError.
    #[pyo3(signature = (point, solid=true, *, max_dist=1e15, exclude_rigid_body=None))]
    fn project_point<'py>(
        &self,
        py: Python<'py>,
        point: Vector,
        solid: bool,
        max_dist: f64,
        exclude_rigid_body: Option<Handle>,
    ) -> PyResult<Option<(Bound<'py, PyAny>, Bound<'py, PyAny>)>> {
        let (point, most) = (single("point (m)", point.0)?, positive("max_dist (m)", max_dist)?);
        let found =
            self.0.with(py, |contents| contents.world.project_point(point, most, solid, filter(exclude_rigid_body)));
        found
            .map(|(collider, at)| {
                let at = (at.is_inside, vector(py, &double(at.point)));
                Ok((handle(py, collider)?, result(py, "PointProjection", at)?))
            })
            .transpose()
    }

    /// Returns the colliders that contain a point (m). Raises ShapeError, InvalidValueError.
    #[pyo3(signature = (point, *, exclude_rigid_body=None))]
    fn intersect_point<'py>(
        &self,
        py: Python<'py>,
        point: Vector,
        exclude_rigid_body: Option<Handle>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let point = single("point (m)", point.0)?;
        let found = self.0.with(py, |contents| {
            let found = contents.world.intersect_point(point, filter(exclude_rigid_body));
            found.map(|(collider, _)| collider).collect::<Vec<_>>()
        });
        found.into_iter().map(|collider| handle(py, collider)).collect()
    }
}
