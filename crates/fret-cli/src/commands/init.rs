//! `fret init`: a case to begin with.

use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::json;

use crate::arguments::InitArguments;
use crate::failure::{Failure, Unwritten};
use crate::templates::{TEMPLATES, Template};
use crate::terminal::Answer;

/// Writes a template, or tells which there are.
pub fn init(InitArguments { template, manner }: &InitArguments) -> Result<Answer, Failure> {
    let (Some(name), out) = (template, manner.out.as_deref()) else { return Ok(list()) };
    if out == Some(Path::new("-")) {
        let help = "name a file; a template may have other files beside it";
        return Err(Failure::call("a case to begin with is written to a file", help));
    }
    let template = TEMPLATES.iter().find(|template| template.name == *name).ok_or_else(|| {
        let names: Vec<&str> = TEMPLATES.iter().map(|template| template.name).collect();
        Failure::call(format!("no template is called {name:?}"), format!("there are: {}", names.join(", ")))
    })?;
    let path = out.map_or_else(|| PathBuf::from(format!("{name}.toml")), Path::to_owned);
    let written = write(template, &path)?;
    for path in &written {
        manner.wrote(Path::new(path));
    }
    let record = json!({ "status": "written", "template": name, "files": written });
    let path = in_a_call(&path);
    let next = format!("next: fret check {path}; fret plan {path}; fret run {path}");
    Ok(Answer::new(record, format!("written: {}\n{next}", written.join(", "))))
}

/// A path as a call of the command has it.
fn in_a_call(path: &Path) -> String {
    let shown = path.display().to_string();
    if shown.contains(char::is_whitespace) { format!("\"{shown}\"") } else { shown }
}

fn list() -> Answer {
    let all = TEMPLATES.iter().map(|template| json!({ "name": template.name, "about": template.about }));
    let lines = TEMPLATES.iter().map(|template| format!("\n  {:<14}{}", template.name, template.about));
    let text = "cases to begin with, `fret init NAME` writes one:".to_owned() + &lines.collect::<String>();
    Answer::new(json!({ "templates": all.collect::<Vec<_>>() }), text)
}

/// Writes the case and what it names beside it; nothing that exists is replaced.
fn write(template: &Template, path: &Path) -> Result<Vec<String>, Failure> {
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    let beside = template.beside.iter().map(|&(name, content)| (folder.join(name), content));
    // The commands in its first lines name the file.
    let case = template.case.replace(" FILE", &format!(" {}", in_a_call(path)));
    let files: Vec<(PathBuf, &str)> = [(path.to_owned(), case.as_str())].into_iter().chain(beside).collect();
    if let Some((there, _)) = files.iter().find(|(path, _)| path.exists()) {
        let help = if there == path {
            "choose another name with --out FILE, or move it away"
        } else {
            "the case names it: choose another folder with --out DIR/FILE, or move it away"
        };
        return Err(Failure::call(format!("{}: exists already", there.display()), help));
    }
    if !folder.as_os_str().is_empty() {
        fs::create_dir_all(folder).map_err(Unwritten::at(folder))?;
    }
    for (path, content) in &files {
        OpenOptions::new()
            .write(true)
            .create_new(true)
            .open(path)
            .and_then(|mut file| file.write_all(content.as_bytes()))
            .map_err(Unwritten::at(path))?;
    }
    Ok(files.iter().map(|(path, _)| path.display().to_string()).collect())
}
