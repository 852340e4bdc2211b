//! The page as a file: it is written however the run ends, has the results of the run, and loads nothing.

use base64::Engine as _;
use lariat_scene::run::{self, Options};
use lariat_scene::{Error, Purpose, Scene, view};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

pub fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../assets/scenes/{name}.toml"))
}

/// Runs a scene into a temporary folder.
pub fn page_of(name: &str, sets: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let sets: Vec<String> = sets.iter().map(ToString::to_string).collect();
    let scene = Scene::read(&scene(name), &sets, Purpose::Run).unwrap();
    run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    folder
}

/// The data of a page.
pub struct Data(pub serde_json::Value);

impl Data {
    fn read(folder: &Path) -> Data {
        Self::of(&fs::read_to_string(folder.join("view.html")).unwrap())
    }

    pub fn of(text: &str) -> Data {
        let (_, rest) = text.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
        Data(serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap())
    }

    fn bytes(text: &serde_json::Value) -> Vec<u8> {
        base64::engine::general_purpose::STANDARD.decode(text.as_str().unwrap()).unwrap()
    }

    pub fn doubles(text: &serde_json::Value) -> Vec<f64> {
        Self::bytes(text).chunks_exact(8).map(|x| f64::from_le_bytes(x.try_into().unwrap())).collect()
    }

    pub fn times(&self) -> Vec<f64> {
        Self::doubles(&self.0["times"])
    }

    pub fn frames(&self) -> Vec<f32> {
        Self::bytes(&self.0["frames"]).chunks_exact(4).map(|x| f32::from_le_bytes(x.try_into().unwrap())).collect()
    }
}

fn last_row(file: &Path) -> Vec<f64> {
    fs::read_to_string(file).unwrap().lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect()
}

/// The tip in the last frame is the tip of the last row, to single precision; the rows in the page are those of the files, to the bit.
#[test]
fn the_page_has_what_the_run_wrote() {
    let folder = page_of("payload_pendulum", &["duration=0.5"]);
    let (data, probes) = (Data::read(folder.path()), folder.path().join("probes"));
    assert_eq!(data.times().len(), 31);
    assert_eq!((data.times()[0], data.times()[30]), (0.0, 0.5));
    let numbers = data.frames();
    // one part: its cable, its number of nodes, 11 nodes with 9 numbers each; one body with 7
    let frame = 3 + 11 * 9 + 7;
    assert_eq!(numbers.len(), 31 * frame);
    assert!(numbers.iter().all(|x| x.is_finite()));
    let last = &numbers[30 * frame..];
    let body: Vec<f32> = last_row(&probes.join("crate.csv"))[1..8].iter().map(|&x| x as f32).collect();
    assert_eq!((&last[..3], &last[102..]), (&[1.0, 0.0, 11.0][..], &body[..]));
    let pull = last_row(&probes.join("hook.csv"));
    let pull = pull[1].hypot(pull[2]) as f32;
    let tension = last[3 + 10 * 9 + 7];
    assert!((tension / pull - 1.0).abs() < 0.1, "{tension} N at the end, {pull} N at the hook");
    for probe in data.0["probes"].as_array().unwrap() {
        let rows = Data::doubles(&probe["rows"]);
        let text = fs::read_to_string(probes.join(format!("{}.csv", probe["name"].as_str().unwrap()))).unwrap();
        let file: Vec<f64> = text.lines().skip(1).flat_map(|l| l.split(',')).map(|x| x.parse().unwrap()).collect();
        assert!(rows.iter().map(|x| x.to_bits()).eq(file.iter().map(|x| x.to_bits())), "{}", probe["name"]);
    }
}

#[test]
fn a_long_run_keeps_to_the_limits_of_frames_and_rows_and_has_its_last_state() {
    let light = "cable.pendulum.integrator={ method = \"generalised-alpha-0\", substeps = 1 }";
    let folder = page_of("falling_pendulum", &["duration=25.0", "cable.pendulum.elements=2", light]);
    let data = Data::read(folder.path());
    let times = data.times();
    assert!(times.len() > view::FRAMES / 2 && times.len() <= view::FRAMES + 1, "{}", times.len());
    assert_eq!((times[0], times.last()), (0.0, Some(&25.0)));
    let rows = Data::doubles(&data.0["probes"][0]["rows"]).len() / 13;
    assert!(rows > view::ROWS / 2 && rows <= view::ROWS + 1, "{rows}");
}

