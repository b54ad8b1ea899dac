//! How a document is refused: every mistake with its place, what was found, what is allowed.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

use super::mistake::Mistake;
use super::words::printable;

/// Bytes of a place that is marked over several lines, at the most.
const LONGEST_MARK: usize = 1000;

/// A refused document, with all its mistakes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    name: String,
    text: String,
    mistakes: Vec<Mistake>,
    /// Whether the case is a good one that there is not the memory for.
    lacks_memory: bool,
}

impl Refusal {
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

    /// Name of the document (a file name).
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

    /// The refusal as a person reads it, with its lines; in colour for a terminal.
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
        let snippet = Snippet::source(&self.text)
            .path(&self.name)
            .annotation(AnnotationKind::Primary.span(shown(&self.text, span)));
        let group = Level::ERROR.primary_title(printable(&mistake.message)).element(snippet);
        let group = match &mistake.help {
            Some(help) => group.element(Level::HELP.message(printable(help))),
            None => group,
        };
        renderer.render(&[group])
    }
}

/// What of a place is marked: of a long one over several lines, the part in its first line.
fn shown(text: &str, span: Range<usize>) -> Range<usize> {
    let marked = text.get(span.clone()).unwrap_or_default();
    match marked.find('\n') {
        Some(end) if marked.len() > LONGEST_MARK => span.start..span.start + end.max(1),
        _ => span,
    }
}

impl std::fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(&self.render(false))
    }
}

impl std::error::Error for Refusal {}

#[cfg(test)]
mod tests {
    use super::{Mistake, Refusal};

    #[test]
    fn a_long_place_over_several_lines_is_marked_in_its_first() {
        let text = format!("a = [\n{}]\n", "_".repeat(5000));
        let mistake = Mistake { message: "wrong".to_owned(), help: None, span: Some(4..text.len() - 1) };
        let told = Refusal::new("case.toml", &text, vec![mistake]).render(false);
        assert!(told.contains("a = [") && told.len() < 200, "{told}");
    }

    #[test]
    fn a_refusal_knows_its_case_and_the_places_of_its_mistakes() {
        let text = "a = 1\nµm = 2\n\nlast";
        let mistake = |at: usize| Mistake { message: "wrong".to_owned(), help: None, span: Some(at..at + 1) };
        let starts = [0, 4, 5, 6, 8, text.find("= 2").unwrap(), text.find("last").unwrap()];
        let error = Refusal::new("case.toml", text, starts.into_iter().rev().map(mistake).collect());
        assert_eq!(error.name(), "case.toml");
        // by lines and letters, the end of a line among its letters; in the order of the text
        let places: Vec<_> = error.mistakes().iter().map(|mistake| error.place(mistake).unwrap()).collect();
        assert_eq!(places, [(1, 1), (1, 5), (1, 6), (2, 1), (2, 2), (2, 4), (4, 1)]);
        assert_eq!(error.place(&Mistake { span: None, ..mistake(0) }), None);
        assert!(!error.lacks_memory() && error.clone().for_memory().lacks_memory());
        assert_eq!(error.clone().for_memory().mistakes(), error.mistakes());
        // with its line where it has a place in the text
        let [first, last] = [0, 6].map(|index| {
            let one = vec![error.mistakes()[index].clone()];
            Refusal::new("case.toml", text, one).render(false)
        });
        assert!(first.contains("case.toml:1:1") && first.contains("a = 1"), "{first}");
        assert!(last.contains("case.toml:4:1") && last.contains("last"), "{last}");
        let beyond = Refusal::new("case.toml", text, vec![mistake(text.len())]).render(false);
        assert_eq!(beyond, "error: case.toml: wrong");
        assert_eq!(Refusal::plain("b", "no").render(false), "error: b: no");
    }
}
