//! Ranges of the effect tables of a `[[cable]]`: damping, drag, buoyancy.
//!
//! What docs/scene.md shows is the default of a key that is missing, but for the density of a fluid, which must be there. A cable that is
//! described by EA, EI and mass per length has no diameter and no area: `diameter` and `area` give them.

use super::check::{number, vector};
use super::document::{Document, KeyPath};
use super::table::{BuoyancyTable, CableTable, DampingTable, DragTable};
use crate::error::Error;
use lariat_ancf::{BendingRule, Buoyancy, Damping, Drag, Effects, Flow, Rule, Section};

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
) -> Result<Effects, Error> {
    Ok(Effects {
        damping: table.damping.as_ref().map(|t| damping(doc, &at.key("damping"), t, rule)).transpose()?,
        drag: table.drag.as_ref().map(|t| drag(doc, &at.key("drag"), t, section)).transpose()?,
        buoyancy: table.buoyancy.as_ref().map(|t| buoyancy(doc, &at.key("buoyancy"), t, section)).transpose()?,
        ..Effects::default()
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
        flow: Flow::uniform(vector(doc, &at.key("flow"), table.flow.unwrap_or_default())?),
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
