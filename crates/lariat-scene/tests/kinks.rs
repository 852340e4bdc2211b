//! `kinks` of a cable: its slope is free on both sides of a load, a junction or a ball attachment.

use lariat_scene::run::{Options, Recording, World, collect};
use lariat_scene::{Error, Purpose, Scene, Warning};

fn parse(text: &str, purpose: Purpose) -> Result<Scene, Error> {
    Scene::parse("scene.toml", text, &[], purpose)
}

fn run(text: &str, purpose: Purpose) -> Recording {
    let run = collect(&parse(text, purpose).unwrap(), purpose, &mut Options::default()).unwrap();
    assert!(run.failed.is_none(), "{:?}", run.failed);
    run
}

/// Columns of the last row of a probe.
fn last<const N: usize>(run: &Recording, probe: &str, from: usize) -> [f64; N] {
    let probe = run.probes.iter().find(|p| p.name == probe).unwrap();
    let row = probe.rows.chunks(probe.columns.len()).last().unwrap();
    core::array::from_fn(|k| row[from + k])
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

const LENGTH: f64 = 11.0;
const AT: f64 = 4.0;

/// A cable of 11 m between pins that are 10 m apart, with a force at 4 m.
fn loaded(elements: usize, kinks: &str, bending: f64) -> String {
    let probes: String = [1.0, 2.5, AT, 6.0, 9.0]
        .iter()
        .map(|s| format!("[[probe]]\nname = \"at {s}\"\ncable = \"line\"\nat = {s:?}\n"))
        .collect();
    format!(
        "duration = 0.5\ndt = 0.01\n[[cable]]\nname = \"line\"\npoints = [[0.0, 0.0, 0.0], [3.6, -2.0, 0.0], [10.0, 0.0, 0.0]]\nlength = {LENGTH:?}\n\
         elements = {elements}\naxial_stiffness = 1e5\nbending_stiffness = {bending:?}\nmass_per_length = 1.0\naxial_law = \"hooke\"\n{kinks}\
         [[attachment]]\nname = \"left\"\ncable = \"line\"\nat = \"start\"\nbody = \"world\"\nanchor = [0.0, 0.0, 0.0]\n\
         [[attachment]]\nname = \"right\"\ncable = \"line\"\nat = \"end\"\nbody = \"world\"\nanchor = [10.0, 0.0, 0.0]\n\
         [[load]]\ncable = \"line\"\nat = {AT:?}\nforce = [0.0, -100.0, 0.0]\n{probes}"
    )
}

/// Positions of the five points.
fn points(run: &Recording) -> Vec<[f64; 3]> {
    ["at 1", "at 2.5", "at 4", "at 6", "at 9"].iter().map(|name| last(run, name, 1)).collect()
}

fn off(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max)
}

/// The five points of a cable without stiffness: two elastic catenaries.
///
/// *Source.* Irvine 1981, section 2.3: `x = H s/EA + H/w (asinh(V/H) - asinh((V - w s)/H))`, `y = s/EA (V - w s/2) + H/w
/// (sqrt(1 + (V/H)^2) - sqrt(1 + ((V - w s)/H)^2))`, downwards, with V that of the left pin; beyond the load V is less by P.
fn catenaries() -> Vec<[f64; 3]> {
    let (w, ea, p) = (9.81, 1e5, 100.0);
    let over = |h: f64, v: f64, s: f64| {
        let (a, b) = (v / h, (v - w * s) / h);
        let x = h * s / ea + h / w * (a.asinh() - b.asinh());
        let y = s / ea * (v - 0.5 * w * s) + h / w * ((1.0 + a * a).sqrt() - (1.0 + b * b).sqrt());
        [x, -y]
    };
    let place = |h: f64, v: f64, s: f64| {
        let [x, y] = over(h, v, s.min(AT));
        if s <= AT {
            return [x, y, 0.0];
        }
        let [dx, dy] = over(h, v - w * AT - p, s - AT);
        [x + dx, y + dy, 0.0]
    };
    let (mut h, mut v) = (80.0, 100.0);
    for _ in 0..100 {
        let miss = |h: f64, v: f64| {
            let end = place(h, v, LENGTH);
            [end[0] - 10.0, end[1]]
        };
        let (f, d) = (miss(h, v), 1e-5);
        let (fh, fv) = (miss(h + d, v), miss(h, v + d));
        let j = [[(fh[0] - f[0]) / d, (fv[0] - f[0]) / d], [(fh[1] - f[1]) / d, (fv[1] - f[1]) / d]];
        let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        h -= (f[0] * j[1][1] - f[1] * j[0][1]) / det;
        v -= (f[1] * j[0][0] - f[0] * j[1][0]) / det;
    }
    [1.0, 2.5, AT, 6.0, 9.0].iter().map(|s| place(h, v, *s)).collect()
}

