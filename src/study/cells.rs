//! From a study to the cells that are measured, each once, in an order that is always the same.

use std::collections::{BTreeMap, BTreeSet};

use super::document::Study;

/// Most cells of a study.
pub const MOST: usize = 100_000;

/// One shadow with its settings on one light of one scene at one size.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// Name that is the same in every run and can be that of a file.
    pub name: String,
    /// Position of the case in the study.
    pub case: usize,
    /// Position of the method.
    pub method: usize,
    /// Settings of the shadow node, and of the light as `light.NAME`.
    pub settings: BTreeMap<String, String>,
    /// Those that are varied.
    pub varied: Vec<String>,
    /// Columns and rows.
    pub frame: (u32, u32),
    /// Whether it is there for the comparison alone.
    pub baseline: bool,
}

impl Cell {
    /// What it is besides its frame: cells with the same have the same errors.
    pub fn without_frame(&self) -> String {
        self.name.rsplit_once("--").map_or(&*self.name, |(rest, _)| rest).to_owned()
    }
}

/// Cells that are drawn in turn, and the plain shadow map of each.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Batch {
    /// All of one class of scenes, in order.
    pub cells: Vec<Cell>,
    /// Per cell, the position of its plain shadow map in `cells`.
    pub plain: Vec<usize>,
}

/// Cells of a batch at most. What is compared must be drawn in turn, so that all of a class should fit; but what is stopped
/// in the middle of a batch is measured again.
const BATCH: usize = 64;

/// All cells of a study, or of its quick form, in batches. `has` tells whether a kind of shadow has a setting. The error
/// is a sentence.
pub fn batches(study: &Study, quick: bool, has: &dyn Fn(&str, &str) -> bool) -> Result<Vec<Batch>, String> {
    let mut cells = Vec::new();
    let mut known = BTreeSet::new();
    for grid in study.grids.iter().filter(|g| g.quick || !quick) {
        let wanted = |names: &[String], name: &String| names.is_empty() || names.contains(name);
        for (c, case) in study.cases.iter().enumerate().filter(|(_, c)| wanted(&grid.cases, &c.name)) {
            for (m, method) in study.methods.iter().enumerate().filter(|(_, m)| wanted(&grid.methods, &m.name)) {
                let usable = |(name, _): &&(String, Vec<String>)| name.contains('.') || has(&method.shadow, name);
                let axes: Vec<_> = method.vary.iter().chain(&grid.vary).filter(usable).collect();
                for settings in product(&axes)? {
                    let varied = axes.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
                    let settings: BTreeMap<String, String> = method.set.clone().into_iter().chain(settings).collect();
                    for frame in &grid.frames {
                        let name = cell_name(&case.name, &method.name, &settings, *frame);
                        if known.insert(name.clone()) {
                            let (settings, varied, frame) = (settings.clone(), varied.clone(), *frame);
                            cells.push(Cell { name, case: c, method: m, settings, varied, frame, baseline: false });
                        }
                    }
                }
                if cells.len() > MOST {
                    return Err(format!("the study has more than {MOST} cells"));
                }
            }
        }
    }
    cells.sort_by_key(|c| (c.case, c.method));
    let Some(plain) = study.methods.iter().position(|m| m.name == study.plain) else { return Ok(Vec::new()) };
    let mut all: Vec<Batch> = Vec::new();
    let methods = cells.chunk_by(|a, b| (a.case, a.method) == (b.case, b.method));
    for group in methods.flat_map(|method| method.chunks(BATCH)) {
        let class = |cell: &Cell| &study.cases[cell.case].class;
        let fits = |b: &&mut Batch| class(&b.cells[0]) == class(&group[0]) && b.cells.len() + group.len() <= BATCH;
        match all.last_mut().filter(fits) {
            Some(batch) => batch.cells.extend_from_slice(group),
            None => all.push(Batch { cells: group.to_vec(), plain: Vec::new() }),
        }
    }
    for batch in &mut all {
        for index in 0..batch.cells.len() {
            let wanted = baseline(study, plain, &batch.cells[index], has);
            let known = batch.cells.iter().position(|c| c.name == wanted.name);
            batch.plain.push(known.unwrap_or(batch.cells.len()));
            if known.is_none() {
                batch.cells.push(wanted);
            }
        }
        // A plain shadow map is its own.
        (batch.plain.len()..batch.cells.len()).for_each(|own| batch.plain.push(own));
    }
    Ok(all)
}

/// The plain shadow map that a cell is compared with: same case and frame, and the cell's settings where it has them.
fn baseline(study: &Study, plain: usize, cell: &Cell, has: &dyn Fn(&str, &str) -> bool) -> Cell {
    let method = &study.methods[plain];
    let mut settings = method.set.clone();
    for (name, value) in &cell.settings {
        // Only what belongs to the map itself: a plain shadow map has no filter.
        if name == "size" && has(&method.shadow, name) || name.starts_with("light.") {
            settings.insert(name.clone(), value.clone());
        }
    }
    let name = cell_name(&study.cases[cell.case].name, &method.name, &settings, cell.frame);
    let varied = cell.varied.iter().filter(|v| settings.contains_key(*v)).cloned().collect();
    Cell { name, case: cell.case, method: plain, settings, varied, frame: cell.frame, baseline: true }
}

