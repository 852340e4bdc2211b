//! Sections and materials that no cable has: probably another unit was meant.
//!
//! # Validity
//!
//! Sources of the limits: below ten times its thickness a rod shears visibly (the deflection of a
//! Timoshenko cantilever, nu = 0.3, is 0.8 % above Euler's at 10, 3 % at 5); the softest technical
//! elastomers have 1e5 Pa; waves along a rod run at 10 m/s in them, and at 1200 m/s (lead) to 5200
//! m/s (steel, aluminium) in metals, of which a thousandth is left where a modulus in MPa is read
//! in Pa; none is faster than 36000 m/s in any solid (Trachenko et al., Sci. Adv. 6 (2020)
//! eabc8662: fine-structure constant and ratio of masses of electron and proton; diamond has
//! 18000), and 32 times as fast a wave is where a density in g/cm^3 is read in kg/m^3; the lightest
//! foams have 10 kg/m^3; a cable of more than three times the length of its points, and a damping
//! time of more than a second, are probably shares in percent; the thickest cables are those of
//! suspension bridges (Akashi Kaikyo: 1.12 m) and the thickest pipelines 1.42 m (56 inches). The
//! fastest tidal streams run at 10 m/s (Saltstraumen), and the fastest gust that was measured had
//! 113 m/s (Barrow Island, 1996). A curve of which all secants are below a thirtieth of EA, up to
//! strains that only rubber bears, has its strains in percent: rubber's own secants fall to a
//! fifth. The largest coefficients of dry friction are those of racing tyres, 1.7. Only rubber, in
//! which waves run at up to 200 m/s, breaks above a strain of 1. A radius of contact of ten
//! diameters is more than any sheath.

use super::Warning;
use crate::effect::{AxialLaw, Contact, Damping, Drag, Effects};
use crate::integrate::StepControl;
use crate::scales::watch::{
    FASTEST, FASTEST_CURRENT, FASTEST_WIND, LARGE_TOLERANCE, LEAST_LIQUID, LIGHTEST, MOST_FRICTION, MOST_STRETCH,
    MOST_WIDE, RUBBER, SHEATH, SLACK, SLENDERNESS, SLOWEST, SLOWEST_STRAIN, SOFTEST, SOFTEST_CURVE, STRETCHY,
    STRONGEST_GRAVITY, THICKEST, WIDE_SHARE,
};
use crate::section::Section;
use crate::strength::Strength;

/// Returns the warnings about the section and the unstretched length (m) of a cable.
pub fn warnings(cable: &str, section: &Section, length_m: f64) -> impl Iterator<Item = Warning> {
    // a solid round section has EI/EA = (d/4)^2
    let solid = || 4.0 * (section.bending_stiffness / section.axial_stiffness).sqrt();
    let diameter_m = section.diameter.unwrap_or_else(solid);
    let (ratio, name) = (length_m / diameter_m, || cable.to_string());
    let shape = if ratio < SLENDERNESS {
        Some(Warning::Stubby { cable: name(), ratio, length_m, diameter_m })
    } else {
        let thick = section.diameter.is_some_and(|diameter| diameter > THICKEST);
        thick.then(|| Warning::Thick { cable: name(), diameter_m })
    };
    let slow = section.axial_stiffness < SLOWEST * SLOWEST * section.mass_per_length;
    let light = light(cable, section);
    let soft = section.youngs_modulus().filter(|modulus| *modulus < SOFTEST || slow);
    let material = soft.map(|youngs_modulus_pa| Warning::SoftMaterial { cable: name(), youngs_modulus_pa });
    shape.into_iter().chain(material).chain(light)
}

/// Returns the warning about a length (m) that is several times the drawn one (m).
pub fn slack(cable: &str, length_m: f64, drawn_m: f64) -> Option<Warning> {
    (length_m > SLACK * drawn_m).then(|| Warning::MuchSlack { cable: cable.to_string(), length_m, drawn_m })
}

/// Returns the warnings about numbers of effects in another measure, on a cable of an EA in N.
pub fn of_effects(cable: &str, effects: &Effects, axial_stiffness_n: f64) -> impl Iterator<Item = Warning> {
    let damping = effects.damping.iter().flat_map(move |own| damping(cable, own));
    let drag = effects.drag.iter().flat_map(move |own| drag(cable, own));
    let curve = effects.axial_law.as_ref().and_then(|law| curve(cable, law, axial_stiffness_n));
    let contact = effects.contact.as_ref().and_then(|own| friction(cable, own.friction));
    damping.chain(drag).chain(curve).chain(contact)
}

/// Returns the warning about a coefficient of friction in percent, or an angle in degrees.
pub(super) fn friction(cable: &str, friction: f64) -> Option<Warning> {
    (friction > MOST_FRICTION).then(|| Warning::RoughContact { cable: cable.to_string(), friction })
}

/// Returns the warning about a radius of contact in mm, of a cable of a length in m.
pub fn contact_radius(cable: &str, contact: Option<&Contact>, section: &Section, length_m: f64) -> Option<Warning> {
    let (radius_m, diameter_m) = (contact?.radius?, section.diameter);
    let thick = 2.0 * radius_m > MOST_WIDE.min(WIDE_SHARE * length_m)
        || diameter_m.is_some_and(|diameter| radius_m > SHEATH * diameter);
    thick.then(|| Warning::ThickContact { cable: cable.to_string(), radius_m, length_m, diameter_m })
}

