//! The `lariat` command: files, exit codes, messages.

use lariat_scene::run::Summary;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn lariat(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_lariat")).args(arguments).output().unwrap()
}

fn scene(name: &str) -> String {
    format!("{}/../../assets/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn summary(folder: &Path) -> Summary {
    serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap()
}

fn rows(file: PathBuf) -> (String, Vec<Vec<f64>>) {
    let text = fs::read_to_string(file).unwrap();
    let mut lines = text.lines();
    let header = lines.next().unwrap().to_string();
    (header, lines.map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect())
}

/// An explicit method within its stability limit, as the cable is at the start.
const EXPLICIT: &[&str] = &["--set", "cable.pendulum.integrator={ method = \"verlet\", stable = 0.9 }"];

/// A load that stretches the cable fourfold: its frequencies rise beyond the limit of the explicit step during the run.
const STRETCH: &str = "\n[[load]]\ncable = \"pendulum\"\nat = \"end\"\nforce = [3.0e5, 0.0, 0.0]\nramp = 1.0\n";

#[test]
fn a_run_writes_its_probes_and_a_summary_with_every_key() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/folder");
    let output = lariat(&["run", &scene("falling_pendulum"), "--out", out.to_str().unwrap(), "--set", "duration=0.1"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).is_empty(), "no progress bar without a terminal");
    let json: serde_json::Value = serde_json::from_str(&fs::read_to_string(out.join("summary.json")).unwrap()).unwrap();
    let mut keys: Vec<&str> = json.as_object().unwrap().keys().map(String::as_str).collect();
    let mut expected = [
        "name",
        "simulated_s",
        "cpu_s",
        "wall_s",
        "real_time_factor",
        "steps",
        "rejected_steps",
        "newton_iterations",
        "factorisations",
        "solves",
        "divided_steps",
        "search_tests",
        "iterations_for",
        "divisions_for",
        "element_evaluations",
        "effect_evaluations",
        "max_gap_m",
        "energy_start_j",
        "energy_end_j",
        "energy_balance",
        "told",
        "warnings",
        "failed",
    ];
    keys.sort_unstable();
    expected.sort_unstable();
    assert_eq!(keys, expected);
    assert_eq!((json["simulated_s"].as_f64(), json["failed"].is_null()), (Some(0.1), true));
    assert!(json["effect_evaluations"].as_object().unwrap().is_empty());
    for (name, header, columns) in [
        ("tip", "t,x,y,z,vx,vy,vz,sx,sy,sz,tension,curvature,moment,tension_uncertainty", 14),
        ("pin", "t,fx,fy,fz,mx,my,mz,gap", 8),
        ("energy", "t,kinetic,axial,bending,gravity,dissipated,interface_work,total", 8),
        ("momentum", "t,px,py,pz,lx,ly,lz", 7),
    ] {
        let (found, rows) = rows(out.join(format!("probes/{name}.csv")));
        assert_eq!(found, header);
        assert_eq!(rows.len(), 11);
        for (k, row) in rows.iter().enumerate() {
            assert_eq!((row.len(), row[0]), (columns, k as f64 / 100.0));
        }
    }
}

/// A coarse mesh and a body that falls: told once each, to the standard error alone; the run succeeds.
#[test]
fn warnings_go_to_stderr_once_and_change_no_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let body = "\n[[body]]\nname = \"bob\"\nshape = { ball = 0.1 }\nmass = 2.0\nposition = [9.0, 0.0, 0.0]\n";
    let text = fs::read_to_string(scene("falling_pendulum")).unwrap().replace("engine = \"none\"", "");
    fs::write(&file, text + body).unwrap();
    let out = folder.path().join("out");
    let arguments = ["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()];
    let output = lariat(&[&arguments[..], &["--set", "cable.pendulum.elements=2"]].concat());
    let (told, printed) = (stderr(&output), String::from_utf8_lossy(&output.stdout).into_owned());
    assert!(output.status.success() && !printed.contains("warning"), "{printed}");
    let lines: Vec<&str> = told.lines().collect();
    assert!(lines.len() == 2 && lines.iter().all(|line| line.starts_with("warning: ")), "{told}");
    assert!(lines[0].contains("body \"bob\"") && lines[1].contains("try `elements = "), "{told}");
    let page = fs::read_to_string(out.join("view.html")).unwrap();
    assert!(page.contains("falls_freely") && page.contains("coarse_mesh"));
}

