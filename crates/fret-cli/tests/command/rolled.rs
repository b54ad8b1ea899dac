//! A contact that rolls: what it does by distance rolled is told in the table of a run, on its page and in the summary of a sweep. Judged
//! against what the case prescribes, and the energies and distances of `history.csv`.

use crate::bench::{Bench, SPHERE};
use crate::swept::column;

/// The small sphere, rolled by a fifth of a contact under a creepage.
fn rolling() -> String {
    SPHERE
        .replace("tangential_force = [0.05, 0.0]", "roll = [20e-6, 0.0]\ncreepage = [1e-4, 0.0]")
        .replace("cycles = 2\n", "")
}

/// The last of the words after a name that begins a line.
fn last_in_row<'a>(table: &'a str, name: &str) -> &'a str {
    table.lines().find(|line| line.starts_with(name)).unwrap().split_whitespace().last().unwrap()
}

#[test]
fn what_a_contact_does_as_it_rolls_is_told_at_the_end_and_on_the_page() {
    let bench = Bench::new("rolled");
    let answer = bench.file("case.toml", &rolling()).fret(&["run", "case.toml", "--out", "run"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    // Prescribed; the upper body is held across the way and does not turn.
    for (name, told) in [("creepage x", "1.0000e-4"), ("creepage y", "0"), ("spin", "0")] {
        assert_eq!(last_in_row(&answer.out, name), told, "{}", answer.out);
    }
    let history = bench.text("run/history.csv");
    let [energy, roll] = ["dissipated_energy", "roll_x"].map(|name| {
        let numbers = column(&history, name);
        numbers.iter().map(|number| number.parse::<f64>().unwrap()).collect::<Vec<_>>()
    });
    let last = energy.len() - 1;
    let friction = (energy[last] - energy[last - 1]) / (roll[last] - roll[last - 1]);
    let told: f64 = last_in_row(&answer.out, "rolling friction").parse().unwrap();
    // Five digits are printed.
    assert!((told / friction - 1.0).abs() < 1e-4, "{told} against {friction}");
    let indent = answer.out.lines().find(|line| line.starts_with("rolling friction")).unwrap();
    assert_eq!(indent.split_whitespace().nth(2), Some("-"), "the indentation does not roll: {indent}");

    assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
    let page = bench.text("run/report.html");
    for words in [
        "<h2>Rolling</h2>",
        "<th>creepage x</th><th>rolling friction</th>",
        "<td>1.0000 · 10⁻⁴</td>",
        "tangential force over distance rolled",
        "rolling friction over distance rolled",
    ] {
        assert!(page.contains(words), "the page lacks {words:?}");
    }
    assert!(
        !page.contains("<h2>Fretting loop") && !page.contains("<th>creepage y"),
        "what is not there is not told"
    );
    assert!(!page.contains("NaN"), "every number is one");
    crate::shown::assert_stands_alone(&page);
    crate::shown::assert_balanced(&page);
}

#[test]
fn steady_states_make_a_tractive_curve() {
    let bench = Bench::new("rolled-steady");
    let case = rolling()
        .replace(
            "roll = [20e-6, 0.0]\ncreepage = [1e-4, 0.0]",
            "roll = \"steady\"\ntangential_force = [0.05, 0.0]",
        )
        .replace("increments = 8", "increments = 3");
    let answer = bench.file("case.toml", &case).fret(&["run", "case.toml", "--out", "run", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_eq!(bench.fret(&["report", "run"]).code, Some(0));
    let page = bench.text("run/report.html");
    let chart = page.split("aria-label=\"tangential force over creepage\"").nth(1).unwrap();
    let chart = chart.split("</svg>").next().unwrap();
    assert_eq!(chart.matches("<circle class=\"dot").count(), 3, "a point for each steady state");
    assert!(!page.contains("creepage x over distance rolled"), "the way to a steady state tells nothing");
}

#[test]
fn a_sweep_of_rolling_has_its_numbers_and_another_one_has_not() {
    let bench = Bench::new("rolled-swept");
    let sweep = "base = \"case.toml\"\n\n[axes]\n\"friction.coefficient\" = [0.1, 0.2]\n";
    for (name, case) in [("rolling", rolling()), ("rubbing", SPHERE.to_owned())] {
        let file = format!("{name}.toml");
        let answer = bench.file("case.toml", &case).file(&file, sweep).fret(&["sweep", &file, "--quiet"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
    }
    let summary = bench.text("results/rolling/summary.csv");
    let numbers = |name: &str| {
        column(&summary, name).iter().map(|number| number.parse::<f64>().unwrap()).collect::<Vec<_>>()
    };
    // Prescribed, over a difference of distances of eight digits less.
    assert!(numbers("creepage_x").iter().all(|creepage| (creepage / 1e-4 - 1.0).abs() < 1e-8));
    assert!(numbers("rolling_friction").iter().all(|friction| *friction > 0.0));
    let rubbing = bench.text("results/rubbing/summary.csv");
    let head = rubbing.lines().next().unwrap();
    assert!(!["creepage", "spin", "rolling"].iter().any(|word| head.contains(word)), "{head}");
}
