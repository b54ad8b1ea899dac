//! Words of the page: nothing from a case reaches it unescaped.

use crate::figures::figure;

use super::scale::superscript;

/// Text between tags or in an attribute.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            _ => safe.push(letter),
        }
    }
    safe
}

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
    let is_plain = (1e-3..1e5).contains(&value.abs()) || value == 0.0;
    printed(&if is_plain { format!("{value}") } else { format!("{value:e}") })
}

/// Digits with a power of ten in place of an `e`, and a true minus.
fn printed(shown: &str) -> String {
    match shown.split_once('e') {
        Some((digits, exponent)) => {
            let power = exponent.parse().map_or_else(|_| exponent.to_owned(), superscript);
            format!("{digits} · 10{power}").replace('-', "−")
        }
        None => shown.replace('-', "−"),
    }
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.1} %", 100.0 * share) } else { "–".to_owned() }
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

/// A table of names and values; values are HTML already.
pub fn pairs(rows: &[(String, String)]) -> String {
    let rows: Vec<String> = rows
        .iter()
        .map(|(name, value)| format!("<tr><th scope=\"row\">{}</th><td>{value}</td></tr>", escaped(name)))
        .collect();
    format!("<table class=\"pairs\">{}</table>\n", rows.concat())
}

/// A table with a head; cells are HTML already.
pub fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let cells = |tag: &str, row: &mut dyn Iterator<Item = String>| -> String {
        row.map(|cell| format!("<{tag}>{cell}</{tag}>")).collect()
    };
    let body: String =
        rows.iter().map(|row| format!("<tr>{}</tr>", cells("td", &mut row.iter().cloned()))).collect();
    format!(
        "<table class=\"grid\"><thead><tr>{}</tr></thead><tbody>{body}</tbody></table>\n",
        cells("th", &mut head.iter().map(|name| escaped(name)))
    )
}

/// A figure with its caption, which is HTML already.
pub fn figure_of(drawing: &str, caption: &str) -> String {
    format!("<figure>{drawing}<figcaption>{caption}</figcaption></figure>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_case_cannot_become_tags() {
        assert_eq!(
            escaped("<script>\"a\" & 'b'</script>"),
            "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;"
        );
    }

    #[test]
    fn numbers_are_printed_as_in_a_book() {
        assert_eq!(number(-2.5e-7), "−2.5000 · 10⁻⁷");
        assert_eq!(number(12.0), "12.000");
        assert_eq!(given(210e9), "2.1 · 10¹¹");
        assert_eq!(given(0.3), "0.3");
        assert_eq!(deviation(1.0012, 1.0), "+0.12 %");
        assert_eq!(deviation(1.0, 0.0), "–");
    }
}