/// What `--error` claims is printed and in summary.json; what cannot be proven is a warning, and no failure.
#[test]
fn an_error_that_is_asked_for_is_claimed_or_told_to_be_out_of_reach() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let to = out.to_str().unwrap();
    let output = lariat(&["static", &scene("cantilever"), "--out", to, "--error", "1e-3"]);
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && stderr(&output).is_empty(), "{}", stderr(&output));
    let error = summary(&out).error.unwrap();
    let claimed = format!("error of positions at most {:.1e} m", error.claim.claimed_m.unwrap());
    assert!(printed.contains(&claimed) && printed.contains("not covered: the model"), "{printed}");
    assert!(printed.contains(&format!("elements \"beam\" {}", error.claim.elements)), "{printed}");
    let rest = ["--out", to, "--error", "1e-2", "--set", "duration=4.5"];
    let output = lariat(&[&["run", &scene("falling_pendulum")], &rest[..]].concat());
    let (told, printed) = (stderr(&output), String::from_utf8_lossy(&output.stdout).into_owned());
    let horizon = summary(&out).error.unwrap().claim.horizon_s.unwrap();
    assert!(output.status.success() && told.contains(&format!("not proven from {horizon:.4} s on")), "{told}");
    assert!(printed.contains("at most 1e-2 m before"), "{printed}");
}

#[test]
fn bad_input_exits_with_2_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let to = out.to_str().unwrap();
    let file = scene("falling_pendulum");
    for (arguments, fragment) in [
        (vec!["run", &file, "--out", to, "--set", "cable.pendulum.elements=0"], "elements"),
        (vec!["run", &file, "--out", to, "--error", "1e-12"], "--error"),
        (vec!["run", "no/such/scene.toml", "--out", to], "no/such/scene.toml"),
        (vec!["run", &file], "--out"),
        (vec!["run", "/dev/zero", "--out", to], "more than 256 MiB"),
        (vec!["run", &file, "--out", to, "--set", "duration=1e6"], "would write some"),
        (vec!["fly"], "fly"),
    ] {
        let output = lariat(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(fragment), "{}", stderr(&output));
        assert!(!out.exists());
    }
}

#[test]
fn a_folder_that_cannot_be_created_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "in the way").unwrap();
    let output = lariat(&["run", &scene("falling_pendulum"), "--out", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("cannot write to"), "{}", stderr(&output));
    assert_eq!(fs::read_to_string(&file).unwrap(), "in the way");
}

#[test]
fn help_lists_the_measurements_of_the_workspace() {
    let help = String::from_utf8(lariat(&["--help"]).stdout).unwrap();
    for name in ["report", "stability", "table1", "lariat-bench", "keys"] {
        assert!(help.contains(name), "{name}: {help}");
    }
}

/// A copy of the command finds `lariat-bench` beside it, hands all arguments over, `--help` too, and returns its exit code. Without
/// the program the message says how to build it.
#[cfg(unix)]
#[test]
fn measurements_are_run_by_the_program_beside_the_command() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let [command, program, script] = ["lariat", "lariat-bench", "script"].map(|name| folder.path().join(name));
    // written first and renamed later: a file that another test's child still holds open cannot be executed
    fs::write(&script, "#!/bin/sh\necho \"$@\"\nexit 3\n").unwrap();
    fs::set_permissions(&script, fs::Permissions::from_mode(0o755)).unwrap();
    fs::copy(env!("CARGO_BIN_EXE_lariat"), &command).unwrap();
    let run = |arguments: &[&str]| {
        for _ in 0..100 {
            match Command::new(&command).args(arguments).env_remove("CARGO").output() {
                Err(error) if error.kind() == std::io::ErrorKind::ExecutableFileBusy => {
                    std::thread::sleep(std::time::Duration::from_millis(20));
                }
                output => return output.unwrap(),
            }
        }
        panic!("{} stays busy", command.display());
    };
    let output = run(&["table1"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("cargo build --release -p lariat-bench"), "{}", stderr(&output));
    fs::rename(&script, &program).unwrap();
    for arguments in [&["report", "--out", "a folder", "--quick"][..], &["stability", "--help"], &["table1", "-h"]] {
        let output = run(arguments);
        assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), arguments.join(" "));
        assert_eq!(output.status.code(), Some(3));
    }
}

