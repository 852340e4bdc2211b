//! The values of `rule` and `integrator`, as tables for a terminal.

use lariat_ancf::{AxialRule, BendingRule, Method, Rule};

/// Rows of the table of rules: name, axial and bending energy, when to use it.
const NOTES: [(&str, &str, &str); 8] = [
    (
        "projected-3",
        "strain projected on linear functions; 3 Gauss points",
        "default: neither locks nor has zero-energy modes",
    ),
    ("G3-3", "3 Gauss points; 3 Gauss points", "under-integrated: relieves locking a little"),
    ("G4-4", "4 Gauss points; 4 Gauss points", "as G3-3, less"),
    ("G5-3", "5 Gauss points (exact); 3 Gauss points", "exact axial energy; locks on thin cables with few elements"),
    ("G10-10", "10 Gauss points (exact); 10 Gauss points", "the paper's reference"),
    (
        "ST2",
        "exact; r''/|r'|^2 with the mean stretch",
        "the paper's symbolic model; |r'| nearly constant in an element",
    ),
    ("L2T2", "mean strain; r''/|r'|^2 with the mean stretch", "the paper's simplified model"),
    ("exact-none", "exact; none", "a chain, or a rope without bending stiffness"),
];

/// Returns the table of rules.
pub fn rules() -> String {
    let mut text = format!("{:<12} {:<53} {}\n", "rule", "axial energy; bending energy", "validity");
    for (name, energies, note) in NOTES {
        text += &format!("{name:<12} {energies:<53} {note}\n");
    }
    text += "\nAny pair can be written as AXIAL-BENDING or { axial, bending }:\n\
             \x20 axial    projected | exact | mean | gauss-N (GN), N from 1 to 10\n\
             \x20 bending  none | t1 (mean of |r''|^2) | t2 | gauss-N (N), N from 1 to 10\n\
             Cost: the axial energy is a constant quadratic form of six numbers whatever the rule; Gauss bending costs in\n\
             proportion to its points; `lariat table1` measures both.\n\n\
             Rejected because of zero-energy modes (allow_rank_deficient = true runs them nevertheless):\n";
    for (reason, names) in rejected() {
        text += &format!("  {}\n    {reason}\n", names.join(", "));
    }
    text
}

/// Returns the rejected pairs by reason, in the order of the lists of rules.
fn rejected() -> Vec<(&'static str, Vec<String>)> {
    let axial =
        [AxialRule::Projected, AxialRule::Exact, AxialRule::Mean].into_iter().chain((1..=10).map(AxialRule::Gauss));
    let mut groups: Vec<(&'static str, Vec<String>)> = Vec::new();
    for axial in axial {
        for bending in
            [BendingRule::None, BendingRule::T1, BendingRule::T2].into_iter().chain((1..=10).map(BendingRule::Gauss))
        {
            let rule = Rule::new(axial, bending);
            let Some(reason) = rule.spare_modes() else { continue };
            match groups.iter_mut().find(|(r, _)| *r == reason) {
                Some((_, names)) => names.push(rule.to_string()),
                None => groups.push((reason, vec![rule.to_string()])),
            }
        }
    }
    groups
}

/// Returns the table of integrators.
pub fn integrators() -> String {
    let header = ("integrator", "order", "error estimate", "cost per step", "stability", "validity");
    let mut text =
        format!("{:<26} {:<6} {:<15} {:<20} {:<52} {}\n", header.0, header.1, header.2, header.3, header.4, header.5);
    for method in Method::ALL {
        let p = method.properties();
        let cost = format!("{} {}", p.stages, if p.implicit { "implicit solve" } else { "force" });
        text += &format!(
            "{:<26} {:<6} {:<15} {:<20} {:<52} {}\n",
            method.to_string(),
            p.order,
            if p.estimate_order.is_some() { "yes: tolerance" } else { "no" },
            if p.stages == 1 { cost } else { cost + "s" },
            p.stability,
            p.validity
        );
    }
    text + "\nintegrator = { tolerance = m } uses the default method; { method, tolerance } a method with an error estimate, in m of\n\
            position per host step; { method, substeps } equal steps in each host step; { method, max_step } steps no longer than\n\
            that, in s; { method, adaptive } 1 to 8 steps of the discrete gradient in 1/60 s, of which 1 and 2 keep this error, in m;\n\
            { method, stable } an explicit method at this share of its stability limit; { fidelity } game, engineering\n\
            or reference. generalised-alpha-R takes any spectral radius R from 0 to 1.\n"
}
