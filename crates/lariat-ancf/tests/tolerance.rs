//! The tolerance is the position error in metres per host step: the true error of a host step
//! follows it.

mod common;

use common::{EXACT_IN_TIME, pendulum};
use lariat_ancf::{Cable, Integrator, Method, Section};

const HOST_STEP: f64 = 1.0 / 60.0;

/// True errors of host steps divided by their tolerance.
struct Ratios {
    /// Of all host steps, ascending.
    all: Vec<f64>,
    /// Of those that error control divided into three steps or more, ascending.
    cut: Vec<f64>,
}

impl Ratios {
    /// Returns a description if the claim of [`true_error_follows_tolerance`] is not met.
    fn miss(&self) -> Option<String> {
        let worst = self.all[self.all.len() - 1];
        let low = self.cut.len() >= 10 && self.cut[self.cut.len() / 2] < 0.1;
        (low || worst > 10.0 || worst.is_nan()).then(|| format!("{self}"))
    }
}

impl std::fmt::Display for Ratios {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let at = |x: &[f64], share: usize| x.get(share * (x.len().max(1) - 1) / 10).copied().unwrap_or(f64::NAN);
        let (all, cut) = (&self.all, &self.cut);
        write!(
            f,
            "true error/tolerance: tenth {:.3}, median {:.3}, nine tenths {:.3}, worst {:.3}",
            at(all, 1),
            at(all, 5),
            at(all, 9),
            at(all, 10)
        )?;
        write!(f, "; of {} host steps of three steps or more: median {:.3}", cut.len(), at(cut, 5))
    }
}

/// Returns the true errors of `count` host steps of a run, the largest displacement error of any
/// node: each step is repeated from the same state by `exact`.
fn ratios(mut cable: Cable, mut exact: Cable, tolerance: f64, count: usize) -> Ratios {
    let errors: Vec<(f64, u64)> = (0..count)
        .map(|_| {
            exact.restore(cable.snapshot().clone()).unwrap();
            exact.step(HOST_STEP).unwrap();
            let steps = cable.diagnostics().steps;
            cable.step(HOST_STEP).unwrap();
            let error = (0..cable.nodes())
                .map(|i| (cable.node_position(i) - exact.node_position(i)).norm())
                .fold(0.0, f64::max);
            (error / tolerance, cable.diagnostics().steps - steps)
        })
        .collect();
    let sorted = |least: u64| {
        let mut x: Vec<f64> = errors.iter().filter(|(_, steps)| *steps >= least).map(|(ratio, _)| *ratio).collect();
        x.sort_by(f64::total_cmp);
        x
    };
    Ratios { all: sorted(1), cut: sorted(3) }
}

/// Checks that no host step's error exceeds 10 times its tolerance, and that the median is not
/// below a tenth of it among the host steps that error control divided into three steps or more: in
/// the others the step is bounded by the host's and not by the error.
///
/// Two seconds of the paper's pendulum, 10 elements, host step 1/60 s, tolerances from 1e-3 to 1e-7
/// m.
///
/// *Source.* The same step by the symplectic method of order 6, whose error in a host step is below
/// 1e-12 m.
fn true_error_follows_tolerance(method: Method) {
    true_error_follows(method, &[1e-3, 1e-4, 1e-5, 1e-6, 1e-7]);
}

fn true_error_follows(method: Method, tolerances: &[f64]) {
    let mut missed = Vec::new();
    for &tolerance in tolerances {
        let cable = pendulum(10).integrator(Integrator::tolerance(method, tolerance).unwrap()).build().unwrap();
        let exact = pendulum(10).integrator(EXACT_IN_TIME).build().unwrap();
        let ratios = ratios(cable, exact, tolerance, 120);
        println!("{method} {tolerance:.0e}: {ratios}");
        missed.extend(ratios.miss().map(|miss| format!("{tolerance:.0e}: {miss}")));
    }
    assert!(missed.is_empty(), "{method} misses at\n{}", missed.join("\n"));
}

/// See [`true_error_follows_tolerance`].
///
/// *Source.* As there.
#[test]
fn true_error_follows_tolerance_of_esdirk3() {
    true_error_follows_tolerance(Method::Esdirk3);
}

/// See [`true_error_follows_tolerance`].
///
/// *Source.* As there.
#[test]
fn true_error_follows_tolerance_of_esdirk4() {
    true_error_follows_tolerance(Method::Esdirk4);
}

/// See [`true_error_follows_tolerance`].
///
/// *Source.* As there.
#[test]
fn true_error_follows_tolerance_of_tr_bdf2() {
    true_error_follows_tolerance(Method::TrBdf2);
}

/// See [`true_error_follows_tolerance`].
///
/// *Source.* As there.
#[test]
fn true_error_follows_tolerance_of_the_trapezoidal_rule() {
    true_error_follows_tolerance(Method::Trapezoid);
}

/// See [`true_error_follows_tolerance`].
///
/// *Source.* As there.
#[test]
fn true_error_follows_tolerance_of_generalised_alpha_0() {
    true_error_follows_tolerance(Method::GeneralisedAlpha { rho: 0.0 });
}

/// See [`true_error_follows_tolerance`].
///
/// *Source.* As there.
#[test]
fn true_error_follows_tolerance_of_generalised_alpha_05() {
    true_error_follows_tolerance(Method::GeneralisedAlpha { rho: 0.5 });
}

/// The discrete gradient follows tolerances down to those that a 64th of the host step can keep.
///
/// *Source.* As above.
#[test]
fn true_error_follows_tolerance_of_the_discrete_gradient() {
    true_error_follows(Integrator::COUPLED.method, &[1e-3, 1e-4, 1e-5, 1e-6]);
}

/// Pendulums for which the error control was not tuned: ten times stiffer, five millimetres thin,
/// three metres long and stiffer. Default method.
///
/// *Source.* As above; 60 host steps.
#[test]
fn true_error_follows_tolerance_of_other_pendulums() {
    let Integrator { method, .. } = Integrator::default();
    let mut missed = Vec::new();
    for (name, side, modulus, length) in
        [("stiff", 0.01, 1e9, 2.0), ("thin", 0.005, 1e8, 2.0), ("long", 0.01, 3e8, 3.0)]
    {
        for tolerance in [1e-4, 1e-6] {
            let build = |integrator| {
                pendulum(10)
                    .points([lariat_ancf::Vector3::zeros(), lariat_ancf::Vector3::new(length, 0.0, 0.0)])
                    .section(Section::square(side, modulus, 4000.0).unwrap())
                    .integrator(integrator)
                    .build()
                    .unwrap()
            };
            let ratios =
                ratios(build(Integrator::tolerance(method, tolerance).unwrap()), build(EXACT_IN_TIME), tolerance, 60);
            println!("{name}, {method} {tolerance:.0e}: {ratios}");
            missed.extend(ratios.miss().map(|miss| format!("{name}, {tolerance:.0e}: {miss}")));
        }
    }
    assert!(missed.is_empty(), "{method} misses at\n{}", missed.join("\n"));
}
