//! A folder that results are written to: one program at a time, and the bytes of no file that Lariat did not write are lost.
//!
//! The names of the files stand in `.lariat-files`, below a line that names the process; once a file is written to its end, its
//! checksum and length stand behind a tab. The next run removes a file of the list only if its bytes are those. A file of the list
//! whose bytes are others is the user's and in the way; one without checksum, as a process that was killed leaves it, is set aside
//! as `NAME.1`. New files are created, never opened: a link is not written through. The lock of the list is held until everything
//! is written; the operating system releases it when the process ends, however it ends. Where a file system knows no locks, none
//! is held.

use crate::error::Error;
use lariat_ancf::seal::Checksum;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

const FILES: &str = ".lariat-files";
/// How the first line of a list begins.
const HEAD: &str = "# process ";
/// Folders of the series of results; their files are CSV.
const SERIES: [&str; 3] = ["probes/", "cables/", "bodies/"];
/// Names of other results of a run.
const RESULTS: [&str; 5] = ["summary.json", "view.html", "run.svg", "run.usda", "state"];

/// A line of a list: a file, and what was written to it.
#[derive(Clone, Debug, PartialEq)]
struct Entry {
    name: String,
    /// Checksum and length, as text; empty if the file was not written to its end.
    sum: String,
}

/// A folder that belongs to this process while the value lives.
pub struct Folder {
    path: PathBuf,
    /// Holds the lock.
    list: File,
    entries: Vec<Entry>,
}

/// A file that was created in a [`Folder`], and all that was written to it.
pub(crate) struct OwnFile {
    path: PathBuf,
    file: File,
    sum: Checksum,
}

impl Folder {
    /// Locks a folder, which is created unless it is there, and makes sure that files of these names can be created without
    /// the loss of bytes that Lariat did not write. Nothing is removed yet.
    ///
    /// # Errors
    /// [`Error::Busy`] while another process writes there, [`Error::InTheWay`] for a file that Lariat did not write and this
    /// process would overwrite, [`Error::Output`]. The folder is then as it was.
    pub fn open(path: &Path, names: &[String]) -> Result<Self, Error> {
        let list_path = path.join(FILES);
        let fail = |path: &Path| {
            let path = path.to_path_buf();
            move |source| Error::Output { path, source }
        };
        fs::create_dir_all(path).map_err(fail(path))?;
        let is_new = fs::symlink_metadata(&list_path).is_err();
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
        if !text.is_empty() && !text.starts_with(HEAD) {
            return Err(Error::InTheWay { path: list_path });
        }
        let entries = text.lines().skip(1).map(|line| {
            let (name, sum) = line.split_once('\t').unwrap_or((line, ""));
            Entry { name: name.to_string(), sum: sum.to_string() }
        });
        let folder = Folder { path: path.to_path_buf(), list, entries: entries.collect() };
        let known = |name: &String| folder.entries.iter().find(|entry| entry.name == *name);
        let in_the_way = |name: &&String| {
            let is_own = known(name).is_some_and(|entry| folder.is_unchanged(entry) || entry.sum.is_empty());
            fs::symlink_metadata(folder.file(name)).is_ok() && !is_own
        };
        if let Some(name) = names.iter().find(in_the_way) {
            if is_new {
                let _ = fs::remove_file(&list_path);
            }
            return Err(Error::InTheWay { path: folder.file(name) });
        }
        Ok(folder)
    }

    /// Locks a folder for the files of a run, removes what the last run wrote there, and notes what this one writes.
    ///
    /// # Errors
    /// As [`Folder::open`].
    pub fn take(path: &Path, names: &[String]) -> Result<Self, Error> {
        let mut folder = Folder::open(path, names)?;
        folder.claim(names, is_result)?;
        Ok(folder)
    }

    /// Removes the files of the last list that `is_stale` tells of, and that nobody changed since, and notes what is written now.
    pub(crate) fn claim(&mut self, names: &[String], is_stale: fn(&str) -> bool) -> Result<(), Error> {
        for entry in self.entries.iter().filter(|entry| is_stale(&entry.name)) {
            let path = self.file(&entry.name);
            let done = match (entry.sum.is_empty(), names.contains(&entry.name)) {
                (true, true) => set_aside(&path),
                (false, _) if self.is_unchanged(entry) => fs::remove_file(&path),
                _ => Ok(()),
            };
            done.map_err(|source| Error::Output { path, source })?;
        }
        self.entries.retain(|entry| !is_stale(&entry.name));
        self.entries.extend(names.iter().map(|name| Entry { name: name.clone(), sum: String::new() }));
        self.write_list().map_err(|source| Error::Output { path: self.file(FILES), source })
    }

