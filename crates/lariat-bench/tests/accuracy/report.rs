//! The accuracy report: its page says what its files hold, errors fall as they should, a section
//! that fails loses no other, and the library's documented figures are those that were measured.

use lariat_bench::Error;
use lariat_bench::clock::Repeats;
use lariat_bench::page::Block;
use lariat_bench::report::{self, Options, Progress, Report, pendulum, taut};
use lariat_bench::table::{Format, Table};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The two coarsest settings of each curve, each run once.
fn tiny() -> Options {
    let repeats = Repeats { least: 1, most: 1, enough: 0.0, limit: 0.0 };
    Options { command: "", rungs: 2, repeats, readings: 2 }
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

/// The tables that the page shows, in their order.
fn shown(report: &Report) -> Vec<&Table> {
    let blocks = report.sections.iter().flat_map(|section| &section.blocks);
    let table = |block| match block {
        &Block::Table(ref table) | &Block::Excerpt(ref table) => Some(table),
        _ => None,
    };
    blocks.filter_map(table).collect()
}

/// Compares every cell of every table on the page with the rows of the CSV file, to the digits that
/// are printed, and returns the number of numbers that were compared.
fn compare(folder: &Path, report: &Report) -> usize {
    let tables = markdown_tables(&fs::read_to_string(folder.join("README.md")).unwrap());
    let shown = shown(report);
    assert_eq!(tables.len(), shown.len());
    let mut numbers = 0;
    for (table, lines) in shown.into_iter().zip(&tables) {
        let rows = csv(&folder.join(table.file()));
        // an excerpt may leave rows out, and keeps their order
        let mut rows = rows.iter();
        assert_eq!(table.rows.len(), lines.len(), "{}", table.name);
        for line in lines {
            let cells = || table.visible().zip(line);
            let fits = |row: &&BTreeMap<String, String>| {
                cells().all(|((i, _, format), cell)| same(&row[table.columns[i].name], cell, format))
            };
            assert!(rows.by_ref().any(|row| fits(&row)), "{}: no row for {line:?}", table.file());
            numbers += cells().filter(|((.., format), cell)| *format != Format::Plain && *cell != "-").count();
        }
    }
    numbers
}

/// Whether a printed cell is that of the CSV file.
fn same(raw: &str, cell: &str, format: Format) -> bool {
    match (raw.parse::<f64>(), cell.parse::<f64>()) {
        (Ok(raw), Ok(shown)) if format != Format::Plain => (raw - shown).abs() <= 1.001 * rounding(cell),
        _ if raw.is_empty() => cell.is_empty() || cell == "-",
        _ => raw == cell,
    }
}

/// Every number on the page is that of its CSV file, every figure is a file, and each section is
/// told when it begins and ends.
#[test]
fn the_page_of_a_report_says_what_its_files_hold() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("new/report");
    let (mut begun, mut done) = (Vec::new(), 0);
    let report = report::run(&out, &tiny(), &mut |progress| match progress {
        Progress::Begun(title) => begun.push(title.to_string()),
        Progress::Done(_) => done += 1,
        Progress::Failed(error) => panic!("{error}"),
    });
    let report = report.unwrap();
    assert_eq!((begun.len(), done, report.sections.len()), (14, 14, 14));
    assert!(compare(&out, &report) > 150);
    let page = fs::read_to_string(out.join("README.md")).unwrap();
    for block in report.sections.iter().flat_map(|section| &section.blocks) {
        match block {
            Block::Figure(figure) => {
                assert!(out.join(format!("{}.svg", figure.name)).exists());
                assert!(page.contains(&format!("![{}]({}.svg)", figure.caption, figure.name)));
            }
            Block::Data(table) => assert!(page.contains(&format!("[{}]({0})", table.file())), "{}", table.name),
            _ => {}
        }
    }
    assert!(page.len() < 30_000 && !out.join("index.html").exists(), "{} characters", page.len());
    // a setting that is rejected is a row with its reason, on the page too
    let rejected: Vec<_> = csv(&out.join("catenary.csv")).into_iter().filter(|row| row["rule"] == "G2-none").collect();
    assert_eq!(rejected.len(), 2);
    for row in rejected {
        assert!(row["failed"].contains("rank deficient") && row["error_m"].is_empty(), "{row:?}");
        // a table of the page escapes the bars of |r'|
        assert!(page.contains(&row["failed"].replace('|', "\\|")), "{row:?}");
    }
}