/// Every frame of a scene whose cable can touch has its contacts after the bodies: on a rope that sticks to a slope they carry its weight.
///
/// *Source.* Equilibrium of 1 m of 0.1 kg/m.
#[test]
fn frames_have_the_forces_of_contacts() {
    let folder = page_of("../contact/stick", &["duration=0.5"]);
    let data = Data::read(folder.path());
    assert_eq!(data.0["contacts"], true);
    let (numbers, bodies) = (data.frames(), data.0["bodies"].as_array().unwrap().len());
    let (mut at, mut carried, mut count) = (0, [0.0f32; 3], 0);
    for _ in data.times() {
        assert_eq!(numbers[at], 1.0);
        at += 3 + 9 * numbers[at + 2] as usize + 7 * bodies;
        (count, carried) = (numbers[at] as usize, [0.0; 3]);
        for contact in numbers[at + 1..at + 1 + 6 * count].chunks_exact(6) {
            (0..3).for_each(|x| carried[x] += contact[3 + x]);
        }
        at += 1 + 6 * count;
    }
    assert_eq!(at, numbers.len());
    assert!(count > 3);
    let off = carried[0].hypot(carried[1] - 0.981).hypot(carried[2]);
    assert!(off < 1e-3 * 0.981, "{carried:?}");
}

/// A straight twisted cable: along it runs a stripe whose turn from end to end is the twist; a page without torsion has none.
///
/// *Source.* A uniform twist.
#[test]
fn frames_have_the_stripe_of_a_twisted_cable() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("twisted.toml");
    let text = r#"
        duration = 0.1
        gravity = [0, 0, 0]
        [[cable]]
        name = "rope"
        points = [[0, 0, 0], [1, 0, 0]]
        axial_stiffness = 1e4
        bending_stiffness = 0.03
        mass_per_length = 0.1
        elements = 4
        torsion = { stiffness = 0.02, initial_twist = 0.4 }
        [[attachment]]
        cable = "rope"
        at = "start"
        body = "world"
        kind = "clamp"
        [[attachment]]
        cable = "rope"
        at = "end"
        body = "world"
        kind = "clamp"
    "#;
    fs::write(&file, text).unwrap();
    let scene = Scene::read(&file, &[], Purpose::Run).unwrap();
    run::run(&scene, &folder.path().join("out"), &mut Options::default()).unwrap();
    let data = Data::read(&folder.path().join("out"));
    assert_eq!(data.0["stripes"], true);
    let (numbers, frames) = (data.frames(), data.times().len());
    let frame = 1 + 2 + (9 + 4) * 5;
    assert_eq!(numbers.len(), frame * frames);
    for numbers in numbers.chunks_exact(frame) {
        let stripe: Vec<&[f32]> = numbers[frame - 20..].chunks_exact(4).collect();
        for (i, node) in stripe.iter().enumerate() {
            assert!((node[3] / (0.4 * std::f32::consts::TAU) - 1.0).abs() < 1e-5, "{node:?}");
            // about x
            let cross = stripe[0][1] * node[2] - stripe[0][2] * node[1];
            let turned = cross.atan2(stripe[0][1] * node[1] + stripe[0][2] * node[2]);
            let off = turned - 0.1 * std::f32::consts::TAU * i as f32;
            assert!(node[0].abs() < 1e-6 && off.abs() < 1e-5, "{i}: {node:?}");
        }
    }
    assert_eq!(Data::read(page_of("falling_pendulum", &["duration=0.1"]).path()).0["stripes"], false);
}

#[test]
fn statics_have_one_frame() {
    let folder = tempfile::tempdir().unwrap();
    let catenary = Scene::read(&scene("catenary"), &[], Purpose::Static).unwrap();
    run::statics(&catenary, folder.path(), &mut run::Options::default()).unwrap();
    assert_eq!(Data::read(folder.path()).times(), [0.0]);
}