/// A stiffness that does nothing, and with which a cable has the kinks alone that are given.
const LITTLE: f64 = 1e-9;

/// Without stiffness positions converge with the second order at least, by kinks that are given or found; without kinks with the first.
#[test]
fn a_loaded_limp_cable_converges_with_the_second_order() {
    let exact = catenaries();
    let errors = |kinks: &str, bending: f64| -> Vec<f64> {
        let error = |n| off(&points(&run(&loaded(n, kinks, bending), Purpose::Static)), &exact);
        [2, 4, 8, 16, 32].into_iter().map(error).collect()
    };
    let (with, without) = (errors("kinks = [4.0]\n", 0.0), errors("", LITTLE));
    assert_eq!(errors("", 0.0), with);
    println!("with {with:?}, without {without:?}");
    for pair in with.windows(2).filter(|pair| pair[0] > 1e-5) {
        assert!((pair[0] / pair[1]).log2() >= 1.9, "{with:?}");
    }
    assert!(with[4] < 2e-6 && with[2] < 0.1 * without[2], "{with:?} {without:?}");
}

/// With stiffness the hinge is off by what the stiffness does, which falls with `sqrt(EI/T)`: below an element it is the smaller error. Where it
/// is told, the mesh that the warning names takes nine tenths of it away, or more.
///
/// *Source.* The same cable with 640 elements and a mesh that is fine at the load.
#[test]
fn a_kink_is_better_than_a_mesh_that_does_not_resolve_the_corner() {
    let h = LENGTH / 8.0;
    let mut rows = Vec::new();
    for share in [0.01, 0.03, 0.1, 0.3, 1.0, 3.0] {
        // the tension is about 120 N at the load
        let bending = 120.0 * (share * h) * (share * h);
        let fine = loaded(640, "", bending)
            .replace("elements = 640", "elements = { count = 640, finest = 0.002, at = [4.0] }");
        let exact = points(&run(&fine, Purpose::Static));
        let [with, without] = ["kinks = [\"36.36363636363636 %\"]\n", ""]
            .map(|kinks| off(&points(&run(&loaded(8, kinks, bending), Purpose::Static)), &exact));
        let warnings = run(&loaded(8, "kinks = [4.0]\n", bending), Purpose::Static).summary.warnings;
        let advised = warnings.iter().find_map(|warning| match warning {
            Warning::StiffKink { mesh, .. } => Some(mesh.clone()),
            _ => None,
        });
        let told = advised.is_some();
        if let Some(mesh) = advised {
            let text = loaded(8, "", bending).replace("elements = 8", &format!("elements = {mesh}"));
            let left = off(&points(&run(&text, Purpose::Static)), &exact);
            println!("{mesh}: {left:.1e} m");
            assert!(left < 0.1 * with, "{mesh}: {left} for {with}");
        }
        println!("sqrt(EI/T) = {share} h: with {with:.1e} m, without {without:.1e} m, told {told}");
        rows.push((share, with, without, told));
    }
    for (share, with, without, told) in &rows {
        assert!(*share > 0.03 || with < without, "{rows:?}");
        // 2e-3 of the length
        assert!(*told || *with < 0.022, "{rows:?}");
        assert!(*share > 0.01 || !told, "{rows:?}");
    }
}

