//! The system's memory, held against a mesh before the work: without it the system would end the program, or stand still.

use std::fs::read_to_string;

use super::failure::Failure;

/// What to do where a refinement would take more than there is.
pub(super) const ADVICE: &str = "raise the edge length, ask for fewer levels or smaller regions";

/// A limit of cells: the caller's, or that of memory where this is lower.
pub(super) struct Limit {
    pub(super) cells: u64,
    /// Bytes that are free, if they make the limit.
    free: Option<u64>,
    bytes_per_cell: u64,
}

impl Limit {
    /// The limit where `asked` cells are allowed, of which each takes so many bytes at the peak of the work. More than
    /// `most` is out of range, whatever memory there is, and stays, to be refused with the other options.
    pub(super) fn new(asked: u64, most: u64, bytes_per_cell: u64) -> Self {
        Self::within(asked, bytes_per_cell, if asked > most { None } else { free_memory() })
    }

    fn within(asked: u64, bytes_per_cell: u64, free: Option<u64>) -> Self {
        let free = free.filter(|free| free / bytes_per_cell < asked);
        Self { cells: free.map_or(asked, |free| free / bytes_per_cell), free, bytes_per_cell }
    }

    /// The refusal of so many `cells`, if it is memory that refuses them; `before` says of which file.
    pub(super) fn exceeded(&self, before: &str, cells: u64, name: &str, advice: &str) -> Option<Failure> {
        let free = self.free?;
        Some(Failure::refused(
            "memory-exceeded",
            format!(
                "{before}: the mesh would have {} {name} or more and take {}, of which {} are free; {advice}, or free memory",
                if cells < 1 << 50 { cells.to_string() } else { format!("{:.1e}", cells as f64) },
                bytes_in_words(cells as f64 * self.bytes_per_cell as f64),
                bytes_in_words(free as f64)
            ),
        ))
    }
}

/// An amount of memory, in the largest unit of which there is one.
fn bytes_in_words(bytes: f64) -> String {
    match bytes {
        1e15.. => format!("{:.1e} GB", bytes / 1e9),
        1e9.. => format!("{:.1} GB", bytes / 1e9),
        1e6.. => format!("{:.1} MB", bytes / 1e6),
        _ => format!("{:.1} kB", bytes / 1e3),
    }
}

/// Bytes that programs can still have, with what can be swapped, where the system tells: Linux's `/proc/meminfo`, within a
/// container the limit of its group (<https://docs.kernel.org/admin-guide/cgroup-v2.html>), and the limit of the process's
/// address space (`ulimit -v`).
fn free_memory() -> Option<u64> {
    let of_system = free_in(&read_to_string("/proc/meminfo").ok()?)?;
    let number =
        |file: &str| read_to_string(format!("/sys/fs/cgroup/memory.{file}")).ok()?.trim().parse().ok();
    let of_group =
        number("max").zip(number("current")).map(|(most, now): (u64, u64)| most.saturating_sub(now));
    let of_process = read_to_string("/proc/self/limits").ok().as_deref().and_then(address_space);
    let of_process = of_process.map(|most| most.saturating_sub(held().unwrap_or(0)));
    Some([of_group, of_process].into_iter().flatten().fold(of_system, u64::min))
}

/// Bytes of this process's address space that are in use.
fn held() -> Option<u64> {
    let size = read_to_string("/proc/self/status").ok()?;
    let line = size.lines().find_map(|line| line.strip_prefix("VmSize:"))?;
    Some(1024 * line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?)
}

/// The limit of a process's address space in bytes, if there is one.
fn address_space(limits: &str) -> Option<u64> {
    let soft =
        limits.lines().find_map(|line| line.strip_prefix("Max address space"))?.split_whitespace().next();
    soft?.parse().ok()
}

fn free_in(meminfo: &str) -> Option<u64> {
    let kibibytes = |name: &str| -> Option<u64> {
        let line = meminfo.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':'))?;
        line.trim().strip_suffix("kB")?.trim().parse().ok()
    };
    Some(1024 * (kibibytes("MemAvailable")? + kibibytes("SwapFree").unwrap_or(0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_system_tells_is_read() {
        let told = "MemTotal:       4026156 kB\nMemFree:  7 kB\nMemAvailable:    2000 kB\nSwapFree:            500 kB\n";
        assert_eq!(free_in(told), Some(2500 * 1024));
        assert_eq!(free_in("MemTotal: 5 kB\n"), None);
        assert_eq!(free_in("MemAvailable: five kB\n"), None);
        let limits = "Limit Soft Hard Units\nMax data size unlimited unlimited bytes\nMax address space 700 unlimited bytes\n";
        assert_eq!(address_space(limits), Some(700));
        assert_eq!(address_space(&limits.replace("700", "unlimited")), None);
    }

    #[test]
    fn memory_limits_what_the_caller_allows() {
        let limit = Limit::within(100, 330, Some(33_000 - 1));
        assert_eq!(limit.cells, 99);
        let message =
            limit.exceeded("a.vtu", 2_000_000, "hexes", ADVICE).expect("memory is short").to_string();
        assert!(
            message.starts_with("error[memory-exceeded]: a.vtu: the mesh would have 2000000 hexes"),
            "{message}"
        );
        assert!(message.contains("take 660.0 MB, of which 33.0 kB are free"), "{message}");
        let huge = limit.exceeded("a.vtu", u64::MAX, "hexes", ADVICE).expect("memory is short").to_string();
        assert!(huge.contains("1.8e19 hexes or more and take 6.1e12 GB"), "{huge}");
        for free in [Some(33_000), None] {
            let limit = Limit::within(100, 330, free);
            assert_eq!(limit.cells, 100);
            assert!(limit.exceeded("a.vtu", 101, "hexes", ADVICE).is_none());
        }
    }
}
