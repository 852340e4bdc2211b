//! The page in a browser without network. Ignored by default, because it needs Chromium: `.ci/view` installs it and runs these.

use super::browser::Browser;
use super::page::{page_of, scene};
use lariat_scene::run::{self, Options};
use lariat_scene::{Purpose, Scene};
use std::path::Path;

const DRAWN: &str = "document.documentElement.dataset.drawn";
const FRAME: &str = "document.documentElement.dataset.frame";
/// Number of pixels of the scene that differ from the background.
const INK: &str = "(() => { const d = pen.getImageData(0, 0, canvas.width, canvas.height).data; let n = 0; \
                   for (let i = 4; i < d.length; i += 4) n += d[i] !== d[0] || d[i + 1] !== d[1] || d[i + 2] !== d[2]; return n; })()";

/// The pendulum: a frame for each host time, the slider at its end shows another picture, the mouse rotates and zooms, Play runs to
/// the end and stops, a click in a plot goes to its time, and the page reports no error.
#[test]
#[ignore = "needs Chromium: .ci/view"]
fn the_page_shows_the_run_and_its_controls_work() {
    let folder = page_of("falling_pendulum", &["duration=0.6"]);
    let mut page = Browser::start(1200, 800);
    page.open(&folder.path().join("view.html"));
    assert_eq!(page.ask("document.documentElement.dataset.frames"), "61");
    assert_eq!(page.ask("document.title"), "falling pendulum");
    assert!(page.ask(INK).parse::<u32>().unwrap() > 2000, "an empty picture");
    let (first, ink) = (page.ask(DRAWN), page.ask("canvas.toDataURL()"));
    page.ask("slider.focus()");
    page.call(
        "Input.dispatchKeyEvent",
        serde_json::json!({ "type": "keyDown", "key": "End", "code": "End", "windowsVirtualKeyCode": 35 }),
    );
    assert_eq!((page.ask(FRAME), page.ask("times[current]")), ("60".to_string(), "0.6".to_string()));
    assert_ne!(page.ask(DRAWN), first);
    assert_ne!(page.ask("canvas.toDataURL()"), ink);
    // the tip that is drawn is the last row of its probe
    let tip = "(() => { const [at, n] = frames[60].cables[0], p = data.probes[0].table; \
               return Math.hypot(numbers[at + 9 * (n - 1) + 1] - p[1][60], numbers[at + 9 * (n - 1) + 2] - p[2][60]); })()";
    assert!(page.ask(tip).parse::<f64>().unwrap() < 1e-6);

    let (x, y) = page.middle_of("scene");
    for (kind, dx) in [("mousePressed", 0.0), ("mouseMoved", 40.0), ("mouseMoved", 90.0), ("mouseReleased", 90.0)] {
        page.mouse(kind, x + dx, y + 0.3 * dx);
    }
    let turned = page.ask(DRAWN);
    assert!(page.ask("Math.abs(camera.yaw - 0.3)").parse::<f64>().unwrap() > 0.1);
    page.mouse("mouseWheel", x, y);
    assert_ne!(page.ask(DRAWN), turned);
    page.click("reset");
    assert_eq!(page.ask("camera.yaw"), "0.3");

    page.ask("document.getElementById('speed').value = '5'");
    page.click("play");
    assert_eq!(page.ask("document.documentElement.dataset.playing"), "true");
    let end = std::time::Instant::now() + std::time::Duration::from_secs(20);
    while page.ask("document.documentElement.dataset.playing") == "true" {
        assert!(std::time::Instant::now() < end, "the animation never ends");
    }
    assert_eq!(page.ask(FRAME), "60");
    // two sections are open: 6 plots of the tip and of the middle; the motion is in a plane, and z is not a curve
    assert!(page.ask("document.querySelector('.constant').textContent").contains("z = 0"));
    assert_eq!(page.ask("document.querySelectorAll('.uplot').length"), "14");
    page.ask("document.querySelector('.u-over').id = 'over'");
    page.click("over");
    let there = page.ask("times[current]").parse::<f64>().unwrap();
    assert!((there - 0.3).abs() < 0.02, "{there}");
    page.click("theme");
    assert!(page.complaints.is_empty(), "{:?}", page.complaints);
}

