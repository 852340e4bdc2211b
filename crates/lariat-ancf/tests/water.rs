//! Cables at a free surface and in waves: forces against their formulas, derivatives, energy, draught, what is deep below.

use lariat_ancf::coupling::{Coupling, Linearisation};
use lariat_ancf::{
    At, Buoyancy, Cable, Drag, Effects, Error, Flow, Integrator, Method, Section, StepControl, Surface, Vector3, Water,
    Wave,
};
use std::f64::consts::{PI, TAU};

const RHO: f64 = 1000.0;
const G: f64 = 9.81;

fn still() -> Surface {
    Surface::at(0.0, Vector3::new(0.0, -G, 0.0))
}

fn in_waves() -> Surface {
    still().with_wave(Wave { phase: 0.4, depth: Some(30.0), ..Wave::deep(0.8, 5.0, Vector3::new(1.0, 0.0, 0.3)) })
}

fn in_water(surface: Option<Surface>) -> Effects {
    Effects {
        drag: Some(Drag::new(
            RHO,
            1.1,
            0.05,
            Flow { surface: surface.map(Box::new), ..Flow::uniform(Vector3::new(0.2, 0.0, 0.1)) },
        )),
        buoyancy: Some(Buoyancy { surface, ..Buoyancy::new(RHO, 1.0) }),
        ..Effects::default()
    }
}

/// A cable of 20 cm and a density in kg/m^3, between two points.
fn cable(points: [Vector3<f64>; 2], density: f64, effects: Effects) -> lariat_ancf::CableBuilder {
    let section = Section::round(0.2, 1e7, density).unwrap();
    Cable::builder().points(points).section(section).elements(4).effects(effects)
}

/// *Source.* Below the surface by more than its radius, a cable in still water is one in water without a surface: to the bit.
#[test]
fn a_cable_deep_below_the_surface_moves_as_in_water_without_one() {
    let run = |surface: Option<Surface>| {
        let ends = [Vector3::new(0.0, -9.0, 0.0), Vector3::new(4.0, -9.0, 0.0)];
        let mut cable = cable(ends, 1500.0, in_water(surface)).fix(At::Start).build().unwrap();
        for _ in 0..30 {
            cable.step(1.0 / 60.0).unwrap();
        }
        cable.positions().to_vec()
    };
    assert_eq!(run(None), run(Some(still())));
}

/// *Source.* Sums of the formula at 4000 points: 1/2 rho d C |u| u, (1 + C_a) rho A u', rho A g of what is wet.
#[test]
fn the_force_on_an_upright_cable_in_a_wave_is_that_of_morison() {
    let ends = [Vector3::new(2.0, -6.0, 1.0), Vector3::new(2.0, -2.0, 1.0)];
    let mut cable = cable(ends, 1500.0, in_water(Some(in_waves()))).elements(12).build().unwrap();
    cable.set_time(1.3).unwrap();
    let force = cable.force();
    let sum = |c: usize| force.chunks_exact(6).map(|node| node[c]).sum::<f64>();
    let found = Vector3::new(sum(0), sum(1), sum(2));
    let sea = in_waves().sea();
    let (n, area) = (4000, PI * 0.01);
    let mut expected = Vector3::zeros();
    for i in 0..n {
        let at = sea.at(1.3, &(ends[0] + (ends[1] - ends[0]) * ((i as f64 + 0.5) / n as f64)));
        let u = at.velocity + Vector3::new(0.2, 0.0, 0.1);
        let (along, across) = (u.y, Vector3::new(u.x, 0.0, u.z));
        let drag = 0.5 * RHO * 0.2 * (1.1 * across.norm() * across + 0.05 * along.abs() * along * Vector3::y());
        let inertia = at.acceleration * (2.0 * RHO * area);
        let weight = Vector3::new(0.0, -(1500.0 - RHO) * area * G, 0.0);
        expected += (drag + inertia + weight) * (4.0 / n as f64);
    }
    println!("{found} {expected}");
    assert!((found - expected).norm() < 1e-4 * expected.norm(), "{found} {expected}");
}

