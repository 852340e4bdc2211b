//! Structures of assets/scenes: a deck on stays, a suspension bridge, a slung load, a multibody arm, joints.

use super::results::{Results, asset};

const WEIGHT: f64 = 600.0 * 9.81;

/// The stays carry the deck in proportion to their stiffness against its sinking.
///
/// *Source.* Statics of a rigid deck that sinks level on elastic bars: `N = EA v sin(a)/L`, `v = W/sum(EA sin^2(a)/L)`, with the
/// geometry before the deck sinks (by 0.1 % of the length of a stay).
#[test]
fn the_stays_of_a_deck_carry_their_shares() {
    let results = Results::of("run", &asset("cable_stayed"), &[]).done();
    let stiffness = 1.5e6;
    let sine_and_length = |offset: f64| (4.0 / offset.hypot(4.0), offset.hypot(4.0));
    let offsets = [5.5, 3.5, 1.5];
    let total: f64 = offsets.iter().map(|&x| sine_and_length(x)).map(|(s, l)| 2.0 * stiffness * s * s / l).sum();
    let sinks = WEIGHT / total;
    let deck = results.last("deck");
    assert!(((0.9 - deck[2]) / sinks - 1.0).abs() < 5e-3, "{} m of {sinks}", 0.9 - deck[2]);
    let mut lift = 0.0;
    for (k, &offset) in offsets.iter().enumerate() {
        let (sine, length) = sine_and_length(offset);
        let expected = stiffness * sinks * sine / length;
        for side in ["left", "right"] {
            let row = results.last(&format!("{side}_{}", k + 1));
            let pull = row[1].hypot(row[2]);
            lift += row[2];
            assert!((pull / expected - 1.0).abs() < 5e-3, "{side} {}: {pull} N of {expected}", k + 1);
        }
    }
    assert!((lift / WEIGHT - 1.0).abs() < 1e-3, "{lift} N of {WEIGHT}");
    assert!(deck[1].abs() < 1e-6 && deck[6].abs() < 1e-6, "level: {deck:?}");
    assert!(results.summary().max_gap_m < 1e-6);
}

/// Horizontal tension times sag is the moment of the loads about the middle of the span.
///
/// *Source.* `H f = w L^2/8`, which for five equal loads in six equal spaces is `4.5 P d`; and the cable's own weight, spread along its
/// length of 12.47 m: `0.08 kg/m x g x 12.47 m x 12 m/8` (its steeper ends carry a little more of it: 0.01 %). The tower carries half of
/// the weight. C1 elements do not represent the kinks of a light cable at its clips: the tension is 0.35 % low with 24 elements.
#[test]
fn a_suspension_bridge_has_the_tension_of_the_parabola() {
    let results = Results::of("run", &asset("bridge"), &[]).done();
    let [tower, middle, hanger] = ["tower", "middle", "hanger"].map(|probe| {
        let late: Vec<_> = results.rows(probe).into_iter().filter(|row| row[0] > 3.0).collect();
        let mean = |i: usize| late.iter().map(|row| row[i]).sum::<f64>() / late.len() as f64;
        [mean(1), mean(2)]
    });
    let g = 9.81;
    let loads: f64 = [13.0 / 6.0, 5.0 / 3.0, 1.5, 5.0 / 3.0, 13.0 / 6.0].map(|l| g * (20.0 + 0.02 * l)).iter().sum();
    let cable = 0.08 * g * 12.47;
    let moment = 4.5 * (loads / 5.0) * 2.0 + cable * 12.0 / 8.0;
    let sag = 4.0 - middle[1];
    assert!((tower[0] * sag / moment - 1.0).abs() < 5e-3, "{} N x {sag} m of {moment} N m", tower[0]);
    assert!((sag - 1.5).abs() < 5e-3, "{sag} m");
    let share = 0.5 * (loads + cable);
    assert!((-tower[1] / share - 1.0).abs() < 1e-3, "{} N of {share}", -tower[1]);
    assert!((hanger[1] / (20.0 * g) - 1.0).abs() < 2e-3, "{} N", hanger[1]);
    assert!(results.summary().max_gap_m < 1e-5);
}

