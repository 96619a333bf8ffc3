//! `chart`: what a study has measured, as a drawing and a report.

use std::path::{Component, Path, PathBuf};

use clap::{Args, ValueEnum};

use super::context::Context;
use super::exit::{Exit, Failure, Outcome};
use super::output;
use super::results::{Results, read};
use crate::chart::{self, Chart, Choice, METRICS, Metric, REGIONS, Report, Time};
use crate::diagnostic::{Diagnostic, Place, Severity, has_errors};
use crate::studio::Loader;
use crate::study::claims::judge;
use crate::study::figures::figure;
use crate::study::{Record, sheet};

/// Pixels across a picture of the report.
const THUMBNAIL: u32 = 240;

/// The truth that errors are taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Reference {
    Rays,
    Pcf,
}

/// What lies across.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Across {
    /// All passes on the adapter
    #[default]
    Total,
    /// The pass that draws the picture
    Main,
    /// From the submission to the pixels on the host
    Wall,
    /// All passes, beside those of the plain shadow map
    Ratio,
}

impl From<Across> for Time {
    fn from(across: Across) -> Self {
        match across {
            Across::Total => Self::Total,
            Across::Main => Self::Main,
            Across::Wall => Self::Wall,
            Across::Ratio => Self::Ratio,
        }
    }
}

/// Draw error against time of what a study has measured, and report on it
#[derive(Args, Debug)]
#[command(
    after_help = "Writes chart.svg, chart.png and report.html into the folder of results, or what -o names. The report \
is one file with all numbers, claims, and pictures, and needs no network. Fronts and verdicts go to stdout.

Examples:
  shadetree chart target/paper
  shadetree chart target/paper -o paper.svg -o paper.html --time ratio
  shadetree chart target/classes --error percentile_99 --region penumbra -o penumbra.png
  shadetree chart target/classes --format json"
)]
pub(super) struct DrawChart {
    /// Folder of results, as `study` writes it
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// File to write instead: .svg, .png or .html; may be given several times
    #[arg(short, long, value_name = "OUT")]
    output: Vec<PathBuf>,
    /// The truth that errors are taken from; by default rays, where there are such
    #[arg(long, value_enum)]
    reference: Option<Reference>,
    /// What lies across
    #[arg(long, value_enum, default_value_t, value_name = "TIME")]
    time: Across,
    /// What lies upwards
    #[arg(long, default_value = "rms", value_name = "ERROR", value_parser = METRICS.iter().map(|m| m.name).collect::<Vec<_>>())]
    error: String,
    /// Part of the picture that the error is taken over
    #[arg(long, default_value = "all", value_name = "PART", value_parser = REGIONS)]
    region: String,
    /// Size of the frames; by default the one that most was measured with
    #[arg(long, value_name = "WxH", value_parser = super::render::size)]
    frame: Option<(u32, u32)>,
    /// Part of an adapter's name, where the folder holds results of several
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// The form of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Svg,
    Png,
    Html,
}

fn form(path: &Path) -> Option<Form> {
    let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
    match extension.as_str() {
        "svg" => Some(Form::Svg),
        "png" => Some(Form::Png),
        "html" | "htm" => Some(Form::Html),
        _ => None,
    }
}

