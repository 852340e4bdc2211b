//! How much depends on each warning about a scene or a run, and what it is a sign of.

use super::Warning;
use lariat_ancf::Level;
use lariat_ancf::warning::fold::{Judged, Sign};

impl Warning {
    /// Returns how much depends on it.
    pub fn level(&self) -> Level {
        match self {
            Warning::Cable(warning) => warning.level(),
            Warning::FallsFreely { .. }
            | Warning::StartsInside { .. }
            | Warning::PassesThrough { .. }
            | Warning::UnfinishedRamp { .. }
            | Warning::RankDeficient { .. }
            | Warning::LeftAsDrawn { .. }
            | Warning::VelocityJump { .. }
            | Warning::DrawnCorner { .. }
            | Warning::FarAnchor { .. }
            | Warning::MixedJoints { .. }
            | Warning::ClosingGap { .. }
            | Warning::LargeLoad { .. }
            | Warning::LargeInWaves { .. }
            | Warning::LightWater { .. }
            | Warning::AddedMassInAir { .. }
            | Warning::FarFromOrigin { .. }
            | Warning::FastSpin { .. }
            | Warning::CoarsePath { .. }
            | Warning::ManyTurns { .. } => Level::Setup,
            Warning::OpenGap { .. }
            | Warning::Unsettled { .. }
            | Warning::SheaveStopped { .. }
            | Warning::WheelTurned { .. }
            | Warning::EnergyMade { .. }
            | Warning::NoConvergence { .. }
            | Warning::ForcesNotProven { .. }
            | Warning::ErrorNotReached { .. }
            | Warning::CoarseTension { .. }
            | Warning::UnstableEquilibrium { .. } => Level::Wrong,
            Warning::StiffKink { .. } | Warning::EnergyLost { .. } => Level::Coarse,
        }
    }

    /// Returns the name of the cable that it is about, if it is about one.
    pub fn cable(&self) -> Option<&str> {
        match self {
            Warning::Cable(warning) => Some(warning.cable()),
            Warning::StartsInside { cable, .. }
            | Warning::PassesThrough { cable, .. }
            | Warning::OpenGap { cable, .. }
            | Warning::Unsettled { cable, .. }
            | Warning::StiffKink { cable, .. }
            | Warning::CoarseTension { cable, .. }
            | Warning::RankDeficient { cable, .. }
            | Warning::UnstableEquilibrium { cable, .. }
            | Warning::VelocityJump { cable, .. }
            | Warning::DrawnCorner { cable, .. }
            | Warning::AddedMassInAir { cable, .. }
            | Warning::FarAnchor { cable, .. }
            | Warning::MixedJoints { cable, .. }
            | Warning::ClosingGap { cable, .. }
            | Warning::LargeLoad { cable, .. } => Some(cable),
            Warning::FallsFreely { .. }
            | Warning::SheaveStopped { .. }
            | Warning::WheelTurned { .. }
            | Warning::UnfinishedRamp { .. }
            | Warning::EnergyMade { .. }
            | Warning::EnergyLost { .. }
            | Warning::NoConvergence { .. }
            | Warning::ForcesNotProven { .. }
            | Warning::ErrorNotReached { .. }
            | Warning::LeftAsDrawn { .. }
            | Warning::LargeInWaves { .. }
            | Warning::LightWater { .. }
            | Warning::FarFromOrigin { .. }
            | Warning::FastSpin { .. }
            | Warning::CoarsePath { .. }
            | Warning::ManyTurns { .. } => None,
        }
    }
}

impl Judged for Warning {
    fn level(&self) -> Level {
        self.level()
    }

