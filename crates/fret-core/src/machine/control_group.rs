//! Memory limits that Linux sets on groups of processes: containers, and the jobs of batch systems.
//!
//! `sysinfo` looks at the root of the tree alone, which is right inside a container and blind inside the job of a batch system: so the
//! groups of this process are walked up here. Formats: `cgroups(7)`, versions 1 and 2.

use std::fs;
use std::path::Path;

/// Memory left in the tightest of the groups this process is in [bytes]; `None` where none sets a limit.
pub fn memory_left() -> Option<u64> {
    let groups = fs::read_to_string("/proc/self/cgroup").ok()?;
    left_in(&groups, Path::new("/sys/fs/cgroup"))
}

/// The same by the text of `/proc/self/cgroup`, with the tree of groups at `root`.
fn left_in(groups: &str, root: &Path) -> Option<u64> {
    let tightest = groups.lines().filter_map(|line| {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, group) = (parts.next()?, Path::new(parts.next()?));
        let (tree, limit, unreclaimable) = if controllers.is_empty() {
            (root.to_owned(), "memory.max", "anon")
        } else if controllers.split(',').any(|name| name == "memory") {
            (root.join("memory"), "memory.limit_in_bytes", "total_rss")
        } else {
            return None;
        };
        // Inside a container the group's name may be that of the host, and the root of the tree the group itself.
        let ancestors = group.ancestors().filter_map(|group| group.strip_prefix("/").ok());
        ancestors.filter_map(|group| left_at(&tree.join(group), limit, unreclaimable)).min()
    });
    tightest.min()
}

/// What a group's limit leaves beside the memory that cannot be taken back: cached files can.
fn left_at(group: &Path, limit: &str, unreclaimable: &str) -> Option<u64> {
    let limit: u64 = fs::read_to_string(group.join(limit)).ok()?.trim().parse().ok()?; // "max": no limit
    let statistics = fs::read_to_string(group.join("memory.stat")).ok()?;
    let used = statistics.lines().find_map(|line| {
        let (name, bytes) = line.split_once(' ')?;
        (name == unreclaimable).then(|| bytes.parse::<u64>().ok()).flatten()
    });
    Some(limit.saturating_sub(used.unwrap_or(0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tree of groups as files, below the temporary folder.
    struct Tree(std::path::PathBuf);

    impl Tree {
        fn new(name: &str, files: &[(&str, &str)]) -> Self {
            let root = std::env::temp_dir().join(format!("fretting-groups-{name}-{}", std::process::id()));
            for (file, text) in files {
                let path = root.join(file);
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                fs::write(path, text).unwrap();
            }
            Self(root)
        }
    }

    impl Drop for Tree {
        fn drop(&mut self) {
            fs::remove_dir_all(&self.0).unwrap();
        }
    }

    #[test]
    fn the_tightest_group_above_the_process_counts_less_what_cannot_be_taken_back() {
        let tree = Tree::new(
            "second",
            &[
                ("memory.max", "max\n"),
                ("memory.stat", "anon 900\nfile 5000\n"),
                ("job/memory.max", "2000\n"),
                ("job/memory.stat", "anon 300\nfile 1500\n"),
                ("job/step/memory.max", "max\n"),
                ("job/step/memory.stat", "anon 200\nfile 1500\n"),
            ],
        );
        assert_eq!(left_in("0::/job/step\n", &tree.0), Some(1700));
        assert_eq!(left_in("0::/\n", &tree.0), None, "the root has no limit");
    }

    #[test]
    fn groups_of_the_first_version_are_read_in_their_own_tree() {
        let tree = Tree::new(
            "first",
            &[
                ("memory/memory.limit_in_bytes", "4096\n"),
                ("memory/memory.stat", "cache 4000\ntotal_rss 96\n"),
            ],
        );
        let groups = "5:cpuset:/docker/a\n4:cpu,memory:/docker/a\n0::/\n";
        assert_eq!(
            left_in(groups, &tree.0),
            Some(4000),
            "the name is the host's, the root is the container's"
        );
        assert_eq!(left_in("5:cpuset:/docker/a\n", &tree.0), None);
    }
}
