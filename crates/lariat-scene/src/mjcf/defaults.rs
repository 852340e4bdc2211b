//! Classes of defaults, written into the elements that have them.
//!
//! Composites and flexcomps take none: MuJoCo 3.17 gives their parts its own defaults (checked by
//! `tests/mjcf/models.py`, which reads masses and damping under a default of each).

use super::tree::Element;
use crate::error::Error;
use std::collections::HashMap;

/// Attributes of a class by kind of element.
type Class = HashMap<String, Vec<(String, String)>>;

/// Writes the defaults of a model into its bodies, tendons and equalities.
///
/// # Errors
/// A class that no `<default>` has.
pub(super) fn apply(root: &mut Element) -> Result<(), Error> {
    let mut classes = HashMap::from([("main".to_string(), Class::new())]);
    for default in root.named("default") {
        collect(default, None, &mut classes)?;
    }
    for section in &mut root.children {
        match section.name.as_str() {
            "worldbody" => body(section, "main", &classes)?,
            "equality" => plain(section, Some("equality"), &classes)?,
            "tendon" => plain(section, Some("tendon"), &classes)?,
            "actuator" => plain(section, None, &classes)?,
            _ => {}
        }
    }
    Ok(())
}

fn collect(element: &Element, parent: Option<&str>, classes: &mut HashMap<String, Class>) -> Result<(), Error> {
    let name = match (element.attribute("class"), parent) {
        (Some(name), _) => name,
        (None, None) => "main",
        (None, Some(_)) => return Err(element.wrong("needs a class")),
    };
    let mut class = match parent {
        Some(parent) => classes.get(parent).cloned().unwrap_or_default(),
        None => classes.get(name).cloned().unwrap_or_default(),
    };
    for child in element.children.iter().filter(|child| child.name != "default") {
        let given = class.entry(child.name.clone()).or_default();
        for (key, value) in &child.attributes {
            given.retain(|(name, _)| name != key);
            given.push((key.clone(), value.clone()));
        }
    }
    classes.insert(name.to_string(), class);
    for child in element.named("default") {
        collect(child, Some(name), classes)?;
    }
    Ok(())
}

fn body(element: &mut Element, class: &str, classes: &HashMap<String, Class>) -> Result<(), Error> {
    for child in &mut element.children {
        match child.name.as_str() {
            "body" | "frame" => {
                let own = child.attribute("childclass").unwrap_or(class).to_string();
                if !classes.contains_key(&own) {
                    return Err(child.wrong(format!("childclass = {own:?}: no <default> has this class")));
                }
                body(child, &own, classes)?;
            }
            "geom" | "joint" | "site" => merge(child, None, class, classes)?,
            _ => {}
        }
    }
    Ok(())
}

fn plain(section: &mut Element, kind: Option<&str>, classes: &HashMap<String, Class>) -> Result<(), Error> {
    section.children.iter_mut().try_for_each(|child| merge(child, kind, "main", classes))
}

/// Orientations, of which an element has one: its own goes before that of a class.
const TURNS: [&str; 5] = ["quat", "euler", "axisangle", "xyaxes", "zaxis"];

fn merge(
    element: &mut Element,
    kind: Option<&str>,
    class: &str,
    classes: &HashMap<String, Class>,
) -> Result<(), Error> {
    let class = element.attribute("class").unwrap_or(class);
    let Some(class) = classes.get(class) else {
        return Err(element.wrong(format!("class = {class:?}: no <default> has this class")));
    };
    let turned = TURNS.iter().any(|key| element.has(key));
    for (key, value) in class.get(kind.unwrap_or(&element.name)).into_iter().flatten() {
        let drawn = element.name == "fixed" && ["material", "width"].contains(&key.as_str());
        if !(element.has(key) || drawn || turned && TURNS.contains(&key.as_str())) {
            element.attributes.push((key.clone(), value.clone()));
        }
    }
    Ok(())
}
