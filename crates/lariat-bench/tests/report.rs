//! The accuracy report: what Markdown says is what the files hold, errors fall as they should, and the library's own figures are those
//! that were measured.

use lariat_bench::report::section::Format;
use lariat_bench::report::{self, Bench, Options, Report, pendulum, taut};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The two coarsest rungs, each point run once.
fn tiny() -> Options {
    Options { command: "", rungs: 2, least_runs: 1, most_runs: 1, budget: 0.0, patience: 0.0, readings: 2 }
}

fn csv(path: &Path) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    reader.deserialize().map(Result::unwrap).collect()
}

/// Half a unit of the last digit that is printed.
fn rounding(text: &str) -> f64 {
    let (mantissa, power) = text.split_once('e').map_or((text, 0), |(m, p)| (m, p.parse().unwrap()));
    let digits = mantissa.split_once('.').map_or(0, |(_, digits)| digits.len() as i32);
    0.5 * 10f64.powi(power - digits)
}

/// Rows of all tables of a Markdown file, without headings and rules.
fn markdown_tables(text: &str) -> Vec<Vec<Vec<String>>> {
    let mut tables: Vec<Vec<Vec<String>>> = Vec::new();
    let mut before = "";
    for line in text.lines() {
        if line.starts_with('|') && !before.starts_with('|') {
            tables.push(Vec::new());
        }
        if let (true, Some(table)) = (line.starts_with('|'), tables.last_mut()) {
            let cells = line.trim_matches('|').replace("\\|", "\u{1}");
            table.push(cells.split('|').map(|cell| cell.trim().replace('\u{1}', "|")).collect());
        }
        before = line;
    }
    tables.iter_mut().for_each(|table| drop(table.drain(..2)));
    tables
}

/// Every cell of every table in the Markdown is that of the CSV file, to the digits that are printed.
fn compare(folder: &Path, report: &Report) -> usize {
    let tables = markdown_tables(&fs::read_to_string(folder.join("README.md")).unwrap());
    let written: Vec<_> = report.sections.iter().flat_map(|section| section.tables()).collect();
    assert_eq!(tables.len(), written.len());
    let mut numbers = 0;
    for (table, shown) in written.into_iter().zip(&tables) {
        let rows = csv(&folder.join(table.file()));
        assert_eq!(rows.len(), shown.len(), "{}", table.name);
        for (row, cells) in rows.iter().zip(shown) {
            for ((i, _, format), cell) in table.shown().zip(cells) {
                let raw = &row[table.columns[i].name];
                match (raw.parse::<f64>(), cell.parse::<f64>()) {
                    (Ok(raw), Ok(shown)) if format != Format::Plain => {
                        let off = (raw - shown).abs();
                        assert!(off <= 1.001 * rounding(cell), "{}: {cell} for {raw:?}", table.file());
                        numbers += 1;
                    }
                    _ if raw.is_empty() => assert!(cell.is_empty() || cell == "-", "{}: {cell}", table.file()),
                    _ => assert_eq!(raw, cell, "{}", table.file()),
                }
            }
        }
    }
    numbers
}

#[test]
fn a_report_says_in_markdown_what_its_files_hold_and_its_page_needs_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/report");
    let mut told = Vec::new();
    let report = report::run(&out, tiny(), &mut |what| told.push(what.to_string())).unwrap();
    assert!(compare(&out, &report) > 500);
    assert!(told.iter().any(|what| what.contains("payload")));

    let page = fs::read_to_string(out.join("index.html")).unwrap();
    let figures: Vec<_> = report.sections.iter().flat_map(|section| section.figures()).collect();
    assert_eq!(page.matches("<svg").count(), figures.len());
    for figure in figures {
        assert!(out.join(format!("{}.svg", figure.name)).exists());
        assert!(page.contains(&figure.caption));
    }
    for outside in ["<img", "<script", "<link", "src=", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    // a choice that is refused is a row with its reason, not a gap
    let refused: Vec<_> = csv(&out.join("catenary.csv")).into_iter().filter(|row| row["rule"] == "G2-none").collect();
    assert_eq!(refused.len(), 2);
    for row in refused {
        assert!(row["failed"].contains("rank deficient") && row["error_m"].is_empty(), "{row:?}");
    }
    assert!(fs::read_to_string(out.join("README.md")).unwrap().contains("rank deficient"));
}

/// Errors by line of a ladder, from the coarsest.
fn ladders(points: &[report::point::Point]) -> BTreeMap<&str, Vec<f64>> {
    let mut lines: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for point in points {
        let error = point.error.unwrap_or_else(|| panic!("{:?}", point.failed));
        lines.entry(&point.setting.line).or_default().push(error);
    }
    lines
}

