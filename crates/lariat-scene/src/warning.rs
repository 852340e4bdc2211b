//! Warnings: what is probably not meant, or not good enough, in a scene that runs.
//!
//! A warning changes neither results nor exit codes. It says where, how much, and what to do.

use serde::{Deserialize, Serialize, Serializer};

/// A warning about a scene or a run; its text says what to do. In `summary.json` it is its fields with `kind` and `text`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Warning {
    /// The elements are too long for the shape.
    #[error(
        "cable {cable:?}: the mesh with elements = {elements} puts points probably more than {error_m:.1e} m off: try elements = {enough}"
    )]
    CoarseMesh {
        /// Name of the cable.
        cable: String,
        /// Estimate of the largest error of position in m.
        error_m: f64,
        /// Number of elements.
        elements: usize,
        /// Number of elements that would do.
        enough: usize,
    },
    /// The elements are too long for a small motion of a cable whose shape is resolved.
    #[error(
        "cable {cable:?}: the mesh with elements = {elements} is probably off by {error_m:.1e} m, where the largest displacement is \
         {displacement_m:.1e} m: try elements = {enough}"
    )]
    CoarseMotion {
        /// Name of the cable.
        cable: String,
        /// Estimate of the error of the displacement in m.
        error_m: f64,
        /// Largest displacement of a node in m.
        displacement_m: f64,
        /// Number of elements.
        elements: usize,
        /// Number of elements that would do.
        enough: usize,
    },
    /// An element between points that are held or loaded turns too much.
    #[error(
        "cable {cable:?}: an element turns by {turn_rad:.2} rad from end to end: try elements = {enough} instead of {elements}"
    )]
    CoarseElement {
        /// Name of the cable.
        cable: String,
        /// Angle between the slopes at the ends of the element in rad.
        turn_rad: f64,
        /// Number of elements.
        elements: usize,
        /// Number of elements that would do.
        enough: usize,
    },
    /// The tension is beyond the range of the law.
    #[error(
        "cable {cable:?}: at {time_s:.4} s its tension is {tension_n:.3e} N, {percent:.1} % of EA = {axial_stiffness_n:.3e} N: the law (Green's strain) \
         holds for small strain and is stiffer than Hooke's beyond; check Young's modulus (Pa), section (m), masses (kg) and length, or \
         add to EA",
        percent = 100.0 * .tension_n / .axial_stiffness_n
    )]
    LargeStrain {
        /// Name of the cable.
        cable: String,
        /// Time of the largest tension in s.
        time_s: f64,
        /// Largest tension in N.
        tension_n: f64,
        /// Axial stiffness EA in N.
        axial_stiffness_n: f64,
    },
    /// A reel whose rate comes near the speed of waves.
    #[error(
        "cable {cable:?}: at {time_s:.3} s its reel turns with {ratio:.2} of the speed of transverse waves: above 0.3 waves of the mesh may \
         grow; give the cable damping, or a slower rate"
    )]
    FastReel {
        /// Name of the cable.
        cable: String,
        /// Time of the largest ratio in s.
        time_s: f64,
        /// Rate over the speed of transverse waves.
        ratio: f64,
    },
    /// Too short for its thickness.
    #[error(
        "cable {cable:?}: it is {ratio:.3} times as long as thick ({length_m:.4} m, {diameter_m:.3e} m): below 10 its shear is not small, \
         and it has none; check the section, in m"
    )]
    Stubby {
        /// Name of the cable.
        cable: String,
        /// Unstretched length over thickness.
        ratio: f64,
        /// Unstretched length in m.
        length_m: f64,
        /// Outer diameter or side in m; without a section that of the solid round one with the same EI/EA.
        diameter_m: f64,
    },
    /// Thicker than any cable.
    #[error("cable {cable:?}: it is {diameter_m} m thick: the section is in m; was {diameter_m} mm meant?")]
    Thick {
        /// Name of the cable.
        cable: String,
        /// Outer diameter or side in m.
        diameter_m: f64,
    },
    /// Softer than any rope.
    #[error(
        "cable {cable:?}: Young's modulus is {youngs_modulus_pa} Pa, softer than any rope or rubber: it is in Pa (steel 2.1e11, rubber \
         1e6 to 1e8); was {youngs_modulus_pa} GPa meant?"
    )]
    SoftMaterial {
        /// Name of the cable.
        cable: String,
        /// Young's modulus in Pa.
        youngs_modulus_pa: f64,
    },
    /// A dynamic body that nothing holds and nothing stops.
    #[error(
        "body {body:?}: nothing holds it, and no body is under it: it falls freely, {fall_m:.3e} m in the {duration_s} s of the run; \
         attach a cable to it, join it, or set gravity = [0, 0, 0]"
    )]
    FallsFreely {
        /// Name of the body.
        body: String,
        /// Fall from rest during the run in m.
        fall_m: f64,
        /// Duration of the run in s.
        duration_s: f64,
    },
    /// A cable that starts inside a body.
    #[error(
        "cable {cable:?}: at {at_m:.4} m it starts {depth_m:.2e} m inside body {body:?}: it passes through, and \
         [cable.contact] does not push it out; check the points of the cable and the place of the body"
    )]
    StartsInside {
        /// Name of the cable.
        cable: String,
        /// Name of the body.
        body: String,
        /// Arc length of the deepest node in m.
        at_m: f64,
        /// Its distance from the surface in m.
        depth_m: f64,
    },
    /// A cable that passes through a body.
    #[error(
        "cable {cable:?}: from {time_s:.3} s on it passes through body {body:?}: without [cable.contact] cables touch nothing"
    )]
    PassesThrough {
        /// Name of the cable.
        cable: String,
        /// Name of the body.
        body: String,
        /// Time in s at which it was first found in it.
        time_s: f64,
    },
    /// Integration makes energy.
    #[error(
        "the run makes energy: {made_j:.1e} J until {time_s:.4} s, {percent:.2} % of the largest energy or work ({scale_j:.3e} J): take a smaller tolerance, \
         shorter steps, or the discrete gradient (fidelity = \"game\"), which makes none", percent = 100.0 * .made_j / .scale_j
    )]
    EnergyMade {
        /// Time in s.
        time_s: f64,
        /// Energy made in J.
        made_j: f64,
        /// Largest energy or work so far in J.
        scale_j: f64,
    },
    /// Integration takes energy.
    #[error(
        "integration takes {lost_j:.1e} J until {time_s:.4} s, {percent:.1} % of the largest energy or work ({scale_j:.3e} J), besides damping and drag: the \
         motion is damped that much; take a smaller tolerance or shorter steps", percent = 100.0 * .lost_j / .scale_j
    )]
    EnergyLost {
        /// Time in s.
        time_s: f64,
        /// Energy lost in J.
        lost_j: f64,
        /// Largest energy or work so far in J.
        scale_j: f64,
    },
    /// An error that was asked for is not proven, because refining does not help.
    #[error(
        "the error of {asked_m:e} m is not proven{}: meshes up to elements = {elements} do not come closer{}", until(*.horizon_s, *.estimate_m),
        branches(*.other_branch)
    )]
    NoConvergence {
        /// Error that was asked for in m.
        asked_m: f64,
        /// Estimate of the error in m, if the meshes could be compared.
        estimate_m: Option<f64>,
        /// Elements of the cable that has most.
        elements: usize,
        /// First host time in s at which the error is not proven.
        horizon_s: Option<f64>,
        /// True if the runs are apart by more than a tenth of the longest cable.
        other_branch: bool,
    },
    /// An error that was asked for is not proven with as many elements as are tried.
    #[error("the error of {asked_m:e} m is not proven{} with elements = {elements}, the most that are tried{}", until(*.horizon_s, *.estimate_m),
        branches(*.other_branch)
    )]
    ErrorNotReached {
        /// Error that was asked for in m.
        asked_m: f64,
        /// Estimate of the error in m, if the meshes could be compared.
        estimate_m: Option<f64>,
        /// Elements of the cable that has most.
        elements: usize,
        /// First host time in s at which the error is not proven.
        horizon_s: Option<f64>,
        /// True if the runs are apart by more than a tenth of the longest cable.
        other_branch: bool,
    },
    /// A rule with zero-energy modes, as the scene allows.
    #[error("cable {cable:?}: rule {rule} has zero-energy modes, as allowed: {reason}")]
    RankDeficient {
        /// Name of the cable.
        cable: String,
        /// Name of the rule.
        rule: String,
        /// Which modes.
        reason: String,
    },
    /// An equilibrium that is not stable.
    #[error("cable {cable:?}: the equilibrium found is unstable or indifferent (stiffness not positive definite){}", compressed(.rule, *.compression))]
    UnstableEquilibrium {
        /// Name of the cable.
        cable: String,
        /// Name of the rule.
        rule: String,
        /// Largest compressive strain, if it is beyond what the rule holds.
        compression: Option<f64>,
    },
    /// A dynamic body that statics leave where it is drawn.
    #[error("body {body:?}: no cable is attached to it: it is left where it is drawn, and may not be at rest there")]
    LeftAsDrawn {
        /// Name of the body.
        body: String,
    },
    /// Cable and body start at different velocities.
    #[error(
        "attachment {attachment:?}: cable and body start with velocities {difference_m_s:.3e} m/s apart, which gives a shock: give both the \
         same `velocity` there"
    )]
    VelocityJump {
        /// Name of the attachment.
        attachment: String,
        /// Difference of the velocities in m/s.
        difference_m_s: f64,
    },
}

fn until(horizon: Option<f64>, estimate: Option<f64>) -> String {
    let horizon = horizon.map_or(String::new(), |time| format!(" from {time:.4} s on"));
    estimate.map_or(horizon.clone(), |estimate| format!("{horizon} (estimate {estimate:.1e} m)"))
}

fn branches(other: bool) -> &'static str {
    if other {
        "; the runs follow different branches: several equilibria, or a motion that its start does not determine"
    } else {
        ""
    }
}

fn compressed(rule: &str, compression: Option<f64>) -> String {
    let advice = |strain: f64| {
        let percent = 100.0 * strain;
        format!(
            "; it is compressed by {percent:.2} %, and rule {rule} holds thick elements to 0.1 % only: see rule exact-3"
        )
    };
    compression.map_or(String::new(), advice)
}

/// Serialises warnings with their texts.
///
/// # Errors
/// As the serialiser.
pub(crate) fn with_texts<S: Serializer>(warnings: &[Warning], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct WithText<'a> {
        text: String,
        #[serde(flatten)]
        warning: &'a Warning,
    }
    serializer.collect_seq(warnings.iter().map(|warning| WithText { text: warning.to_string(), warning }))
}
