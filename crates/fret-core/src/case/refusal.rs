//! How a case is refused: every mistake with its place, what was found, what is allowed.

use super::wording::printable;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// One mistake in a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// What was found, and what is allowed.
    pub message: String,
    /// What to do about it, when that can be said.
    pub help: Option<String>,
    /// Bytes of the case text the mistake stands at, when it stands anywhere.
    pub span: Option<Range<usize>>,
}

/// A place in which a case differs from the setting of a state.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// Dotted key of the case.
    pub key: String,
    /// What the case has.
    pub case: String,
    /// What the state has.
    pub state: String,
}

/// A refused case, with all its mistakes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CaseError {
    name: String,
    text: String,
    mistakes: Vec<Mistake>,
    /// Whether the case is a good one that there is not the memory for.
    lacks_memory: bool,
}

impl CaseError {
    /// A refusal of a text, with its mistakes.
    pub fn new(name: &str, text: &str, mut mistakes: Vec<Mistake>) -> Self {
        mistakes.sort_by_key(|mistake| mistake.span.as_ref().map_or(usize::MAX, |span| span.start));
        Self { name: name.to_owned(), text: text.to_owned(), mistakes, lacks_memory: false }
    }

    /// A refusal without a place in a text.
    pub fn plain(name: &str, message: impl Into<String>) -> Self {
        Self::new(name, "", vec![Mistake { message: message.into(), help: None, span: None }])
    }

    /// The same for want of memory alone.
    #[must_use]
    pub(crate) fn for_memory(self) -> Self {
        Self { lacks_memory: true, ..self }
    }

    /// Whether the case is a good one that there is not the memory for, now and here.
    pub fn lacks_memory(&self) -> bool {
        self.lacks_memory
    }

    /// All mistakes, in the order of the text.
    pub fn mistakes(&self) -> &[Mistake] {
        &self.mistakes
    }

    /// Name of the case (a file name).
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Line and column of a mistake, both from 1, when it stands anywhere.
    pub fn place(&self, mistake: &Mistake) -> Option<(usize, usize)> {
        let start = mistake.span.as_ref()?.start.min(self.text.len());
        let before = self.text.get(..start)?;
        let line_start = before.rfind('\n').map_or(0, |position| position + 1);
        Some((before.matches('\n').count() + 1, before[line_start..].chars().count() + 1))
    }

    /// The refusal as a person reads it, with the lines of the case; in colour for a terminal.
    pub fn render(&self, colour: bool) -> String {
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        let blocks: Vec<String> =
            self.mistakes.iter().map(|mistake| self.block(mistake, &renderer)).collect();
        blocks.join("\n\n")
    }

    fn block(&self, mistake: &Mistake, renderer: &Renderer) -> String {
        let Some(span) = mistake.span.clone().filter(|span| span.end <= self.text.len()) else {
            let help = mistake.help.as_ref().map_or(String::new(), |help| format!("\n  = help: {help}"));
            return printable(&format!("error: {}: {}{help}", self.name, mistake.message)).into_owned();
        };
        let snippet =
            Snippet::source(&self.text).path(&self.name).annotation(AnnotationKind::Primary.span(span));
        let group = Level::ERROR.primary_title(printable(&mistake.message)).element(snippet);
        let group = match &mistake.help {
            Some(help) => group.element(Level::HELP.message(printable(help))),
            None => group,
        };
        renderer.render(&[group])
    }
}

impl std::fmt::Display for CaseError {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.render(false))
    }
}

impl std::error::Error for CaseError {}
