//! `elements` of a cable: their number, or a mesh that is graded towards points.

use super::Scene;
use super::cable::CableScene;
use super::references::{CableEnd, Position, arc_length};
use crate::document::{Document, KeyPath};
use crate::error::Error;
use crate::schema::{Kind, POSITION, POSITIVE, choice, table};
use lariat_ancf::{At, CableBuilder};
use serde::Deserialize;

/// Most elements of a cable.
const MOST: u64 = 1_000_000;

table! {
    /// A mesh that is fine at some points: from each of them on, elements grow by a constant ratio, 2 at most. A cable of stiffness EI under
    /// a tension T bends within `sqrt(EI/T)` of clamps and loads, where `finest` should be twice that, or less.
    struct GradedTable("[cable.elements]") {
        /// Number of elements, or a few more. So few that neighbours would differ by a factor of more than 2 are refused; with `"auto"`
        /// that of an even mesh, and as many more as the fine points need.
        count: u64 = required, Kind::Whole(1, MOST);
        /// Length of the elements at the points, less than the mean length. `"auto"` finds the equilibrium of the scene first, and makes
        /// elements of `2 sqrt(EI/T)` wherever the cable bends more sharply than even ones can: at clamps, loads, junctions and attachments.
        finest: Finest = required, Kind::Either(&[Kind::Choice(Auto::names), Kind::Number(POSITIVE)]), "m";
        /// The points, which get nodes. Not where material runs through an end. `"auto"` chooses them.
        at: Option<Vec<Position>> = ("both ends"), Kind::List(&POSITION), "m";
    }
}

choice! {
    /// What statics choose.
    enum Auto {
        /// The mesh is that of the equilibrium.
        Auto = "auto",
    }
}

/// Length of the elements at the points of a graded mesh.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged)]
pub enum Finest {
    /// In m.
    Length(f64),
    /// Chosen by statics.
    Auto(Auto),
}

/// A number of elements, or a graded mesh.
pub(super) const ELEMENTS: Kind = Kind::Either(&[Kind::Whole(1, MOST), Kind::Table(&GradedTable::TABLE)]);

/// Elements as a scene writes them.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum ElementsTable {
    /// So many, about even.
    Count(u64),
    /// Graded.
    Graded(GradedTable),
}

impl ElementsTable {
    /// Returns the number of elements.
    pub(super) fn count(&self) -> u64 {
        match self {
            ElementsTable::Count(count) => *count,
            ElementsTable::Graded(graded) => graded.count,
        }
    }

    /// Returns the mesh of a cable of a length in m.
    pub(super) fn grading(&self, doc: &Document<'_>, at: &KeyPath, length: f64) -> Result<Fine, Error> {
        let ElementsTable::Graded(graded) = self else { return Ok(Fine::Nowhere) };
        let Finest::Length(finest) = graded.finest else {
            return match graded.at {
                None => Ok(Fine::ByStatics),
                Some(_) => Err(doc.conflict(&at.key("at"), "finest = \"auto\" chooses the points")),
            };
        };
        let point = |point: &Position| arc_length(doc, &at.key("at"), *point, length);
        let ends = [Position::End(CableEnd::Start), Position::End(CableEnd::End)];
        let points = graded.at.as_deref().unwrap_or(&ends).iter().map(point).collect::<Result<_, _>>()?;
        Ok(Fine::At(Grading { finest, points }))
    }
}

/// Where the elements of a cable are fine.
#[derive(Clone, Debug, PartialEq)]
pub enum Fine {
    /// Nowhere: they are about even.
    Nowhere,
    /// At some points.
    At(Grading),
    /// Where the equilibrium of the scene says.
    ByStatics,
}

/// The points at which the elements of a cable are fine.
#[derive(Clone, Debug, PartialEq)]
pub struct Grading {
    /// Length of the elements there in m.
    pub finest: f64,
    /// Arc lengths in m.
    pub points: Vec<f64>,
}

impl CableScene {
    /// Gives the elements to a builder.
    pub(super) fn mesh(&self, builder: CableBuilder) -> CableBuilder {
        let builder = builder.elements(self.elements);
        match &self.fine {
            Fine::Nowhere | Fine::ByStatics => builder,
            Fine::At(grading) => builder.finest(grading.finest, grading.points.iter().map(|s| At::ArcLength(*s))),
        }
    }
}

/// Refuses meshes that are fine where material runs through an end, once reels and sheaves are known: all that comes in would be
/// as fine.
pub(super) fn check_eyes(doc: &Document<'_>, scene: &Scene) -> Result<(), Error> {
    for (index, cable) in scene.cables.iter().enumerate() {
        let Fine::At(grading) = &cable.fine else { continue };
        let [start, end] = scene.eyes(index);
        let near = 1e-9 * cable.length;
        let at_eye = |s: &&f64| start && **s <= near || end && **s >= cable.length - near;
        if let Some(s) = grading.points.iter().find(at_eye) {
            let at = KeyPath::root("cable").item(scene.whole(index)).key("elements").key("at");
            return Err(
                doc.conflict(&at, format!("material runs through the end at {s} m, where elements come and go"))
            );
        }
    }
    Ok(())
}