/// Returns the warning about gravity (m/s^2) in mm/s^2.
pub fn gravity(cable: &str, gravity_m_s2: f64) -> Option<Warning> {
    (gravity_m_s2 > STRONGEST_GRAVITY).then(|| Warning::StrongGravity { cable: cable.to_string(), gravity_m_s2 })
}

/// Returns the warning about error control that is none, of a cable of a length in m.
pub fn tolerance(cable: &str, control: StepControl, length_m: f64) -> Option<Warning> {
    let (StepControl::Tolerance(tolerance_m)
    | StepControl::ToleranceOf(tolerance_m, _)
    | StepControl::Adaptive(tolerance_m)) = control
    else {
        return None;
    };
    let large = tolerance_m > LARGE_TOLERANCE * length_m;
    large.then(|| Warning::LargeTolerance { cable: cable.to_string(), tolerance_m, length_m })
}

/// Returns the warning about a breaking strain in percent.
pub fn strength(cable: &str, strength: &Strength, section: &Section) -> Option<Warning> {
    let wave_speed_m_s = (section.axial_stiffness / section.mass_per_length).sqrt();
    let strain = strength.strain.filter(|strain| *strain > STRETCHY && wave_speed_m_s > RUBBER)?;
    Some(Warning::StretchyBreak { cable: cable.to_string(), strain, wave_speed_m_s })
}

/// Returns the warnings about damping in another measure.
fn damping(cable: &str, damping: &Damping) -> impl Iterator<Item = Warning> {
    let (cable, Damping { axial: axial_s, bending: bending_s }) = (cable.to_string(), *damping);
    let stretch = (axial_s > SLOWEST_STRAIN).then(|| Warning::SlowStretch { cable: cable.clone(), axial_s });
    let bending = (bending_s > SLOWEST_STRAIN).then_some(Warning::SlowBending { cable, bending_s });
    stretch.into_iter().chain(bending)
}

/// Returns the warnings about drag on a diameter in mm, and of a flow in knots or km/h.
fn drag(cable: &str, drag: &Drag) -> impl Iterator<Item = Warning> {
    let name = || cable.to_string();
    let diameter = drag.diameter.filter(|diameter| *diameter > THICKEST);
    let thick = diameter.map(|diameter_m| Warning::ThickDrag { cable: name(), diameter_m });
    let (density_kg_m3, speed_m_s) = (drag.fluid_density, drag.flow.largest_speed());
    let is_liquid = density_kg_m3 > LEAST_LIQUID;
    let fast = speed_m_s > if is_liquid { FASTEST_CURRENT } else { FASTEST_WIND };
    let flow = fast.then(|| Warning::FastFlow { cable: name(), speed_m_s, density_kg_m3, is_liquid });
    thick.into_iter().chain(flow)
}

/// Returns the warning about a curve whose strains are in percent, of a cable of an EA in N.
fn curve(cable: &str, law: &AxialLaw, axial_stiffness_n: f64) -> Option<Warning> {
    let AxialLaw::Curve(rows) = law else { return None };
    let stiffest = |[strain, force]: &[f64; 2]| if *strain > 0.0 { force / strain } else { 0.0 };
    let &[strain, force_n] = rows.last()?;
    let soft = rows.iter().map(stiffest).fold(0.0, f64::max) < SOFTEST_CURVE * axial_stiffness_n;
    (strain > MOST_STRETCH && soft).then(|| {
        let cable = cable.to_string();
        Warning::SoftCurve { cable, strain, force_n, axial_stiffness_n }
    })
}

/// Returns the warning about elements (m) that are thicker than long, of a cable of a length in m;
/// one that is short itself is told as such.
pub fn elements(cable: &str, section: &Section, length_m: f64, element_m: f64) -> Option<Warning> {
    let diameter_m = section.diameter.filter(|d| *d > element_m && length_m > SLENDERNESS * d)?;
    Some(Warning::ThickElements { cable: cable.to_string(), element_m, diameter_m })
}

/// Returns the warning about a material that is lighter than any, or waves that are faster.
fn light(cable: &str, section: &Section) -> Option<Warning> {
    let (axial_stiffness_n, mass_per_length_kg_m) = (section.axial_stiffness, section.mass_per_length);
    let wave_speed_m_s = (axial_stiffness_n / mass_per_length_kg_m).sqrt();
    let Some(modulus) = section.youngs_modulus() else {
        let cable = cable.to_string();
        let waves = Warning::FastWaves { cable, axial_stiffness_n, mass_per_length_kg_m, wave_speed_m_s };
        return (wave_speed_m_s > FASTEST).then_some(waves);
    };
    let density_kg_m3 = mass_per_length_kg_m * modulus / axial_stiffness_n;
    let light = density_kg_m3 < LIGHTEST || wave_speed_m_s > FASTEST;
    light.then(|| Warning::LightMaterial { cable: cable.to_string(), density_kg_m3, wave_speed_m_s })
}