/// *Source.* Central differences of the force.
#[test]
fn the_derivatives_of_the_force_at_the_surface_of_water_at_rest_are_exact() {
    let ends = [Vector3::new(0.0, 0.03, 0.0), Vector3::new(4.0, -0.05, 0.2)];
    let mut cable = cable(ends, 700.0, in_water(Some(still()))).build().unwrap();
    let (q, v): (Vec<f64>, Vec<f64>) = {
        let q = cable.positions().to_vec();
        let v = (0..q.len()).map(|i| 0.3 * (1.7 * i as f64).sin()).collect();
        (q, v)
    };
    let mut force = |q: &[f64]| {
        cable.set_coordinates(q, &v).unwrap();
        cable.force()
    };
    let h = 1e-6;
    let columns: Vec<Vec<f64>> = (0..q.len())
        .map(|i| {
            let moved = |by: f64| {
                let mut x = q.clone();
                x[i] += by;
                x
            };
            let (a, b) = (force(&moved(h)), force(&moved(-h)));
            a.iter().zip(&b).map(|(a, b)| (a - b) / (2.0 * h)).collect()
        })
        .collect();
    force(&q);
    let jacobians = cable.jacobians();
    let size = columns.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    for (i, column) in columns.iter().enumerate() {
        for (k, x) in column.iter().enumerate() {
            let exact = -jacobians.stiffness[(k, i)];
            assert!((x - exact).abs() < 1e-6 * size, "{k} {i}: {x} {exact}");
        }
    }
}

/// The work of the surface on a level cable that bobs is the change of the energy of the water that it displaces, at long steps, of which the
/// numerical dissipation of the method takes some and makes none.
///
/// *Source.* The energy of a circular segment: rho g per length times the integral of its area over the depth, by sums.
#[test]
fn the_surface_does_the_work_of_the_displaced_water_on_a_cable_that_bobs() {
    let effects = Effects {
        buoyancy: Some(Buoyancy { surface: Some(still()), ..Buoyancy::new(RHO, 0.0) }),
        ..Effects::default()
    };
    let ends = [Vector3::new(0.0, 0.05, 0.0), Vector3::new(4.0, 0.05, 0.0)];
    let integrator = Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(0.1) };
    let mut cable = cable(ends, 600.0, effects).integrator(integrator).build().unwrap();
    let mass = 600.0 * PI * 0.01 * 4.0;
    let water = |y: f64| {
        let n = 20_000;
        let area = |depth: f64| {
            let s = (depth / 0.1).clamp(-1.0, 1.0);
            0.01 * (0.5 * PI + s.asin() + s * (1.0 - s * s).sqrt())
        };
        // from above the surface down to y
        let step = (0.1 - y).max(0.0) / n as f64;
        (0..n).map(|i| area(-0.1 + (i as f64 + 0.5) * step) * step).sum::<f64>() * 4.0 * RHO * G
    };
    let energy = |cable: &Cable| {
        let middle = cable.sample(2.0).unwrap();
        0.5 * mass * middle.velocity.y.powi(2) + mass * G * middle.position.y + water(middle.position.y)
    };
    let start = energy(&cable);
    let (mut low, mut high) = (0.0f64, 0.0f64);
    let first = water(0.05);
    for _ in 0..200 {
        cable.step(0.1).unwrap();
        let y = cable.sample(2.0).unwrap().position.y;
        (low, high) = (low.min(y), high.max(y));
        // what is dry is taken from the buoyancy of the whole
        let expected = first - water(y) - RHO * PI * 0.01 * 4.0 * G * (y - 0.05);
        let work = cable.effect_work().buoyancy;
        assert!((work - expected).abs() < 1e-6 * mass * G * 0.1, "{y}: {work} {expected}");
        let now = energy(&cable);
        assert!(now <= start + 1e-9 * mass * G, "{y}: {now} {start}");
    }
    println!("between {low} and {high}");
    assert!(low < -0.05 && high < 0.0501, "{low} {high}");
}