/// All shapes, statics, a run that fails at once: drawn without an error of the page.
#[test]
#[ignore = "needs Chromium: .ci/view"]
fn every_shape_and_every_kind_of_outcome_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("corner.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    )
    .unwrap();
    let mut text = std::fs::read_to_string(scene("falling_pendulum")).unwrap().replace("engine = \"none\"", "");
    for (i, shape) in [
        "{ cuboid = [0.2, 0.1, 0.3] }",
        "{ ball = 0.2 }",
        "{ cylinder = [0.3, 0.1] }",
        "{ capsule = [0.3, 0.1] }",
        "{ mesh = \"corner.obj\" }",
        "{ plane = [0.0, 1.0, 0.0] }",
        "{ plane = [1.0, 1.0, 0.0] }",
        "\"none\"",
    ]
    .iter()
    .enumerate()
    {
        let kind = ["kinematic", "fixed"][i % 2];
        text += &format!(
            "\n[[body]]\nname = \"b{i}\"\nkind = \"{kind}\"\nshape = {shape}\nposition = [{i}.0, -3.0, 3.0]\n"
        );
    }
    let file = folder.path().join("shapes.toml");
    std::fs::write(&file, text).unwrap();
    let sets = ["duration=0.05".to_string()];
    run::run(&Scene::read(&file, &sets, Purpose::Run).unwrap(), folder.path(), &mut Options::default()).unwrap();
    let mut page = Browser::start(1200, 800);
    page.open(&folder.path().join("view.html"));
    assert!(page.ask(INK).parse::<u32>().unwrap() > 5000);
    page.click("names");

    let catenary = |sets: &[String], purpose| Scene::read(&scene("catenary"), sets, purpose).unwrap();
    run::statics(&catenary(&[], Purpose::Static), folder.path(), &mut run::Options::default()).unwrap();
    page.open(&folder.path().join("view.html"));
    assert_eq!(page.ask("document.documentElement.dataset.frames"), "1");
    assert_eq!(page.ask("document.querySelectorAll('.uplot').length"), "0");
    for id in ["play", "slider", "pace"] {
        assert_eq!(page.ask(&format!("getComputedStyle(document.getElementById('{id}')).display")), "none", "{id}");
    }
    assert!(page.ask("document.getElementById('summary').textContent").contains("peak tension"));
    // it stretches without limit, and no equilibrium is found
    let limp = ["cable.line.axial_stiffness=1e-9".to_string()];
    run::run(&catenary(&limp, Purpose::Run), folder.path(), &mut Options::default()).unwrap_err();
    page.open(&folder.path().join("view.html"));
    assert!(page.ask("document.querySelector('.failed').textContent").contains("failed"));
    assert!(page.complaints.is_empty(), "{:?}", page.complaints);
}

/// A cable at rest in its equilibrium moves by rounding errors only: the page has no curve, but values.
#[test]
#[ignore = "needs Chromium: .ci/view"]
fn rounding_errors_are_not_plotted() {
    let folder = page_of("catenary", &[]);
    let mut page = Browser::start(1200, 800);
    page.open(&folder.path().join("view.html"));
    page.ask("document.querySelectorAll('#plots details').forEach((fold) => (fold.open = true))");
    // a section fills when the browser has noticed that it is open
    let end = std::time::Instant::now() + std::time::Duration::from_secs(20);
    while page.ask("[...document.querySelectorAll('#plots details')].every((fold) => fold.childElementCount > 1)")
        != "true"
    {
        assert!(std::time::Instant::now() < end, "a section stays empty");
    }
    assert_eq!(page.ask("document.querySelectorAll('.uplot').length"), "0");
    let constant = page.ask("[...document.querySelectorAll('.constant')].map((p) => p.textContent).join('; ')");
    for text in ["fx = 3.08", "gap = 0", "vx = 0, vy = 0, vz = 0", "kinetic = 0"] {
        assert!(constant.contains(text), "{text}: {constant}");
    }
    assert!(page.complaints.is_empty(), "{:?}", page.complaints);
}

