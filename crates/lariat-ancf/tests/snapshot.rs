//! The state is plain data: a run continued from a snapshot is bitwise the same, and so are those
//! of two equal cables.

mod common;

use common::soft_cable;
use lariat_ancf::coupling::Linearisation;
use lariat_ancf::{
    At, Cable, Error, Integrator, Method, Motion, PointLoad, SlopeSupport, StepControl, Support, Vector3,
};

/// A cable with everything that a state must represent: a moving support, a clamp's direction, a
/// load that ramps up.
fn busy(method: Method, control: StepControl) -> Option<Cable> {
    let integrator = Integrator { method, control };
    integrator.checked().ok()?;
    let mut cable = soft_cable()
        .fix(At::Start)
        .integrator(integrator)
        .load(PointLoad { ramp: 0.3, ..PointLoad::force(0.4, Vector3::new(0.0, 1.0, 2.0)) })
        .load(PointLoad { ramp: 0.1, ..PointLoad::moment(1.0, Vector3::new(0.0, 0.02, 0.01)) })
        .build()
        .unwrap();
    let motion = Motion::uniform(0.0, Vector3::zeros(), Vector3::new(0.1, 0.3, 0.0));
    let slope = SlopeSupport::Direction(Vector3::new(0.6, 0.8, 0.0));
    cable.set_support(At::Start, Support { position: Some(motion), slope, ..Support::default() }).unwrap();
    Some(cable)
}

/// Every method with fixed steps, and with a tolerance where it has an estimate.
fn cases() -> impl Iterator<Item = (Method, StepControl)> {
    Method::ALL.into_iter().flat_map(|m| [StepControl::Substeps(20), StepControl::Tolerance(1e-5)].map(|c| (m, c)))
}

fn run(cable: &mut Cable, steps: usize) {
    for i in 0..steps {
        cable.step(if i % 3 == 2 { 1.0 / 120.0 } else { 1.0 / 60.0 }).unwrap();
    }
}

fn bits(cable: &Cable) -> Vec<u64> {
    let numbers = cable.positions().iter().chain(cable.velocities());
    numbers.map(|x| x.to_bits()).chain([cable.time().to_bits()]).collect()
}

/// A state restored to a cable that has moved on, or to another one, continues bitwise as the
/// uninterrupted run.
///
/// *Source.* Bitwise equality of the two runs. It guards against memory of a method (accelerations,
/// the proposed step) that lives outside the state.
#[test]
fn a_restored_state_continues_bitwise_the_same_run() {
    for (method, control) in cases() {
        let Some(mut cable) = busy(method, control) else { continue };
        run(&mut cable, 10);
        let snapshot = cable.snapshot().clone();
        run(&mut cable, 10);
        let expected = bits(&cable);
        run(&mut cable, 7);
        cable.restore(snapshot.clone()).unwrap();
        run(&mut cable, 10);
        assert_eq!(bits(&cable), expected, "{method}, {control:?}: the same cable");
        let mut other = busy(method, control).unwrap();
        run(&mut other, 3);
        other.restore(snapshot).unwrap();
        run(&mut other, 10);
        assert_eq!(bits(&other), expected, "{method}, {control:?}: another cable");
    }
}

/// A cable written to JSON and read back continues bitwise the same run, counts included.
///
/// *Source.* Bitwise equality; serde_json prints the shortest decimal that reads back to the same
/// number.
#[test]
fn a_cable_read_back_from_json_continues_bitwise_the_same_run() {
    for (method, control) in cases() {
        let Some(mut cable) = busy(method, control) else { continue };
        run(&mut cable, 10);
        let text = serde_json::to_string(&cable).unwrap();
        let mut copy: Cable = serde_json::from_str(&text).unwrap();
        assert_eq!(bits(&copy), bits(&cable), "{method}, {control:?}: as read");
        assert_eq!(copy.integrator(), cable.integrator());
        assert_eq!(copy.rule(), cable.rule());
        run(&mut cable, 10);
        run(&mut copy, 10);
        assert_eq!(bits(&copy), bits(&cable), "{method}, {control:?}: continued");
        assert_eq!(copy.diagnostics(), cable.diagnostics(), "{method}, {control:?}");
    }
}

/// Two equal cables, and a clone, give bitwise the same run.
///
/// *Source.* Bitwise equality: no hash map, no clock, no shared state.
#[test]
fn equal_cables_give_the_same_bits() {
    for (method, control) in cases() {
        let (Some(mut a), Some(mut b)) = (busy(method, control), busy(method, control)) else { continue };
        run(&mut a, 6);
        run(&mut b, 6);
        let mut clone = a.clone();
        run(&mut a, 12);
        run(&mut b, 12);
        assert_eq!(bits(&a), bits(&b), "{method}, {control:?}");
        assert_eq!(a.diagnostics(), b.diagnostics(), "{method}, {control:?}");
        run(&mut clone, 12);
        assert_eq!(bits(&a), bits(&clone), "{method}, {control:?}: clone");
    }
}

/// Reading reactions and energies does not change the run.
///
/// *Source.* Bitwise equality with a run that is not read. It guards against reactions that are
/// read before a new support has put its node in place marking the accelerations as known, so that
/// the next step began from the old place.
#[test]
fn reading_reactions_and_energies_does_not_change_the_run() {
    for (method, control) in cases() {
        let (Some(mut a), Some(mut b)) = (busy(method, control), busy(method, control)) else { continue };
        for _ in 0..10 {
            let _ = (a.reactions().unwrap(), a.energy(), a.momentum(), a.sample(0.3).unwrap(), a.force());
            a.step(1.0 / 60.0).unwrap();
            b.step(1.0 / 60.0).unwrap();
        }
        assert_eq!(bits(&a), bits(&b), "{method}, {control:?}");
    }
}

/// A state of another mesh, and JSON whose state does not fit its elements, are errors.
///
/// *Source.* The contract: no panic on user input.
#[test]
fn a_state_of_another_mesh_is_an_error() {
    let mut cable = soft_cable().build().unwrap();
    let other = soft_cable().elements(7).build().unwrap();
    let error = cable.restore(other.snapshot().clone()).unwrap_err();
    let (count, expected) = (other.positions().len(), cable.positions().len());
    assert_eq!(error, Error::WrongCount { cable: cable.name().to_string(), what: "positions", count, expected });
    let mut json = serde_json::to_value(&cable).unwrap();
    json["snapshot"] = serde_json::to_value(other.snapshot()).unwrap();
    assert!(serde_json::from_value::<Cable>(json).is_err());
}

/// A saved cable whose reel numbers elements that neither its mesh nor its stock has is refused, where it panicked.
#[test]
fn reels_without_their_elements_are_refused() {
    let mut cable = soft_cable().fix(At::Start).fidelity(lariat_ancf::Fidelity::Game).build().unwrap();
    cable.add_reel(At::Start, lariat_ancf::Reel::with_rate(0.1)).unwrap();
    let text = serde_json::to_string(&cable).unwrap();
    assert!(serde_json::from_str::<Cable>(&text).is_ok() && text.contains("\"origin\":0"));
    for origin in ["1", "999999999999", "9223372036854775807"] {
        let damaged = text.replace("\"origin\":0", &format!("\"origin\":{origin}"));
        let error = serde_json::from_str::<Cable>(&damaged).unwrap_err().to_string();
        assert!(error.contains("beside a reel"), "{origin}: {error}");
    }
}
