//! Memory: what the machine and the limits of this process leave, and claims on it.
//!
//! Work that needs much memory claims it before it starts, as a whole. The claim is refused where it is more than is left; where the
//! system itself would not give it, that shows here too: as much is reserved, and given back. What the work then allocates piece by
//! piece, in libraries as well that can only abort where there is none, is there. A claim counts while it lives, so that runs beside
//! each other in one process do not count on the same memory.

use std::fmt;
use std::hint::black_box;
use std::sync::{Mutex, MutexGuard, TryLockError};
use std::time::{Duration, Instant};

use sysinfo::{MemoryRefreshKind, System};

use super::control_group;
use super::process::{ADDRESSES_OF_A_THREAD, addresses_left, resident};
use super::threads::available_threads;

/// Address space is taken in larger pieces than memory: this share more than a claim must be left of it.
const ADDRESSES: f64 = 0.1;

/// What sets the limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// The memory of the machine that is free.
    Machine,
    /// The control group of a container or a batch job.
    ControlGroup,
    /// The address space of the process: `ulimit -v`.
    AddressSpace,
}

/// Memory that can be had.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Available {
    /// How much [bytes].
    pub bytes: u64,
    /// What sets the limit.
    pub limit: Limit,
}

/// Why memory cannot be had.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MemoryError {
    /// More is needed than there is.
    #[error(
        "needs about {} of memory, and {} is available ({}); {}",
        amount(*.needed), amount(.available.bytes), .available.limit, .available.limit.way_out()
    )]
    TooLittle {
        /// What is needed [bytes].
        needed: u64,
        /// What there is.
        available: Available,
    },
    /// The system does not give it.
    #[error("needs about {} of memory, which the system does not give; fewer cells need less", amount(*.0))]
    NotGiven(u64),
}

impl Limit {
    fn way_out(self) -> &'static str {
        match self {
            Self::Machine => "fewer cells need less, or a machine that has more free",
            Self::ControlGroup => "fewer cells need less, or a container or batch job that is given more",
            Self::AddressSpace => "fewer cells need less, or a higher limit: ulimit -v unlimited",
        }
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Machine => "what the machine has free",
            Self::ControlGroup => "the limit of the container or batch job: its control group",
            Self::AddressSpace => "the limit on the address space: ulimit -v",
        })
    }
}

/// An amount of memory as a person reads it: `12.5 MB`, `4.3 GB`.
pub fn amount(bytes: u64) -> String {
    let megabytes = bytes as f64 / 1e6;
    if megabytes < 0.05 {
        format!("{:.0} kB", 1e3 * megabytes)
    } else if megabytes < 1e3 {
        format!("{megabytes:.1} MB")
    } else {
        format!("{:.1} GB", megabytes / 1e3)
    }
}

/// Memory that this process can have now, beside what it holds already.
pub fn available() -> Available {
    let machine = machine_left().map(|bytes| Available { bytes, limit: Limit::Machine });
    let group = control_group::memory_left().map(|bytes| Available { bytes, limit: Limit::ControlGroup });
    let addresses = addresses_left().map(|left| {
        let of_threads = ADDRESSES_OF_A_THREAD * (threads_at_hand() as u64 + 1);
        let bytes = (left.saturating_sub(of_threads) as f64 / (1.0 + ADDRESSES)) as u64;
        Available { bytes, limit: Limit::AddressSpace }
    });
    let unknown = Available { bytes: u64::MAX, limit: Limit::Machine };
    [machine, group, addresses].into_iter().flatten().min_by_key(|limit| limit.bytes).unwrap_or(unknown)
}

/// Threads of the pool that this is asked in; those of the machine outside of one.
fn threads_at_hand() -> usize {
    match rayon::current_thread_index() {
        Some(_) => rayon::current_num_threads(),
        None => available_threads(),
    }
}

/// A claim on memory; given up when it is dropped.
#[derive(Debug)]
#[must_use = "a claim counts while it lives"]
pub struct Claim(u64);

/// All claims of a process.
struct Claims {
    /// Its number: a fork inherits the memory, and none of the work.
    process: u32,
    /// Their sum [bytes].
    sum: u64,
    /// Memory the process held before the first of them [bytes].
    before: u64,
}

