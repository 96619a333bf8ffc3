//! `completions` and `man`: what shells and readers want to know, from the same table as the command line.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::exit::{Failure, Outcome};
use super::{Cli, Exit, output};

/// Print a completion script for a shell
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree completions bash > ~/.local/share/bash-completion/completions/shadetree
  shadetree completions zsh > ~/.zfunc/_shadetree
  shadetree completions fish > ~/.config/fish/completions/shadetree.fish")]
pub(super) struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub(super) fn run(&self) -> Outcome {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "shadetree", &mut script);
        output::print(&script)?;
        Ok(Exit::Done)
    }
}

/// Print the manual page
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  shadetree man | man -l -
  shadetree man > ~/.local/share/man/man1/shadetree.1")]
pub(super) struct Man {}

impl Man {
    pub(super) fn run(&self) -> Outcome {
        let mut command = Cli::command().disable_help_subcommand(true);
        command.build();
        let mut page = Vec::new();
        let failed = |e: std::io::Error| Failure::write(std::path::Path::new("-"), &e);
        clap_mangen::Man::new(command.clone()).render(&mut page).map_err(failed)?;
        for sub in command.get_subcommands() {
            let name = format!("shadetree-{}", sub.get_name());
            let sub = sub.clone().display_name(name);
            clap_mangen::Man::new(sub).render(&mut page).map_err(failed)?;
        }
        output::print(&page)?;
        Ok(Exit::Done)
    }
}
