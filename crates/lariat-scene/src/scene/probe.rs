//! `[[probe]]`: what a run writes down.

use super::references::{Position, arc_length, body, cable};
use super::{MAX_COUNT, Scene};
use crate::document::{Document, KeyPath};
use crate::error::{Error, Problem};
use crate::schema::{Choose, Kind, POSITION, POSITIVE, table};

table! {
    /// Writes `DIR/probes/NAME.csv`.
    struct ProbeTable("[[probe]]") {
        /// No other probe has it, capitals aside.
        name: String = required, Kind::Parsed { accepted: "a text that can name a file: without / \\ : * ? \" < > | and leading dot", parse: can_name_a_file };
        /// Interval of the samples: at most 1e8 samples in all. A sample between two host steps is read from a copy, stepped up to there.
        every: Option<f64> = ("each host step"), Kind::Number(POSITIVE), "s";
        /// Name of a cable, with `at`.
        cable: Option<String> = (), Kind::Text;
        /// Arc length of the unstretched cable, from 0 to its length, beside `cable` or `torsion`.
        at: Option<Position> = (), POSITION, "m";
        /// Name of a body.
        body: Option<String> = (), Kind::Text;
        /// Name of an attachment.
        attachment: Option<String> = (), Kind::Text;
        /// Name of a cable with a reel.
        reel: Option<String> = (), Kind::Text;
        /// Name of a sheave.
        sheave: Option<String> = (), Kind::Text;
        /// Name of a cable with torsion; with `at`, the part between clamps there, by default the first.
        torsion: Option<String> = (), Kind::Text;
        /// Name of a cable, or `"all"` for cables and dynamic bodies.
        energy: Option<String> = (), Kind::Text;
        /// Name of a cable, or `"all"` for cables and dynamic bodies.
        momentum: Option<String> = (), Kind::Text;
    }
    choose Choose::ExactlyOne(&["cable", "body", "attachment", "reel", "sheave", "torsion", "energy", "momentum"]);
}

/// A checked probe.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeScene {
    /// Name; its file is `probes/NAME.csv`.
    pub name: String,
    /// Interval in s; `None` = each host step.
    pub every: Option<f64>,
    /// What it reads.
    pub target: Target,
}

/// What a probe reads; numbers are positions in the scene's lists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point of a cable.
    Point {
        /// The cable.
        cable: usize,
        /// Arc length in m.
        arc_length: f64,
    },
    /// Position and velocity of a body.
    Body(usize),
    /// Force, moment and gap of an attachment.
    Attachment(usize),
    /// Reel of a cable.
    Reel(usize),
    /// Sheave.
    Sheave(usize),
    /// Torsion of a cable at a point.
    Torsion {
        /// The cable.
        cable: usize,
        /// Arc length in m.
        arc_length: f64,
    },
    /// Energy of a cable, or of all.
    Energy {
        /// The cable; `None` for all, with the bodies.
        cable: Option<usize>,
        /// Whether one of them has torsion, whose energy then is a column.
        torsion: bool,
    },
    /// Momentum of a cable, or of all.
    Momentum(Option<usize>),
}

fn can_name_a_file(name: &str) -> Result<(), String> {
    let forbidden = |c: char| c.is_control() || r#"/\:*?"<>|"#.contains(c);
    if name.is_empty() || name.starts_with('.') || name.contains(forbidden) {
        return Err(format!("{name:?} cannot name a file"));
    }
    Ok(())
}

/// Reads the probe in row `i`.
pub(super) fn read(doc: &Document<'_>, scene: &Scene, i: usize, row: ProbeTable) -> Result<ProbeScene, Error> {
    let at = KeyPath::root("probe").item(i);
    // file systems that ignore case would write two probes into one file
    if scene.probes.iter().any(|p| p.name.to_lowercase() == row.name.to_lowercase()) {
        return Err(doc.error(&at.key("name"), Problem::NameTaken(row.name)));
    }
    if let Some(every) = row.every.filter(|every| scene.duration / every > MAX_COUNT) {
        let problem = format!("{every} s makes {:.3e} samples", scene.duration / every);
        return Err(doc.conflict(&at.key("every"), problem));
    }
    if row.at.is_some() && row.cable.is_none() && row.torsion.is_none() {
        let problem = Problem::Conflict("at is for a probe of a cable".to_string());
        return Err(doc.error_accepting(&at.key("at"), problem, "at beside cable or torsion"));
    }
    let cable_or_all = |key: &str, name: &str| match name {
        "all" => Ok(None),
        _ => cable(doc, &at.key(key), scene, name).map(Some),
    };
    let target = if let Some(name) = &row.cable {
        let cable = cable(doc, &at.key("cable"), scene, name)?;
        let point = row.at.ok_or_else(|| doc.missing(&at.key("at")))?;
        Target::Point { cable, arc_length: arc_length(doc, &at.key("at"), point, scene.whole_length(cable))? }
    } else if let Some(name) = &row.body {
        Target::Body(body(doc, &at.key("body"), scene, name)?)
    } else if let Some(name) = &row.attachment {
        let known = || scene.attachments.iter().map(|a| a.name.as_str());
        let unknown = || doc.unknown_name(&at.key("attachment"), "attachment", name, known());
        Target::Attachment(known().position(|n| n == name).ok_or_else(unknown)?)
    } else if let Some(name) = &row.reel {
        let cable = cable(doc, &at.key("reel"), scene, name)?;
        if scene.reel_part(cable).is_none() {
            return Err(doc.conflict(&at.key("reel"), format!("cable {name:?} has no reel")));
        }
        Target::Reel(cable)
    } else if let Some(name) = &row.sheave {
        let known = || scene.sheaves.iter().map(|s| s.name.as_str());
        let unknown = || doc.unknown_name(&at.key("sheave"), "sheave", name, known());
        Target::Sheave(known().position(|n| n == name).ok_or_else(unknown)?)
    } else if let Some(name) = &row.torsion {
        let cable = cable(doc, &at.key("torsion"), scene, name)?;
        if scene.cables[cable].effects.torsion.is_none() {
            return Err(doc.conflict(&at.key("torsion"), format!("cable {name:?} has no torsion")));
        }
        let point = |point| arc_length(doc, &at.key("at"), point, scene.whole_length(cable));
        Target::Torsion { cable, arc_length: row.at.map_or(Ok(0.0), point)? }
    } else if let Some(name) = &row.energy {
        let cable = cable_or_all("energy", name)?;
        let read = cable.map_or(&scene.cables[..], |index| &scene.cables[index..=index]);
        let torsion = read.iter().any(|cable| cable.effects.torsion.is_some());
        Target::Energy { cable, torsion }
    } else {
        Target::Momentum(cable_or_all("momentum", row.momentum.as_deref().unwrap_or("all"))?)
    };
    Ok(ProbeScene { name: row.name, every: row.every, target })
}
