//! Runs that are broken off, in every way a run can be, and resumed: the results are those of an unbroken run, bit for
//! bit (only the times differ); where that is impossible the run is refused and nothing is touched.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::bench::{Answer, Bench, SPHERE};

/// Coated, so that pressure and shear act on each other; with every kind of control, and changes from one to another.
const COATED: &str = r#"
[grid]
cells = [20, 24]
size = [200e-6, 240e-6]

[upper]
rigid = true

[lower]
coatings = [{ thickness = 20e-6, young = 400e9, poisson = 0.25 }]
substrate = { young = 210e9, poisson = 0.3 }

[profile.ellipsoid]
radius_x = 8e-3
radius_y = 12e-3

[friction]
coefficient = 0.2

[[load]]
normal_force = 1.0
increments = 8
ramp = "cubic"

[[load]]
tangential_force = [0.1, 0.05]
cycles = 2
increments = 12

[[load]]
shift = [40e-9, 0.0]
increments = 10

[[load]]
approach = 60e-9
twist = 1e-4
increments = 6

[[load]]
normal_force = 0.2
increments = 6

[output]
fields = ["pressure", "shear", "slip", "gap", "zone"]
every = 3
"#;

/// The small sphere with a longer history: pressure first, then shear.
fn long_sphere() -> String {
    SPHERE.replace("increments = 3\n", "increments = 20\n").replace("increments = 8\n", "increments = 40\n")
}

/// Pressure alone, up and down again.
fn frictionless() -> String {
    let head = SPHERE.split("[[load]]").next().unwrap().replace("0.1", "0.0");
    format!(
        "{head}[[load]]\nnormal_force = 1.0\nincrements = 60\n[[load]]\nnormal_force = 0.1\nincrements = 40\n\
         [output]\nfields = [\"pressure\", \"gap\"]\nevery = 7\n"
    )
}

/// The coated contact in cycles of shift that wear it, then released. A computed cycle stands for up to three.
fn worn() -> String {
    let head = COATED.split("[[load]]").next().unwrap();
    format!(
        "{head}[wear]\ncoefficient = 2e-11\nevery = 3\nlargest_step = 0.1\n\
         [[load]]\nnormal_force = 1.0\nincrements = 4\n\
         [[load]]\nshift = [60e-9, 0.0]\ncycles = 20\nincrements = 8\n\
         [[load]]\nnormal_force = 0.3\nincrements = 3\n\
         [output]\nfields = [\"pressure\", \"gap\", \"worn_depth\"]\nevery = 3\n"
    )
}

/// The coated contact in cycles until they close, which brings the stage after them forward.
fn steady() -> String {
    let head = COATED.split("[[load]]").next().unwrap();
    format!(
        "{head}[[load]]\nnormal_force = 1.0\nincrements = 4\n\
         [[load]]\ntangential_force = [0.15, 0.0]\nincrements = 12\nuntil_steady = {{ tolerance = 2e-3, most_cycles = 12 }}\n\
         [[load]]\nshift = [40e-9, 20e-9]\nincrements = 6\n\
         [output]\nfields = [\"shear\", \"zone\"]\nevery = 5\n"
    )
}

/// All files of a folder, by their names below it.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fn walk(folder: &Path, below: &str, found: &mut BTreeMap<String, Vec<u8>>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{below}{}", entry.file_name().to_string_lossy());
            if entry.path().is_dir() {
                walk(&entry.path(), &format!("{name}/"), found);
            } else {
                found.insert(name, std::fs::read(entry.path()).unwrap());
            }
        }
    }
    let mut found = BTreeMap::new();
    walk(folder, "", &mut found);
    found
}

/// What a run found: the table without its column of times, the table of cycles, and every file of the field store.
fn findings(results: &Path) -> BTreeMap<String, Vec<u8>> {
    let table = std::fs::read_to_string(results.join("history.csv")).unwrap();
    let place = table.lines().next().unwrap().split(',').position(|column| column == "wall_s").unwrap();
    let timeless = table.lines().map(|line| {
        let cells = line.split(',').enumerate().filter(|(column, _)| *column != place);
        cells.map(|(_, cell)| cell).collect::<Vec<_>>().join(",")
    });
    let mut found = files(&results.join("fields.zarr"));
    found.insert("history.csv".to_owned(), timeless.collect::<Vec<_>>().join("\n").into_bytes());
    found.insert("cycles.csv".to_owned(), std::fs::read(results.join("cycles.csv")).unwrap());
    found
}

