//! Large deflections of a cantilever under a force and under a moment at its tip: `cargo run --release --example elastica`.
//!
//! # References
//!
//! Under a transverse force with P L^2/EI = 10 the tip of the inextensible elastica moves by 0.81061 L across and by 0.55500 L towards the
//! clamp (Mattiasson 1981, Int. J. Numer. Methods Eng. 17, 145, table 1). Under an end moment it is an arc of radius EI/M, here a quarter
//! circle and a full circle.

use lariat::{At, Cable, PointLoad, Section, Vector3};
use std::f64::consts::PI;

/// The tip of a cantilever of 1 m with EI = 1 N m^2 in equilibrium under a force (N) and a moment (N m) at its tip.
fn tip(force: Vector3<f64>, moment: Vector3<f64>) -> Result<Vector3<f64>, lariat::Error> {
    let mut beam = Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(1.0e6, 1.0, 0.4)?) // EA N, EI N m^2, kg/m
        .elements(24)
        .gravity(Vector3::zeros())
        .clamp(At::Start)
        .build()?;
    // in four load steps: a full circle is too far from the straight line for one
    for part in 1..=4 {
        beam.clear_loads();
        let share = f64::from(part) / 4.0;
        beam.add_load(PointLoad { moment: moment * share, ..PointLoad::force(1.0, force * share) })?;
        beam.equilibrium()?;
    }
    Ok(beam.sample(1.0)?.position)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let none = Vector3::zeros();
    for (name, force, moment, expected) in [
        ("force, P L^2/EI = 10", -10.0 * Vector3::y(), none, Vector3::new(1.0 - 0.55500, -0.81061, 0.0)),
        ("moment, quarter circle", none, 0.5 * PI * Vector3::z(), Vector3::new(2.0 / PI, 2.0 / PI, 0.0)),
        ("moment, full circle", none, 2.0 * PI * Vector3::z(), none),
    ] {
        let tip = tip(force, moment)?;
        let off = (tip - expected).norm();
        println!("{name:<23} tip at {:+.5}, {:+.5} m, error {off:.1e} m", tip.x, tip.y);
        if off > 1e-4 {
            return Err(format!("{name}: error {off:.1e} m").into());
        }
    }
    Ok(())
}
