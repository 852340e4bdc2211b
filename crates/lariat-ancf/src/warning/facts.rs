//! How much depends on each warning of a cable, and what it is a sign of.

use super::Warning;
use super::level::{Judged, Level, Sign};

impl Warning {
    /// Returns how much depends on it.
    pub fn level(&self) -> Level {
        match self {
            Warning::UntouchedObstacles { .. }
            | Warning::SlowReel { .. }
            | Warning::HighRestitution { .. }
            | Warning::IdleTorsion { .. }
            | Warning::MuchSlack { .. }
            | Warning::SlowStretch { .. }
            | Warning::SlowBending { .. }
            | Warning::ThickElements { .. }
            | Warning::StartsInside { .. }
            | Warning::PriedAttachment { .. }
            | Warning::ThickDrag { .. }
            | Warning::FastFlow { .. }
            | Warning::ThickContact { .. }
            | Warning::StrongGravity { .. }
            | Warning::LargeTolerance { .. }
            | Warning::FreeEye { .. }
            | Warning::RoughContact { .. }
            | Warning::StretchyBreak { .. }
            | Warning::SoftCurve { .. }
            | Warning::MomentAlong { .. }
            | Warning::StiffTorsion { .. }
            | Warning::Stubby { .. }
            | Warning::Thick { .. }
            | Warning::LightMaterial { .. }
            | Warning::FastWaves { .. }
            | Warning::SoftMaterial { .. } => Level::Setup,
            Warning::LargeStrain { .. }
            | Warning::EnergyMade { .. }
            | Warning::FastReel { .. }
            | Warning::UnseenLoad { .. }
            | Warning::BreaksAgain { .. }
            | Warning::BeyondCurve { .. }
            | Warning::Overloaded { .. }
            | Warning::RoundedEnds { .. }
            | Warning::PassedThrough { .. }
            | Warning::FrictionLags { .. }
            | Warning::RunsOver { .. }
            | Warning::CutShort { .. }
            | Warning::UnsolvedSteps { .. }
            | Warning::Facets { .. }
            | Warning::TwistSlips { .. }
            | Warning::KinksThroughItself { .. } => Level::Wrong,
            Warning::CoarseMesh { .. }
            | Warning::GreenStrain { .. }
            | Warning::CoarseMotion { .. }
            | Warning::CoarseElement { .. }
            | Warning::CoarseMoment { .. }
            | Warning::CoarseKink { .. }
            | Warning::LongSteps { .. }
            | Warning::EnergyLost { .. }
            | Warning::NotResolved { .. }
            | Warning::Sinks { .. }
            | Warning::CoarseContact { .. }
            | Warning::CoarseTouchdown { .. }
            | Warning::CoarseTwist { .. } => Level::Coarse,
        }
    }

    /// Returns the name of the cable that it is about.
    pub fn cable(&self) -> &str {
        match self {
            Warning::CoarseMesh { cable, .. }
            | Warning::UntouchedObstacles { cable, .. }
            | Warning::CoarseMotion { cable, .. }
            | Warning::CoarseElement { cable, .. }
            | Warning::CoarseMoment { cable, .. }
            | Warning::CoarseKink { cable, .. }
            | Warning::LongSteps { cable, .. }
            | Warning::LargeStrain { cable, .. }
            | Warning::GreenStrain { cable, .. }
            | Warning::MuchSlack { cable, .. }
            | Warning::SlowStretch { cable, .. }
            | Warning::SlowBending { cable, .. }
            | Warning::ThickElements { cable, .. }
            | Warning::ThickDrag { cable, .. }
            | Warning::FastFlow { cable, .. }
            | Warning::ThickContact { cable, .. }
            | Warning::StrongGravity { cable, .. }
            | Warning::LargeTolerance { cable, .. }
            | Warning::FreeEye { cable, .. }
            | Warning::RoughContact { cable, .. }
            | Warning::StretchyBreak { cable, .. }
            | Warning::SoftCurve { cable, .. }
            | Warning::BreaksAgain { cable, .. }
            | Warning::StartsInside { cable, .. }
            | Warning::BeyondCurve { cable, .. }
            | Warning::Overloaded { cable, .. }
            | Warning::EnergyMade { cable, .. }
            | Warning::EnergyLost { cable, .. }
            | Warning::FastReel { cable, .. }
            | Warning::SlowReel { cable, .. }
            | Warning::UnseenLoad { cable, .. }
            | Warning::RoundedEnds { cable, .. }
            | Warning::PassedThrough { cable, .. }
            | Warning::NotResolved { cable, .. }
            | Warning::Sinks { cable, .. }
            | Warning::CoarseContact { cable, .. }
            | Warning::CoarseTouchdown { cable, .. }
            | Warning::HighRestitution { cable, .. }
            | Warning::FrictionLags { cable, .. }
            | Warning::Facets { cable, .. }
            | Warning::RunsOver { cable, .. }
            | Warning::PriedAttachment { cable, .. }
            | Warning::CutShort { cable, .. }
            | Warning::UnsolvedSteps { cable, .. }
            | Warning::IdleTorsion { cable, .. }
            | Warning::CoarseTwist { cable, .. }
            | Warning::TwistSlips { cable, .. }
            | Warning::KinksThroughItself { cable, .. }
            | Warning::MomentAlong { cable, .. }
            | Warning::StiffTorsion { cable, .. }
            | Warning::Stubby { cable, .. }
            | Warning::Thick { cable, .. }
            | Warning::LightMaterial { cable, .. }
            | Warning::FastWaves { cable, .. }
            | Warning::SoftMaterial { cable, .. } => cable,
        }
    }
}

