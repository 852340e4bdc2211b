//! Warnings: what a cable says about its own mesh, steps, law and sizes, where they are probably
//! not good enough.
//!
//! A warning changes no result. It says where, how much, and what to do.
//! [`Cable::warnings`](crate::Cable::warnings) judges the present state, a [`Watch`] all host steps
//! that it notes; [`Cable::set_watched`](crate::Cable::set_watched) lets a cable note its own. Each
//! has a [`Level`], by which lists of warnings are sorted; [`fold::lines`] leaves out what follows
//! from another one.
//!
//! | file | what it judges |
//! |---|---|
//! | `sizes` | section, length and material, before anything moves |
//! | `contact` | the mesh beside what the cable touches, and its friction |
//! | `prying` | attachments that hold a stiff cable nearer what it touches than it lies |
//! | `watch` | mesh, tension and reel, by the shapes of a run |
//! | `steps` | the length of integration steps, by the velocities of a run |
//! | `layers`, `advised` | moments and kinks at clamps and loads, and meshes that do |
//! | `balance` | the energy that integration makes or loses |
//! | `shock` | a velocity that jumps |
//! | `level`, `facts` | how much depends on a warning, and on each |
//! | `words` | the names of what users set, in Rust, scenes and Python |
//! | `fold` | which of them follow from which, and what to tell of many |

mod advised;
pub mod balance;
mod contact;
mod facts;
pub mod fold;
mod layers;
mod level;
mod prying;
mod shock;
pub mod sizes;
mod steps;
mod torsion;
mod watch;
mod words;

pub use crate::watch::{EnergyBalance, IslandChange, Passage, Through, Watch};
pub use advised::AdvisedMesh;
pub use level::{Level, name_of};
pub use shock::Shock;
pub use watch::breaks_again;
pub use words::Interface;

use crate::scales::watch::STRAIN_ROUNDS;
use serde::{Deserialize, Serialize};

