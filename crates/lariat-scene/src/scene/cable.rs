//! `[[cable]]`: shape, section, rule and motion of a cable.

use super::breaking::{self, BREAK, BreakScene};
use super::effects::{self, EFFECTS};
use super::elements::{ELEMENTS, ElementsTable, Fine};
use super::integrator::{self, IntegratorTable};
use super::reel::{self, DrumScene, DrumTable, REEL};
use super::references::{Position, arc_length};
use super::sections::{self, PieceTable, SECTION, SectionForm, SectionKeys, Sections};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Kind, NOT_NEGATIVE, POSITION, POSITIVE, VECTOR, choice, parse_as, table};
use lariat_ancf::{At, AxialRule, BendingRule, Cable, Effects, Fidelity, Reel, Rule, Section, Vector3, Water};
use serde::Deserialize;

choice! {
    /// How a cable starts.
    enum Initial {
        /// As drawn.
        Straight = "straight",
        /// In static equilibrium.
        Equilibrium = "equilibrium",
    }
}

table! {
    /// A cable: an elastic line of a start shape, a section and material, and a rule that computes its elastic forces. An effect
    /// whose table is absent costs nothing.
    struct CableTable("[[cable]]") {
        /// No other cable has it.
        name: String = required, Kind::Name(&["all"]);
        /// Start shape: the polyline through these points, of which neighbours differ. Corners are rounded, within 0.6 elements, but where the cable is held: there it starts strained, which a warning tells.
        points: Vec<Vector3<f64>> = required, Kind::Rows(&["x", "y", "z"], 2), "m";
        /// Unstretched length: a cable shorter than drawn is taut at the start, a longer one hangs slack.
        length: Option<f64> = ("the length of the polyline"), Kind::Number(POSITIVE), "m";
        /// Instead of `length`: the length with which it has this tension at its middle when it hangs between its drawn ends, under its
        /// weight, `line_load` and buoyancy: as it is installed, before a `[[load]]`, wind or a current. `initial = "equilibrium"` starts with
        /// all of them.
        pretension: Option<f64> = ("none"), Kind::Number(POSITIVE), "N";
        /// Instead of `length`: the length with which it hangs by this distance below the line between its drawn ends, at most.
        sag: Option<f64> = ("none"), Kind::Number(POSITIVE), "m";
        /// `"straight"` starts as drawn, `"equilibrium"` in the static shape under the loads of the scene, with bodies and junctions
        /// held where they are drawn; with contact it lies on the bodies, without friction.
        initial: Initial = "straight", Kind::Choice(Initial::names);
        /// Number of elements, or a mesh that is fine at some points. A cable over sheaves shares them out over its parts, each of which has at
        /// least two.
        elements: ElementsTable = 10, ELEMENTS;
        /// Points between the ends at which the slope is free on both sides, as at a hinge: where a point load, a junction or a ball
        /// attachment bends a cable that is limp, `sqrt(EI/T)` far below an element; one with stiffness wants `elements` that are fine there. A
        /// cable without bending stiffness and without a reel has all such points by itself, but for `engine = "none"`. It stays one cable, and
        /// no moment goes through them. Need `engine = "rapier"`. An equilibrium is that of the scene.
        kinks: Option<Vec<Position>> = ("none, or without `bending_stiffness` all such points"), Kind::List(&POSITION), "m";
        /// Shape of a solid section, or a rope or chain by name and nominal diameter; or the three stiffnesses.
        section: Option<SectionForm> = ("required without the three stiffnesses"), Kind::Table(&SECTION), "m";
        /// Density of the material, beside a solid `section`.
        density: Option<f64> = ("required with a solid `section`"), Kind::Number(POSITIVE), "kg/m^3";
        /// Young's modulus, beside a solid `section`.
        youngs_modulus: Option<f64> = ("required with a solid `section`"), Kind::Number(POSITIVE), "Pa";
        /// EA, with `bending_stiffness` and `mass_per_length`, instead of `section`.
        axial_stiffness: Option<f64> = ("required without `section`"), Kind::Number(POSITIVE), "N";
        /// EI, with `axial_stiffness` and `mass_per_length`, instead of `section`.
        bending_stiffness: Option<f64> = ("required without `section`"), Kind::Number(NOT_NEGATIVE), "N m^2";
        /// Mass per unstretched length, with `axial_stiffness` and `bending_stiffness`, instead of `section`.
        mass_per_length: Option<f64> = ("required without `section`"), Kind::Number(POSITIVE), "kg/m";
        /// Pieces with other sections, each up to the next one. Need `length`, or the drawn one.
        piece: Vec<PieceTable> = ("none"), Kind::Tables(&PieceTable::TABLE);
        /// Force strategy.
        rule: Option<RuleTable> = ("`\"projected-T1\"` with `{ fidelity = \"game\" }`, else `\"projected-3\"`"), RULE;
        /// `true` runs a rule with zero-energy modes.
        allow_rank_deficient: bool = false, Kind::Flag;
        /// Time integrator and step control. A cable with `contact`, a reel with `max_force` or a drum, a sheave, or `torsion` on a body, at a
        /// junction or with a reel needs the method `"discrete-gradient"`, and one with any of them or `torsion` has `{ fidelity = "game" }` by default; with `{ fidelity =
        /// "engineering" }` it is stepped by that method to 1e-5 m per host step.
        integrator: IntegratorTable = { fidelity = "engineering" }, Kind::Table(&IntegratorTable::TABLE);
        /// Velocity of the start point.
        velocity: Vector3<f64> = [0.0, 0.0, 0.0], VECTOR, "m/s";
        /// Angular velocity of the whole cable about its start point.
        angular_velocity: Vector3<f64> = [0.0, 0.0, 0.0], VECTOR, "rad/s";
    }
    rest effects;
    plus EFFECTS;
    plus &[BREAK, REEL];
}

