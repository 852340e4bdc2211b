//! Thrown cables: no step is refused, and no energy is made.

use crate::chain::Chain;
use crate::law::{energies, work};
use crate::recipe::{disturb, scene};
use lariat_ancf::{AxialLaw, Effects, Method, Rule};
use std::time::Instant;

/// What a run of many scenes did.
#[derive(Debug, Default)]
pub struct Tally {
    pub scenes: u64,
    pub refused: Vec<(u64, String)>,
    /// Most by which the energy law was broken in a host step, as a share of the largest kinetic and strain energy.
    pub broken: f64,
    /// Most by which the mechanical energy rose.
    pub rise: f64,
    pub host_steps: u64,
    pub steps: u64,
    pub iterations: u64,
    pub rescaled: u64,
    pub split: u64,
    pub indefinite: u64,
    pub worst_host_step: u64,
    /// Time in s of the slowest host step, which is told alone.
    pub slowest: f64,
}

/// Runs scenes by host steps of 1/60 s for 0.6 s.
pub fn run(seeds: std::ops::Range<u64>, rule: Rule, longest: f64) -> Tally {
    run_with(seeds, rule, longest, |_| None)
}

/// Runs scenes likewise, with the axial law that a stiffness EA (N) makes.
fn run_with(seeds: std::ops::Range<u64>, rule: Rule, longest: f64, law: impl Fn(f64) -> Option<AxialLaw>) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let crate::recipe::Scene { mut cable, disturbance, driven } =
            scene(seed, rule, Method::DiscreteGradient, longest);
        if let Some(law) = law(cable.elements()[0].section.axial_stiffness) {
            cable.set_effects(Effects { axial_law: Some(law), ..Effects::default() }).unwrap();
        }
        tally.scenes += 1;
        let (mut largest, mut broken, mut rise, mut rose_from) = (0.0f64, 0.0f64, 0.0f64, f64::INFINITY);
        // the first host step puts supports in place
        for step in 0..36 {
            if step == 9 {
                disturb(&mut cable, disturbance);
                rose_from = f64::INFINITY;
            }
            let ([before, scale], work_before) = (energies(&cable), work(&cable));
            let counts = *cable.diagnostics();
            largest = largest.max(scale);
            let begun = Instant::now();
            if let Err(error) = cable.step(1.0 / 60.0) {
                tally.refused.push((seed, error.to_string()));
                break;
            }
            tally.slowest = tally.slowest.max(begun.elapsed().as_secs_f64());
            let [after, scale] = energies(&cable);
            largest = largest.max(scale);
            // a step after a change puts supports in place
            if step != 0 && step != 9 {
                broken = broken.max(after - before - (work(&cable) - work_before));
            }
            let energy = cable.energy().total();
            if !driven {
                rose_from = rose_from.min(energy);
                rise = rise.max(energy - rose_from);
            }
            let done = cable.diagnostics().since(&counts);
            tally.worst_host_step = tally.worst_host_step.max(done.newton_iterations);
        }
        let counts = cable.diagnostics();
        tally.broken = tally.broken.max(broken / largest);
        tally.rise = tally.rise.max(rise / largest);
        tally.host_steps += counts.host_steps;
        tally.steps += counts.steps;
        tally.iterations += counts.newton_iterations;
        tally.rescaled += counts.rescaled_steps;
        tally.split += counts.split_steps;
        tally.indefinite += counts.indefinite_factorisations;
    }
    tally
}

