//! The project's own chores, run by `cargo xtask`: each is a list of commands, shown as they run, stopped at the first that fails.

use std::env;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

const USAGE: &str = "\
usage: cargo xtask CHORE

  test      the tests: Rust in release mode, then the Python package, built and installed into target/venv;
            with --long all of them, also those that take long
  check     format, clippy, documentation, and ruff for Python: warnings are errors
  bench     the benchmarks
  extremes  the stiff and extreme cases, and five thousand random ones, each certified, with their pages in docs/trust: half an
            hour
  docs      the site, into target/site, and the Rust documentation, into target/doc: warnings are errors
  wheel     the Python wheel, into target/wheels
  coverage  lines that the Rust tests reach, into target/coverage; wants `cargo install cargo-tarpaulin`
  audit     licences, sources and known faults of the dependencies; wants `cargo install cargo-deny`, and the network:
            exit code 3 says that the faults could not be looked up";

/// Exit code of a chore that could not get its answer.
const NOT_CHECKED: u8 = 3;

fn main() -> ExitCode {
    let words: Vec<String> = env::args().skip(1).collect();
    let (chore, steps) = match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["test"] => ("test", test(Tests::Short)),
        ["test", "--long"] => ("test --long", test(Tests::All)),
        ["check"] => ("check", check()),
        ["bench"] => ("bench", vec![cargo(&["bench", "--workspace", "--locked"])]),
        ["extremes"] => ("extremes", extremes()),
        ["docs"] => ("docs", docs()),
        ["wheel"] => ("wheel", wheel()),
        ["coverage"] => ("coverage", vec![coverage()]),
        ["audit"] => ("audit", audit()),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::FAILURE;
        }
    };
    match steps.iter().try_for_each(Step::run) {
        Ok(()) => {
            let names: Vec<&str> = steps.iter().map(|step| step.what).collect();
            eprintln!("xtask {chore}: passed: {}", names.join(", "));
            ExitCode::SUCCESS
        }
        Err(failure) => {
            eprintln!("xtask {chore}: {failure}");
            ExitCode::from(failure.code)
        }
    }
}

/// One command of a chore.
struct Step {
    what: &'static str,
    program: PathBuf,
    arguments: Vec<String>,
    variables: Vec<(&'static str, &'static str)>,
    /// Words on standard error by which a failure is not the answer no but no answer, and what is then said.
    unanswered: Option<(&'static str, &'static str)>,
}

/// A command that did not end well.
struct Failure {
    what: &'static str,
    why: String,
    code: u8,
}

impl fmt::Display for Failure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} failed: {}", self.what, self.why)
    }
}

impl Step {
    fn new(what: &'static str, program: impl Into<PathBuf>, arguments: &[&str]) -> Self {
        let arguments = arguments.iter().map(|&argument| argument.to_owned()).collect();
        Self { what, program: program.into(), arguments, variables: Vec::new(), unanswered: None }
    }

    fn called(mut self, what: &'static str) -> Self {
        self.what = what;
        self
    }

    fn with(mut self, name: &'static str, value: &'static str) -> Self {
        self.variables.push((name, value));
        self
    }

    fn unanswered_by(mut self, words: &'static str, meaning: &'static str) -> Self {
        self.unanswered = Some((words, meaning));
        self
    }

    fn run(&self) -> Result<(), Failure> {
        let settings: Vec<String> =
            self.variables.iter().map(|(name, value)| format!("{name}='{value}' ")).collect();
        eprintln!("+ {}{} {}", settings.concat(), self.program.display(), self.arguments.join(" "));
        let mut command = Command::new(&self.program);
        command.args(&self.arguments).envs(self.variables.iter().copied()).current_dir(root());
        let fail = |why: String, code: u8| Err(Failure { what: self.what, why, code });
        let ended = match self.unanswered {
            None => command.status(),
            Some((words, meaning)) => match command.stdout(Stdio::inherit()).output() {
                Ok(output) => {
                    let said = String::from_utf8_lossy(&output.stderr);
                    eprint!("{said}");
                    if !output.status.success() && said.contains(words) {
                        return fail(meaning.to_owned(), NOT_CHECKED);
                    }
                    Ok(output.status)
                }
                Err(error) => Err(error),
            },
        };
        match ended {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => {
                fail(status.to_string(), status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(1))
            }
            Err(error) => fail(format!("{}: {error}", self.program.display()), 1),
        }
    }
}

/// Which tests are run.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tests {
    /// Those that are not marked as long.
    Short,
    /// All.
    All,
}