/// The mesh that statics choose is right to 5e-4 of the length whatever the stiffness, from a hinge to a beam, and whatever the even mesh; and moves.
///
/// *Source.* The same cable with 640 elements and a mesh that is fine at the load; with a kink there without stiffness.
#[test]
fn a_mesh_that_statics_choose_is_right_at_any_stiffness() {
    let h = LENGTH / 8.0;
    for share in [0.0, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0] {
        let bending = 120.0 * (share * h) * (share * h);
        let fine = loaded(640, "", bending);
        let exact = match share {
            0.0 => points(&run(&loaded(1024, "kinks = [4.0]\n", bending), Purpose::Static)),
            _ => {
                let fine = fine.replace("elements = 640", "elements = { count = 640, finest = 0.002, at = [4.0] }");
                points(&run(&fine, Purpose::Static))
            }
        };
        let mut errors = Vec::new();
        for elements in [4, 8, 16, 32] {
            let mesh = format!("elements = {{ count = {elements}, finest = \"auto\" }}");
            let text = loaded(elements, "", bending).replace(&format!("elements = {elements}"), &mesh);
            let chosen = run(&text, Purpose::Static);
            let told = chosen
                .summary
                .warnings
                .iter()
                .any(|w| matches!(w, Warning::StiffKink { .. } | Warning::CoarseTension { .. }));
            assert!(!told, "{:?}", chosen.summary.warnings);
            errors.push(off(&points(&chosen), &exact));
            if elements == 8 {
                run(&text, Purpose::Run);
                // a program that builds the world has the same mesh
                let world = World::build(&parse(&text, Purpose::Static).unwrap()).unwrap();
                let built: Vec<usize> = world.cables().iter().map(|cable| cable.elements().len()).collect();
                let chosen: Vec<usize> = chosen.world.cables().iter().map(|cable| cable.elements().len()).collect();
                assert!(
                    built == chosen && (share >= 1.0 || built.iter().sum::<usize>() != 8 || built.len() > 1),
                    "{built:?} {chosen:?}"
                );
            }
        }
        println!("sqrt(EI/T) = {share} h: {errors:?} m");
        // a beam wants more than four
        assert!(errors[usize::from(share >= 1.0)..].iter().all(|error| *error < 5e-4 * LENGTH), "{share}: {errors:?}");
    }
}

/// A net of taut stiff cables on even elements is told with its tension on a finer mesh, and the mesh that the warning names is right. A hanging
/// cable, whose sag gives way, is not told; nor one on a mesh that is fine.
///
/// *Source.* The same net with 160 elements per cable, and fine at the crossings.
#[test]
fn a_tension_that_the_mesh_makes_is_told() {
    let net = |mesh: &str, load: f64| {
        let mut text = String::new();
        for (name, x, y, z) in [("a", 6.0, 0.6, 0.0), ("b", 0.0, -0.6, 6.0)] {
            text += &format!(
                "[[cable]]\nname = \"{name}\"\npoints = [[{:?}, {y:?}, {:?}], [0.0, 0.0, 0.0], [{x:?}, {y:?}, {z:?}]]\nelements = {mesh}\naxial_stiffness = 6.6e6\n\
                 bending_stiffness = 10.0\nmass_per_length = 0.55\nlength = {:?}\n",
                -x,
                -z,
                2.0 * 36.36f64.sqrt() / 1.001
            );
            for at in ["start", "end"] {
                text += &format!("[[attachment]]\ncable = \"{name}\"\nat = \"{at}\"\nbody = \"world\"\n");
            }
        }
        text += "[[junction]]\ncable = \"a\"\nat = \"50 %\"\nother = \"b\"\nother_at = \"50 %\"\n";
        text += &format!("[[load]]\ncable = \"a\"\nat = \"50 %\"\nforce = [0.0, {:?}, 0.0]\n", -load);
        text += "[[probe]]\nname = \"b\"\ncable = \"b\"\nat = \"25 %\"\n";
        let found = run(&text, Purpose::Static);
        let told = found.summary.warnings.iter().find_map(|warning| match warning {
            Warning::CoarseTension { cable, fine_n, tension_n, .. } if cable == "b" => Some([*tension_n, *fine_n]),
            _ => None,
        });
        (last::<1>(&found, "b", 10)[0], told)
    };
    for load in [500.0, 2000.0] {
        let (exact, told) = net("{ count = 160, finest = 0.01, at = [\"50 %\"] }", load);
        assert_eq!(told, None);
        for elements in [4, 8, 16, 64] {
            let (even, told) = net(&elements.to_string(), load);
            let (chosen, untold) = net(&format!("{{ count = {elements}, finest = \"auto\" }}"), load);
            println!("{load} N, {elements} elements: {even:.0} of {exact:.0} N, told {told:?}, chosen {chosen:.0}");
            assert!((chosen / exact - 1.0).abs() < 0.01 && untold.is_none(), "{chosen} of {exact}, {untold:?}");
            match told {
                Some([_, fine]) => assert!((fine / exact - 1.0).abs() < 0.02, "{fine} of {exact}"),
                None => assert!((even / exact - 1.0).abs() < 0.12, "{even} of {exact}"),
            }
        }
    }
    let even = run(&loaded(8, "", 1e-3), Purpose::Static).summary.warnings;
    assert!(!even.iter().any(|warning| matches!(warning, Warning::CoarseTension { .. })), "{even:?}");
}