/// The load swings out and back once while the helicopter flies, and is at rest when it has stopped.
///
/// *Source.* The simple pendulum: amplitude `acos(1 - v^2/2gL)`, period `4 sqrt(L/g) K(sin(a/2))`, 6.4 s for L = 10.0617 m.
#[test]
fn a_slung_load_swings_once_and_comes_to_rest() {
    let results = Results::of("run", &asset("slung_load"), &[]).done();
    let (load, above) = (results.rows("load"), results.rows("helicopter"));
    let angles: Vec<(f64, f64)> =
        load.iter().zip(&above).map(|(l, h)| (l[0], (l[1] - h[1]).atan2(h[2] - l[2]).to_degrees())).collect();
    let amplitude = (1.0f64 - 9.0 / (2.0 * 9.81 * 10.06165)).acos().to_degrees();
    let most =
        |from: f64, to: f64| angles.iter().filter(|a| a.0 >= from && a.0 <= to).map(|a| a.1.abs()).fold(0.0, f64::max);
    assert!(most(0.0, 0.5) < 1e-3, "at rest before: {}", most(0.0, 0.5));
    for half in [(0.5, 3.7), (3.7, 6.9)] {
        let out = most(half.0, half.1);
        assert!((out / amplitude - 1.0).abs() < 5e-3, "{out} degrees of {amplitude}");
    }
    // 3 m/s within half a host step of the moment: g v/L dt/2 = 0.02 m/s of the 3 m/s would be left
    assert!(most(6.91, 10.0) < 0.1, "{} degrees are left", most(6.91, 10.0));
}

/// A tether supports the tip of a multibody arm with a force at its elbow; the tip stays at its height.
///
/// *Source.* Moments about the shoulder: `T x 1.5 m = 3 kg g x 0.75 m + 20 N x 0.5 m`.
#[test]
fn a_tether_holds_the_tip_of_a_multibody_arm() {
    let results = Results::of("run", &asset("tether_multibody"), &[]).done();
    let late: Vec<f64> = results.rows("tip").iter().filter(|row| row[0] > 4.0).map(|row| row[2]).collect();
    let pull = late.iter().sum::<f64>() / late.len() as f64;
    let expected = (3.0 * 9.81 * 0.75 + 20.0 * 0.5) / 1.5;
    assert!((pull / expected - 1.0).abs() < 2e-3, "{pull} N of {expected}");
    let hand = results.last("hand");
    assert!((hand[1] - 1.25).abs() < 1e-4 && hand[2].abs() < 1e-3, "{hand:?}");
    // the arm drops by 0.1 mm before the tether is taut: the same limit as for the arms of the coupling's own tests
    assert!(results.summary().max_gap_m < 1e-3 && results.last("tip")[7] < 1e-6, "{}", results.summary().max_gap_m);
}

/// A hinge rotates about its axis and keeps its point, a slider moves along its axis and does not rotate, a ball keeps its point, a
/// fixed joint moves with the other body: by impulse joints and in a multibody, from bodies that are rotated at the start.
///
/// *Source.* A physical pendulum released from horizontal: `v = sqrt(2 g h)` of the centre for a slider, `w = sqrt(2 m g h/I)` for a hinge,
/// from the energy at its position.
#[test]
fn joints_have_the_freedom_of_their_kind() {
    for multibody in [false, true] {
        let scene = |joint: &str| {
            format!(
                "duration = 0.3\ndt = 0.005\n[[body]]\nname = \"b\"\nshape = {{ ball = 0.1 }}\nmass = 2.0\nposition = [1.0, 0.0, 0.0]\n\
                 rotation = [0.0, 0.7, 0.2]\n[[joint]]\nbody = \"b\"\nto = \"world\"\nat = [0.0, 0.0, 0.0]\nmultibody = {multibody}\n{joint}\n\
                 [[cable]]\nname = \"c\"\npoints = [[50.0, 0.0, 0.0], [51.0, 0.0, 0.0]]\nsection = {{ round = 0.001 }}\ndensity = 1000.0\n\
                 youngs_modulus = 1e6\n[[probe]]\nname = \"b\"\nbody = \"b\"\n"
            )
        };
        let inertia = 2.0 + 0.4 * 2.0 * 0.01;
        for (joint, falls) in [
            ("kind = \"hinge\"\naxis = [0.0, 0.0, 2.0]", true),
            ("kind = \"ball\"", true),
            ("kind = \"slider\"\naxis = [0.0, -1.0, 0.0]", true),
            ("kind = \"hinge\"\naxis = [0.0, 1.0, 0.0]", false),
            ("kind = \"slider\"\naxis = [-1.0, 0.0, 0.0]", false),
            ("kind = \"fixed\"", false),
        ] {
            let results = Results::of_text("run", &scene(joint)).done();
            let (first, row) = (&results.rows("b")[0], results.last("b"));
            let case = format!("{joint}, multibody {multibody}: {row:?}");
            if !falls {
                assert!((1..8).all(|i| (row[i] - first[i]).abs() < 2e-3), "{case}");
            } else if joint.contains("slider") {
                assert!((row[1] - 1.0).abs() < 1e-3 && (row[9] / -(9.81 * 0.3) - 1.0).abs() < 1e-2, "{case}");
            } else {
                assert!((row[1].hypot(row[2]) - 1.0).abs() < 2e-3 && row[3].abs() < 1e-3, "{case}");
                let spin = (2.0 * 2.0 * 9.81 * -row[2] / inertia).sqrt();
                assert!((row[13] / -spin - 1.0).abs() < 2e-2, "{case}, {spin} rad/s");
            }
        }
    }
}
