//! What the workers of a sweep share: the points, the next of them, the answers, the memory.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Instant;

use fret_core::case::CaseError;
use fret_core::machine::memory::{self, Claim, MemoryError};
use fret_core::plan::{LeaveOut, Plan};
use fret_core::run::{RunError, Simulation};

use super::answer::Answer;
use super::besides::besides;
use super::folder::SweepFolder;
use super::planned::{Planned, asks_for_more};
use super::question::Question;
use super::setting::Setting;
use crate::failure::Failure;
use crate::figures::{counted, duration};
use crate::manner::{Listener, Manner};
use crate::threads::{self, locked};
use fret_results::Origin;

/// Whether a point has no answer because there was not the memory for it.
fn lacks_memory(failure: &Failure) -> bool {
    match failure {
        Failure::Memory(_) | Failure::Unsolved(RunError::OutOfMemory { .. }) => true,
        Failure::Case(error) => error.lacks_memory(),
        _ => false,
    }
}

/// Whether a failure says nothing of the point: somebody stopped, or another machine has the memory or the room.
fn is_no_answer(failure: &Failure) -> bool {
    lacks_memory(failure) || matches!(failure, Failure::Interrupted(_) | Failure::Unwritten(_))
}

/// What the workers share: the points, the next of them, the answers.
pub struct Board<'a> {
    question: &'a Question,
    /// In which units its values are told.
    setting: &'a Setting,
    origin: Option<Origin>,
    /// Points to be solved, of equal ones the first.
    open: Vec<usize>,
    /// Those equal to an open one, which take its answer.
    equal: HashMap<usize, Vec<usize>>,
    next: AtomicUsize,
    answers: Mutex<Vec<Option<Answer>>>,
    ended: Mutex<Option<Failure>>,
    /// Points that have memory and are being solved.
    at_work: Mutex<usize>,
    /// One of them is over.
    freed: Condvar,
    /// The open points, planned.
    planned: Planned,
    /// Points that were found finished.
    pub before: usize,
    /// Those of them that are solved.
    pub solved_before: usize,
    manner: &'a Manner,
    started: Instant,
}

/// A point at work in memory of its own; those that wait for it hear of its end.
struct AtWork<'a>(&'a Board<'a>, Option<Claim>);

impl Drop for AtWork<'_> {
    fn drop(&mut self) {
        self.1 = None;
        *locked(&self.0.at_work) -= 1;
        self.0.freed.notify_all();
    }
}

impl<'a> Board<'a> {
    /// Points of a sweep, some of which are finished already.
    pub fn new(
        (question, setting): (&'a Question, &'a Setting),
        origin: Option<Origin>,
        known: Vec<Option<Answer>>,
        manner: &'a Manner,
    ) -> Self {
        let mut open = Vec::new();
        let mut equal = HashMap::new();
        let mut first_of = HashMap::new();
        for number in (0..known.len()).filter(|&number| known[number].is_none()) {
            let first = *first_of.entry(&question.points[number].case_file.text).or_insert(number);
            if first == number {
                open.push(number);
            } else {
                equal.entry(first).or_insert_with(Vec::new).push(number);
            }
        }
        let planned = Planned::of(&question.points, &open, origin.as_ref());
        Self {
            planned,
            setting,
            question,
            origin,
            before: known.iter().flatten().count(),
            solved_before: known.iter().flatten().filter(|answer| answer.status() == "solved").count(),
            open,
            equal,
            next: AtomicUsize::new(0),
            answers: Mutex::new(known),
            ended: Mutex::new(None),
            at_work: Mutex::new(0),
            freed: Condvar::new(),
            manner,
            started: Instant::now(),
        }
    }

    /// Says how many there are.
    pub fn announce(&self, threads: usize) {
        let found = if self.before > 0 {
            format!(", {} of them finished before", self.before)
        } else {
            String::new()
        };
        let points = counted(self.question.points.len(), "point");
        let equal = match self.equal.values().flatten().count() {
            0 => String::new(),
            count => format!(", {count} equal to another"),
        };
        let common = match self.planned.common.count() {
            0 => String::new(),
            count => format!(", {} solved once", counted(count, "common beginning")),
        };
        self.manner.say(&format!("{points}{found}{equal}{common}, on {}", counted(threads, "thread")));
    }

    /// Solves what is open: a point a thread, all threads for the points when there are fewer.
    pub fn work(&self, folder: &SweepFolder<'_>, threads: usize) -> Option<Failure> {
        let workers = threads.min(self.open.len()).max(1);
        let each = threads / workers;
        if let Err(failure) = threads::check(workers * each) {
            return Some(failure);
        }
        let solve = || {
            if let Err(failure) = self.solve_points(folder, each) {
                self.next.store(self.open.len(), Ordering::Relaxed); // nobody begins another one
                locked(&self.ended).get_or_insert(failure);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..workers {
                // Where the system starts no more of them, those that there are solve all points.
                let _ = std::thread::Builder::new().spawn_scoped(scope, solve);
            }
            solve();
        });
        locked(&self.ended).take()
    }

