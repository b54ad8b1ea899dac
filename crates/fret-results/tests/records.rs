//! What a run writes down of its plan is read back whole: of every example, with maps, heights, wear of layers, springs and units.

use std::path::{Path, PathBuf};

use fret_core::plan::PlanRecord;
use fretting_results::CaseFile;
use serde::Deserialize;

#[test]
fn the_plan_of_every_example_reads_back_as_it_was_written() {
    let mut cases = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")];
    while let Some(folder) = folders.pop() {
        let all = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let (below, files): (Vec<PathBuf>, Vec<PathBuf>) = all.partition(|path| path.is_dir());
        folders.extend(below);
        cases.extend(files.into_iter().filter(|path| path.extension().is_some_and(|end| end == "toml")));
    }
    let mut planned = 0;
    for path in cases {
        let text = std::fs::read_to_string(&path).unwrap();
        if !text.contains("[[load]]") {
            continue; // a sweep
        }
        let written = CaseFile::read(&path).unwrap().planned().unwrap().to_json();
        let text = serde_json::to_string_pretty(&written).unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        let read =
            PlanRecord::deserialize(&value).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert_eq!(read.to_json(), written, "{}", path.display());
        planned += 1;
    }
    assert!(planned > 20, "{planned}");
}
