//! The scenes of `assets/hard`, which version 0.1 got wrong without a word: what they give now, beside a reference.

use crate::error::Error;
use crate::table::{Cell, Format, Table, shown};
use lariat_ancf::Vector3;
use lariat_scene::Warning;
use lariat_scene::run::{self, Options, ProbeRecord, Recording};
use lariat_scene::scene::{Purpose, Scene};
use std::path::Path;

/// What a scene is judged by.
enum Quantity {
    /// The relative velocity of two bodies at the end, per closing speed in m/s.
    Restitution([&'static str; 2], f64),
    /// The mean norm of an attachment's force over the last half, in N.
    MeanForce(&'static str),
    /// The largest norm of an attachment's force in N.
    PeakForce(&'static str),
    /// The largest distance of a body from its path in a fine run over this time in s, per distance that it goes there.
    Path(&'static str, f64),
    /// The same of the vector part of its attitude's quaternion.
    Attitude(&'static str, f64),
    /// The force of an attachment at rest in N.
    RestForce(&'static str),
    /// Energy made, per largest energy.
    EnergyMade,
    /// Its warnings alone.
    Warning,
}

/// The right value.
enum Reference {
    /// By a formula.
    Formula(f64, &'static str),
    /// By a run of a scene with these overrides.
    Fine(&'static str, &'static [&'static str]),
}

/// A scene with its quantity, its reference, and what version 0.1 gave.
struct Case(&'static str, Quantity, Reference, &'static str);

const FINE: [&str; 2] = ["dt=0.0010416666666666667", "cable.c.integrator={method=\"esdirk4\",tolerance=1e-7}"];
const FINE_BOOM: [&str; 2] = ["dt=0.0010416666666666667", "cable.line.integrator={method=\"esdirk4\",tolerance=1e-7}"];

fn cases() -> Vec<Case> {
    use Quantity::*;
    use Reference::*;
    let whirl = |rate: f64| Formula(0.1 * rate * rate * 0.7, "m w^2 r");
    let none = |what| Formula(0.0, what);
    vec![
        Case("blow_rebounds", Restitution(["free", "swing"], 2.936), none("Rapier alone"), "0.09 to 0.21"),
        Case("rotor_ball_game", MeanForce("a"), whirl(10.0), "838"),
        Case("rotor_ball_default", MeanForce("a"), whirl(10.0), "wrong"),
        Case("rotor_ball_default_damped", MeanForce("a"), whirl(10.0), "4.96"),
        Case("rotor_clamp_game", MeanForce("a"), whirl(3.0), "wrong"),
        Case("winch_circle_game", Path("b", 4.0), Fine("winch_circle_game", &FINE), "2.2 m off"),
        Case("hoist_game", PeakForce("h"), Fine("hoist_game", &FINE), "71 800"),
        Case("crane_slew_game", Path("l", 4.0), Fine("crane_slew_game", &FINE), "wrong"),
        Case("boom_impulse_joint", Attitude("boom", 0.5), Fine("boom_impulse_joint", &FINE_BOOM), "right"),
        Case("boom_multibody", Attitude("boom", 0.5), Fine("boom_impulse_joint", &FINE_BOOM), "a gap of 0.49 m"),
        Case("boom_multibody_game", Attitude("boom", 0.5), Fine("boom_impulse_joint", &FINE_BOOM), "makes 225 J"),
        Case("boom_multibody_ga0", Attitude("boom", 0.5), Fine("boom_impulse_joint", &FINE_BOOM), "a gap of 0.49 m"),
        Case("midpoint_heats", EnergyMade, none("energy law"), "heats"),
        Case("tolerance_1m_heats", EnergyMade, none("energy law"), "heats"),
        Case("payload_midpoint_1", EnergyMade, none("energy law"), "heats"),
        Case("static_hung_box", RestForce("hook"), Formula(50.0 * 9.80665, "m g"), "3.9"),
        Case("static_slings", RestForce("left"), Formula(5664.0, "m g/(2 sin 60)"), "the slings alone"),
        Case("static_stub_inverts", Warning, none("a stable equilibrium"), "inverted"),
        Case("silent_gpa", Warning, none("E in GPa"), "silent"),
        Case("silent_mm", Warning, none("a diameter in mm"), "silent"),
        Case("silent_unattached_bob", Warning, none("a body that nothing holds"), "silent"),
    ]
}

fn record(name: &str, overrides: &[&str], purpose: Purpose) -> Result<Recording, lariat_scene::Error> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/hard/{name}.toml"));
    let overrides: Vec<String> = overrides.iter().map(|text| text.to_string()).collect();
    let recording = run::collect(&Scene::read(&path, &overrides, purpose)?, purpose, &mut Options::default())?;
    match recording.failed {
        Some(error) => Err(error),
        None => Ok(recording),
    }
}

/// Returns the name of the kind of a warning, in words.
fn kind(warning: &Warning) -> String {
    let debug = match warning {
        Warning::Cable(warning) => format!("{warning:?}"),
        warning => format!("{warning:?}"),
    };
    let name = debug.chars().take_while(|c| c.is_alphabetic());
    let words = name.flat_map(|c| c.is_uppercase().then_some(' ').into_iter().chain(c.to_lowercase()));
    words.collect::<String>().trim_start().to_string()
}

fn probe<'a>(recording: &'a Recording, name: &str) -> Option<&'a ProbeRecord> {
    recording.probes.iter().find(|probe| probe.name == name)
}

/// Returns times and three columns of a probe, from the one of this name on.
fn vectors(recording: &Recording, name: &str, first: &str) -> Vec<(f64, Vector3<f64>)> {
    let Some(probe) = probe(recording, name) else { return Vec::new() };
    let Some(at) = probe.columns.iter().position(|column| *column == first) else { return Vec::new() };
    let rows = probe.rows.chunks_exact(probe.columns.len());
    rows.map(|row| (row[0], Vector3::new(row[at], row[at + 1], row[at + 2]))).collect()
}

/// Returns the largest distance of two paths at the times of the first, per largest distance from the start.
fn apart(one: &[(f64, Vector3<f64>)], other: &[(f64, Vector3<f64>)], until: f64) -> f64 {
    let nearest = |t: f64| other.iter().min_by(|a, b| (a.0 - t).abs().total_cmp(&(b.0 - t).abs()));
    let (mut distance, mut way) = (0.0f64, 0.0f64);
    for (t, x) in one.iter().filter(|(t, _)| *t <= until) {
        if let (Some((_, y)), Some((_, start))) = (nearest(*t), other.first()) {
            (distance, way) = (distance.max((x - y).norm()), way.max((y - start).norm()));
        }
    }
    distance / way
}

impl Quantity {
    fn name(&self) -> String {
        match self {
            Quantity::Restitution(..) => "restitution".into(),
            Quantity::MeanForce(probe) => format!("mean force at `{probe}` in N"),
            Quantity::PeakForce(probe) => format!("largest force at `{probe}` in N"),
            Quantity::Path(probe, until) => format!("path of `{probe}` until {until} s, relative"),
            Quantity::Attitude(probe, until) => format!("attitude of `{probe}` until {until} s, relative"),
            Quantity::RestForce(probe) => format!("force at `{probe}` in N"),
            Quantity::EnergyMade => "energy made, relative".into(),
            Quantity::Warning => "warned of".into(),
        }
    }

    fn value(&self, now: &Recording, fine: Option<&Recording>) -> f64 {
        let forces = |name: &str| vectors(now, name, "fx");
        match self {
            Quantity::Restitution([a, b], speed) => {
                let last = |name: &str| vectors(now, name, "vx").last().map_or(f64::NAN, |(_, v)| v.x);
                (last(a) - last(b)) / speed
            }
            Quantity::MeanForce(name) => {
                let all = forces(name);
                let late = &all[all.len() / 2..];
                late.iter().map(|(_, f)| f.norm()).sum::<f64>() / late.len() as f64
            }
            Quantity::PeakForce(name) => forces(name).iter().map(|(_, f)| f.norm()).fold(0.0, f64::max),
            Quantity::RestForce(name) => forces(name).last().map_or(f64::NAN, |(_, f)| f.norm()),
            Quantity::Path(name, until) | Quantity::Attitude(name, until) => {
                let first = if matches!(self, Quantity::Path(..)) { "x" } else { "qx" };
                let path = |recording: &Recording| vectors(recording, name, first);
                fine.map_or(f64::NAN, |fine| apart(&path(now), &path(fine), *until))
            }
            Quantity::EnergyMade => now.summary.energy_balance.as_ref().map_or(f64::NAN, |b| b.made()),
            Quantity::Warning => f64::NAN,
        }
    }
}

/// Returns the table; `progress` is called with a line for each scene.
///
/// # Errors
/// [`Error::Scene`] if a reference run fails.
pub fn table(progress: &mut dyn FnMut(&str)) -> Result<Table, Error> {
    let mut rows = Vec::new();
    for Case(name, quantity, reference, before) in cases() {
        let purpose = if name.starts_with("static") { Purpose::Static } else { Purpose::Run };
        let fine = match &reference {
            Reference::Fine(scene, overrides) => Some(record(scene, overrides, purpose)?),
            Reference::Formula(..) => None,
        };
        let (expected, source): (Cell, _) = match &reference {
            Reference::Formula(value, source) => ((*value).into(), *source),
            Reference::Fine(..) => match quantity {
                Quantity::PeakForce(_) => (fine.as_ref().map(|fine| quantity.value(fine, None)).into(), "fine run"),
                _ => (0.0.into(), "fine run"),
            },
        };
        let (now, said) = match record(name, &[], purpose) {
            Ok(now) => {
                let mut names: Vec<String> = now.summary.warnings.iter().map(kind).collect();
                names.dedup();
                let value = quantity.value(&now, fine.as_ref());
                (if value.is_nan() { Cell::Empty } else { value.into() }, names.join(", "))
            }
            Err(error) => (Cell::Empty, format!("refused: {error}").lines().next().unwrap_or_default().to_string()),
        };
        progress(&format!("{name}: {now:?} {said}"));
        rows.push(vec![name.into(), quantity.name().into(), expected, source.into(), before.into(), now, said.into()]);
    }
    let columns = vec![
        shown("scene", "scene", Format::Plain),
        shown("quantity", "quantity", Format::Plain),
        shown("reference", "reference", Format::Short),
        shown("source", "source", Format::Plain),
        shown("version_0_1", "version 0.1", Format::Plain),
        shown("now", "now", Format::Short),
        shown("warnings", "warnings", Format::Plain),
    ];
    Ok(Table { name: "coupling_hard", columns, rows })
}