/// Long tests carry `#[ignore]` in Rust and the mark `long` in Python.
fn test(which: Tests) -> Vec<Step> {
    let mut rust = vec!["test", "--release", "--workspace", "--locked"];
    let mut pytest = vec!["-m", "pytest", "--numprocesses=auto", "--dist=loadfile", "python/tests"];
    if which == Tests::All {
        rust.extend(["--", "--include-ignored"]);
        pytest.push("--long");
    }
    let mut steps = vec![cargo(&rust).called("Rust tests")];
    steps.extend(venv());
    steps.push(python("Python build", &["-m", "pip", "install", "--quiet", ".[test]"]));
    steps.push(python("Python tests", &pytest));
    steps
}

/// In release mode, as the tests: what the compiler runs itself (derives, build scripts) is then built once for all chores.
fn check() -> Vec<Step> {
    let mut steps = vec![cargo(&["fmt", "--all", "--check"])];
    steps.extend(venv());
    steps.push(python("ruff, installed", &["-m", "pip", "install", "--quiet", "ruff==0.17.*"]));
    steps.push(python("Python rules", &["-m", "ruff", "check"]));
    steps.push(python("Python format", &["-m", "ruff", "format", "--check"]));
    let clippy =
        ["clippy", "--release", "--workspace", "--all-targets", "--locked", "--", "--deny", "warnings"];
    steps.push(cargo(&clippy));
    steps.push(doc());
    steps
}

fn extremes() -> Vec<Step> {
    let run = ["run", "--release", "--locked", "--package", "fret-validation", "--example"];
    let [stiff, random] =
        ["docs/trust/extremes.md", "docs/trust/random-cases.md"].map(|page| ["--", "--page", page]);
    vec![
        cargo(&[&run[..], &["stiff_cases"], &stiff].concat()).called("stiff cases"),
        cargo(&[&run[..], &["extremes"], &random].concat()).called("random cases"),
    ]
}

fn docs() -> Vec<Step> {
    let mut steps = vec![doc()];
    steps.extend(venv());
    let tools = ["-m", "pip", "install", "--quiet", ".[test]"];
    steps.push(python("documentation tools", &tools));
    // The theme's makers announce the next mkdocs on every build.
    steps.push(
        python("site", &["-m", "mkdocs", "build", "--strict", "--quiet"]).with("NO_MKDOCS_2_WARNING", "1"),
    );
    steps
}

fn doc() -> Step {
    cargo(&["doc", "--release", "--workspace", "--no-deps", "--locked"])
        .with("RUSTDOCFLAGS", "--deny warnings")
}

fn wheel() -> Vec<Step> {
    let mut steps = Vec::from_iter(venv());
    steps.push(python("wheel", &["-m", "pip", "wheel", "--no-deps", "--wheel-dir", "target/wheels", "."]));
    steps
}

/// The program `fret`, started by tests, counts too.
fn coverage() -> Step {
    let words = "tarpaulin --engine llvm --release --locked --follow-exec --skip-clean --timeout 1800 \
                 --target-dir target/coverage --output-dir target/coverage --out Stdout --out Json \
                 --packages fretting --packages fretting-results --packages fretting-drawing --packages fretting-cli \
                 --packages fret-validation";
    cargo(&words.split_whitespace().collect::<Vec<_>>()).called("coverage")
}

/// The database of faults is fetched anew each time: an old one would say yes to a new fault.
fn audit() -> Vec<Step> {
    vec![
        cargo(&["deny", "check", "licenses", "bans", "sources"]).called("licences, doubles, sources"),
        cargo(&["deny", "check", "advisories"]).called("known faults").unanswered_by(
            "failed to fetch advisory database",
            "not checked: the RustSec database could not be fetched; nothing is known about faults",
        ),
    ]
}

/// `cargo` with these words; the step is called after the first.
fn cargo(arguments: &[&'static str]) -> Step {
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    Step::new(arguments.first().copied().unwrap_or("cargo"), program, arguments)
}

/// The making of `target/venv`, where it is missing.
fn venv() -> Option<Step> {
    let system_python = if cfg!(windows) { "py" } else { "python3" };
    let missing = !root().join(venv_python()).exists();
    missing.then(|| Step::new("Python environment", system_python, &["-m", "venv", "target/venv"]))
}

fn python(what: &'static str, arguments: &[&str]) -> Step {
    Step::new(what, root().join(venv_python()), arguments)
}

fn venv_python() -> &'static str {
    if cfg!(windows) { "target/venv/Scripts/python.exe" } else { "target/venv/bin/python" }
}

/// The folder of the workspace.
fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here)
}
