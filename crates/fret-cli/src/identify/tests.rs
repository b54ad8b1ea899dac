//! What is written of an identification: the text, the table, the record, the page.

use std::fmt::Write;
use std::path::PathBuf;

use fret_core::identify::IndentationRequest;

use super::indentation::{IndentationAsked, indentation};
use super::loops::loops as identify;
use super::{Identified, Request};
use crate::failure::Failure;
use crate::figures::figure;
use fret_results::{Beside, CaseFile};

/// Two equal spheres of E = 210 GPa, nu = 0, pressed with 100 N: units mm and N.
const CASE: &str = "[units]\nlength = \"mm\"\nforce = \"N\"\n[grid]\ncells = [24, 24]\nsize = \"auto\"\n[upper]\nsubstrate = { young = 210e3, poisson = 0.0 }\n\
    [lower]\nsubstrate = { young = 210e3, poisson = 0.0 }\n[profile.sphere]\nradius = 10.0\n[friction]\ncoefficient = 0.5\n[[load]]\nnormal_force = 100.0\nincrements = 1\n\
    [[load]]\ntangential_force = [1.0, 0.0]\nincrements = 4\n";
/// Three cycles of a hundred points, by a formula (friction coefficient 0.45, rig 30 kN/mm), from the middle of the displacement on.
const LOOP: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/logs/loop.csv"));

fn answer(log: &str, request: &Request) -> Identified {
    let beside = Beside { folder: PathBuf::new(), contents: Vec::new() };
    let case = CaseFile::of_text("case.toml", CASE.to_owned(), beside);
    identify(("log.csv", log.as_bytes()), &case, request).unwrap_or_else(|failure| panic!("{failure:?}"))
}

/// Columns in the order of the page, heads with units, counted cycles; a cycle with missing points is named, and its row is empty.
#[test]
fn a_cycle_that_was_skipped_is_named_and_empty() {
    let rows: Vec<&str> = LOOP.lines().skip(1).collect();
    let mut log = "cycle,displacement [um],force [N]\n".to_owned();
    for cycle in 1..=4 {
        for (row, line) in rows[100..200].iter().enumerate() {
            if cycle != 3 || !(20..60).contains(&row) {
                log += &format!("{cycle},{line}\n");
            }
        }
    }
    let log_asked = fret_core::identify::Request { every: Some(3), ..Default::default() };
    let mut answer = answer(&log, &Request { log: log_asked, key: None });
    let fits = answer.tables.pop().unwrap();
    let (text, table, json) = (answer.text, answer.tables.remove(0).1, answer.record);
    // The fit is repeated on the first and the fourth.
    assert_eq!(fits.0, "fits.csv");
    let fits: Vec<&str> = fits.1.lines().collect();
    assert!(fits[0].starts_with("cycle,noise,friction_coefficient,friction_coefficient_low,friction_coefficient_high,rig_stiffness [N/mm],"));
    assert!(fits.len() == 3 && fits[1].starts_with("1,") && fits[2].starts_with("4,"), "{fits:?}");
    let friction = |row: &str| row.split(',').nth(2).unwrap().parse::<f64>().unwrap();
    assert_eq!(json["fits"][1]["parameters"][0]["value"], friction(fits[2]));
    assert!(text.contains("in cycle 1 to ") && text.contains("in cycle 4 (2 fits)"), "{text}");
    assert!(answer.page.contains("friction coefficient over the cycles: fits, and their 95 % intervals"));
    assert!(
        text.starts_with("log.csv: 3 of 4 cycles used, fitted: cycle 4\n  skipped: 3 (points are missing"),
        "{text}"
    );
    assert!(
        table.starts_with("cycle,points,dissipated_energy [N mm],force_amplitude [N],displacement_amplitude [mm],opening [mm],energy_ratio,"),
        "{table}"
    );
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[1].starts_with("1,100,") && lines[3] == "3,60,,,,,,,,,,,", "{table}");
    assert!(json["cycles"][2]["force_amplitude"].is_null());
    assert_eq!(json["cycles"][2]["points"], 60);
    // Text, table and record have the numbers of one answer.
    let energy = json["cycles"][3]["dissipated_energy"].as_f64().unwrap();
    assert!(lines[4].starts_with(&format!("4,100,{energy},")), "{}", lines[4]);
    assert_eq!(json["sliding_condition"], "gross_slip");
    // all cycles that are loops slide, the skipped one between them changes nothing
    let spans = json["sliding_conditions"].as_array().unwrap();
    assert_eq!(spans.len(), 1);
    assert_eq!((&spans[0]["from"], &spans[0]["to"]), (&serde_json::json!(1.0), &serde_json::json!(4.0)));
    assert!(text.contains("over the cycles        gross slip in cycles 1 to 4"), "{text}");
    assert!(answer.page.contains("dissipated energy over the cycles"));
    assert!(answer.page.contains("Fretting loops of log.csv"));
}