fn assert_same(bench: &Bench, one: &str, other: &str) {
    let [one, other] = [one, other].map(|name| findings(&bench.folder.join(name)));
    assert_eq!(one.keys().collect::<Vec<_>>(), other.keys().collect::<Vec<_>>());
    for (name, content) in &one {
        assert!(other[name] == *content, "{name} differs");
    }
}

/// Solves a case without a break, into `whole`; the time that took.
fn solve_whole(bench: &Bench, case: &str) -> Duration {
    let started = Instant::now();
    let answer = bench.file("case.toml", case).fret(&["run", "case.toml", "--out", "whole", "--quiet"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    started.elapsed()
}

/// Starts a run into `broken`, or goes on with it, and ends it by a signal as soon as its table has so many lines.
fn break_off(bench: &Bench, lines: usize, signal: &str) -> Answer {
    let table = bench.folder.join("broken/history.csv");
    let run = bench.command(&["run", "case.toml", "--out", "broken", "--quiet", "--resume"]).spawn().unwrap();
    let patience = Instant::now();
    let written = || std::fs::read_to_string(&table).map_or(0, |text| text.lines().count());
    while written() < lines && patience.elapsed().as_secs() < 60 {
        std::thread::sleep(Duration::from_millis(2));
    }
    let sent = std::process::Command::new("kill").args([signal, &run.id().to_string()]).status().unwrap();
    assert!(sent.success());
    Answer::from(run.wait_with_output().unwrap())
}

fn resume(bench: &Bench) -> Answer {
    bench.fret(&["run", "case.toml", "--out", "broken", "--resume"])
}

/// A history that is long enough to be broken off before its end, and its unbroken results in `whole`.
fn long_bench(test: &str) -> Bench {
    let bench = Bench::new(test);
    solve_whole(&bench, &long_sphere().replace("cycles = 2", "cycles = 12"));
    bench
}

/// Kills runs at moments drawn by a seeded generator until enough kills hit a living run, resuming in between.
fn killed_at_random(test: &str, case: &str, kills_wanted: usize, mut seed: u64) {
    let bench = Bench::new(test);
    let time = solve_whole(&bench, case);
    let broken = bench.folder.join("broken");
    let (mut kills, mut solved) = (0, 0);
    let patience = Instant::now();
    while kills < kills_wanted || solved == 0 {
        assert!(patience.elapsed().as_secs() < 300, "{kills} kills, {solved} runs solved");
        // Marsaglia's xorshift.
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        let threads = if seed & 1 == 0 { "1" } else { "2" };
        let arguments = ["run", "case.toml", "--out", "broken", "--resume", "--quiet", "--threads", threads];
        let mut run = bench.command(&arguments).spawn().unwrap();
        // Between nothing and nearly the whole: at the start, among the increments, while files are written.
        std::thread::sleep(time.mul_f64(0.9 * (seed >> 11) as f64 / (1_u64 << 53) as f64));
        run.kill().unwrap();
        let status = run.wait().unwrap();
        if status.success() {
            assert_same(&bench, "whole", "broken");
            std::fs::remove_dir_all(&broken).unwrap();
            solved += 1;
        } else {
            assert_eq!(status.code(), None, "neither killed nor solved: {}", resume(&bench).err);
            kills += 1;
        }
        if kills == kills_wanted && broken.exists() {
            let answer = resume(&bench);
            assert_eq!(answer.code, Some(0), "{}", answer.err);
            assert_same(&bench, "whole", "broken");
            solved += 1;
        }
    }
}

#[test]
fn a_coated_run_killed_twenty_times_ends_as_if_nothing_had_been() {
    killed_at_random("killed-coated", COATED, 20, 0x9e37_79b9_7f4a_7c15);
}

#[test]
fn a_run_of_pressure_then_shear_killed_twenty_times_ends_as_if_nothing_had_been() {
    killed_at_random("killed-sphere", &long_sphere(), 20, 0xbf58_476d_1ce4_e5b9);
}

#[test]
fn a_frictionless_run_killed_twenty_times_ends_as_if_nothing_had_been() {
    killed_at_random("killed-frictionless", &frictionless(), 20, 0x94d0_49bb_1331_11eb);
}

#[test]
fn a_run_with_wear_killed_eight_times_ends_as_if_nothing_had_been() {
    killed_at_random("killed-worn", &worn(), 8, 0xd6e8_feb8_6659_fd93);
}

#[test]
fn a_run_until_it_is_steady_killed_eight_times_ends_as_if_nothing_had_been() {
    killed_at_random("killed-steady", &steady(), 8, 0xa076_1d64_78bd_642f);
}

/// A run that goes on from a checkpoint older than its tables and fields, as after a power failure.
#[cfg(unix)]
#[test]
#[ignore = "long: 4 s"]
fn cycles_and_fields_beyond_the_checkpoint_are_cut_off() {
    let bench = Bench::new("beyond");
    solve_whole(&bench, &worn().replace("cycles = 20", "cycles = 90"));
    let checkpoint = bench.folder.join("broken/checkpoint");
    assert_eq!(break_off(&bench, 40, "-INT").code, Some(130));
    let older = std::fs::read(checkpoint.join("even")).unwrap();
    assert_eq!(break_off(&bench, 100, "-INT").code, Some(130));
    for newer in ["even", "odd"] {
        std::fs::remove_file(checkpoint.join(newer)).unwrap();
    }
    std::fs::write(checkpoint.join("synced"), older).unwrap();

    // A table of cycles that is shorter than the checkpoint tells is not gone on with.
    let table = bench.text("broken/cycles.csv");
    std::fs::write(bench.folder.join("broken/cycles.csv"), &table[..table.find('\n').unwrap()]).unwrap();
    let refused = resume(&bench);
    assert_eq!(refused.code, Some(1), "{}", refused.err);
    assert!(
        refused.err.contains("cycles.csv") && refused.err.contains("nothing was touched"),
        "{}",
        refused.err
    );
    std::fs::write(bench.folder.join("broken/cycles.csv"), table).unwrap();

    let answer = resume(&bench);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert_same(&bench, "whole", "broken");
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_says_how_to_go_on_and_does() {
    let bench = long_bench("resumed");
    let interrupted = break_off(&bench, 30, "-INT");
    assert_eq!(interrupted.code, Some(130), "{}", interrupted.err);
    let again = bench.fret(&["run", "case.toml", "--out", "broken"]);
    assert_eq!(again.code, Some(1), "hours of work are not thrown away unasked: {}", again.err);
    assert!(again.err.contains("--resume") && again.err.contains("--force"), "{}", again.err);
    let answer = resume(&bench);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.err.contains("increments are solved; continuing with increment"), "{}", answer.err);
    assert_same(&bench, "whole", "broken");
    let record: Value = serde_json::from_str(&bench.text("broken/run.json")).unwrap();
    assert_eq!((&record["status"], &record["resumed"]), (&"solved".into(), &1.into()));
    let whole: Value = serde_json::from_str(&bench.text("whole/run.json")).unwrap();
    for total in ["increments", "convolutions", "dissipated_energy", "largest_residual"] {
        assert_eq!(record["totals"][total], whole["totals"][total], "{total}");
    }
    assert!(!bench.folder.join("broken/checkpoint").exists());
}

#[cfg(unix)]
#[test]
#[ignore = "long: 5 s"]
fn torn_and_damaged_checkpoints_are_told_from_whole_ones() {
    let bench = long_bench("damaged");
    break_off(&bench, 40, "-KILL");
    let newest = |name: &str| bench.folder.join("broken/checkpoint").join(name);

    // Torn in the middle of a write, as by a kill: the other one serves.
    let odd = std::fs::read(newest("odd")).unwrap();
    std::fs::write(newest("odd"), &odd[..odd.len() / 2]).unwrap();
    // A single flipped bit is found as well, whatever it stood for.
    let mut even = std::fs::read(newest("even")).unwrap();
    let middle = even.len() / 2;
    even[middle] ^= 0x10;
    std::fs::write(newest("even"), &even).unwrap();
    let synced = std::fs::read(newest("synced")).unwrap();
    std::fs::write(newest("synced"), b"fretting checkpoint\nnot really").unwrap();

    let before = files(&bench.folder.join("broken"));
    let refused = resume(&bench);
    assert_eq!(refused.code, Some(1), "{}", refused.err);
    for words in ["damaged", "even", "odd", "synced", "--force"] {
        assert!(refused.err.contains(words), "expected {words:?}: {}", refused.err);
    }
    assert!(files(&bench.folder.join("broken")) == before, "a refusal touches nothing");

    // What a power failure leaves: only the one that waited for the disk, and fields beyond it.
    std::fs::write(newest("synced"), synced).unwrap();
    let answer = resume(&bench);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.err.contains("an older checkpoint is taken"), "{}", answer.err);
    assert_same(&bench, "whole", "broken");
}

#[cfg(unix)]
#[test]
fn results_that_miss_a_part_are_not_gone_on_with() {
    let bench = long_bench("missing");
    break_off(&bench, 60, "-KILL");
    let state = std::fs::read_dir(bench.folder.join("broken/states")).unwrap().next().unwrap().unwrap();
    let state = format!("broken/states/{}", state.file_name().to_string_lossy());
    for part in ["broken/fields.zarr/pressure/c/1/0/0", "broken/history.csv", &state] {
        let path = bench.folder.join(part);
        let content = std::fs::read(&path).unwrap();
        let mut flipped = content.clone();
        flipped[content.len() / 2] ^= 1;
        for damaged in [&content[..content.len() / 3], &flipped] {
            std::fs::write(&path, damaged).unwrap();
            let before = files(&bench.folder.join("broken"));
            let refused = resume(&bench);
            assert_eq!(refused.code, Some(1), "{part}: {}", refused.err);
            assert!(
                refused.err.contains(part) && refused.err.contains("nothing was touched"),
                "{}",
                refused.err
            );
            assert!(files(&bench.folder.join("broken")) == before);
        }
        std::fs::write(&path, content).unwrap();
    }
    // What follows from the case is written anew.
    for part in ["zarr.json", "pressure/zarr.json", "x/zarr.json", "y/c/0", "increment/c/0"] {
        std::fs::remove_file(bench.folder.join("broken/fields.zarr").join(part)).unwrap();
    }
    assert_eq!(resume(&bench).code, Some(0));
    assert_same(&bench, "whole", "broken");
}

/// A table that somebody edited: as long as before, but not what was computed.
#[cfg(unix)]
#[test]
fn a_number_that_was_changed_in_a_table_is_noticed() {
    let bench = long_bench("altered");
    break_off(&bench, 110, "-KILL"); // two cycles are over
    for table in ["broken/history.csv", "broken/cycles.csv"] {
        let content = bench.text(table);
        // The last digit of a number with an exponent, in the first row.
        let row = content.find('\n').unwrap() + 1;
        let place = row + content[row..].find("e-").unwrap() - 1;
        let digit = if &content[place..=place] == "7" { "8" } else { "7" };
        let mut altered = content.clone();
        altered.replace_range(place..=place, digit);
        std::fs::write(bench.folder.join(table), &altered).unwrap();
        let before = files(&bench.folder.join("broken"));
        let refused = resume(&bench);
        assert_eq!(refused.code, Some(1), "{table}: {}", refused.err);
        assert!(refused.err.contains("changed since") && refused.err.contains(table), "{}", refused.err);
        assert!(files(&bench.folder.join("broken")) == before);
        std::fs::write(bench.folder.join(table), content).unwrap();
    }
    assert_eq!(resume(&bench).code, Some(0));
    assert_same(&bench, "whole", "broken");
}

#[test]
fn a_solved_run_is_left_as_it_is() {
    let bench = Bench::new("solved-already");
    solve_whole(&bench, SPHERE);
    let before = files(&bench.folder);
    let answer = bench.fret(&["run", "case.toml", "--out", "whole", "--resume", "--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let told: Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(told["status"], "solved");
    assert!(told["message"].as_str().unwrap().contains("solved already"), "{}", answer.out);
    assert!(files(&bench.folder) == before);
}

#[test]
fn a_case_that_was_changed_is_not_gone_on_with() {
    let bench = Bench::new("changed");
    solve_whole(&bench, SPHERE);
    bench.file("case.toml", &SPHERE.replace("coefficient = 0.1", "coefficient = 0.11"));
    let before = files(&bench.folder);
    let refused = bench.fret(&["run", "case.toml", "--out", "whole", "--resume"]);
    assert_eq!(refused.code, Some(1), "{}", refused.err);
    assert!(refused.err.contains("another case"), "{}", refused.err);
    assert!(files(&bench.folder) == before);

    // Comments and order are no change.
    bench.file("case.toml", &format!("# the same\n{SPHERE}"));
    let same = bench.fret(&["run", "case.toml", "--out", "whole", "--resume"]);
    assert_eq!(same.code, Some(0), "{}", same.err);
}

#[test]
fn there_is_nothing_to_go_on_with_in_an_empty_folder_so_the_run_starts() {
    let bench = Bench::new("resume-nothing");
    solve_whole(&bench, SPHERE);
    assert_eq!(resume(&bench).code, Some(0));
    assert_same(&bench, "whole", "broken");
}

#[cfg(unix)]
#[test]
fn two_runs_do_not_write_into_one_folder() {
    let bench = Bench::new("two-runs");
    let endless = long_sphere().replace("cycles = 2", "cycles = 100000");
    bench.file("case.toml", &endless);
    let mut first = bench.command(&["run", "case.toml", "--out", "broken", "--quiet"]).spawn().unwrap();
    let patience = Instant::now();
    while !bench.folder.join("broken/checkpoint/even").exists() && patience.elapsed().as_secs() < 60 {
        std::thread::sleep(Duration::from_millis(5));
    }
    for wish in ["--resume", "--force"] {
        let second = bench.fret(&["run", "case.toml", "--out", "broken", wish]);
        assert_eq!(second.code, Some(1), "{}", second.err);
        assert!(second.err.contains("another run is writing"), "{}", second.err);
    }
    first.kill().unwrap();
    first.wait().unwrap();
    assert!(bench.text("broken/history.csv").lines().count() > 1);
}

/// No file may grow beyond a limit of the system: the writing fails as on a full disk. Then there is room again.
#[cfg(unix)]
#[test]
fn a_full_disk_ends_a_run_and_with_room_it_goes_on() {
    let bench = Bench::new("full");
    solve_whole(&bench, &long_sphere());
    // The first checkpoint, without a state before it, has room in 60 half-kilobytes; a later one has not.
    let limited = format!(
        "trap '' XFSZ; ulimit -f 60; exec '{}' run case.toml --out broken --quiet",
        env!("CARGO_BIN_EXE_fret")
    );
    let mut shell = std::process::Command::new("sh");
    let answer = Answer::from(shell.args(["-c", &limited]).current_dir(&bench.folder).output().unwrap());
    assert_eq!(answer.code, Some(2), "{}", answer.err);
    assert!(answer.err.contains("cannot be written"), "{}", answer.err);
    assert!(answer.err.contains("--resume continues"), "{}", answer.err);
    let answer = resume(&bench);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.err.contains("increments are solved; continuing with increment"), "{}", answer.err);
    assert_same(&bench, "whole", "broken");
}

#[cfg(unix)]
#[test]
fn a_folder_without_permission_is_refused_by_name() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new("read-only");
    let locked = bench.folder.join("locked");
    std::fs::create_dir(&locked).unwrap();
    std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o555)).unwrap();
    // The system's administrator may write everywhere: then there is nothing to be seen here.
    if std::fs::write(locked.join("probe"), "").is_ok() {
        return;
    }
    bench.file("case.toml", SPHERE);
    for wish in ["--quiet", "--resume"] {
        let answer = bench.fret(&["run", "case.toml", "--out", "locked", wish]);
        assert_eq!(answer.code, Some(2), "{}", answer.err);
        assert!(answer.err.contains("no permission"), "{}", answer.err);
    }
    std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o755)).unwrap();
}