#[test]
fn an_unknown_subcommand_suggests_the_nearest() {
    let output = lariat(&["raport", "--out", "x"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("'report'"), "{}", stderr(&output));
}

#[test]
fn keys_are_listed_in_all_or_by_table_and_misspelt_ones_are_errors() {
    let text = |arguments: &[&str]| String::from_utf8(lariat(arguments).stdout).unwrap();
    let all = text(&["keys"]);
    assert!(
        all.contains("### `[[cable]]`") && all.contains("### `[cable.drag]`") && all.contains("| `fluid_density` |")
    );
    let drag = text(&["keys", "cable.drag"]);
    assert!(
        drag.starts_with("### `[cable.drag]`")
            && drag.contains("[cable.drag.flow.power_law]")
            && !drag.contains("[[cable]]"),
        "{drag}"
    );
    assert!(text(&["keys", "cable.length"]).contains("| `length` | a finite number > 0 | m |"));
    let output = lariat(&["keys", "cable.dragg"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("Did you mean \"drag\"?"), "{}", stderr(&output));
}

#[test]
fn a_run_that_fails_exits_with_3_names_cable_and_time_and_keeps_its_samples() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let file = out.join("stretched.toml");
    fs::write(&file, fs::read_to_string(scene("falling_pendulum")).unwrap() + STRETCH).unwrap();
    let file = file.to_str().unwrap();
    let output = lariat(&[&["run", file, "--out", out.to_str().unwrap()], EXPLICIT].concat());
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let message = stderr(&output);
    assert!(message.contains("pendulum") && message.contains("t = "), "{message}");
    let summary = summary(out);
    assert_eq!(summary.failed.as_deref(), message.lines().last().map(|line| line.trim_start_matches("error: ")));
    let (_, rows) = rows(out.join("probes/tip.csv"));
    assert!(summary.simulated_s > 0.0 && summary.simulated_s < 2.0);
    assert!((rows.last().unwrap()[0] - summary.simulated_s).abs() < 1e-9, "{} rows", rows.len());
    assert!(rows.iter().flatten().all(|x| x.is_finite()));
}

#[test]
fn results_of_the_last_run_are_removed() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().to_str().unwrap();
    assert!(lariat(&["static", &scene("cantilever"), "--out", to]).status.success());
    assert!(folder.path().join("probes/wall.csv").exists());
    assert!(lariat(&["static", &scene("catenary"), "--out", to]).status.success());
    assert!(!folder.path().join("probes/wall.csv").exists());
}

/// Other files in the folder stay, also those that look like results, and nothing outside is touched.
#[test]
fn files_of_the_user_are_not_removed() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let to = out.to_str().unwrap();
    assert!(lariat(&["static", &scene("cantilever"), "--out", to]).status.success());
    let outside = folder.path().join("outside.csv");
    let mine = [out.join("notes.txt"), out.join("probes/mine.csv"), out.join("probes/folder/wall.csv"), outside];
    fs::create_dir(out.join("probes/folder")).unwrap();
    mine.iter().for_each(|file| fs::write(file, "mine").unwrap());
    let list = out.join(".lariat-files");
    let listed = fs::read_to_string(&list).unwrap();
    assert!(listed.lines().any(|name| name.starts_with("probes/wall.csv\t")), "{listed}");
    fs::write(&list, listed + "probes/../../outside.csv\n../outside.csv\nnotes.txt\n").unwrap();
    assert!(lariat(&["static", &scene("catenary"), "--out", to]).status.success());
    for file in &mine {
        assert_eq!(fs::read_to_string(file).unwrap(), "mine", "{}", file.display());
    }
    assert!(!out.join("probes/wall.csv").exists() && out.join("probes/middle.csv").exists());
}

#[test]
fn static_prints_the_equilibrium_of_each_cable() {
    let folder = tempfile::tempdir().unwrap();
    let output = lariat(&["static", &scene("catenary"), "--out", folder.path().to_str().unwrap()]);
    let text = String::from_utf8(output.stdout).unwrap();
    for fragment in [
        "cable \"line\": stable, residual",
        "peak tension",
        "sag",
        "on \"left\" at 0 m: force [",
        "on \"right\" at 3 m",
    ] {
        assert!(text.contains(fragment), "{fragment}: {text}");
    }
    let statics = summary(folder.path()).statics.unwrap();
    assert_eq!((statics.len(), statics[0].name.as_str(), statics[0].reactions.len()), (1, "line", 2));
}

