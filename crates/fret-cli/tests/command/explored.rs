//! `fret explore`: who is answered, that a slider solves what `fret run` would solve, that the newest question wins, and that it ends.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::thread;

use serde_json::{Value, json};

use crate::bench::{Bench, SPHERE};

/// A page that is served; it ends with the test.
struct Served {
    run: Child,
    host: String,
    token: String,
}

impl Served {
    fn start(bench: &Bench, case: &str) -> Self {
        let mut run = bench
            .file("case.toml", case)
            .command(&["explore", "case.toml", "--threads", "1"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(run.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("open http://").unwrap();
        let (host, rest) = address.split_once('/').unwrap();
        Self { run, host: host.to_owned(), token: rest.trim_end_matches('/').to_owned() }
    }

    /// Status and body of a request whose lines of the head are given.
    fn raw(&self, first: &str, head: &str, body: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        let length = body.len();
        write!(
            stream,
            "{first} HTTP/1.1\r\n{head}Connection: close\r\nContent-Length: {length}\r\n\r\n{body}"
        )
        .unwrap();
        let mut text = String::new();
        stream.read_to_string(&mut text).unwrap();
        let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        // a long answer comes in pieces, each after its length
        let whole = if head.contains("chunked") { pieces(body) } else { body.to_owned() };
        (status, whole)
    }

    fn get(&self, place: &str) -> (u16, String) {
        self.raw(&format!("GET {place}"), &format!("Host: {}\r\n", self.host), "")
    }

    fn post(&self, what: &str, question: &Value) -> Value {
        let (token, host) = (&self.token, &self.host);
        let first = format!("POST /{token}/{what}");
        let (status, answer) = self.raw(&first, &format!("Host: {host}\r\n"), &question.to_string());
        assert_eq!(status, 200, "{answer}");
        serde_json::from_str(&answer).unwrap()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.run.kill();
        let _ = self.run.wait();
    }
}

fn pieces(mut body: &str) -> String {
    let mut whole = String::new();
    while let Some((length, rest)) = body.split_once("\r\n") {
        let length = usize::from_str_radix(length, 16).unwrap();
        whole += &rest[..length];
        body = rest[length..].trim_start_matches("\r\n");
    }
    whole
}

#[test]
fn nobody_is_answered_who_does_not_know_the_address() {
    let bench = Bench::new("explore-token");
    let served = Served::start(&bench, SPHERE);
    assert_eq!(served.token.len(), 32);
    let own = format!("/{}/", served.token);
    let (status, page) = served.get(&own);
    assert_eq!(status, 200);
    assert!(page.contains("a small sphere") && page.contains("type=\"range\""));
    // The page asks its own place alone: no address stands in it, and the browser is told to refuse others.
    assert!(page.contains("default-src 'none'") && page.contains("connect-src 'self'"));
    assert!(!page.replace("http-equiv", "").contains("http"));
    for wrong in [
        "/",
        "",
        "/favicon.ico",
        &format!("/{}/", "0".repeat(32)),
        &own[..own.len() - 1],
        &format!("{own}other"),
    ] {
        let place = if wrong.is_empty() { "*" } else { wrong };
        assert_eq!(served.get(place), (404, String::new()), "{place}");
    }
    // The right address under another name, from another page, or by another method.
    let host = format!("Host: {}\r\n", served.host);
    let post = format!("POST {own}solve");
    assert_eq!(served.raw(&format!("GET {own}"), "Host: elsewhere.example\r\n", "").0, 404);
    assert_eq!(served.raw(&post, &format!("{host}Origin: https://elsewhere.example\r\n"), "{}").0, 404);
    assert_eq!(served.raw(&format!("GET {own}solve"), &host, "").0, 404);
    assert_eq!(served.raw(&post, &host, "no question").0, 400);
    assert_eq!(served.raw(&post, &host, "{}").0, 200);
}

/// The numbers after a slider moved are those of `fret run` on the case that the page writes: the same bits.
#[test]
fn a_moved_slider_solves_the_case_that_the_page_writes() {
    let bench = Bench::new("explore-solve");
    let case = &SPHERE.replace("[friction]\n", "# dry\n[friction]   # measured\n");
    let served = Served::start(&bench, case);
    for values in [json!({}), json!({"friction.coefficient": 0.07, "load.indent.normal_force": 1.7})] {
        let answer = served.post("solve", &json!({ "values": values }));
        assert_eq!(answer["status"], "solved", "{answer}");
        for figure in ["loop", "section", "zones", "pressure"] {
            assert!(answer["figures"][figure].as_str().unwrap().contains("<svg"), "{figure}");
        }
        let written = served.post("case", &json!({ "values": values, "written": "shown" }));
        let text = written["text"].as_str().unwrap();
        assert_eq!(
            bench.file("shown.toml", text).fret(&["run", "shown.toml", "--force", "--quiet"]).code,
            Some(0)
        );
        let history = bench.text("results/shown/history.csv");
        for name in ["dissipated_energy", "max_pressure", "normal_force", "approach"] {
            let column = history.lines().next().unwrap().split(',').position(|head| head == name).unwrap();
            let last: f64 = history.lines().last().unwrap().split(',').nth(column).unwrap().parse().unwrap();
            assert_eq!(answer["raw"][name].as_f64().unwrap(), last, "{name} of {values}");
        }
        // The page has four digits, and is solved no farther; a solution to all digits has them, too.
        let exact = text
            .replace("tolerance = 1e-6", "tolerance = 1e-12")
            .replace("tolerance = 0.000001", "tolerance = 1e-12");
        assert_ne!(exact, text);
        bench.file("exact.toml", &exact).fret(&["run", "exact.toml", "--force", "--quiet"]);
        let exact = bench.text("results/exact/history.csv");
        for name in ["dissipated_energy", "max_pressure", "approach"] {
            let column = exact.lines().next().unwrap().split(',').position(|head| head == name).unwrap();
            let last: f64 = exact.lines().last().unwrap().split(',').nth(column).unwrap().parse().unwrap();
            let found = answer["raw"][name].as_f64().unwrap();
            assert!((found / last - 1.0).abs() < 3e-5, "{name} of {values}: {found} {last}");
        }
    }
    // The other button writes the case that was opened, with its own grid and output, and the moved number.
    let own = served.post("case", &json!({"values": {"friction.coefficient": 0.07}, "written": "own"}));
    // Below the line that says who wrote it stands the text that was opened, with its comments, its order and this number.
    let (_, below) = own["text"].as_str().unwrap().split_once('\n').unwrap();
    assert_eq!(below, case.replace("coefficient = 0.1", "coefficient = 0.07"));
}

/// Hertz: the largest von Mises stress on the axis of a circle of contact is 0.62 p0, 0.48 radii deep (nu = 0.3); the grid of 24 cells
/// leaves some percent, friction some more.
#[test]
fn the_stress_below_is_that_of_hertz() {
    let bench = Bench::new("explore-stress");
    let with_strength =
        SPHERE.replace("poisson = 0.3 }", "poisson = 0.3, fatigue = { yield_strength = 400e6 } }");
    let served = Served::start(&bench, &with_strength);
    let pressed =
        json!({"values": {"friction.coefficient": 0.02, "load.fretting.tangential_force.0": 0.001}});
    let solved = served.post("solve", &pressed);
    let stress = served.post("stress", &pressed);
    let p0 = (6.0 * (210e9_f64 / 0.91).powi(2) / 1e-4).cbrt() / std::f64::consts::PI;
    let most = stress["raw"]["max_von_mises"].as_f64().unwrap();
    assert!((most / (0.62 * p0) - 1.0).abs() < 0.05, "{most:e} of {p0:e}");
    assert!((solved["raw"]["max_pressure"].as_f64().unwrap() / p0 - 1.0).abs() < 0.05);
    let margin = stress["raw"]["yield_margin"].as_f64().unwrap();
    assert!((margin * most / 400e6 - 1.0).abs() < 1e-12, "{margin}");
    assert!(stress["figures"]["stress"].as_str().unwrap().contains("depth"));
}

#[test]
fn what_cannot_be_solved_is_said_and_the_next_question_is_answered() {
    let bench = Bench::new("explore-refused");
    let served = Served::start(&bench, SPHERE);
    let ask = |key: &str, value: f64| served.post("solve", &json!({ "values": { key: value } }));
    let refused = ask("lower.substrate.poisson", 0.7);
    assert_eq!(refused["status"], "refused");
    assert!(refused["message"].as_str().unwrap().contains("poisson"), "{refused}");
    let unknown = ask("title", 1.0);
    assert!(unknown["message"].as_str().unwrap().contains("is no slider"), "{unknown}");
    assert_eq!(ask("lower.substrate.poisson", 0.25)["status"], "solved");
}

/// Of questions that come while one is solved the newest is answered; the others are told that they have given way.
#[test]
fn the_newest_question_is_always_answered() {
    let bench = Bench::new("explore-newest");
    let served = Served::start(&bench, SPHERE);
    let answers: Vec<Value> = thread::scope(|scope| {
        let ask = |number: u32| {
            let coefficient = 0.06 + 0.01 * f64::from(number);
            let served = &served;
            scope.spawn(move || {
                served.post("solve", &json!({"values": {"friction.coefficient": coefficient}}))
            })
        };
        let asked: Vec<_> = (0..6).map(ask).collect();
        asked.into_iter().map(|answer| answer.join().unwrap()).collect()
    });
    assert!(
        answers.iter().all(|answer| ["solved", "superseded"].contains(&answer["status"].as_str().unwrap()))
    );
    assert!(answers.iter().any(|answer| answer["status"] == "solved"), "{answers:?}");
    assert_eq!(served.post("solve", &json!({}))["status"], "solved");
}

#[test]
#[cfg(unix)]
fn it_ends_with_the_command() {
    let bench = Bench::new("explore-end");
    let mut served = Served::start(&bench, SPHERE);
    assert_eq!(served.post("solve", &json!({}))["status"], "solved");
    // Not SIGINT: whoever runs the tests in the background may have it ignored, and then the command does so, too.
    assert!(Command::new("kill").args(["-TERM", &served.run.id().to_string()]).status().unwrap().success());
    assert_eq!(served.run.wait().unwrap().code(), Some(0));
}

#[test]
fn a_case_that_is_wrong_or_rolls_is_refused() {
    let bench = Bench::new("explore-none");
    let case = SPHERE.replace("young = 210e9", "young = -1.0");
    let answer = bench.file("case.toml", &case).fret(&["explore", "case.toml"]);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("young"), "{}", answer.err);
    let rolls =
        SPHERE.replace("tangential_force = [0.05, 0.0]", "roll = [20e-6, 0.0]\ncreepage = [1e-4, 0.0]");
    let rolls = rolls.replace("cycles = 2\n", "");
    let answer = bench.file("rolls.toml", &rolls).fret(&["explore", "rolls.toml"]);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("rolls") && answer.err.contains("fret run"), "{}", answer.err);
}
