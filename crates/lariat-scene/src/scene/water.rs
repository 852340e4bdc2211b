//! `[water]`: the water that cables and bodies are in; `[body.water]`: what it does to a body.

use super::Scene;
use super::body::{BodyKind, BodyShape};
use super::flow::{self, FLOW};
use crate::document::{Document, KeyPath};
use crate::error::Error;
use crate::schema::{ANY, Kind, NOT_NEGATIVE, POSITIVE, VECTOR, table};
use lariat_ancf::{Cable, Effects, Flow, Surface, Vector3, Water, Wave};
use serde::Deserialize;
use toml::Value;

table! {
    /// Water that cables and bodies are in. In it are the cables whose `drag` and `buoyancy` have no `fluid_density` of their own, and the
    /// bodies with `[body.water]`. Statics, and `initial = "equilibrium"`, are in it with its current, but without the wave.
    struct WaterTable("[water]") {
        /// Density.
        density: f64 = required, Kind::Number(POSITIVE), "kg/m^3";
        /// Height of the surface at rest above the origin, against gravity: above it is air, which does nothing.
        level: Option<f64> = ("none: the water is everywhere"), Kind::Number(ANY), "m";
        /// Velocity of the water: the same everywhere and always, or a table.
        current: Option<Value> = ("at rest"), Kind::Either(&[VECTOR, Kind::Table(&FLOW)]), "m/s";
        /// A wave on the surface, beside `level`; its motion is added to the current.
        wave: Option<WaveTable> = ("none"), Kind::Table(&WaveTable::TABLE);
    }
}

table! {
    /// A linear regular wave (Airy), a crest of which is over the origin at t = 0. Beyond a steepness of 0.142 pi tanh(k d) it would break.
    struct WaveTable("[water.wave]") {
        /// Half the height from trough to crest.
        amplitude: f64 = required, Kind::Number(POSITIVE), "m";
        /// Period that a fixed observer sees.
        period: f64 = required, Kind::Number(POSITIVE), "s";
        /// Direction in which it goes; what of it is along the surface counts.
        direction: Vector3<f64> = required, VECTOR;
        /// Phase: the crest is where k x + phase = 0.
        phase: f64 = 0.0, Kind::Number(ANY), "rad";
        /// Depth of the water.
        depth: Option<f64> = ("deep"), Kind::Number(POSITIVE), "m";
    }
}

table! {
    /// What the water of `[water]` does to a dynamic body: buoyancy of what is below the surface, drag, added mass, and the forces of the wave. Its
    /// numbers are about the axes of the body.
    struct BodyWaterTable("[body.water]") {
        /// Displaced volume.
        volume: Option<f64> = ("that of the shape; required without one"), Kind::Number(POSITIVE.single()), "m^3";
        /// Drag coefficient times area: one number, or one for each axis of the body, through its centre of mass: it makes no moment. Of a body that floats it is the area at its draught; where it is less deep, drag is less.
        drag_area: Option<OneOrAxes> = ("0"), Kind::Either(&[Kind::Number(NOT_NEGATIVE.single()), Kind::Numbers(&["x", "y", "z"], NOT_NEGATIVE.single())]), "m^2";
        /// Drag of rotation: the moment is half of it times the density times the angular velocity squared.
        rotational_drag: Option<[f64; 3]> = ("0"), Kind::Numbers(&["x", "y", "z"], NOT_NEGATIVE.single()), "m^5";
        /// Coefficient of added mass on the mass of water that it displaces when it floats, or all of it if it sinks: one number, or one for each axis of the body. It has none in air.
        added_mass: Option<OneOrAxes> = ("0"), Kind::Either(&[Kind::Number(NOT_NEGATIVE.single()), Kind::Numbers(&["x", "y", "z"], NOT_NEGATIVE.single())]);
    }
}

/// A number in all directions or by axis, as a scene writes it.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
pub enum OneOrAxes {
    /// In all directions.
    One(f64),
    /// By axis.
    Axes([f64; 3]),
}

impl OneOrAxes {
    fn axes(self) -> Vector3<f64> {
        match self {
            OneOrAxes::One(number) => Vector3::repeat(number),
            OneOrAxes::Axes(axes) => axes.into(),
        }
    }
}

/// A checked body in water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyWater {
    /// Displaced volume in m^3; `None` = that of the shape.
    pub volume: Option<f64>,
    /// Drag coefficient times area by axis in m^2.
    pub drag_area: Vector3<f64>,
    /// Drag of rotation by axis in m^5.
    pub rotational_drag: Vector3<f64>,
    /// Coefficients of added mass by axis.
    pub added_mass: Vector3<f64>,
}