/// A link is the user's, whatever it leads to, and nothing is written through it.
#[cfg(unix)]
#[test]
fn a_link_is_not_written_through() {
    let folder = tempfile::tempdir().unwrap();
    let (out, target) = (folder.path().join("out"), folder.path().join("target.txt"));
    fs::create_dir(&out).unwrap();
    std::os::unix::fs::symlink(&target, out.join("summary.json")).unwrap();
    let refused = || {
        let output = lariat(&["static", &scene("cantilever"), "--out", out.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(stderr(&output).contains("summary.json is not the result"), "{}", stderr(&output));
    };
    refused();
    assert!(!target.exists());
    fs::write(&target, "mine").unwrap();
    refused();
    assert_eq!(fs::read_to_string(&target).unwrap(), "mine");
}

/// Every result, in turn, is changed by the user and written anew by the user: it stays as it is, or, where the next run has no
/// use for its name, is left alone.
#[test]
fn results_that_were_changed_since_are_the_users() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().to_str().unwrap();
    let run = |name: &str| lariat(&["static", &scene(name), "--out", to]);
    for name in ["summary.json", "view.html", "state", "probes/wall.csv"] {
        assert!(run("cantilever").status.success());
        let file = folder.path().join(name);
        let written = fs::read(&file).unwrap();
        for mine in [b"mine".to_vec(), [&written[..], b" "].concat(), written[1..].to_vec()] {
            fs::write(&file, &mine).unwrap();
            let again = run("cantilever");
            assert_eq!(again.status.code(), Some(2), "{name}: {}", stderr(&again));
            assert!(stderr(&again).contains(name) && stderr(&again).contains("changed since"), "{}", stderr(&again));
            assert_eq!(fs::read(&file).unwrap(), mine, "{name}");
        }
        if name == "probes/wall.csv" {
            // the probes of the other scene have other names
            assert!(run("catenary").status.success());
            assert_eq!(fs::read(&file).unwrap(), written[1..], "{name}");
        }
        fs::write(&file, &written).unwrap();
    }
}

/// What a run that was killed leaves cannot be told from what the user made of it: it is set aside.
#[cfg(unix)]
#[test]
fn samples_of_a_run_that_was_killed_are_set_aside() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().to_str().unwrap();
    let mut killed = long_run(folder.path());
    killed.kill().unwrap();
    killed.wait().unwrap();
    let samples = fs::read(folder.path().join("probes/tip.csv")).unwrap();
    let again = ["run", &scene("falling_pendulum"), "--out", to, "--set", "duration=0.1"];
    for _ in 0..2 {
        assert!(lariat(&again).status.success());
        assert_eq!(fs::read(folder.path().join("probes/tip.csv.1")).unwrap(), samples);
        assert!(!folder.path().join("probes/tip.csv.2").exists());
    }
}

