//! The entry functions of `fuzz` over its corpus, and over seeded mutations of it: nothing panics, hangs or takes memory without bound.
//!
//! The mutations of a test are fixed. `LARIAT_SEEDS=1000..9000` runs others. An input that fails is written beside the corpus.

mod mutate;
mod targets;

#[allow(dead_code, reason = "bytes alone are counted here")]
#[path = "../../../lariat-ancf/tests/counting/mod.rs"]
mod counting;

use counting::{HELD, MOST};
use cpu_time::ThreadTime;
use mutate::Random;
use std::ops::Range;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Most memory in bytes that an input of some kB may take: a cable of the million elements that a scene may have (`run/size.rs`) takes 0.8 GB
/// where it is drawn and checked.
const BYTES: i64 = 1 << 30;
/// Longest CPU time of an input: a step that fails at all 64 parts of its length takes some seconds.
const TIME: Duration = Duration::from_secs(20);

fn folder(target: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target)
}

/// Returns the corpus of a target, by name.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let files = std::fs::read_dir(folder(target)).unwrap();
    let mut paths: Vec<_> = files.map(|file| file.unwrap().path()).collect();
    paths.sort();
    assert!(!paths.is_empty());
    paths.iter().map(|path| std::fs::read(path).unwrap()).collect()
}

/// Returns what is wrong with an input, if anything.
fn fault(run: fn(&[u8]), data: &[u8]) -> Option<String> {
    let (begin, held) = (ThreadTime::now(), HELD.get());
    MOST.set(held);
    let panicked = catch_unwind(|| run(data)).is_err();
    let (time, bytes) = (begin.elapsed(), MOST.get() - held);
    match () {
        _ if panicked => Some("it panicked".to_string()),
        _ if time > TIME => Some(format!("it took {time:?}")),
        _ if bytes > BYTES => Some(format!("it took {bytes} bytes")),
        _ => None,
    }
}

/// Runs a target over its corpus and over the mutations of seeds.
fn hold(target: &str, run: fn(&[u8]), of_test: Range<u64>) {
    let corpus = corpus(target);
    let asked = std::env::var("LARIAT_SEEDS").ok();
    let seeds = asked.as_deref().and_then(|range| range.split_once(".."));
    let seeds = seeds.map_or(of_test, |(from, to)| from.parse().unwrap()..to.parse().unwrap());
    let mutated = seeds.map(|seed| (Some(seed), Random::new(seed).mutated(&corpus)));
    let mut faults = Vec::new();
    for (seed, data) in corpus.iter().map(|data| (None, data.clone())).chain(mutated) {
        if let Some(fault) = fault(run, &data) {
            let name = seed.map_or("corpus".to_string(), |seed| seed.to_string());
            let path = std::env::temp_dir().join(format!("lariat-fuzz-{target}-{name}"));
            std::fs::write(&path, &data).unwrap();
            faults.push(format!("{target}, seed {name}: {fault}: {}", path.display()));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn scenes_of_any_bytes_are_parsed_or_refused() {
    hold("scene", targets::scene, 0..1500);
}

#[test]
fn models_of_any_bytes_are_imported_or_refused() {
    hold("mjcf", targets::mjcf, 0..3000);
}

#[test]
fn meshes_of_any_bytes_are_read_or_refused() {
    hold("mesh", targets::mesh, 0..1500);
}

#[test]
fn saved_cables_of_any_bytes_are_read_or_refused() {
    hold("snapshot", targets::snapshot, 0..3000);
}

/// Writes the corpus of saved cables anew, after their form has changed: a plain one, one with effects and contact, and one with a reel.
#[test]
#[ignore = "writes into the repository"]
fn write_the_corpus_of_saved_cables() {
    use lariat_ancf::{At, Cable, Contact, Damping, Fidelity, Reel, Section, Vector3};
    let section = Section::from_stiffness(1e4, 0.01, 0.1).unwrap();
    let rope = || Cable::builder().points([Vector3::zeros(), Vector3::x()]).section(section).elements(2);
    let game = || rope().fidelity(Fidelity::Game).fix(At::Start);
    let contact = Contact { radius: Some(0.01), ..Contact::default() };
    let mut reeled = game().build().unwrap();
    reeled.add_reel(At::Start, Reel::with_rate(0.1)).unwrap();
    let effects = lariat_ancf::Effects { contact: Some(contact), ..Default::default() };
    let damped = game().effects(effects).damping(Damping { axial: 1e-3, bending: 1e-3 }).length(1.1);
    let plain = rope().fix(At::Start).build().unwrap();
    let cables = [("plain", plain), ("damped", damped.build().unwrap()), ("reel", reeled)];
    for (name, mut cable) in cables {
        cable.step(0.01).unwrap();
        std::fs::write(folder("snapshot").join(name).with_extension("json"), serde_json::to_vec(&cable).unwrap())
            .unwrap();
    }
}

/// The harness finds what it looks for.
#[test]
fn faults_are_found() {
    assert_eq!(fault(|_| {}, b""), None);
    assert!(fault(|_| drop(vec![1u8; BYTES as usize + 1]), b"").is_some_and(|fault| fault.contains("bytes")));
    assert!(fault(|data| assert!(data.is_empty()), b"x").is_some_and(|fault| fault.contains("panicked")));
    let corpus = vec![b"points = [[0.0, 1.0, 2.0]]".to_vec(), b"elements = 8".to_vec()];
    let made: Vec<_> = (0..50).map(|seed| Random::new(seed).mutated(&corpus)).collect();
    assert!(made.iter().filter(|data| !corpus.contains(data)).count() > 40);
}
