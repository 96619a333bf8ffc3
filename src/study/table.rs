//! Records as a table of comma-separated values, one cell a row, for other programs.

use std::borrow::Cow;

use super::record::{Record, Role};
use super::statistics::Spread;

/// The table, with a first row of names. Times are milliseconds; what is not known is empty.
pub fn csv(records: &[Record]) -> String {
    let mut out = String::new();
    let spread = ["median", "mad", "min", "count", "outliers"];
    let times = ["light", "filter", "main", "total", "wall", "ratio"];
    let metrics = ["rmse", "bias", "max", "p99", "over_step", "over_twentieth", "false_lit", "false_dark"];
    let mut names: Vec<String> = [
        "cell",
        "case",
        "class",
        "scene",
        "light",
        "method",
        "shadow",
        "settings",
        "baseline",
        "columns",
        "rows",
        "side",
        "bits",
        "format",
        "triangles",
    ]
    .map(str::to_owned)
    .to_vec();
    names.extend(times.iter().flat_map(|t| spread.iter().map(move |s| format!("{t}_{s}"))));
    let mut references: Vec<&String> = records.iter().flat_map(|r| r.errors.keys()).collect();
    references.sort();
    references.dedup();
    names.extend(references.iter().flat_map(|r| metrics.iter().map(move |m| format!("{r}_{m}"))));
    names.extend(["adapter", "driver", "backend", "software", "failure"].map(str::to_owned));
    row(&mut out, &names);
    for r in records {
        let settings: Vec<String> = r.settings.iter().map(|(n, v)| format!("{n}={v}")).collect();
        let number = |n: Option<u32>| n.map_or_else(String::new, |n| n.to_string());
        let mut cells = vec![
            r.cell.clone(),
            r.case.clone(),
            r.class.clone(),
            r.scene.clone(),
            r.light.clone(),
            r.method.clone(),
            r.shadow.clone(),
            settings.join(" "),
            r.baseline.to_string(),
            r.frame.0.to_string(),
            r.frame.1.to_string(),
            number(r.side),
            number(r.bits),
            r.format.clone().unwrap_or_default(),
            r.triangles.to_string(),
        ];
        let series = [
            r.time_of(&[Role::Light]),
            r.time_of(&[Role::Filter]),
            r.time_of(&[Role::Main]),
            r.total(),
            Some(r.wall.clone()),
            r.ratios(),
        ];
        for samples in series {
            match samples.as_deref().and_then(Spread::of) {
                Some(s) => cells.extend([
                    s.median.to_string(),
                    s.mad.to_string(),
                    s.min.to_string(),
                    s.count.to_string(),
                    s.outliers.to_string(),
                ]),
                None => cells.extend(spread.map(|_| String::new())),
            }
        }
        for reference in &references {
            match r.error(reference) {
                Some(m) => cells.extend(
                    [m.rms, m.bias, m.most, m.percentile_99, m.over_step, m.over_twentieth, m.false_lit, m.false_dark]
                        .map(|n| n.to_string()),
                ),
                None => cells.extend(metrics.map(|_| String::new())),
            }
        }
        let machine = &r.machine;
        cells.extend([machine.adapter.clone(), machine.driver.clone(), machine.backend.clone()]);
        cells.extend([machine.software.to_string(), r.failure.clone().unwrap_or_default()]);
        row(&mut out, &cells);
    }
    out
}

/// One row, as RFC 4180 has it but for the end of the line.
fn row(out: &mut String, cells: &[String]) {
    for (index, cell) in cells.iter().enumerate() {
        if index > 0 {
            out.push(',');
        }
        out.push_str(&quoted(cell));
    }
    out.push('\n');
}

fn quoted(cell: &str) -> Cow<'_, str> {
    if cell.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", cell.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(cell)
    }
}

#[cfg(test)]
mod tests {
    use super::super::record::Series;
    use super::*;

    #[test]
    fn a_table_has_a_row_a_cell_and_as_many_columns_in_each() {
        let passes = vec![Series { name: "main".into(), role: Role::Main, milliseconds: vec![2.0, 4.0] }];
        let record = Record { cell: "a,b".into(), method: "say \"x\"".into(), passes, ..Record::default() };
        let text = csv(&[record.clone(), Record { passes: Vec::new(), ..record }]);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[1].starts_with("\"a,b\",,,,,\"say \"\"x\"\"\","), "{}", lines[1]);
        assert!(lines[1].contains(",3,1,2,2,0,"), "{}", lines[1]);
        let commas = |line: &str| line.replace("\"a,b\"", "").matches(',').count();
        assert!(lines.iter().all(|l| commas(l) == commas(lines[0])));
    }
}