/// A warning about a cable; its text says what to do. It serialises as its fields with `kind`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Warning {
    /// The elements are too long for the shape.
    #[error(
        "cable {cable:?}: the mesh with `elements({elements})` puts points probably more than {error_m:.1e} m off: try `elements({enough})`"
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
    /// The moment of a clamp is that of the elements beside it, which are longer than what bends
    /// there.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m it bends within {layer_m:.2e} m, which the mesh with `elements({elements})` does not resolve: the moment there, {moment_nm:.3e} N m, \
         would be some {elastica_nm:.3e} N m: try `{enough}`"
    )]
    CoarseMoment {
        /// Name of the cable.
        cable: String,
        /// Arc length of the point in m.
        arc_length_m: f64,
        /// Moment of the mesh in N m.
        moment_nm: f64,
        /// Moment in N m of an elastica with the same angle between tangent and force.
        elastica_nm: f64,
        /// Length in m within which it bends, `sqrt(EI/T)`.
        layer_m: f64,
        /// Number of elements.
        elements: usize,
        /// A mesh that would do.
        enough: AdvisedMesh,
    },
    /// A kink at a load, a clamp or a held point is smeared over the elements beside it.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m it turns sharply, and the mesh with `elements({elements})` is smooth there, which puts points probably {error_m:.1e} m off: try \
         `{enough}`, or free its slope there by `CableSet::add_kink`"
    )]
    CoarseKink {
        /// Name of the cable.
        cable: String,
        /// Arc length of the point in m.
        arc_length_m: f64,
        /// Estimate of the error of position in m.
        error_m: f64,
        /// Number of elements.
        elements: usize,
        /// A mesh that would do.
        enough: AdvisedMesh,
    },
    /// There are obstacles, but no effect by which they are touched.
    #[error(
        "cable {cable:?}: it has {count} obstacles and no effect `Contact`, so it touches none: give it one, or no obstacles"
    )]
    UntouchedObstacles {
        /// Name of the cable.
        cable: String,
        /// Number of obstacles.
        count: usize,
    },
    /// The elements are too long for a small motion of a cable whose shape is resolved.
    #[error(
        "cable {cable:?}: the mesh with `elements({elements})` is probably off by {error_m:.1e} m, where the largest displacement is \
         {displacement_m:.1e} m: try `elements({enough})`"
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
        "cable {cable:?}: an element turns by {turn_rad:.2} rad from end to end: try `elements({enough})` instead of {elements}"
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
    /// The integration steps are too long for the motion.
    #[error(
        "cable {cable:?}: with steps of {step_s:.2e} s its motion at {time_s:.4} s is probably off by {error_m:.1e} m after one oscillation: \
         try steps of {enough_s:.1e} s, `StepControl::MaxStep({enough_s:.1e})`, or `StepControl::Tolerance`"
    )]
    LongSteps {
        /// Name of the cable.
        cable: String,
        /// Time of the largest estimate in s.
        time_s: f64,
        /// Estimate of the error of position per oscillation in m.
        error_m: f64,
        /// Length of the integration steps in s.
        step_s: f64,
        /// Length of steps that would do in s.
        enough_s: f64,
    },
    /// The tension is beyond the range of the law.
    #[error(
        "cable {cable:?}: at {time_s:.4} s its tension is {tension_n:.3e} N, {percent:.1} % of EA = {axial_stiffness_n:.3e} N: the law (Green's strain) \
         holds for small strain and is stiffer than Hooke's beyond; check Young's modulus (Pa), section (m), masses (kg) and length, or \
         take the law of Hooke or of a rope, whose EA is force over elongation",
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
    /// The tension is where Green's law, which the cable has by default, is off Hooke's.
    #[error(
        "cable {cable:?}: at {time_s:.4} s its tension is {tension_n:.3e} N, {percent:.1} % of EA = {axial_stiffness_n:.3e} N: its law (Green's strain) elongates it by {less_percent:.1} % \
         less than Hooke's: where EA is force over elongation, set `AxialLaw::Hooke`; where Green's law is meant, `AxialLaw::Green`",
        percent = 100.0 * .tension_n / .axial_stiffness_n, less_percent = 100.0 * less_elongation(.tension_n / .axial_stiffness_n)
    )]
    GreenStrain {
        /// Name of the cable.
        cable: String,
        /// Time of the largest tension in s.
        time_s: f64,
        /// Largest tension in N.
        tension_n: f64,
        /// Axial stiffness EA in N.
        axial_stiffness_n: f64,
    },
    /// A cable slides over the facets of a mesh.
    #[error(
        "cable {cable:?}: until {time_s:.3} s it slid {slid_m:.3} m along itself over the facets of a mesh about which it bends: its edges brake it, also without friction, \
         by 5 to 50 % on a pulley of 12 to 96 sides: take a round shape (cylinder, ball, capsule), or a sheave"
    )]
    Facets {
        /// Name of the cable.
        cable: String,
        /// Time in s.
        time_s: f64,
        /// Way in m.
        slid_m: f64,
    },
    /// Integration makes energy.
    #[error(
        "cable {cable:?}: integration of it, and of what moves with it, makes energy: {made_j:.1e} J until {time_s:.4} s, {percent:.2} % of its largest energy or work ({scale_j:.3e} J): {}",
        less_energy(*.discrete_gradient), percent = 100.0 * .made_j / .scale_j
    )]
    EnergyMade {
        /// Name of the cable.
        cable: String,
        /// Time in s.
        time_s: f64,
        /// Energy made in J.
        made_j: f64,
        /// Largest energy or work so far in J.
        scale_j: f64,
        /// Whether the method is the discrete gradient.
        #[serde(default)]
        discrete_gradient: bool,
    },
    /// Integration takes energy.
    #[error(
        "cable {cable:?}: integration of it, and of what moves with it, takes {lost_j:.1e} J until {time_s:.4} s, {percent:.1} % of its largest energy or work ({scale_j:.3e} J), besides damping \
         and drag: the motion is damped that much; take a smaller tolerance or shorter steps", percent = 100.0 * .lost_j / .scale_j
    )]
    EnergyLost {
        /// Name of the cable.
        cable: String,
        /// Time in s.
        time_s: f64,
        /// Energy lost in J.
        lost_j: f64,
        /// Largest energy or work so far in J.
        scale_j: f64,
    },
    /// A reel whose rate comes near the speed of waves.
    #[error(
        "cable {cable:?}: at {time_s:.3} s its reel turns with {ratio:.2} of the speed of transverse waves: above 0.3 waves across \
         it may grow, whatever its damping, and its shape and frequencies are wrong then; {}", if *undirected {
            "where it runs out faster than waves, nothing gives a cable without bending stiffness its direction at the eye: clamp it there, or give it bending stiffness"
        } else {
            "give it a slower rate, or more tension"
        }
    )]
    FastReel {
        /// Name of the cable.
        cable: String,
        /// Time of the largest ratio in s.
        time_s: f64,
        /// Rate over the speed of transverse waves.
        ratio: f64,
        /// Whether it is above 1, and neither bending stiffness nor a clamp gives the cable a
        /// direction at the eye.
        #[serde(default)]
        undirected: bool,
    },
    /// A table of rates asks for changes that the acceleration of the reel does not give.
    #[error(
        "cable {cable:?}: the rates of its reel ask for {asked_m:.4} m, and with an acceleration of {acceleration_m_s2:.3} m/s^2 it gives {given_m:.4} m: {rate_m_s:.3} m/s is \
         not reached before the next row; give it more acceleration, or the rows more time"
    )]
    SlowReel {
        /// Name of the cable.
        cable: String,
        /// Length in m that the table asks for.
        asked_m: f64,
        /// Length in m that the acceleration gives.
        given_m: f64,
        /// Largest rate in m/s that is not reached.
        rate_m_s: f64,
        /// Acceleration of the reel in m/s^2.
        acceleration_m_s2: f64,
    },
    /// Its load may have exceeded what it withstands between two integration steps, and none of
    /// them saw it.
    #[error(
        "cable {cable:?}: near {time_s:.4} s its load came to {share:.2} of what it withstands, and with steps of {step_s:.1e} s may have come to {reached:.2} of it between two \
         steps: whether it breaks there is not resolved; try shorter steps, or a tolerance"
    )]
    UnseenLoad {
        /// Name of the cable.
        cable: String,
        /// Time in s.
        time_s: f64,
        /// Share of the limit that was read.
        share: f64,
        /// Share of the limit that may have been reached.
        reached: f64,
        /// Length of the integration steps in s.
        step_s: f64,
    },
    /// A tension beyond the last row of a measured curve.
    #[error(
        "cable {cable:?}: at {time_s:.3} s its tension was {tension_n:.3e} N, and its curve ends at {force_n:.3e} N and a strain of {strain}: the last slope went on from there; \
         measure further, or let it break by `Strength`"
    )]
    BeyondCurve {
        /// Name of the cable.
        cable: String,
        /// Time of the largest tension in s.
        time_s: f64,
        /// Largest tension in N.
        tension_n: f64,
        /// Last strain of the curve.
        strain: f64,
        /// Last force of the curve in N.
        force_n: f64,
    },
    /// The tension is more than anything of its make bears.
    #[error(
        "cable {cable:?}: at {time_s:.4} s its tension is {tension_n:.3e} N, {times:.1} times the {bears_n:.3e} N that break a rope or a solid of its make: check the length \
         (was it drawn longer than it is?), masses and speeds, or give it a `Strength`, by which it breaks",
        times = .tension_n / .bears_n
    )]
    Overloaded {
        /// Name of the cable.
        cable: String,
        /// Time of the largest tension in s.
        time_s: f64,
        /// Largest tension in N.
        tension_n: f64,
        /// Breaking load in N of a rope of its make, or 0.05 EA of a stiff solid.
        bears_n: f64,
    },
    /// It starts in an obstacle.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m it starts {depth_m:.2e} m deep in obstacle {obstacle}: `Contact` does not push out what starts inside; move one of them, and see \
         that slack sags into nothing"
    )]
    StartsInside {
        /// Name of the cable.
        cable: String,
        /// Key of the obstacle; in Python its index.
        obstacle: u64,
        /// Arc length in m.
        arc_length_m: f64,
        /// Depth of its surface in m.
        depth_m: f64,
    },
    /// It is what several breaks left of a cable that nothing damps.
    #[error(
        "cable {cable:?}: {breaks} breaks, one after another, made it what it is, and nothing damps its stretch: it keeps the energy with which it snaps taut, which a real rope \
         loses; how often it breaks is then not to be relied on; give it damping, as by `CableBuilder::damped_as`"
    )]
    BreaksAgain {
        /// Name of the cable.
        cable: String,
        /// Number of the breaks.
        breaks: u32,
    },
    /// What holds a straight, stiff cable moves in jumps of its rounding.
    #[error(
        "cable {cable:?}: at {time_s:.3} s the rounding of what holds it, far from the origin in single precision, may pull at it by {noise_n:.1e} N, where its \
         tension is {tension_n:.1e} N at most: bring the scene near the origin, choose less stiffness or damping, or use bodies in double precision"
    )]
    RoundedEnds {
        /// Name of the cable.
        cable: String,
        /// Time of the largest estimate in s.
        time_s: f64,
        /// Estimate of the largest force that the rounding makes in N.
        noise_n: f64,
        /// Largest tension in N.
        tension_n: f64,
    },
    /// Its centre line went through that of a cable that it can touch, through itself, or through a
    /// thin part of an obstacle.
    #[error(
        "cable {cable:?}: in {steps} steps it passed through {}: try more elements, shorter steps, or more stiffness of contact or in bending",
        passed(.first.as_ref())
    )]
    PassedThrough {
        /// Name of the cable.
        cable: String,
        /// Number of steps in which it did.
        steps: u64,
        /// The first of them, where it is known.
        #[serde(default)]
        first: Option<Passage>,
    },
    /// The tolerance of the discrete gradient asked for steps shorter than a 64th of the host step,
    /// which were not taken.
    #[error(
        "cable {cable:?}: {steps} steps of a 64th of the host step had an estimated error above the tolerance: the motion is not resolved to it; try shorter host \
         steps, more damping, or a larger tolerance"
    )]
    NotResolved {
        /// Name of the cable.
        cable: String,
        /// Number of such steps.
        steps: u64,
    },
    /// Steps were accepted that are not solved.
    #[error(
        "cable {cable:?}: in {steps} steps of it, and of what moves with it, the iteration did not come to its end, however short they were: forces of contacts and damping were not \
         those of their laws there, and took {hidden_j:.1e} J less than these say; no energy is made; try shorter host steps, more elements, or contact that is less stiff"
    )]
    UnsolvedSteps {
        /// Name of the cable.
        cable: String,
        /// Number of steps.
        steps: u64,
        /// Energy in J that contacts and damping did not take.
        hidden_j: f64,
    },
    /// A limit to the work cut steps short.
    #[error(
        "cable {cable:?}: in {steps} steps the limit to the work was reached: forces and motion have errors without a bound there, though no energy is made; try \
         shorter host steps, more damping, less stiffness, or a larger limit"
    )]
    CutShort {
        /// Name of the cable.
        cable: String,
        /// Number of such steps.
        steps: u64,
    },
    /// It is deep in what it touches, for longer than an impact takes, or at rest.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m it lies deep in what it touches, by {share:.2} of its radius: between its points of contact, try \
         `elements({enough})`; pressed in by its load, try a larger `Contact::stiffness`"
    )]
    Sinks {
        /// Name of the cable.
        cable: String,
        /// Arc length in m where it is deepest.
        arc_length_m: f64,
        /// Depth over radius.
        share: f64,
        /// Number of elements that would do.
        enough: usize,
    },
    /// Its elements are long beside the radius around which contact bends them.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m an element turns by {turn_rad:.2} rad about what it touches, so friction and depth there are probably off by several per \
         cent: try `elements({enough})`, 12 per turn"
    )]
    CoarseContact {
        /// Name of the cable.
        cable: String,
        /// Arc length in m where the element begins.
        arc_length_m: f64,
        /// Angle between the slopes at the ends of the element in rad.
        turn_rad: f64,
        /// Number of elements that would do.
        enough: usize,
    },
    /// It leaves what it lies on within an element that is long for that.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m it leaves what it lies on within an element, and its tension is off by up to {:.2} % of the largest: try \
         `elements({enough})`",
        100.0 * share
    )]
    CoarseTouchdown {
        /// Name of the cable.
        cable: String,
        /// Arc length in m where that element begins.
        arc_length_m: f64,
        /// Share of the largest tension.
        share: f64,
        /// Number of elements that would do.
        enough: usize,
    },
    /// It touches something off which it should bounce with more of its velocity than it can.
    #[error(
        "cable {cable:?}: with what it touches it has a coefficient of restitution of {restitution}, and impacts of cables have at most 15/17: it leaves with less"
    )]
    HighRestitution {
        /// Name of the cable.
        cable: String,
        /// Coefficient of restitution with what it touches.
        restitution: f64,
    },
    /// It runs over a cable without slipping, since that turns beneath it.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m a cable ran {run_m:.3} m over another one around which it bends, and friction did not hold it: the section of the one beneath turns \
         freely, as nothing holds a cable against turning about itself; where it could not turn, put a fixed rod in its place"
    )]
    RunsOver {
        /// Name of the cable.
        cable: String,
        /// Arc length of the contact in m.
        arc_length_m: f64,
        /// Length in m that ran over it.
        run_m: f64,
    },
    /// An attachment holds a stiff cable nearer a body than it lies beside it.
    #[error(
        "cable {cable:?}: at {arc_length_m:.4} m an attachment holds it nearer what it touches than its radius, {radius_m} m, lets it lie beside that: bent over so much, it adds \
         some {force_n:.1e} N to the forces there, more on a finer mesh; put the anchor a radius outside"
    )]
    PriedAttachment {
        /// Name of the cable.
        cable: String,
        /// Arc length of the attachment in m.
        arc_length_m: f64,
        /// Radius of the cable in m.
        radius_m: f64,
        /// The moment beside the attachment over the length that does not touch, in N.
        force_n: f64,
    },
    /// Friction does not settle on the normal forces.
    #[error(
        "cable {cable:?}: in {steps} steps its friction did not settle on the normal forces of the step, and tensions along what it slides on are probably wrong: try \
         shorter steps"
    )]
    FrictionLags {
        /// Name of the cable.
        cable: String,
        /// Number of steps in which it did not.
        steps: u64,
    },
    /// It has torsion, and no two clamps that hold its spin.
    #[error(
        "cable {cable:?}: its torsion does nothing, for no two clamps hold its spin: clamp it at both ends (a ball, a pin or a swivel holds none), or leave torsion out"
    )]
    IdleTorsion {
        /// Name of the cable.
        cable: String,
    },
    /// Its elements are too long for the kinks of its torque.
    #[error(
        "cable {cable:?}: its torque times the length of an element is {ratio:.2} EI: above 1.5 the torque at which it kinks is off by more than 0.2 %, and kinks are not resolved; try `elements({enough})` instead of {elements}"
    )]
    CoarseTwist {
        /// Name of the cable.
        cable: String,
        /// Largest |M| l/EI of an element.
        ratio: f64,
        /// Number of elements.
        elements: usize,
        /// Number of elements that would do.
        enough: usize,
    },
    /// Twist was lost where it is too sharply bent.
    #[error(
        "cable {cable:?}: {slips} times it turned by more than 120 degrees within half an element or a step, where its twist is not kept, so its torque is probably wrong: try more elements, shorter steps, or more stiffness in bending"
    )]
    TwistSlips {
        /// Name of the cable.
        cable: String,
        /// Number of such turns.
        slips: u64,
    },
    /// A coefficient of friction that no pair of materials has.
    #[error(
        "cable {cable:?}: its coefficient of friction is {friction}: no two materials have more than 2; it is a ratio of forces, not in percent, and no angle"
    )]
    RoughContact {
        /// Name of the cable.
        cable: String,
        /// Its coefficient of friction.
        friction: f64,
    },
    /// A breaking strain that no material of such stiffness reaches.
    #[error(
        "cable {cable:?}: it breaks at a strain of {strain}, {percent:.0} % of its length, and waves run along it at {wave_speed_m_s:.0} m/s, as in no rubber: a strain is a share of the \
         length, not in percent; so it may never break", percent = 100.0 * .strain
    )]
    StretchyBreak {
        /// Name of the cable.
        cable: String,
        /// Strain at which it breaks.
        strain: f64,
        /// Speed of waves along it in m/s.
        wave_speed_m_s: f64,
    },
    /// A radius of contact that no cable has.
    #[error(
        "cable {cable:?}: the radius of its contact is {radius_m} m, of a cable that is {length_m:.4} m long{}: it is in m; was {radius_m} mm meant?",
        .diameter_m.map_or(String::new(), |d| format!(" and {d} m thick"))
    )]
    ThickContact {
        /// Name of the cable.
        cable: String,
        /// Radius of contact in m.
        radius_m: f64,
        /// Unstretched length in m.
        length_m: f64,
        /// Outer diameter of the section in m, if it is known.
        diameter_m: Option<f64>,
    },
    /// Gravity in another unit.
    #[error(
        "cable {cable:?}: gravity is {gravity_m_s2} m/s^2, more than 300 times that of the earth: it is in m/s^2, not in mm/s^2"
    )]
    StrongGravity {
        /// Name of the cable.
        cable: String,
        /// Acceleration in m/s^2.
        gravity_m_s2: f64,
    },
    /// Error control that allows errors of the size of the cable.
    #[error(
        "cable {cable:?}: the tolerance of its integrator is {tolerance_m} m, of a cable that is {length_m:.4} m long: it is an error of positions in m"
    )]
    LargeTolerance {
        /// Name of the cable.
        cable: String,
        /// Tolerance in m.
        tolerance_m: f64,
        /// Unstretched length in m.
        length_m: f64,
    },
    /// A reel whose eye nothing holds.
    #[error(
        "cable {cable:?}: nothing holds the eye of its reel at {arc_length_m:.4} m, which moves with what it pays out: fix that end, or attach it"
    )]
    FreeEye {
        /// Name of the cable.
        cable: String,
        /// Arc length of the eye in m.
        arc_length_m: f64,
    },
    /// It is several times as long as drawn.
    #[error(
        "cable {cable:?}: it is {length_m:.4} m long and drawn over {drawn_m:.4} m, {percent:.0} % of slack: its length is in m; was a share meant?",
        percent = 100.0 * (.length_m / .drawn_m - 1.0)
    )]
    MuchSlack {
        /// Name of the cable.
        cable: String,
        /// Unstretched length in m.
        length_m: f64,
        /// Length of its points in m.
        drawn_m: f64,
    },
    /// A damping time that no rope has.
    #[error(
        "cable {cable:?}: its axial damping is {axial_s} s: it stretches under a load only within such a time, and is stiff until then; it is the time of Kelvin \
         and Voigt, not a share of the critical damping; for that of a rope set `CableBuilder::damped_as`"
    )]
    SlowStretch {
        /// Name of the cable.
        cable: String,
        /// Time of the axial strain in s.
        axial_s: f64,
    },
    /// The same in bending.
    #[error(
        "cable {cable:?}: its damping in bending is {bending_s} s: it bends under a load only within such a time, and is stiff until then; it is the time of Kelvin \
         and Voigt, not a share of the critical damping; for that of a rope set `CableBuilder::damped_as`"
    )]
    SlowBending {
        /// Name of the cable.
        cable: String,
        /// Time of the curvature in s.
        bending_s: f64,
    },
    /// Thicker in a fluid than any cable.
    #[error(
        "cable {cable:?}: its drag is that of a diameter of {diameter_m} m: it is in m; was {diameter_m} mm meant?"
    )]
    ThickDrag {
        /// Name of the cable.
        cable: String,
        /// Diameter of drag in m.
        diameter_m: f64,
    },
    /// A flow that is faster than any current or wind.
    #[error(
        "cable {cable:?}: the fluid of its drag, of {density_kg_m3} kg/m^3, flows with {speed_m_s} m/s, faster than any {}: it is in m/s; were knots or km/h meant?",
        if *.is_liquid { "current" } else { "wind" }
    )]
    FastFlow {
        /// Name of the cable.
        cable: String,
        /// Largest speed in m/s, by its tables.
        speed_m_s: f64,
        /// Density of the fluid in kg/m^3.
        density_kg_m3: f64,
        /// Whether it is a liquid, by its density.
        is_liquid: bool,
    },
    /// A measured curve that is much softer than the section.
    #[error(
        "cable {cable:?}: its axial law reaches {force_n:.3e} N at a strain of {strain}, where EA = {axial_stiffness_n:.3e} N makes {:.3e} N: strains are shares of the length; \
         were {strain} % meant?", .strain * .axial_stiffness_n
    )]
    SoftCurve {
        /// Name of the cable.
        cable: String,
        /// Last strain of the curve.
        strain: f64,
        /// Force there in N.
        force_n: f64,
        /// EA of the section in N.
        axial_stiffness_n: f64,
    },
    /// Elements that are thicker than long.
    #[error(
        "cable {cable:?}: its elements are {element_m:.2e} m long and {diameter_m:.2e} m thick: what bends within the thickness shears, and a cable has no shear; take fewer elements"
    )]
    ThickElements {
        /// Name of the cable.
        cable: String,
        /// Length of the shortest elements in m.
        element_m: f64,
        /// Outer diameter or side in m.
        diameter_m: f64,
    },
    /// Its torque is one at which it goes into a loop, and it does not touch itself.
    #[error(
        "cable {cable:?}: its torque reached {torque_nm:.3e} N m at a tension of {tension_n:.3e} N, at which a straight cable goes into loops: {share:.2} half waves of its helix fit in, \
         and 1 is enough; it does not touch itself, and a loop is pulled through itself; try `Contact` with itself, more tension, or less twist"
    )]
    KinksThroughItself {
        /// Name of the cable.
        cable: String,
        /// Torque in N m.
        torque_nm: f64,
        /// Least tension in N where it had that torque.
        #[serde(default)]
        tension_n: f64,
        /// `int sqrt(M^2/(4 EI^2) - T/EI) ds/pi`.
        share: f64,
    },
    /// A point moment has a part about the tangent, which does nothing.
    #[error(
        "cable {cable:?}: at {time_s:.3} s the moment on it at {at_m:.4} m has {part_nm:.3e} N m about its tangent, and that part does nothing, for the spin of a section \
         between clamps is none of the coordinates: twist an end by a motor of its torsion, or clamp the cable to a body and put the moment on that"
    )]
    MomentAlong {
        /// Name of the cable.
        cable: String,
        /// Arc length in m.
        at_m: f64,
        /// Part of the moment about the tangent in N m.
        part_nm: f64,
        /// Time in s.
        time_s: f64,
    },
    /// Torsion is stiffer than bending.
    #[error(
        "cable {cable:?}: its GJ is {ratio:.3} EI, and of a round section of one material it is EI/(1 + nu), less than EI: check both; right for a section that is wound or \
         braided against twist"
    )]
    StiffTorsion {
        /// Name of the cable.
        cable: String,
        /// GJ/EI.
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
        /// Outer diameter or side in m; without a section that of the solid round one with the same
        /// EI/EA.
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
    /// Lighter than any cable, or so light that waves run faster along it than in any material.
    #[error(
        "cable {cable:?}: its density is {density_kg_m3:.3e} kg/m^3, with waves of {wave_speed_m_s:.1e} m/s, as no material has: it is in kg/m^3 (rope 500 to 1500, steel \
         7850); was {density_kg_m3:.3} g/cm^3 meant? For a cable without weight set `GravityScale(0.0)`"
    )]
    LightMaterial {
        /// Name of the cable.
        cable: String,
        /// Density in kg/m^3.
        density_kg_m3: f64,
        /// Speed of longitudinal waves in m/s.
        wave_speed_m_s: f64,
    },
    /// Waves run along it faster than in any material, by its stiffness and mass per length.
    #[error(
        "cable {cable:?}: EA = {axial_stiffness_n:.3e} N and {mass_per_length_kg_m:.3e} kg/m make waves of {wave_speed_m_s:.1e} m/s along it, as no material has (steel 5200, \
         HMPE 10000): EA is Young's modulus times the area, in N; was the modulus given?"
    )]
    FastWaves {
        /// Name of the cable.
        cable: String,
        /// EA in N.
        axial_stiffness_n: f64,
        /// Mass per length in kg/m.
        mass_per_length_kg_m: f64,
        /// Speed of longitudinal waves in m/s.
        wave_speed_m_s: f64,
    },
    /// Softer than any rope, or than any of its density.
    #[error(
        "cable {cable:?}: Young's modulus is {youngs_modulus_pa} Pa, softer than any rope or rubber: it is in Pa (steel 2.1e11, rubber \
         1e6 to 1e8); was {youngs_modulus_pa} GPa or MPa meant?"
    )]
    SoftMaterial {
        /// Name of the cable.
        cable: String,
        /// Young's modulus in Pa.
        youngs_modulus_pa: f64,
    },
}

