//! Ranges of a `[[cable]]`.

use super::check::{missing, number, vector};
use super::document::{Document, KeyPath};
use super::table::{CableTable, IntegratorTable, SectionTable};
use super::value::RuleValue;
use super::{CableScene, check_effects};
use crate::error::Error;
use lariat_ancf::{Fidelity, Integrator, IntegratorChoice, Method, Rule, Section, Shape, StepControl, Vector3};

/// Largest number of elements of a cable.
const MOST_ELEMENTS: usize = 1_000_000;

pub(super) fn cable(doc: &Document<'_>, at: &KeyPath, table: CableTable) -> Result<CableScene, Error> {
    refuse_effects(doc, at, &table)?;
    if table.name.is_empty() || table.name == "all" {
        return Err(doc.error(&at.key("name"), format!("{:?} is no name for a cable", table.name)));
    }
    let points = points(doc, &at.key("points"), &table.points)?;
    let drawn: f64 = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    let length = number(doc, &at.key("length"), table.length.unwrap_or(drawn), |x| x > 0.0)?;
    let equilibrium = match table.initial.as_deref() {
        None | Some("straight") => false,
        Some("equilibrium") => true,
        Some(other) => return Err(doc.error(&at.key("initial"), format!("unknown start {other:?}"))),
    };
    let elements = table.elements.unwrap_or(10);
    if !(1..=MOST_ELEMENTS).contains(&elements) {
        return Err(doc.error(&at.key("elements"), format!("{elements} elements")));
    }
    let rule = rule(doc, &at.key("rule"), table.rule.as_ref(), table.allow_rank_deficient.unwrap_or(false))?;
    let section = section(doc, at, &table)?;
    let effects = check_effects::effects(doc, at, &table, &section, rule, length)?;
    let motion = |key: &str, value: Option<[f64; 3]>| vector(doc, &at.key(key), value.unwrap_or_default());
    Ok(CableScene {
        points,
        length,
        equilibrium,
        elements,
        section,
        rule,
        effects,
        integrator: integrator(doc, &at.key("integrator"), table.integrator.as_ref())?,
        velocity: motion("velocity", table.velocity)?,
        angular_velocity: motion("angular_velocity", table.angular_velocity)?,
        name: table.name,
    })
}

fn refuse_effects(doc: &Document<'_>, at: &KeyPath, table: &CableTable) -> Result<(), Error> {
    let effects =
        [("contact", table.contact.is_some()), ("break", table.breaking.is_some()), ("reel", table.reel.is_some())];
    match effects.iter().find(|(_, present)| *present) {
        Some((name, _)) => Err(doc.not_built(&at.key(name), format!("the effect {name:?}"))),
        None => Ok(()),
    }
}

fn points(doc: &Document<'_>, at: &KeyPath, rows: &[[f64; 3]]) -> Result<Vec<Vector3<f64>>, Error> {
    if rows.len() < 2 {
        return Err(doc.error(at, format!("{} point", rows.len())));
    }
    let points: Vec<_> = rows.iter().map(|&row| vector(doc, at, row)).collect::<Result<_, _>>()?;
    match points.windows(2).position(|p| p[0] == p[1]) {
        Some(i) => Err(doc.error(at, format!("points {i} and {} coincide at {:?}", i + 1, rows[i]))),
        None => Ok(points),
    }
}

fn section(doc: &Document<'_>, at: &KeyPath, table: &CableTable) -> Result<Section, Error> {
    let triple = [
        ("axial_stiffness", table.axial_stiffness),
        ("bending_stiffness", table.bending_stiffness),
        ("mass_per_length", table.mass_per_length),
    ];
    let material = [("density", table.density), ("youngs_modulus", table.youngs_modulus)];
    let Some(shape) = &table.section else {
        if triple.iter().all(|(_, value)| value.is_none()) {
            return Err(missing(doc, &at.key("section")));
        }
        if let Some((key, _)) = material.iter().find(|(_, value)| value.is_some()) {
            return Err(doc.error(&at.key(key), format!("{key} has no meaning without section")));
        }
        let [ea, ei, m] = triple.map(|(key, value)| {
            let at = at.key(key);
            let value = value.ok_or_else(|| missing(doc, &at))?;
            number(doc, &at, value, |x| x > 0.0 || key == "bending_stiffness" && x == 0.0)
        });
        return Section::from_stiffness(ea?, ei?, m?).map_err(|e| doc.error(&at.key("axial_stiffness"), e.to_string()));
    };
    if let Some((key, _)) = triple.iter().find(|(_, value)| value.is_some()) {
        return Err(doc.error(&at.key(key), format!("both section and {key} are given")));
    }
    let [density, modulus] = material.map(|(key, value)| {
        let at = at.key(key);
        number(doc, &at, value.ok_or_else(|| missing(doc, &at))?, |x| x > 0.0)
    });
    let at = at.key("section");
    Section::new(shape_of(doc, &at, shape)?, modulus?, density?).map_err(|e| doc.error(&at, e.to_string()))
}

