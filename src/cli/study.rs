//! `study`: measure every cell of a study, and put results of several machines together.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::context::Context;
use super::exit::Outcome;

/// Measure shadows against each other: times by pass, errors against the truth
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    after_help = "Examples:
  shadetree study graphs/studies/paper.ron -o target/paper
  shadetree study graphs/studies/paper.ron -o target/quick --quick
  parallel -j1 shadetree study S.ron -o part{} --shard {}/4 ::: 1 2 3 4
  shadetree study merge part1 part2 part3 part4 -o whole

A run that was stopped goes on where it was: give it the same folder."
)]
pub(super) struct RunStudy {
    #[command(subcommand)]
    pub(super) command: Option<StudyCommand>,
    /// Study file
    #[arg(value_name = "STUDY", required = true)]
    pub(super) study: Option<PathBuf>,
    /// Folder for the results; what it holds already is not measured again
    #[arg(short, long, value_name = "DIR", required_unless_present = "list")]
    pub(super) output: Option<PathBuf>,
    /// Only the grids that are marked as quick, without errors; then the laws that the study claims must hold
    #[arg(long)]
    pub(super) quick: bool,
    /// Measure one of N parts
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub(super) shard: Option<(usize, usize)>,
    /// List the cells instead of measuring them
    #[arg(long)]
    pub(super) list: bool,
    /// Part of an adapter's name, or `cpu` for a software one
    #[arg(long, value_name = "NAME")]
    pub(super) adapter: Option<String>,
    /// Folder with further nodes; may be given several times
    #[arg(long, value_name = "DIR")]
    pub(super) nodes: Vec<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(super) enum StudyCommand {
    Merge(Merge),
}

/// Put results of one study from several folders into one
#[derive(Args, Debug)]
pub(super) struct Merge {
    /// Folders of results
    #[arg(value_name = "DIR", required = true)]
    pub(super) folders: Vec<PathBuf>,
    /// Folder for all of them
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: PathBuf,
    /// Although they were measured on different adapters
    #[arg(long)]
    pub(super) mixed: bool,
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parsed = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    parsed
        .filter(|(i, n)| (1..=*n).contains(i))
        .ok_or_else(|| "expected I/N with I from 1 to N, as in `2/4`".to_owned())
}

impl RunStudy {
    pub(super) fn run(&self, context: &Context) -> Outcome {
        if let Some(StudyCommand::Merge(merge)) = &self.command {
            return super::merge::run(merge, context);
        }
        self.start(context)
    }

    #[cfg(not(feature = "render"))]
    fn start(&self, _: &Context) -> Outcome {
        Err(super::render::cannot_render())
    }

    #[cfg(feature = "render")]
    fn start(&self, context: &Context) -> Outcome {
        super::experiment::run(self, context)
    }
}
