//! Order conditions and stability functions of the implicit Runge-Kutta methods.

use lariat_ancf::integrate::dirk::Tableau;
use lariat_ancf::integrate::{esdirk3, esdirk4, midpoint, tr_bdf2};

/// Returns the largest residual of the order conditions of each order up to 4 for weights `b`.
fn order_conditions(t: &Tableau, b: &[f64]) -> [f64; 4] {
    let s = t.a.len();
    let a = |i: usize, j: usize| t.a[i].get(j).copied().unwrap_or(0.0);
    let c: Vec<f64> = (0..s).map(|i| t.c(i)).collect();
    let sum = |f: &dyn Fn(usize) -> f64| (0..s).map(|i| b[i] * f(i)).sum::<f64>();
    let row = |i: usize, f: &dyn Fn(usize) -> f64| (0..s).map(|j| a(i, j) * f(j)).sum::<f64>();
    let ac = |i: usize| row(i, &|j| c[j]);
    let largest = |x: &[f64]| x.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    [
        largest(&[sum(&|_| 1.0) - 1.0]),
        largest(&[sum(&|i| c[i]) - 1.0 / 2.0]),
        largest(&[sum(&|i| c[i] * c[i]) - 1.0 / 3.0, sum(&ac) - 1.0 / 6.0]),
        largest(&[
            sum(&|i| c[i].powi(3)) - 1.0 / 4.0,
            sum(&|i| c[i] * ac(i)) - 1.0 / 8.0,
            sum(&|i| row(i, &|j| c[j] * c[j])) - 1.0 / 12.0,
            sum(&|i| row(i, &ac)) - 1.0 / 24.0,
        ]),
    ]
}

/// The tableaus satisfy Butcher's conditions up to their order, and their embedded formulas exactly
/// up to theirs, so that the difference estimates the error.
///
/// *Source.* Butcher's order conditions (Hairer, Norsett & Wanner 1993, II.2, table 2.1), to the
/// rounding of the printed fractions.
#[test]
fn tableaus_satisfy_the_order_conditions_they_claim() {
    for (name, tableau, order, embedded) in [
        ("midpoint", midpoint::TABLEAU, 2, None),
        ("tr-bdf2", tr_bdf2::TABLEAU, 2, Some(3)),
        ("esdirk3", esdirk3::TABLEAU, 3, Some(2)),
        ("esdirk4", esdirk4::TABLEAU, 4, Some(3)),
    ] {
        let check = |what: &str, b: &[f64], order: usize| {
            let residuals = order_conditions(&tableau, b);
            println!("{name}, {what}: 1e{:.1?}", residuals.map(|r| (r + 1e-17).log10()));
            assert!(residuals[..order].iter().all(|r| *r < 1e-14), "{name}, {what}: {residuals:?}");
            assert!(residuals.get(order).is_none_or(|r| *r > 1e-3), "{name}, {what}: of higher order {residuals:?}");
        };
        check("result", tableau.b, order);
        if let Some(embedded) = embedded {
            let weights = tableau.estimate.unwrap().weights;
            let hat: Vec<f64> = tableau.b.iter().zip(weights).map(|(b, e)| b - e).collect();
            check("embedded", &hat, embedded);
        }
    }
}

/// Returns the absolute value of a tableau's stability function R(z) at z = x + i y, by solving the
/// stages successively.
fn amplification(t: &Tableau, z: (f64, f64)) -> f64 {
    type C = (f64, f64);
    let mul = |a: C, b: C| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let div = |a: C, b: C| {
        let n = b.0 * b.0 + b.1 * b.1;
        ((a.0 * b.0 + a.1 * b.1) / n, (a.1 * b.0 - a.0 * b.1) / n)
    };
    let mut stages: Vec<C> = Vec::new();
    for (i, row) in t.a.iter().enumerate() {
        let known = (0..i).fold((1.0, 0.0), |s: C, j| {
            let zk = mul(z, stages[j]);
            (s.0 + row[j] * zk.0, s.1 + row[j] * zk.1)
        });
        stages.push(div(known, (1.0 - row[i] * z.0, -row[i] * z.1)));
    }
    let end = stages.iter().zip(t.b).fold((1.0, 0.0), |s: C, (y, b)| {
        let zk = mul(z, *y);
        (s.0 + b * zk.0, s.1 + b * zk.1)
    });
    end.0.hypot(end.1)
}

/// No implicit tableau amplifies an oscillation of any frequency, and the L-stable ones damp an
/// infinitely stiff component at once.
///
/// *Source.* Definition of A- and L-stability (Hairer & Wanner 1996, IV.3): |R(i y)| <= 1 for all
/// y, R(infinity) = 0.
#[test]
fn implicit_tableaus_are_stable_for_every_frequency() {
    for (name, tableau, l_stable) in [
        ("midpoint", midpoint::TABLEAU, false),
        ("tr-bdf2", tr_bdf2::TABLEAU, true),
        ("esdirk3", esdirk3::TABLEAU, true),
        ("esdirk4", esdirk4::TABLEAU, true),
    ] {
        for k in -300..=600 {
            let r = amplification(&tableau, (0.0, 10f64.powf(f64::from(k) / 100.0)));
            assert!(r <= 1.0 + 1e-12, "{name}: |R| = {r} at y = 1e{}", f64::from(k) / 100.0);
        }
        let stiff = amplification(&tableau, (-1e9, 0.0));
        assert_eq!(stiff < 1e-6, l_stable, "{name}: R = {stiff}");
    }
}
