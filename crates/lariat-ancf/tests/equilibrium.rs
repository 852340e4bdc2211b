//! Static equilibrium in difficult cases: distant start shapes, thin cables, loops, heavy loads,
//! supports that have jumped.
//!
//! *Physics.* In equilibrium the reactions balance the loads. A stable one is a minimum of the
//! potential energy (Lagrange-Dirichlet): every small displacement that the supports allow raises
//! it. *Source.* Both laws are independent of the solver: the balance uses the reactions, the
//! minimum energies alone.

mod common;

use common::{Random, largest_difference};
use lariat_ancf::{
    At, AxialRule, BendingRule, Cable, CableBuilder, EquilibriumFailure, EquilibriumOptions, Error, Motion, PointLoad,
    Rule, Section, SlopeSupport, Support, Vector3,
};

const GRAVITY: f64 = 9.81;
const NO_BENDING: Rule = Rule::new(AxialRule::Projected, BendingRule::None);

/// A cable of 1 kg/m, with a name for messages.
struct Kind {
    name: &'static str,
    axial: f64,
    bending: f64,
    rule: Rule,
}

/// From zero bending stiffness to steel of 1 cm, and a thin cable: EA L^2/EI = 1e10 with 10 m.
fn kinds() -> [Kind; 4] {
    let kind = |name, axial, bending, rule| Kind { name, axial, bending, rule };
    [
        kind("no bending", 1e5, 0.0, NO_BENDING),
        kind("soft", 1e5, 0.1, Rule::default()),
        kind("steel", 1e7, 10.0, Rule::default()),
        kind("thin", 1e6, 0.01, Rule::default()),
    ]
}

/// A cable of `length` from the origin to `end`.
fn cable(kind: &Kind, length: f64, end: [f64; 3], elements: usize) -> CableBuilder {
    Cable::builder()
        .name(kind.name)
        .points([Vector3::zeros(), Vector3::from(end)])
        .length(length)
        .section(Section::from_stiffness(kind.axial, kind.bending, 1.0).unwrap())
        .rule(kind.rule)
        .elements(elements)
}

fn pinned(kind: &Kind, length: f64, end: [f64; 3], elements: usize) -> CableBuilder {
    cable(kind, length, end, elements).fix(At::Start).fix(At::End)
}

fn held_at(x: [f64; 3]) -> Support {
    Support { position: Some(Motion::fixed(Vector3::from(x))), ..Support::default() }
}

/// Potential energy in J, gravity and point forces included.
fn potential(cable: &Cable) -> f64 {
    let loads = cable.loads().iter().map(|l| l.force.dot(&cable.sample(l.arc_length).unwrap().position));
    cable.energy().total() - loads.sum::<f64>()
}

/// Checks the laws that an equilibrium satisfies.
fn check_at_rest(what: &str, cable: &mut Cable) {
    let gravity = cable.gravity();
    let loads: Vector3<f64> = cable.loads().iter().map(|l| l.force).sum::<Vector3<f64>>() + gravity * cable.length();
    let reactions: Vec<_> = cable.reactions().unwrap();
    let sum: Vector3<f64> = reactions.iter().map(|r| r.force).sum();
    let largest = reactions.iter().map(|r| r.force.norm()).fold(loads.norm(), f64::max);
    assert!((sum + loads).norm() < 1e-5 * (1.0 + largest), "{what}: reactions {sum:?} under {loads:?}");
    // no node's slope points backwards along both chords
    for i in 1..cable.nodes() - 1 {
        let t = Vector3::from_column_slice(&cable.positions()[6 * i + 3..6 * i + 6]);
        let chord = |a: usize| cable.node_position(a + 1) - cable.node_position(a);
        assert!(t.dot(&chord(i - 1)) > 0.0 || t.dot(&chord(i)) > 0.0, "{what}: folded at node {i}");
    }
    let held: Vec<(usize, bool)> = reactions
        .iter()
        .map(|r| (r.node, cable.support(At::Node(r.node)).unwrap().slope != SlopeSupport::Free))
        .collect();
    let (q, still) = (cable.positions().to_vec(), vec![0.0; cable.positions().len()]);
    let bottom = potential(cable);
    let mut random = Random::new(7);
    for size in [1e-3, 1e-5] {
        for _ in 0..10 {
            let mut moved: Vec<f64> = q.iter().map(|x| x + size * random.next()).collect();
            for &(node, clamped) in &held {
                let to = 6 * node + if clamped { 6 } else { 3 };
                moved[6 * node..to].copy_from_slice(&q[6 * node..to]);
            }
            cable.set_coordinates(&moved, &still).unwrap();
            let rise = potential(cable) - bottom;
            assert!(rise > -1e-11 * (1.0 + bottom.abs()), "{what}: moved by {size}, the energy falls by {:e} J", -rise);
        }
    }
    cable.set_coordinates(&q, &still).unwrap();
}