impl DrawChart {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        let mut files = self.files(context)?;
        let loader = Loader::default();
        let Results { records, study, warnings } = read(&self.folder, &loader)?;
        context.report(&warnings);
        let records = self.of_one_adapter(records)?;
        let mut sheet = sheet::Sheet::default();
        if let Some(source) = &study {
            let (read, found) = sheet::read(source);
            context.report(&found);
            if has_errors(&found) {
                return Ok(Exit::Input);
            }
            sheet = read;
        }
        let chart = match self.chart(&records) {
            Ok(chart) => chart,
            Err(mut failure) => {
                // Claims and published tables are about times, and a report can do with them.
                let drawn = self.output.iter().any(|path| form(path) != Some(Form::Html));
                let has_words = !sheet.claims.is_empty() || !sheet.published.is_empty();
                let Some(chart) = Chart::without_panels(&records, &self.choice()).filter(|_| has_words && !drawn)
                else {
                    return Err(failure);
                };
                failure.diagnostics.iter_mut().for_each(|d| d.severity = Severity::Warning);
                context.report(&failure.diagnostics);
                files.retain(|(_, form)| *form == Form::Html);
                chart
            }
        };
        #[cfg(feature = "render")]
        let progress = super::picture::late(context, "drawing", None);
        let verdicts = judge(&sheet.claims, &records);
        let comparisons: Vec<_> = sheet.published.iter().map(|table| table.compare(&records)).collect();
        let title = if sheet.title.is_empty() { records[0].study.clone() } else { sheet.title };
        let report = Report {
            chart: &chart,
            records: &records,
            title: &title,
            note: &sheet.note,
            verdicts: &verdicts,
            comparisons: &comparisons,
        };
        let made: Result<Vec<_>, Failure> =
            files.iter().map(|(path, form)| Ok((path.as_path(), self.file(*form, &report, &loader)?))).collect();
        #[cfg(feature = "render")]
        progress.finish_and_clear();
        let made = made?;
        let whole: Vec<(&Path, &[u8])> = made.iter().map(|(path, bytes)| (*path, bytes.as_slice())).collect();
        output::write_all(&whole)?;
        files.iter().for_each(|(path, _)| context.say(&format!("wrote {}", path.display())));
        let text = if context.is_json() { format!("{}\n", chart::json(&report)) } else { listing(&report) };
        output::print(text.as_bytes())?;
        Ok(Exit::Done)
    }

    /// What is written, and in which form.
    fn files(&self, context: &Context) -> Result<Vec<(PathBuf, Form)>, Failure> {
        let mut files = Vec::new();
        for path in &self.output {
            let Some(form) = form(path) else {
                let message = format!("`{}` is neither an .svg nor a .png nor an .html", path.display());
                return Err(Failure::usage(message, "name the file with one of these extensions"));
            };
            #[cfg(not(feature = "render"))]
            if form == Form::Png {
                return Err(super::render::cannot_render());
            }
            files.push((path.clone(), form));
        }
        if files.is_empty() {
            files.push((self.folder.join("chart.svg"), Form::Svg));
            if cfg!(feature = "render") {
                files.push((self.folder.join("chart.png"), Form::Png));
            } else {
                context.say("this build makes no PNG files: it was built without the feature `render`");
            }
            files.push((self.folder.join("report.html"), Form::Html));
        }
        Ok(files)
    }

    /// The records of the adapter that is asked for, or of the only one.
    fn of_one_adapter(&self, mut records: Vec<Record>) -> Result<Vec<Record>, Failure> {
        let place = || Place::file(self.folder.display().to_string());
        let mut all: Vec<String> = records.iter().map(|r| r.machine.adapter.clone()).collect();
        all.sort();
        all.dedup();
        if let Some(wanted) = &self.adapter {
            let wanted = wanted.to_lowercase();
            records.retain(|r| r.machine.adapter.to_lowercase().contains(&wanted));
        }
        let mut machines: Vec<_> = records.iter().map(|r| r.machine.clone()).collect();
        machines.sort();
        machines.dedup();
        let listed = |names: &[String]| names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ");
        match machines.as_slice() {
            [_] => Ok(records),
            [] => {
                let wanted = self.adapter.as_deref().unwrap_or_default();
                let message = format!("nothing was measured on an adapter called `{wanted}`");
                let help = format!("the results are of {}", listed(&all));
                Err(vec![Diagnostic::error("ST0664", message, place()).help(help)].into())
            }
            several => {
                let names: Vec<String> =
                    several.iter().map(|m| format!("{} ({}, {})", m.adapter, m.driver, m.backend)).collect();
                let message = "the results are of several adapters or drivers, whose times do not belong in one chart";
                let help = format!("choose one with --adapter; there are {}", listed(&names));
                Err(vec![Diagnostic::error("ST0664", message, place()).help(help)].into())
            }
        }
    }

    fn choice(&self) -> Choice {
        Choice {
            time: self.time.into(),
            metric: Metric::named(&self.error).unwrap_or(METRICS[0]),
            region: self.region.clone(),
            reference: self.reference.map(|r| if r == Reference::Rays { "rays" } else { "pcf" }.to_owned()),
            frame: self.frame,
        }
    }

    fn chart<'a>(&self, records: &'a [Record]) -> Result<Chart<'a>, Failure> {
        let choice = self.choice();
        Chart::new(records, &choice).ok_or_else(|| {
            let failed = records.iter().filter(|r| r.failure.is_some()).count();
            let timed = records.iter().filter(|r| choice.time.of(r).is_some()).count();
            let mut truths: Vec<&str> = records.iter().flat_map(|r| r.errors.keys().map(String::as_str)).collect();
            truths.sort_unstable();
            truths.dedup();
            let message = format!(
                "no cell has both a time and an error: of {} cells {failed} failed and {timed} have such a time",
                records.len()
            );
            let help = match truths.as_slice() {
                [] => "measure errors too: give the study a reference".to_owned(),
                _ if timed == 0 => "try `--time wall`".to_owned(),
                known => format!("errors are there against {}; see also --frame and --region", known.join(", ")),
            };
            let place = Place::file(self.folder.display().to_string());
            vec![Diagnostic::error("ST0665", message, place).help(help)].into()
        })
    }

    fn file(&self, form: Form, report: &Report<'_>, loader: &Loader) -> Result<Vec<u8>, Failure> {
        match form {
            Form::Svg => Ok(chart::svg(report.chart, report.title).into_bytes()),
            Form::Png => png(&chart::svg(report.chart, report.title)),
            Form::Html => {
                let picture = |name: &str| {
                    let path = Path::new(name);
                    // Names come from a file; what they name lies in the folder.
                    let inside = path.components().all(|c| matches!(c, Component::Normal(_)));
                    let bytes = inside.then(|| loader.bytes(&self.folder.join(path)).ok()).flatten()?;
                    chart::small(&bytes, THUMBNAIL)
                };
                Ok(chart::html(report, &picture).into_bytes())
            }
        }
    }
}

