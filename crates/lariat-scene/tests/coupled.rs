//! Runs to a given error with contact, clutches, brakes, drums and sheaves: the true error is at
//! most the claimed one, or nothing is claimed from a horizon on.
//!
//! *Source.* The same scene with four times as many elements in an eighth of the host step, or half
//! of that of the claimed run.

use lariat_ancf::study::{Claim, Outcome, Resolution};
use lariat_scene::run::{Options, Recording, collect};
use lariat_scene::{Purpose, Scene};
use std::fs;
use std::path::{Path, PathBuf};

/// Least number of parts of a host step in the reference.
const PARTS: u32 = 8;

/// The scenes beside this file, by their names, with the error in m that their first line asks for.
fn scenes() -> Vec<(f64, Scene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/coupled");
    let mut files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let read = |file: &PathBuf| {
        let text = fs::read_to_string(file).unwrap();
        let asked = text.split("Asked for: ").nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap();
        (asked, Scene::read(file, &[], Purpose::Run).unwrap())
    };
    files.iter().map(read).collect()
}

/// Returns the scene as the reference has it.
fn finer(scene: &Scene, claim: &Claim) -> Scene {
    let mut finer = scene.clone();
    let parts = PARTS.max(2 * claim.parts);
    let share = f64::from(claim.parts) / f64::from(parts);
    let tolerance = claim.tolerance_m.map(|tolerance| tolerance * share.powi(3));
    let resolution = Resolution { elements: 4 * claim.elements, tolerance, parts, coupled: true, ..Default::default() };
    let largest = scene.cables.iter().map(|cable| cable.elements).max().unwrap();
    for cable in &mut finer.cables {
        cable.elements = resolution.elements_of(cable.elements, largest);
        cable.integrator = resolution.integrator().into();
    }
    finer.probes.iter_mut().for_each(|probe| probe.every = Some(scene.dt));
    finer.dt /= f64::from(parts);
    finer
}

/// Largest distance in m of all points and bodies before a time in s.
fn apart(a: &Recording, b: &Recording, before: f64) -> f64 {
    let mut largest: f64 = 0.0;
    for (a, b) in a.probes.iter().zip(&b.probes) {
        assert_eq!(a.rows.len(), b.rows.len());
        let rows = |probe: &'_ lariat_scene::run::ProbeRecord| probe.columns.len();
        for (a, b) in a.rows.chunks_exact(rows(a)).zip(b.rows.chunks_exact(rows(b))) {
            assert!((a[0] - b[0]).abs() < 1e-9);
            if a[0] < before - 1e-9 {
                largest = largest.max((1..4).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt());
            }
        }
    }
    largest
}

#[test]
fn what_is_claimed_holds_against_finer_runs() {
    let (mut proven, mut count) = (0, 0);
    for (asked, scene) in scenes() {
        let run =
            collect(&scene, Purpose::Run, &mut Options { error: Some(asked.into()), ..Options::default() }).unwrap();
        let claim = &run.summary.error.as_ref().unwrap().claim;
        let reference = collect(&finer(&scene, claim), Purpose::Run, &mut Options::default()).unwrap();
        assert!(run.failed.is_none() && reference.failed.is_none(), "{}", scene.name);
        let off = apart(&run, &reference, claim.horizon_s.unwrap_or(f64::INFINITY));
        println!("{}: asked {asked:.0e}, off {off:.1e}, {claim:?}", scene.name);
        assert!(off <= claim.claimed_m.unwrap_or(asked), "{}: off {off:.2e} m, {claim:?}", scene.name);
        assert!(claim.parts > 1 && (claim.outcome == Outcome::Proven) != claim.horizon_s.is_some());
        proven += usize::from(claim.outcome == Outcome::Proven);
        count += 1;
    }
    // a study that proves nothing would pass, too
    assert!(count >= 10 && 2 * proven > count, "{proven} of {count}");
}

/// What is on disk has the rows of the host steps that the scene asks for, however many the runs
/// took.
#[test]
fn samples_are_those_of_the_host_steps_of_the_scene() {
    let (asked, scene) = scenes().into_iter().find(|(_, scene)| scene.name == "motor_of_bounded_force").unwrap();
    let run = collect(&scene, Purpose::Run, &mut Options { error: Some(asked.into()), ..Options::default() }).unwrap();
    let plain = collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
    assert!(run.summary.error.as_ref().unwrap().claim.parts > 1);
    for (a, b) in run.probes.iter().zip(&plain.probes) {
        let times = |probe: &lariat_scene::run::ProbeRecord| -> Vec<f64> {
            probe.rows.chunks_exact(probe.columns.len()).map(|row| row[0]).collect()
        };
        assert_eq!(times(a), times(b));
    }
}
