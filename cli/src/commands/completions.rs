//! `affinor completions`: command-line completions for a shell.

use super::failure::Failure;
use super::output::deliver;
use clap::{Args, Command};
use clap_complete::{Shell, generate};

#[derive(Args)]
pub struct Arguments {
    /// The shell
    pub shell: Shell,
}

impl Arguments {
    pub fn run(&self, command: &mut Command) -> Result<(), Failure> {
        let mut script = Vec::new();
        generate(self.shell, command, "affinor", &mut script);
        deliver(None, &[], |out| out.write_all(&script))
    }
}
