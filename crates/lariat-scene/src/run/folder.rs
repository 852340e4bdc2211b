//! A folder that a run writes to: one run at a time, and nobody's file is overwritten.
//!
//! The names of the files of a run stand in `.lariat-files`, below a line that names its process. The run holds the lock of
//! this file until it has written everything; the operating system releases it when the process ends, however it ends. Where
//! a file system knows no locks, none is held.

use crate::error::Error;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

const FILES: &str = ".lariat-files";

/// A folder that belongs to this run while it lives.
pub(super) struct Folder {
    path: PathBuf,
    /// Holds the lock.
    _list: File,
}

impl Folder {
    /// Creates the folder, unless it is there, removes what the last run wrote there, and notes what this one writes.
    /// `is_result` tells which names a list may hold.
    ///
    /// # Errors
    /// [`Error::Busy`] while another run writes there, [`Error::InTheWay`] for a file that no run wrote and this one would
    /// overwrite, [`Error::Output`]. The folder is then as it was.
    pub fn take(path: &Path, names: &[String], is_result: fn(&str) -> bool) -> Result<Self, Error> {
        let list_path = path.join(FILES);
        let fail = |path: &Path| {
            let path = path.to_path_buf();
            move |source| Error::Output { path, source }
        };
        fs::create_dir_all(path).map_err(fail(path))?;
        let is_new = !list_path.exists();
        let mut list = OpenOptions::new()
            .create(true)
            .read(true)
            .write(true)
            .truncate(false)
            .open(&list_path)
            .map_err(fail(&list_path))?;
        let locked = list.try_lock();
        let mut text = String::new();
        list.read_to_string(&mut text).map_err(fail(&list_path))?;
        if matches!(locked, Err(TryLockError::WouldBlock)) {
            return Err(Error::Busy { path: path.to_path_buf(), holder: holder(&text) });
        }
        let last: Vec<&str> = text.lines().filter(|name| is_result(name)).collect();
        let in_the_way = |name: &&String| !last.contains(&name.as_str()) && path.join(name).is_file();
        if let Some(name) = names.iter().find(in_the_way) {
            if is_new {
                let _ = fs::remove_file(&list_path);
            }
            return Err(Error::InTheWay { path: path.join(name) });
        }
        for stale in last.iter().map(|name| path.join(name)).filter(|path| path.is_file()) {
            fs::remove_file(&stale).map_err(fail(&stale))?;
        }
        let head = format!("# process {} since {}\n", std::process::id(), now());
        let text = names.iter().fold(head, |text, name| text + name + "\n");
        let write = |list: &mut File| -> io::Result<()> {
            list.rewind()?;
            list.set_len(0)?;
            list.write_all(text.as_bytes())
        };
        write(&mut list).map_err(fail(&list_path))?;
        Ok(Folder { path: path.to_path_buf(), _list: list })
    }

    /// Returns the path of a file in the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }
}

/// Returns the time in s since 1970.
fn now() -> u64 {
    SystemTime::UNIX_EPOCH.elapsed().map_or(0, |time| time.as_secs())
}

/// Returns in words who wrote a list, and when; it may be half written.
fn holder(list: &str) -> String {
    let words: Vec<&str> = list.lines().next().unwrap_or_default().split_whitespace().collect();
    match words[..] {
        ["#", "process", id, "since", since] => {
            let ago = since.parse().map_or(0, |since| now().saturating_sub(since));
            format!("process {id}, begun {ago} s ago")
        }
        _ => "a process that just began".to_string(),
    }
}
