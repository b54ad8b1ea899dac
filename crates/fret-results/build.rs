//! Tells the program the commit that it is built from, and whether its sources were changed since: from git, or from what `cargo package`
//! writes down; "unknown" where neither is there.

use std::path::Path;
use std::process::Command;

/// What the program is made of, seen from this crate.
const SOURCES: [&str; 8] = [
    "src",
    "build.rs",
    "../fret-cli/src",
    "../fret-core/src",
    "../fret-fft/src",
    "../fret-py/src",
    "../fret-table/src",
    "../../Cargo.lock",
];

fn main() {
    let (commit, is_clean) = packaged().or_else(checked_out).unwrap_or(("unknown".to_owned(), None));
    let tree = is_clean.map_or("unknown", |is_clean| if is_clean { "clean" } else { "changed" });
    println!("cargo::rustc-env=FRET_COMMIT={commit}");
    println!("cargo::rustc-env=FRET_TREE={tree}");
    let changed = if is_clean == Some(false) { ", sources changed since" } else { "" };
    println!("cargo::rustc-env=FRET_VERSION={} (commit {commit}{changed})", env!("CARGO_PKG_VERSION"));
    // Nothing else can change the answer; without git nothing does.
    println!("cargo::rerun-if-changed=build.rs");
}

/// The commit of a published package.
fn packaged() -> Option<(String, Option<bool>)> {
    let told = std::fs::read_to_string(".cargo_vcs_info.json").ok()?;
    let commit = told.split("\"sha1\": \"").nth(1)?.split('"').next()?.to_owned();
    Some((commit, Some(!told.contains("\"dirty\": true"))))
}

/// The commit of a checkout of this project; not that of another one, which holds a copy.
fn checked_out() -> Option<(String, Option<bool>)> {
    if git(&["rev-parse", "--show-prefix"])?.trim_end_matches('/') != "crates/fret-results" {
        return None;
    }
    let commit = git(&["rev-parse", "HEAD"])?;
    let changes = git(&[&["status", "--porcelain", "--"], &SOURCES[..]].concat());
    let moves = git(&["rev-parse", "--git-path", "logs/HEAD"])?;
    for path in SOURCES.iter().copied().chain([moves.as_str()]).filter(|path| Path::new(path).exists()) {
        println!("cargo::rerun-if-changed={path}");
    }
    Some((commit, changes.map(|changes| changes.is_empty())))
}

fn git(words: &[&str]) -> Option<String> {
    let answer = Command::new("git").args(words).output().ok().filter(|answer| answer.status.success())?;
    Some(String::from_utf8(answer.stdout).ok()?.trim().to_owned())
}