#[cfg(feature = "render")]
fn png(svg: &str) -> Result<Vec<u8>, Failure> {
    Ok(crate::studio::figure::rasterized(svg)?)
}

#[cfg(not(feature = "render"))]
fn png(_: &str) -> Result<Vec<u8>, Failure> {
    Err(super::render::cannot_render())
}

/// Fronts and verdicts for people.
fn listing(report: &Report<'_>) -> String {
    let chart = report.chart;
    let mut out = String::new();
    for panel in &chart.panels {
        out.push_str(&format!("{}\n", panel.title()));
        for i in &panel.front {
            let point = &panel.points[*i];
            let time = format!("{}{}", figure(point.time.median), chart.choice.time.unit());
            let name = format!("{} {}", chart.methods[point.method], point.label);
            out.push_str(&format!("  {time:>12}  {:>9}  {}\n", figure(point.error), name.trim_end()));
        }
    }
    if !report.verdicts.is_empty() {
        out.push_str("claims\n");
    }
    for verdict in report.verdicts {
        let number = verdict.decisive().map_or(String::new(), |p| {
            let (low, high) = (figure(p.interval.0), figure(p.interval.1));
            format!(": {} {} ({low} to {high}; {}) of {}", p.what, figure(p.value), p.allowed(), p.place)
        });
        let unsure = if verdict.decisive().is_some_and(|p| !p.sure) { ", unsure" } else { "" };
        out.push_str(&format!("  {:<14} {}{unsure}{number}\n", verdict.id, verdict.outcome.words()));
    }
    out
}
