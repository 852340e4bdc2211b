//! The tables of a scene file as they are written: docs/scene.md in full, key by key. What is missing is `None`; an unknown key is
//! an error. Ranges and references are checked later (`check`).

use super::value::{At, FlowValue, RuleValue, ShapeValue};
use serde::Deserialize;

/// The root of a scene file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneTable {
    /// Name of the scene.
    pub name: Option<String>,
    /// Simulated time in s.
    pub duration: Option<f64>,
    /// Host step in s.
    pub dt: Option<f64>,
    /// Gravity in m/s^2.
    pub gravity: Option<[f64; 3]>,
    /// `"none"` or `"rapier"`.
    pub engine: Option<String>,
    /// Rapier's number of solver iterations.
    pub solver_iterations: Option<u32>,
    /// Rigid bodies.
    #[serde(default)]
    pub body: Vec<BodyTable>,
    /// Extension: bodies that hold to each other.
    #[serde(default)]
    pub joint: Vec<JointTable>,
    /// Cables.
    #[serde(default)]
    pub cable: Vec<CableTable>,
    /// Attachments.
    #[serde(default)]
    pub attachment: Vec<AttachmentTable>,
    /// Extension: cables tied to each other.
    #[serde(default)]
    pub junction: Vec<JunctionTable>,
    /// Point loads.
    #[serde(default)]
    pub load: Vec<LoadTable>,
    /// Probes.
    #[serde(default)]
    pub probe: Vec<ProbeTable>,
}

/// A `[[body]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyTable {
    /// Name.
    pub name: String,
    /// `"dynamic"`, `"fixed"` or `"kinematic"`.
    pub kind: Option<String>,
    /// Shape, in m.
    pub shape: Option<ShapeValue>,
    /// Mass in kg.
    pub mass: Option<f64>,
    /// Density in kg/m^3.
    pub density: Option<f64>,
    /// Principal moments of inertia in kg m^2.
    pub inertia: Option<[f64; 3]>,
    /// Origin in m.
    pub position: Option<[f64; 3]>,
    /// Axis times angle in rad.
    pub rotation: Option<[f64; 3]>,
    /// Velocity in m/s.
    pub velocity: Option<[f64; 3]>,
    /// Angular velocity in rad/s.
    pub angular_velocity: Option<[f64; 3]>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Rows of t, x, y, z (s, m).
    pub path: Option<Vec<[f64; 4]>>,
}

/// Extension: a `[[joint]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointTable {
    /// Name; default `joint-N` by position from 0.
    pub name: Option<String>,
    /// `"hinge"`, `"slider"`, `"ball"` or `"fixed"`.
    pub kind: String,
    /// A dynamic body.
    pub body: String,
    /// What it holds to: a body or `"world"`.
    pub to: String,
    /// Where the joint is at t = 0, in m, world axes.
    pub at: [f64; 3],
    /// Direction of a hinge or slider at t = 0, world axes.
    pub axis: Option<[f64; 3]>,
    /// True for a link of a multibody.
    pub multibody: Option<bool>,
}

/// A `[[cable]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CableTable {
    /// Name.
    pub name: String,
    /// Start shape in m.
    pub points: Vec<[f64; 3]>,
    /// Unstretched length in m.
    pub length: Option<f64>,
    /// `"straight"` or `"equilibrium"`.
    pub initial: Option<String>,
    /// Number of elements.
    pub elements: Option<usize>,
    /// Shape of the section.
    pub section: Option<SectionTable>,
    /// Density in kg/m^3.
    pub density: Option<f64>,
    /// Young's modulus in Pa.
    pub youngs_modulus: Option<f64>,
    /// EA in N.
    pub axial_stiffness: Option<f64>,
    /// EI in N m^2.
    pub bending_stiffness: Option<f64>,
    /// Mass per unstretched length in kg/m.
    pub mass_per_length: Option<f64>,
    /// Force strategy.
    pub rule: Option<RuleValue>,
    /// Extension: run a rule that leaves modes without energy all the same.
    pub allow_rank_deficient: Option<bool>,
    /// Time integrator.
    pub integrator: Option<IntegratorTable>,
    /// Initial velocity in m/s.
    pub velocity: Option<[f64; 3]>,
    /// Initial angular velocity about the start point in rad/s.
    pub angular_velocity: Option<[f64; 3]>,
    /// Internal damping.
    pub damping: Option<DampingTable>,
    /// Fluid drag.
    pub drag: Option<DragTable>,
    /// Buoyancy.
    pub buoyancy: Option<BuoyancyTable>,
    /// Extension: stress-free stretch and curvature.
    pub rest_shape: Option<RestShapeTable>,
    /// Extension: forces per length.
    #[serde(default)]
    pub line_load: Vec<LineLoadTable>,
    /// Extension: what gravity is multiplied by.
    pub gravity_scale: Option<f64>,
    /// Contact with bodies.
    pub contact: Option<ContactTable>,
    /// Breaking.
    #[serde(rename = "break")]
    pub breaking: Option<BreakTable>,
    /// Reeling.
    pub reel: Option<ReelTable>,
}

/// `section = { .. }`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SectionTable {
    /// Side in m.
    pub square: Option<f64>,
    /// Diameter in m.
    pub round: Option<f64>,
    /// Extension: outer and inner diameter in m.
    pub tube: Option<[f64; 2]>,
}