/// Against the independent solver's run. Substeps are halved: order 2 divides the error by 4; tolerances fall tenfold.
#[test]
fn errors_in_time_fall_down_every_ladder_as_the_order_says() {
    let mut bench = Bench { options: Options { rungs: 4, ..tiny() }, progress: &mut |_| () };
    let points = pendulum::in_time(&mut bench).unwrap();
    let lines = ladders(&points);
    assert_eq!(lines.len(), 11);
    for (name, errors) in &lines {
        println!("{name}: {errors:?}");
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            match *name {
                // from 0.95 of the stable step to 0.5 and 0.25
                "verlet" => assert!((2.5..6.0).contains(&ratio), "{ratio}"),
                "rkn4" => assert!(ratio > 5.0, "{ratio}"),
                // what rounding leaves
                "rkn6" => assert!(ratio > 1.0 || pair[1] < 1e-12, "{ratio}"),
                "midpoint" | "generalised-alpha-0.5-once" => assert!((2.5..6.0).contains(&ratio), "{name}: {ratio}"),
                _ => assert!((3.0..40.0).contains(&ratio), "{name}: {ratio}"),
            }
        }
    }
    assert!(lines["rkn4"][0] < 1e-9, "{:?}", lines["rkn4"]);
}

/// Against the analytic motion; cubic elements: order 4 or more in their length with an exact integrator.
#[test]
fn a_plucked_steel_cable_converges_to_the_analytic_modes() {
    let mut bench = Bench { options: Options { rungs: 4, ..tiny() }, progress: &mut |_| () };
    let points = taut::measure_all(&mut bench).unwrap();
    for (name, errors) in ladders(&points) {
        println!("{name}: {errors:?}");
        assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{name}: {errors:?}");
        assert!(errors[3] < 3e-7, "{name}: {errors:?}");
    }
    let errors = &ladders(&points)["rkn4"];
    // 4 to 8 elements; the finest come near what the linear formula leaves out
    assert!(errors[0] / errors[2] > 0.8 * 16.0, "{errors:?}");
}

#[test]
fn a_report_says_which_readme_it_cannot_mark() {
    let folder = tempfile::tempdir().unwrap();
    let readme = folder.path().join("README.md");
    fs::write(&readme, "no marks").unwrap();
    let report = Report { command: "", sections: Vec::new(), machine: String::new(), seconds: 0.0 };
    let error = report::update_readme(&report, &readme).unwrap_err();
    assert!(error.to_string().contains("<!-- fidelity -->"), "{error}");
    assert_eq!(fs::read_to_string(&readme).unwrap(), "no marks");
}

/// The tables in the documentation of `Fidelity` against the checked-in report: errors as printed, times within a factor of 2 (the
/// report may have been made again on another machine).
#[test]
fn the_fidelities_document_what_the_checked_in_report_measured() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let source = fs::read_to_string(root.join("crates/lariat-ancf/src/integrate/fidelity.rs")).unwrap();
    let measured = csv(&root.join("docs/accuracy/fidelity.csv"));
    let mut documented = Vec::new();
    let mut rows: Vec<Vec<String>> = Vec::new();
    for line in source.lines().map(str::trim) {
        if let Some(cells) = line.strip_prefix("/// | ").filter(|cells| !cells.starts_with("scene")) {
            rows.push(cells.trim_end_matches('|').split('|').map(|cell| cell.trim().to_string()).collect());
        }
        if let Some(name) = line.strip_suffix(',').filter(|name| ["Game", "Engineering", "Reference"].contains(name)) {
            documented.extend(rows.drain(..).map(|row| (name.to_lowercase(), row)));
        }
    }
    assert_eq!(documented.len(), 9);
    for (fidelity, row) in documented {
        let [scene, elements, error, cpu] = &row[..] else { panic!("{row:?}") };
        let found = measured.iter().find(|m| m["fidelity"] == fidelity && m["scene"] == *scene);
        let found = found.unwrap_or_else(|| panic!("{fidelity}, {scene} is not in the report"));
        let number = |column: &str| found[column].parse::<f64>().unwrap();
        assert_eq!(found["elements"], *elements, "{fidelity}, {scene}");
        let off = (number("error_m") - error.parse::<f64>().unwrap()).abs();
        assert!(off <= 1.001 * rounding(error), "{fidelity}, {scene}: {error} m, measured {}", found["error_m"]);
        let ratio = number("cpu_median_ms") / cpu.parse::<f64>().unwrap();
        assert!((0.5..2.0).contains(&ratio), "{fidelity}, {scene}: {cpu} ms, measured {}", found["cpu_median_ms"]);
    }
}
