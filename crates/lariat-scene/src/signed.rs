//! A file of its own, outside of a [folder](crate::folder) of results: its last line is a comment with the checksum of what stands
//! above, so that the next file of the name replaces it only while nobody changed it.

use crate::error::Error;
use lariat_ancf::seal::Checksum;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::path::Path;

/// How a format writes a comment: what begins and what ends it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Comment(&'static str, &'static str);

impl Comment {
    /// That of TOML and OpenUSD.
    pub const HASH: Comment = Comment("# ", "");
    /// That of SVG.
    pub const XML: Comment = Comment("<!-- ", " -->");

    /// Returns the last line of a file.
    fn line(self, body: &[u8]) -> String {
        format!("{}lariat: {}{}\n", self.0, Checksum::of(body).digits(), self.1)
    }

    /// Returns whether a file is as it was written.
    fn closes(self, bytes: &[u8]) -> bool {
        let end =
            bytes.strip_suffix(b"\n").unwrap_or(bytes).iter().rposition(|&byte| byte == b'\n').map_or(0, |i| i + 1);
        let (body, line) = bytes.split_at(end);
        line == self.line(body).as_bytes()
    }
}

/// Writes a text with its checksum in the last line. A file of the name is replaced if it is one that was written so, and nobody
/// changed it since. To a pipe or a device the text is written as it is.
///
/// # Errors
/// [`Error::InTheWay`] for any other file of the name, and for a link; [`Error::Output`].
pub fn write(path: &Path, text: &str, comment: Comment) -> Result<(), Error> {
    let fail = |source| Error::Output { path: path.to_path_buf(), source };
    let body = if text.ends_with('\n') { text.to_string() } else { format!("{text}\n") };
    let is_device = |metadata: fs::Metadata| !metadata.is_file() && !metadata.is_dir();
    match (fs::symlink_metadata(path), fs::metadata(path)) {
        (Err(_), _) => {}
        (_, Ok(metadata)) if is_device(metadata.clone()) => return fs::write(path, body).map_err(fail),
        (Ok(metadata), _) => {
            if !metadata.is_file() || !comment.closes(&fs::read(path).map_err(fail)?) {
                return Err(Error::InTheWay { path: path.to_path_buf() });
            }
            fs::remove_file(path).map_err(fail)?;
        }
    }
    let mut file = OpenOptions::new().write(true).create_new(true).open(path).map_err(fail)?;
    let text = body.clone() + &comment.line(body.as_bytes());
    let written = file.write_all(text.as_bytes());
    if written.is_err() {
        let _ = fs::remove_file(path);
    }
    written.map_err(fail)
}