/// What statics choose is chosen by them alone.
#[test]
fn chosen_points_are_not_given() {
    let text = loaded(8, "", 1.0).replace("elements = 8", "elements = { count = 8, finest = \"auto\", at = [4.0] }");
    let error = parse(&text, Purpose::Static).unwrap_err().to_string();
    assert!(error.contains("cable.line.elements.at") && error.contains("auto"), "{error}");
    // a cable that falls has no equilibrium to choose by
    let falls = loaded(8, "", 1.0).replace("elements = 8", "elements = { count = 8, finest = \"auto\" }");
    let falls =
        format!("{}{}", &falls[..falls.find("[[attachment]]").unwrap()], &falls[falls.find("[[load]]").unwrap()..]);
    let error = collect(&parse(&falls, Purpose::Run).unwrap(), Purpose::Run, &mut Options::default());
    let error = error.err().expect("no mesh").to_string();
    assert!(error.contains("finest = \"auto\"") && error.contains("line"), "{error}");
}

/// Two cables without stiffness that cross at a junction, four elements each, with a load there.
///
/// *Source.* Symmetry and statics: four straight halves without weight carry P = 4 T sin(a), and stretch to `cos(a) = l/(1 + T/EA)` of
/// their length l; with weight, the same scene with 64 elements each.
#[test]
fn a_net_of_two_by_two_is_right_with_four_elements() {
    let net = |elements: &str, kinks: bool, bending: f64| {
        let mut text = "engine = \"rapier\"\n".to_string();
        let lines = [("a", 1.0, 0.0), ("b", 1.0, 1.0), ("c", 0.0, 0.0), ("d", 0.0, 1.0)];
        for (name, along, k) in lines {
            let (x, z) = if along == 1.0 { ([-1.5, 1.5], [k - 0.5; 2]) } else { ([k - 0.5; 2], [-1.5, 1.5]) };
            text += &format!(
                "[[cable]]\nname = \"{name}\"\npoints = [[{:?}, 0.0, {:?}], [{:?}, 0.0, {:?}]]\nelements = {elements}\naxial_stiffness = 1e4\n\
                 bending_stiffness = {bending:?}\nmass_per_length = 0.05\n{}",
                x[0],
                z[0],
                x[1],
                z[1],
                if kinks { "kinks = [1.0, 2.0]\n" } else { "" }
            );
            for at in ["start", "end"] {
                text += &format!("[[attachment]]\ncable = \"{name}\"\nat = \"{at}\"\nbody = \"world\"\n");
            }
        }
        for (i, first) in ["a", "b"].iter().enumerate() {
            for (k, other) in ["c", "d"].iter().enumerate() {
                text += &format!(
                    "[[junction]]\ncable = \"{first}\"\nat = {:?}\nother = \"{other}\"\nother_at = {:?}\n",
                    k as f64 + 1.0,
                    i as f64 + 1.0
                );
                text +=
                    &format!("[[load]]\ncable = \"{first}\"\nat = {:?}\nforce = [0.0, -20.0, 0.0]\n", k as f64 + 1.0);
                text +=
                    &format!("[[probe]]\nname = \"{first}{other}\"\ncable = \"{first}\"\nat = {:?}\n", k as f64 + 1.0);
            }
        }
        let run = run(&text, Purpose::Static);
        ["ac", "ad", "bc", "bd"].map(|name| last::<3>(&run, name, 1)).to_vec()
    };
    let exact = net("96", true, 0.0);
    let [with, without] = [(true, 0.0), (false, LITTLE)].map(|(kinks, bending)| off(&net("4", kinks, bending), &exact));
    let [found, auto] =
        ["4", "{ count = 4, finest = \"auto\" }"].map(|elements| off(&net(elements, false, 0.0), &exact));
    assert!((auto - found).abs() < 1e-9, "{auto} {found}");
    println!(
        "net of 2 x 2: sag {:.4} m, off by {with:.1e} m with kinks, {found:.1e} m with those found, {without:.1e} m without",
        exact[0][1]
    );
    assert!(with < 1e-4 && without > 3.0 * with && (found - with).abs() < 1e-9, "{with} {found} {without}");
}

