//! The page of a run has the numbers of its loops, and error bars where they were asked for. Judged against the case, `cycles.csv`, and
//! Hertz.

use serde_json::Value;

use crate::bench::{Bench, SPHERE};
use crate::studied::HERTZ;
use crate::swept::column;

/// The cells of a row of a table of the page, without its name.
fn cells(page: &str, name: &str) -> Vec<String> {
    let row = page.split(&format!("<tr><td>{name}</td>")).nth(1).unwrap_or_else(|| panic!("no row {name:?}"));
    let row = row.split("</tr>").next().unwrap();
    row.split("<td>").skip(1).map(|cell| cell.trim_end_matches("</td>").to_owned()).collect()
}

/// A printed number read back: digits, and a power of ten in raised figures.
fn read(printed: &str) -> f64 {
    let plain: String = printed
        .chars()
        .map(|letter| {
            "⁰¹²³⁴⁵⁶⁷⁸⁹"
                .chars()
                .position(|raised| raised == letter)
                .map_or(letter, |digit| (b'0' + digit as u8) as char)
        })
        .collect();
    plain.replace(" · 10", "e").replace(['⁻', '−'], "-").parse().unwrap_or_else(|_| panic!("{printed:?}"))
}

#[test]
fn the_page_has_the_numbers_of_the_last_cycle() {
    let bench = Bench::new("loops");
    let answer = bench.file("case.toml", SPHERE).fret(&["run", "case.toml", "--out", "run", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
    let (page, cycles) = (bench.text("run/report.html"), bench.text("run/cycles.csv"));
    assert!(page.contains("<th>fretting, cycle 2</th>"));
    let told = |name: &str| read(&cells(&page, name)[0]);
    let last = |name: &str| column(&cycles, name).last().unwrap().parse::<f64>().unwrap();
    // Prescribed, and held to the tolerance of the solver.
    assert!((told("force amplitude Q*") / 0.05 - 1.0).abs() < 1e-4);
    // By its definition, of numbers of five digits.
    let amplitudes = 4.0 * told("force amplitude Q*") * told("displacement amplitude δ*");
    assert!((told("energy ratio A") * amplitudes / last("dissipated_energy") - 1.0).abs() < 3e-4);
    for (name, entry) in [("stiffness after reversal", "stiffness"), ("sliding ratio D", "sliding_ratio")] {
        assert!((told(name) / last(entry) - 1.0).abs() < 1e-4, "{name}");
    }
    for name in ["sliding condition", "running condition of all cycles"] {
        assert_eq!(cells(&page, name), ["partial slip"], "half of what friction carries");
    }
}

#[test]
fn error_bars_stand_on_the_page_while_they_are_of_the_run() {
    let bench = Bench::new("error-bars-page");
    let run = ["run", "case.toml", "--out", "run", "--quiet"];
    let with = [&run[..], &["--estimate-error"]].concat();
    let answer = bench.file("case.toml", HERTZ).fret(&with);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
    let page = bench.text("run/report.html");
    assert!(page.contains("<h2>Error bars</h2>") && page.contains("on 16 × 16 cells with 1 increment"));
    let chapter = page.split("<h2>Error bars</h2>").nth(1).unwrap();
    let approach = cells(chapter, "approach");
    let (value, bar) = approach[0].split_once(" ± ").unwrap();
    // Hertz: a^2 / R with a = 1.
    assert!((read(value) - 0.01).abs() <= read(bar) && read(bar) < 1e-4, "{approach:?}");
    let file: Value = serde_json::from_str(&bench.text("run/error_bars.json")).unwrap();
    let written = file["stages"][0]["approach"]["value"].as_f64().unwrap();
    assert!((read(value) / written - 1.0).abs() < 1e-4);
    // There is no friction, and so nothing to say of stick.
    assert!(!chapter.split("</section>").next().unwrap().contains("stick"));

    bench.file("run/error_bars.json", "{ \"stages\": 3 }");
    let refused = bench.fret(&["report", "run"]);
    assert_eq!(refused.code, Some(1));
    assert!(
        refused.err.contains("error_bars.json") && refused.err.contains("--estimate-error"),
        "{}",
        refused.err
    );
    assert_eq!(bench.fret(&run).code, Some(0));
    assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
    assert!(!bench.text("run/report.html").contains("Error bars"));
}