static CLAIMS: Mutex<Claims> = Mutex::new(Claims { process: 0, sum: 0, before: 0 });
/// Nobody holds the claims for longer than this; who does was at it when this process was forked, and does so for ever.
const PATIENCE: Duration = Duration::from_secs(1);

/// Claims memory for work that is about to start [bytes].
///
/// # Errors
/// When it is more than can be had, beside what other claims have yet to take.
pub fn claim(bytes: usize) -> Result<Claim, MemoryError> {
    let needed = bytes as u64;
    let mut claims = claims();
    let mut outstanding = 0;
    if let Some(claims) = claims.as_mut() {
        let now = resident();
        if claims.sum == 0 {
            claims.before = now;
        }
        outstanding = claims.sum.saturating_sub(now.saturating_sub(claims.before));
    }
    let mut available = available();
    available.bytes = available.bytes.saturating_sub(outstanding);
    if needed > available.bytes {
        return Err(MemoryError::TooLittle { needed, available });
    }
    reserve(needed + outstanding)?;
    if let Some(claims) = claims.as_mut() {
        claims.sum += needed;
    }
    Ok(Claim(needed))
}

/// Whether a claim would be granted now.
///
/// # Errors
/// As [`claim`].
pub fn check(bytes: usize) -> Result<(), MemoryError> {
    claim(bytes).map(drop)
}

impl Drop for Claim {
    fn drop(&mut self) {
        if let Some(mut claims) = claims() {
            claims.sum = claims.sum.saturating_sub(self.0);
        }
    }
}

/// The claims of this process; nothing where they cannot be had.
fn claims() -> Option<MutexGuard<'static, Claims>> {
    let started = Instant::now();
    let mut claims = loop {
        match CLAIMS.try_lock() {
            Ok(claims) => break claims,
            Err(TryLockError::Poisoned(poisoned)) => break poisoned.into_inner(),
            Err(TryLockError::WouldBlock) if started.elapsed() < PATIENCE => {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err(TryLockError::WouldBlock) => return None,
        }
    };
    if claims.process != std::process::id() {
        *claims = Claims { process: std::process::id(), sum: 0, before: 0 };
    }
    Some(claims)
}

/// Takes so much memory from the system and gives it back untouched.
fn reserve(bytes: u64) -> Result<(), MemoryError> {
    let length = usize::try_from(bytes).map_err(|_| MemoryError::NotGiven(bytes))?;
    let mut block: Vec<u8> = Vec::new();
    let reserved = block.try_reserve_exact(length);
    black_box(block); // or the compiler does without
    reserved.map_err(|_| MemoryError::NotGiven(bytes))
}

/// Memory of the machine that is free or can be taken back [bytes].
fn machine_left() -> Option<u64> {
    let mut system = System::new();
    system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
    Some(system.available_memory()).filter(|bytes| *bytes > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_claim_of_more_than_any_machine_has_is_refused_with_both_amounts() {
        let Err(MemoryError::TooLittle { needed, available }) = claim(1 << 60) else {
            panic!("an exabyte was granted");
        };
        assert_eq!(needed, 1 << 60);
        assert!(available.bytes < 1 << 50, "{available:?}");
        let words = MemoryError::TooLittle { needed, available }.to_string();
        assert!(words.contains(&amount(available.bytes)) && words.contains("fewer cells"), "{words}");
    }

    #[test]
    fn claims_that_live_beside_each_other_count_together() {
        let half = usize::try_from(available().bytes / 5 * 3).unwrap();
        let first = claim(half).unwrap();
        assert!(claim(half).is_err(), "three fifths of what there is, twice");
        drop(first);
        assert!(claim(half).is_ok());
    }

    #[test]
    fn amounts_are_told_in_the_unit_a_person_would_use() {
        assert_eq!(amount(12_540_000), "12.5 MB");
        assert_eq!([0, 49_400, 50_000].map(amount), ["0 kB", "49 kB", "0.1 MB"]);
        assert_eq!(amount(4_322_200_000), "4.3 GB");
    }
}
