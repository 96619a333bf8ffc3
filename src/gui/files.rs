//! Files of the editor: graphs, what is kept between runs, and what a crash must not take.
//!
//! While a graph differs from its file, its text is kept in a folder that belongs to this run. The folder of a run that
//! ended without tidying up is offered when the editor starts the next time.

use std::fs::File;
use std::path::{Path, PathBuf};

use etcetera::BaseStrategy;
use serde_json::{Value as Json, json};

use crate::studio::write;

/// Where the editor keeps things.
#[derive(Clone, Debug)]
pub struct Places {
    config: PathBuf,
    state: PathBuf,
}

/// A graph that a run did not get to save.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Lost {
    /// Its file, if it had one.
    pub(super) path: Option<PathBuf>,
    pub(super) text: String,
    file: PathBuf,
}

/// What is kept between runs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Settings {
    pub(super) dark: bool,
    pub(super) scale: f32,
    pub(super) snap: bool,
    pub(super) minimap: bool,
    pub(super) outline: bool,
    pub(super) bottom: bool,
    pub(super) side: bool,
    pub(super) welcomed: bool,
    /// Newest first.
    pub(super) recent: Vec<PathBuf>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            dark: true,
            scale: 1.0,
            snap: true,
            minimap: true,
            outline: true,
            bottom: true,
            side: true,
            welcomed: false,
            recent: Vec::new(),
        }
    }
}

/// Most recent files that are remembered.
const RECENT: usize = 12;

impl Places {
    /// The places of this system for this person. None where there is no home.
    pub fn of_system() -> Option<Self> {
        let base = etcetera::choose_base_strategy().ok()?;
        let state = base.state_dir().unwrap_or_else(|| base.cache_dir());
        Some(Self { config: base.config_dir().join("shadetree"), state: state.join("shadetree") })
    }

    /// Places in a folder.
    pub fn within(folder: &Path) -> Self {
        Self { config: folder.join("config"), state: folder.join("state") }
    }

    fn settings_file(&self) -> PathBuf {
        self.config.join("editor.json")
    }

    /// What was kept. What cannot be read is as if it had never been.
    pub(super) fn settings(&self) -> Settings {
        let mut settings = Settings::default();
        let Some(json) = std::fs::read(self.settings_file()).ok().and_then(|b| serde_json::from_slice::<Json>(&b).ok())
        else {
            return settings;
        };
        for (name, flag) in settings.flags() {
            *flag = json[name].as_bool().unwrap_or(*flag);
        }
        if let Some(scale) = json["scale"].as_f64().filter(|s| (0.5..=3.0).contains(s)) {
            settings.scale = super::preview::narrow(scale);
        }
        let recent = json["recent"].as_array().into_iter().flatten();
        settings.recent = recent.filter_map(|p| p.as_str().map(PathBuf::from)).take(RECENT).collect();
        settings
    }

    /// Keeps settings. It is no loss where that cannot be done.
    pub(super) fn keep(&self, settings: &Settings) {
        let mut copy = settings.clone();
        let mut json = json!({ "version": 1, "scale": settings.scale, "recent": settings.recent });
        for (name, flag) in copy.flags() {
            json[name] = json!(*flag);
        }
        let _ = std::fs::create_dir_all(&self.config);
        let _ = write(&self.settings_file(), format!("{json:#}\n").as_bytes());
    }
}

