//! What a probe writes: the columns of its file and a row of numbers.
//!
//! `dissipated` is the energy that damping and drag have taken from the cables, `interface_work` the work that cables have done on
//! the bodies they are attached to, and `total` the sum of the present energies, kinetic to gravity and torsion, with `"all"` including the
//! dynamic bodies. The gap of an attachment to the world is zero, because it is a support of the cable. Force and moment of an
//! attachment are those on the body or the world; at t = 0 those of a cable whose bodies are still held.

use super::World;
use crate::error::Error;
use crate::scene::Target;
use lariat_ancf::At;

/// Returns the columns of a probe.
pub(crate) fn columns(target: Target) -> &'static [&'static str] {
    match target {
        Target::Point { .. } => &[
            "t",
            "x",
            "y",
            "z",
            "vx",
            "vy",
            "vz",
            "sx",
            "sy",
            "sz",
            "tension",
            "curvature",
            "moment",
            "tension_uncertainty",
        ],
        Target::Body(_) => &["t", "x", "y", "z", "qx", "qy", "qz", "qw", "vx", "vy", "vz", "wx", "wy", "wz"],
        Target::Attachment(_) => &["t", "fx", "fy", "fz", "mx", "my", "mz", "gap"],
        Target::Reel(_) => &["t", "length_out", "rate", "force", "tension", "work"],
        Target::Sheave(_) => &["t", "passed", "rate", "from_tension", "to_tension", "friction", "lost"],
        Target::Torsion { .. } => &["t", "torque", "twist", "twist_rate", "energy"],
        Target::Energy { torsion: false, .. } => {
            &["t", "kinetic", "axial", "bending", "gravity", "dissipated", "interface_work", "total"]
        }
        Target::Energy { torsion: true, .. } => {
            &["t", "kinetic", "axial", "bending", "gravity", "dissipated", "interface_work", "total", "torsion"]
        }
        Target::Momentum(_) => &["t", "px", "py", "pz", "lx", "ly", "lz"],
    }
}

/// Reads a probe at the present state; `row` begins with the time.
pub(super) fn read(target: Target, world: &mut World, row: &mut Vec<f64>) -> Result<(), Error> {
    match target {
        Target::Point { cable, arc_length } => {
            let (part, s) = world.part(cable, arc_length);
            let sample = world.cables()[part].sample(s)?;
            for vector in [sample.position, sample.velocity, sample.slope] {
                row.extend(vector.iter());
            }
            row.extend([sample.tension, sample.curvature.norm(), sample.moment.norm()]);
            row.push(sample.tension_uncertainty);
        }
        Target::Body(index) => {
            if let Some(body) = world.body(index) {
                let q = body.rotation;
                row.extend(body.position.iter().chain(&[q.i, q.j, q.k, q.w]));
                row.extend(body.velocity.iter().chain(body.angular_velocity.iter()));
            }
        }
        Target::Attachment(index) => {
            let (force, moment, gap) = world.attachment(index)?;
            row.extend(force.iter().chain(moment.iter()).chain(&[gap]));
        }
        Target::Reel(cable) => {
            let (part, _) = world.part(cable, f64::INFINITY);
            // a reel at the end is at the last part of its cable
            let at_start = world.scene().reel_part(cable).is_some_and(|own| world.scene().cables[own].reel_at_start);
            let (part, end) = if at_start { (cable, At::Start) } else { (part, At::End) };
            if let Some(reel) = world.cables()[part].reel(end) {
                row.extend([reel.length_out, reel.rate, reel.force, reel.tension, reel.work]);
            }
        }
        Target::Sheave(sheave) => row.extend(world.sheave(sheave).unwrap_or([f64::NAN; 6])),
        Target::Torsion { cable, arc_length } => {
            let (part, s) = world.part(cable, arc_length);
            let reading = world.cables()[part].torsion_at(s)?;
            // without a clamp on both sides nothing is twisted
            row.extend(reading.map_or([0.0; 4], |at| [at.torque, at.twist, at.twist_rate, at.energy]));
        }
        Target::Energy { cable, torsion } => {
            let energy = world.energy(cable);
            let work = world.interface_work(cable)?;
            row.extend([energy.kinetic, energy.axial, energy.bending, energy.gravity]);
            row.extend([world.dissipated(cable), work, energy.total()]);
            row.extend(torsion.then_some(energy.torsion));
        }
        Target::Momentum(cable) => {
            let momentum = world.momentum(cable);
            row.extend(momentum.linear.iter().chain(momentum.angular.iter()));
        }
    }
    Ok(())
}