impl Judged for Warning {
    fn level(&self) -> Level {
        self.level()
    }

    fn sign(&self) -> Option<Sign> {
        Some(match self {
            Warning::Stubby { .. }
            | Warning::ThickElements { .. }
            | Warning::Thick { .. }
            | Warning::LightMaterial { .. }
            | Warning::FastWaves { .. }
            | Warning::ThickDrag { .. }
            | Warning::SoftCurve { .. }
            | Warning::ThickContact { .. }
            | Warning::SoftMaterial { .. } => Sign::Sizes,
            Warning::LargeStrain { .. }
            | Warning::GreenStrain { .. }
            | Warning::BeyondCurve { .. }
            | Warning::Overloaded { .. } => Sign::Strain,
            Warning::EnergyMade { .. } => Sign::EnergyMade,
            Warning::EnergyLost { .. } => Sign::EnergyLost,
            Warning::StartsInside { .. } => Sign::Inside,
            Warning::PassedThrough { .. } => Sign::Crossing,
            Warning::LongSteps { .. } | Warning::NotResolved { .. } | Warning::CutShort { .. } => Sign::Steps,
            Warning::CoarseMesh { .. }
            | Warning::CoarseMotion { .. }
            | Warning::CoarseElement { .. }
            | Warning::CoarseContact { .. }
            | Warning::CoarseTwist { .. } => Sign::Mesh,
            Warning::Sinks { .. } => Sign::Depth,
            Warning::TwistSlips { .. } => Sign::Twist,
            Warning::UntouchedObstacles { .. }
            | Warning::MuchSlack { .. }
            | Warning::SlowStretch { .. }
            | Warning::SlowBending { .. }
            | Warning::CoarseMoment { .. }
            | Warning::CoarseKink { .. }
            | Warning::CoarseTouchdown { .. }
            | Warning::HighRestitution { .. }
            | Warning::RunsOver { .. }
            | Warning::PriedAttachment { .. }
            | Warning::IdleTorsion { .. }
            | Warning::KinksThroughItself { .. }
            | Warning::MomentAlong { .. }
            | Warning::StiffTorsion { .. }
            | Warning::FastReel { .. }
            | Warning::SlowReel { .. }
            | Warning::UnseenLoad { .. }
            | Warning::BreaksAgain { .. }
            | Warning::FastFlow { .. }
            | Warning::StrongGravity { .. }
            | Warning::LargeTolerance { .. }
            | Warning::FreeEye { .. }
            | Warning::RoughContact { .. }
            | Warning::StretchyBreak { .. }
            | Warning::FrictionLags { .. }
            | Warning::UnsolvedSteps { .. }
            | Warning::Facets { .. }
            | Warning::RoundedEnds { .. } => return None,
        })
    }

    fn same_kind(&self, other: &Self) -> bool {
        core::mem::discriminant(self) == core::mem::discriminant(other)
    }

