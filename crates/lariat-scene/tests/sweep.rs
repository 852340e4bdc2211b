//! Sweeps and runs in memory: every combination is a row, a failure loses no other run, a restart skips what is done.

use lariat_scene::run::{self, Options};
use lariat_scene::sweep::{self, Row, Source, Store, TIMES};
use lariat_scene::{Error, Purpose, Scene};
use std::fs;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

const TEXT: &str = r#"
duration = 0.1
dt = 0.01
[[cable]]
name = "rope"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
elements = 4
section = { square = 0.01 }
density = 4000.0
youngs_modulus = 1.0e8
[[attachment]]
cable = "rope"
at = "start"
body = "world"
[[probe]]
name = "tip"
cable = "rope"
at = "end"
"#;
const SOURCE: Source<'_> = Source { file: "rope.toml", text: TEXT };

fn grid() -> Vec<Vec<String>> {
    sweep::grid(&["cable.rope.elements=2,3".to_string(), "duration=0.05,-1,0.1".to_string()]).unwrap()
}

fn swept(points: &[Vec<String>], store: Option<&Store>) -> Vec<Row> {
    sweep::sweep(&SOURCE, points, store, &Arc::default(), &|_, _| ()).unwrap()
}

/// Without the times, which differ from run to run.
fn results(rows: &[Row]) -> Vec<Row> {
    let mut rows = rows.to_vec();
    rows.iter_mut().for_each(|row| row.results.retain(|name, _| !TIMES.contains(&name.as_str())));
    rows
}

#[test]
fn a_grid_has_all_combinations_in_order() {
    let points = grid();
    assert_eq!(points.len(), 6);
    assert_eq!(points[0], ["cable.rope.elements=2", "duration=0.05"]);
    assert_eq!(points[5], ["cable.rope.elements=3", "duration=0.1"]);
    let names = sweep::grid(&[
        "fidelity=game,engineering".to_string(),
        "gravity=[0.0, -1.0, 0.0],[0.0, -9.81, 0.0]".to_string(),
    ]);
    let names = names.unwrap();
    assert_eq!(names.len(), 4);
    assert_eq!(names[1], ["fidelity=game", "gravity=[0.0, -9.81, 0.0]"]);
    assert!(sweep::grid(&["duration".to_string()]).is_err() && sweep::grid(&["duration=".to_string()]).is_err());
}

/// A row is what a run by itself writes; the runs of duration -1 fail, and no other.
#[test]
fn rows_are_those_of_single_runs_and_failures_lose_none() {
    let rows = swept(&grid(), None);
    assert_eq!(
        rows.iter().map(|row| row.error.is_some()).collect::<Vec<_>>(),
        [false, true, false, false, true, false]
    );
    for row in rows.iter().filter(|row| row.error.is_none()) {
        let scene = Scene::parse("rope.toml", TEXT, &row.settings, Purpose::Run).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let summary = run::run(&scene, folder.path(), &mut Options::default()).unwrap();
        assert_eq!(row.results["steps"], Some(summary.steps as f64));
        let file = fs::read_to_string(folder.path().join("probes/tip.csv")).unwrap();
        let columns: Vec<&str> = file.lines().next().unwrap().split(',').collect();
        let last: Vec<f64> = file.lines().last().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
        for (column, last) in columns.iter().zip(last).skip(1) {
            assert_eq!(row.results[&format!("tip.{column}.last")], Some(last), "{column}");
        }
    }
}

