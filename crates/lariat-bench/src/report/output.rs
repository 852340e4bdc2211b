//! Writing a report: Markdown, CSV, SVG, and one HTML page made of the Markdown with the drawings inside.

use super::Report;
use super::section::{Cell, Table};
use crate::error::Error;
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd, html};
use std::io;
use std::path::Path;

fn output(path: &Path) -> impl Fn(io::Error) -> Error + '_ {
    move |source| Error::Output { path: path.to_path_buf(), source }
}

/// Makes the folder and sees whether it can be written.
pub fn try_folder(out: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(out).map_err(output(out))?;
    let trial = out.join(".report");
    std::fs::write(&trial, "").map_err(output(&trial))?;
    std::fs::remove_file(&trial).map_err(output(&trial))
}

/// Writes all files.
pub fn write(report: &Report, out: &Path) -> Result<(), Error> {
    let save = |name: &str, text: &str| {
        let path = out.join(name);
        std::fs::write(&path, text).map_err(|source| Error::Output { path, source })
    };
    for section in &report.sections {
        for table in section.tables() {
            save(&table.file(), &table.csv())?;
        }
        for figure in section.figures() {
            save(&format!("{}.svg", figure.name), &figure.svg)?;
        }
    }
    let text = markdown(report);
    save("README.md", &text)?;
    save("index.html", &page(report, &text))
}

fn markdown(report: &Report) -> String {
    let mut out = format!(
        "# Accuracy against cost\n\nMade by `{}` in {:.0} s; do not edit. {}\n\nTimes are CPU time on one thread: the median of \
         repeated runs, with the least and the most of them beside it or in the CSV files. Counts are the same on every machine. Every \
         table and every point of a figure is in a CSV file beside this page; `index.html` is the same page for a browser. What is \
         measured and what it is compared with is told section by section, and in `crates/lariat-bench/src/report/mod.rs`.\n\n",
        report.command, report.seconds, report.machine
    );
    report.sections.iter().for_each(|section| out += &section.markdown());
    out.trim_end().to_string() + "\n"
}

const STYLE: &str = "body{font-family:sans-serif;max-width:64em;margin:2em auto;padding:0 1em;color:#2d2d30;line-height:1.45}\
    table{border-collapse:collapse;font-size:.85em;display:block;overflow-x:auto}td,th{border:1px solid #e1e1e4;padding:.2em .5em}\
    th{background:#f5f5f7}svg{max-width:100%;height:auto}figcaption{font-size:.9em;color:#606066}summary{cursor:pointer}";

/// The Markdown as one page, every drawing in it.
fn page(report: &Report, markdown: &str) -> String {
    let drawing = |file: &str| {
        let figures = report.sections.iter().flat_map(|section| section.figures());
        figures.into_iter().find(|f| format!("{}.svg", f.name) == file)
    };
    // an image holds its caption as text events, which its figure has already
    let mut inside = false;
    let events = Parser::new_ext(markdown, Options::ENABLE_TABLES).filter_map(|event| match event {
        Event::Start(Tag::Image { dest_url, .. }) if drawing(&dest_url).is_some() => {
            inside = true;
            drawing(&dest_url).map(|f| Event::Html(figure(&f.svg, &f.caption).into()))
        }
        Event::End(TagEnd::Image) if inside => {
            inside = false;
            None
        }
        _ if inside => None,
        event => Some(event),
    });
    let mut body = String::new();
    html::push_html(&mut body, events);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Lariat: accuracy against cost</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// A drawing inside a page: without an XML heading.
fn figure(svg: &str, caption: &str) -> String {
    let svg = svg.find("<svg").map_or(svg, |at| &svg[at..]);
    format!("<figure>{svg}<figcaption>{caption}</figcaption></figure>")
}

fn find<'a>(report: &'a Report, name: &str) -> Option<&'a Table> {
    report.sections.iter().flat_map(|s| s.tables()).find(|t| t.name == name)
}

/// Some columns, with the head and the decimals of each, of the rows that `shown` takes, as Markdown.
fn excerpt(table: &Table, columns: &[(&str, &str, usize)], shown: impl Fn(&[Cell]) -> bool) -> String {
    let heads: Vec<&str> = columns.iter().map(|c| c.1).collect();
    let words = |name: &str| {
        let at = table.columns.iter().position(|c| c.name == name);
        at.is_some_and(|i| table.rows.iter().any(|row| matches!(row[i], Cell::Text(_))))
    };
    let align: Vec<&str> = columns.iter().map(|c| if words(c.0) { "---" } else { "---:" }).collect();
    let mut out = format!("| {} |\n|{}|\n", heads.join(" | "), align.join("|"));
    for row in table.rows.iter().filter(|row| shown(row)) {
        let cells = columns.iter().map(|(name, _, digits)| {
            match table.columns.iter().position(|c| c.name == *name).map(|i| &row[i]) {
                Some(Cell::Text(text)) => text.clone(),
                Some(Cell::Count(n)) => n.to_string(),
                Some(Cell::Number(x)) if *x < 0.01 => format!("{x:.1e}"),
                Some(Cell::Number(x)) => format!("{x:.digits$}"),
                _ => "-".to_string(),
            }
        });
        out += &format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "));
    }
    out
}

/// Replaces what stands between `<!-- name -->` and `<!-- /name -->`.
fn replace(text: &str, name: &str, new: &str) -> Option<String> {
    let (open, close) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let (before, rest) = text.split_once(&open)?;
    let (_, after) = rest.split_once(&close)?;
    Some(format!("{before}{open}{new}{close}{after}"))
}

/// The README's table, with the line that names the machine.
pub fn update_readme(report: &Report, readme: &Path) -> Result<(), Error> {
    let read = |source| Error::Read { path: readme.to_path_buf(), source };
    let text = std::fs::read_to_string(readme).map_err(read)?;
    let word = |row: &[Cell], i: usize, word: &str| matches!(&row[i], Cell::Text(t) if t == word);
    let fidelity = find(report, "fidelity").map(|table| {
        let columns = [
            ("fidelity", "fidelity", 0),
            ("scene", "scene", 0),
            ("integrator", "integrator", 0),
            ("control", "control", 0),
            ("elements", "elements", 0),
            ("error_m", "error m", 3),
            ("cpu_median_ms", "CPU ms", 2),
        ];
        excerpt(table, &columns, |row| !word(row, 1, "catenary"))
    });
    let new = format!("{}\n{}\n", fidelity.unwrap_or_default(), report.machine);
    let missing = || io::Error::other("no <!-- fidelity --> ... <!-- /fidelity --> in it");
    let text = replace(&text, "fidelity", &new)
        .ok_or_else(|| Error::Output { path: readme.to_path_buf(), source: missing() })?;
    std::fs::write(readme, text).map_err(output(readme))
}