    fn time(&self) -> Option<f64> {
        match self {
            Warning::LongSteps { time_s, .. }
            | Warning::LargeStrain { time_s, .. }
            | Warning::GreenStrain { time_s, .. }
            | Warning::BeyondCurve { time_s, .. }
            | Warning::Overloaded { time_s, .. }
            | Warning::EnergyLost { time_s, .. }
            | Warning::FastReel { time_s, .. }
            | Warning::UnseenLoad { time_s, .. }
            | Warning::MomentAlong { time_s, .. }
            | Warning::RoundedEnds { time_s, .. } => Some(*time_s),
            // energy is made until its time, not from then on
            _ => None,
        }
    }

    fn severity(&self) -> f64 {
        match self {
            Warning::CoarseMesh { error_m, .. }
            | Warning::LongSteps { error_m, .. }
            | Warning::CoarseKink { error_m, .. } => *error_m,
            Warning::CoarseMoment { moment_nm, elastica_nm, .. } => moment_nm / elastica_nm,
            Warning::CoarseMotion { error_m, displacement_m, .. } => error_m / displacement_m,
            Warning::CoarseElement { turn_rad, .. } | Warning::CoarseContact { turn_rad, .. } => *turn_rad,
            Warning::LargeStrain { tension_n, axial_stiffness_n, .. }
            | Warning::GreenStrain { tension_n, axial_stiffness_n, .. } => tension_n / axial_stiffness_n,
            Warning::EnergyMade { made_j: energy, scale_j, .. }
            | Warning::EnergyLost { lost_j: energy, scale_j, .. } => energy / scale_j,
            Warning::FastReel { ratio, .. }
            | Warning::CoarseTwist { ratio, .. }
            | Warning::StiffTorsion { ratio, .. }
            | Warning::CoarseTouchdown { share: ratio, .. }
            | Warning::KinksThroughItself { share: ratio, .. } => *ratio,
            Warning::MomentAlong { part_nm, .. } => *part_nm,
            Warning::SlowReel { asked_m, given_m, .. } => (asked_m - given_m).abs(),
            Warning::UnseenLoad { reached, .. } => *reached,
            Warning::StartsInside { depth_m, .. } => *depth_m,
            Warning::BeyondCurve { tension_n, force_n, .. } => tension_n / force_n,
            Warning::Overloaded { tension_n, bears_n, .. } => tension_n / bears_n,
            Warning::BreaksAgain { breaks, .. } => f64::from(*breaks),
            Warning::FastFlow { speed_m_s, .. } => *speed_m_s,
            Warning::RoughContact { friction, .. } => *friction,
            Warning::ThickContact { radius_m, .. } => *radius_m,
            Warning::StrongGravity { gravity_m_s2, .. } => *gravity_m_s2,
            Warning::LargeTolerance { tolerance_m, .. } => *tolerance_m,
            Warning::FreeEye { arc_length_m, .. } => *arc_length_m,
            Warning::StretchyBreak { strain, .. } => *strain,
            Warning::SoftCurve { strain, .. } => *strain,
            Warning::RoundedEnds { noise_n, .. } => *noise_n,
            Warning::Facets { slid_m, .. } => *slid_m,
            Warning::Sinks { share, .. } => *share,
            Warning::PassedThrough { steps, .. }
            | Warning::NotResolved { steps, .. }
            | Warning::CutShort { steps, .. }
            | Warning::UnsolvedSteps { steps, .. }
            | Warning::FrictionLags { steps, .. } => *steps as f64,
            Warning::TwistSlips { slips, .. } => *slips as f64,
            Warning::MuchSlack { length_m, drawn_m, .. } => length_m / drawn_m,
            Warning::SlowStretch { axial_s: time, .. } | Warning::SlowBending { bending_s: time, .. } => *time,
            Warning::ThickElements { element_m, diameter_m, .. } => diameter_m / element_m,
            // the more beyond the sizes of cables the smaller the number, or there is none
            Warning::Stubby { ratio, .. } => -ratio,
            Warning::LightMaterial { wave_speed_m_s, .. } | Warning::FastWaves { wave_speed_m_s, .. } => {
                *wave_speed_m_s
            }
            Warning::SoftMaterial { youngs_modulus_pa, .. } => -youngs_modulus_pa,
            Warning::Thick { diameter_m, .. } | Warning::ThickDrag { diameter_m, .. } => *diameter_m,
            Warning::HighRestitution { restitution, .. } => *restitution,
            Warning::RunsOver { run_m, .. } => *run_m,
            Warning::PriedAttachment { force_n, .. } => *force_n,
            Warning::UntouchedObstacles { count, .. } => *count as f64,
            Warning::IdleTorsion { .. } => 0.0,
        }
    }
}
