//! Twisted cables that are paid out and taken in.

use lariat_ancf::coupling::Coupling;
use lariat_ancf::{
    At, Cable, Effects, Integrator, Method, PointLoad, Reel, Section, SlopeSupport, StepControl, Support, Torsion,
    Vector3,
};
use nalgebra::UnitQuaternion;
use std::f64::consts::TAU;

const STIFFNESS: f64 = 0.5;

fn game(step: f64) -> Integrator {
    Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(step) }
}

/// A rope of 2 m along x without weight, whose first end slides along its axis under a pull in N
/// and holds the spin, twisted by some turns.
fn pulled(turns: f64, pull: f64) -> Cable {
    let torsion = Torsion { initial_twist: turns, ..Torsion::new(STIFFNESS) };
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(2.0, 0.0, 0.0)])
        .section(Section::from_stiffness(1e5, 0.6, 0.1).unwrap())
        .elements(10)
        .gravity(Vector3::zeros())
        .clamp(At::Start)
        .clamp(At::End)
        .effects(Effects { torsion: Some(torsion), ..Effects::default() })
        .integrator(game(1.0 / 240.0))
        .build()
        .unwrap();
    let own = cable.support(At::Start).unwrap();
    cable.set_support(At::Start, Support { position: None, ..own }).unwrap();
    assert!(own.slope != SlopeSupport::Free);
    cable.add_load(PointLoad::force(0.0, Vector3::new(-pull, 0.0, 0.0))).unwrap();
    cable
}

/// The work of the winch that takes a twisted rope in, and length and torque at the end.
fn taken_in(turns: f64) -> [f64; 3] {
    let mut cable = pulled(turns, 200.0);
    cable.equilibrium().unwrap();
    cable.add_reel(At::End, Reel::with_rate(-0.1)).unwrap();
    for _ in 0..600 {
        cable.step(1.0 / 60.0).unwrap();
    }
    let reel = cable.reel(At::End).unwrap();
    assert!(reel.merges >= 4, "{reel:?}");
    let torque = cable.torsion().first().map_or(0.0, |reading| reading.torque);
    [reel.work, reel.length_out, torque]
}

/// A twisted rope that is taken in slowly keeps its twist: the torque grows as 1/L, and the winch
/// does the integral of M^2/(2 GJ) less work for it, which is what the energy of the twist gains.
///
/// *Source.* `M = GJ Phi/L`, and `GJ Phi^2/2 (1/L1 - 1/L0)`.
#[test]
fn a_rope_that_is_taken_in_keeps_its_twist() {
    let ([plain, ..], [work, length, torque]) = (taken_in(0.0), taken_in(1.5));
    let twist = 1.5 * TAU;
    let own = 0.5 * STIFFNESS * twist * twist * (1.0 / length - 0.5);
    println!("{length} m, {torque} N m, work {} J for {own} J", work - plain);
    assert!((torque / (STIFFNESS * twist / length) - 1.0).abs() < 1e-12, "{torque}");
    assert!(((work - plain) / own - 1.0).abs() < 1e-6, "{} of {own}", work - plain);
}

/// The pull on a winch that stands is that of the rope without twist, and M^2/(2 GJ) more that
/// pushes out; so a brake of less force lets the rope run out against no load, and a stronger one
/// holds it.
///
/// *Source.* -dU/dL at fixed twist.
#[test]
fn a_twisted_rope_pushes_out_of_its_reel() {
    let [plain, twisted] = [0.0, 1.5].map(|turns| {
        let mut cable = pulled(turns, 200.0);
        cable.equilibrium().unwrap();
        cable.add_reel(At::End, Reel::default()).unwrap();
        let read = |cable: &Cable| cable.reel(At::End).unwrap().force;
        let at_rest = read(&cable);
        cable.step(1.0 / 60.0).unwrap();
        [at_rest, read(&cable)]
    });
    let torque = STIFFNESS * 1.5 * TAU / 2.0;
    let own = 0.5 * torque * torque / STIFFNESS;
    for (plain, twisted) in plain.iter().zip(twisted) {
        assert!(((twisted - plain) / own - 1.0).abs() < 1e-6, "{plain} {twisted} {own}");
    }
    let ran = [0.9, 1.1].map(|share| {
        let mut cable = pulled(1.5, 200.0);
        cable.equilibrium().unwrap();
        cable.add_reel(At::End, Reel::brake(share * own + plain[0])).unwrap();
        (0..6).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        cable.length() - 2.0
    });
    assert!(ran[0] > 1e-3 && ran[1] == 0.0, "{ran:?}");
}

/// A slack twisted rope between clamps, damped, whose reels at one or both ends turn out and in.
fn swinging(step: f64, turns: f64, both: bool) -> Cable {
    let torsion = Torsion { initial_twist: turns, ..Torsion::new(0.02) };
    let mut cable = Cable::builder()
        .points([Vector3::zeros(), Vector3::new(0.6, -0.8, 0.3), Vector3::new(1.2, 0.0, 0.0)])
        .section(Section::from_stiffness(1e4, 0.03, 0.2).unwrap())
        .elements(12)
        .clamp(At::Start)
        .clamp(At::End)
        .effects(Effects { torsion: Some(torsion), ..Effects::default() })
        .integrator(game(step))
        .build()
        .unwrap();
    for at in [At::End, At::Start].into_iter().take(if both { 2 } else { 1 }) {
        cable.add_reel(at, Reel { acceleration: 4.0, ..Reel::default() }).unwrap();
    }
    cable
}