/// A net of ten by ten limp cables with a load at each of its hundred crossings is right with eleven elements per cable.
///
/// *Source.* The same scene with four times as many; and equilibrium: its supports carry the loads and the weight.
#[test]
fn a_net_of_ten_by_ten_is_right_with_an_element_per_mesh() {
    let net = |elements: &str, kinks: bool, bending: f64| {
        let mut text = "engine = \"rapier\"\n".to_string();
        let crossings: Vec<String> = (1..11).map(|k| format!("{:?}", f64::from(k))).collect();
        let kinks = if kinks { format!("kinks = [{}]\n", crossings.join(", ")) } else { String::new() };
        for k in 1..11 {
            for (name, a, b) in [("x", [0, k], [11, k]), ("z", [k, 0], [k, 11])] {
                text += &format!(
                    "[[cable]]\nname = \"{name}{k}\"\npoints = [[{}.0, 0.0, {}.0], [{}.0, 0.0, {}.0]]\nelements = {elements}\naxial_stiffness = 1e4\n\
                     bending_stiffness = {bending:?}\nmass_per_length = 0.05\n{kinks}",
                    a[0], a[1], b[0], b[1]
                );
                for at in ["start", "end"] {
                    text += &format!("[[attachment]]\ncable = \"{name}{k}\"\nat = \"{at}\"\nbody = \"world\"\n");
                }
            }
        }
        for x in 1..11 {
            for z in 1..11 {
                text += &format!("[[junction]]\ncable = \"x{z}\"\nat = {x}.0\nother = \"z{x}\"\nother_at = {z}.0\n");
                text += &format!("[[load]]\ncable = \"x{z}\"\nat = {x}.0\nforce = [0.0, -20.0, 0.0]\n");
            }
        }
        for k in [1, 3, 5, 6, 8, 10] {
            text += &format!("[[probe]]\nname = \"{k}\"\ncable = \"x{k}\"\nat = 5.0\n");
        }
        let run = run(&text, Purpose::Static);
        [1, 3, 5, 6, 8, 10].map(|k| last::<3>(&run, &k.to_string(), 1)).to_vec()
    };
    let exact = net("44", true, 0.0);
    let [with, without] =
        [(true, 0.0), (false, LITTLE)].map(|(kinks, bending)| off(&net("11", kinks, bending), &exact));
    let [found, auto] =
        ["11", "{ count = 11, finest = \"auto\" }"].map(|elements| off(&net(elements, false, 0.0), &exact));
    assert!((auto - found).abs() < 1e-9, "{auto} {found}");
    println!(
        "net of 10 x 10: sag {:.4} m, off by {with:.1e} m with kinks, {found:.1e} m with those found, {without:.1e} m without",
        exact[2][1]
    );
    assert!(with < 1e-4 && without > 10.0 * with && (found - with).abs() < 1e-9, "{with} {found} {without}");
    // symmetric
    assert!((exact[2][1] - exact[3][1]).abs() < 1e-6 && (exact[0][1] - exact[5][1]).abs() < 1e-6, "{exact:?}");
}