fn shape_of(doc: &Document<'_>, at: &KeyPath, table: &SectionTable) -> Result<Shape, Error> {
    let size = |key: &str, x: f64| number(doc, &at.key(key), x, |x| x > 0.0);
    match (table.square, table.round, table.tube) {
        (Some(side), None, None) => size("square", side).map(Shape::Square),
        (None, Some(diameter), None) => size("round", diameter).map(Shape::Round),
        (None, None, Some([outer, inner])) => {
            size("tube", outer)?;
            number(doc, &at.key("tube"), inner, |x| x >= 0.0 && x < outer)?;
            Ok(Shape::Tube(outer, inner))
        }
        _ => Err(doc.error(at, "not exactly one shape")),
    }
}

fn rule(doc: &Document<'_>, at: &KeyPath, value: Option<&RuleValue>, deficient: bool) -> Result<Rule, Error> {
    let rule = match value {
        None => Rule::default(),
        Some(RuleValue::Name(name)) => name.parse().map_err(|e| doc.error(at, unknown(&e, "rule", name)))?,
        Some(RuleValue::Pair { axial, bending }) => {
            let part = |e, key: &str, text: &str| doc.error(&at.key(key), unknown(&e, &format!("{key} rule"), text));
            Rule::new(
                axial.parse().map_err(|e| part(e, "axial", axial))?,
                bending.parse().map_err(|e| part(e, "bending", bending))?,
            )
        }
    };
    match rule.spare_modes() {
        Some(reason) if !deficient => Err(doc.error_accepting(
            at,
            format!("{rule} is rank deficient: {reason}"),
            "a rule without spare modes (`lariat rules`), or allow_rank_deficient = true beside it",
        )),
        _ => Ok(rule),
    }
}

/// The problem with a rule's name, with the nearest name if one is near.
fn unknown(error: &lariat_ancf::Error, what: &str, name: &str) -> String {
    match error {
        lariat_ancf::Error::UnknownRule { suggestion: Some(nearest), .. } => {
            format!("unknown {what} {name:?}: did you mean {nearest:?}?")
        }
        _ => format!("unknown {what} {name:?}"),
    }
}

fn integrator(doc: &Document<'_>, at: &KeyPath, table: Option<&IntegratorTable>) -> Result<IntegratorChoice, Error> {
    let Some(table) = table else { return Ok(IntegratorChoice::default()) };
    let controls = [
        ("tolerance", table.tolerance.map(StepControl::Tolerance)),
        ("substeps", table.substeps.map(StepControl::Substeps)),
        ("max_step", table.max_step.map(StepControl::MaxStep)),
        ("stable", table.stable.map(StepControl::Stable)),
    ];
    let given: Vec<_> = controls.iter().filter_map(|(key, control)| control.map(|c| (*key, c))).collect();
    if let Some(fidelity) = &table.fidelity {
        if table.method.is_some() || !given.is_empty() {
            return Err(doc.error(at, "fidelity stands alone"));
        }
        let preset: Result<Fidelity, _> = fidelity.parse();
        return preset.map(IntegratorChoice::from).map_err(|error| doc.error(&at.key("fidelity"), error.to_string()));
    }
    let method = match &table.method {
        None => Integrator::default().method,
        Some(name) => name
            .parse::<Method>()
            .map_err(|error| doc.error_accepting(&at.key("method"), error.to_string(), "see `lariat integrators`"))?,
    };
    let [(key, control)] = given[..] else {
        return Err(doc.error(at, if given.is_empty() { "no step control" } else { "more than one step control" }));
    };
    if table.method.is_none() && key != "tolerance" {
        return Err(doc.error(&at.key("method"), format!("missing key: {key} needs a method")));
    }
    let integrator = Integrator { method, control }.checked();
    integrator.map(IntegratorChoice::from).map_err(|error| doc.error(&at.key(key), error.to_string()))
}
