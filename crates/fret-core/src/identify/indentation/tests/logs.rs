//! What a log is refused for, and what is told of logs that are odd.

use super::super::{IndentationRequest, Part};
use super::{Test, found, hertz, homogeneous, refusal_of, sphere};

fn refusal(log: &str, keys: &[(&str, f64)], request: &IndentationRequest) -> String {
    refusal_of(&homogeneous("profile.sphere.radius = 1.0", 16), log, keys, request)
}

#[test]
fn what_is_no_indentation_is_refused_with_its_place() {
    let good = Test { deepest: 1e-3, load: &hertz, frame: 0.0 }.log([0.0; 2], 0);
    let key = [("lower.substrate.young", 70e3)];
    let request = IndentationRequest::default();
    let strict = IndentationRequest { strict: true, ..request.clone() };
    let holed = good.replacen("\n0.", "\nx.", 1);
    let first = holed.lines().position(|line| line.starts_with("x.")).unwrap() + 1;
    let short = good.lines().take(8).fold(String::new(), |text, line| text + line + "\n");
    let still = good.lines().enumerate().fold(String::new(), |text, (row, line)| {
        let depth = line.split(';').next().unwrap();
        text + &if row == 0 { line.to_owned() } else { format!("{depth};2.5") } + "\n"
    });
    let touch = IndentationRequest { touch: Some(1.0), ..request.clone() };
    for (log, keys, request, words) in [
        (&holed, &key, &strict, format!("log.csv: line {first}, column \"depth\": \"x.")),
        (&short, &key, &request, "7 rows of numbers: an indentation needs at least 12".to_owned()),
        (&still, &key, &request, "column \"load\" is 2.5 in all lines from 2 to 201".to_owned()),
        (&good.replace("load", "time"), &key, &request, "no line names the columns".to_owned()),
        (
            &good,
            &[("friction.coefficient", 0.5)],
            &request,
            "tells numbers of the bodies and of the profile".to_owned(),
        ),
        (&good, &key, &touch, "is the depth at first touch right".to_owned()),
    ] {
        let message = refusal(log, keys, request);
        assert!(message.contains(&words), "{message}: expected {words}");
    }
}

/// What the model does not have is said: a test whose unloading lies below its loading, one whose columns are counted the other way.
#[test]
fn a_test_that_is_not_elastic_is_told_and_its_parts_can_be_fitted() {
    let case = homogeneous("profile.sphere.radius = 1.0", 32);
    let key = [("lower.substrate.young", 60e3)];
    let log = Test { deepest: 1e-3, load: &hertz, frame: 0.0 }.log([0.0; 2], 0);
    let plastic = log.lines().enumerate().fold(String::new(), |text, (row, line)| {
        let Some((depth, load)) = line.split_once(';').filter(|_| row > 0) else { return text + line + "\n" };
        let [depth, load] = [depth, load].map(|number| number.parse::<f64>().unwrap());
        // Unloading at the same depths with less load, and both columns counted the other way.
        let load = if row > 100 && load > 0.0 { load * (load / 3243.0).powf(0.2) } else { load };
        text + &format!("{:.6};{:.6}\n", -depth, -load)
    });
    let whole = found(&case, &key, &plastic, &IndentationRequest::default()).unwrap();
    println!("{:?} {:?}", whole.constants[0], whole.notes);
    for words in [
        "loading lies above unloading by",
        "the load is largest below zero",
        "the depth falls where the load grows",
    ] {
        assert!(whole.notes.iter().any(|note| note.contains(words)), "{words}: {:?}", whole.notes);
    }
    let request = IndentationRequest { part: Part::Loading, ..IndentationRequest::default() };
    let loading = found(&case, &key, &plastic, &request).unwrap();
    assert!((loading.constants[0].value / 70e3 - 1.0).abs() < 0.01, "{:?}", loading.constants[0]);
    assert!(loading.lines[0] == 2 && *loading.lines.last().unwrap() < 103);
}

/// A log from half of the depth on, of a rigid frame: its modulus is found with the frame, too, which is not negative.
#[test]
fn a_log_that_begins_deep_is_fitted_with_its_frame() {
    let case = |values: &[f64]| sphere(&[values[0], 1.0]);
    let log = Test { deepest: 1e-3, load: &hertz, frame: 0.0 }.log([0.003; 2], 3);
    let is_deep = |line: &&str| line.split(';').next().unwrap().parse::<f64>().is_ok_and(|depth| depth > 0.8);
    let rows: Vec<&str> = log.lines().take(1).chain(log.lines().filter(is_deep)).collect();
    let request = IndentationRequest { frame: true, ..IndentationRequest::default() };
    let deep = found(&case, &[("lower.substrate.young", 50e3)], &rows.join("\n"), &request).unwrap();
    let young = &deep.constants[0];
    assert!(deep.frame >= 0.0, "{deep:?}");
    assert!(
        young.interval[0] < 1.01 * 70e3 && young.interval[1] > 0.99 * 70e3 && young.value < 1.3 * 70e3,
        "{young:?} {:?}",
        deep.notes
    );
}

/// Where the depth is counted downwards, the touch is told and asked for as the log counts it.
#[test]
fn the_touch_is_told_as_the_log_counts_it() {
    let case = |values: &[f64]| sphere(&[values[0], 1.0]);
    let log = Test { deepest: 1e-3, load: &hertz, frame: 0.0 }.log([0.0; 2], 0);
    let turned: Vec<String> = log
        .lines()
        .map(|line| match line.split_once(';') {
            Some((depth, load)) if depth.parse::<f64>().is_ok() => {
                format!("{};{load}", -depth.parse::<f64>().unwrap())
            }
            _ => line.to_owned(),
        })
        .collect();
    let key = [("lower.substrate.young", 50e3)];
    let of = |touch| {
        let request = IndentationRequest { touch, ..IndentationRequest::default() };
        found(&case, &key, &turned.join("\n"), &request).unwrap()
    };
    let free = of(None);
    assert!(
        (free.touch + 0.3e-3).abs() < 2e-6 && free.constants[1].value == free.touch,
        "{:?}",
        free.constants
    );
    let young = of(Some(-0.3e-3)).constants[0].value;
    assert!((young / 70e3 - 1.0).abs() < 0.01, "{young}");
    let request = IndentationRequest { touch: Some(f64::NAN), ..IndentationRequest::default() };
    assert!(found(&case, &key, &log, &request).unwrap_err().to_string().contains("no finite number"));
}

/// Thousands with separators are no numbers, and those rows no few to skip: the first of them is named.
#[test]
fn rows_without_numbers_in_a_sequence_are_refused() {
    let log = Test { deepest: 1e-3, load: &hertz, frame: 0.0 }.log([0.0; 2], 0);
    let rows: Vec<String> = log
        .lines()
        .enumerate()
        .map(|(row, line)| if (90..94).contains(&row) { "0.9;1,022.624".to_owned() } else { line.to_owned() })
        .collect();
    let case = |values: &[f64]| sphere(&[values[0], 1.0]);
    let key = [("lower.substrate.young", 50e3)];
    let refused = found(&case, &key, &rows.join("\n"), &IndentationRequest::default()).unwrap_err();
    let words = refused.to_string();
    assert!(words.contains("line 91") && words.contains("1,022.624"), "{words}");
}
