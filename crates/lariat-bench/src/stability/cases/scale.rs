//! Far from the origin, and tiny and huge cables.

use super::stage::{Case, End, Play, case, line, soft};
use super::{G, green_stretch};
use crate::stability::Family::Scale;
use crate::stability::host::Precision;
use crate::stability::outcome::Reading;
use lariat_ancf::{Integrator, Method, Section};

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for far in [1e3, 1e5] {
        // single precision resolves 0.06 mm at 1 km, 8 mm at 100 km
        let swinging = case(Scale, format!("a pendulum {far:.0e} m from the origin"), 1.0, move |s| {
            let load = s.ball(5.0, 0.05, [far + 2.0, 0.0, 0.0]);
            let rope = line([far, 0.0, 0.0], [far + 2.0, 0.0, 0.0], soft());
            s.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
            Ok(Play::idle().judging(move |s| {
                // Rapier adds to the position in each of its substeps, and each sum is rounded by up to half a unit in the last place, all
                // to the same side if the sums are alike; so may be the place that it starts from, and the pose from the centre of mass
                let unit = f64::from((far as f32).next_up() - far as f32);
                let roundings = s.host.iterations as f64 + 2.0;
                let resolution = if s.host.precision == Precision::Single { 0.5 * unit * roundings } else { 0.0 };
                let place = s.place(load);
                let end = s.cable(0).map_or(f64::NAN, |c| (c.node_position(c.nodes() - 1) - place).norm());
                vec![Reading::at_most("body off its end, m", end, resolution + 1e-6, "single precision")]
            }))
        });
        cases.push(swinging.gap(1e-3).energy(0.01, 0.02));
    }
    // a silk thread of 1 mm length: the tolerance of 1e-6 m is a thousandth of it
    let thread = case(Scale, "a thread of 1 mm", 0.1, |s| {
        let section = Section::round(1e-5, 1e10, 1300.0)?;
        let load = s.ball(1e-6, 1e-4, [1e-3, 0.0, 0.0]);
        let rope = line([0.0; 3], [1e-3, 0.0, 0.0], section).elements(4);
        let rope = rope.integrator(Integrator::tolerance(Method::Esdirk4, 1e-9)?);
        s.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Play::idle()
            .judging(|s| vec![Reading::at_most("stretch", s.trace.stretch, 1e-3, "3 weights over EA: 4e-5")]))
    });
    cases.push(thread.gap(1e-6).energy(0.01, 0.02));
    let tether = case(Scale, "a tether of 10 km", 5.0, |s| {
        let section = Section::round(0.01, 2.1e11, 7850.0)?;
        let (ea, mu) = (section.axial_stiffness, section.mass_per_length);
        let f = green_stretch(G * (1e3 + 0.5 * mu * 1e4) / ea);
        let load = s.cube(1e3, 0.5, [0.0, -1e4 * f, 0.0]);
        let rope = line([0.0; 3], [0.0, -1e4 * f, 0.0], section).length(1e4).elements(20);
        let rope = rope.integrator(Integrator::tolerance(Method::Esdirk4, 1e-3)?);
        s.rope(rope, End::Fixed, End::On(load, [0.0; 3]))?;
        Ok(Play::idle().judging(move |s| {
            let stretch = s.stretch(0);
            vec![Reading::near(
                "stretch",
                stretch,
                f - 1.0,
                0.2,
                "statics, and what rings when hung in evenly stretched",
            )]
        }))
    });
    cases.push(tether.gap(1e-2).energy(0.01, 0.05));
    cases
}
