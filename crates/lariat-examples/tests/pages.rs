//! The pages of the repository: links lead somewhere, the cookbook shows the code that is run, and
//! its recipes do what they say.

#[path = "../../../examples/cookbook/recipes/mod.rs"]
mod recipes;

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Pages written by hand: of the root, of docs, and of every crate.
fn pages() -> Vec<PathBuf> {
    let crates = fs::read_dir(root().join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let folders = [root().to_path_buf(), root().join("docs")].into_iter().chain(crates);
    let files = folders.flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    files.filter(|path| path.extension().is_some_and(|e| e == "md")).collect()
}

/// The text without its code.
fn prose(page: &str) -> String {
    page.split("```").step_by(2).collect()
}

/// Targets of the links of a page.
fn links(page: &str) -> Vec<String> {
    let target = |rest: &str| rest.split_once(')').map(|(target, _)| target.to_string());
    prose(page).split("](").skip(1).filter_map(target).collect()
}

/// The anchors that GitHub gives to the headings of a page.
fn anchors(page: &str) -> Vec<String> {
    let text = prose(page);
    let headings =
        text.lines().filter_map(|line| line.strip_prefix('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |c: char| c.is_alphanumeric() || " -_".contains(c);
    headings.map(|h| h.to_lowercase().chars().filter(|&c| kept(c)).collect::<String>().replace(' ', "-")).collect()
}

#[test]
fn links_lead_to_files_and_headings_that_exist() {
    let mut broken = Vec::new();
    let mut count = 0;
    for path in pages() {
        let page = fs::read_to_string(&path).unwrap();
        for link in links(&page).into_iter().filter(|link| !link.contains("://")) {
            count += 1;
            let (file, anchor) = link.split_once('#').map_or((link.as_str(), None), |(f, a)| (f, Some(a)));
            let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            let exists = match anchor {
                None => target.exists(),
                Some(anchor) => {
                    fs::read_to_string(&target).is_ok_and(|page| anchors(&page).iter().any(|a| a == anchor))
                }
            };
            if !exists {
                broken.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    assert!(count > 100, "only {count} links were found");
}

#[test]
fn every_crate_has_a_readme() {
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let readme = entry.unwrap().path().join("README.md");
        assert!(readme.exists(), "{}", readme.display());
    }
}

#[test]
fn the_cookbook_shows_the_code_and_the_cost_of_its_recipes() {
    let page = fs::read_to_string(root().join("docs/cookbook.md")).unwrap();
    for recipe in recipes::ALL {
        let (open, close) = (format!("<!-- {} -->", recipe.name), format!("<!-- /{} -->", recipe.name));
        let block = page.split_once(&open).and_then(|(_, rest)| rest.split_once(&close)).expect("marks on the page").0;
        let code = block.trim().strip_prefix("```rust,ignore\n").and_then(|b| b.strip_suffix("\n```"));
        let current = code == Some(recipe.shown()) && page.contains(&recipe.row());
        assert!(current, "{}: run `cargo run --release --example cookbook -- --out docs/cookbook.md`", recipe.name);
    }
}

#[test]
fn every_recipe_meets_the_value_computed_by_hand() {
    for recipe in recipes::ALL {
        let mut stage = (recipe.build)().unwrap();
        for _ in 0..recipe.steps {
            stage.step().unwrap();
        }
        println!("{}: {}", recipe.name, stage.check().unwrap());
    }
}