/// A model that is imported again replaces its scene, unless the user changed that.
#[test]
fn an_import_replaces_what_an_import_wrote_alone() {
    let folder = tempfile::tempdir().unwrap();
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/mjcf/composite.xml");
    let out = folder.path().join("rope.toml");
    let import = || lariat(&["import", model.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    let first = import();
    assert!(first.status.success(), "{}", stderr(&first));
    let scene = fs::read_to_string(&out).unwrap();
    assert!(import().status.success());
    assert_eq!(fs::read_to_string(&out).unwrap(), scene);
    for mine in ["mine".to_string(), scene.clone() + "# mine\n", scene.replacen('5', "6", 1), String::new()] {
        fs::write(&out, &mine).unwrap();
        let refused = import();
        assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
        assert_eq!(fs::read_to_string(&out).unwrap(), mine);
    }
}

/// No file may grow past 8 kB: rows until then stay, none is cut, and the summary says why the run ended.
#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_up_during_a_run_leaves_whole_rows() {
    let folder = tempfile::tempdir().unwrap();
    let run = format!(
        "trap '' XFSZ; ulimit -f 8; exec {} run {} --out {}",
        env!("CARGO_BIN_EXE_lariat"),
        scene("falling_pendulum"),
        folder.path().display()
    );
    let output = Command::new("bash").args(["-c", &run]).output().unwrap();
    assert_eq!(output.status.code(), Some(3), "{}", stderr(&output));
    let message = stderr(&output);
    assert!(message.contains(".csv") && message.contains("t = "), "{message}");
    assert_eq!(
        summary(folder.path()).failed.as_deref(),
        message.lines().last().map(|line| line.trim_start_matches("error: "))
    );
    let text = fs::read_to_string(folder.path().join("probes/tip.csv")).unwrap();
    assert!(text.ends_with('\n') && text.len() <= 8192);
    let (_, rows) = rows(folder.path().join("probes/tip.csv"));
    assert!(rows.len() > 20 && rows.iter().all(|row| row.len() == 14 && row.iter().all(|x| x.is_finite())));
    // the page does not fit either and is removed
    assert!(!folder.path().join("view.html").exists());
}

/// A scene that runs for minutes, once it has written some rows to the folder.
#[cfg(unix)]
fn long_run(to: &Path) -> std::process::Child {
    let child = Command::new(env!("CARGO_BIN_EXE_lariat"))
        .args(["run", &scene("falling_pendulum"), "--out", to.to_str().unwrap(), "--set", "duration=1e4"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let probe = to.join("probes/tip.csv");
    for _ in 0..3000 {
        if fs::metadata(&probe).is_ok_and(|m| m.len() > 1000) {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    child
}

#[cfg(unix)]
#[test]
fn ctrl_c_and_a_request_to_terminate_leave_every_sample_and_a_summary() {
    for signal in ["-INT", "-TERM"] {
        let folder = tempfile::tempdir().unwrap();
        let mut child = long_run(folder.path());
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(130), "{signal}");
        let summary = summary(folder.path());
        assert!(summary.failed.unwrap().contains("interrupted"));
        let (_, rows) = rows(folder.path().join("probes/tip.csv"));
        assert!((rows.last().unwrap()[0] - summary.simulated_s).abs() < 1e-9);
        let page = fs::read_to_string(folder.path().join("view.html")).unwrap();
        assert!(page.contains("interrupted at t = ") && page.trim_end().ends_with("</html>"));
    }
}

/// The second run names the first and changes nothing of it; a run that was killed leaves no lock.
#[cfg(unix)]
#[test]
fn two_runs_do_not_share_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().to_str().unwrap();
    let mut first = long_run(folder.path());
    for arguments in [
        vec!["static", &scene("catenary"), "--out", to],
        vec!["run", &scene("catenary"), "--out", to, "--error", "1e-3"],
    ] {
        let second = lariat(&arguments);
        assert_eq!(second.status.code(), Some(2), "{}", stderr(&second));
        assert!(stderr(&second).contains(&format!("process {}, begun", first.id())), "{}", stderr(&second));
        assert!(folder.path().join("probes/tip.csv").exists() && !folder.path().join("summary.json").exists());
    }
    first.kill().unwrap();
    first.wait().unwrap();
    assert!(lariat(&["static", &scene("catenary"), "--out", to]).status.success());
}

#[test]
fn a_file_that_no_run_wrote_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let mine = folder.path().join("summary.json");
    fs::write(&mine, "mine").unwrap();
    for command in ["run", "static"] {
        let output = lariat(&[command, &scene("catenary"), "--out", folder.path().to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("summary.json is not the result"), "{}", stderr(&output));
        assert_eq!(fs::read_to_string(&mine).unwrap(), "mine");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}

/// A model nested 10 000 deep, which a recursive reader answers by overflowing its stack.
#[test]
fn a_model_that_is_nested_without_bound_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("deep.xml");
    let bodies = "<body>".repeat(10_000) + &"</body>".repeat(10_000);
    fs::write(&model, format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>")).unwrap();
    let output = lariat(&["import", model.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("nested deeper than 256 levels"), "{}", stderr(&output));
}

#[test]
fn the_tables_list_every_integrator_and_every_rejected_rule() {
    let output = lariat(&["integrators"]);
    let text = String::from_utf8(output.stdout).unwrap();
    for method in lariat_ancf::Method::ALL {
        assert!(text.contains(&method.to_string()), "{method}");
    }
    let text = String::from_utf8(lariat(&["rules"]).stdout).unwrap();
    for name in ["projected-3", "ST2", "L2T2", "G2-2", "mean-3", "G5-1"] {
        assert!(text.contains(name), "{name}");
    }
}
