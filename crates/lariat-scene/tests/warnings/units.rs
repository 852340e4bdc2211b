//! Sizes and materials in another unit than was meant.

use crate::{pendulum, warned};
use lariat_ancf::Warning as CableWarning;
use lariat_scene::{Purpose, Scene, Warning};

#[test]
fn a_pendulum_in_si_units_has_no_warning() {
    for (wire, mass) in [([5.0, 0.004, 2.1e11], 20.0), ([1.0, 0.002, 1.0e11], 3.0), ([30.0, 0.02, 1.0e9], 100.0)] {
        assert_eq!(warned(&pendulum(wire, mass, 0.1, "bob"), Purpose::Run), [], "{wire:?}");
        assert_eq!(warned(&pendulum(wire, mass, 0.1, "bob"), Purpose::Static), [], "{wire:?}");
    }
}

#[test]
fn a_modulus_in_gpa_is_told() {
    for (modulus, mass) in [(210.0, 20.0), (70.0, 0.5), (3.5, 1.0)] {
        let warnings = warned(&pendulum([3.0, 0.004, modulus], mass, 0.1, "bob"), Purpose::Run);
        let soft = CableWarning::SoftMaterial { cable: "wire".to_string(), youngs_modulus_pa: modulus }.into();
        assert!(warnings.contains(&soft), "{warnings:?}");
        assert!(warnings[0].to_string().contains("in Pa"), "{}", warnings[0]);
    }
}

/// In MPa the modulus of steel is one of a soft rubber: the strain tells.
#[test]
fn a_tension_beyond_the_law_is_told_in_runs_and_in_statics() {
    let beyond = |text: &str, purpose| {
        let warnings = warned(text, purpose);
        let found = warnings.iter().any(|w| {
            matches!(w, Warning::Cable(CableWarning::LargeStrain { cable, tension_n, axial_stiffness_n, .. })
                if cable == "wire" && *tension_n > 0.05 * axial_stiffness_n)
        });
        assert!(found, "{purpose:?} {warnings:?}");
    };
    for (modulus, mass) in [(2.1e5, 2.0), (1.0e6, 10.0), (1.0e7, 5.0)] {
        beyond(&pendulum([2.0, 0.006, modulus], mass, 0.0, "bob"), Purpose::Run);
    }
    // T/EA = 0.08 to 0.4
    for (modulus, mass) in [(2.0e7, 4.0), (5.0e6, 2.0), (5.0e6, 5.0)] {
        beyond(&pendulum([2.0, 0.006, modulus], mass, 0.0, "bob"), Purpose::Static);
    }
    // T/EA in the middle at rest, 1.22 times that at the top, above which the law is told to be off Hooke's
    let area = std::f64::consts::FRAC_PI_4 * 0.006f64.powi(2);
    for (share, told) in [(0.04, true), (0.01, false)] {
        let modulus = 1.0 * 9.81 / share / area;
        let below =
            warned(&pendulum([2.0, 0.006, modulus], 1.0 - 0.5 * 2.0 * 7850.0 * area, 0.0, "bob"), Purpose::Static);
        let off = matches!(&below[..], [Warning::Cable(CableWarning::GreenStrain { .. })]);
        assert!(if told { off } else { below.is_empty() }, "{share} {below:?}");
    }
}

#[test]
fn a_section_in_mm_is_told() {
    for (length, diameter) in [(5.0, 4.0), (0.3, 2.0), (2.0, 0.5)] {
        let warnings = warned(&pendulum([length, diameter, 2.1e11], 20.0, 0.1, "bob"), Purpose::Run);
        let stubby = |w: &Warning| matches!(w, Warning::Cable(CableWarning::Stubby { ratio, .. }) if (ratio * diameter / length - 1.0).abs() < 1e-12);
        assert!(warnings.iter().any(stubby), "{warnings:?}");
    }
    let long = warned(&pendulum([60.0, 4.0, 2.1e11], 20.0, 0.1, "bob"), Purpose::Run);
    assert!(long.contains(&CableWarning::Thick { cable: "wire".to_string(), diameter_m: 4.0 }.into()), "{long:?}");
    // by its stiffnesses, a round rod of 0.1 m
    let rod = "[[cable]]\nname = \"rod\"\npoints = [[0.0, 0.0, 9.0], [0.8, 0.0, 9.0]]\naxial_stiffness = 1.0e8\n\
               bending_stiffness = 6.25e4\nmass_per_length = 60.0\n[[attachment]]\ncable = \"rod\"\nat = \"start\"\nbody = \"world\"\nkind = \"clamp\"\n";
    let warnings = warned(&format!("duration = 0.02\n{rod}"), Purpose::Run);
    assert!(
        matches!(&warnings[..], [Warning::Cable(CableWarning::Stubby { ratio, .. })] if (ratio - 8.0).abs() < 1e-9),
        "{warnings:?}"
    );
}

