//! Contact of cables with reels: on all elements but the one at the eye.

use super::common::G;
use lariat_ancf::contact::{Cylinder, HalfSpace, Obstacle};
use lariat_ancf::coupling::Coupling;
use lariat_ancf::{At, Cable, Contact, Damping, Effects, Integrator, Method, Reel, Section, StepControl, Vector3};
use nalgebra::UnitQuaternion;

const WEIGHT: f64 = 0.3;
const RADIUS: f64 = 0.01;

fn game(h: f64) -> Integrator {
    Integrator { method: Method::DiscreteGradient, control: StepControl::MaxStep(h) }
}

fn rope(points: &[Vector3<f64>], elements: usize, friction: f64) -> Cable {
    let contact = Some(Contact::with_friction(friction).with_radius(RADIUS));
    let damping = Some(Damping { axial: 2e-3, bending: 2e-2 });
    Cable::builder()
        .points(points.iter().copied())
        .section(Section::from_stiffness(2e4, 0.01, WEIGHT).unwrap())
        .elements(elements)
        .effects(Effects { contact, damping, ..Effects::default() })
        .integrator(game(1.0 / 240.0))
        .build()
        .unwrap()
}

fn floor(friction: f64) -> Obstacle {
    Obstacle::new(1, HalfSpace { normal: Vector3::y() }, Vector3::zeros(), friction)
}

/// Rope that is paid out onto the ground lies there with all of its weight but what the eye bears, and nothing makes energy, with the reel at
/// either end.
///
/// *Source.* Statics: the sum of contact forces and of the vertical tension at the eye is the weight; the energy law.
#[test]
fn rope_that_is_paid_out_lies_on_the_ground() {
    for at in [At::Start, At::End] {
        let (top, low) = (Vector3::new(0.0, 1.0, 0.0), Vector3::new(0.2, 0.2, 0.0));
        let points = if at == At::Start { [top, low] } else { [low, top] };
        let mut cable = rope(&points, 16, 0.5);
        cable.fix(at).unwrap();
        cable.set_obstacles([floor(0.5)]).unwrap();
        cable.add_reel(at, Reel { rate: vec![[0.0, 0.5], [3.0, 0.0]], ..Reel::default() }).unwrap();
        let (mut deep, mut most, mut held, mut pull) = (0.0f64, 0.0f64, 0.0, 0.0);
        for step in 0..600 {
            cable.step(1.0 / 60.0).unwrap();
            // what hangs swings a little: means over two seconds
            if step >= 480 {
                held += cable.contacts().map(|t| t.normal_force * t.normal.y + t.friction.y).sum::<f64>() / 120.0;
                let slope = cable.sample(cable.arc_length(at).unwrap()).unwrap().slope.normalize();
                pull += cable.reel(at).unwrap().tension * slope.y.abs() / 120.0;
            }
            deep = cable.contacts().fold(deep, |deep, touch| deep.max(touch.depth));
            let energy = cable.energy();
            most = most.max(energy.kinetic + energy.gravity.abs());
        }
        let weight = WEIGHT * G * cable.length();
        let made = cable.energy_law().made;
        println!(
            "{at:?}: {:.4} m, {held:.4} + {pull:.4} of {weight:.4} N, {:.2} radii deep, made {made:.1e} J",
            cable.length(),
            deep / RADIUS
        );
        assert!((cable.length() - 2.3246).abs() < 0.02 && cable.reel(at).unwrap().splits > 10);
        assert!((held + pull - weight).abs() < 2e-3 * weight && held > 0.5 * weight);
        assert!(deep < 0.5 * RADIUS && made <= 1e-9 * most);
    }
}

/// A rope that lies on the ground and is reeled in over it is pulled with the friction of what still lies there.
///
/// *Source.* Coulomb: mu times the weight on the ground, at a speed that hardly accelerates it.
#[test]
fn rope_that_is_reeled_in_drags_over_the_ground() {
    let friction = 0.4;
    let points = [Vector3::new(0.0, RADIUS, 0.0), Vector3::new(3.0, RADIUS, 0.0)];
    let mut cable = rope(&points, 24, friction);
    cable.fix(At::End).unwrap();
    cable.set_obstacles([floor(friction)]).unwrap();
    cable.add_reel(At::End, Reel { rate: vec![[0.0, -0.2]], acceleration: 0.5, ..Reel::default() }).unwrap();
    let (mut sum, mut count) = (0.0, 0.0);
    for step in 0..480 {
        cable.step(1.0 / 60.0).unwrap();
        if step >= 60 {
            // the element at the eye touches nothing, and lies on its inner node with half of its weight
            let eye = cable.elements()[cable.elements().len() - 1].length;
            let pull = cable.reel(At::End).unwrap().force;
            sum += pull.abs() / (friction * WEIGHT * G * (cable.length() - 0.5 * eye));
            count += 1.0;
        }
    }
    let merges = cable.reel(At::End).unwrap().merges;
    println!("{:.4} of the friction, {merges} merged", sum / count);
    assert!((sum / count - 1.0).abs() < 0.015 && merges > 5);
}

