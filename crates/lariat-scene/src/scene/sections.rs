//! Sections of a cable: one, or pieces with their own from arc lengths on.

use super::references::{Position, arc_length};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{ARC_LENGTH, Choose, Kind, NOT_NEGATIVE, POSITIVE, table};
use lariat_ancf::{RopeMaterial, Section, Shape};
use serde::Deserialize;

table! {
    /// A solid section of one material, or a rope or chain by its nominal diameter, with mass and EA as catalogues have them, without EI but for wire rope
    /// (`RopeMaterial` of lariat-ancf names the sources). The `axial_law` of a rope or chain by name is `"rope"`, unless it has another one,
    /// or a rest stretch or `torque_per_tension`, with which no law goes: catalogues have force over elongation, and it folds rather than be pushed.
    keys SECTION("[cable.section]") {
        /// Side of a square.
        square = (), Kind::Number(POSITIVE), "m";
        /// Diameter.
        round = (), Kind::Number(POSITIVE), "m";
        /// Outer and inner diameter, outer > inner >= 0.
        tube = (), Kind::Numbers(&["outer", "inner"], NOT_NEGATIVE), "m";
        /// Nominal diameter d of a nylon rope: 585.2 d^2 kg/m, EA 1.035e9 d^2 + 1.151e9 d^3 N.
        nylon = (), Kind::Number(POSITIVE), "m";
        /// Nominal diameter d of a polyester rope: 678.8 d^2 kg/m, EA 4.315e9 d^2 N.
        polyester = (), Kind::Number(POSITIVE), "m";
        /// Nominal diameter d of a rope of high-modulus polyethylene: 495.7 d^2 kg/m, EA 3.276e10 d^2 + 3.679e10 d^3 N.
        hmpe = (), Kind::Number(POSITIVE), "m";
        /// Nominal diameter d of a steel wire rope: 4090 d^2 kg/m, EA 4.60e10 d^2 N, EI 1.253e7 d^4 N m^2.
        wire_rope = (), Kind::Number(POSITIVE), "m";
        /// Bar diameter d of a studless chain: 2.001e4 d^2 kg/m, EA 8.561e10 d^2 - 3.927e7 d^3 N. Contact and drag have the diameter of a round bar
        /// of its volume, 1.8 d, unless they are given theirs.
        chain = (), Kind::Number(POSITIVE), "m";
    }
    choose Choose::ExactlyOne(&["square", "round", "tube", "nylon", "polyester", "hmpe", "wire_rope", "chain"]);
}

/// A section as a scene writes it.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SectionForm {
    /// Side.
    Square(f64),
    /// Diameter.
    Round(f64),
    /// Outer and inner diameter.
    Tube(f64, f64),
    /// By name.
    Nylon(f64),
    /// By name.
    Polyester(f64),
    /// By name.
    Hmpe(f64),
    /// By name.
    WireRope(f64),
    /// By name.
    Chain(f64),
}

/// A section as mechanics has it.
enum Form {
    Solid(Shape),
    Rope(RopeMaterial, f64),
}

impl SectionForm {
    fn form(self) -> Form {
        match self {
            SectionForm::Square(side) => Form::Solid(Shape::Square(side)),
            SectionForm::Round(diameter) => Form::Solid(Shape::Round(diameter)),
            SectionForm::Tube(outer, inner) => Form::Solid(Shape::Tube(outer, inner)),
            SectionForm::Nylon(diameter) => Form::Rope(RopeMaterial::Nylon, diameter),
            SectionForm::Polyester(diameter) => Form::Rope(RopeMaterial::Polyester, diameter),
            SectionForm::Hmpe(diameter) => Form::Rope(RopeMaterial::Hmpe, diameter),
            SectionForm::WireRope(diameter) => Form::Rope(RopeMaterial::WireRope, diameter),
            SectionForm::Chain(diameter) => Form::Rope(RopeMaterial::Chain, diameter),
        }
    }
}

table! {
    /// A piece of a cable with another section, up to the next piece: a chain behind a rope. Before the first one the section is that of the
    /// cable. A node is where it begins.
    struct PieceTable("[[cable.piece]]") {
        /// Arc length of the unstretched cable where it begins, or a share of its length, ascending from piece to piece, above 0.
        from: Position = required, ARC_LENGTH, "m";
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
    }
}

/// The keys by which a table gives a section.
#[derive(Clone, Copy, Debug)]
pub(super) struct SectionKeys {
    pub section: Option<SectionForm>,
    pub density: Option<f64>,
    pub youngs_modulus: Option<f64>,
    pub axial_stiffness: Option<f64>,
    pub bending_stiffness: Option<f64>,
    pub mass_per_length: Option<f64>,
}

impl From<&PieceTable> for SectionKeys {
    fn from(row: &PieceTable) -> Self {
        let PieceTable {
            section, density, youngs_modulus, axial_stiffness, bending_stiffness, mass_per_length, ..
        } = *row;
        SectionKeys { section, density, youngs_modulus, axial_stiffness, bending_stiffness, mass_per_length }
    }
}

