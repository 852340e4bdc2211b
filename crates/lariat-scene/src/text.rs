//! Texts of files, of a bounded size.

use crate::error::Error;
use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

/// Most bytes of a file: a hundred times what a mesh of a million triangles needs is refused, and `/dev/zero` has an end.
const MOST: u64 = 256 << 20;

/// Reads the text of a file.
///
/// # Errors
/// [`Error::Read`], also for a file of more than 256 MiB and for one that is no UTF-8.
pub fn read_text(path: &Path) -> Result<String, Error> {
    bounded(path).map_err(|source| Error::Read { path: path.to_path_buf(), source })
}

/// Reads the text of a file, as [`read_text`] does.
pub(crate) fn bounded(path: &Path) -> io::Result<String> {
    let mut bytes = Vec::new();
    File::open(path)?.take(MOST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST {
        let problem = format!("it has more than {} MiB", MOST >> 20);
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, problem));
    }
    String::from_utf8(bytes).map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8"))
}
