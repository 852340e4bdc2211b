//! The effects of a `[[cable]]`: a table each, read into the types of the mechanics.
//!
//! The mechanics' types are the tables. Where the format has a shorter form (a flow by three numbers, a wind by a power law, a
//! rest shape of the whole cable) it is written out before serde reads it.

use super::flow::{self, FLOW};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{ANY, Choose, Default, Key, Kind, NOT_NEGATIVE, POSITIVE, VECTOR, table};
use lariat_ancf::{
    BendingRule, Buoyancy, Damping, Drag, Effects, GravityScale, LineLoad, RestPiece, RestShape, Rule, Section,
};
use serde::de::DeserializeOwned;
use toml::Value;

/// What effects need to know of their cable.
pub(super) struct Context<'c> {
    /// Section.
    pub section: &'c Section,
    /// Force strategy.
    pub rule: Rule,
    /// Unstretched length in m.
    pub length: f64,
}

/// An effect that a scene can switch on.
trait SceneEffect: Sized {
    /// Its key of `[[cable]]`.
    const KEY: Key;

    /// Reads its value, which the schema has accepted.
    fn read(doc: &Document<'_>, at: &KeyPath, value: Value, cable: &Context<'_>) -> Result<Self, Error>;
}

/// The keys of all effects.
pub(super) const EFFECTS: &[Key] =
    &[Damping::KEY, Drag::KEY, Buoyancy::KEY, RestShape::KEY, <Vec<LineLoad>>::KEY, GravityScale::KEY];

/// Reads the effects of the cable at a path from its remaining keys.
pub(super) fn read(doc: &Document<'_>, at: &KeyPath, mut rows: toml::Table, cable: &Context<'_>) -> Result<Effects, Error> {
    Ok(Effects {
        damping: one(doc, at, &mut rows, cable)?,
        drag: one(doc, at, &mut rows, cable)?,
        buoyancy: one(doc, at, &mut rows, cable)?,
        rest_shape: one(doc, at, &mut rows, cable)?,
        line_loads: one(doc, at, &mut rows, cable)?.unwrap_or_default(),
        gravity_scale: one(doc, at, &mut rows, cable)?.unwrap_or_default(),
    })
}

fn one<T: SceneEffect>(
    doc: &Document<'_>,
    at: &KeyPath,
    rows: &mut toml::Table,
    cable: &Context<'_>,
) -> Result<Option<T>, Error> {
    let value = rows.remove(T::KEY.name);
    value.map(|value| T::read(doc, &at.key(T::KEY.name), value, cable)).transpose()
}

/// Reads a value into a type.
pub(super) fn typed<T: DeserializeOwned>(doc: &Document<'_>, at: &KeyPath, value: Value) -> Result<T, Error> {
    value.try_into().map_err(|error: toml::de::Error| doc.conflict(at, error.message()))
}

const fn key(name: &'static str, kind: Kind, default: Default, meaning: &'static str) -> Key {
    Key { name, kind, unit: "", default, meaning }
}

table! {
    /// Internal damping after Kelvin and Voigt: stress = E (strain + time x strain rate).
    keys DAMPING for Damping("[cable.damping]") {
        /// Time of the axial strain.
        axial = 0.0, Kind::Number(NOT_NEGATIVE), "s";
        /// Time of the curvature, 0 with a rule without bending.
        bending = 0.0, Kind::Number(NOT_NEGATIVE), "s";
    }
    choose Choose::AtLeastOne(&["axial", "bending"]);
}

impl SceneEffect for Damping {
    const KEY: Key = key("damping", Kind::Table(&DAMPING), Default::Absent("off"), "Internal damping.");

    fn read(doc: &Document<'_>, at: &KeyPath, value: Value, cable: &Context<'_>) -> Result<Self, Error> {
        let damping: Damping = typed(doc, at, value)?;
        if damping.bending > 0.0 && cable.rule.bending == BendingRule::None {
            return Err(doc.conflict(&at.key("bending"), format!("rule {} has no bending to damp", cable.rule)));
        }
        Ok(damping)
    }
}

