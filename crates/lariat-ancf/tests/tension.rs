//! The tension that is read: that of equilibrium, of second order in bending at least, with an uncertainty that covers its error.

use lariat_ancf::{At, Cable, CableBuilder, Motion, PointLoad, Section, Support, Vector3};

fn rod(axial: f64, bending: f64, elements: usize) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(axial, bending, 1.0).unwrap())
        .elements(elements)
        .gravity(Vector3::zeros())
}

fn settled(builder: CableBuilder) -> Cable {
    let mut cable = builder.build().unwrap();
    cable.equilibrium().unwrap();
    cable
}

fn tension(cable: &Cable, s: f64) -> f64 {
    cable.sample(s).unwrap().tension
}

/// Largest error of the tension along a cable, and the share of points at which the uncertainty covers it.
fn against(coarse: &Cable, fine: &Cable) -> (f64, f64) {
    let (mut worst, mut covered) = (0.0_f64, 0.0);
    for i in 0..400 {
        let s = coarse.length() * (f64::from(i) + 0.5) / 400.0;
        let here = coarse.sample(s).unwrap();
        let off = (here.tension - tension(fine, s)).abs();
        worst = worst.max(off);
        covered += f64::from(u8::from(off <= here.tension_uncertainty)) / 400.0;
    }
    (worst, covered)
}

/// A cantilever with a force at its tip, and one with gravity: from 10 to 40 elements the error falls by ten at
/// least, where the first order would divide it by four.
///
/// *Source.* The same cable with 160 elements.
#[test]
fn the_tension_is_of_second_order_in_bending_and_its_uncertainty_covers_the_error() {
    let force = |n| rod(1e6, 1.0, n).clamp(At::Start).load(PointLoad::force(1.0, [0.0, -10.0, 0.0]));
    let heavy = |n| rod(3e5, 0.5, n).clamp(At::Start).gravity([0.0, -9.81, 0.0]);
    let cases: [(&str, &dyn Fn(usize) -> CableBuilder); 2] = [("force", &force), ("heavy", &heavy)];
    for (name, build) in cases {
        let fine = settled(build(160));
        let errors = [10, 20, 40].map(|n| {
            let coarse = settled(build(n));
            let (error, covered) = against(&coarse, &fine);
            let largest = coarse.peak_tension().1;
            println!("{name}, {n} elements: off by {error:.2e} N of {largest:.2e} N, covered {covered:.2}");
            assert!(covered > 0.9, "{name}, {n}: {covered}");
            error
        });
        assert!(errors[0] > 10.0 * errors[2], "{name}: {errors:?}");
    }
}

/// Where the tension itself jumps it is not averaged: a load, a support and another section.
///
/// *Source.* Statics: forces along the line; the rule holds a share of 1e-3 of the strain that is not read.
#[test]
fn the_tension_is_not_averaged_where_it_jumps() {
    // a hanging line with a load in the middle
    let hanging =
        rod(1e7, 1e-3, 4).load(PointLoad::force(0.5, [30.0, 0.0, 0.0])).load(PointLoad::force(1.0, [10.0, 0.0, 0.0]));
    let cable = settled(hanging.fix(At::Start));
    let near = 1e-6;
    for (s, expected) in [(0.1, 40.0), (0.5 - near, 40.0), (0.5 + near, 10.0), (0.9, 10.0)] {
        assert!((tension(&cable, s) - expected).abs() < 0.04, "{s}: {} N", tension(&cable, s));
    }
    // held in the middle, pulled at the end
    let mut held = settled(rod(1e7, 1e-3, 4).fix(At::Start).load(PointLoad::force(1.0, [10.0, 0.0, 0.0])));
    let position = Some(Motion::fixed(held.node_position(2)));
    held.set_support(At::Node(2), Support { position, ..Support::default() }).unwrap();
    held.add_load(PointLoad::force(1.0, [50.0, 0.0, 0.0])).unwrap();
    held.equilibrium().unwrap();
    for (s, expected) in [(0.5 - near, 10.0), (0.5 + near, 60.0)] {
        assert!((tension(&held, s) - expected).abs() < 0.06, "{s}: {} N", tension(&held, s));
    }
    // one element: its ends are in equilibrium
    let single = settled(rod(1e7, 1e-3, 1).fix(At::Start).load(PointLoad::force(1.0, [10.0, 0.0, 0.0])));
    let sample = single.sample(0.3).unwrap();
    assert!((sample.tension - 10.0).abs() < 1e-8, "{}", sample.tension);
}