/// Densities in g/cm^3, of which some are slow enough; densities of real cables are not told.
#[test]
fn a_density_in_grams_per_cubic_centimetre_is_told() {
    let line = |density: f64, modulus: f64| {
        format!(
            "duration = 0.02\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]]\nsection = {{ round = 0.01 }}\ndensity = {density:?}\n\
             youngs_modulus = {modulus:?}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n"
        )
    };
    for (density, modulus) in [(7.85, 2.1e11), (1.15, 3e9), (0.9, 1e9), (2.7, 7e10), (1.1, 5e6), (19.3, 4.1e11)] {
        let light = |text: &str| {
            let warnings = warned(text, Purpose::Run);
            warnings.iter().any(|w| matches!(w, Warning::Cable(CableWarning::LightMaterial { density_kg_m3, .. }) if (density_kg_m3 / density - 1.0).abs() < 1e-9))
        };
        assert!(light(&line(density, modulus)), "{density}");
        let heavy = warned(&line(1000.0 * density, modulus), Purpose::Run);
        let told = |w: &Warning| matches!(w, Warning::Cable(CableWarning::LightMaterial { .. }));
        assert!(!heavy.iter().any(told), "{density} {heavy:?}");
    }
}

/// A radius of contact in mm, a damping time in percent of critical, a rotation in degrees, a force beyond EA; and none where they are in SI units.
#[test]
fn radius_damping_rotation_and_load_in_other_measures_are_told() {
    // a rope of 2 m, EA = 1e5 N, and a box beside it
    let text = |section: &str, table: &str, turn: f64, force: f64| {
        format!(
            "duration = 0.01\ngravity = [0.0, 0.0, 0.0]\n[[body]]\nname = \"box\"\nkind = \"fixed\"\nshape = {{ cuboid = [0.1, 0.1, 0.1] }}\nposition = [0.0, -90.0, 0.0]\n\
             rotation = [0.0, {turn:?}, 0.0]\n[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\n{section}\n{table}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n[[load]]\ncable = \"rope\"\nat = \"end\"\nforce = [{force:?}, 0.0, 0.0]\n"
        )
    };
    let kinds = |text: &str| -> Vec<&str> {
        let kind = |w: &Warning| match w {
            Warning::Cable(CableWarning::ThickContact { radius_m, .. }) => {
                assert!(w.to_string().contains(&format!("{radius_m} mm meant?")), "{w}");
                "radius"
            }
            Warning::Cable(CableWarning::SlowStretch { .. }) => "damping",
            Warning::ManyTurns { .. } => "rotation",
            Warning::LargeLoad { force_n, axial_stiffness_n, .. } => {
                assert!((force_n / axial_stiffness_n - 2.0).abs() < 1e-9, "{w}");
                "load"
            }
            _ => "",
        };
        warned(text, Purpose::Run).iter().map(kind).filter(|kind| !kind.is_empty()).collect()
    };
    let solid = "section = { square = 0.01 }\ndensity = 4000.0\nyoungs_modulus = 1e9";
    let stiff = "axial_stiffness = 1e5\nbending_stiffness = 0.1\nmass_per_length = 0.4";
    for section in [solid, stiff] {
        for radius in [5.0, 1.0] {
            assert_eq!(kinds(&text(section, &format!("contact = {{ radius = {radius:?} }}"), 0.0, 0.0)), ["radius"]);
        }
        assert_eq!(kinds(&text(section, "damping = { axial = 2.0 }", 90.0, 0.0)), ["damping", "rotation"]);
        assert_eq!(kinds(&text(section, "damping = { axial = 0.02 }", 45.0, 2e5)), ["load", "rotation"]);
        for radius in [0.005, 0.02] {
            let fine = format!("contact = {{ radius = {radius:?} }}\ndamping = {{ axial = 0.1, bending = 0.5 }}");
            assert!(kinds(&text(section, &fine, std::f64::consts::TAU, 1e3)).is_empty());
        }
    }
    // thicker than ten diameters
    assert_eq!(kinds(&text(solid, "contact = { radius = 0.15 }", 0.0, 0.0)), ["radius"]);
    assert!(kinds(&text(stiff, "contact = { radius = 0.15 }", 0.0, 0.0)).is_empty());
}

