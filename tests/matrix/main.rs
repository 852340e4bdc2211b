//! Every pair of features works, is refused for a reason of physics, or is a known miss: the pairs
//! are those of `lariat matrix`, in `crates/lariat-bench/src/matrix`.
//!
//! `cargo test` runs a selection; with the environment variable `LARIAT_LONG_TESTS=1` it runs every
//! pair.
//!
//! # References
//! Conservation of energy and momentum; the same scene at dt/8; the same run with and without a
//! saved state; the same features far apart; a world that may not sleep.

use lariat_bench::matrix::draft::Draft;
use lariat_bench::matrix::feature::{Feature, Pair};
use lariat_bench::matrix::laws::{DURATION, Plan, STEP, built, finish, together};
use lariat_bench::matrix::misses::{Miss, differences, of};
use lariat_bench::matrix::reasons::reason;
use lariat_bench::matrix::run::{Outcome, Row, judged, run};
use lariat_bench::misses::read;
use lariat_bench::stability::outcome::Check;
use lariat_bench::stability::recipe::Recipe;
use lariat_rapier::lariat_ancf::{AxialLaw, EffectWork, Fidelity, island};
use std::collections::BTreeSet;

/// Pairs of the quick selection: each this many.
const EVERY: usize = 8;

fn known() -> Vec<Miss> {
    read(include_str!("../../crates/lariat-bench/matrix_misses.csv")).expect("a file of misses")
}

fn long() -> bool {
    std::env::var_os("LARIAT_LONG_TESTS").is_some_and(|value| value == "1")
}

/// Returns the pairs that are run: all in the long run, else every eighth, and a different one in
/// each row of the matrix.
fn selected() -> Vec<Pair> {
    let all = Pair::all();
    if long() {
        return all;
    }
    // a step that has no factor with the length of a row
    all.into_iter().enumerate().filter(|(k, _)| (k * 7).is_multiple_of(EVERY)).map(|(_, pair)| pair).collect()
}

#[test]
fn pairs_of_features_keep_the_laws() {
    let pairs = selected();
    let rows: Vec<Row> = pairs.iter().map(|pair| run(*pair)).collect();
    let differences = differences(&rows, &known());
    assert!(differences.is_empty(), "{} pairs:\n{}", rows.len(), differences.join("\n"));
    let right = rows.iter().filter(|row| row.outcome == Outcome::Right).count();
    println!("{right} of {} pairs are right", rows.len());
    // a matrix in which hardly anything runs would be true, too
    assert!(2 * right > rows.len(), "{right} of {}", rows.len());
}

/// Runs of all host steps end at the same time, so that positions can be compared.
///
/// Reference: the time at which they are to end.
#[test]
fn runs_of_finer_steps_end_at_the_same_time() {
    for parts in [1.0, 2.0, 3.0, 4.0, 8.0, 64.0] {
        let draft = Draft::of(&[Feature::Held, Feature::FixedBody], false);
        let mut scene = built(&draft, Plan::default(), STEP / parts).expect("a scene");
        finish(&mut scene).expect("a run");
        // host steps are single precision
        assert!((scene.time - DURATION).abs() < 1e-6, "{parts} parts end at {} s", scene.time);
    }
}

/// Each effect, term, axial law and fidelity of the code is that of a feature: a new one is in the
/// matrix, or this fails.
///
/// Reference: the lists of the code.
#[test]
fn what_the_code_lists_is_in_the_matrix() {
    let effects: BTreeSet<_> = Feature::ALL.into_iter().filter_map(Feature::effect).collect();
    let listed: BTreeSet<_> = EffectWork::default().by_key().map(|(key, _)| key).collect();
    assert_eq!(effects, listed);
    let terms: BTreeSet<_> = Feature::ALL.into_iter().map(Feature::term).collect();
    assert_eq!(terms, island::terms().into_iter().collect());
    // exhaustive, so that a new law does not compile until it has a feature
    for law in [AxialLaw::Green, AxialLaw::Hooke, AxialLaw::Rope, AxialLaw::Curve(Vec::new())] {
        let feature = match law {
            // what all scenes of the matrix have
            AxialLaw::Green => continue,
            AxialLaw::Hooke => Feature::HookeLaw,
            AxialLaw::Rope => Feature::RopeLaw,
            AxialLaw::Curve(_) => Feature::CurveLaw,
        };
        assert_eq!(feature.effect(), Some("axial_law"));
    }
    // the reference is the engineering of a tighter tolerance
    let fidelities = Fidelity::ALL.map(Fidelity::name);
    assert!(fidelities.contains(&Feature::Game.name()) && fidelities.contains(&Feature::Engineering.name()));
    assert_eq!(fidelities.len(), 3);
}

