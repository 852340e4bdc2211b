//! A rod rolled up by an end moment, in one call, from straight or from any other roll.
//!
//! *Physics.* A moment M at the end of a clamped rod bends it into an arc and, by this energy, stretches it: with
//! f^2 = 1 + 2 M^2/(EA EI), the angle is M f^2 L/EI and the radius f L/angle.
//!
//! *Source.* Analytic: dW/df = 0 and dW/dtheta' = M for W = EA (f^2 - 1)^2/8 + EI (theta'/f)^2/2.

mod common;

use lariat_ancf::{At, Cable, PointLoad, Section, Vector3};

/// A clamped rod of 1 m with EI = 1 N m^2 and 32 elements.
fn rod(axial: f64) -> Cable {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(axial, 1.0, 1.0).unwrap())
        .elements(32)
        .gravity(Vector3::zeros())
        .clamp(At::Start)
        .build()
        .unwrap()
}

/// Rolls the rod by `degrees` and gives the iterations and the distance of the end from the arc's.
fn roll(rod: &mut Cable, axial: f64, degrees: f64) -> (usize, f64) {
    let angle = degrees.to_radians();
    let mut m = angle;
    for _ in 0..200 {
        m = angle / (1.0 + 2.0 * m * m / axial);
    }
    rod.clear_loads();
    rod.add_load(PointLoad::moment(1.0, Vector3::z() * m)).unwrap();
    let report = rod.equilibrium().unwrap_or_else(|e| panic!("EA {axial:e}, {degrees} degrees: {e}"));
    let radius = (1.0 + 2.0 * m * m / axial).sqrt() / angle;
    let end =
        if angle == 0.0 { Vector3::x() } else { Vector3::new(radius * angle.sin(), radius * (1.0 - angle.cos()), 0.0) };
    (report.iterations, (common::tip(rod) - end).norm())
}

/// From straight, up to two full circles at once, thick to very thin (EA L^2/EI = 2e4 to 1e8).
#[test]
fn a_straight_rod_is_rolled_up_in_one_call() {
    for (axial, most) in [(2e4, 300), (1e6, 300), (1e8, 600)] {
        for degrees in [45.0, 90.0, 180.0, 270.0, 360.0, 720.0] {
            let (iterations, error) = roll(&mut rod(axial), axial, degrees);
            println!("EA {axial:e}, {degrees} degrees: {iterations} iterations, end {error:.1e} m off");
            assert!(iterations < most, "EA {axial:e}, {degrees} degrees: {iterations}");
            assert!(error < if degrees > 360.0 { 2e-3 } else { 1e-4 }, "EA {axial:e}, {degrees} degrees: {error:e} m");
        }
    }
}

/// From one roll to another: on, back, and over to the other side.
#[test]
fn a_rolled_rod_is_rolled_on_and_back_in_one_call() {
    for (from, to) in [(90.0, 180.0), (90.0, 360.0), (45.0, 90.0), (315.0, 360.0), (180.0, -180.0), (360.0, 0.0)] {
        let mut rod = rod(2e4);
        roll(&mut rod, 2e4, from);
        let (iterations, error) = roll(&mut rod, 2e4, to);
        println!("{from} to {to} degrees: {iterations} iterations, end {error:.1e} m off");
        assert!(iterations < 300 && error < 2e-5, "{from} to {to} degrees: {iterations} iterations, {error:e} m");
    }
}

/// Eight calls around the circle give the same circle as one.
#[test]
fn the_circle_does_not_depend_on_the_number_of_calls() {
    let (mut once, mut often) = (rod(2e4), rod(2e4));
    roll(&mut once, 2e4, 360.0);
    let mut iterations = 0;
    for i in 1..=8 {
        iterations += roll(&mut often, 2e4, 45.0 * f64::from(i)).0;
    }
    println!("{iterations} iterations in eight calls");
    let off = common::largest_difference(once.positions(), often.positions());
    assert!(off < 1e-7 && iterations < 300, "{off:e} m, {iterations} iterations");
}