table! {
    /// Drag of a fluid or wind by Morison's formula.
    keys DRAG for Drag("[cable.drag]") {
        /// Density of the fluid.
        fluid_density = required, Kind::Number(POSITIVE), "kg/m^3";
        /// Normal coefficient on the diameter.
        normal = 1.2, Kind::Number(NOT_NEGATIVE);
        /// Tangential coefficient on the diameter.
        tangential = 0.01, Kind::Number(NOT_NEGATIVE);
        /// Diameter, required for a cable without `section`.
        diameter = ("that of the section"), Kind::Number(POSITIVE), "m";
        /// Velocity of the fluid: the same everywhere and always, or a table.
        flow = ("at rest"), Kind::Either(&[VECTOR, Kind::Table(&FLOW)]), "m/s";
    }
}

impl SceneEffect for Drag {
    const KEY: Key = key("drag", Kind::Table(&DRAG), Default::Absent("off"), "Drag of a fluid or wind.");

    fn read(doc: &Document<'_>, at: &KeyPath, mut value: Value, cable: &Context<'_>) -> Result<Self, Error> {
        if let Some(flow) = value.get_mut("flow") {
            flow::write_out(doc, &at.key("flow"), flow)?;
        }
        let drag: Drag = typed(doc, at, value)?;
        if drag.diameter.or(cable.section.diameter).is_none() {
            return Err(doc.missing(&at.key("diameter")));
        }
        Ok(drag)
    }
}

table! {
    /// Buoyancy and added mass in a fluid at rest.
    keys BUOYANCY for Buoyancy("[cable.buoyancy]") {
        /// Density of the fluid.
        fluid_density = required, Kind::Number(POSITIVE), "kg/m^3";
        /// Coefficient of added mass; 0 for none.
        added_mass = 1.0, Kind::Number(NOT_NEGATIVE);
        /// Displaced area, required for a cable without `section`.
        area = ("that of the section"), Kind::Number(POSITIVE), "m^2";
    }
}

impl SceneEffect for Buoyancy {
    const KEY: Key = key("buoyancy", Kind::Table(&BUOYANCY), Default::Absent("off"), "Buoyancy and added mass.");

    fn read(doc: &Document<'_>, at: &KeyPath, value: Value, cable: &Context<'_>) -> Result<Self, Error> {
        let buoyancy: Buoyancy = typed(doc, at, value)?;
        if buoyancy.area.or(cable.section.outer_area).is_none() {
            return Err(doc.missing(&at.key("area")));
        }
        Ok(buoyancy)
    }
}

table! {
    /// Stress-free stretch and curvature, of the whole cable or of pieces. The natural curvature has no direction, because an
    /// element without twist knows none: a coil may unwind into any curve of the same curvature, and a cable that is straighter
    /// than its natural curvature may wrinkle. Draw its start shape with many points.
    struct RestShapeTable("[cable.rest_shape]") {
        /// Stress-free stretch of the whole cable: below 1 it pulls at its unstretched length.
        stretch: Option<f64> = ("1"), Kind::Number(POSITIVE);
        /// Stress-free curvature of the whole cable, 0 with a rule without bending; it has no direction.
        curvature: Option<f64> = ("0"), Kind::Number(NOT_NEGATIVE), "1/m";
        /// Pieces, instead of `stretch` and `curvature`.
        piece: Vec<RestPiece> = ("none"), Kind::Tables(&REST_PIECE);
    }
    choose Choose::AtLeastOne(&["stretch", "curvature", "piece"]);
}