/// No curve has a point, so no figure of curves can be drawn: those sections fail, the others are
/// measured and written.
#[test]
fn a_section_that_fails_loses_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let mut failed = 0;
    let options = Options { rungs: 0, ..tiny() };
    let report = report::run(folder.path(), &options, &mut |progress| {
        failed += usize::from(matches!(progress, Progress::Failed(_)));
    });
    let report = report.unwrap();
    assert_eq!((report.failures.len(), failed, report.sections.len()), (6, 6, 14));
    for file in ["table1.csv", "fidelity.csv", "effects.csv", "kernels.csv", "figure_1.svg"] {
        assert!(folder.path().join(file).exists(), "{file}");
    }
    let page = fs::read_to_string(folder.path().join("README.md")).unwrap();
    assert_eq!(page.matches("This section failed: ").count(), 6);
    let error = report.check().unwrap_err();
    assert!(matches!(&error, Error::Sections { titles } if titles.len() == 6) && error.exit_code() == 3, "{error}");
}

/// Errors by curve, from the coarsest setting.
fn curves(points: &[report::point::Point]) -> BTreeMap<&str, Vec<f64>> {
    let mut lines: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for point in points {
        let error = point.error.unwrap_or_else(|| panic!("{:?}", point.failed));
        lines.entry(&point.setting.line).or_default().push(error);
    }
    lines
}

/// The error in time from an independent solver's run: halving the substeps of a method of order 2
/// divides it by 4; tolerances fall tenfold.
#[test]
fn errors_in_time_fall_with_the_order_of_the_method() {
    let options = Options { rungs: 4, ..tiny() };
    let points = pendulum::in_time(&options).unwrap();
    let lines = curves(&points);
    assert_eq!(lines.len(), 11);
    for (name, errors) in &lines {
        println!("{name}: {errors:?}");
        for pair in errors.windows(2) {
            let ratio = pair[0] / pair[1];
            match *name {
                // from 0.95 of the stable step to 0.5 and 0.25
                "verlet" => assert!((2.5..6.0).contains(&ratio), "{ratio}"),
                "rkn4" => assert!(ratio > 5.0, "{ratio}"),
                // limited by rounding
                "rkn6" => assert!(ratio > 1.0 || pair[1] < 1e-12, "{ratio}"),
                "midpoint" | "discrete-gradient" => assert!((2.5..6.0).contains(&ratio), "{name}: {ratio}"),
                _ => assert!((3.0..40.0).contains(&ratio), "{name}: {ratio}"),
            }
        }
    }
    assert!(lines["rkn4"][0] < 1e-9, "{:?}", lines["rkn4"]);
}

/// The error from the analytic motion: cubic elements have order 4 or more in their length.
#[test]
fn a_plucked_steel_cable_converges_to_the_analytic_modes() {
    let options = Options { rungs: 4, ..tiny() };
    let points = taut::measure_all(&options).unwrap();
    for (name, errors) in curves(&points) {
        println!("{name}: {errors:?}");
        assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{name}: {errors:?}");
        assert!(errors[3] < 3e-7, "{name}: {errors:?}");
    }
    let errors = &curves(&points)["rkn4"];
    // 4 to 8 elements; errors of finer meshes are near those of the linear formula
    assert!(errors[0] / errors[2] > 0.8 * 16.0, "{errors:?}");
}

/// A README without marks is an error that names them, and is left as it is; between marks the table
/// and the line of the machine are replaced.
#[test]
fn a_readme_needs_marks_for_its_table() {
    let folder = tempfile::tempdir().unwrap();
    let readme = folder.path().join("README.md");
    fs::write(&readme, "no marks").unwrap();
    let error = report::readme::update(&Report::default(), &readme).unwrap_err();
    assert!(matches!(&error, Error::NoMark { path, .. } if *path == readme) && error.exit_code() == 2, "{error}");
    assert!(error.to_string().contains("<!-- fidelity -->"), "{error}");
    assert_eq!(fs::read_to_string(&readme).unwrap(), "no marks");
    fs::write(&readme, "a\n<!-- fidelity -->\nold\n<!-- /fidelity -->\nb\n").unwrap();
    let report = Report { machine: "Machine: one.".to_string(), ..Report::default() };
    report::readme::update(&report, &readme).unwrap();
    let expected = "a\n<!-- fidelity -->\n\nMachine: one.\n<!-- /fidelity -->\nb\n";
    assert_eq!(fs::read_to_string(&readme).unwrap(), expected);
}

/// The tables in the documentation of `Fidelity` agree with the checked-in report: errors as
/// printed, times within a factor of 2, since the report may have been made on another machine.
#[test]
fn the_documented_errors_of_the_fidelities_are_those_of_the_report() {
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