/// A slack in per cent, elements that are thicker than long, and an anchor in the axes of the world; and none of them where they are
/// as they should be.
#[test]
fn slack_elements_and_anchors_in_other_measures_are_told() {
    let text = |length: f64, elements: &str, anchor: [f64; 3]| {
        format!(
            "duration = 0.01\n[[body]]\nname = \"load\"\nshape = {{ ball = 0.1 }}\nmass = 5.0\nposition = [2.0, 0.0, 0.0]\n\
             [[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]\nlength = {length:?}\nelements = {elements}\n\
             section = {{ round = 0.02 }}\ndensity = 1000.0\nyoungs_modulus = 1e8\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = {anchor:?}\ngap = \"close\"\n"
        )
    };
    let kinds = |text: &str| -> Vec<&str> {
        let kind = |w: &Warning| match w {
            Warning::Cable(CableWarning::MuchSlack { .. }) => "slack",
            Warning::Cable(CableWarning::ThickElements { .. }) => "elements",
            Warning::FarAnchor { .. } => "anchor",
            _ => "",
        };
        let scene = Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap();
        scene.warnings(Purpose::Run).iter().map(kind).filter(|kind| !kind.is_empty()).collect()
    };
    let (none, at_load) = (Vec::<&str>::new(), [0.0; 3]);
    assert_eq!(kinds(&text(2.1, "10", at_load)), none);
    assert_eq!(kinds(&text(5.9, "10", at_load)), none);
    assert_eq!(kinds(&text(102.0, "10", at_load)), ["slack"]);
    assert_eq!(kinds(&text(2.1, "90", at_load)), none);
    assert_eq!(kinds(&text(2.1, "120", at_load)), ["elements"]);
    assert_eq!(kinds(&text(2.1, "{ count = 30, finest = 0.03 }", at_load)), none);
    assert_eq!(kinds(&text(2.1, "{ count = 30, finest = 0.01 }", at_load)), ["elements"]);
    assert_eq!(kinds(&text(2.1, "10", [-0.1, 0.0, 0.0])), none);
    assert_eq!(kinds(&text(2.1, "10", [2.0, 0.0, 0.0])), ["anchor"]);
}

/// A body so far away that single precision rounds it, one that spins by more than half a turn in a step, a cable in air with the added mass
/// of water; and none of them where they are as they should be.
#[test]
fn far_bodies_fast_spins_and_added_mass_in_air_are_told() {
    let text = |x: f64, spin: f64, height: f64, added: f64| {
        format!(
            "duration = 0.01\ndt = 0.05\n[water]\ndensity = 1000.0\nlevel = 0.0\n[[body]]\nname = \"load\"\nshape = {{ ball = 0.1 }}\nmass = 5.0\nposition = [{:?}, 0.0, 0.0]\n\
             [[body]]\nname = \"wheel\"\nkind = \"kinematic\"\nshape = \"none\"\nposition = [0.0, 9.0, 0.0]\nangular_velocity = [0.0, {spin:?}, 0.0]\n\
             [[cable]]\nname = \"rope\"\npoints = [[{x:?}, {height:?}, 0.0], [{:?}, {height:?}, 0.0]]\n\
             section = {{ round = 0.02 }}\ndensity = 1100.0\nyoungs_modulus = 1e8\nbuoyancy = {{ added_mass = {added:?} }}\n\
             [[attachment]]\ncable = \"rope\"\nat = \"start\"\nbody = \"world\"\n\
             [[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"load\"\nanchor = [0.0, {height:?}, 0.0]\ngap = \"close\"\n",
            x + 2.0,
            x + 2.0
        )
    };
    let kinds = |text: &str| -> Vec<&str> {
        let kind = |w: &Warning| match w {
            Warning::FarFromOrigin { .. } => "far",
            Warning::FastSpin { .. } => "spin",
            Warning::AddedMassInAir { share, added_kg, .. } => {
                assert!(
                    *share == 1.0 && (added_kg / (1e3 * std::f64::consts::PI * 1e-4 * 2.0) - 1.0).abs() < 0.03,
                    "{w}"
                );
                "air"
            }
            _ => "",
        };
        let scene = Scene::parse("scene.toml", text, &[], Purpose::Run).unwrap();
        scene.warnings(Purpose::Run).iter().map(kind).filter(|kind| !kind.is_empty()).collect()
    };
    let none = Vec::<&str>::new();
    assert_eq!(kinds(&text(0.0, 60.0, -0.5, 1.0)), none);
    assert_eq!(kinds(&text(0.0, 66.0, -0.5, 1.0)), ["spin"]);
    assert_eq!(kinds(&text(2e3, 0.0, -0.5, 1.0)), ["far"]);
    assert_eq!(kinds(&text(0.0, 0.0, 0.5, 1.0)), ["air"]);
    assert_eq!(kinds(&text(0.0, 0.0, 0.5, 0.0)), none);
}

