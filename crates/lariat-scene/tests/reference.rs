//! docs/scene.md and the schema: the page shows the keys of the parser, and defaults are what the page says.

use lariat_scene::scene::SceneTable;
use lariat_scene::schema::{Default, Table, markdown};
use lariat_scene::{Purpose, Scene};
use std::fs;
use std::path::Path;

fn page() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/scene.md")).unwrap()
}

#[test]
fn the_page_shows_the_keys_of_the_schema() {
    let (page, tables) = (page(), markdown::tables(&SceneTable::TABLE));
    let updated = markdown::replace(&page, &tables).expect("the page has no marks for the tables");
    let lines = page.lines().zip(updated.lines()).find(|(old, new)| old != new);
    assert!(page == updated, "`lariat keys --into docs/scene.md` writes the tables anew; first difference: {lines:?}");
    for table in SceneTable::TABLE.all() {
        assert!(table.keys().count() > 0 && page.contains(table.header), "{}", table.header);
    }
}

#[test]
fn the_scenes_of_the_page_are_accepted() {
    let page = page();
    let blocks: Vec<&str> = page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(blocks.len(), 3);
    Scene::parse("page.toml", blocks[0], &[], Purpose::Run).unwrap();
    // effects are parts of a cable, which the page leaves out of its water
    let cable = blocks[0].find("[[attachment]]").unwrap();
    let text = format!("{}{}{}", &blocks[0][..cable], blocks[1], &blocks[0][cable..]);
    Scene::parse("page.toml", &text, &[], Purpose::Run).unwrap();
    let drawn = "name = \"tether\"\npoints = [[0.0, 3.0, 0.0], [2.0, -2.0, 0.0]]\nsection = { wire_rope = 0.01 }\n";
    let text = format!("duration = 1.0\n{}", blocks[2].replace("# ...\n", drawn));
    Scene::parse("page.toml", &text, &[], Purpose::Run).unwrap();
}

/// A scene with every table and no key that has a default value.
const SCENE: &str = r#"
duration = 1.0
[[body]]
name = "crate"
shape = { ball = 0.1 }
mass = 1.0
[[body]]
name = "link"
shape = "none"
mass = 1.0
inertia = [1.0, 1.0, 1.0]
[[joint]]
kind = "ball"
body = "link"
to = "world"
at = [0.0, 0.0, 0.0]
[[cable]]
name = "first"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
section = { round = 0.01 }
density = 4000.0
youngs_modulus = 1.0e8
damping = { axial = 0.1 }
buoyancy = { fluid_density = 1000.0 }
[cable.drag]
fluid_density = 1.2
flow = { velocity = [1.0, 0.0, 0.0], profile = { rows = [[0.0, 1.0]] } }
[[cable.rest_shape.piece]]
from = 0.0
curvature = 0.1
[[cable.line_load]]
force = [0.0, 1.0, 0.0]
[[cable]]
name = "second"
points = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]
section = { round = 0.01 }
density = 4000.0
youngs_modulus = 1.0e8
damping = { bending = 0.1 }
[cable.drag]
fluid_density = 1.2
flow = { velocity = [1.0, 0.0, 0.0], power_law = { reference = 10.0, exponent = 0.14, top = 100.0 } }
[[cable.rest_shape.piece]]
from = 0.0
stretch = 0.9
[[attachment]]
cable = "first"
at = "start"
body = "world"
[[load]]
cable = "first"
at = "end"
force = [0.0, 1.0, 0.0]
[[probe]]
name = "all"
energy = "all"
"#;

/// Returns path and value of every default of a table and those below it that are in the scene.
fn defaults(schema: &Table, values: &toml::Table, path: &str) -> Vec<(String, &'static str)> {
    let mut found = Vec::new();
    for key in schema.keys() {
        let path = if path.is_empty() { key.name.to_string() } else { format!("{path}.{}", key.name) };
        if let Default::Value(value) = key.default {
            assert!(!values.contains_key(key.name), "{path} is in the scene");
            found.push((path.clone(), value));
        }
        match (values.get(key.name), key.table()) {
            (Some(toml::Value::Table(inner)), Some(table)) => found.extend(defaults(table, inner, &path)),
            (Some(toml::Value::Array(rows)), Some(table)) => {
                for (i, row) in rows.iter().enumerate() {
                    let row = row.as_table().into_iter();
                    found.extend(row.flat_map(|row| defaults(table, row, &format!("{path}.{i}"))));
                }
            }
            _ => {}
        }
    }
    found
}

/// A default that is given explicitly changes nothing, so every default is a value that its key accepts.
#[test]
fn defaults_are_what_the_schema_says() {
    let scene = |sets: &[String]| Scene::parse("scene.toml", SCENE, sets, Purpose::Run).unwrap();
    let plain = scene(&[]);
    assert_eq!(plain.cables[0].rule, lariat_ancf::Rule::default());
    assert_eq!(plain.cables[0].integrator, lariat_ancf::Fidelity::default());
    assert_eq!(plain.gravity, lariat_ancf::STANDARD_GRAVITY);
    // the two forms of damping and rest shape leave the other key to its default
    let values: toml::Table = SCENE.replace("axial = 0.1", "").replace("bending = 0.1", "").parse().unwrap();
    let mut tried = 0;
    for (path, value) in defaults(&SceneTable::TABLE, &without(values), "") {
        let given = path.ends_with("0.damping.axial") || path.ends_with("1.damping.bending");
        let given =
            given || path.ends_with("0.rest_shape.piece.0.curvature") || path.ends_with("1.rest_shape.piece.0.stretch");
        if !given {
            assert_eq!(scene(&[format!("{path}={value}")]), plain, "{path} = {value}");
            tried += 1;
        }
    }
    assert!(tried > 30, "{tried}");
}

/// Removes the keys of rest shapes that have a default.
fn without(mut values: toml::Table) -> toml::Table {
    for cable in values.get_mut("cable").and_then(toml::Value::as_array_mut).into_iter().flatten() {
        let pieces =
            cable.get_mut("rest_shape").and_then(|rest| rest.get_mut("piece")).and_then(toml::Value::as_array_mut);
        for piece in pieces.into_iter().flatten().filter_map(toml::Value::as_table_mut) {
            piece.retain(|key, _| key == "from");
        }
    }
    values
}

/// The page has a row for every reason for which iterations and divisions are counted.
///
/// *Source.* The list of the counters.
#[test]
fn the_page_lists_all_reasons() {
    let page = page();
    let section = page.split("### Reasons").nth(1).and_then(|rest| rest.split("\n## ").next()).unwrap();
    for key in lariat_ancf::ReasonCounts::KEYS {
        assert_eq!(section.matches(&format!("\n| `{key}` | ")).count(), 1, "{key}");
    }
}