/// *Source.* The segment of the circle whose share is the ratio of the densities, by bisection.
#[test]
fn a_floating_cable_comes_to_rest_at_its_draught() {
    for density in [300.0, 500.0, 850.0] {
        let (mut low, mut high) = (-1.0f64, 1.0f64);
        for _ in 0..60 {
            let s = 0.5 * (low + high);
            let share = 0.5 + (s.asin() + s * (1.0 - s * s).sqrt()) / PI;
            if share < density / RHO { low = s } else { high = s }
        }
        let water = Water::new(RHO).with_surface(still());
        let effects =
            Effects { drag: Some(water.drag(1.2, 0.01)), buoyancy: Some(water.buoyancy(1.0)), ..Effects::default() };
        // drag ends what is left of the motion slowly: it starts where it will rest but for a centimetre
        let y = -0.1 * low + 0.01;
        let ends = [Vector3::new(0.0, y, 0.0), Vector3::new(4.0, y, 0.0)];
        let mut cable = cable(ends, density, effects).build().unwrap();
        let mut mean = 0.0;
        for i in 0..3600 {
            cable.step(1.0 / 30.0).unwrap();
            mean += if i >= 2400 { cable.sample(2.0).unwrap().position.y / 1200.0 } else { 0.0 };
        }
        let last = cable.sample(2.0).unwrap().position.y;
        println!("{density}: mean {mean} last {last} expected {}", -0.1 * low);
        assert!((mean + 0.1 * low).abs() < 1e-4, "{density} {mean} {}", -0.1 * low);
    }
}

/// *Source.* omega^2 of small heave: rho g b/(m + a), b the width of the cut at the surface.
#[test]
fn a_floating_cable_heaves_with_its_natural_period() {
    let effects = Effects {
        buoyancy: Some(Buoyancy { surface: Some(still()), ..Buoyancy::new(RHO, 1.0) }),
        ..Effects::default()
    };
    let ends = [Vector3::new(0.0, 0.002, 0.0), Vector3::new(4.0, 0.002, 0.0)];
    let integrator = Integrator::tolerance(Method::Esdirk4, 1e-9).unwrap();
    let mut cable = cable(ends, 500.0, effects).integrator(integrator).build().unwrap();
    let expected = TAU * ((500.0 + RHO) * PI * 0.01 / (RHO * G * 0.2)).sqrt();
    let (mut before, mut crossings) = (0.002, Vec::new());
    for i in 1..2000 {
        cable.step(0.01).unwrap();
        let now = cable.sample(2.0).unwrap().position.y;
        if before > 0.0 && now <= 0.0 {
            crossings.push(0.01 * f64::from(i) - 0.01 * now / (now - before));
        }
        before = now;
    }
    let n = crossings.len() - 1;
    let found = (crossings[n] - crossings[0]) / n as f64;
    println!("{found} {expected}");
    assert!((found / expected - 1.0).abs() < 2e-4, "{found} {expected}");
}

#[test]
fn a_surface_that_is_none_is_refused() {
    let build = |surface: Surface| {
        let ends = [Vector3::zeros(), Vector3::new(4.0, 0.0, 0.0)];
        cable(ends, 600.0, in_water(Some(surface))).build()
    };
    assert!(build(in_waves()).is_ok());
    for bad in [
        Surface { up: Vector3::new(0.1, 1.0, 0.0), ..still() },
        Surface { up: Vector3::zeros(), ..still() },
        Surface { gravity: 0.0, ..still() },
        still().with_wave(Wave::deep(5.0, 3.0, Vector3::x())),
    ] {
        assert!(matches!(build(bad), Err(Error::InvalidValue { .. })), "{bad:?}");
    }
}