/// Every kind of cable in every difficult case, with even and odd numbers of elements, ends in
/// balance, at a minimum of the energy and without folds.
#[test]
fn difficult_cases_end_in_balance_at_a_minimum_of_the_energy() {
    let load = |f: f64| PointLoad::force(f, Vector3::new(0.0, -5000.0, 0.0));
    let mut most = 0;
    for kind in &kinds() {
        for n in [20, 41] {
            let jumped = |to: [f64; 3]| {
                let mut cable = pinned(kind, 10.0, [8.0, 1.0, 0.0], n).build().unwrap();
                cable.set_support(At::End, held_at(to)).unwrap();
                cable
            };
            let build = |builder: CableBuilder| builder.build().unwrap();
            let cases = [
                ("stretched three times", build(pinned(kind, 1.0, [3.0, 0.0, 0.0], n))),
                ("90 % closer than its length", build(pinned(kind, 1.0, [0.1, 0.0, 0.0], n))),
                ("taut", build(pinned(kind, 10.0, [10.0, 1.0, 0.0], n))),
                ("slack", build(pinned(kind, 10.0, [8.0, 1.0, 0.0], n))),
                ("pin below pin", build(pinned(kind, 10.0, [0.0, -8.0, 0.0], n))),
                ("both ends at one point", jumped([0.0; 3])),
                ("half a ton, taut", build(pinned(kind, 10.0, [10.0, 0.0, 0.0], n).load(load(5.0)))),
                ("half a ton, slack", build(pinned(kind, 10.0, [8.0, 0.0, 0.0], n).load(load(5.0)))),
                ("half a ton off the middle", build(pinned(kind, 10.0, [8.0, 0.0, 0.0], n).load(load(3.1)))),
                ("no gravity, slack", build(pinned(kind, 10.0, [8.0, 0.0, 0.0], n).gravity(Vector3::zeros()))),
                ("an end moved across", jumped([-7.0, 3.0, 4.0])),
                ("an end moved three lengths away", jumped([30.0, 3.0, 4.0])),
                ("released at one end", build(cable(kind, 10.0, [10.0, 0.0, 0.0], n).fix(At::Start))),
            ];
            for (place, mut cable) in cases {
                let what = format!("{} {n}, {place}", kind.name);
                let report = cable.equilibrium().unwrap_or_else(|e| panic!("{what}: {e}"));
                println!("{what}: {} iterations, stable {}", report.iterations, report.stable);
                assert!(report.iterations < 600, "{what}: {report:?}");
                most = most.max(report.iterations);
                check_at_rest(&what, &mut cable);
            }
        }
    }
    println!("at most {most} iterations");
}

/// A heavy weight on a light, stiff cable makes it a triangle of its unstretched length, with T =
/// F/(2 sin).
///
/// *Source.* Statics of three forces: half length 5, half span 4, so depth 3 and T = (5000 +
/// weight/2)/(2 * 3/5), the stretch and the weight are 1e-3 of it.
#[test]
fn heavy_weight_pulls_a_slack_cable_into_a_triangle() {
    let mut cable = pinned(&kinds()[2], 10.0, [8.0, 0.0, 0.0], 40)
        .load(PointLoad::force(5.0, Vector3::new(0.0, -5000.0, 0.0)))
        .build()
        .unwrap();
    cable.equilibrium().unwrap();
    let depth = -cable.node_position(20).y;
    // at the middle of an element: the sharp bend makes the strain oscillate inside the elements
    // next to it
    let tension = cable.sample(2.375).unwrap().tension;
    println!("depth {depth:.4} m, tension {tension:.1} N");
    assert!((depth - 3.0).abs() < 0.03, "{depth}");
    assert!((tension - 5000.0 / 1.2).abs() < 0.02 * tension, "{tension}");
}