#[test]
fn a_restart_runs_only_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let points = grid();
    let first = swept(&points[..2], Some(&Store::open(folder.path(), &SOURCE).unwrap()));
    // a line that was not written to its end
    let path = folder.path().join("rows.jsonl");
    fs::write(&path, fs::read_to_string(&path).unwrap() + "{\"of\":\"").unwrap();
    let store = Store::open(folder.path(), &SOURCE).unwrap();
    assert!(matches!(Store::open(folder.path(), &SOURCE), Err(Error::Busy { .. })));
    let known = std::sync::Mutex::new(0);
    let count = |_: &Row, before: bool| *known.lock().unwrap() += usize::from(before);
    let rows = sweep::sweep(&SOURCE, &points, Some(&store), &Arc::default(), &count).unwrap();
    assert_eq!(*known.lock().unwrap(), 2);
    // with the times of the first run: it was not run again
    assert_eq!(rows[..2], first);
    assert_eq!(results(&rows), results(&swept(&points, None)));
    drop(store);
    let other = Source { text: &TEXT.replace("elements = 4", "elements = 5"), ..SOURCE };
    assert!(Store::open(folder.path(), &other).unwrap().done(&points[0]).is_none());
}

/// A sweep that is stopped while runs are under way ends them, and keeps the rows that are done:
/// with the same store the rest is run later. Runs of an hour would not end within the time of a
/// test.
#[test]
fn a_sweep_that_is_stopped_ends_its_runs() {
    let folder = tempfile::tempdir().unwrap();
    let points = sweep::grid(&["duration=0.05,36000,36001,36002".to_string()]).unwrap();
    let store = Store::open(folder.path(), &SOURCE).unwrap();
    let stop = Arc::new(AtomicBool::new(false));
    let first_row = |_: &Row, _: bool| stop.store(true, Ordering::Relaxed);
    let rows = sweep::sweep(&SOURCE, &points, Some(&store), &stop, &first_row).unwrap();
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0].settings, points[0]);
    drop(store);
    let again = Store::open(folder.path(), &SOURCE).unwrap();
    assert!(again.done(&points[0]).is_some() && points[1..].iter().all(|point| again.done(point).is_none()));
}

/// What every run would refuse is told before any; what some accept is run.
#[test]
fn a_key_that_no_run_accepts_is_an_error() {
    let misspelt = sweep::grid(&["cable.rope.elemnts=2,3".to_string()]).unwrap();
    assert!(SOURCE.check(&misspelt).unwrap_err().to_string().contains("elements"));
    assert!(SOURCE.check(&grid()).is_ok() && SOURCE.check(&[]).is_ok());
}

#[test]
fn the_command_writes_one_table() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (folder.path().join("rope.toml"), folder.path().join("out"));
    fs::write(&scene, TEXT).unwrap();
    let sweep = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lariat"));
        command.arg("sweep").arg(&scene).arg("--out").arg(&out);
        command.args(["--vary", "cable.rope.elements=2,3", "--vary", "duration=0.05,0.1"]).output().unwrap()
    };
    let printed = String::from_utf8(sweep().stdout).unwrap();
    assert!(printed.starts_with("4 runs: 0 failed, 0 were done before"), "{printed}");
    assert!(String::from_utf8(sweep().stdout).unwrap().starts_with("4 runs: 0 failed, 4 were done before"));
    let table = fs::read_to_string(out.join("table.csv")).unwrap();
    assert_eq!(table.lines().count(), 5);
    assert!(table.starts_with("cable.rope.elements,duration,"), "{table}");
    let mut wrong = Command::new(env!("CARGO_BIN_EXE_lariat"));
    let wrong =
        wrong.arg("sweep").arg(&scene).arg("--out").arg(&out).args(["--vary", "cable.rope.element=2,3"]).output();
    assert_eq!(wrong.unwrap().status.code(), Some(2));
}

