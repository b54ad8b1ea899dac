//! `fret study`: one case at many resolutions, how far each is from the reference and what it costs.

use std::path::Path;

use serde_json::json;

use crate::arguments::StudyArguments;
use crate::failure::Failure;
use crate::interrupt;
use crate::manner::Listener;
use crate::report::study::STUDY;
use crate::study::levels::{LEVELS, Levels};
use crate::study::question::Question;
use crate::study::studied::{Studied, studied};
use crate::study::{picture, table};
use crate::terminal::Answer;
use fret_results::{CaseFile, folder_for_answers};

/// Studies a case.
pub fn study(arguments: &StudyArguments) -> Result<Answer, Failure> {
    let case_file = CaseFile::asked(&arguments.case)?;
    let plan = case_file.planned()?;
    let question = Question::new(&arguments.request, &plan)?;
    let pool = arguments.threads.pool()?;
    let folder = arguments.manner.out.clone().unwrap_or_else(|| {
        let mut name = case_file.stem().into_os_string();
        name.push("-study");
        Path::new("results").join(name)
    });
    let folder = folder_for_answers(&folder, &[STUDY, LEVELS], "a study")?;
    interrupt::listen();
    let kept = Levels::below(&folder)?;
    let manner = &arguments.manner;
    let say = |text: &str| manner.say(text);
    let title = case_file.title(&plan.case);
    let studied = pool
        .install(|| studied((&title, &plan), question, Some(&kept), &say, &mut Listener::telling(manner)))?;
    let Studied { record, study, lines, measured } = &studied;
    manner.write(&folder.join("study.csv"), table::csv(&record.lines).as_bytes())?;
    manner.write(
        &folder.join("study.svg"),
        picture::picture(&title, plan.case.dimension(), study, lines).as_bytes(),
    )?;
    let answer = json!(record);
    manner.write_json(&folder.join(STUDY), &answer)?;
    kept.remove();
    let text = format!(
        "{title}\n{measured}\n\n{}\n\n{}\n\nresults    {}",
        table::table(record),
        record.choice,
        folder.display()
    );
    Ok(Answer::new(answer, text))
}