    fn sign(&self) -> Option<Sign> {
        Some(match self {
            Warning::Cable(warning) => return warning.sign(),
            Warning::StartsInside { .. } => Sign::Inside,
            Warning::OpenGap { .. } | Warning::FarAnchor { .. } | Warning::ClosingGap { .. } => Sign::Gap,
            Warning::VelocityJump { .. } => Sign::Shock,
            Warning::DrawnCorner { .. } => Sign::Corner,
            Warning::LargeLoad { .. } => Sign::Sizes,
            Warning::EnergyMade { .. } => Sign::EnergyMade,
            Warning::EnergyLost { .. } => Sign::EnergyLost,
            Warning::FallsFreely { .. }
            | Warning::PassesThrough { .. }
            | Warning::Unsettled { .. }
            | Warning::SheaveStopped { .. }
            | Warning::WheelTurned { .. }
            | Warning::UnfinishedRamp { .. }
            | Warning::StiffKink { .. }
            | Warning::CoarseTension { .. }
            | Warning::NoConvergence { .. }
            | Warning::ForcesNotProven { .. }
            | Warning::ErrorNotReached { .. }
            | Warning::RankDeficient { .. }
            | Warning::UnstableEquilibrium { .. }
            | Warning::LeftAsDrawn { .. }
            | Warning::MixedJoints { .. }
            | Warning::LargeInWaves { .. }
            | Warning::LightWater { .. }
            | Warning::AddedMassInAir { .. }
            | Warning::FarFromOrigin { .. }
            | Warning::FastSpin { .. }
            | Warning::CoarsePath { .. }
            | Warning::ManyTurns { .. } => return None,
        })
    }

    fn same_kind(&self, other: &Self) -> bool {
        match (self, other) {
            (Warning::Cable(a), Warning::Cable(b)) => a.same_kind(b),
            _ => core::mem::discriminant(self) == core::mem::discriminant(other),
        }
    }

    fn time(&self) -> Option<f64> {
        match self {
            Warning::Cable(warning) => warning.time(),
            Warning::EnergyLost { time_s, .. } => Some(*time_s),
            // energy is made until its time, and a gap is largest then: consequences may precede
            _ => None,
        }
    }

    fn severity(&self) -> f64 {
        match self {
            Warning::Cable(warning) => warning.severity(),
            Warning::FallsFreely { fall_m, .. } => *fall_m,
            Warning::StartsInside { depth_m, .. } => *depth_m,
            Warning::PassesThrough { time_s, .. } | Warning::SheaveStopped { time_s, .. } => -time_s,
            Warning::OpenGap { gap_m, .. } | Warning::ClosingGap { gap_m, .. } => *gap_m,
            Warning::Unsettled { force, .. } => *force,
            Warning::WheelTurned { error_m, part_m, .. } => error_m / part_m,
            Warning::UnfinishedRamp { ramp_s, .. } => *ramp_s,
            Warning::EnergyMade { made_j: energy, scale_j, .. }
            | Warning::EnergyLost { lost_j: energy, scale_j, .. } => energy / scale_j,
            Warning::UnstableEquilibrium { compression, .. } => compression.unwrap_or(0.0),
            Warning::VelocityJump { force_n, .. } => *force_n,
            Warning::DrawnCorner { speed_m_s, .. } => *speed_m_s,
            Warning::FarAnchor { distance_m, radius_m, .. } => distance_m / radius_m,
            Warning::LargeLoad { force_n, axial_stiffness_n, .. } => force_n / axial_stiffness_n,
            Warning::LargeInWaves { size_m, wave_length_m, .. } => size_m / wave_length_m,
            Warning::LightWater { density_kg_m3 } => -density_kg_m3,
            Warning::ManyTurns { angle_rad, .. } => *angle_rad,
            Warning::StiffKink { error_m, .. } => *error_m,
            Warning::CoarseTension { share, .. } => *share,
            Warning::AddedMassInAir { share, .. } => *share,
            Warning::FarFromOrigin { distance_m, .. } => *distance_m,
            Warning::FastSpin { turn_rad, .. } => *turn_rad,
            Warning::CoarsePath { lost_m, .. } => *lost_m,
            Warning::NoConvergence { .. }
            | Warning::ForcesNotProven { .. }
            | Warning::ErrorNotReached { .. }
            | Warning::RankDeficient { .. }
            | Warning::LeftAsDrawn { .. }
            | Warning::MixedJoints { .. } => 0.0,
        }
    }
}