/// A number of the case is fitted beside the other constants; a key where none stands is refused.
#[test]
fn a_key_of_the_case_is_fitted_or_refused() {
    let request = |key: &str| Request { key: Some(key.to_owned()), ..Request::default() };
    let json = answer(LOOP, &request("lower.substrate.young")).record;
    let young = &json["parameters"][3];
    assert_eq!(young["name"], "lower.substrate.young");
    let [low, high] = ["low", "high"].map(|key| young[key].as_f64().unwrap());
    // The formula has 210e3; one loop in gross slip tells it to a third beside the rig.
    assert!(low < 210e3 && 210e3 < high && high / low < 3.0, "{young}");
    let beside = Beside { folder: PathBuf::new(), contents: Vec::new() };
    let case = CaseFile::of_text("case.toml", CASE.to_owned(), beside);
    for key in [
        "lower.substrate.poisson",
        "title",
        "nope",
        "",
        "load.7.normal_force",
        "load[7].normal_force",
        "lower.substrate.young[0]",
        "lower.substrate[.young",
        "lower.substrate].young",
    ] {
        let refused = identify(("log.csv", LOOP.as_bytes()), &case, &request(key)).unwrap_err();
        assert!(refused.message().contains("the case has no positive number there"), "{refused:?}");
    }
}

/// A rigid ball on a body of E = 70 GPa, nu = 0.3, that the case takes for softer: Hertz, in closed form, without noise.
const PRESSED: &str = "[units]\nlength = \"mm\"\nforce = \"N\"\n[grid]\ncells = [32, 32]\nsize = \"auto\"\n[upper]\nrigid = true\n[lower]\nsubstrate = { young = 50e3, poisson = 0.3 }\n\
    [profile.sphere]\nradius = 1.0\n[[load]]\nnormal_force = 1.0\nincrements = 1\n";

fn hertz() -> String {
    (0..60).fold("h (um)\tP (N)\n".to_owned(), |mut log, k| {
        let depth = 0.02e-3 * f64::from(k) - 0.1e-3;
        let load = 4.0 / 3.0 * 70e3 / 0.91 * depth.max(0.0).powf(1.5);
        let _ = writeln!(log, "{:.6}\t{load:.8}", 1e3 * depth + 0.4);
        log
    })
}

fn indented(keys: &[&str], request: IndentationRequest) -> Result<Identified, Failure> {
    let beside = Beside { folder: PathBuf::new(), contents: Vec::new() };
    let case = CaseFile::of_text("case.toml", PRESSED.to_owned(), beside);
    let keys = keys.iter().map(|key| (*key).to_owned()).collect();
    indentation(("log.txt", hertz().as_bytes()), &case, &IndentationAsked { request, keys })
}

/// Text, record, table and page have the numbers of one answer; the modulus is that of the closed form to the error of 32 cells.
#[test]
fn an_indentation_is_written_as_one_answer() {
    let mut answer = indented(&["lower.substrate.young"], IndentationRequest::default()).unwrap();
    let (json, text, table, page) = (answer.record, answer.text, answer.tables.remove(0).1, answer.page);
    let young = json["parameters"][0]["value"].as_f64().unwrap();
    assert!((young / 70e3 - 1.0).abs() < 0.01, "{young}");
    assert!((json["touch"].as_f64().unwrap() - 0.4e-3).abs() < 2e-6, "{json}");
    assert_eq!(json["parameters"][1]["name"], "depth at first touch");
    assert!(
        text.starts_with("log.txt: 60 points of the whole test, 2 constants fitted with ")
            && text.contains(&format!("lower.substrate.young  {} MPa   95 %: ", figure(young)))
            && text.contains("on half of the cells: "),
        "{text}"
    );
    assert!(table.starts_with("line,depth [mm],force [N],computed_force [N],residual [N]\n2,"), "{table}");
    assert_eq!(table.lines().count(), 61);
    assert!(page.contains("Indentation of log.txt") && page.contains("residuals of the indentation"));
}

