//! Colliders of a world.

use super::bodies::{Handle, collider_handle, invalid, not_negative, parameters, positive, single};
use super::queries::{combine_rule, groups};
use super::{Contents, World};
use crate::error::{Raise, raise};
use lariat_ancf::Vector3;
use lariat_rapier::Error;
use lariat_rapier::rapier::geometry::{ColliderBuilder, SharedShape};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Deserialize;

/// What a builder of a collider collects.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColliderParameters {
    shape: String,
    size: Vec<f64>,
    #[serde(default)]
    translation: [f64; 3],
    #[serde(default)]
    rotation: [f64; 3],
    mass: Option<f64>,
    density: Option<f64>,
    friction: Option<f64>,
    restitution: Option<f64>,
    friction_combine_rule: Option<String>,
    collision_groups: Option<(u32, u32)>,
    solver_groups: Option<(u32, u32)>,
    #[serde(default)]
    indices: Vec<[u32; 3]>,
    #[serde(default)]
    sensor: bool,
}

impl ColliderParameters {
    /// Returns the builder of Rapier.
    pub fn builder(&self) -> PyResult<ColliderBuilder> {
        let mut builder = self.shape()?;
        builder = builder
            .translation(single("translation (m)", self.translation.into())?)
            .rotation(single("rotation (rad)", self.rotation.into())?)
            .sensor(self.sensor);
        if let Some(density) = self.density {
            builder = builder.density(not_negative("density (kg/m^3)", density)?);
        }
        if let Some(mass) = self.mass {
            builder = builder.mass(not_negative("mass (kg)", mass)?);
        }
        if let Some(friction) = self.friction {
            builder = builder.friction(not_negative("friction", friction)?);
        }
        if let Some(restitution) = self.restitution {
            builder = builder.restitution(not_negative("restitution", restitution)?);
        }
        if let Some(rule) = &self.friction_combine_rule {
            builder = builder.friction_combine_rule(combine_rule(rule)?);
        }
        if let Some(given) = self.collision_groups {
            builder = builder.collision_groups(groups(given));
        }
        if let Some(given) = self.solver_groups {
            builder = builder.solver_groups(groups(given));
        }
        Ok(builder)
    }

    fn shape(&self) -> PyResult<ColliderBuilder> {
        let wrong = |message: String| raise(Raise::new("BuilderError", message));
        let vectors = || self.size.chunks_exact(3).map(|v| single("point (m)", Vector3::from_column_slice(v)));
        match (self.shape.as_str(), &self.size[..]) {
            ("halfspace", &[x, y, z]) => {
                let normal = Vector3::new(x, y, z);
                let unit = normal.try_normalize(1e-9).filter(|unit| unit.iter().all(|x| x.is_finite()));
                let unit = unit.ok_or_else(|| invalid("length of the normal", normal.norm(), "> 0"))?;
                return Ok(ColliderBuilder::new(SharedShape::halfspace(single("normal", unit)?)));
            }
            ("convex_hull", _) => {
                let points = vectors().collect::<PyResult<Vec<_>>>()?;
                let flat = || wrong(format!("{} points have no convex hull with a volume", points.len()));
                if points.len() < 4 {
                    return Err(flat());
                }
                return ColliderBuilder::convex_hull(&points).ok_or_else(flat);
            }
            ("trimesh", _) => {
                let points = vectors().collect::<PyResult<Vec<_>>>()?;
                if let Some(index) = self.indices.iter().flatten().find(|i| **i as usize >= points.len()) {
                    return Err(wrong(format!("a triangle has vertex {index}, of {}", points.len())));
                }
                return ColliderBuilder::trimesh(points, self.indices.clone()).map_err(|e| wrong(e.to_string()));
            }
            _ => {}
        }
        let size = self.size.iter().map(|&x| positive("size of the collider (m)", x)).collect::<PyResult<Vec<_>>>()?;
        Ok(match (self.shape.as_str(), &size[..]) {
            ("cuboid", &[x, y, z]) => ColliderBuilder::cuboid(x, y, z),
            ("ball", &[radius]) => ColliderBuilder::ball(radius),
            ("cylinder", &[half, radius]) => ColliderBuilder::cylinder(half, radius),
            ("cone", &[half, radius]) => ColliderBuilder::cone(half, radius),
            ("capsule_x", &[half, radius]) => ColliderBuilder::capsule_x(half, radius),
            ("capsule_y", &[half, radius]) => ColliderBuilder::capsule_y(half, radius),
            ("capsule_z", &[half, radius]) => ColliderBuilder::capsule_z(half, radius),
            (shape, _) => return Err(wrong(format!("unknown shape {shape:?}"))),
        })
    }
}

#[pymethods]
impl World {
    /// Inserts a collider, on a body or fixed in the world.
    fn _add_collider(
        &self,
        py: Python<'_>,
        collider: &Bound<'_, PyDict>,
        body: Option<Handle>,
    ) -> PyResult<(u32, u32)> {
        let collider = parameters::<ColliderParameters>(collider)?.builder()?;
        let added = self.0.compute(py, |Contents { world, .. }| {
            if let Some(body) = body {
                world.bodies.get(body.0).ok_or(Error::NoBody(body.0))?;
            }
            Ok(world.insert_collider(collider, body.map(|body| body.0)).into_raw_parts())
        });
        added.map_err(raise::<Error>)
    }

    /// Adds a collider to a body, or one fixed in the world. Raises NoBodyError, BuilderError,
    /// InvalidValueError.
    #[pyo3(signature = (builder, parent=None))]
    fn add_collider<'py>(
        slf: &Bound<'py, Self>,
        builder: &Bound<'py, PyAny>,
        parent: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("lariat_cables.bodies")?.getattr("add_collider")?.call1((slf, builder, parent))
    }

    /// Removes a collider. Raises NoColliderError.
    fn remove_collider(&self, py: Python<'_>, handle: (u32, u32)) -> PyResult<()> {
        let handle = collider_handle(handle);
        let removed = self.0.compute(py, |Contents { world, .. }| world.remove_collider(handle).map(|_| ()));
        let none = || raise(Raise::new("NoColliderError", format!("no collider {handle:?} in this world")));
        removed.ok_or_else(none)
    }
}