/// A hanging line under its weight: linear, and exact at its ends.
///
/// *Source.* Statics: the weight below.
#[test]
fn ends_are_read_by_the_middle_of_their_element() {
    for n in [2, 3, 10] {
        let cable = settled(rod(1e7, 1e-3, n).fix(At::Start).gravity([9.81, 0.0, 0.0]));
        for s in [0.0, 0.3, 1.0] {
            let expected = 9.81 * (1.0 - s);
            assert!((tension(&cable, s) - expected).abs() < 1e-4, "{n}: {} {expected}", tension(&cable, s));
        }
        let (at, peak) = cable.peak_tension();
        assert!(at == 0.0 && (peak - 9.81).abs() < 1e-4);
    }
}

/// A slack rope that is stiff beside its tension, EI/(T h^2) up to 400: its tension is the force along the tangent, at every point, on every
/// mesh. Its strain is off by 0.7 N of 1 N.
///
/// *Source.* Equilibrium: the force at a point is the reaction and the weight between, `F(s) = R + w s`.
#[test]
fn the_tension_of_a_slack_rope_is_that_of_equilibrium() {
    for (elements, bending, end) in [(5, 0.5, 2.5), (20, 0.5, 2.5), (20, 2.0, 2.9), (40, 0.02, 1.0), (80, 0.5, 2.5)] {
        let rope = Cable::builder().points([Vector3::zeros(), Vector3::new(end, 0.3, 0.0)]).length(3.0);
        let rope = rope.section(Section::from_stiffness(1.6e6, bending, 0.14).unwrap()).elements(elements);
        let mut rope = settled(rope.fix(At::Start).fix(At::End));
        let support = rope.reactions().unwrap()[0].force;
        let mut worst = 0.0f64;
        for k in 0..=60 {
            let s = 0.05 * f64::from(k);
            let sample = rope.sample(s).unwrap();
            let force = -support + Vector3::new(0.0, 0.14 * 9.81 * s, 0.0);
            worst = worst.max((sample.tension - force.dot(&sample.slope.normalize())).abs());
        }
        println!("{elements} elements, EI {bending}, {end} m: {worst:.1e} N off of {:.3} N", support.norm());
        assert!(worst < 1e-8 * support.norm().max(1.0), "{worst}");
    }
}

/// A string that turns about one end, whose inertia grows along it: the tension is that of the second order of the mesh, which swings by what its linear
/// strain leaves out.
///
/// *Source.* `N = m w^2 (L^2 - x^2)/2`, on lengths that hardly stretch.
#[test]
fn the_tension_of_a_turning_string_is_that_of_its_inertia() {
    let (spin, mass) = (12.0, 0.3);
    for elements in [2, 5, 10] {
        let section = Section::from_stiffness(1e7, 1e-3, mass).unwrap();
        let string = Cable::builder().points([Vector3::zeros(), 2.0 * Vector3::x()]).section(section);
        let mut string = string.elements(elements).gravity(Vector3::zeros()).fix(At::Start).build().unwrap();
        let h = 2.0 / elements as f64;
        let pull = |s: f64| 0.5 * mass * spin * spin * (4.0 - s * s);
        let (q, v): (Vec<_>, Vec<_>) = (0..=elements)
            .map(|k| {
                let s = h * k as f64;
                // stretched by N/EA
                let (x, slope) = (s + mass * spin * spin * (2.0 * s - s * s * s / 6.0) / 1e7, 1.0 + pull(s) / 1e7);
                ([x, 0.0, 0.0, slope, 0.0, 0.0], [0.0, spin * x, 0.0, 0.0, spin * slope, 0.0])
            })
            .unzip();
        string.set_coordinates(&q.concat(), &v.concat()).unwrap();
        for _ in 0..10 {
            string.step(1e-3).unwrap();
        }
        for k in 0..40 {
            let s = 0.05 * f64::from(k);
            let off = (tension(&string, s) - pull(s)).abs() / pull(0.0);
            assert!(off < 0.4 / (elements * elements) as f64, "{elements}, {s} m: {off:.1e}");
        }
    }
}