/// Keys with numbers of lists in brackets or as keys of their own, twice the same, or where none stands.
#[test]
fn keys_of_an_indentation_are_those_of_the_case() {
    for (keys, words) in [
        (
            &["lower.coatings[0].young"][..],
            "--fit lower.coatings[0].young: the case has no positive number there",
        ),
        (&["lower.coatings[0].young", "lower.coatings.0.young"], "named twice"),
        (&["load[0].normal_force"], "load over depth tells numbers of the bodies and of the profile"),
    ] {
        let refused = indented(keys, IndentationRequest::default()).unwrap_err();
        assert!(refused.message().contains(words), "{refused:?}");
    }
}

/// Two equal halves in a line contact of 150 N/mm: units mm and N.
const LINE: &str = "[units]\nlength = \"mm\"\nforce = \"N\"\n[grid]\ncells = 32\nsize = 0.4\n[upper]\nsubstrate = { young = 210e3, poisson = 0.3 }\n\
    [lower]\nsubstrate = { young = 210e3, poisson = 0.3 }\n[profile.cylinder]\nradius = 20.0\naxis = \"y\"\n[friction]\ncoefficient = 0.6\n\
    [rig]\ntangential_stiffness = 2.0e4\n[[load]]\nnormal_force = 150.0\nincrements = 1\n";

/// A parallelogram of gross slip: the plateaus at 0.45 of the normal force, the flanks of 15 kN/mm for a mm of length, 0.02 mm to and fro.
fn parallelogram(unit: &str) -> String {
    let (most, limit, slope) = (0.01, 0.45 * 150.0, 15e3);
    (0..200).fold(format!("displacement [mm],force [{unit}]\n"), |mut log, k| {
        let along = f64::from(k) / 50.0;
        let displacement = most * if along < 2.0 { along - 1.0 } else { 3.0 - along };
        let way = if along < 2.0 { displacement + most } else { most - displacement };
        let force = (slope * way - limit).min(limit) * if along < 2.0 { 1.0 } else { -1.0 };
        let _ = writeln!(log, "{displacement:e},{force:e}");
        log
    })
}

/// Forces of a line contact are those of a unit of its length: a log in N/mm is taken, one in N refused, and heads are those of `history.csv`.
#[test]
fn forces_of_a_line_contact_are_those_of_a_unit_of_its_length() {
    let of = |unit: &str| {
        let beside = Beside { folder: PathBuf::new(), contents: Vec::new() };
        let case = CaseFile::of_text("case.toml", LINE.to_owned(), beside);
        identify(("log.csv", parallelogram(unit).as_bytes()), &case, &Request::default())
    };
    let refused = of("N").unwrap_err();
    assert!(refused.message().contains("the case is a line contact"), "{refused:?}");
    let [mut plain, mut kilo] =
        ["N/mm", "kN/m"].map(|unit| of(unit).unwrap_or_else(|failure| panic!("{failure:?}")));
    let heads =
        "cycle,points,dissipated_energy [N],force_amplitude [N/mm],displacement_amplitude [mm],opening [mm],";
    let (table, text, json) = (plain.tables.remove(0).1, plain.text, plain.record);
    assert!(table.starts_with(heads) && table.contains("slope_after_reversal [N/mm^2]"), "{table}");
    assert_eq!(table, kilo.tables.remove(0).1);
    let friction = &json["parameters"][0];
    assert!((friction["value"].as_f64().unwrap() / 0.45 - 1.0).abs() < 0.01, "{json}");
    assert_eq!(json["parameters"][1]["unit"], "force/length^2");
    assert!(text.contains("N/mm^2   95 %") && plain.page.contains("tangential force [N/mm]"), "{text}");
}
