//! `fret identify`: constants of a model from measured fretting loops, or from an indentation.

use std::path::{Path, PathBuf};

use fret_core::identify::{IndentationRequest, Part, Request as LoopsAsked};
use fret_core::measured::Asked;

use crate::arguments::{IdentifyArguments, columns_asked};
use crate::failure::Failure;
use crate::figures::counted;
use crate::identify::{self, Identified, IndentationAsked, Question, Request};
use crate::log_file::{content, name_of};
use crate::terminal::Answer;
use fret_results::{CaseFile, folder_for_answers, stem};

/// The answer, which marks its folder.
const IDENTIFIED: &str = "identified.json";
/// How columns and units are chosen.
const EXAMPLE: &str = "displacement=...,force=...";
const EXAMPLE_OF_DEPTH: &str = "depth=...,force=...";

/// Identifies a log by a case; writes what was found beside it.
pub fn identify(arguments: &IdentifyArguments) -> Result<Answer, Failure> {
    let name = name_of(&arguments.log);
    let bytes = content(&arguments.log)?;
    let asked = |example: &str| columns_asked(&arguments.columns, &arguments.units, [example, example]);
    let question = if arguments.indentation {
        Question::Indentation(indentation_asked(arguments, asked(EXAMPLE_OF_DEPTH)?)?)
    } else {
        let (asked, strict) = (asked(EXAMPLE)?, arguments.strict);
        let every = arguments.every.map(|every| every as usize);
        let log = LoopsAsked { asked, cycle: arguments.cycle, every, strict };
        Question::Loops(Request { log, key: one_key(&arguments.fit)? })
    };
    let case_file = CaseFile::read(&arguments.case)?;
    let pool = arguments.threads.pool()?;
    let folder = arguments.manner.out.clone().unwrap_or_else(|| default_folder(&arguments.log));
    let folder = folder_for_answers(&folder, &[IDENTIFIED], "an identification")?;
    arguments.manner.step(|| format!("read: {name}, {}", counted(bytes.len(), "byte")));
    let log = (name.as_str(), &bytes[..]);
    let Identified { record, text, page, tables } =
        pool.install(|| identify::identify(log, &case_file, &question))?;
    let manner = &arguments.manner;
    manner.write_json(&folder.join(IDENTIFIED), &record)?;
    manner.write(&folder.join("identified.html"), page.as_bytes())?;
    for (name, table) in &tables {
        manner.write(&folder.join(name), table.as_bytes())?;
    }
    let text = format!("{text}\nwritten to {}", folder.display());
    Ok(Answer::new(record, text))
}

fn one_key(keys: &[String]) -> Result<Option<String>, Failure> {
    match keys {
        [] => Ok(None),
        [key] => Ok(Some(key.clone())),
        keys => Err(Failure::call(
            format!(
                "--fit, {} times: a fretting loop tells one number of the case besides friction and rig",
                keys.len()
            ),
            "--fit KEY once; several are fitted to an indentation (--indentation)",
        )),
    }
}

fn indentation_asked(arguments: &IdentifyArguments, asked: Asked) -> Result<IndentationAsked, Failure> {
    let part = arguments.part.as_deref().and_then(Part::named).unwrap_or_default();
    if arguments.fit.is_empty() && !arguments.frame {
        return Err(Failure::call(
            "--indentation: nothing is fitted but the depth at first touch",
            "--fit lower.coatings[0].young, or another number of the case; or --frame",
        ));
    }
    let (touch, frame, strict) = (arguments.touch, arguments.frame, arguments.strict);
    let request = IndentationRequest { asked, part, touch, frame, strict };
    Ok(IndentationAsked { request, keys: arguments.fit.clone() })
}

/// The folder for the answer, when none is named.
fn default_folder(log: &Path) -> PathBuf {
    Path::new("results").join(format!("{}-identified", stem(log, "log").display()))
}
