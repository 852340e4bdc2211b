//! Ranges of the effect tables of a `[[cable]]`: damping, drag, buoyancy, rest shape, line loads, gravity scale.
//!
//! What docs/scene.md shows is the default of a key that is missing, but for the density of a fluid, which must be there. A cable that is
//! described by EA, EI and mass per length has no diameter and no area: `diameter` and `area` give them.

use super::check::{number, vector};
use super::check_flow;
use super::document::{Document, KeyPath};
use super::table::{BuoyancyTable, CableTable, DampingTable, DragTable, LineLoadTable, RestPieceTable, RestShapeTable};
use crate::error::Error;
use lariat_ancf::{
    BendingRule, Buoyancy, Damping, Drag, Effects, GravityScale, LineLoad, LineLoads, RestPiece, RestShape, Rule,
    Section,
};

/// Coefficients where a table has none.
const NORMAL: f64 = 1.2;
const TANGENTIAL: f64 = 0.01;
const ADDED_MASS: f64 = 1.0;

pub(super) fn effects(
    doc: &Document<'_>,
    at: &KeyPath,
    table: &CableTable,
    section: &Section,
    rule: Rule,
    length: f64,
) -> Result<Effects, Error> {
    let loads = table.line_load.iter().enumerate();
    let loads: Vec<LineLoad> =
        loads.map(|(i, t)| line_load(doc, &at.key("line_load").item(i), t, length)).collect::<Result<_, _>>()?;
    let scale = |scale| number(doc, &at.key("gravity_scale"), scale, |_| true).map(GravityScale);
    Ok(Effects {
        damping: table.damping.as_ref().map(|t| damping(doc, &at.key("damping"), t, rule)).transpose()?,
        drag: table.drag.as_ref().map(|t| drag(doc, &at.key("drag"), t, section)).transpose()?,
        buoyancy: table.buoyancy.as_ref().map(|t| buoyancy(doc, &at.key("buoyancy"), t, section)).transpose()?,
        rest_shape: table
            .rest_shape
            .as_ref()
            .map(|t| rest_shape(doc, &at.key("rest_shape"), t, rule, length))
            .transpose()?,
        line_loads: (!loads.is_empty()).then_some(LineLoads(loads)),
        gravity_scale: table.gravity_scale.map(scale).transpose()?,
    })
}

fn damping(doc: &Document<'_>, at: &KeyPath, table: &DampingTable, rule: Rule) -> Result<Damping, Error> {
    if table.axial.is_none() && table.bending.is_none() {
        return Err(doc.error(at, "neither axial nor bending"));
    }
    let time = |key: &str, value: Option<f64>| number(doc, &at.key(key), value.unwrap_or(0.0), |x| x >= 0.0);
    let damping = Damping { axial: time("axial", table.axial)?, bending: time("bending", table.bending)? };
    if damping.bending > 0.0 && rule.bending == BendingRule::None {
        return Err(doc.error(&at.key("bending"), format!("rule {rule} has no bending to damp")));
    }
    Ok(damping)
}

fn drag(doc: &Document<'_>, at: &KeyPath, table: &DragTable, section: &Section) -> Result<Drag, Error> {
    let coefficient =
        |key: &str, value: Option<f64>, default: f64| number(doc, &at.key(key), value.unwrap_or(default), |x| x >= 0.0);
    let diameter = table.diameter.map(|d| number(doc, &at.key("diameter"), d, |x| x > 0.0)).transpose()?;
    if diameter.or(section.diameter).is_none() {
        return Err(doc.error(&at.key("diameter"), "missing key: the cable has no section shape"));
    }
    Ok(Drag {
        fluid_density: number(doc, &at.key("fluid_density"), table.fluid_density, |x| x > 0.0)?,
        normal: coefficient("normal", table.normal, NORMAL)?,
        tangential: coefficient("tangential", table.tangential, TANGENTIAL)?,
        diameter,
        flow: check_flow::flow(doc, &at.key("flow"), table.flow.as_ref())?,
    })
}

fn buoyancy(doc: &Document<'_>, at: &KeyPath, table: &BuoyancyTable, section: &Section) -> Result<Buoyancy, Error> {
    let area = table.area.map(|a| number(doc, &at.key("area"), a, |x| x > 0.0)).transpose()?;
    if area.or(section.outer_area).is_none() {
        return Err(doc.error(&at.key("area"), "missing key: the cable has no section shape"));
    }
    Ok(Buoyancy {
        fluid_density: number(doc, &at.key("fluid_density"), table.fluid_density, |x| x > 0.0)?,
        added_mass: number(doc, &at.key("added_mass"), table.added_mass.unwrap_or(ADDED_MASS), |x| x >= 0.0)?,
        area,
    })
}

fn rest_shape(
    doc: &Document<'_>,
    at: &KeyPath,
    table: &RestShapeTable,
    rule: Rule,
    length: f64,
) -> Result<RestShape, Error> {
    let whole = table.stretch.is_some() || table.curvature.is_some();
    if whole && !table.piece.is_empty() {
        return Err(doc.error(&at.key("piece"), "both pieces and numbers of the whole cable"));
    }
    if !whole && table.piece.is_empty() {
        return Err(doc.error(at, "neither stretch nor curvature"));
    }
    if whole {
        let piece = RestPieceTable { from: 0.0, stretch: table.stretch, curvature: table.curvature };
        return Ok(RestShape { pieces: vec![rest_piece(doc, at, &piece, rule)?] });
    }
    let mut pieces: Vec<RestPiece> = Vec::new();
    for (i, piece) in table.piece.iter().enumerate() {
        let at = at.key("piece").item(i);
        if piece.stretch.is_none() && piece.curvature.is_none() {
            return Err(doc.error(&at, "neither stretch nor curvature"));
        }
        let before = pieces.last().map(|p| p.from);
        let follows = |from: f64| from >= 0.0 && from < length && before.is_none_or(|before| from > before);
        number(doc, &at.key("from"), piece.from, follows)?;
        pieces.push(rest_piece(doc, &at, piece, rule)?);
    }
    Ok(RestShape { pieces })
}

fn rest_piece(doc: &Document<'_>, at: &KeyPath, table: &RestPieceTable, rule: Rule) -> Result<RestPiece, Error> {
    let stretch = number(doc, &at.key("stretch"), table.stretch.unwrap_or(1.0), |x| x > 0.0)?;
    let curvature = number(doc, &at.key("curvature"), table.curvature.unwrap_or(0.0), |x| x >= 0.0)?;
    if curvature > 0.0 && rule.bending == BendingRule::None {
        return Err(doc.error(&at.key("curvature"), format!("rule {rule} has no bending to curve")));
    }
    Ok(RestPiece { from: table.from, stretch, curvature })
}

fn line_load(doc: &Document<'_>, at: &KeyPath, table: &LineLoadTable, length: f64) -> Result<LineLoad, Error> {
    let from = number(doc, &at.key("from"), table.from.unwrap_or(0.0), |x| x >= 0.0 && x < length)?;
    let to = number(doc, &at.key("to"), table.to.unwrap_or(length), |x| x > from && x <= length * (1.0 + 1e-12))?;
    Ok(LineLoad { from, to, force: vector(doc, &at.key("force"), table.force)? })
}
