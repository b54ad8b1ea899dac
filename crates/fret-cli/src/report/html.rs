//! Numbers as they are printed, and the parts that all chapters are made of. Words of a case are escaped by the templates.

use std::borrow::Borrow;

use maud::{Markup, Render, html};

use crate::figures::{figure, typed};
use crate::table::Columns;

use fret_drawing::Axis;

/// A number as it is printed.
pub fn number(value: f64) -> String {
    printed(&figure(value))
}

/// A number whose size alone matters.
pub fn short(value: f64) -> String {
    printed(&format!("{value:.1e}"))
}

/// A number as it was typed: as few digits as say it.
pub fn given(value: f64) -> String {
    printed(&typed(value))
}

/// Digits with a power of ten in place of an `e`, and a true minus.
fn printed(shown: &str) -> String {
    let power =
        |exponent: &str| exponent.parse().map_or_else(|_| format!("10{exponent}"), Axis::power_of_ten);
    let shown = match shown.split_once('e') {
        Some((digits, exponent)) => format!("{digits} · {}", power(exponent)),
        None => shown.to_owned(),
    };
    shown.replace('-', "−")
}

/// A deviation in percent, with its sign and enough digits to be seen.
pub fn deviation(computed: f64, exact: f64) -> String {
    let share = 100.0 * (computed / exact - 1.0);
    if !share.is_finite() {
        return "–".to_owned();
    }
    let decimals = if share.abs() < 0.095 { 3 } else { 2 };
    format!("{share:+.decimals$} %").replace('-', "−")
}

/// A chapter with its heading.
pub fn chapter(heading: &str, body: &Markup) -> Markup {
    html! { section { h2 { (heading) } (body) } }
}

/// A table of names and values.
pub fn pairs(rows: impl IntoIterator<Item = (impl Render, impl Render)>) -> Markup {
    html! {
        div class="scroll" { table class="pairs" { @for (name, value) in rows { tr { th scope="row" { (name) } td { (value) } } } } }
    }
}

/// A table with a head.
pub fn table(head: &[impl AsRef<str>], rows: &[Vec<String>]) -> Markup {
    html! {
        div class="scroll" {
            table class="grid" {
                thead { tr { @for name in head { th { (name.as_ref()) } } } }
                tbody { @for row in rows { tr { @for cell in row { td { (cell) } } } } }
            }
        }
    }
}

/// A table of columns; `number` prints one beside the kind of its unit.
pub fn grid<R, B: Borrow<R>>(
    columns: &Columns<'_, R>,
    rows: impl IntoIterator<Item = B>,
    number: impl Fn(f64, &str) -> String,
) -> Markup {
    let printed = |cell: String| if cell == "-" { "–".to_owned() } else { cell };
    let row = |row: B| {
        let cells = columns.cells(row.borrow(), |_, value, kind| number(value, kind));
        cells.into_iter().map(printed).collect()
    };
    table(&columns.names(), &rows.into_iter().map(row).collect::<Vec<_>>())
}

/// Figures side by side where there is room.
pub fn side_by_side(figures: &[Markup]) -> Markup {
    html! { div class="figures" { @for figure in figures { (figure) } } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_case_cannot_become_tags() {
        let table = table(&["<b>"], &[vec!["<script>\"a\" & 'b'</script>".to_owned()]]).into_string();
        assert!(
            table.contains("&lt;b&gt;") && table.contains("&lt;script&gt;") && !table.contains("<script"),
            "{table}"
        );
        let page = html! { p title=("\"><script>") {} }.into_string();
        assert_eq!(page, "<p title=\"&quot;&gt;&lt;script&gt;\"></p>");
    }

    #[test]
    fn numbers_are_printed_as_in_a_book() {
        assert_eq!(number(-2.5e-7), "−2.5000 · 10⁻⁷");
        assert_eq!(number(12.0), "12.000");
        assert_eq!(given(210e9), "2.1 · 10¹¹");
        assert_eq!(given(0.3), "0.3");
        assert_eq!(given(3.208_999_999_999_999_7e-7), "3.209 · 10⁻⁷");
        assert_eq!(deviation(1.0012, 1.0), "+0.12 %");
        assert_eq!(deviation(1.0, 0.0), "–");
    }
}
