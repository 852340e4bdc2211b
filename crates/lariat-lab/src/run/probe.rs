//! What a probe writes: the columns of its file and a row of numbers.
//!
//! `dissipated` is what effects take out of the scene and `interface_work` what passes between cables and bodies: zero here.
//! `gap` is zero: an attachment to the world holds the cable point itself. The force of an attachment is the one on the world.

use super::World;
use crate::error::Error;
use crate::scene::Target;

/// The columns of a probe.
pub(super) fn columns(target: Target) -> &'static [&'static str] {
    match target {
        Target::Point { .. } => {
            &["t", "x", "y", "z", "vx", "vy", "vz", "sx", "sy", "sz", "tension", "curvature", "moment"]
        }
        Target::Attachment(_) => &["t", "fx", "fy", "fz", "mx", "my", "mz", "gap"],
        Target::Energy(_) => &["t", "kinetic", "axial", "bending", "gravity", "dissipated", "interface_work", "total"],
        Target::Momentum(_) => &["t", "px", "py", "pz", "lx", "ly", "lz"],
    }
}

/// Reads a probe at the present state; `row` begins with the time.
pub(super) fn read(target: Target, world: &mut World, row: &mut Vec<f64>) -> Result<(), Error> {
    match target {
        Target::Point { cable, arc_length } => {
            let sample = world.cables[cable].sample(arc_length)?;
            for vector in [sample.position, sample.velocity, sample.slope] {
                row.extend(vector.iter());
            }
            row.extend([sample.tension, sample.curvature.norm(), sample.moment.norm()]);
        }
        Target::Attachment(index) => {
            let (force, moment) = world.attachment(index)?;
            row.extend(force.iter().chain(moment.iter()).chain(&[0.0]));
        }
        Target::Energy(cable) => {
            let energy = world.energy(cable);
            row.extend([energy.kinetic, energy.axial, energy.bending, energy.gravity, 0.0, 0.0, energy.total()]);
        }
        Target::Momentum(cable) => {
            let momentum = world.momentum(cable);
            row.extend(momentum.linear.iter().chain(momentum.angular.iter()));
        }
    }
    Ok(())
}
