//! Cycles that are no whole loops are skipped and named; only that which is to be fitted is refused.

use super::exports::rows;
use super::{Request, case, constant, identified, identify, refusal};

/// Fifteen cycles of a hundred points, by number; `change` makes of a row what is written.
fn numbered(change: impl Fn(usize, usize, String) -> Option<String>) -> String {
    let rows = rows();
    let mut text = "cycle;displacement [um];force [N]\n".to_owned();
    for cycle in 1..=15 {
        for (row, [d, q]) in rows[100..200].iter().enumerate() {
            if let Some(line) = change(cycle, row, format!("{cycle};{d};{q}")) {
                text += &(line + "\n");
            }
        }
    }
    text
}

#[track_caller]
fn is_fitted(log: &str, cycle: f64, skipped: &str) {
    let found = identified(log, &Request::default());
    assert_eq!(found.fitted_cycle().measured.name, cycle);
    assert!((constant(&found, 0)[0] / 0.45 - 1.0).abs() < 3e-3, "{:?}", found.constants);
    assert_eq!(found.skipped_in_words().unwrap_or_default(), skipped);
    let strict = Request { strict: true, ..Request::default() };
    assert_eq!(skipped.is_empty(), identify(log, case(), &strict).is_ok());
}

#[test]
fn a_whole_log_leaves_nothing_out() {
    is_fitted(&numbered(|_, _, line| Some(line)), 15.0, "");
}

#[test]
fn a_log_that_ends_or_begins_inside_a_cycle_is_identified() {
    is_fitted(
        &numbered(|cycle, row, line| (cycle < 15 || row < 40).then_some(line)),
        14.0,
        "15 (ends early)",
    );
    is_fitted(&numbered(|cycle, row, line| (cycle > 1 || row > 50).then_some(line)), 15.0, "1 (starts late)");
    is_fitted(&numbered(|cycle, row, line| (cycle < 15 || row < 5).then_some(line)), 14.0, "15 (5 points)");
}

/// A lone row of another cycle at the start or at the end, as a rig that is stopped after it has counted on writes it.
#[test]
fn a_lone_row_of_another_cycle_is_skipped() {
    let log = numbered(|_, _, line| Some(line));
    is_fitted(&(log.clone() + "99;10.1;60.1\n"), 15.0, "99 (1 point)");
    is_fitted(&log.replacen("force [N]\n", "force [N]\n0;1.0;2.0\n", 1), 15.0, "0 (1 point)");
}

#[test]
fn missing_lines_leave_one_cycle_out() {
    let log = numbered(|cycle, row, line| (cycle != 7 || !(20..60).contains(&row)).then_some(line));
    is_fitted(&log, 15.0, "7 (points are missing between lines 621 and 622)");
    let asked = refusal(&log, &Request { cycle: Some(7.0), ..Request::default() });
    assert!(asked.contains("points are missing there"), "{asked}");
    assert!(asked.contains("--cycle 6") || asked.contains("--cycle 8"), "{asked}");
    let found = identified(&log, &Request::default());
    assert_eq!(found.skipped().count(), 1);
    assert_eq!((found.cycles[6].measured.force.len(), found.cycles[6].quantities), (60, None));
}

/// Every row its own cycle, and rows in no order: refused in words.
#[test]
fn a_log_without_a_whole_cycle_is_refused_in_words() {
    let counted = rows()
        .iter()
        .enumerate()
        .fold("cycle;displacement [um];force [N]\n".to_owned(), |text, (k, [d, q])| {
            text + &format!("{k};{d};{q}\n")
        });
    let told = refusal(&counted, &Request::default());
    assert!(told.contains("none of its 301 cycles is whole: 0 (1 point), 1 (1 point)"), "{told}");
    assert!(told.contains("and 291 more"), "{told}");
}

/// Without a column of cycles: less than two whole ones, with parts around; a spike in one of many.
#[test]
fn parts_of_cycles_around_a_whole_one_are_no_harm() {
    let rows = rows();
    let of = |from: usize, to: usize| {
        rows[from..to]
            .iter()
            .fold("displacement [um],force [N]\n".to_owned(), |text, [d, q]| text + &format!("{d},{q}\n"))
    };
    // From nothing to more than one cycle: the turns at the top are at 25, 125, ..., those at the bottom at 75, 175.
    for (from, to) in [(0, 190), (40, 200), (60, 230), (0, 301)] {
        let found = identified(&of(from, to), &Request::default());
        assert!((constant(&found, 0)[0] / 0.45 - 1.0).abs() < 5e-3, "{from} {to}: {:?}", found.constants);
    }
    let mut spiked = of(0, 301).lines().map(str::to_owned).collect::<Vec<_>>();
    spiked[60] = "8000,1".to_owned();
    let found = identified(&spiked.join("\n"), &Request::default());
    assert!((constant(&found, 0)[0] / 0.45 - 1.0).abs() < 5e-3);
    assert!(found.skipped_in_words().unwrap().contains("points are missing"));
}