table! {
    /// A piece of a rest shape, up to the next piece. An element belongs to the piece in which its middle lies.
    keys REST_PIECE for RestPiece("[[cable.rest_shape.piece]]") {
        /// Arc length of the unstretched cable where the piece begins, ascending from piece to piece.
        from = required, Kind::Number(NOT_NEGATIVE), "m";
        /// Stress-free stretch.
        stretch = 1.0, Kind::Number(POSITIVE);
        /// Stress-free curvature, 0 with a rule without bending.
        curvature = 0.0, Kind::Number(NOT_NEGATIVE), "1/m";
    }
    choose Choose::AtLeastOne(&["stretch", "curvature"]);
}

impl SceneEffect for RestShape {
    const KEY: Key = key(
        "rest_shape",
        Kind::Table(&RestShapeTable::TABLE),
        Default::Absent("straight and unstretched"),
        "Stress-free stretch and curvature.",
    );

    fn read(doc: &Document<'_>, at: &KeyPath, value: Value, cable: &Context<'_>) -> Result<Self, Error> {
        let RestShapeTable { stretch, curvature, piece } = typed(doc, at, value)?;
        let whole = stretch.is_some() || curvature.is_some();
        if whole && !piece.is_empty() {
            return Err(doc.conflict(&at.key("piece"), "both pieces and numbers of the whole cable are given"));
        }
        let uniform = RestPiece { from: 0.0, stretch: stretch.unwrap_or(1.0), curvature: curvature.unwrap_or(0.0) };
        let pieces = if whole { vec![uniform] } else { piece };
        let mut before = f64::NEG_INFINITY;
        for (i, piece) in pieces.iter().enumerate() {
            let at = if whole { at.clone() } else { at.key("piece").item(i) };
            if piece.from <= before || piece.from >= cable.length {
                return Err(doc.error(&at.key("from"), Problem::OutOfRange(piece.from)));
            }
            if piece.curvature > 0.0 && cable.rule.bending == BendingRule::None {
                let problem = format!("rule {} has no bending to curve", cable.rule);
                return Err(doc.conflict(&at.key("curvature"), problem));
            }
            before = piece.from;
        }
        Ok(RestShape { pieces })
    }
}

table! {
    /// A constant force per length of a piece of the cable.
    keys LINE_LOAD for LineLoad("[[cable.line_load]]") {
        /// Arc length of the unstretched cable where it begins, below the length of the cable.
        from = 0.0, Kind::Number(NOT_NEGATIVE), "m";
        /// Arc length where it ends, above `from`, at most the length of the cable.
        to = ("the end of the cable"), Kind::Number(POSITIVE), "m";
        /// Force per length of unstretched cable, in world axes.
        force = required, VECTOR, "N/m";
    }
}

impl SceneEffect for Vec<LineLoad> {
    const KEY: Key = key("line_load", Kind::Tables(&LINE_LOAD), Default::Absent("none"), "Forces per length.");

    fn read(doc: &Document<'_>, at: &KeyPath, mut value: Value, cable: &Context<'_>) -> Result<Self, Error> {
        for load in value.as_array_mut().into_iter().flatten().filter_map(Value::as_table_mut) {
            load.entry("to").or_insert(Value::Float(cable.length));
        }
        let loads: Vec<LineLoad> = typed(doc, at, value)?;
        for (i, load) in loads.iter().enumerate() {
            let at = at.item(i);
            if load.from >= cable.length {
                return Err(doc.error(&at.key("from"), Problem::OutOfRange(load.from)));
            }
            if load.to <= load.from || load.to > cable.length * (1.0 + 1e-12) {
                return Err(doc.error(&at.key("to"), Problem::OutOfRange(load.to)));
            }
        }
        Ok(loads)
    }
}

impl SceneEffect for GravityScale {
    const KEY: Key = key(
        "gravity_scale",
        Kind::Number(ANY),
        Default::Value("1.0"),
        "Factor of gravity, less buoyancy, for this cable.",
    );

    fn read(doc: &Document<'_>, at: &KeyPath, value: Value, _: &Context<'_>) -> Result<Self, Error> {
        typed(doc, at, value)
    }
}
