//! The command line tool; everything is in [`shadetree::cli`].

fn main() -> std::process::ExitCode {
    shadetree::cli::run(std::env::args_os())
}