/// All combinations, the last axis fastest.
fn product(axes: &[&(String, Vec<String>)]) -> Result<Vec<Vec<(String, String)>>, String> {
    let mut all = vec![Vec::new()];
    for (name, values) in axes {
        if all.len().saturating_mul(values.len()) > MOST {
            return Err(format!("`{name}` makes more than {MOST} combinations"));
        }
        let with = |so_far: &Vec<(String, String)>| {
            let one = |value: &String| so_far.iter().cloned().chain([(name.clone(), value.clone())]).collect();
            values.iter().map(one).collect::<Vec<Vec<_>>>()
        };
        all = all.iter().flat_map(with).collect();
    }
    Ok(all)
}

fn cell_name(case: &str, method: &str, settings: &BTreeMap<String, String>, frame: (u32, u32)) -> String {
    let settings: Vec<String> = settings.iter().map(|(name, value)| format!("{name}={value}")).collect();
    let parts = [case.to_owned(), method.to_owned(), settings.join(","), format!("{}x{}", frame.0, frame.1)];
    parts.iter().map(|p| slug(p)).collect::<Vec<_>>().join("--")
}

/// Letters that file systems do not mind. What is changed is told apart by its number, so that no two become one.
pub fn slug(text: &str) -> String {
    let fine = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '=' | ',');
    let plain = |c: char| match c {
        c if fine(c) => c,
        ' ' => '-',
        _ => '_',
    };
    let mut slug: String = text.chars().map(plain).collect();
    let changed = text.chars().filter(|c| !fine(*c) && *c != ' ').fold(0_u32, |n, c| n.wrapping_mul(31) ^ u32::from(c));
    if changed != 0 {
        slug.push_str(&format!("~{changed:x}"));
    }
    slug
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::SourceText;
    use crate::study::read::read;

    fn study(grids: &str) -> Study {
        let text = format!(
            "Study(version: 1, plain: \"hard\", cases: {{\"a\": (scene: \"a\", light: \"l\"), \"b\": (scene: \"b\", light: \"l\")}}, \
             methods: {{\"hard\": (shadow: \"h\", set: {{\"metric\": \"zw\"}}), \"soft\": (shadow: \"s\", vary: {{\"width\": [3, 5]}})}}, \
             grids: [{grids}])"
        );
        let (study, found) = read(&SourceText::new("s.ron", text));
        study.unwrap_or_else(|| panic!("{found:?}"))
    }

    /// The soft shadow alone has a width.
    fn has(kind: &str, name: &str) -> bool {
        name == "size" || (kind == "s" && name == "width")
    }

    fn names(grids: &str, quick: bool) -> Vec<String> {
        let batches = batches(&study(grids), quick, &has).expect("cells");
        batches.iter().flat_map(|b| &b.cells).map(|c| c.name.clone()).collect()
    }

    #[test]
    fn cells_are_all_combinations_each_once() {
        let one = "(cases: [\"a\"], frames: [(4, 3)], vary: {\"size\": [64, 128]})";
        let expected = [
            "a--hard--metric=zw,size=64--4x3",
            "a--hard--metric=zw,size=128--4x3",
            "a--soft--size=64,width=3--4x3",
            "a--soft--size=128,width=3--4x3",
            "a--soft--size=64,width=5--4x3",
            "a--soft--size=128,width=5--4x3",
        ];
        assert_eq!(names(one, false), expected);
        assert_eq!(names(&format!("{one}, {one}"), false), expected);
        assert_eq!(names(one, true), Vec::<String>::new());
        assert_eq!(names("(frames: [(4, 3)], quick: true)", true).len(), 6);
    }

    #[test]
    fn every_cell_has_the_plain_map_of_its_size_and_frame_in_its_batch() {
        let grid = "(methods: [\"soft\"], frames: [(4, 3), (8, 6)], vary: {\"size\": [64, 128]})";
        for batch in batches(&study(grid), false, &has).expect("cells") {
            assert_eq!(batch.cells.len(), batch.plain.len());
            for (cell, plain) in batch.cells.iter().zip(&batch.plain) {
                let plain = &batch.cells[*plain];
                assert_eq!((plain.case, plain.method, plain.frame), (cell.case, 0, cell.frame));
                assert_eq!(plain.settings.get("size"), cell.settings.get("size"));
                assert!(plain.baseline && plain.plain_has_no_width());
            }
        }
    }

    impl Cell {
        fn plain_has_no_width(&self) -> bool {
            !self.settings.contains_key("width")
        }
    }

    #[test]
    fn batches_are_bounded_and_names_told_apart() {
        let sizes: Vec<String> = (0..70).map(|i| i.to_string()).collect();
        let grid = format!("(frames: [(4, 3)], vary: {{\"size\": [{}]}})", sizes.join(", "));
        let all = batches(&study(&grid), false, &has).expect("cells");
        // The two cases are of two classes.
        assert!(all.iter().all(|b| b.cells.iter().all(|c| c.case == b.cells[0].case)));
        assert_ne!(slug("a/b"), slug("a:b"));
        assert_ne!(slug("a b"), slug("a_b"));
        let many: Vec<String> = (0..400).map(|i| i.to_string()).collect();
        let axis = many.join(", ");
        let vary = format!("\"size\": [{axis}], \"light.x\": [{axis}]");
        assert!(batches(&study(&format!("(frames: [(4, 3)], vary: {{{vary}}})")), false, &has).is_err());
    }
}
