//! Columns and stubs in statics: beam-columns below the critical load, the elastica above it, and rods so
//! thick that they shorten instead of buckling.
//!
//! *Physics.* Compression softens bending: a shape close to the critical load is soft, and its force
//! residual is small long before its moments are in balance. A stub below its critical load has one
//! physical shape, the straight one.

mod common;

use common::rod::Elastica;
use lariat_ancf::{At, Cable, CableBuilder, EquilibriumFailure, Error, PointLoad, Rule, Section, Vector3};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// A weightless cantilever of 1 m along x, clamped at its start, with a force at its tip.
fn cantilever(axial: f64, bending: f64, elements: usize, force: [f64; 2]) -> CableBuilder {
    Cable::builder()
        .points([Vector3::zeros(), Vector3::x()])
        .section(Section::from_stiffness(axial, bending, 1.0).unwrap())
        .elements(elements)
        .gravity(Vector3::zeros())
        .clamp(At::Start)
        .load(PointLoad::force(1.0, Vector3::new(force[0], force[1], 0.0)))
}

/// Largest bending moment in N m that the cable itself does not balance: the moment at the clamp minus
/// that of the tip force about it, as a share of the latter.
fn moment_defect(cable: &mut Cable) -> f64 {
    let reaction = cable.reactions().unwrap()[0];
    let arm = common::tip(cable) - cable.node_position(0);
    let (force, across) = (cable.loads()[0].force, arm.cross(&cable.loads()[0].force));
    assert!((reaction.force + force).norm() < 1e-6 * force.norm(), "{reaction:?}");
    (reaction.moment + across).norm() / across.norm()
}

/// Deflection and moments of a column with a small lateral force, from half of the critical load to 98 %
/// of it, whatever its slenderness, and however small the lateral force.
///
/// *Source.* Beam-column (Timoshenko & Gere 1961, section 1.10): tip deflection Q L^3/(3 EI) * 3 (tan u -
/// u)/u^3, u = L sqrt(P/EI), for the thin column; the elastica with the Green-law stretch, by shooting, for
/// all. Four elements make the critical load 1e-4 too high, which 1 - P/P_cr divides.
#[test]
fn deflection_of_a_column_grows_as_that_of_the_beam_column() {
    for (axial, elements) in [(1e4, 8), (1e6, 4), (1e6, 10), (1e6, 40), (1e8, 10), (1e8, 40)] {
        for share in [0.5, 0.9, 0.98] {
            for lateral in [1e-5, 1e-6, 1e-8] {
                let p = share * PI * PI / 4.0;
                let u = p.sqrt();
                let beam = lateral * p * (u.tan() - u) / u.powi(3);
                let expected = Elastica { axial, bending: 1.0, length: 1.0, force: [-p, lateral * p] }.tip().0.y;
                assert!(axial < 1e8 || (expected / beam - 1.0).abs() < 1e-4, "{expected} {beam}");
                let mut cable = cantilever(axial, 1.0, elements, [-p, lateral * p]).build().unwrap();
                let report = cable.equilibrium().unwrap();
                let (y, defect) = (common::tip(&cable).y, moment_defect(&mut cable));
                let error = (y / expected - 1.0).abs();
                println!(
                    "EA {axial:e} n {elements}, {share}, {lateral:e}: {error:.1e}, moments {defect:.1e}, {report:?}"
                );
                let allowed = if elements == 4 { 4e-5 } else { 2e-6 } / (1.0 - share);
                assert!(error < allowed, "{y} of {expected}");
                assert!(defect < 1e-6 && report.stable, "moments are {defect:e} out of balance");
            }
        }
    }
}

/// A column above its critical load takes the shape of the elastica, and not the straight one, which is
/// unstable; without any lateral force in an arbitrary direction.
///
/// *Source.* Shooting; itself tested in `elastica.rs` against elliptic integrals.
#[test]
fn a_column_above_its_critical_load_buckles_to_the_elastica() {
    for axial in [1e4, 1e6, 1e8] {
        for share in [1.02, 1.1, 1.5, 2.0] {
            let p = share * PI * PI / 4.0;
            for lateral in [1e-4, 1e-6] {
                let mut cable = cantilever(axial, 1.0, 40, [-p, lateral * p]).build().unwrap();
                let report = cable.equilibrium().unwrap();
                let (tip, defect) = (common::tip(&cable), moment_defect(&mut cable));
                let (end, _) = Elastica { axial, bending: 1.0, length: 1.0, force: [-p, lateral * p] }.tip();
                let error = (tip.xy() - Vector2::new(end.x, end.y)).norm();
                println!("EA {axial:e}, {share}, {lateral:e}: {error:.1e} m, moments {defect:.1e}, {report:?}");
                assert!(error < 3e-4 && tip.z.abs() < 1e-5, "{error:e} m, {tip:?}");
                assert!(defect < 1e-6 && report.stable, "{defect:e} {report:?}");
            }
        }
    }
}

/// A stub under a force below its critical load is shortened, whatever the rule and the number of elements;
/// it does not run backwards from its clamp. The default rule holds it in an unstable shape, since its
/// elements fold where they are compressed by more than 1e-3, and says so.
///
/// *Source.* The Green law: EA (f^2 - 1)/2 f = -P with the root of f between 0.577 and 1.
#[test]
fn a_stub_in_compression_is_shortened_and_does_not_run_backwards() {
    for rule in ["projected-3", "exact-3", "G5-3", "ST2", "L2T2"] {
        for elements in 1..=10 {
            for (share, bending) in [(-1e-4, 1000.0), (-0.01, 10.0), (-0.05, 1000.0), (-0.15, 100.0), (0.15, 1000.0)] {
                let (axial, mut f) = (1000.0, 1.0);
                for _ in 0..100 {
                    f -= (0.5 * (f * f - 1.0) * f - share) / (1.5 * f * f - 0.5);
                }
                let rule: Rule = rule.parse().unwrap();
                let builder = cantilever(axial, bending, elements, [share * axial, 0.0]).rule(rule);
                let mut cable = builder.build().unwrap();
                let report = cable.equilibrium().unwrap_or_else(|e| panic!("{rule} {elements} {share}: {e}"));
                let tip = common::tip(&cable);
                assert!((tip - Vector3::x() * f).norm() < 1e-7, "{rule} {elements} {share}: {tip:?} of {f}");
                let folds = rule == Rule::default() && share < -1e-3;
                assert_eq!(report.stable, !folds, "{rule} {elements} {share}: {report:?}");
            }
        }
    }
}

/// Beyond the largest force that the Green law carries in compression there is no straight shape: that is
/// an error, or a bent shape in balance, and never a rod that runs backwards.
///
/// *Source.* max of EA (1 - f^2)/2 f = EA/sqrt(27) at f = 1/sqrt(3).
#[test]
fn a_force_beyond_the_law_of_the_material_is_an_error() {
    let (axial, bending) = (1000.0, 1000.0);
    for elements in [1, 2, 4, 10] {
        for rule in ["projected-3", "exact-3"] {
            let force = [-1.1 * axial / 27f64.sqrt(), 0.0];
            let builder = cantilever(axial, bending, elements, force).rule(rule.parse().unwrap());
            let error = builder.build().unwrap().equilibrium().unwrap_err();
            println!("{rule} {elements}: {error}");
            let Error::NoEquilibrium { failure, .. } = error else { panic!("{error}") };
            let named = [EquilibriumFailure::Folded { element: 0 }, EquilibriumFailure::NotConverged];
            assert!(named.iter().any(|n| core::mem::discriminant(n) == core::mem::discriminant(&failure)), "{failure}");
        }
    }
}