/// A limp cable that a ball attachment holds at 4 m: the force on it is that of both sides, and is the weight that hangs there.
///
/// *Source.* Newton's third law: the forces on all three attachments are the weight; convergence against 64 elements.
#[test]
fn an_attachment_holds_both_sides_of_a_kink() {
    let held = |elements: usize, kinks: &str| {
        let probes = ["left", "mid", "right"]
            .map(|name| format!("[[probe]]\nname = \"{name}\"\nattachment = \"{name}\"\n"))
            .concat();
        let text = loaded(elements, kinks, 0.0).replace("force = [0.0, -100.0, 0.0]", "force = [0.0, 0.0, 0.0]");
        let load = text.find("[[load]]").unwrap();
        let text = format!(
            "{}[[attachment]]\nname = \"mid\"\ncable = \"line\"\nat = 4.0\nbody = \"world\"\nanchor = [3.6, -0.2, 0.0]\n{}{probes}",
            &text[..load],
            &text[text[load..].find("[[probe]]").unwrap() + load..]
        );
        run(&text, Purpose::Static)
    };
    let exact = points(&held(128, "kinks = [4.0]\n"));
    let mut errors = Vec::new();
    for elements in [4, 8, 16] {
        let run = held(elements, "kinks = [4.0]\n");
        let forces = ["left", "mid", "right"].map(|name| last::<3>(&run, name, 1));
        let weight: f64 = forces.iter().map(|force| force[1]).sum();
        assert!((weight + 9.81 * LENGTH).abs() < 1e-6 * 9.81 * LENGTH, "{forces:?}");
        errors.push(off(&points(&run), &exact));
    }
    println!("{errors:?}, without {:e}", off(&points(&held(8, "")), &exact));
    assert!(errors.windows(2).all(|pair| (pair[0] / pair[1]).log2() > 1.9), "{errors:?}");
}

/// A run keeps the parts of a kinked cable together, and its readings count along all of it.
///
/// *Source.* The same run as two cables at a `[[junction]]`, bit for bit.
#[test]
fn a_kinked_cable_moves_as_two_cables_at_a_junction() {
    let kinked = loaded(11, "kinks = [4.0]\n", 0.01).replace("[[load]]", "[[load]]\nramp = 0.1");
    let head = "axial_stiffness = 1e5\nbending_stiffness = 0.01\nmass_per_length = 1.0\naxial_law = \"hooke\"\n";
    let drawn = 4.0 / 11.0;
    let all = 3.6f64.hypot(2.0) + 6.4f64.hypot(2.0);
    let share = drawn * all / 3.6f64.hypot(2.0);
    let text = format!(
        "duration = 0.5\ndt = 0.01\n[[cable]]\nname = \"a\"\npoints = [[0.0, 0.0, 0.0], {p}]\nlength = 4.0\nelements = 4\n{head}\
         [[cable]]\nname = \"b\"\npoints = [{p}, {q}[10.0, 0.0, 0.0]]\nlength = 7.0\nelements = 7\n{head}\
         [[junction]]\ncable = \"a\"\nat = \"end\"\nother = \"b\"\nother_at = \"start\"\n\
         [[attachment]]\ncable = \"a\"\nat = \"start\"\nbody = \"world\"\nanchor = [0.0, 0.0, 0.0]\n[[attachment]]\ncable = \"b\"\nat = \"end\"\nbody = \"world\"\nanchor = [10.0, 0.0, 0.0]\n\
         [[load]]\ncable = \"a\"\nat = \"end\"\nramp = 0.1\nforce = [0.0, -100.0, 0.0]\n[[probe]]\nname = \"at 6\"\ncable = \"b\"\nat = 2.0\n",
        p = format!("[{:?}, {:?}, 0.0]", 3.6 * share, -2.0 * share),
        q = if share < 1.0 { "[3.6, -2.0, 0.0], " } else { "" },
    );
    let (a, b) = (run(&kinked, Purpose::Run), run(&text, Purpose::Run));
    let rows = |run: &Recording| {
        let probe = run.probes.iter().find(|probe| probe.name == "at 6").unwrap();
        probe.rows.chunks(probe.columns.len()).map(|row| row[1..4].to_vec()).collect::<Vec<_>>()
    };
    let (a, b) = (rows(&a), rows(&b));
    let apart =
        a.iter().zip(&b).map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)).fold(0.0, f64::max);
    assert!(a.len() == 51 && apart < 1e-9, "{apart}");
}

