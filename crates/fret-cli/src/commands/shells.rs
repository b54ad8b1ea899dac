//! `fret completions` and `fret man`: what shells and `man` want of the command line, from the same words as its help.

use std::fs;
use std::path::Path;

use clap::CommandFactory;
use clap_complete::Shell;
use serde_json::json;

use crate::arguments::Arguments;
use crate::failure::{Failure, Unwritten};
use crate::terminal::{Answer, to_standard_output};

/// Writes the completions for a shell to standard output.
pub fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "fret", &mut script);
    to_standard_output(&script)
}

/// Writes the page of `man` of the command to standard output.
pub fn page_of_all() -> Result<(), Failure> {
    to_standard_output(&page(Arguments::command(), "fret", Path::new("standard output"))?)
}

/// Writes the pages of `man` of the command and of all its verbs into a folder.
pub fn pages(folder: &Path) -> Result<Answer, Failure> {
    let command = Arguments::command();
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
    let text = format!("{} pages in {}", written.len(), folder.display());
    Ok(Answer::new(json!({ "status": "written", "files": written }), text))
}

fn page(command: clap::Command, title: &str, path: &Path) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    clap_mangen::Man::new(command).title(title).render(&mut page).map_err(Unwritten::at(path))?;
    Ok(page)
}