/// A rod whose end is folded back on itself is straightened: the far slope reversed and of length
/// 2, the chord of the last element a third of its length.
///
/// *Source.* With the slopes (1, -2) along a line and the chord 1/3, r' = 1/3 - 3/2 P1 - 5/6 P2 on
/// the element (P Legendre): r'^2 has mean 1 and first moment 0, so the strain projected on linear
/// functions vanishes; no rod does that. An unloaded rod is straight.
#[test]
fn a_folded_end_is_straightened() {
    for bending in [0.01, 1.0, 10.0] {
        let mut rod = Cable::builder()
            .points([Vector3::zeros(), Vector3::x()])
            .section(Section::from_stiffness(2e4, bending, 1.0).unwrap())
            .elements(32)
            .gravity(Vector3::zeros())
            .clamp(At::Start)
            .build()
            .unwrap();
        let straight = rod.positions().to_vec();
        let mut q = straight.clone();
        q[6 * 32] = q[6 * 31] + 1.0 / 96.0;
        q[6 * 32 + 3] = -2.0;
        rod.set_coordinates(&q, &vec![0.0; q.len()]).unwrap();
        let report = rod.equilibrium().unwrap();
        println!("EI {bending}: {report:?}");
        assert!(report.stable);
        assert!(largest_difference(rod.positions(), &straight) < 1e-6, "EI {bending}: {:?}", &rod.positions()[180..]);
    }
}

/// A cable without bending stiffness that is clamped upwards at its start hangs down from the
/// clamp; it does not collapse onto it.
///
/// *Source.* The lowest shape of such a cable under gravity hangs straight down from its support:
/// its end is near -L.
#[test]
fn a_cable_without_bending_clamped_upwards_hangs_from_its_clamp() {
    for n in [20, 41] {
        let mut cable = cable(&kinds()[0], 10.0, [0.0, 10.0, 0.0], n).clamp(At::Start).build().unwrap();
        let report = cable.equilibrium().unwrap();
        let end = common::tip(&cable).y;
        println!("{n} elements: {report:?}, end at {end:.3} m");
        assert!(report.stable && end < -9.0, "{report:?}, end at {end} m");
    }
}

/// A cable that its supports cannot hold is an error without iterations, with the resultant: free,
/// held by a slope alone, rotated by a moment about a pin.
///
/// *Source.* Newton's second law: a resultant force accelerates a free body, a moment rotates one
/// about a pin.
#[test]
fn a_cable_that_is_not_held_is_an_error_without_iterations() {
    let free = || cable(&kinds()[1], 1.0, [1.0, 0.0, 0.0], 200);
    let mut by_slope = free().build().unwrap();
    let slope = SlopeSupport::Direction(Vector3::x());
    by_slope.set_support(At::Start, Support { slope, ..Support::default() }).unwrap();
    let spun = free().gravity(Vector3::zeros()).fix(At::Start).load(PointLoad::moment(1.0, Vector3::z()));
    let pushed = free().gravity(Vector3::zeros()).load(PointLoad::force(0.3, Vector3::x()));
    for (what, mut cable, expected) in [
        ("free", free().build().unwrap(), GRAVITY),
        ("slope alone", by_slope, GRAVITY),
        ("spun", spun.build().unwrap(), 1.0),
        ("pushed", pushed.build().unwrap(), 1.0),
    ] {
        let before = cable.snapshot().clone();
        match cable.equilibrium().unwrap_err() {
            Error::NoEquilibrium { failure, residual, iterations, .. } => {
                assert_eq!(failure, EquilibriumFailure::NotHeld, "{what}");
                assert!((residual - expected).abs() < 1e-9 && iterations == 0, "{what}: {residual}, {iterations}");
            }
            error => panic!("{what}: {error}"),
        }
        assert_eq!(*cable.snapshot(), before, "{what}");
    }
    let mut at_rest = free().gravity(Vector3::zeros()).build().unwrap();
    let before = at_rest.positions().to_vec();
    let report = at_rest.equilibrium().unwrap();
    assert!(report.iterations == 1 && !report.stable, "{report:?}");
    assert_eq!(at_rest.positions(), before);
}

/// A search that fails ends within five times the iterations of an attempt, its error carries time,
/// reason and residual, and the cable is unchanged.
///
/// *Source.* The contract.
#[test]
fn a_failed_search_is_bounded_and_its_error_carries_the_reason() {
    for iterations in [0, 1, 3, 7] {
        let mut cable = pinned(&kinds()[3], 10.0, [0.0, -8.0, 0.0], 41).build().unwrap();
        let before = cable.snapshot().clone();
        let options = EquilibriumOptions { iterations, ..EquilibriumOptions::default() };
        match cable.equilibrium_with(options).unwrap_err() {
            Error::NoEquilibrium { cable, time, failure, residual, iterations: done } => {
                println!("{cable:?}: {failure}; {residual:e} N after {done}");
                assert!(cable == "thin" && time == 0.0, "{cable}: {time}");
                assert!(done <= 5 * iterations, "{done} of {iterations}");
                assert!(iterations == 0 || residual.is_finite(), "{residual}");
            }
            error => panic!("{error}"),
        }
        assert_eq!(*cable.snapshot(), before);
    }
}