/// A reel that does nothing changes nothing of a contact on other elements but what iterations leave.
///
/// *Source.* The cable without reel.
#[test]
fn neither_sees_the_other_where_they_do_not_meet() {
    let points = [Vector3::new(0.0, 1.0, 0.0), Vector3::new(1.6, 1.0, 0.3)];
    let post = || {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
        let mut post = Obstacle::new(7, Cylinder { half_height: 1.0, radius: 0.1 }, [0.9, 0.55, 0.0], 0.3);
        post.motion.rotation = turn;
        post
    };
    let run = |reel: bool, obstacle: bool| {
        let mut cable = rope(&points, 12, 0.3);
        cable.fix(At::Start).unwrap();
        cable.set_obstacles(obstacle.then(post)).unwrap();
        if reel {
            cable.add_reel(At::Start, Reel::default()).unwrap();
        }
        (0..60).for_each(|_| cable.step(1.0 / 60.0).unwrap());
        cable
    };
    let apart =
        |a: &Cable, b: &Cable| a.positions().iter().zip(b.positions()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let (with, without) = (run(true, true), run(false, true));
    assert!(with.contacts().count() > 0);
    let free = run(true, false);
    println!("{:.1e} with it, {:.1e} without contact", apart(&with, &without), apart(&with, &free));
    assert!(apart(&with, &without) < 0.01 * apart(&with, &free));
}

/// A run with contact and a reel goes on from its snapshot, and from its description, to the bit, across splits and merges; contacts keep their
/// friction and energy where elements come and go at the start.
///
/// *Source.* Bitwise equality; contacts do not lose energy by a renumbering.
#[test]
fn it_is_saved_and_contacts_stay_across_splits() {
    let points = [Vector3::new(0.0, 0.6, 0.0), Vector3::new(0.0, RADIUS, 0.0), Vector3::new(2.0, RADIUS, 0.0)];
    let mut cable = rope(&points, 20, 0.6);
    cable.fix(At::Start).unwrap();
    cable.set_obstacles([floor(0.6)]).unwrap();
    (0..120).for_each(|_| cable.step(1.0 / 60.0).unwrap());
    let rate = vec![[0.0, 0.4], [4.0, -0.4]];
    cable.add_reel(At::Start, Reel { rate, ..Reel::default() }).unwrap();
    let run = |cable: &mut Cable, steps: usize| {
        for _ in 0..steps {
            cable.set_obstacles([floor(0.6)]).unwrap();
            cable.step(1.0 / 60.0).unwrap();
        }
    };
    let bits =
        |cable: &Cable| cable.positions().iter().chain(cable.velocities()).map(|x| x.to_bits()).collect::<Vec<_>>();
    run(&mut cable, 100);
    let (snapshot, saved) = (cable.snapshot().clone(), serde_json::to_string(&cable).unwrap());
    let before = cable.contact_energy();
    assert!(cable.reel(At::Start).unwrap().splits > 3 && before > 0.0);
    run(&mut cable, 250);
    let expected = bits(&cable);
    assert!(cable.reel(At::Start).unwrap().merges > 0);
    cable.restore(snapshot).unwrap();
    assert_eq!(cable.contact_energy(), before);
    run(&mut cable, 250);
    assert_eq!(bits(&cable), expected);
    let mut read: Cable = serde_json::from_str(&saved).unwrap();
    run(&mut read, 250);
    assert_eq!(bits(&read), expected);
}

/// A winch that hauls a load over a round edge pulls with the friction of a quarter turn, with the reel at either end.
///
/// *Source.* Euler and Eytelwein: `T1 = T0 exp(mu phi)`, within 1 %, of which 0.3 % is the sag before the edge; the load with the rope that hangs, at a
/// steady speed.
#[test]
fn a_winch_hauls_a_load_over_an_edge_with_the_friction_of_a_capstan() {
    let (friction, radius, load) = (0.3, 0.1, 120.0);
    let around = radius + RADIUS;
    let bend = |angle: f64| Vector3::new(around * angle.sin(), around * angle.cos(), 0.0);
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut points = vec![Vector3::new(-1.5, around, 0.0)];
    points.extend((0..=6).map(|k| bend(f64::from(k) / 6.0 * quarter)));
    points.push(Vector3::new(around, -1.5, 0.0));
    for at in [At::Start, At::End] {
        if at == At::End {
            points.reverse();
        }
        let mut cable = rope(&points, 80, friction);
        cable.fix(at).unwrap();
        let far = if at == At::Start { cable.length() } else { 0.0 };
        cable.add_load(lariat_ancf::PointLoad::force(far, [0.0, -load, 0.0])).unwrap();
        let mut bar = Obstacle::new(7, Cylinder { half_height: 1.0, radius }, [0.0; 3], friction);
        bar.motion.rotation = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), quarter);
        cable.set_obstacles([bar]).unwrap();
        cable.add_reel(at, Reel { rate: vec![[0.0, 0.0], [0.5, -0.2]], ..Reel::default() }).unwrap();
        let (mut ratio, mut count) = (0.0, 0.0);
        for step in 0..240 {
            cable.step(1.0 / 60.0).unwrap();
            if step >= 120 {
                let tip = cable.node_position(if at == At::Start { cable.nodes() - 1 } else { 0 });
                ratio += cable.reel(at).unwrap().tension / (load - WEIGHT * G * tip.y);
                count += 1.0;
            }
        }
        let expected = (friction * quarter).exp();
        println!("{at:?}: {:.4} of {expected:.4}", ratio / count);
        assert!((ratio / count / expected - 1.0).abs() < 0.01 && cable.reel(at).unwrap().merges > 10);
    }
}
