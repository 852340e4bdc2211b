//! The effects whose cost is measured: examples of each effect in the list of the mechanics.
//!
//! An effect that is added to the list and has no examples here does not compile.

use lariat_ancf::{
    AxialLaw, Buoyancy, Contact, Damping, Drag, Effects, Flow, GravityScale, LineLoad, LineLoads, RestShape, Torsion,
    Vector3, for_each_effect,
};

/// The label of the example whose flow a program samples at every node before the step.
const SAMPLED: &str = "sampled flow";

/// Examples of an effect: a label, empty if there is only one, and the effect.
trait Examples: Sized {
    fn examples() -> Vec<(&'static str, Self)>;
}

impl Examples for GravityScale {
    fn examples() -> Vec<(&'static str, Self)> {
        vec![("", GravityScale(0.5))]
    }
}

impl Examples for AxialLaw {
    fn examples() -> Vec<(&'static str, Self)> {
        vec![("Hooke", AxialLaw::Hooke), ("rope", AxialLaw::Rope)]
    }
}

impl Examples for Buoyancy {
    fn examples() -> Vec<(&'static str, Self)> {
        vec![("", Buoyancy::new(1000.0, 1.0))]
    }
}

impl Examples for LineLoads {
    fn examples() -> Vec<(&'static str, Self)> {
        vec![("", LineLoad::uniform(Vector3::x()).into())]
    }
}

impl Examples for RestShape {
    fn examples() -> Vec<(&'static str, Self)> {
        vec![("curvature", RestShape::curved(0.1)), ("stretch", RestShape::stretched(0.999))]
    }
}

impl Examples for Damping {
    fn examples() -> Vec<(&'static str, Self)> {
        let both = Damping { axial: 1e-3, bending: 1e-3 };
        vec![("axial and bending", both), ("axial", Damping { bending: 0.0, ..both })]
    }
}

impl Examples for Drag {
    fn examples() -> Vec<(&'static str, Self)> {
        let drag = |flow| Drag::new(1000.0, 1.2, 0.01, flow);
        let flow = Vector3::new(1.0, 0.0, 0.2);
        vec![
            ("uniform flow", drag(Flow::uniform(flow))),
            ("power-law wind", drag(Flow::power_law(flow, Vector3::y(), 10.0, 0.14, 100.0))),
            (SAMPLED, drag(Flow::default())),
        ]
    }
}

/// None: the table steps a cable by the method of its row, and one end alone is held.
impl Examples for Torsion {
    fn examples() -> Vec<(&'static str, Self)> {
        Vec::new()
    }
}

/// None: the table steps a cable alone, which touches nothing.
impl Examples for Contact {
    fn examples() -> Vec<(&'static str, Self)> {
        Vec::new()
    }
}

/// Effects to be measured.
pub struct Case {
    /// Name in tables.
    pub name: String,
    /// The effects.
    pub effects: Effects,
    /// Whether a program samples the flow before each step.
    pub sampled: bool,
}

/// Name of a column that counts the elements for which an effect was evaluated.
macro_rules! columns {
    ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => {
        /// Names of the columns that count the elements for which an effect was evaluated, in the
        /// order of the list.
        pub const COLUMNS: &[&str] = &[$(concat!($key, "_evaluations_per_step")),*];
    };
}

for_each_effect!(columns);

/// Returns the examples of all effects, and all effects at once by the first example of each.
pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut all = Effects::default();
    macro_rules! add {
        ($({ field: $field:ident, type: $type:ident, set: $set:ident, key: $key:literal, summary: $summary:literal })*) => { $({
            let examples = <$type as Examples>::examples();
            all.$field = examples.first().map(|(_, effect)| effect.clone());
            for (label, effect) in examples {
                let name = if label.is_empty() { $key.to_string() } else { format!("{}: {label}", $key) };
                let effects = Effects { $field: Some(effect), ..Effects::default() };
                cases.push(Case { name: name.replace('_', " "), effects, sampled: label == SAMPLED });
            }
        })* };
    }
    for_each_effect!(add);
    cases.push(Case { name: "all effects".to_string(), effects: all, sampled: false });
    cases
}
