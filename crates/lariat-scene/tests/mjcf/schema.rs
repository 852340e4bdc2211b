//! The schema of MuJoCo: every element and attribute added to a model changes the scene, is told, is refused, or is on the
//! list of what is harmless.

use lariat_scene::mjcf;
use roxmltree::{Document, Node};
use std::collections::HashSet;
use std::fmt::Write as _;

/// A model with an element of each kind that is read.
const BASE: &str = r#"<mujoco>
<compiler angle="radian"/>
<option gravity="0 0 -9"><flag/></option>
<default><geom/><joint/><site/><equality/><tendon/></default>
<extension><plugin plugin="mujoco.elasticity.cable"/></extension>
<worldbody>
<geom name="ground" type="plane" size="1 1 1" euler=".1 .2 .3"/>
<composite type="cable" prefix="c_" curve="s" count="11 1 1" size="1" offset="0 0 1" initial="none">
<plugin plugin="mujoco.elasticity.cable"><config key="bend" value="1e8"/></plugin>
<joint kind="main" damping="0.01"/><skin/><geom type="capsule" size=".01"/><site/>
</composite>
<flexcomp name="f" type="grid" dim="1" count="4 1 1" spacing=".1 .1 .1" pos="0 1 1"><edge stiffness="1e4"/><contact/><pin id="0"/></flexcomp>
<body name="load" pos="1 0 1"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint/>
<geom type="box" size=".05 .05 .05" contype="0" conaffinity="0"/><site name="s" pos="0 0 0"/><camera/><light/></body>
<body name="hand" mocap="true" pos="3 0 1"><geom size=".02"/></body>
</worldbody>
<contact><exclude body1="load" body2="hand"/></contact>
<equality><connect site1="c_S_last" site2="s"/><weld body1="f_3" body2="hand"/></equality>
<tendon><spatial><site site="s"/><site site="c_S_first"/></spatial></tendon>
<actuator><motor site="s"/><general site="s"/></actuator>
</mujoco>"#;

/// Values of which each does something, or nothing to that attribute.
const VALUES: [&str; 12] = [
    "0.37",
    "0",
    "1 0 0",
    "0.3 0.2 0.1 0.4",
    "0.1 0.2 0.3 0.4 0.5 0.6",
    "true",
    "false",
    "disable",
    "enable",
    "zyx",
    "other",
    "",
];

fn path_of(node: Node<'_, '_>) -> String {
    let name = node.tag_name().name();
    let parent = node.parent_element().map_or("", |parent| parent.tag_name().name());
    match (parent, name) {
        ("", name) | ("mujoco", name) if name != "worldbody" => name.to_string(),
        (_, "body" | "worldbody") => "body".to_string(),
        ("worldbody", name) => format!("body/{name}"),
        (parent, name) => format!("{parent}/{name}"),
    }
}

/// A path, an attribute with its value, and a child, as [`edited`] has them.
type Edit<'a> = (&'a str, Option<(&'a str, &'a str)>, &'a str);

/// Writes the base with an attribute set, a child added, or both, in the first element of a path.
fn edited(path: &str, attribute: Option<(&str, &str)>, child: &str) -> Option<String> {
    fn write(node: Node<'_, '_>, edit: &mut Option<Edit<'_>>, text: &mut String) {
        let name = node.tag_name().name();
        let here = edit.take_if(|(path, ..)| path_of(node) == *path && name != "worldbody");
        let (_, attribute, child) = here.unwrap_or(("", None, ""));
        let _ = write!(text, "<{name}");
        for own in node.attributes().filter(|own| attribute.is_none_or(|(key, _)| key != own.name())) {
            let _ = write!(text, " {}=\"{}\"", own.name(), own.value());
        }
        if let Some((key, value)) = attribute {
            let _ = write!(text, " {key}=\"{value}\"");
        }
        text.push('>');
        node.children().filter(Node::is_element).for_each(|node| write(node, edit, text));
        let _ = writeln!(text, "{child}</{name}>");
    }
    let document = Document::parse(BASE).unwrap();
    let mut edit = Some((path, attribute, child));
    let mut text = String::new();
    write(document.root_element(), &mut edit, &mut text);
    edit.is_none().then_some(text)
}

