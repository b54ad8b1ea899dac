//! This process: the memory it holds, and the address space that its limit leaves.

use sysinfo::{Pid, ProcessRefreshKind, ProcessesToUpdate, System};

/// Address space that a thread takes at the most besides its work [bytes]: the GNU allocator maps as much for it, and uses little of it.
pub const ADDRESSES_OF_A_THREAD: u64 = 64 << 20;

/// What this process holds: `[resident, virtual]` [bytes].
fn held() -> Option<[u64; 2]> {
    let own = Pid::from_u32(std::process::id());
    let mut system = System::new();
    let what = ProcessRefreshKind::nothing().with_memory();
    system.refresh_processes_specifics(ProcessesToUpdate::Some(&[own]), false, what);
    system.process(own).map(|process| [process.memory(), process.virtual_memory()])
}

/// Memory that this process holds [bytes].
pub fn resident() -> u64 {
    held().map_or(0, |[resident, _]| resident)
}

/// Address space that the process's limit leaves [bytes]; `None` without a limit.
#[cfg(unix)]
pub fn addresses_left() -> Option<u64> {
    use rustix::process::{Resource, getrlimit};
    let limit = getrlimit(Resource::As).current?;
    held().map(|[_, taken]| limit.saturating_sub(taken))
}

/// Address space that the process's limit leaves [bytes]; no limit is known here.
#[cfg(not(unix))]
pub fn addresses_left() -> Option<u64> {
    None
}