impl Warning {
    /// Names the obstacle that it is about by that of a body, for which `name` is asked by the key.
    pub fn with_body(mut self, name: impl FnOnce(u64) -> Option<String>) -> Self {
        if let Warning::PassedThrough { first: Some(Passage { through, .. }), .. } = &mut self
            && let Through::Obstacle(key) = through
            && let Some(name) = name(*key)
        {
            *through = Through::Body(name);
        }
        self
    }
}

/// Returns what it passed through, and first when and where.
fn passed(first: Option<&Passage>) -> String {
    first.map_or("what it can touch".to_string(), |Passage { time_s, arc_length_m, through }| {
        format!("what it can touch, first at {time_s:.4} s, with its point at {arc_length_m:.4} m, through {through}")
    })
}

/// Returns the share by which the elongation at a tension over EA is less by Green's law, `(e +
/// e^2/2)(1 + e)`, than by Hooke's, e.
pub(crate) fn less_elongation(share: f64) -> f64 {
    // from above, where the law is convex
    let newton = |e: f64, _| e - ((e + 0.5 * e * e) * (1.0 + e) - share) / (1.0 + 3.0 * e + 1.5 * e * e);
    1.0 - (0..STRAIN_ROUNDS).fold(share, newton) / share
}

/// Returns what to do about energy that integration makes, with the discrete gradient or without.
pub fn less_energy(discrete_gradient: bool) -> &'static str {
    match discrete_gradient {
        true => "take a smaller tolerance or shorter steps",
        false => {
            "take a smaller tolerance, shorter steps, or the discrete gradient (`Fidelity::Game`), which makes none"
        }
    }
}