/// Returns effects in water without its wave, as statics have them; `None` if there is no wave.
pub fn without_wave(effects: &Effects) -> Option<Effects> {
    let mut still = effects.clone();
    let of_drag = surface_of_drag(&mut still).and_then(|surface| surface.wave.take()).is_some();
    let buoyancy = still.buoyancy.as_mut().and_then(|buoyancy| buoyancy.surface.as_mut());
    let of_buoyancy = buoyancy.and_then(|surface| surface.wave.take()).is_some();
    (of_drag || of_buoyancy).then_some(still)
}

impl Scene {
    /// Puts a cable that statics left in still water back into the wave.
    pub fn add_wave(&self, cable: &mut Cable, index: usize) -> Result<(), Error> {
        let (own, mut effects) = (&self.cables[index].effects, cable.effects().clone());
        let of_own = own.drag.as_ref().and_then(|drag| drag.flow.surface.as_deref());
        if let (Some(to), Some(from)) = (surface_of_drag(&mut effects), of_own) {
            to.wave = from.wave;
        }
        if let (Some(to), Some(from)) = (&mut effects.buoyancy, &own.buoyancy) {
            to.surface = from.surface;
        }
        if effects != *cable.effects() {
            cable.set_effects(effects)?;
        }
        Ok(())
    }
}

fn surface_of_drag(effects: &mut Effects) -> Option<&mut Surface> {
    effects.drag.as_mut()?.flow.surface.as_deref_mut()
}

/// Reads the water of a scene.
pub(super) fn read(
    doc: &Document<'_>,
    table: Option<WaterTable>,
    gravity: Vector3<f64>,
) -> Result<Option<Water>, Error> {
    let Some(WaterTable { density, level, current, wave }) = table else { return Ok(None) };
    let at = KeyPath::root("water");
    let mut water = Water::new(density);
    if let Some(mut current) = current {
        let at = at.key("current");
        flow::write_out(doc, &at, &mut current)?;
        water = water.with_flow(doc.typed::<Flow>(&at, current)?);
    }
    let Some(level) = level else {
        return match wave {
            Some(_) => Err(doc.conflict(&at.key("wave"), "a wave needs a surface: give the level of the water")),
            None => Ok(Some(water)),
        };
    };
    if gravity == Vector3::zeros() {
        return Err(doc.conflict(&at.key("level"), "without gravity water has no level"));
    }
    let mut surface = Surface::at(level, gravity);
    if let Some(WaveTable { amplitude, period, direction, phase, depth }) = wave {
        surface = surface.with_wave(Wave { amplitude, period, direction, phase, depth });
    }
    surface.check().map_err(|error| doc.conflict(&at.key("wave"), error.to_string()))?;
    Ok(Some(water.with_surface(surface)))
}

/// Reads what water does to the body at a path of keys.
pub(super) fn of_body(
    doc: &Document<'_>,
    at: &KeyPath,
    table: Option<BodyWaterTable>,
    (kind, shape, water): (BodyKind, &BodyShape, Option<&Water>),
) -> Result<Option<BodyWater>, Error> {
    let Some(BodyWaterTable { volume, drag_area, rotational_drag, added_mass }) = table else { return Ok(None) };
    if water.is_none() {
        return Err(doc.conflict(at, "the scene has no water: add [water]"));
    }
    if kind != BodyKind::Dynamic {
        return Err(doc.conflict(at, format!("a {} body is not moved by water", kind.name())));
    }
    if matches!(shape, BodyShape::None) && volume.is_none() {
        return Err(doc.missing(&at.key("volume")));
    }
    let [drag_area, added_mass] = [drag_area, added_mass].map(|given| given.map_or(Vector3::zeros(), OneOrAxes::axes));
    let rotational_drag = rotational_drag.unwrap_or_default().into();
    Ok(Some(BodyWater { volume, drag_area, rotational_drag, added_mass }))
}

/// Writes the water of the scene into an effect of a cable that has no `fluid_density` of its own; returns whether it did.
///
/// # Errors
/// The missing key, of a scene without water.
pub(super) fn write_into(
    doc: &Document<'_>,
    at: &KeyPath,
    value: &mut Value,
    water: Option<&Water>,
) -> Result<bool, Error> {
    let Some(effect) = value.as_table_mut().filter(|effect| !effect.contains_key("fluid_density")) else {
        return Ok(false);
    };
    let water = water.ok_or_else(|| doc.missing(&at.key("fluid_density")))?;
    effect.insert("fluid_density".to_string(), Value::Float(water.density));
    Ok(true)
}

/// Returns a value of the mechanics as TOML.
pub(super) fn as_toml<T: serde::Serialize>(doc: &Document<'_>, at: &KeyPath, value: &T) -> Result<Value, Error> {
    Value::try_from(value).map_err(|error| doc.conflict(at, error.to_string()))
}
