//! The command line. One table, `Command`, feeds help, manual page and completions.
//!
//! stdout is data, stderr is messages and progress, `-` is stdin or stdout. Exit codes: see [`Exit`].

mod chart;
mod check;
#[cfg(feature = "render")]
mod choice;
mod choose;
#[cfg(feature = "render")]
mod comparison;
mod compare;
mod completions;
mod context;
mod doctor;
mod edit;
mod exit;
#[cfg(feature = "render")]
mod experiment;
mod explain;
mod figure;
mod fmt;
mod folder;
mod generate;
mod merge;
#[cfg(feature = "render")]
mod ladder;
mod new;
mod nodes;
mod output;
#[cfg(feature = "render")]
mod picture;
mod render;
mod results;
mod study;
mod simplify;
#[cfg(feature = "render")]
mod truth;
mod watch;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

use crate::diagnostic::{Diagnostic, Place};
use context::{Color, Context, Format};
pub use exit::Exit;
use exit::{Failure, Outcome};

/// Weaves light, shadow and surface nodes into WGSL, proves it, and shows it.
#[derive(Debug, Parser)]
#[command(
    name = "shadetree",
    version,
    arg_required_else_help = cfg!(not(feature = "gui")),
    after_help = "Exit codes: 0 done, 1 the input is wrong, 2 the command line is wrong, 3 a file cannot be read or \
written, 4 no suitable graphics adapter.

Without a command the editor opens.

Examples:
  shadetree edit graphs/surfaces/bumpy_glass.ron
  shadetree generate graphs/lights/spot_vsm.ron graphs/surfaces/bumpy_glass.ron
  shadetree render graphs/scenes/car.ron -o car.png
  shadetree explain ST0501"
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Form of messages and listings
    #[arg(long, global = true, value_enum, default_value_t, value_name = "FORM")]
    format: Format,
    /// When to colour messages (NO_COLOR is heeded)
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    color: Color,
    /// Only errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// More detail
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    verbose: u8,
}

#[derive(Debug, Subcommand)]
enum Command {
    Edit(edit::Edit),
    Generate(generate::Generate),
    Check(check::Check),
    Render(render::Render),
    Compare(compare::Compare),
    Chart(chart::DrawChart),
    Choose(choose::Choose),
    Figure(figure::DrawFigure),
    Study(study::RunStudy),
    Simplify(simplify::Simplify),
    Nodes(nodes::Nodes),
    Fmt(fmt::Fmt),
    New(new::New),
    Explain(explain::Explain),
    Doctor(doctor::Doctor),
    Completions(completions::Completions),
    Man(completions::Man),
}

impl Command {
    fn run(&self, context: &Context) -> Outcome {
        match self {
            Self::Edit(c) => c.run(context),
            Self::Generate(c) => c.run(context),
            Self::Check(c) => c.run(context),
            Self::Render(c) => c.run(context),
            Self::Compare(c) => c.run(context),
            Self::Chart(c) => c.run(context),
            Self::Choose(c) => c.run(context),
            Self::Figure(c) => c.run(context),
            Self::Study(c) => c.run(context),
            Self::Simplify(c) => c.run(context),
            Self::Nodes(c) => c.run(context),
            Self::Fmt(c) => c.run(context),
            Self::New(c) => c.run(context),
            Self::Explain(c) => c.run(context),
            Self::Doctor(c) => c.run(context),
            Self::Completions(c) => c.run(),
            Self::Man(c) => c.run(),
        }
    }
}

/// Runs the tool with its arguments (the program's name first) and answers how it ended.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    ExitCode::from(dispatch(arguments.into_iter().collect()) as u8)
}

fn dispatch(arguments: Vec<OsString>) -> Exit {
    output::handle_interrupt();
    let cli = match Cli::try_parse_from(&arguments) {
        Ok(cli) => cli,
        Err(error) => return misused(&error, &arguments),
    };
    let context = Context::new(cli.format, cli.color, cli.quiet, cli.verbose);
    let command = cli.command.unwrap_or_else(|| Command::Edit(edit::Edit::default()));
    if cli.format == Format::Md && !matches!(command, Command::Nodes(_)) {
        let failure = Failure::usage("only `nodes` can write Markdown", "use --format text or json");
        context.report(&failure.diagnostics);
        return failure.exit;
    }
    command.run(&context).unwrap_or_else(|failure| {
        context.report(&failure.diagnostics);
        failure.exit
    })
}

/// Help and version are data; all else is a usage error, as JSON if that was asked for.
fn misused(error: &clap::Error, arguments: &[OsString]) -> Exit {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        let _ = error.print();
        return Exit::Done;
    }
    let asked = |pair: &[OsString]| pair[0] == "--format" && pair[1] == "json";
    if arguments.windows(2).any(asked) || arguments.iter().any(|a| a == "--format=json") {
        let text = error.render().to_string();
        let (message, rest) = text.split_once('\n').unwrap_or((&text, ""));
        let message = message.trim_start_matches("error: ");
        let mut diagnostic = Diagnostic::error("ST0500", message, Place::default());
        let rest: Vec<&str> = rest.lines().map(str::trim).filter(|l| !l.is_empty()).collect();
        if !rest.is_empty() {
            diagnostic = diagnostic.help(rest.join("\n"));
        }
        Context { format: Format::Json, ..Context::default() }.report(&[diagnostic]);
    } else {
        let _ = error.print();
    }
    Exit::Usage
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_table_is_consistent_and_every_help_has_examples() {
        let mut command = Cli::command();
        command.clone().debug_assert();
        command.build();
        for sub in command.get_subcommands_mut().filter(|s| s.get_name() != "help") {
            let help = sub.render_long_help().to_string();
            assert!(help.contains("Examples:\n  shadetree "), "{}: {help}", sub.get_name());
        }
    }

    #[test]
    fn the_built_in_files_are_in_order() {
        use crate::diagnostic::SourceText;
        let starter = include_str!("starter.ron");
        let (graph, found) = crate::graph::read(&SourceText::new("starter.ron", starter));
        assert_eq!(found, []);
        assert_eq!(graph.map(|g| crate::graph::write(&g)).as_deref(), Some(starter));
    }

    #[test]
    fn exit_codes_are_the_documented_ones() {
        let run = |line: &str| dispatch(line.split(' ').map(OsString::from).collect());
        assert_eq!(run("shadetree --no-such-flag"), Exit::Usage);
        assert_eq!(run("shadetree explain ST0999 -q"), Exit::Input);
        assert_eq!(run("shadetree check /no/such/file.ron -q"), Exit::Io);
        assert_eq!(run("shadetree fmt --format md x.ron"), Exit::Usage);
    }
}