/// `integrator = { .. }`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IntegratorTable {
    /// Name of the method.
    pub method: Option<String>,
    /// Position error in m per host step.
    pub tolerance: Option<f64>,
    /// Equal steps per host step.
    pub substeps: Option<u32>,
    /// Extension: longest step in s.
    pub max_step: Option<f64>,
    /// Extension: share of the stability limit.
    pub stable: Option<f64>,
    /// Extension: `"game"`, `"engineering"` or `"reference"`.
    pub fidelity: Option<String>,
}

/// `[cable.damping]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DampingTable {
    /// Kelvin-Voigt time of the axial strain in s.
    pub axial: Option<f64>,
    /// Kelvin-Voigt time of the curvature in s.
    pub bending: Option<f64>,
}

/// `[cable.drag]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DragTable {
    /// Density of the fluid in kg/m^3.
    pub fluid_density: f64,
    /// Normal coefficient on the diameter.
    pub normal: Option<f64>,
    /// Tangential coefficient on the diameter.
    pub tangential: Option<f64>,
    /// Velocity of the fluid in m/s.
    pub flow: Option<FlowValue>,
    /// Extension: diameter in m, for a cable without section shape.
    pub diameter: Option<f64>,
}

/// `flow = { .. }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlowTable {
    /// Velocity in m/s where the factors are 1.
    pub velocity: [f64; 3],
    /// Factor by height.
    pub profile: Option<ProfileTable>,
    /// Factor by height after the power law of wind.
    pub power_law: Option<PowerLawTable>,
    /// Rows of t (s) and factor.
    pub history: Option<Vec<[f64; 2]>>,
}

/// `profile = { .. }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProfileTable {
    /// Direction of height.
    pub up: Option<[f64; 3]>,
    /// Rows of height (m) and factor.
    pub rows: Vec<[f64; 2]>,
}

/// `power_law = { .. }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PowerLawTable {
    /// Direction of height.
    pub up: Option<[f64; 3]>,
    /// Height in m where the factor is 1.
    pub reference: f64,
    /// Exponent.
    pub exponent: f64,
    /// Height in m above which the factor is constant.
    pub top: f64,
}

/// `[cable.rest_shape]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RestShapeTable {
    /// Stress-free stretch of the whole cable.
    pub stretch: Option<f64>,
    /// Stress-free curvature of the whole cable in 1/m.
    pub curvature: Option<f64>,
    /// Or pieces along the arc.
    #[serde(default)]
    pub piece: Vec<RestPieceTable>,
}

/// `[[cable.rest_shape.piece]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RestPieceTable {
    /// Arc length in m where it begins.
    pub from: f64,
    /// Stress-free stretch.
    pub stretch: Option<f64>,
    /// Stress-free curvature in 1/m.
    pub curvature: Option<f64>,
}

/// `[[cable.line_load]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LineLoadTable {
    /// Arc length in m where it begins.
    pub from: Option<f64>,
    /// Arc length in m where it ends.
    pub to: Option<f64>,
    /// Force in N per m of unstretched cable.
    pub force: [f64; 3],
}

/// `[cable.buoyancy]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BuoyancyTable {
    /// Density of the fluid in kg/m^3.
    pub fluid_density: f64,
    /// Coefficient of added mass.
    pub added_mass: Option<f64>,
    /// Extension: displaced area in m^2, for a cable without section shape.
    pub area: Option<f64>,
}

/// `[cable.contact]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactTable {
    /// Radius in m.
    pub radius: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
}

/// `[cable.break]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BreakTable {
    /// Breaking tension in N.
    pub tension: f64,
}

/// `[cable.reel]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReelTable {
    /// `"start"` or `"end"`.
    pub end: String,
    /// Rows of t (s) and rate (m/s).
    pub rate: Vec<[f64; 2]>,
}

/// An `[[attachment]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttachmentTable {
    /// Name; default `attachment-N` by position from 0.
    pub name: Option<String>,
    /// The cable.
    pub cable: String,
    /// Where on the cable.
    pub at: At,
    /// A body or `"world"`.
    pub body: String,
    /// Where on the body, in m.
    pub anchor: Option<[f64; 3]>,
    /// `"ball"` or `"clamp"`.
    pub kind: Option<String>,
}

/// Extension: a `[[junction]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JunctionTable {
    /// Name; default `junction-N` by position from 0.
    pub name: Option<String>,
    /// A cable.
    pub cable: String,
    /// Where on it.
    pub at: At,
    /// The cable that it is tied to.
    pub other: String,
    /// Where on that.
    pub other_at: At,
}

/// A `[[load]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadTable {
    /// The cable.
    pub cable: Option<String>,
    /// Where on the cable.
    pub at: Option<At>,
    /// Or a body.
    pub body: Option<String>,
    /// Where on the body, in m.
    pub point: Option<[f64; 3]>,
    /// Force in N.
    pub force: Option<[f64; 3]>,
    /// Moment in N m.
    pub moment: Option<[f64; 3]>,
    /// Time from zero to full in s.
    pub ramp: Option<f64>,
}

/// A `[[probe]]`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProbeTable {
    /// Name of the file.
    pub name: String,
    /// Interval in s.
    pub every: Option<f64>,
    /// A cable.
    pub cable: Option<String>,
    /// Where on the cable.
    pub at: Option<At>,
    /// A body.
    pub body: Option<String>,
    /// An attachment.
    pub attachment: Option<String>,
    /// A cable or `"all"`.
    pub energy: Option<String>,
    /// A cable or `"all"`.
    pub momentum: Option<String>,
}