/// The list has each feature once, under its own name, and each pair once.
#[test]
fn every_pair_is_in_the_list_once() {
    let names: BTreeSet<_> = Feature::ALL.into_iter().map(Feature::name).collect();
    assert_eq!(names.len(), Feature::ALL.len());
    assert!(Feature::ALL.into_iter().all(|feature| feature.name().parse() == Ok(feature)));
    let pairs: BTreeSet<_> = Pair::all().into_iter().collect();
    assert_eq!(pairs.len(), Feature::ALL.len() * (Feature::ALL.len() - 1) / 2);
}

/// A new miss, one that grew and one that is mended are reported, and nothing else.
#[test]
fn misses_that_differ_from_the_list_are_reported() {
    let pair = Pair(Feature::Held, Feature::Cut);
    let row = |value: f64| {
        let check = Check::at_most("energy made", value, 0.01, "the contract");
        let outcome = if check.holds() { Outcome::Right } else { Outcome::Wrong(vec![check.clone()]) };
        Row { pair, outcome, checks: vec![check] }
    };
    let changes = |before: &Row, now: &Row| differences(std::slice::from_ref(now), &of(before));
    assert!(changes(&row(0.02), &row(0.02)).is_empty());
    assert!(changes(&row(0.001), &row(0.002)).is_empty());
    assert!(changes(&row(0.02), &row(0.05)).iter().any(|line| line.ends_with("worse")));
    assert!(changes(&row(0.02), &row(f64::NAN)).iter().any(|line| line.ends_with("worse")));
    assert!(changes(&row(0.001), &row(0.02)).iter().any(|line| line.contains("a new miss")));
    assert!(changes(&row(0.02), &row(0.001)).iter().any(|line| line.contains("mended")));
}

/// Triples of the long run that are known to miss a law, as pairs are. Statics refuse the coil over a
/// wheel, whose elements fold.
const MISSED: [&str; 1] = ["contact with itself + sheave + statics"];

/// Triples at random of features whose pairs are all right keep the laws of the pairs.
///
/// *Source.* The laws of the pairs.
#[test]
fn triples_of_features_keep_the_laws() {
    let missed: BTreeSet<String> = known().into_iter().map(|miss| miss.pair).collect();
    let excluded = |pair: Pair| missed.contains(&pair.to_string()) || reason(pair).is_some();
    let apart = |feature: &Feature| matches!(feature, Feature::Sleep | Feature::ErrorTarget);
    let features: Vec<Feature> = Feature::ALL.into_iter().filter(|feature| !apart(feature)).collect();
    let (wanted, mut faults, mut triples) = (if long() { 300 } else { 30 }, Vec::new(), BTreeSet::new());
    for seed in 0.. {
        if triples.len() == wanted {
            break;
        }
        let drawn = Recipe::from_seed(seed);
        let mut three = [0, 1, 2].map(|k| features[drawn.choose(k, features.len())]);
        three.sort_unstable();
        let [a, b, c] = three;
        if a == b || b == c || [Pair(a, b), Pair(a, c), Pair(b, c)].into_iter().any(excluded) || !triples.insert(three)
        {
            continue;
        }
        let name = three.map(Feature::name).join(" + ");
        match together(&three, Plan { statics: three.contains(&Feature::Statics) }) {
            Ok(checks) => {
                if let Outcome::Wrong(failed) = judged(&checks) {
                    faults.extend(failed.iter().map(|check| format!("{name}: {check}")));
                }
            }
            Err(ended) => faults.push(format!("{name}: {ended:?}")),
        }
    }
    let (known, new): (Vec<&String>, Vec<&String>) =
        faults.iter().partition(|fault| MISSED.iter().any(|name| fault.starts_with(&format!("{name}: "))));
    assert!(new.is_empty(), "{} of {wanted} triples:\n{new:#?}", new.len());
    assert!(!long() || known.len() == MISSED.len(), "mended: {known:#?} are left of {MISSED:#?}");
}