/// The curve of a cable in the file begins at its support, and ends where the probe of its end is.
#[test]
fn a_run_is_written_as_openusd() {
    let scene = Scene::parse("rope.toml", TEXT, &[], Purpose::Run).unwrap();
    let folder = tempfile::tempdir().unwrap();
    run::run(&scene, folder.path(), &mut Options { usd: true, ..Options::default() }).unwrap();
    let text = fs::read_to_string(folder.path().join("run.usda")).unwrap();
    assert!(text.starts_with("#usda 1.0") && text.contains("def BasisCurves \"rope\""), "{text}");
    assert!(text.contains("curveVertexCounts = [13]") && text.contains("custom double lariat:axialStiffness = 10000"));
    let recording = run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
    assert_eq!(recording.usd(), text);
    let tip = &recording.probes[0];
    let last: Vec<f32> = tip.rows[tip.rows.len() - tip.columns.len() + 1..][..3].iter().map(|&x| x as f32).collect();
    let end = format!("({}, {}, {})],\n        }}", last[0], last[1], last[2]);
    assert!(text.contains(&end), "{end}");
    // a run without it removes the file of the last
    run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    assert!(!folder.path().join("run.usda").exists());
}

/// Each picture is a state of the run: the held end stays at its place, the free one is at as many places as there are pictures.
#[test]
fn a_run_is_written_as_an_animated_picture() {
    let scene = Scene::parse("rope.toml", TEXT, &[], Purpose::Run).unwrap();
    let folder = tempfile::tempdir().unwrap();
    run::run(&scene, folder.path(), &mut Options { svg: true, ..Options::default() }).unwrap();
    let text = fs::read_to_string(folder.path().join("run.svg")).unwrap();
    let svg = roxmltree::Document::parse(&text).unwrap();
    let path = svg.descendants().find(|node| node.has_tag_name("path")).unwrap();
    let moving = path.children().find(|node| node.attribute("attributeName") == Some("d")).unwrap();
    let pictures: Vec<&str> = moving.attribute("values").unwrap().split(';').collect();
    assert_eq!(path.attribute("d"), Some(pictures[0]));
    let ends =
        |place: fn(&str) -> &str| pictures.iter().map(|d| place(d)).collect::<std::collections::HashSet<_>>().len();
    assert_eq!(ends(|d| d.split('C').next().unwrap_or_default()), 1);
    assert!(
        pictures.len() > 10 && ends(|d| d.rsplit_once(' ').map_or("", |(_, y)| y)) > pictures.len() / 2,
        "{pictures:?}"
    );
    assert_eq!(run::collect(&scene, Purpose::Run, &mut Options::default()).unwrap().svg(), text);
    run::run(&scene, folder.path(), &mut Options::default()).unwrap();
    assert!(!folder.path().join("run.svg").exists());
}

/// The user's own table and rows stay, byte for byte, and so does the table of a sweep that was changed; nothing else is written then.
#[test]
fn files_of_the_user_are_not_touched() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (folder.path().join("rope.toml"), folder.path().join("out"));
    fs::write(&scene, TEXT).unwrap();
    fs::create_dir(&out).unwrap();
    let sweep = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lariat"));
        command.arg("sweep").arg(&scene).arg("--out").arg(&out).args(["--vary", "duration=0.05,0.1"]).output().unwrap()
    };
    for name in ["table.csv", "rows.jsonl"] {
        let mine = out.join(name);
        for text in ["mine", "{\"of\": 3}\n{}", "{}\n"] {
            fs::write(&mine, text).unwrap();
            let refused = sweep();
            let told = String::from_utf8_lossy(&refused.stderr).into_owned();
            assert_eq!(refused.status.code(), Some(2), "{told}");
            assert!(told.contains(name), "{told}");
            assert_eq!(fs::read_to_string(&mine).unwrap(), text);
            assert_eq!(fs::read_dir(&out).unwrap().count(), 1, "{name}");
        }
        fs::remove_file(&mine).unwrap();
    }
    assert!(sweep().status.success() && sweep().status.success());
    let table = out.join("table.csv");
    let changed = fs::read_to_string(&table).unwrap() + "mine\n";
    fs::write(&table, &changed).unwrap();
    assert_eq!(sweep().status.code(), Some(2));
    assert_eq!(fs::read_to_string(&table).unwrap(), changed);
}
