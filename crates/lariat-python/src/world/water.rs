//! The water that bodies of a world are in.

use super::bodies::Handle;
use super::{Contents, World};
use crate::convert::{Vector, data};
use crate::error::{Raise, raise};
use lariat_ancf::{Flow, Surface, Vector3, Water, Wave};
use lariat_rapier::Error;
use lariat_rapier::convert;
use lariat_rapier::water::{BodiesInWater, Immersed};
use pyo3::prelude::*;
use serde::Deserialize;

/// What `lariat.Water` holds.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    density: f64,
    level: Option<f64>,
    wave: Option<Wave>,
    flow: Flow,
}

/// A number in all directions, or one for each axis of a body.
struct OneOrAxes(Vector3<f64>);

impl<'a, 'py> FromPyObject<'a, 'py> for OneOrAxes {
    type Error = PyErr;
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        match f64::extract(object) {
            Ok(number) => Ok(OneOrAxes(Vector3::repeat(number))),
            Err(_) => Vector::extract(object).map(|axes| OneOrAxes(axes.0)),
        }
    }
}

impl Parameters {
    fn water(self, gravity: Vector3<f64>) -> Water {
        let mut flow = self.flow;
        if let Some(level) = self.level {
            let surface = Surface::at(level, gravity);
            flow.surface = Some(Box::new(match self.wave {
                Some(wave) => surface.with_wave(wave),
                None => surface,
            }));
        }
        Water::new(self.density).with_flow(flow)
    }
}

impl Contents {
    fn set_water(&mut self, water: Option<Parameters>) -> Result<(), Error> {
        let Contents { world, set, time, .. } = self;
        match water.map(|own| own.water(convert::vector(world.gravity))) {
            None => {
                if let Some(mut water) = set.set_water(None) {
                    let bodies: Vec<_> = water.bodies().collect();
                    bodies.into_iter().for_each(|body| _ = water.remove(world, body));
                }
            }
            Some(water) => match set.water_mut() {
                Some(own) => own.set_water(water)?,
                None => {
                    let mut new = BodiesInWater::new(water)?;
                    new.set_time(*time);
                    set.set_water(new);
                }
            },
        }
        Ok(())
    }
}

#[pymethods]
impl World {
    /// Sets the water of the world; bodies that are in it stay, with their added mass. None takes
    /// it away, with all that is in it. Raises InvalidValueError.
    fn set_water(&self, py: Python<'_>, water: &Bound<'_, PyAny>) -> PyResult<()> {
        let parameters = if water.is_none() {
            None
        } else {
            let plain = py.import("lariat_cables.water")?.getattr("plain")?.call1((water,))?;
            let wrong = |error: serde_json::Error| raise(Raise::new("BuilderError", error.to_string()));
            Some(serde_json::from_value::<Parameters>(data(&plain)?).map_err(wrong)?)
        };
        self.0.compute(py, |contents| contents.set_water(parameters)).map_err(raise)
    }

    /// Puts a dynamic body into the water: buoyancy, the forces of its wave, drag, and added mass.
    ///
    /// ``drag_area`` is drag coefficient times area (m^2), ``spin_drag`` the coefficient of the
    /// quadratic drag of rotation (m^5), both (3,) along the axes of the body, none by default.
    /// ``added_mass`` is the coefficient on the mass that it displaces, 0.5 of a sphere: a number,
    /// or (3,) along the axes of the body. ``volume`` (m^3) is by default that of its colliders.
    /// The body has now its mass and colliders; call it again after they change. Raises
    /// NoWaterError, NoBodyError, NotDynamicError, WaterValueError, NoVolumeError.
    #[pyo3(signature = (body, drag_area=None, *, spin_drag=None, added_mass=None, volume=None))]
    fn immerse(
        &self,
        py: Python<'_>,
        body: Handle,
        drag_area: Option<Vector>,
        spin_drag: Option<Vector>,
        added_mass: Option<OneOrAxes>,
        volume: Option<f64>,
    ) -> PyResult<()> {
        let zero = Vector3::zeros();
        let [drag_area, spin_drag] = [drag_area, spin_drag].map(|given| given.map_or(zero, |v| v.0));
        let added_mass = added_mass.map_or(zero, |given| given.0);
        let immersed = Immersed { volume, drag_area, spin_drag, added_mass };
        let put = self.0.compute(py, |Contents { world, set, .. }| {
            set.water_mut().map(|water| water.insert(world, body.0, immersed))
        });
        let none = || raise(Raise::new("NoWaterError", "the world has no water: call set_water first".to_string()));
        put.ok_or_else(none)?.map_err(raise)
    }

    /// Takes a body out of the water, with its added mass; returns whether it was in it. Raises
    /// TypeError for what is no handle.
    fn emerge(&self, py: Python<'_>, body: Handle) -> bool {
        self.0
            .compute(py, |Contents { world, set, .. }| set.water_mut().is_some_and(|water| water.remove(world, body.0)))
    }

    /// Returns the work of the water in J on a body since it is in it; None for one that is not.
    /// Raises TypeError for what is no handle.
    fn water_work(&self, py: Python<'_>, body: Handle) -> Option<f64> {
        self.0.with(py, |contents| contents.set.water()?.work(body.0))
    }
}