    /// Returns the path of a file in the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Creates a file, and the folder that it lies in.
    pub(crate) fn create(&self, name: &str) -> io::Result<OwnFile> {
        let path = self.file(name);
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        let file = OpenOptions::new().write(true).create_new(true).open(&path)?;
        Ok(OwnFile { path, file, sum: Checksum::EMPTY })
    }

    /// Writes a whole file; nothing stays of one that does not fit on the disk.
    ///
    /// # Errors
    /// That of the operating system; of the kind `AlreadyExists` for a file that was made since the folder was taken.
    pub fn write(&mut self, name: &str, text: &str) -> io::Result<()> {
        let mut own = self.create(name)?;
        let written = own.append(text.as_bytes());
        if written.is_err() {
            // a part of a file would be misleading
            let _ = fs::remove_file(&own.path);
        }
        self.note(name, &own);
        written
    }

    /// Notes what was written to a file.
    pub(crate) fn note(&mut self, name: &str, own: &OwnFile) {
        for entry in self.entries.iter_mut().filter(|entry| entry.name == name) {
            entry.sum = text_of(&own.sum);
        }
    }

    /// Writes the checksums of all files into the list, and releases the folder.
    ///
    /// # Errors
    /// That of the operating system; the files stay, and the next run sets them aside.
    pub fn close(mut self) -> io::Result<()> {
        self.write_list()
    }

    fn write_list(&mut self) -> io::Result<()> {
        let mut text = format!("{HEAD}{} since {}\n", std::process::id(), now());
        for Entry { name, sum } in &self.entries {
            text += name;
            text += if sum.is_empty() { "" } else { "\t" };
            text += sum;
            text += "\n";
        }
        self.list.rewind()?;
        self.list.set_len(0)?;
        self.list.write_all(text.as_bytes())
    }

    /// Returns whether a file has the bytes that were written to it.
    fn is_unchanged(&self, entry: &Entry) -> bool {
        let path = self.file(&entry.name);
        let is_file = fs::symlink_metadata(&path).is_ok_and(|metadata| metadata.is_file());
        is_file && sum_of(&path).is_ok_and(|sum| text_of(&sum) == entry.sum)
    }
}

impl OwnFile {
    /// Appends bytes: all, or none where they do not fit on the disk.
    pub fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let written = self.file.write_all(bytes);
        if written.is_err() {
            let _ = self.file.set_len(self.sum.length());
        } else {
            self.sum.add(bytes);
        }
        written
    }

    /// Returns the path.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// Writes files, by their names, to a folder, in place of those of the last run.
///
/// # Errors
/// As [`Folder::take`]; [`Error::Output`].
pub fn save(path: &Path, files: &[(String, String)]) -> Result<(), Error> {
    let names: Vec<String> = files.iter().map(|(name, _)| name.clone()).collect();
    if let Some(name) = names.iter().find(|name| !is_result(name)) {
        let source = io::Error::new(io::ErrorKind::InvalidInput, "no result has such a name");
        return Err(Error::Output { path: path.join(name), source });
    }
    let mut folder = Folder::take(path, &names)?;
    for (name, text) in files {
        folder.write(name, text).map_err(|source| Error::Output { path: path.join(name), source })?;
    }
    folder.close().map_err(|source| Error::Output { path: path.to_path_buf(), source })
}

/// Returns whether a name is one that runs give to their files: nothing outside the folder, whatever a list says.
fn is_result(name: &str) -> bool {
    let is_file = |file: &str| file.ends_with(".csv") && !file.contains(['/', '\\']);
    SERIES.iter().any(|folder| name.strip_prefix(folder).is_some_and(is_file)) || RESULTS.contains(&name)
}

/// Renames a file to the first name `NAME.1`, `NAME.2` that is free.
fn set_aside(path: &Path) -> io::Result<()> {
    if fs::symlink_metadata(path).is_err() {
        return Ok(());
    }
    let named = |number: u32| {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".{number}"));
        PathBuf::from(name)
    };
    let free = (1..).map(named).find(|path| fs::symlink_metadata(path).is_err());
    free.map_or(Ok(()), |free| fs::rename(path, free))
}

/// Returns a checksum and the number of bytes, as a list holds them.
fn text_of(sum: &Checksum) -> String {
    format!("{} {}", sum.digits(), sum.length())
}

/// Returns the checksum of a file.
fn sum_of(path: &Path) -> io::Result<Checksum> {
    let (mut file, mut buffer, mut sum) = (File::open(path)?, vec![0; 1 << 16], Checksum::EMPTY);
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(sum),
            count => sum.add(&buffer[..count]),
        }
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
