//! Far from the origin; tiny and huge cables.

use super::prelude::*;
use crate::stability::host::Precision;

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for far in [1e3, 1e5] {
        // single precision resolves 0.06 mm at 1 km, 8 mm at 100 km
        let swinging = case(Family::Scale, format!("a pendulum {far:.0e} m from the origin"), 1.0, move |w| {
            let load = w.ball(5.0, 0.05, [far + 2.0, 0.0, 0.0]);
            let rope = straight([far, 0.0, 0.0], [far + 2.0, 0.0, 0.0], polymer_rope());
            w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Script::new().checks(move |w| {
                // Rapier adds to the position in each of its substeps; each sum is rounded by up to
                // half a unit in the last place, and similar sums in the same direction; so are the
                // initial position and the conversion from the centre of mass
                let unit = f64::from((far as f32).next_up() - far as f32);
                let roundings = w.host.iterations as f64 + 2.0;
                let resolution = if w.host.precision == Precision::Single { 0.5 * unit * roundings } else { 0.0 };
                let place = w.position(load);
                let end = w.cable(0).map_or(f64::NAN, |c| (c.node_position(c.nodes() - 1) - place).norm());
                vec![Check::at_most("body off its end, m", end, resolution + 1e-6, "single precision")]
            }))
        });
        cases.push(swinging);
    }
    // a silk thread of 1 mm
    let thread = case(Family::Scale, "a thread of 1 mm", 0.1, |w| {
        let section = Section::round(1e-5, 1e10, 1300.0)?;
        let load = w.ball(1e-6, 1e-4, [1e-3, 0.0, 0.0]);
        let rope = straight([0.0; 3], [1e-3, 0.0, 0.0], section).elements(4);
        let rope = rope.integrator(Integrator::tolerance(Method::Esdirk4, 1e-9)?);
        w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Script::new()
            .checks(|w| vec![Check::at_most("stretch", w.monitor.stretch, 1e-3, "3 times the weight over EA: 4e-5")]))
    });
    cases.push(thread.gap(1e-6));
    let tether = case(Family::Scale, "a tether of 10 km", 5.0, |w| {
        let section = Section::round(0.01, 2.1e11, 7850.0)?;
        let (ea, mu) = (section.axial_stiffness, section.mass_per_length);
        let f = green_stretch(G * (1e3 + 0.5 * mu * 1e4) / ea);
        let load = w.cube(1e3, 0.5, [0.0, -1e4 * f, 0.0]);
        let rope = straight([0.0; 3], [0.0, -1e4 * f, 0.0], section).length(1e4).elements(20);
        let rope = rope.integrator(Integrator::tolerance(Method::Esdirk4, 1e-3)?);
        w.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Script::new().checks(move |w| {
            let stretch = w.stretch(0);
            vec![Check::near(
                "stretch",
                stretch,
                f - 1.0,
                0.2,
                "statics, and the vibration that an even stretch at the start causes",
            )]
        }))
    });
    cases.push(tether.gap(1e-2));
    cases
}
