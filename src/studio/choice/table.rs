//! Where tables of costs are kept: one file for each device, in the folder for caches that the caller names.

use std::path::{Path, PathBuf};

use crate::choose::{CostTable, VERSION};
use crate::studio::write::{Unwritten, write};

/// Most bytes of a table that are read.
const MOST: u64 = 1 << 20;

/// The file of a device below a folder for caches.
pub fn table_path(caches: &Path, device: &str) -> PathBuf {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' { c.to_ascii_lowercase() } else { '-' };
    let name: String = device.chars().map(plain).take(120).collect();
    caches.join("shadetree").join(format!("cost-{name}.json"))
}

/// The table in a file. None where there is none, where it cannot be read, or where it is of another version or device.
pub fn read_table(path: &Path, device: Option<&str>) -> Option<CostTable> {
    if std::fs::metadata(path).ok()?.len() > MOST {
        return None;
    }
    let table: CostTable = serde_json::from_str(&std::fs::read_to_string(path).ok()?).ok()?;
    let sound = table.items.values().all(|v| v.is_finite() && *v >= 0.0);
    (table.version == VERSION && sound && device.is_none_or(|d| d == table.device)).then_some(table)
}

/// Keeps a table, whole or not at all.
pub fn write_table(path: &Path, table: &CostTable) -> Result<(), Unwritten> {
    let failed = |error| Unwritten { path: path.to_path_buf(), error };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    let mut text = serde_json::to_string_pretty(table).map_err(|e| failed(e.into()))?;
    text.push('\n');
    write(path, text.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_kept_and_strange_ones_passed_over() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = table_path(folder.path(), "llvmpipe (LLVM 15, 256 bits) Mesa/22");
        assert!(path.ends_with("shadetree/cost-llvmpipe--llvm-15--256-bits--mesa-22.json"), "{}", path.display());
        let table = CostTable { version: VERSION, device: "a".into(), items: [("pixel".to_owned(), 1.5)].into() };
        write_table(&path, &table).expect("written");
        assert_eq!(read_table(&path, Some("a")), Some(table.clone()));
        assert_eq!(read_table(&path, Some("b")), None);
        write_table(&path, &CostTable { version: VERSION + 1, ..table.clone() }).expect("written");
        assert_eq!(read_table(&path, Some("a")), None);
        write_table(&path, &CostTable { items: [("pixel".to_owned(), -1.0)].into(), ..table }).expect("written");
        assert_eq!(read_table(&path, None), None);
        std::fs::write(&path, "{").expect("written");
        assert_eq!(read_table(&path, None), None);
    }
}
