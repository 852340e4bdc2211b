//! Warnings: what is probably not meant, or not good enough, in a scene that runs.
//!
//! A warning changes neither results nor exit codes. It says where, how much, and what to do.

mod level;
mod told;

pub(crate) use told::{lines, with_texts};

use lariat_ancf::warning::{Interface, less_energy};
use serde::{Deserialize, Serialize};

/// A warning about a scene or a run; its text says what to do. In `summary.json` it is its fields
/// with `kind`, `text`, `level` and, if it follows from another one, `explained_by`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Warning {
    /// A dynamic body that nothing holds and nothing stops.
    #[error(
        "body {body:?}: nothing holds it, loads carry less than its weight, and no body is under it: it falls, {fall_m:.3e} m in the {duration_s} s of \
         the run; attach a cable to it, join it, or set gravity = [0, 0, 0]"
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
        "cable {cable:?}: at {at_m:.4} m it starts {depth_m:.2e} m inside body {body:?}{}",
        if *.own {
            ", which it is attached to: [cable.contact] holds it there, squeezed, and with any force until it is out; draw it outside, by `points` \
             around the body"
        } else {
            ": it passes through, and [cable.contact] does not push it out; check the points of the cable and the place of the body"
        }
    )]
    StartsInside {
        /// Name of the cable.
        cable: String,
        /// Name of the body.
        body: String,
        /// Arc length of the deepest place in m.
        at_m: f64,
        /// Its distance from the surface in m; in a body thinner than an element, half the length
        /// inside.
        depth_m: f64,
        /// Whether it is attached to the body, and inside beyond what the attachment needs.
        #[serde(default)]
        own: bool,
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
    /// An attachment whose two sides are apart.
    #[error(
        "attachment {attachment:?}: cable and anchor are {gap_m:.1e} m apart at {time_s:.4} s{}",
        if *.closed { ": take a shorter `dt`, or find what holds the body back" } else { ", and never met: start them together, or run longer" }
    )]
    OpenGap {
        /// Name of the attachment.
        attachment: String,
        /// Name of its cable.
        #[serde(default)]
        cable: String,
        /// Time in s.
        time_s: f64,
        /// Largest distance in m since they met, or else the least.
        gap_m: f64,
        /// Whether they met.
        closed: bool,
    },
    /// An attachment to a body on joints that did not move as predicted for a second, or whose joints came apart.
    #[error(
        "attachment {attachment:?}: the joints of its body did not hold it as predicted: {}; do not trust its position and the forces of its cables: take a \
         shorter `dt`, more iterations or a multibody, weld links into one body, or keep heavy links away from light ones", unsettled([*.time_s, *.steps, *.force, *.gap_m], *.foreseen)
    )]
    Unsettled {
        /// Name of the attachment.
        attachment: String,
        /// Name of its cable.
        #[serde(default)]
        cable: String,
        /// Time in s at the end of the worst half second, or of the largest gap.
        time_s: f64,
        /// Share of the steps in which the body deviated from its prediction.
        steps: f64,
        /// Difference between the forces that were read and those that moved the body, as a share
        /// of these.
        force: f64,
        /// Distance in m by which a joint of the body came apart; 0 where all of them hold.
        #[serde(default)]
        gap_m: f64,
        /// Whether that is what it is to open by, from what it carries, and has not shown yet.
        #[serde(default)]
        foreseen: bool,
    },
    /// A sheave that a point of its cable stopped.
    #[error(
        "sheave {sheave:?}: it stopped at {time_s:.3} s, before a held or loaded point of its cable, or its last element, came to the wheel"
    )]
    SheaveStopped {
        /// Name of the sheave.
        sheave: String,
        /// Time in s.
        time_s: f64,
    },
    /// A tension in equilibrium that is off because the mesh is smooth where the cable turns.
    #[error(
        "cable {cable:?}: its tension at {at_m:.4} m is {tension_n:.4e} N, and {fine_n:.4e} N on a mesh that is fine where it turns at loads and what holds \
         it, {:.0} % of the largest: take `elements = {{ count = {elements}, finest = \"auto\" }}`", 100.0 * .share
    )]
    CoarseTension {
        /// Name of the cable.
        cable: String,
        /// Arc length in m.
        at_m: f64,
        /// Tension there in N.
        tension_n: f64,
        /// Tension in N on the finer mesh.
        fine_n: f64,
        /// Their difference over the largest tension of the cable.
        share: f64,
        /// Its number of elements.
        elements: usize,
    },
    /// A kink of a cable that is too stiff for a hinge.
    #[error(
        "cable {cable:?}: its kink at {at_m:.4} m leaves out the moment there, within {layer_m:.1e} m of it, which puts points up to {error_m:.1e} m off at \
         {time_s:.3} s: leave the kink out, with `elements = {mesh}`"
    )]
    StiffKink {
        /// Name of the cable.
        cable: String,
        /// Arc length of the kink in m.
        at_m: f64,
        /// Time in s.
        time_s: f64,
        /// Length in m within which the cable bends, `sqrt(EI/T)`.
        layer_m: f64,
        /// Estimate of the error of position in m.
        error_m: f64,
        /// Value of `elements` with which the cable is resolved there without a kink.
        mesh: String,
    },
    /// A part of a cable that turned at a wheel, whose points do not follow it.
    #[error(
        "sheave {sheave:?}: a part of its cable turned there by {angle_rad:.3} rad, at {time_s:.3} s: the point where it leaves the wheel is fixed to \
         its body, and {error_m:.1e} m off, {:.2} % of that part; take a smaller radius, or a longer part", 100.0 * .error_m / .part_m
    )]
    WheelTurned {
        /// Name of the sheave.
        sheave: String,
        /// Angle in rad between the directions of the part at the start and then, seen from the
        /// body.
        angle_rad: f64,
        /// Time in s of the largest share of the error.
        time_s: f64,
        /// Radius times angle in m.
        error_m: f64,
        /// Length of the part then in m.
        part_m: f64,
    },
    /// A load that the run ends too early for.
    #[error(
        "the load on {on:?} has a ramp of {ramp_s} s, of which the run of {duration_s} s sees {percent:.0} %: make the ramp shorter, or the run longer",
        percent = 100.0 * .duration_s / .ramp_s
    )]
    UnfinishedRamp {
        /// Name of the cable or body.
        on: String,
        /// Time from zero to the full load in s.
        ramp_s: f64,
        /// Duration of the run in s.
        duration_s: f64,
    },
    /// Integration makes energy.
    #[error(
        "the run makes energy: {made_j:.1e} J until {time_s:.4} s, {percent:.2} % of the largest energy or work ({scale_j:.3e} J): {}",
        Interface::Scene.text(&less_energy(*.discrete_gradient)), percent = 100.0 * .made_j / .scale_j
    )]
    EnergyMade {
        /// Time in s.
        time_s: f64,
        /// Energy made in J.
        made_j: f64,
        /// Largest energy or work so far in J.
        scale_j: f64,
        /// Whether the method of all cables is the discrete gradient.
        #[serde(default)]
        discrete_gradient: bool,
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
        "the error of {asked_m:e} m is not proven{}: {}{}", until(*.horizon_s, *.estimate_m),
        failed.clone().unwrap_or_else(|| apart(*.steps, *.elements)), branches(*.other_branch)
    )]
    NoConvergence {
        /// Error that was asked for in m.
        asked_m: f64,
        /// Estimate of the error in m, if the meshes could be compared.
        estimate_m: Option<f64>,
        /// Elements of the cable that has most.
        elements: usize,
        /// True if it is runs with shorter steps that do not come closer, and not finer meshes.
        #[serde(default)]
        steps: bool,
        /// First host time in s at which the error is not proven.
        horizon_s: Option<f64>,
        /// True if the runs are apart by more than a tenth of the longest cable.
        other_branch: bool,
        /// Which run failed, and why, if that ended the study.
        #[serde(default)]
        failed: Option<String>,
    },
    /// An error that was asked for is not proven with as many elements as are tried.
    #[error("the error of {asked_m:e} m is not proven{} with elements = {elements}{}{}", until(*.horizon_s, *.estimate_m),
        would_need(*.elements_needed), branches(*.other_branch)
    )]
    ErrorNotReached {
        /// Error that was asked for in m.
        asked_m: f64,
        /// Estimate of the error in m, if the meshes could be compared.
        estimate_m: Option<f64>,
        /// Elements of the cable that has most.
        elements: usize,
        /// Elements that it would need about, by the order that the runs show.
        #[serde(default)]
        elements_needed: Option<usize>,
        /// First host time in s at which the error is not proven.
        horizon_s: Option<f64>,
        /// True if the runs are apart by more than a tenth of the longest cable.
        other_branch: bool,
    },
    /// An error of tensions or moments that was asked for and is not proven.
    #[error("the error {target} is not proven{} with elements = {elements}{}{}", until(*.horizon_s, None),
        failed.as_ref().map_or_else(|| would_need(*.elements_needed), |run| format!(": {run}")), branches(*.other_branch)
    )]
    ForcesNotProven {
        /// What was asked for.
        target: lariat_ancf::study::Target,
        /// Estimate of the error in N or N m, or as a share, if the meshes could be compared.
        estimate: Option<f64>,
        /// Elements of the cable that has most.
        elements: usize,
        /// Elements that it would need about, by the order that the runs show.
        elements_needed: Option<usize>,
        /// First host time in s at which the error is not proven.
        horizon_s: Option<f64>,
        /// True if the runs are apart by more than a tenth of the longest cable.
        other_branch: bool,
        /// Which run failed, and why, if that ended the study.
        #[serde(default)]
        failed: Option<String>,
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
    /// A body in water that is not small beside the wave.
    #[error(
        "body {body:?}: it is {size_m:.3} m large in waves of {wave_length_m:.3} m: it would disturb them, and feels them as if it were small; take it for a \
         rough estimate"
    )]
    LargeInWaves {
        /// Name of the body.
        body: String,
        /// Diameter of the ball about its origin that holds its shape in m.
        size_m: f64,
        /// Length of the wave in m.
        wave_length_m: f64,
    },
    /// Water that is lighter than any liquid.
    #[error(
        "water: its density is {density_kg_m3} kg/m^3, less than that of any liquid: it is in kg/m^3; was {density_kg_m3} g/cm^3 or t/m^3 meant?"
    )]
    LightWater {
        /// Density in kg/m^3.
        density_kg_m3: f64,
    },
    /// A dynamic body that statics leave where it is drawn.
    #[error("body {body:?}: no cable is attached to it: it is left where it is drawn, and may not be at rest there")]
    LeftAsDrawn {
        /// Name of the body.
        body: String,
    },
    /// Cable and body start at different velocities.
    #[error(
        "attachment {attachment:?}: cable and body start with velocities {difference_m_s:.3e} m/s apart, a shock of {force_n:.1e} N: give both the \
         same `velocity` there"
    )]
    VelocityJump {
        /// Name of the attachment.
        attachment: String,
        /// Name of its cable.
        #[serde(default)]
        cable: String,
        /// Force in N of the wave that the difference makes in the cable.
        #[serde(default)]
        force_n: f64,
        /// Difference of the velocities in m/s.
        difference_m_s: f64,
    },
    /// A cable that is strained where its drawn shape has corners.
    #[error(
        "cable {cable:?}: it starts with {energy_j:.2e} J of strain at the corners of its points, enough to throw it at {speed_m_s:.1e} m/s; the sharpest, \
         point {corner}, turns by {turn_rad:.2} rad within an element{}: draw an arc, with many points and some elements along it, or set initial = \"equilibrium\"",
        if *.slack { ", and slack segments sag in arcs of their own, which meet at angles" } else { "" }
    )]
    DrawnCorner {
        /// Name of the cable.
        cable: String,
        /// Row of `points` with the sharpest corner, counted from 0.
        corner: usize,
        /// Angle between the segments there in rad.
        turn_rad: f64,
        /// Whether the cable is longer than drawn, and its segments are arcs.
        slack: bool,
        /// Axial strain energy at the start beyond that of an even stretch in J.
        energy_j: f64,
        /// Speed of the whole cable with that energy in m/s.
        speed_m_s: f64,
    },
    /// An anchor far from all of the shape of its body.
    #[error(
        "attachment {attachment:?}: its anchor is {distance_m:.3e} m from the origin of body {body:?}, whose shape reaches {radius_m:.3e} m: the anchor is in the axes of the body; was a point of the \
         world meant?"
    )]
    FarAnchor {
        /// Name of the attachment.
        attachment: String,
        /// Name of its cable.
        #[serde(default)]
        cable: String,
        /// Name of the body.
        body: String,
        /// Distance of the anchor from the origin of the body in m.
        distance_m: f64,
        /// Radius of a sphere about the origin that holds the shape in m.
        radius_m: f64,
    },
    /// A gap that closes.
    #[error(
        "attachment {attachment:?}: it starts {gap_m:.3e} m from the point of its cable, which is drawn there: what that pull makes is in no balance of energy; \
         let both start at one point where energies and forces are read"
    )]
    ClosingGap {
        /// Name of the attachment.
        attachment: String,
        /// Name of its cable.
        cable: String,
        /// Distance in m.
        gap_m: f64,
    },
    /// A body that moves with others by impulse joints and by those of a multibody at once.
    #[error(
        "attachment {attachment:?}: the body {body:?} moves with others by joints with `multibody` and by some without, and how such bodies answer a cable is not predicted: \
         its motion and forces may be far off; give all joints that connect them the same `multibody`"
    )]
    MixedJoints {
        /// Name of the attachment.
        attachment: String,
        /// Name of its cable.
        cable: String,
        /// Name of the body.
        body: String,
    },
    /// A force that strains the cable beyond its law.
    #[error(
        "cable {cable:?}: the force on it at {at_m:.4} m is {force_n:.3e} N, {percent:.0} % of EA = {axial_stiffness_n:.3e} N, and steps will be very short: check the force \
         (N), Young's modulus (Pa) and section (m)", percent = 100.0 * .force_n / .axial_stiffness_n
    )]
    LargeLoad {
        /// Name of the cable.
        cable: String,
        /// Arc length in m.
        at_m: f64,
        /// Force in N.
        force_n: f64,
        /// EA in N.
        axial_stiffness_n: f64,
    },
    /// A rotation by more than a turn.
    #[error(
        "body {body:?}: its rotation is by {angle_rad} rad, more than a turn: it is in rad; was {angle_rad} degrees meant?"
    )]
    ManyTurns {
        /// Name of the body.
        body: String,
        /// Angle in rad.
        angle_rad: f64,
    },
    /// A cable of which a part starts in air, with the added mass of water.
    #[error(
        "cable {cable:?}: {percent:.0} % of it start above the surface of the water, and its added mass of {added_kg:.3} kg acts along all of it, as if that \
         was water, too: set buoyancy.added_mass = 0, or make two cables of it", percent = 100.0 * .share
    )]
    AddedMassInAir {
        /// Name of the cable.
        cable: String,
        /// Share of its drawn length that is above the surface at rest.
        share: f64,
        /// Added mass of all of it in kg.
        added_kg: f64,
    },
    /// A dynamic body so far from the origin that single precision rounds its positions.
    #[error(
        "body {body:?}: it is {distance_m:.1e} m from the origin, where the single precision of bodies rounds positions to {rounding_m:.1e} m, and motions \
         slower than that in a step are lost: move the origin near it"
    )]
    FarFromOrigin {
        /// Name of the body.
        body: String,
        /// Largest of its coordinates in m.
        distance_m: f64,
        /// Distance of the numbers that there are, there, in m.
        rounding_m: f64,
    },
    /// A body that turns by more than half a turn in a host step.
    #[error(
        "body {body:?}: it turns by {turn_rad:.1} rad in a step of {dt_s:.4} s, beyond half a turn, and only where it is at the end of a step is known: what \
         is tied to it takes the shorter way; take a shorter `dt`, below {longest_s:.1e} s"
    )]
    FastSpin {
        /// Name of the body.
        body: String,
        /// Angle in a host step in rad.
        turn_rad: f64,
        /// Length of a host step in s.
        dt_s: f64,
        /// Length of a host step in s in which it makes a quarter of a turn.
        longest_s: f64,
    },
    /// A kinematic body whose path turns between two host times.
    #[error(
        "body {body:?}: between two host times, {dt_s:.4} s apart, its path goes up to {lost_m:.1e} m off the straight way, and what is tied to it does not see that: take a \
         `dt` of {longest_s:.1e} s or less"
    )]
    CoarsePath {
        /// Name of the body.
        body: String,
        /// Largest distance in m of a row of the path from the straight way between two host times.
        lost_m: f64,
        /// Length of a host step in s.
        dt_s: f64,
        /// Length of a host step in s that would do for a smooth path.
        longest_s: f64,
    },
    /// What a cable says about its own mesh, steps, law and sizes.
    #[error("{}", Interface::Scene.text(.0))]
    #[serde(untagged)]
    Cable(#[from] lariat_ancf::Warning),
}

fn until(horizon: Option<f64>, estimate: Option<f64>) -> String {
    let horizon = horizon.map_or(String::new(), |time| format!(" from {time:.4} s on"));
    estimate.map_or(horizon.clone(), |estimate| format!("{horizon} (estimate {estimate:.1e} m)"))
}

fn unsettled([time_s, steps, force, gap_m]: [f64; 4], foreseen: bool) -> String {
    lariat_rapier::Unsettled::new(time_s, steps, force).with_gap(gap_m, foreseen).text()
}

fn would_need(elements: Option<usize>) -> String {
    elements.map_or(String::from(", the most that are tried"), |n| {
        format!(": by the order that the runs show about {n} would be needed, more than are tried")
    })
}

/// Says which runs do not come closer.
fn apart(steps: bool, elements: usize) -> String {
    if steps {
        "runs with shorter steps do not come closer".to_string()
    } else {
        format!("meshes up to elements = {elements} do not come closer")
    }
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
