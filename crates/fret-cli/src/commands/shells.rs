//! `fret completions` and `fret man`: what shells and `man` want of the command line, from the same words as its help.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use clap::CommandFactory;
use clap_complete::Shell;
use serde_json::json;

use crate::arguments::Arguments;
use crate::failure::{Failure, Unwritten};
use crate::terminal;

/// Writes the completions for a shell to standard output.
pub fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "fret", &mut script);
    to_standard_output(&script)
}

/// Writes the page of `man` of the command to standard output, or into a folder those of all its verbs.
pub fn manual(out: Option<&Path>, as_json: bool) -> Result<(), Failure> {
    let command = Arguments::command();
    let Some(folder) = out else {
        return to_standard_output(&page(command, "fret", Path::new("standard output"))?);
    };
    fs::create_dir_all(folder).map_err(Unwritten::at(folder))?;
    let mut written = Vec::new();
    let verbs = command.get_subcommands().filter(|verb| !verb.is_hide_set());
    let verbs = verbs.map(|verb| (format!("fret-{}", verb.get_name()), verb.clone()));
    let all: Vec<(String, clap::Command)> =
        [("fret".to_owned(), command.clone())].into_iter().chain(verbs).collect();
    for (name, command) in all {
        let path = folder.join(format!("{name}.1"));
        fs::write(&path, page(command, &name, &path)?).map_err(Unwritten::at(&path))?;
        written.push(path.display().to_string());
    }
    if as_json {
        return terminal::answer_in_json(&json!({ "status": "written", "files": written }));
    }
    terminal::answer(&format!("{} pages in {}", written.len(), folder.display()))
}

fn page(command: clap::Command, title: &str, path: &Path) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    clap_mangen::Man::new(command).title(title).render(&mut page).map_err(Unwritten::at(path))?;
    Ok(page)
}

/// Bytes as they are: neither is for the eye, and what a shell reads must not be changed.
fn to_standard_output(bytes: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Unwritten::at(Path::new("standard output"))(error).into())
        }
        _ => Ok(()),
    }
}
