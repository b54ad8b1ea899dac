//! Who is answered: a browser on this machine that knows the address. A question that waits gives way to a newer one; the one at work is
//! finished, so that something is seen however fast a slider moves.

use std::io::Read;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use serde_json::{Value, json};
use tiny_http::{Header, Method, Request, Response};

use super::answer::{Asked, Solver};
use super::page;
use crate::defect;
use crate::failure::Failure;
use crate::interrupt;
use crate::threads::locked;

/// Bytes of a question, at the most.
const LONGEST: u64 = 64 * 1024;
/// How long is waited for a question before looking whether somebody asks to stop.
const WAIT: Duration = Duration::from_millis(150);
/// What every answer says besides: it is nobody else's, and not to be kept.
const HEADERS: [(&str, &str); 4] = [
    ("Cache-Control", "no-store"),
    ("Referrer-Policy", "no-referrer"),
    ("X-Content-Type-Options", "nosniff"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
];

/// A place on this machine where a case can be played with.
pub struct Server {
    http: tiny_http::Server,
    desk: Arc<Desk>,
}

/// Who may ask, and what they have asked. Each request is heard by a thread of its own, so that one whose body never comes keeps
/// nobody waiting.
struct Desk {
    port: u16,
    token: String,
    inbox: Inbox,
}

/// A question for the solver.
struct Posted {
    request: Request,
    asked: Asked,
    what: What,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum What {
    Solve,
    Stress,
    Case,
}

/// What waits for an answer.
struct Inbox<T = Posted> {
    waiting: Mutex<Waiting<T>>,
    changed: Condvar,
}

/// The newest case to be written, the newest other question, and whether there will be more.
struct Waiting<T> {
    case: Option<T>,
    newest: Option<T>,
    has_ended: bool,
}

impl<T> Default for Inbox<T> {
    fn default() -> Self {
        let waiting = Waiting { case: None, newest: None, has_ended: false };
        Self { waiting: Mutex::new(waiting), changed: Condvar::new() }
    }
}

impl<T> Inbox<T> {
    /// Puts a question in; gives back the one that has to give way. A case that is to be written gives way to another one alone.
    fn put(&self, question: T, is_case: bool) -> Option<T> {
        let mut waiting = locked(&self.waiting);
        let older = if is_case { &mut waiting.case } else { &mut waiting.newest }.replace(question);
        self.changed.notify_one();
        older
    }

    fn end(&self) {
        locked(&self.waiting).has_ended = true;
        self.changed.notify_one();
    }

    /// Waits for the newest question; none at the end.
    fn take(&self) -> Option<T> {
        let mut waiting = locked(&self.waiting);
        loop {
            if waiting.has_ended {
                return None;
            }
            let next = waiting.case.take();
            match next.or_else(|| waiting.newest.take()) {
                Some(question) => return Some(question),
                None => waiting = self.changed.wait(waiting).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }
}

impl Server {
    /// Opens a port of this machine alone; 0: one that is free.
    ///
    /// # Errors
    /// When the port cannot be had, or the system gives no random number.
    pub fn open(port: u16) -> Result<Self, Failure> {
        let refuse = |why: String| Failure::call(format!("port {port}: {why}"), "another one with --port N");
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
        let http = tiny_http::Server::http(address).map_err(|error| refuse(error.to_string()))?;
        let port = http.server_addr().to_ip().map_or(port, |address| address.port());
        let random = || getrandom::u64().map_err(|error| refuse(format!("no random number: {error}")));
        let token = format!("{:016x}{:016x}", random()?, random()?);
        Ok(Self { http, desk: Arc::new(Desk { port, token, inbox: Inbox::default() }) })
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.desk.port, self.desk.token)
    }

    /// Answers until somebody asks to stop.
    ///
    /// # Errors
    /// When the system gives no more connections.
    pub fn serve(&self, mut solver: Solver) -> Result<(), Failure> {
        let page: Arc<str> = page::page(solver.question()).into();
        let desk = &self.desk;
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while let Some(posted) = desk.inbox.take() {
                    let answer = answer(&mut solver, &posted);
                    send(posted.request, 200, "application/json", answer.to_string());
                }
            });
            let mut ending = Ok(());
            while ending.is_ok() && !interrupt::is_asked() {
                match self.http.recv_timeout(WAIT) {
                    Ok(Some(request)) if is_too_long(&request) => std::mem::forget(request),
                    Ok(Some(request)) => {
                        let (desk, page) = (Arc::clone(desk), Arc::clone(&page));
                        std::thread::spawn(move || desk.hear(request, &page));
                    }
                    Ok(None) => {}
                    Err(error) => {
                        let what = format!("the page can be asked no more: {error}");
                        ending = Err(Failure::call(what, "start fret explore again"));
                    }
                }
            }
            desk.inbox.end();
            ending
        })
    }
}

