//! A folder of results: one line a cell in `results.jsonl`, the study that they belong to, a table, and pictures. Lines are
//! only ever added, and whole, so what is finished is never lost.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::exit::{Exit, Failure};
use super::output;
use crate::diagnostic::{Diagnostic, Place};
use crate::study::record::VERSION;
use crate::study::{Record, table};

/// Most bytes of results that are read.
const MOST_BYTES: u64 = 1 << 30;

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
        let copy = path.join("study.ron");
        let records = read(path, false)?;
        match std::fs::read_to_string(&copy) {
            Ok(known) if known == study => {}
            Ok(_) if !records.is_empty() => {
                let message = format!("{} holds results of another study", path.display());
                let help = "give -o a new folder, or put the study back as it was";
                return Err(Failure::new(Exit::Input, Diagnostic::error("ST0621", message, place(&copy)).help(help)));
            }
            _ => output::write(&copy, study.as_bytes())?,
        }
        let file = path.join("results.jsonl");
        let mut lines = OpenOptions::new().create(true).read(true).append(true).open(&file).map_err(io(&file))?;
        cut_off(&mut lines).map_err(io(&file))?;
        Ok(Self { path: path.to_owned(), _lock: lock, lines, records })
    }

    /// Adds records with their pictures. What was there stays, whatever happens.
    pub(super) fn add(&mut self, records: Vec<Record>, pictures: &[(String, Vec<u8>)]) -> Result<(), Failure> {
        // Pictures first: a record that names one has it.
        for (name, bytes) in pictures {
            output::write(&self.path.join(name), bytes)?;
        }
        let mut text = String::new();
        for record in &records {
            text.push_str(&serde_json::to_string(record).unwrap_or_default());
            text.push('\n');
        }
        let file = self.path.join("results.jsonl");
        let before = self.lines.seek(SeekFrom::End(0)).map_err(|e| Failure::write(&file, &e))?;
        let added = self.lines.write_all(text.as_bytes()).and_then(|()| self.lines.sync_data());
        if let Err(error) = added {
            // Half a line would stand in the way of the next.
            let _ = self.lines.set_len(before);
            return Err(Failure::write(&file, &error));
        }
        self.records.extend(records.into_iter().map(|r| (r.cell.clone(), r)));
        self.tabulate()
    }

    fn tabulate(&self) -> Result<(), Failure> {
        let all: Vec<Record> = self.records.values().cloned().collect();
        output::write(&self.path.join("results.csv"), table::csv(&all).as_bytes())
    }
}

/// The last record of each cell. A last line that a crash cut off is passed over. Where there is nothing, nothing is read,
/// unless something `must` be there.
pub(super) fn read(folder: &Path, must: bool) -> Result<BTreeMap<String, Record>, Failure> {
    let file = folder.join("results.jsonl");
    let wrong = |code, message: String, help: &str| {
        Failure::new(Exit::Input, Diagnostic::error(code, message, place(&file)).help(help))
    };
    let mut text = String::new();
    match File::open(&file).and_then(|f| f.take(MOST_BYTES).read_to_string(&mut text)) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
        Err(error) => {
            let message = format!("cannot read {}: {error}", file.display());
            let help = "name a folder that `shadetree study` wrote";
            return Err(Failure::new(Exit::Io, Diagnostic::error("ST0501", message, place(&file)).help(help)));
        }
        Ok(_) => {}
    }
    let mut records = BTreeMap::new();
    let whole = text.rfind('\n').map_or("", |end| &text[..end]);
    for (index, line) in whole.lines().enumerate() {
        let version = serde_json::from_str::<serde_json::Value>(line).ok().and_then(|v| v.get("version")?.as_u64());
        match (version, serde_json::from_str::<Record>(line)) {
            (Some(v), _) if v != u64::from(VERSION) => {
                let message = format!("line {} is of version {v}; this program knows {VERSION}", index + 1);
                return Err(wrong("ST0622", message, "give -o a new folder"));
            }
            (_, Ok(record)) => drop(records.insert(record.cell.clone(), record)),
            (_, Err(error)) => {
                let message = format!("line {} is no result: {error}", index + 1);
                return Err(wrong("ST0622", message, "give -o a new folder, or take the line out"));
            }
        }
    }
    if records.is_empty() && must {
        let message = format!("there are no results in {}", folder.display());
        return Err(wrong("ST0624", message, "run `shadetree study FILE -o DIR` first"));
    }
    Ok(records)
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