    fn solve_points(&self, folder: &SweepFolder<'_>, threads: usize) -> Result<(), Failure> {
        let pool = threads::pool(threads)?;
        while let Some(&number) = self.open.get(self.next.fetch_add(1, Ordering::Relaxed)) {
            let point = &self.question.points[number];
            let solve = || -> Result<Answer, Failure> {
                let start = self.origin.as_ref().map(|origin| &origin.start);
                let planned = || point.case_file.planned_leaving_out(LeaveOut::ALL, start);
                let known = self.planned.plan_of(number);
                let plan = known.map_or_else(|| self.with_memory(CaseError::lacks_memory, planned), Ok)?;
                let at_work = self.memory_for(&plan)?;
                let simulation = Simulation::new(&plan).in_claimed_memory();
                let asks = asks_for_more(&plan);
                let mut listener = if asks { Listener::keeping() } else { Listener::silent() };
                let (history, outcome, common) = self.planned.common.solve(number, simulation, &mut listener);
                outcome?;
                let answer = Answer::solved(&history, common);
                drop(at_work);
                if !asks {
                    return Ok(answer);
                }
                // A mistake of the program in what is asked besides costs the point nothing of what was solved.
                let more = || besides(&folder.beside(point), point, &plan, &history);
                let more = AssertUnwindSafe(|| self.with_memory(lacks_memory, more));
                match catch_unwind(more) {
                    Err(_) => {
                        Ok(answer.asked(Err(Failure::Defect(format!("point {number} ended in a panic")))))
                    }
                    Ok(Err(failure)) if lacks_memory(&failure) => Ok(answer.awaiting_memory(failure)),
                    Ok(Err(failure)) if is_no_answer(&failure) => Err(failure),
                    Ok(more) => Ok(answer.asked(more)),
                }
            };
            let answer = match catch_unwind(AssertUnwindSafe(|| pool.install(solve))) {
                Ok(Ok(answer)) => answer,
                Ok(Err(Failure::Interrupted(_))) => {
                    return Err(Failure::Interrupted(
                        "finished points are kept; the same command continues with the others".to_owned(),
                    ));
                }
                // Not an answer of the point: another machine has the memory.
                Ok(Err(failure)) if lacks_memory(&failure) => {
                    self.tell(number, Answer::unsolved(&failure));
                    continue;
                }
                Ok(Err(failure @ Failure::Unwritten(_))) => return Err(failure),
                Ok(Err(failure)) => Answer::unsolved(&failure),
                Err(_) => Answer::unsolved(&Failure::Defect(format!("point {number} ended in a panic"))),
            };
            folder.keep(&self.question.keys, point, &answer)?;
            self.tell(number, answer);
        }
        Ok(())
    }

    /// Asks again while there is no memory for it: that of the points at work is waited for.
    fn with_memory<T, E>(
        &self,
        lacks_memory: impl Fn(&E) -> bool,
        ask: impl Fn() -> Result<T, E>,
    ) -> Result<T, E> {
        let mut is_alone = false;
        loop {
            match ask() {
                Err(error) if lacks_memory(&error) && !is_alone => {
                    let at_work = locked(&self.at_work);
                    is_alone = *at_work == 0;
                    if !is_alone {
                        drop(self.freed.wait(at_work).unwrap_or_else(PoisonError::into_inner));
                    }
                }
                outcome => return outcome,
            }
        }
    }

    /// Memory for a point, beside the points that are at work: waited for while any of them is.
    fn memory_for(&self, plan: &Plan) -> Result<AtWork<'_>, MemoryError> {
        let kept = if asks_for_more(plan) { plan.kept_bytes } else { 0 };
        let mut at_work = locked(&self.at_work);
        loop {
            match memory::claim(plan.memory_bytes.saturating_add(kept)) {
                Ok(claim) => {
                    *at_work += 1;
                    return Ok(AtWork(self, Some(claim)));
                }
                Err(error) if *at_work == 0 => return Err(error),
                Err(_) => at_work = self.freed.wait(at_work).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }

    fn tell(&self, number: usize, answer: Answer) {
        let status = answer.status().to_owned();
        let why = answer.why();
        let mut answers = locked(&self.answers);
        for &other in self.equal.get(&number).into_iter().flatten() {
            answers[other] = Some(answer.clone());
        }
        answers[number] = Some(answer);
        let done = answers.iter().flatten().count();
        let (all, new) = (answers.len(), done - self.before);
        let left = self.started.elapsed().as_secs_f64() * (all - done) as f64 / new as f64;
        let values = self.question.keys.iter().zip(&self.question.points[number].values);
        let place = self.setting.place(values);
        let width = all.to_string().len();
        let time = if done < all { format!("about {} left", duration(left)) } else { String::new() };
        self.manner.say(format!("point {done:>width$}/{all}  {status}  {place}  {time}").trim_end());
        for line in why {
            self.manner.say(&format!("  {line}"));
        }
    }

    /// What the points came to so far.
    pub fn answers(&self) -> Vec<Option<Answer>> {
        locked(&self.answers).clone()
    }
}