/// Whether the body of a request is longer than any question. It is not even thrown away, for which it would be read.
fn is_too_long(request: &Request) -> bool {
    request.body_length().is_some_and(|length| length as u64 > LONGEST)
}

impl Desk {
    /// Answers a request that needs no solution, refuses what it does not know, and passes on the rest.
    fn hear(&self, mut request: Request, page: &str) {
        let header = |name: &'static str| {
            let found = request.headers().iter().find(|header| header.field.equiv(name));
            found.map(|header| header.value.as_str().to_owned())
        };
        // Another name of this machine is one that somebody else gave it, and another page may ask nothing.
        let own = format!("127.0.0.1:{}", self.port);
        let is_own = header("Host").is_some_and(|host| host == own);
        let is_same = header("Origin").is_none_or(|origin| origin == format!("http://{own}"));
        let place = request.url().strip_prefix('/').and_then(|rest| rest.split_once('/'));
        let Some((_, place)) = place.filter(|(token, _)| is_own && is_same && same(token, &self.token))
        else {
            return send(request, 404, "text/plain", String::new());
        };
        let what = match (request.method(), place) {
            (Method::Get, "") => return send(request, 200, "text/html; charset=utf-8", page.to_owned()),
            (Method::Post, "solve") => What::Solve,
            (Method::Post, "stress") => What::Stress,
            (Method::Post, "case") => What::Case,
            _ => return send(request, 404, "text/plain", String::new()),
        };
        let mut text = Vec::new();
        let read = request.as_reader().take(LONGEST).read_to_end(&mut text);
        let asked = read.ok().and_then(|_| serde_json::from_slice::<Asked>(&text).ok());
        let Some(asked) = asked else {
            return send(request, 400, "text/plain", "expected {\"values\": {KEY: NUMBER}}".to_owned());
        };
        if let Some(older) = self.inbox.put(Posted { request, asked, what }, what == What::Case) {
            let answer = json!({ "status": "superseded" });
            send(older.request, 200, "application/json", answer.to_string());
        }
    }
}

/// Whether two tokens are the same, in a time that does not tell where they differ.
fn same(one: &str, other: &str) -> bool {
    let differ = one.bytes().zip(other.bytes()).fold(0, |differ, (one, other)| differ | (one ^ other));
    one.len() == other.len() && differ == 0
}

fn answer(solver: &mut Solver, posted: &Posted) -> Value {
    let asked = &posted.asked;
    let ask = || match posted.what {
        What::Solve => solver.answer(asked),
        What::Stress => solver.stress(asked),
        What::Case => solver.text(asked).map(|text| json!({ "status": "written", "text": text })),
    };
    // A mistake in the program is the answer to one question, not the end of the page.
    defect::caught(ask).unwrap_or_else(|failure: Failure| {
        let record = failure.record();
        let mistakes = record.mistakes.unwrap_or_default();
        let why: Vec<String> = mistakes.into_iter().map(|mistake| mistake.message).collect();
        let message = if why.is_empty() { record.message } else { why.join("; ") };
        json!({ "status": record.status, "message": message })
    })
}

fn send(request: Request, status: u16, kind: &str, text: String) {
    let mut response = Response::from_string(text).with_status_code(status);
    for (name, value) in HEADERS.into_iter().chain([("Content-Type", kind)]) {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    // A browser that has gone away is told nothing.
    let _ = request.respond(response);
}

#[cfg(test)]
mod tests {
    use super::Inbox;

    #[test]
    fn the_newest_question_is_taken_and_a_case_gives_way_to_a_case_alone() {
        let inbox = Inbox::default();
        assert_eq!(inbox.put(1, false), None);
        assert_eq!(inbox.put(2, false), Some(1));
        assert_eq!(inbox.put(10, true), None);
        assert_eq!(inbox.put(11, true), Some(10));
        assert_eq!(inbox.put(3, false), Some(2));
        assert_eq!([inbox.take(), inbox.take()], [Some(11), Some(3)]);
        inbox.put(4, false);
        inbox.end();
        assert_eq!(inbox.take(), None);
    }
}