table! {
    /// A rule by its two parts.
    struct RulePair("[cable.rule]") {
        /// Axial energy.
        axial: AxialRule = required, Kind::Parsed { accepted: "an axial rule of `lariat rules`", parse: parse_as::<AxialRule> };
        /// Bending energy.
        bending: BendingRule = required, Kind::Parsed { accepted: "a bending rule of `lariat rules`", parse: parse_as::<BendingRule> };
    }
}

/// A rule by its name or by its two parts.
const RULE: Kind = Kind::Either(&[
    Kind::Parsed { accepted: "a name of `lariat rules`", parse: parse_as::<Rule> },
    Kind::Table(&RulePair::TABLE),
]);

/// A rule as a scene writes it.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum RuleTable {
    /// By its name.
    Name(Rule),
    /// By its two parts.
    Pair(RulePair),
}

/// A checked cable.
#[derive(Clone, Debug, PartialEq)]
pub struct CableScene {
    /// Name.
    pub name: String,
    /// Start shape in m.
    pub points: Vec<Vector3<f64>>,
    /// Unstretched length in m.
    pub length: f64,
    /// Length in m of the cable between the part before this one and its start: what is on a wheel.
    pub lead: f64,
    /// True to start from static equilibrium.
    pub equilibrium: bool,
    /// Number of elements.
    pub elements: usize,
    /// Where they are fine.
    pub fine: Fine,
    /// Whether nodes are at point loads, where the third derivative of the shape jumps, as they are at attachments.
    pub nodes_at_loads: bool,
    /// Arc lengths in m of kinks, until it is divided there.
    pub kinks: Vec<f64>,
    /// Sections along it.
    pub sections: Sections,
    /// Force strategy.
    pub rule: Rule,
    /// Whether that is the one of a fidelity, and not one that was asked for.
    pub rule_by_fidelity: bool,
    /// Effects.
    pub effects: Effects,
    /// When it becomes two.
    pub breaking: BreakScene,
    /// Reel at an end.
    pub reel: Option<Reel>,
    /// Whether that is the first point.
    pub reel_at_start: bool,
    /// Body on which the reel winds it.
    pub drum: Option<DrumScene>,
    /// Time integrator.
    pub integrator: Fidelity,
    /// Initial velocity in m/s.
    pub velocity: Vector3<f64>,
    /// Initial angular velocity about the start point in rad/s.
    pub angular_velocity: Vector3<f64>,
}

impl From<&CableTable> for SectionKeys {
    fn from(row: &CableTable) -> Self {
        let &CableTable {
            section, density, youngs_modulus, axial_stiffness, bending_stiffness, mass_per_length, ..
        } = row;
        SectionKeys { section, density, youngs_modulus, axial_stiffness, bending_stiffness, mass_per_length }
    }
}

impl CableScene {
    /// Returns the mean of something along it.
    pub fn mean_of(&self, of: impl Fn(&Section) -> f64) -> f64 {
        self.sections.mean(self.length, of)
    }

    /// Returns its mass in kg.
    pub fn mass(&self) -> f64 {
        self.mean_of(|section| section.mass_per_length) * self.length
    }
}