impl Settings {
    fn flags(&mut self) -> [(&'static str, &mut bool); 7] {
        [
            ("dark", &mut self.dark),
            ("snap", &mut self.snap),
            ("minimap", &mut self.minimap),
            ("outline", &mut self.outline),
            ("bottom", &mut self.bottom),
            ("side", &mut self.side),
            ("welcomed", &mut self.welcomed),
        ]
    }

    /// Puts a file first among the recent ones.
    pub(super) fn opened(&mut self, path: &Path) {
        let full = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        self.recent.retain(|p| *p != full);
        self.recent.insert(0, full);
        self.recent.truncate(RECENT);
    }
}

/// The folder of this run for texts that are not saved. It is removed when the run ends in good order.
pub(super) struct Recovery {
    folder: PathBuf,
    // Locked while this run lives.
    _lock: File,
}

impl Recovery {
    /// The folder of this run, and what earlier runs left behind.
    pub(super) fn start(places: &Places) -> std::io::Result<(Self, Vec<Lost>)> {
        let all = places.state.join("recovery");
        std::fs::create_dir_all(&all)?;
        let mut lost = Vec::new();
        for entry in std::fs::read_dir(&all)?.flatten() {
            let folder = entry.path();
            // A lock that can be had belongs to a run that is over.
            let Ok(lock) = File::open(folder.join("lock")) else { continue };
            if lock.try_lock().is_err() {
                continue;
            }
            let found = left_in(&folder);
            if found.is_empty() {
                let _ = std::fs::remove_dir_all(&folder);
            }
            lost.extend(found);
        }
        lost.sort_by(|a, b| a.file.cmp(&b.file));
        let folder = tempfile::Builder::new().prefix("run-").tempdir_in(&all)?.keep();
        let lock = File::create(folder.join("lock"))?;
        lock.lock()?;
        Ok((Self { folder, _lock: lock }, lost))
    }

    fn file(&self, key: &Path) -> PathBuf {
        let readable: String =
            key.to_string_lossy().chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        let tail: String = readable.chars().rev().take(80).collect::<Vec<_>>().into_iter().rev().collect();
        let sum = key
            .to_string_lossy()
            .bytes()
            .fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
        self.folder.join(format!("{tail}-{sum:016x}.json"))
    }

    /// Keeps the text of a graph.
    pub(super) fn keep(&self, key: &Path, path: Option<&Path>, text: &str) -> Result<(), String> {
        let json = json!({ "path": path, "text": text });
        write(&self.file(key), json.to_string().as_bytes()).map_err(|f| f.to_string())
    }

    /// Forgets a graph that is saved, or closed on purpose.
    pub(super) fn forget(&self, key: &Path) {
        let _ = std::fs::remove_file(self.file(key));
    }

    /// Ends in good order: nothing is left to recover.
    pub(super) fn finish(&self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

/// Forgets what was left behind, once a person has it or does not want it.
pub(super) fn discard(lost: &[Lost]) {
    for one in lost {
        let _ = std::fs::remove_file(&one.file);
    }
}

fn left_in(folder: &Path) -> Vec<Lost> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    files
        .filter(|p| p.extension().is_some_and(|e| e == "json"))
        .filter_map(|file| {
            let json: Json = serde_json::from_slice(&std::fs::read(&file).ok()?).ok()?;
            let text = json["text"].as_str()?.to_owned();
            Some(Lost { path: json["path"].as_str().map(PathBuf::from), text, file })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_crash_left_is_found_once_and_what_lives_is_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let places = Places::within(folder.path());
        let (first, lost) = Recovery::start(&places).expect("started");
        assert!(lost.is_empty());
        first.keep(Path::new("a.ron"), Some(Path::new("a.ron")), "Graph()").expect("kept");
        let (second, lost) = Recovery::start(&places).expect("started");
        assert!(lost.is_empty(), "the first run lives");
        drop(first);
        second.finish();
        drop(second);
        let (_third, lost) = Recovery::start(&places).expect("started");
        assert_eq!(
            lost.iter().map(|l| (l.path.clone(), l.text.as_str())).collect::<Vec<_>>(),
            [(Some("a.ron".into()), "Graph()")]
        );
        discard(&lost);
        let (_fourth, lost) = Recovery::start(&places).expect("started");
        assert!(lost.is_empty());
    }

    #[test]
    fn settings_are_kept_and_nonsense_is_ignored() {
        let folder = tempfile::tempdir().expect("a folder");
        let places = Places::within(folder.path());
        assert_eq!(places.settings(), Settings::default());
        let mut settings = Settings { dark: false, scale: 1.5, minimap: false, ..Settings::default() };
        settings.opened(Path::new("/x/a.ron"));
        settings.opened(Path::new("/x/b.ron"));
        settings.opened(Path::new("/x/a.ron"));
        assert_eq!(settings.recent, [PathBuf::from("/x/a.ron"), "/x/b.ron".into()]);
        places.keep(&settings);
        assert_eq!(places.settings(), settings);
        std::fs::write(places.settings_file(), "{\"scale\": 99, \"dark\": 3").expect("written");
        assert_eq!(places.settings(), Settings::default());
    }
}
