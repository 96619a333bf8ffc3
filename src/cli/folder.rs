//! A folder of results that is written to: one line a cell in `results.jsonl`, the study that they belong to, a table, and
//! pictures. Lines are added whole, or all of them replaced at once, so what is finished is never lost.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::exit::{Exit, Failure};
use super::output;
use crate::diagnostic::{Diagnostic, Place, has_errors};
use crate::studio::Loader;
use crate::study::folder::{RESULTS, STUDY, parse};
use crate::study::{Record, table};

/// A folder that this run alone writes to.
pub(super) struct Folder {
    path: PathBuf,
    /// Held as long as the folder is in use.
    _lock: File,
    lines: File,
    /// The last record of each cell.
    pub(super) records: BTreeMap<String, Record>,
}

impl Folder {
    /// Opens a folder, which is made if it is not there, for a study with this text.
    pub(super) fn open(path: &Path, study: &str) -> Result<Self, Failure> {
        let io = |p: &Path| {
            let p = p.to_owned();
            move |e: std::io::Error| Failure::write(&p, &e)
        };
        std::fs::create_dir_all(path.join("pictures")).map_err(io(path))?;
        let lock_path = path.join(".lock");
        let lock = OpenOptions::new().create(true).append(true).open(&lock_path).map_err(io(&lock_path))?;
        if lock.try_lock().is_err() {
            let message = format!("another run is writing into {}", path.display());
            let help = "wait for it, or give -o another folder";
            return Err(Failure::new(Exit::Io, Diagnostic::error("ST0620", message, place(path)).help(help)));
        }
        let copy = path.join(STUDY);
        let records = read(path)?;
        match std::fs::read_to_string(&copy) {
            Ok(known) if known == study => {}
            Ok(_) if !records.is_empty() => {
                let message = format!("{} holds results of another study", path.display());
                let help = "give -o a new folder, or put the study back as it was";
                return Err(Failure::new(Exit::Input, Diagnostic::error("ST0621", message, place(&copy)).help(help)));
            }
            _ => output::write(&copy, study.as_bytes())?,
        }
        let file = path.join(RESULTS);
        let mut lines = reopen(&file)?;
        cut_off(&mut lines).map_err(io(&file))?;
        Ok(Self { path: path.to_owned(), _lock: lock, lines, records })
    }

    /// Adds records with their pictures. What was there stays, whatever happens.
    pub(super) fn add(&mut self, records: Vec<Record>, pictures: &[(String, Vec<u8>)]) -> Result<(), Failure> {
        // Pictures first: a record that names one has it.
        for (name, bytes) in pictures {
            output::write(&self.path.join(name), bytes)?;
        }
        let again = records.iter().any(|r| self.records.contains_key(&r.cell));
        let added = lines(&records);
        self.records.extend(records.into_iter().map(|r| (r.cell.clone(), r)));
        let file = self.path.join(RESULTS);
        if again {
            // A cell that was measured again has one line all the same.
            output::write(&file, lines(self.records.values()).as_bytes())?;
            self.lines = reopen(&file)?;
            return self.tabulate();
        }
        let before = self.lines.seek(SeekFrom::End(0)).map_err(|e| Failure::write(&file, &e))?;
        if let Err(error) = self.lines.write_all(added.as_bytes()).and_then(|()| self.lines.sync_data()) {
            // Half a line would stand in the way of the next.
            let _ = self.lines.set_len(before);
            return Err(Failure::write(&file, &error));
        }
        self.tabulate()
    }

    fn tabulate(&self) -> Result<(), Failure> {
        let all: Vec<Record> = self.records.values().cloned().collect();
        output::write(&self.path.join("results.csv"), table::csv(&all).as_bytes())
    }
}

/// The last record of each cell; none where there is no file. A last line that a crash cut off is passed over.
fn read(folder: &Path) -> Result<BTreeMap<String, Record>, Failure> {
    let file = folder.join(RESULTS);
    if !file.exists() {
        return Ok(BTreeMap::new());
    }
    let (records, found) = parse(&Loader::default().text(&file)?);
    if has_errors(&found) {
        return Err(found.into());
    }
    Ok(records.into_iter().map(|r| (r.cell.clone(), r)).collect())
}

fn lines<'a>(records: impl IntoIterator<Item = &'a Record>) -> String {
    let line = |record| serde_json::to_string(record).unwrap_or_default() + "\n";
    records.into_iter().map(line).collect()
}

fn reopen(file: &Path) -> Result<File, Failure> {
    let opened = OpenOptions::new().create(true).read(true).append(true).open(file);
    opened.map_err(|e| Failure::write(file, &e))
}

/// Takes away what follows the last whole line.
fn cut_off(file: &mut File) -> std::io::Result<()> {
    let length = file.seek(SeekFrom::End(0))?;
    if length == 0 {
        return Ok(());
    }
    let mut at = length;
    let mut block = vec![0; 64 << 10];
    while at > 0 {
        let size = at.min(block.len() as u64);
        at -= size;
        file.seek(SeekFrom::Start(at))?;
        let part = &mut block[..usize::try_from(size).unwrap_or(0)];
        file.read_exact(part)?;
        if let Some(end) = part.iter().rposition(|b| *b == b'\n') {
            let whole = at + end as u64 + 1;
            return if whole < length { file.set_len(whole) } else { Ok(()) };
        }
    }
    file.set_len(0)
}

fn place(path: &Path) -> Place {
    Place::file(path.display().to_string())
}