/// What has no meaning at a kink is refused by its key.
#[test]
fn what_cannot_go_through_a_kink_is_refused() {
    let base = loaded(8, "kinks = [4.0]\n", 0.01);
    let refused = |text: &str, key: &str| match parse(text, Purpose::Run) {
        Err(error) => assert!(error.to_string().contains(key), "{key}: {error}"),
        Ok(_) => panic!("{key} is accepted"),
    };
    for (kinks, key) in
        [("[0.0]", "cable.line.kinks"), ("[4.0, 4.0]", "cable.line.kinks"), ("[12.0]", "kinks"), ("[\"end\"]", "kinks")]
    {
        refused(&base.replace("kinks = [4.0]", &format!("kinks = {kinks}")), key);
    }
    refused(&base.replace("kinks", "initial = \"equilibrium\"\nkinks"), "cable.line.initial");
    refused(&format!("engine = \"none\"\n{base}"), "kinks");
    refused(&base.replace("kinks", "torsion = { stiffness = 1.0 }\nkinks"), "torsion");
    refused(&base.replace("kinks", "contact = { radius = 0.01, itself = true }\nkinks"), "contact");
    refused(&base.replace("kinks", "break = { time = 0.1, at = 4.0 }\nkinks"), "break");
    let clamp = "[[attachment]]\nname = \"mid\"\ncable = \"line\"\nat = 4.0\nbody = \"world\"\nkind = \"clamp\"\n";
    refused(&format!("{base}{clamp}"), "both directions");
}

/// A kink that code makes is that of a scene.
///
/// *Source.* The points of the scene with `kinks`.
#[test]
fn a_kink_of_a_set_is_that_of_a_scene() {
    use lariat_ancf::{At, AxialLaw, Cable, Effects, PointLoad, Section};
    use lariat_rapier::CableSet;
    let mut cable = Cable::builder()
        .points([[0.0, 0.0, 0.0], [3.6, -2.0, 0.0], [10.0, 0.0, 0.0]])
        .length(LENGTH)
        .section(Section::from_stiffness(1e5, 0.0, 1.0).unwrap())
        .elements(8)
        .node_at(AT)
        .effects(Effects { axial_law: Some(AxialLaw::Hooke), ..Effects::default() })
        .fix(At::Start)
        .fix(At::End)
        .build()
        .unwrap();
    cable.add_load(PointLoad::force(AT, [0.0, -100.0, 0.0])).unwrap();
    let mut world = lariat_rapier::rapier::prelude::PhysicsWorld::new();
    let mut set = CableSet::new();
    let first = set.insert(cable);
    let (rest, junction) = set.add_kink(first, AT).unwrap();
    assert_eq!(set.junction(junction).unwrap().nodes().len(), 2);
    assert!(set.add_kink(first, At::End).is_err());
    set.equilibrium(&mut world).unwrap();
    let exact = catenaries();
    let place = |cable, s: f64| set.get(cable).unwrap().sample(s).unwrap().position.into();
    let found: Vec<[f64; 3]> =
        vec![place(first, 1.0), place(first, 2.5), place(first, AT), place(rest, 2.0), place(rest, 5.0)];
    let off = off(&found, &exact);
    println!("{off:e}");
    assert!(off < 1e-3, "{found:?} {exact:?}");
}