fn schema() -> Vec<(String, Vec<String>)> {
    let lines = include_str!("schema.txt").lines().filter(|line| !line.starts_with('#'));
    let row = |line: &str| {
        let (path, names) = line.split_once(':').unwrap();
        (path.to_string(), names.split_whitespace().map(str::to_string).collect())
    };
    lines.map(row).collect()
}

/// Attributes on the list of what is harmless, or is judged with its element.
fn harmless() -> HashSet<(String, String)> {
    let mut harmless = HashSet::new();
    for line in include_str!("../../src/mjcf/known.txt").lines().filter(|line| !line.starts_with('#')) {
        let parts: Vec<&str> = line.split(" | ").collect();
        if ["harmless", "with it"].contains(&parts[1]) {
            harmless.extend(parts[2].split_whitespace().map(|name| (parts[0].to_string(), name.to_string())));
        }
    }
    harmless
}

/// Returns scene and notes, or the error.
fn outcome(text: &str) -> Result<(String, usize), String> {
    mjcf::read("model.xml", text).map(|import| (import.scene, import.notes.len())).map_err(|error| error.to_string())
}

/// Attributes that are read, and have no effect in the model above: names that nothing refers to, what its elements say
/// themselves, points of a grid, and a wind without a density.
fn without_effect(path: &str, name: &str) -> bool {
    matches!((path, name), (_, "name" | "class" | "childclass") | ("option", "wind"))
        || matches!((path, name), ("default/geom", "size") | ("default/site", "pos"))
        || matches!((path, name), ("body/flexcomp", "element" | "point"))
}

#[test]
fn every_attribute_of_the_schema_is_known_and_none_that_is_read_is_dropped() {
    let base = outcome(&edited("mujoco", None, "").unwrap()).unwrap();
    let harmless = harmless();
    let mut dropped = Vec::new();
    for (path, names) in schema() {
        for name in names {
            // what a default does is what it does in an element
            let target = match path.as_str() {
                "default/geom" | "default/joint" | "default/site" => path.replace("default", "body"),
                "default/equality" => "equality/connect".to_string(),
                "default/tendon" => "tendon/spatial".to_string(),
                _ => path.clone(),
            };
            let is_harmless = harmless.contains(&(target, name.clone()));
            let mut silent = true;
            for value in VALUES {
                let Some(text) = edited(&path, Some((&name, value)), "") else { break };
                let result = outcome(&text);
                if let Err(error) = &result {
                    assert!(!error.contains("is not known"), "{path} {name}: {error}");
                }
                silent &= result.as_ref() == Ok(&base);
                if is_harmless || !silent {
                    break;
                }
            }
            if silent && !is_harmless && edited(&path, None, "").is_some() && !without_effect(&path, &name) {
                dropped.push(format!("{path} {name}"));
            }
        }
    }
    assert!(dropped.is_empty(), "accepted without a word: {dropped:#?}");
}

#[test]
fn every_element_of_the_schema_is_known() {
    for (path, _) in schema() {
        let (parent, name) = path.split_once('/').unwrap_or(("mujoco", &path));
        let Some(text) = edited(parent, None, &format!("<{name}/>")) else { continue };
        if let Err(error) = outcome(&text) {
            assert!(!error.contains("is not known"), "{path}: {error}");
        }
    }
}

/// What no schema has is an error that names file, line, element and attribute.
#[test]
fn what_the_schema_has_not_is_named() {
    let mut tried = 0;
    for (path, _) in schema() {
        let name = path.rsplit('/').next().unwrap();
        if let Some(text) = edited(&path, Some(("unheard", "1")), "") {
            let error = outcome(&text).unwrap_err();
            assert!(
                error.starts_with("model.xml:") && error.contains(&format!("<{name}>: unheard: is not known")),
                "{error}"
            );
            tried += 1;
        }
        if let Some(text) = edited(&path, None, "<unheard/>") {
            let error = outcome(&text).unwrap_err();
            assert!(error.contains("<unheard>: is not known in <"), "{path}: {error}");
        }
    }
    assert!(tried > 25, "{tried}");
}