/// Runs chains of ropes and bodies likewise.
pub fn run_chains(seeds: std::ops::Range<u64>, rule: Rule, longest: f64) -> Tally {
    let mut tally = Tally::default();
    for seed in seeds {
        let mut chain = Chain::new(seed, rule, longest);
        tally.scenes += 1;
        let (mut largest, mut broken) = (0.0f64, 0.0f64);
        for step in 0..36 {
            if step == 9 {
                chain.disturb(seed);
            }
            let [before, scale] = chain.energies();
            let counts = chain.cables[0].diagnostics().newton_iterations;
            largest = largest.max(scale);
            let begun = Instant::now();
            if let Err(error) = chain.step(1.0 / 60.0) {
                tally.refused.push((seed, error.to_string()));
                break;
            }
            tally.slowest = tally.slowest.max(begun.elapsed().as_secs_f64());
            let [after, scale] = chain.energies();
            largest = largest.max(scale);
            // pinned nodes take the velocities of their bodies in the first step, and after a blow
            if step != 0 && step != 9 {
                broken = broken.max(after - before);
            }
            tally.worst_host_step = tally.worst_host_step.max(chain.cables[0].diagnostics().newton_iterations - counts);
        }
        tally.broken = tally.broken.max(broken / largest);
        let counts = chain.cables[0].diagnostics();
        tally.host_steps += counts.host_steps;
        tally.steps += counts.steps;
        tally.iterations += counts.newton_iterations;
        tally.rescaled += counts.rescaled_steps;
        tally.split += counts.split_steps;
        tally.indefinite += counts.indefinite_factorisations;
    }
    tally
}

/// Seeds of the quick set and of the long one.
fn seeds() -> std::ops::Range<u64> {
    let long = std::env::var_os("LARIAT_LONG_TESTS").is_some();
    if long { 50_000..51_000 } else { 20_000..20_200 }
}

/// Checks what a run of scenes must show.
fn check(name: &str, tally: &Tally) {
    println!("{name}: {tally:?}");
    assert!(tally.refused.is_empty(), "{name}: {:?}", tally.refused);
    assert!(tally.broken < 1e-8, "{name}: law broken by {:e}", tally.broken);
}

/// No thrown cable is refused, and its energy never rises beyond the work done on it.
///
/// *Source.* The energy law, read from the outside; the tolerance is 1e-9 of the energy in each of several steps.
#[test]
fn thrown_cables_make_no_energy_and_none_is_refused() {
    for rule in ["projected-3", "projected-T1", "projected-none", "ST2", "G5-3"] {
        for longest in [1.0 / 60.0, 1.0 / 240.0] {
            check(&format!("{rule}, 1/{:.0} s", 1.0 / longest), &run(seeds(), rule.parse().unwrap(), longest));
        }
    }
}

/// A measured curve through the forces at strains of 5, 10 and 20 % over EA, to which its slope comes.
fn curve(shares: [f64; 3], axial: f64) -> AxialLaw {
    let rows = [0.0, 0.05, 0.1, 0.2].into_iter().zip([0.0, shares[0], shares[1], shares[2]]);
    AxialLaw::Curve(rows.map(|(strain, share)| [strain, share * axial]).collect())
}

/// The same with the axial laws of Hooke, of a rope, and of measured curves that bend up: one much, one as nylon.
///
/// *Source.* As above.
#[test]
fn thrown_cables_of_other_axial_laws_make_no_energy() {
    let law = |name: &str, axial: f64| match name {
        "Hooke" => AxialLaw::Hooke,
        "rope" => AxialLaw::Rope,
        "stiffening" => curve([1e-4, 1e-3, 0.06], axial),
        _ => curve([0.005, 0.015, 0.06], axial),
    };
    for name in ["Hooke", "rope", "stiffening", "nylon"] {
        for longest in [1.0 / 60.0, 1.0 / 240.0] {
            let tally = run_with(seeds(), "projected-3".parse().unwrap(), longest, |axial| Some(law(name, axial)));
            check(&format!("{name}, 1/{:.0} s", 1.0 / longest), &tally);
        }
    }
}

/// The same of chains of ropes and bodies.
///
/// *Source.* As above.
#[test]
fn thrown_chains_make_no_energy_and_none_is_refused() {
    for rule in ["projected-3", "projected-T1"] {
        for longest in [1.0 / 60.0, 1.0 / 240.0] {
            check(&format!("{rule}, 1/{:.0} s", 1.0 / longest), &run_chains(seeds(), rule.parse().unwrap(), longest));
        }
    }
}
