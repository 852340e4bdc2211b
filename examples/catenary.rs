//! A slack line between two points of different height in equilibrium, compared with the catenary: `cargo run --release --example catenary`.
//!
//! # References
//!
//! An inextensible line of length l without bending stiffness, with span w and rise v, has `sqrt(l^2 - v^2) = 2 a sinh(w/2a)` and the
//! horizontal force `H = m g a`; its lowest point is at `w/2 - a artanh(v/l)`. Here EA is 7000 times the weight.

use lariat::{At, Cable, Section, Vector3};

const LENGTH: f64 = 3.0; // m
const SPAN: f64 = 2.0; // m
const RISE: f64 = 0.5; // m
const MASS: f64 = 0.5; // kg/m

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut line = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(SPAN, RISE, 0.0)])
        .length(LENGTH)
        .section(Section::from_stiffness(1.0e5, 1.0e-5, MASS)?) // EA N, EI N m^2, kg/m
        .elements(40)
        .fix(At::Start)
        .fix(At::End)
        .build()?;
    let report = line.equilibrium()?;
    let pull = line.reactions()?[0].force;
    let lowest = (0..=3000).map(|k| line.sample(f64::from(k) / 1000.0)).collect::<Result<Vec<_>, _>>()?;
    let lowest = lowest.iter().map(|s| s.position).min_by(|a, b| a.y.total_cmp(&b.y)).ok_or("no point")?;

    let chord = (LENGTH * LENGTH - RISE * RISE).sqrt();
    let (mut low, mut high) = (0.1, 10.0);
    for _ in 0..100 {
        let a: f64 = 0.5 * (low + high);
        // the left side falls as a grows
        if 2.0 * a * (SPAN / (2.0 * a)).sinh() > chord { low = a } else { high = a }
    }
    let a = 0.5 * (low + high);
    let (horizontal, place) = (MASS * 9.81 * a, 0.5 * SPAN - a * (RISE / LENGTH).atanh());
    println!("equilibrium in {} iterations, stable: {}", report.iterations, report.stable);
    println!("horizontal force {:.4} N, catenary {horizontal:.4} N", -pull.x);
    println!("lowest point at x = {:.4} m, y = {:.4} m; catenary x = {place:.4} m", lowest.x, lowest.y);
    if (-pull.x / horizontal - 1.0).abs() < 2e-3 && (lowest.x - place).abs() < 2e-3 {
        Ok(())
    } else {
        Err("force or lowest point differ from the catenary".into())
    }
}
