//! Folders of results that are not whole any more: nothing is told from them as if they were.

use std::path::Path;

use serde_json::Value;

use crate::bench::{Bench, SPHERE};

/// A solved run with all that others need to start from it.
fn solved(test: &str) -> Bench {
    let bench = Bench::new(test);
    let case = SPHERE.replace("\"shear\", \"zone\"", "\"shear\", \"slip\", \"zone\"");
    let answer = bench.file("case.toml", &case).fret(&["run", "case.toml", "--out", "run", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    bench
}

/// Changes a file, asks the readers, and puts it back; each has to refuse with these words.
fn refused_by(bench: &Bench, file: &str, change: impl FnOnce(&Path), readers: &[&[&str]], words: &str) {
    let path = bench.folder.join("run").join(file);
    let good = std::fs::read(&path).unwrap();
    change(&path);
    for reader in readers {
        let answer = bench.fret(reader);
        assert_eq!(answer.code, Some(1), "{file}: {reader:?}: {}", answer.err);
        assert!(answer.err.contains(words), "{file}: {reader:?}: expected {words:?}: {}", answer.err);
    }
    std::fs::write(&path, good).unwrap();
}

fn flip(place: usize) -> impl FnOnce(&Path) {
    move |path| {
        let mut bytes = std::fs::read(path).unwrap();
        bytes[place] ^= 1; // of a digit, another digit
        std::fs::write(path, bytes).unwrap();
    }
}

const EXPORT: &[&str] = &["export", "run", "--csv"];
const REPORT: &[&str] = &["report", "run"];
const STRESS: &[&str] = &["stress", "run", "--depths", "20e-6"];
const FROM: &[&str] = &["run", "case.toml", "--from", "run", "--out", "on"];
const RESUME: &[&str] = &["run", "case.toml", "--out", "run", "--resume"];

#[test]
fn a_changed_digit_of_a_table_is_noticed_by_every_reader() {
    let bench = solved("digits");
    let digit = bench.text("run/history.csv").rfind('.').unwrap() + 1;
    refused_by(&bench, "history.csv", flip(digit), &[EXPORT, REPORT, STRESS, FROM, RESUME], "changed since");
    let digit = bench.text("run/cycles.csv").rfind('.').unwrap() + 1;
    refused_by(&bench, "cycles.csv", flip(digit), &[EXPORT, REPORT, STRESS, FROM, RESUME], "changed since");
    let digit = bench.text("run/case.toml").find("210e9").unwrap();
    refused_by(&bench, "case.toml", flip(digit), &[EXPORT, REPORT, STRESS], "changed since");
    let digit = bench.text("run/run.json").find("210000000000").unwrap();
    refused_by(&bench, "run.json", flip(digit), &[EXPORT, REPORT, STRESS, FROM], "changed since");
}

#[test]
fn a_changed_bit_of_a_field_is_noticed_by_every_reader_of_it() {
    let bench = solved("bits");
    refused_by(
        &bench,
        "fields.zarr/pressure/c/4/0/0",
        flip(2000),
        &[EXPORT, REPORT, STRESS, FROM, RESUME],
        "checksum",
    );
    refused_by(&bench, "fields.zarr/shear_x/c/4/0/0", flip(0), &[EXPORT, STRESS, FROM, RESUME], "checksum");
    refused_by(&bench, "fields.zarr/x/c/0", flip(9), &[EXPORT, REPORT, STRESS, FROM, RESUME], "checksum");
    refused_by(&bench, "fields.zarr/increment/c/0", flip(8), &[EXPORT, STRESS, FROM, RESUME], "increment");
}

#[test]
fn what_is_missing_is_missed() {
    let bench = solved("missing-parts");
    let gone = |path: &Path| std::fs::remove_file(path).unwrap();
    refused_by(&bench, "fields.zarr/pressure/c/2/0/0", gone, &[EXPORT, STRESS, RESUME], "pressure");
    refused_by(&bench, "fields.zarr/shear_y/c/2/0/0", gone, &[EXPORT, STRESS, RESUME], "shear_y");
    refused_by(
        &bench,
        "fields.zarr/shear_x/zarr.json",
        gone,
        &[EXPORT, REPORT, STRESS, FROM, RESUME],
        "shear_x",
    );
    refused_by(&bench, "fields.zarr/zarr.json", gone, &[EXPORT, REPORT, STRESS, FROM, RESUME], "zarr.json");
    refused_by(&bench, "case.toml", gone, &[EXPORT, REPORT, STRESS], "case.toml");
    let states = std::fs::read_dir(bench.folder.join("run/states")).unwrap();
    let last =
        states.filter_map(|entry| entry.unwrap().file_name().to_str()?.parse::<usize>().ok()).max().unwrap();
    refused_by(&bench, &format!("states/{last}"), gone, &[FROM, RESUME], "missing");
    refused_by(&bench, &format!("states/{last}"), flip(40), &[FROM, RESUME], "damaged");
    refused_by(&bench, "states/memory", gone, &[FROM, RESUME], "missing");
    refused_by(&bench, "states/memory", flip(40), &[FROM, RESUME], "damaged");
}

#[test]
fn another_format_is_refused_by_every_reader() {
    let bench = solved("formats");
    let other = |path: &Path| {
        let record = std::fs::read_to_string(path).unwrap();
        std::fs::write(path, record.replace("\"format\": 1", "\"format\": 99")).unwrap();
    };
    refused_by(
        &bench,
        "run.json",
        other,
        &[EXPORT, REPORT, STRESS, FROM, RESUME],
        "another version of the format",
    );
}

/// Stores had no checksums once, and records neither.
#[test]
fn results_without_checksums_are_read_as_before() {
    let bench = solved("plain-stores");
    assert_eq!(bench.fret(&["export", "run", "--npz", "--out", "new.npz"]).code, Some(0));
    let store = bench.folder.join("run/fields.zarr");
    let without = |value: &mut Value| {
        let codecs = value["codecs"].as_array_mut().unwrap();
        assert_eq!(codecs.pop().unwrap()["name"], "crc32c");
    };
    let mut group: Value = serde_json::from_str(&bench.text("run/fields.zarr/zarr.json")).unwrap();
    let arrays = group["consolidated_metadata"]["metadata"].as_object_mut().unwrap();
    for (name, metadata) in arrays.iter_mut() {
        without(metadata);
        let mut pending = vec![store.join(name).join("c")];
        while let Some(path) = pending.pop() {
            if path.is_dir() {
                pending.extend(std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
            } else {
                let bytes = std::fs::read(&path).unwrap();
                std::fs::write(&path, &bytes[..bytes.len() - 4]).unwrap();
            }
        }
        std::fs::write(store.join(name).join("zarr.json"), metadata.to_string()).unwrap();
    }
    std::fs::write(store.join("zarr.json"), group.to_string()).unwrap();
    let mut record: Value = serde_json::from_str(&bench.text("run/run.json")).unwrap();
    for key in ["checksums", "states", "commit", "tree_is_clean"] {
        assert!(record.as_object_mut().unwrap().remove(key).is_some(), "{key}");
    }
    bench.file("run/run.json", &record.to_string());
    assert_eq!(bench.fret(&["export", "run", "--npz", "--out", "old.npz"]).code, Some(0));
    let [new, old] = ["new.npz", "old.npz"].map(|name| std::fs::read(bench.folder.join(name)).unwrap());
    assert!(new == old);
    for reader in [STRESS, FROM, RESUME, REPORT] {
        let answer = bench.fret(reader);
        assert_eq!(answer.code, Some(0), "{reader:?}: {}", answer.err);
    }
}

#[test]
fn version_and_record_name_the_commit() {
    let bench = solved("commit");
    let record: Value = serde_json::from_str(&bench.text("run/run.json")).unwrap();
    let commit = record["commit"].as_str().unwrap();
    assert!(commit == "unknown" || commit.len() >= 40 && commit.bytes().all(|byte| byte.is_ascii_hexdigit()));
    assert!(bench.fret(&["--version"]).out.contains(&format!("(commit {commit}")), "{commit}");
    assert_eq!(record["tree_is_clean"].is_boolean(), commit != "unknown");
}