/// Forces, moments and forces per length are arrows at their points; a load with a ramp grows with time.
#[test]
#[ignore = "needs Chromium: .ci/view"]
fn loads_are_arrows() {
    let folder = tempfile::tempdir().unwrap();
    let elastica = Scene::read(&scene("elastica"), &[], Purpose::Static).unwrap();
    run::statics(&elastica, folder.path(), &mut run::Options::default()).unwrap();
    let mut page = Browser::start(1200, 800);
    page.open(&folder.path().join("view.html"));
    assert_eq!(page.ask("loadArrows(frames[0], 0).map((arrow) => arrow.heads)"), "1,2");
    assert_eq!(page.ask("loadArrows(frames[0], 0)[0].label"), "10 N");
    let off = "(() => { const { from, vector } = loadArrows(frames[0], 0)[0], p = data.probes[0].table; \
               return Math.hypot(from[0] - p[1][0], from[1] - p[2][0]) + (vector[1] < 0 && vector[0] === 0 ? 0 : 9); })()";
    assert!(page.ask(off).parse::<f64>().unwrap() < 1e-6);
    let green = "(() => { const d = pen.getImageData(0, 0, canvas.width, canvas.height).data; let n = 0; \
                 for (let i = 0; i < d.length; i += 4) n += d[i] === 11 && d[i + 1] === 122 && d[i + 2] === 85; return n; })()";
    page.ask("(setTheme('light'), show())");
    assert!(page.ask(green).parse::<u32>().unwrap() > 50, "no arrow is drawn");

    let text = std::fs::read_to_string(scene("elastica")).unwrap()
        + "\n[[body]]\nname = \"ball\"\nshape = { ball = 0.1 }\nmass = 1.0\n[[load]]\nbody = \"ball\"\nforce = [0, 0, 2]\nramp = 0.2\n";
    let text = text.replace("engine = \"none\"", "").replacen(
        "[[cable]]\n",
        "[[cable]]\nline_load = [{ force = [0, -1, 0] }]\n",
        1,
    );
    let sets = ["duration=0.2".to_string()];
    run::run(&Scene::parse("loads.toml", &text, &sets, Purpose::Run).unwrap(), folder.path(), &mut Options::default())
        .unwrap();
    page.open(&folder.path().join("view.html"));
    assert_eq!(page.ask("loadArrows(frames[0], 0).length"), "7");
    let last = "loadArrows(frames[frames.length - 1], 0.2).filter((arrow) => arrow.label).map((arrow) => arrow.label)";
    assert!(page.ask(last).contains("2 N") && page.ask(last).contains("1 N/m"), "{}", page.ask(last));
    assert!(page.complaints.is_empty(), "{:?}", page.complaints);
}

#[test]
#[ignore = "needs Chromium: .ci/view"]
fn the_forces_of_contacts_are_arrows() {
    let folder = page_of("../contact/stick", &["duration=0.5"]);
    let mut page = Browser::start(1200, 800);
    page.open(&folder.path().join("view.html"));
    let last = "contactArrows(frames[frames.length - 1])";
    assert!(page.ask(&format!("{last}.length")).parse::<u32>().unwrap() > 3);
    assert_eq!(page.ask(&format!("{last}.every((arrow) => arrow.vector[1] > 0)")), "true");
    assert!(page.ask(&format!("{last}.map((arrow) => arrow.label).join('')")).contains('N'));
    let drawn = "(() => { const d = pen.getImageData(0, 0, canvas.width, canvas.height).data; let n = 0; \
                 for (let i = 0; i < d.length; i += 4) n += d[i] === 163 && d[i + 1] === 53 && d[i + 2] === 143; return n; })()";
    page.ask("(setTheme('light'), goTo(frames.length - 1), show())");
    assert!(page.ask(drawn).parse::<u32>().unwrap() > 50, "no arrow is drawn");
    assert!(page.complaints.is_empty(), "{:?}", page.complaints);
}

/// Draws docs/view.png anew: `LARIAT_PICTURE=docs/view.png .ci/view`.
#[test]
#[ignore = "needs Chromium: .ci/view"]
fn the_picture_of_the_readme_is_small() {
    let folder = page_of("bridge", &[]);
    let mut page = Browser::start(1200, 720);
    page.open(&folder.path().join("view.html"));
    page.ask("goTo(Math.round(0.3 * frames.length))");
    let picture = page.picture();
    assert!(picture.len() < 200_000, "{} bytes", picture.len());
    if let Ok(file) = std::env::var("LARIAT_PICTURE") {
        std::fs::write(file, picture).unwrap();
    }
}

/// Every page of a shipped scene shows the scene in its first window, below at most three lines of words; the rest is folded.
#[test]
#[ignore = "needs Chromium: .ci/view"]
fn the_scene_comes_first_on_every_page() {
    let mut page = Browser::start(1200, 800);
    let mut seen = 0;
    for folder in ["scenes", "contact", "hard"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(folder);
        for file in std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()) {
            let out = tempfile::tempdir().unwrap();
            let short = ["duration=0.05".to_string()];
            // what ends before, or has a table beyond it, is as it is
            let Ok(scene) = Scene::read(&file, &short, Purpose::Run) else { continue };
            let _ = run::run(&scene, out.path(), &mut run::Options::default());
            page.open(&out.path().join("view.html"));
            let lines = page.ask("document.querySelectorAll('#words p.line').length").parse::<u32>().unwrap();
            let [top, bottom] = ["top", "bottom"].map(|side| {
                page.ask(&format!("document.getElementById('scene').getBoundingClientRect().{side}"))
                    .parse::<f64>()
                    .unwrap()
            });
            let name = file.display();
            assert!(
                lines <= 3 && top < 250.0 && bottom <= 800.0,
                "{name}: {lines} lines, the scene from {top} to {bottom} px"
            );
            seen += 1;
        }
    }
    assert!(seen > 50 && page.complaints.is_empty(), "{seen} {:?}", page.complaints);
}