/// Runs for 2 s; returns by how much in J the account of energy was off most, the work that moved,
/// and by how much in rad the twist is not the angle between the directors of both clamps.
fn swing(step: f64, turns: f64, both: bool) -> [f64; 3] {
    let mut cable = swinging(step, turns, both);
    let account = |cable: &Cable| {
        let of_reels: f64 = cable.reels().map(|reel| reel.work + reel.remeshed).sum();
        let law = cable.energy_law();
        let lost = cable.effect_work().dissipated() + law.numerical + law.rescaled;
        cable.energy().total() + cable.energy_in_store() - of_reels + lost
    };
    let (start, angle) = (account(&cable), TAU * turns - carried(&cable));
    let (mut worst, mut moved, mut before) = (0.0f64, 0.0, 0.0);
    for frame in 0..240 {
        let rate = 0.7 * (3.0 * f64::from(frame) / 120.0).sin();
        cable.set_reel_rate(At::End, rate).unwrap();
        if both {
            cable.set_reel_rate(At::Start, -0.6 * rate).unwrap();
        }
        cable.step(1.0 / 120.0).unwrap();
        worst = worst.max((account(&cable) - start).abs());
        let work = cable.reel(At::End).unwrap().work;
        moved += (work - before).abs();
        before = work;
    }
    let reels: Vec<_> = cable.reels().collect();
    assert!(reels.iter().all(|reel| reel.splits > 1 && reel.merges > 1), "{reels:?}");
    let off = (cable.torsion()[0].twist - carried(&cable) - angle).rem_euclid(TAU);
    [worst, moved, off.min(TAU - off)]
}

/// The angle in rad from a director of the first node, carried along the slopes of all elements by
/// smallest rotations, to a fixed one at the last node, less the share of the determinants.
fn carried(cable: &Cable) -> f64 {
    let across = |d: &Vector3<f64>| d.cross(&Vector3::new(0.3, -0.2, 0.9)).normalize();
    let slope = |node: usize| Vector3::from_column_slice(&cable.positions()[6 * node + 3..6 * node + 6]);
    let place = |node: usize| Vector3::from_column_slice(&cable.positions()[6 * node..6 * node + 3]);
    let carry = |u: Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>| {
        UnitQuaternion::rotation_between(from, to).unwrap() * u
    };
    let (mut u, mut share) = (across(&slope(0)), 0.0);
    for (e, element) in cable.elements().iter().enumerate() {
        let (x, y) = (slope(e), slope(e + 1));
        let m = (place(e + 1) - place(e)) * (1.5 / element.length) - (x + y) * 0.25;
        let [x, m, y] = [x, m, y].map(|d| d.normalize());
        u = carry(carry(u, &x, &m), &m, &y);
        share += x.dot(&m.cross(&y)) / 6.0;
    }
    let last = slope(cable.nodes() - 1).normalize();
    let fixed = across(&last);
    u.cross(&fixed).dot(&last).atan2(u.dot(&fixed)) - share
}

/// The account of energy of a rope that swings while it is paid out and taken in closes with twist
/// as without it: what it misses is of the inertia of what flows, a tenth of what the twist does on
/// the lengths. Over splits and merges the twist stays the angle between the directors of both
/// clamps, modulo a full turn.
///
/// *Source.* Conservation of energy; directors carried by smallest rotations.
#[test]
fn reels_keep_energy_and_twist_of_a_swinging_rope() {
    for both in [false, true] {
        let [plain, twisted] = [0.0, 1.5].map(|turns| swing(1.0 / 960.0, turns, both));
        println!("{both}: {twisted:?}, without twist {plain:?}");
        assert!(plain[2] < 1e-11 && twisted[2] < 1e-11, "{twisted:?} {plain:?}");
        assert!(twisted[0] < 2.0 * plain[0] && plain[0] < 5e-3 * plain[1], "{twisted:?} {plain:?}");
    }
}

/// A run with reels goes on bitwise from its snapshot.
///
/// *Source.* The contract.
#[test]
fn a_twisted_rope_with_a_reel_goes_on_from_its_snapshot() {
    let mut cable = swinging(1.0 / 240.0, 1.5, true);
    let advance = |cable: &mut Cable| {
        cable.set_reel_rate(At::End, 0.7).unwrap();
        cable.set_reel_rate(At::Start, -0.4).unwrap();
        (0..40).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    };
    advance(&mut cable);
    let snapshot = cable.snapshot().clone();
    advance(&mut cable);
    let mut other = swinging(1.0 / 240.0, 1.5, true);
    other.restore(snapshot).unwrap();
    advance(&mut other);
    assert_eq!(cable.positions(), other.positions());
    assert_eq!(cable.torsion(), other.torsion());
}