/// Reads the cable at a path, and its drum as written.
pub(super) fn read(
    doc: &Document<'_>,
    at: &KeyPath,
    mut row: CableTable,
    (gravity, water): (Vector3<f64>, Option<&Water>),
) -> Result<(CableScene, Option<DrumTable>), Error> {
    if let Some(i) = row.points.windows(2).position(|p| p[0] == p[1]) {
        let problem = format!("points {i} and {} coincide at {:?}", i + 1, row.points[i].as_slice());
        return Err(doc.conflict(&at.key("points"), problem));
    }
    let drawn: f64 = row.points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
    if !drawn.is_finite() {
        return Err(doc.error(&at.key("points"), Problem::NotFinite(vec![drawn])));
    }
    let mut integrator = integrator::read(doc, &at.key("integrator"), &row.integrator)?;
    let rule = rule(doc, &at.key("rule"), &row, integrator.rule())?;
    let length = length(doc, at, &row, (rule, gravity), (drawn, water))?;
    let sections = sections::read(doc, at, ((&row).into(), &row.piece), length)?;
    let breaking = breaking::read(doc, at, &mut row.effects, (length, row.elements.count()))?;
    let (reel, reel_at_start, drum) = match reel::read(doc, at, &mut row.effects)? {
        Some(reel::Written { reel, at_start, drum }) => (Some(reel), at_start, drum),
        None => (None, false, None),
    };
    let context = effects::Context { sections: &sections, rule, length, water };
    let effects = effects::read(doc, at, row.effects, &context)?;
    let slips = reel.as_ref().is_some_and(|reel| reel.max_force.is_some());
    let key = at.key("integrator");
    if effects.torsion.is_some() && (!doc.contains(&key) || integrator == Fidelity::Engineering) {
        integrator = integrator::by_discrete_gradient(doc, &key, integrator, "torsion")?;
    }
    let needs = [("contact", effects.contact.is_some()), ("a reel with a clutch", slips)];
    for (what, _) in needs.iter().filter(|(_, is)| *is) {
        integrator = integrator::by_discrete_gradient(doc, &key, integrator, what)?;
    }
    integrator::check_tolerance(doc, &key.key("tolerance"), &row.integrator, length)?;
    let kink = |(k, point): (usize, &Position)| arc_length(doc, &at.key("kinks").item(k), *point, length);
    let kinks = row.kinks.iter().flatten().enumerate().map(kink).collect::<Result<_, _>>()?;
    let cable = CableScene {
        points: row.points,
        length,
        lead: 0.0,
        equilibrium: row.initial == Initial::Equilibrium,
        elements: row.elements.count() as usize,
        fine: row.elements.grading(doc, &at.key("elements"), length)?,
        nodes_at_loads: false,
        kinks,
        sections,
        rule,
        rule_by_fidelity: row.rule.is_none(),
        effects,
        breaking,
        reel,
        reel_at_start,
        drum: None,
        integrator,
        velocity: row.velocity,
        angular_velocity: row.angular_velocity,
        name: row.name,
    };
    Ok((cable, drum))
}

/// Returns the length of a cable that is drawn over `drawn` m: as given, or by its tension or sag.
fn length(
    doc: &Document<'_>,
    at: &KeyPath,
    row: &CableTable,
    (rule, gravity): (Rule, Vector3<f64>),
    (drawn, water): (f64, Option<&Water>),
) -> Result<f64, Error> {
    let given = [("length", row.length), ("pretension", row.pretension), ("sag", row.sag)];
    let mut given = given.into_iter().filter_map(|(key, value)| Some((key, value?)));
    let Some((key, value)) = given.next() else { return Ok(drawn) };
    if let Some((other, _)) = given.next() {
        return Err(doc.conflict(&at.key(other), format!("both {key} and {other} are given")));
    }
    if key == "length" {
        return Ok(value);
    }
    if !row.piece.is_empty() {
        return Err(doc.conflict(&at.key(key), "which piece has what length is not known: give the length"));
    }
    let sections = sections::read(doc, at, (row.into(), &[]), drawn)?;
    let mut rest = row.effects.clone();
    breaking::read(doc, at, &mut rest, (drawn, row.elements.count()))?;
    reel::read(doc, at, &mut rest)?;
    let context = effects::Context { sections: &sections, rule, length: drawn, water };
    let effects = effects::read(doc, at, rest, &context)?;
    let builder = Cable::builder().points(row.points.iter().copied()).elements(row.elements.count() as usize);
    let builder = builder.section(*sections.first());
    let builder =
        builder.rule(rule).effects(effects).allow_rank_deficient().gravity(gravity).fix(At::Start).fix(At::End);
    let builder = builder.name(row.name.as_str());
    let builder = if key == "sag" { builder.sag(value) } else { builder.pretension(value) };
    builder.build().map(|cable| cable.length()).map_err(|error| doc.conflict(&at.key(key), error.to_string()))
}

fn rule(doc: &Document<'_>, at: &KeyPath, row: &CableTable, default: Rule) -> Result<Rule, Error> {
    let rule = match &row.rule {
        Some(RuleTable::Name(rule)) => *rule,
        Some(RuleTable::Pair(pair)) => Rule::new(pair.axial, pair.bending),
        None => default,
    };
    match rule.spare_modes() {
        Some(reason) if !row.allow_rank_deficient => Err(doc.error_accepting(
            at,
            Problem::Conflict(format!("{rule} is rank deficient: {reason}")),
            "a rule without zero-energy modes (`lariat rules`), or allow_rank_deficient = true beside it",
        )),
        _ => Ok(rule),
    }
}