/// A diameter of drag in mm, a current in knots, strains of a curve in percent and water in g/cm^3 are told, once each; what is right is not.
#[test]
fn fluids_and_curves_in_other_measures_are_told() {
    let text = |diameter: f64, current: f64, density: f64, scale: f64| {
        let rows = [[0.0, 0.0], [0.05, 3e3], [0.1, 9e3], [0.2, 3e4]].map(|[strain, force]| [scale * strain, force]);
        format!(
            "duration = 0.01\n[water]\ndensity = {density:?}\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, -9.0], [8.0, 0.0, -9.0]]\n\
             axial_stiffness = 3e5\nbending_stiffness = 0.1\nmass_per_length = 0.4\naxial_law = {{ curve = {rows:?} }}\n\
             drag = {{ fluid_density = 1025.0, diameter = {diameter:?}, normal = 1.2, flow = {{ velocity = [0.0, {current:?}, 0.0] }} }}\n\
             [[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\n"
        )
    };
    let kinds = |diameter: f64, current: f64, density: f64, scale: f64| -> Vec<&str> {
        let kind = |w: &Warning| match w {
            Warning::Cable(CableWarning::ThickDrag { .. }) => "diameter",
            Warning::Cable(CableWarning::FastFlow { is_liquid: true, .. }) => "current",
            Warning::Cable(CableWarning::SoftCurve { .. }) => "curve",
            Warning::LightWater { .. } => "water",
            _ => "",
        };
        let warnings = warned(&text(diameter, current, density, scale), Purpose::Run);
        warnings.iter().map(kind).filter(|kind| !kind.is_empty()).collect()
    };
    assert!(kinds(0.012, 2.0, 1025.0, 1.0).is_empty() && kinds(1.4, 11.0, 700.0, 2.0).is_empty());
    assert_eq!(kinds(12.0, 2.0, 1025.0, 1.0), ["diameter"]);
    assert_eq!(kinds(0.012, 30.0, 1025.0, 1.0), ["current"]);
    assert_eq!(kinds(0.012, 2.0, 1.025, 1.0), ["water"]);
    assert_eq!(kinds(0.012, 2.0, 1025.0, 100.0), ["curve"]);
}

/// A path whose rows lie between host times: told where the motion that they describe is off the straight way by more than 2 % of its
/// extent, with a step that would do; and not where the rows are on host times, or lie on the way.
///
/// *Source.* The sagitta of a sine: `A (1 - cos(pi dt/T))`, of an extent of 2 A.
#[test]
fn a_path_that_the_host_steps_do_not_sample_is_told() {
    let told = |dt: f64, period: f64, amplitude: f64| {
        let rows = (0..=400).map(|k| 0.01 * f64::from(k) * period);
        let rows =
            rows.map(|t| format!("[{t:?}, 0.0, {:?}, 0.0]", amplitude * (std::f64::consts::TAU * t / period).sin()));
        let rows = rows.collect::<Vec<_>>().join(", ");
        let text = format!(
            "duration = {:?}\ndt = {dt:?}\n[[body]]\nname = \"vessel\"\nkind = \"kinematic\"\nshape = \"none\"\npath = [{rows}]\n[[cable]]\nname = \"line\"\npoints = [[0.0, \
             0.0, 0.0], [9.0, 0.0, 0.0]]\nsection = {{ wire_rope = 0.02 }}\n[[attachment]]\ncable = \"line\"\nat = \"start\"\nbody = \"vessel\"\n",
            3.0 * period
        );
        let scene = Scene::parse("scene.toml", &text, &[], Purpose::Run).unwrap();
        let found = scene.warnings(Purpose::Run).into_iter().find_map(|warning| match warning {
            Warning::CoarsePath { lost_m, longest_s, .. } => Some((lost_m, longest_s)),
            _ => None,
        });
        let sagitta = amplitude * (1.0 - (std::f64::consts::PI * dt / period).cos());
        if let Some((lost, longest)) = found {
            assert!(lost < 1.05 * sagitta && longest < dt, "{dt}: {lost} of {sagitta}, {longest}");
        }
        (found.is_some(), sagitta / (2.0 * amplitude))
    };
    for (dt, period, amplitude) in [
        (5.0, 10.0, 2.0),
        (1.5, 10.0, 2.0),
        (0.4, 10.0, 2.0),
        (1.0 / 60.0, 0.1, 0.01),
        (1.0 / 60.0, 0.5, 0.3),
        (0.05, 8.0, 30.0),
    ] {
        let (told, share) = told(dt, period, amplitude);
        assert!(told == (share > 0.02), "{dt} s of {period} s: {share}, told {told}");
    }
}