/// The sections of a cable.
#[derive(Clone, Debug, PartialEq)]
pub struct Sections {
    /// The arc length in m at which each begins, ascending from 0.
    list: Vec<(f64, Section)>,
}

impl Sections {
    /// Returns the first one.
    pub fn first(&self) -> &Section {
        &self.list[0].1
    }

    /// Returns the last one.
    pub fn last(&self) -> &Section {
        &self.list[self.list.len() - 1].1
    }

    /// Returns that at an arc length in m.
    pub fn at(&self, arc_length: f64) -> &Section {
        self.list.iter().rfind(|(from, _)| *from <= arc_length).map_or(self.first(), |(_, section)| section)
    }

    /// Returns whether all of the cable has the same one.
    pub fn is_uniform(&self) -> bool {
        self.list.len() == 1
    }

    /// Returns where each begins in m, with it.
    pub fn iter(&self) -> impl Iterator<Item = &(f64, Section)> {
        self.list.iter()
    }

    /// Returns whether something holds of each.
    pub fn all(&self, holds: impl Fn(&Section) -> bool) -> bool {
        self.list.iter().all(|(_, section)| holds(section))
    }

    /// Returns the mean over a cable of this length in m of something.
    pub fn mean(&self, length: f64, of: impl Fn(&Section) -> f64) -> f64 {
        if self.is_uniform() {
            return of(self.first());
        }
        let ends = self.list.iter().skip(1).map(|(from, _)| *from).chain([length]);
        self.list.iter().zip(ends).map(|((from, section), to)| of(section) * (to - from)).sum::<f64>() / length
    }

    /// Returns those of the part between two arc lengths in m.
    pub(super) fn between(&self, [from, to]: [f64; 2]) -> Self {
        let before = self.list.iter().filter(|(start, _)| *start <= from).count().saturating_sub(1);
        let own = self.list[before..].iter().filter(|(start, _)| *start < to);
        let list = own.map(|(start, section)| ((start - from).max(0.0), *section)).collect();
        Sections { list }
    }
}

/// Reads the sections of the cable at a path, its own and those of its pieces; the length is in m.
pub(super) fn read(
    doc: &Document<'_>,
    at: &KeyPath,
    (own, pieces): (SectionKeys, &[PieceTable]),
    length: f64,
) -> Result<Sections, Error> {
    let mut list = vec![(0.0, section(doc, at, own)?)];
    for (k, piece) in pieces.iter().enumerate() {
        let row = at.key("piece").item(k);
        let from = arc_length(doc, &row.key("from"), piece.from, length)?;
        if from <= list[k].0 || from >= length {
            return Err(doc.error(&row.key("from"), Problem::OutOfRange(from)));
        }
        list.push((from, section(doc, &row, piece.into())?));
    }
    Ok(Sections { list })
}

fn section(doc: &Document<'_>, at: &KeyPath, row: SectionKeys) -> Result<Section, Error> {
    let stiffness = [
        ("axial_stiffness", row.axial_stiffness),
        ("bending_stiffness", row.bending_stiffness),
        ("mass_per_length", row.mass_per_length),
    ];
    let material = [("density", row.density), ("youngs_modulus", row.youngs_modulus)];
    let given = |keys: &[(&'static str, Option<f64>)]| keys.iter().find(|(_, x)| x.is_some()).map(|(key, _)| *key);
    let required = |(key, value): (&str, Option<f64>)| value.ok_or_else(|| doc.missing(&at.key(key)));
    let invalid = |path: &str| {
        let at = path.split('.').fold(at.clone(), |at, key| at.key(key));
        move |error: lariat_ancf::Error| doc.conflict(&at, error.to_string())
    };
    match (row.section.map(SectionForm::form), given(&stiffness), given(&material)) {
        (None, None, _) => Err(doc.missing(&at.key("section"))),
        (None, Some(_), Some(key)) => Err(doc.conflict(&at.key(key), format!("{key} has no meaning without section"))),
        (Some(_), Some(key), _) => Err(doc.conflict(&at.key(key), format!("both section and {key} are given"))),
        (None, Some(_), None) => {
            let [ea, ei, m] = stiffness.map(required);
            Section::from_stiffness(ea?, ei?, m?).map_err(invalid("axial_stiffness"))
        }
        (Some(Form::Rope(..)), None, Some(key)) => {
            Err(doc.conflict(&at.key(key), format!("{key} is that of the rope or chain that `section` names")))
        }
        (Some(Form::Rope(material, diameter)), None, None) => material.section(diameter).map_err(invalid("section")),
        (Some(Form::Solid(shape)), None, _) => {
            let [density, modulus] = material.map(required);
            let density = density?;
            let key = if matches!(shape, Shape::Tube(..)) { "section.tube" } else { "section" };
            Section::new(shape, modulus?, density).map_err(invalid(key))
        }
    }
}