/// A run that fails, and one that is stopped: the page has every state until then, and the reason.
#[test]
fn a_run_that_ends_early_leaves_its_page() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(scene("falling_pendulum")).unwrap()
        + "\n[[load]]\ncable = \"pendulum\"\nat = \"end\"\nforce = [3.0e5, 0.0, 0.0]\nramp = 1.0\n";
    let sets = ["cable.pendulum.integrator={ method = \"verlet\", stable = 0.9 }".to_string()];
    let scene = Scene::parse("stretched.toml", &text, &sets, Purpose::Run).unwrap();
    let error = run::run(&scene, folder.path(), &mut Options::default()).unwrap_err();
    let data = Data::read(folder.path());
    assert_eq!(data.0["summary"]["failed"].as_str(), Some(error.to_string().as_str()));
    assert!(data.times().len() > 2 && data.frames().iter().all(|x| x.is_finite()));
    let tip = last_row(&folder.path().join("probes/tip.csv"));
    assert!((data.times().last().unwrap() - tip[0]).abs() < 1e-9);

    let mut options = Options::default();
    let stop = options.stop.clone();
    let mut at_half = |time: f64| stop.store(time > 0.5, Ordering::Relaxed);
    options.progress = Some(&mut at_half);
    let scene = Scene::parse("stopped.toml", &text, &[], Purpose::Run).unwrap();
    let error = run::run(&scene, folder.path(), &mut options).unwrap_err();
    assert!(matches!(error, Error::Interrupted { .. }), "{error}");
    assert_eq!(Data::read(folder.path()).times().last(), Some(&0.51));
}

/// The name of a scene is any text; the page stays valid. Its policy forbids all loading.
#[test]
fn no_name_breaks_the_page_and_nothing_is_loaded() {
    let folder = page_of("falling_pendulum", &["duration=0.02", r#"name="</script><!-- @DATA@ @SCRIPT@ &""#]);
    let text = fs::read_to_string(folder.path().join("view.html")).unwrap();
    assert!(text.contains("<title>&lt;/script>&lt;!-- @DATA@ @SCRIPT@ &amp;</title>"));
    assert_eq!(Data::read(folder.path()).0["name"], "</script><!-- @DATA@ @SCRIPT@ &");
    assert_eq!((text.matches("<script").count(), text.matches("</script>").count()), (3, 3));
    assert!(text.contains("default-src 'none'") && !text.contains("src=\"") && !text.contains("@import"));
}

/// Plots are made by the names of columns: every name has its quantity or follows one that has.
///
/// *Source.* The files of probes in docs/scene.md, which the test of the command compares with
/// files.
#[test]
fn the_page_knows_the_columns_of_every_probe() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let script = fs::read_to_string(root.join("assets/view/plots.js")).unwrap();
    let page = fs::read_to_string(root.join("../../docs/scene.md")).unwrap();
    let (_, table) = page.split_once("| probe of | columns |").unwrap();
    let rows = table.lines().skip(2).take_while(|line| line.starts_with('|'));
    let mut probes = 0;
    for row in rows {
        let columns = row.split('`').nth(1).unwrap();
        let first = columns.split(',').nth(1).unwrap();
        assert!(columns.starts_with("t,") && script.contains(&format!(" {first}: [")), "{columns}");
        probes += 1;
    }
    assert_eq!(probes, 8);
}

/// A page that is a link is not written through.
#[cfg(target_os = "linux")]
#[test]
fn a_page_that_is_a_link_is_in_the_way() {
    let folder = tempfile::tempdir().unwrap();
    let link = folder.path().join("view.html");
    std::os::unix::fs::symlink("/dev/full", &link).unwrap();
    let catenary = Scene::read(&scene("catenary"), &[], Purpose::Static).unwrap();
    let error = run::statics(&catenary, folder.path(), &mut run::Options::default()).unwrap_err();
    assert!(matches!(error, Error::InTheWay { .. }) && error.to_string().contains("view.html"), "{error}");
    assert_eq!(fs::read_link(link).unwrap(), std::path::Path::new("/dev/full"));
}
