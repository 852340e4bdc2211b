//! `lariat keys`: the keys of a scene file, from the schema.

use crate::Error;
use crate::scene::SceneTable;
use crate::schema::markdown;
use std::fs;
use std::path::Path;

/// Returns the tables of all keys, or those of one table or key, such as `cable.drag`, in Markdown.
///
/// # Errors
/// [`Error::NoSuchKey`] for a table or key that does not exist.
pub fn print(path: Option<&str>) -> Result<String, Error> {
    match path {
        None => Ok(markdown::tables(&SceneTable::TABLE)),
        Some(path) => markdown::below(&SceneTable::TABLE, path),
    }
}

/// Replaces the tables in a page.
pub fn update(file: &Path) -> Result<String, Error> {
    let read = |source| Error::Read { path: file.to_path_buf(), source };
    let page = fs::read_to_string(file).map_err(read)?;
    let invalid =
        || read(std::io::Error::other(format!("it has no lines {:?} and {:?}", markdown::BEGIN, markdown::END)));
    let page = markdown::replace(&page, &markdown::tables(&SceneTable::TABLE)).ok_or_else(invalid)?;
    fs::write(file, page).map_err(|source| Error::Output { path: file.to_path_buf(), source })?;
    Ok(format!("keys written to {}\n", file.display()))
}
