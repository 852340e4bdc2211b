//! docs/scene.md has every key that the parser reads, and no other.

use lariat_scene::{Purpose, Scene};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

type Keys = BTreeMap<String, BTreeSet<String>>;

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// The fields of each table in the source of the parser.
fn keys_of_the_parser() -> Keys {
    let (mut keys, mut table, mut renamed) = (Keys::new(), String::new(), None);
    for line in read("src/scene/table.rs").lines() {
        if let Some(rest) = line.strip_prefix("pub struct ") {
            table = rest.trim_end_matches("Table {").to_lowercase();
        } else if let Some(rest) = line.trim().strip_prefix("#[serde(rename = \"") {
            renamed = rest.split('"').next().map(str::to_string);
        } else if let Some((field, _)) = line.strip_prefix("    pub ").and_then(|rest| rest.split_once(':')) {
            let key = renamed.take().unwrap_or(field.to_string());
            keys.entry(table.clone()).or_default().insert(key);
        }
    }
    keys
}

/// The first columns of the tables of the page that begin with `key`, by the last word of the heading above.
fn keys_of_the_page() -> Keys {
    let (mut keys, mut heading, mut inside) = (Keys::new(), String::new(), false);
    for line in read("../../docs/scene.md").lines() {
        if line.starts_with('#') {
            let word = line.trim_matches(|c| "#`[] ".contains(c));
            heading = word.rsplit(['.', ' ']).next().unwrap_or_default().replace('_', "");
        }
        inside = line.starts_with("| key |") || inside && line.starts_with('|');
        if let Some(rest) = line.strip_prefix("| `").filter(|_| inside) {
            let key = rest.split('`').next().unwrap_or_default().to_string();
            assert!(keys.entry(heading.clone()).or_default().insert(key.clone()), "{heading}: {key} twice");
        }
    }
    keys
}

#[test]
fn the_page_has_every_key_of_the_parser_and_no_other() {
    let (parser, page) = (keys_of_the_parser(), keys_of_the_page());
    assert!(parser.len() > 10 && parser["body"].contains("path"), "{parser:?}");
    // the table of a piece of a rest shape is `RestPieceTable` there and `[[cable.rest_shape.piece]]` here
    let heading = |table: &str| page.keys().filter(|h| table.ends_with(h.as_str())).max_by_key(|h| h.len()).cloned();
    let headings: Vec<Option<String>> = parser.keys().map(|table| heading(table)).collect();
    for ((table, keys), heading) in parser.iter().zip(&headings) {
        assert_eq!(Some(keys), heading.as_ref().map(|h| &page[h]), "{table}");
    }
    for extra in page.keys() {
        assert_eq!(headings.iter().filter(|h| h.as_ref() == Some(extra)).count(), 1, "{extra}");
    }
}

#[test]
fn the_scene_of_the_page_is_accepted() {
    let page = read("../../docs/scene.md");
    let text = page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    Scene::parse("page.toml", text, &[], Purpose::Run).unwrap();
}
