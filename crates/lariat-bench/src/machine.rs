//! The machine that results were measured on, in one line.

use std::process::Command;

fn first_line(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output();
    let text = output.map(|o| String::from_utf8_lossy(&o.stdout).into_owned()).unwrap_or_default();
    text.lines().next().unwrap_or("unknown").to_string()
}

/// Returns processor, compiler, commit and load in one line.
pub fn line() -> String {
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let line = cpuinfo.lines().find(|line| line.starts_with(name)).unwrap_or_default();
        line.split_once(':').map_or("unknown", |(_, value)| value.trim()).to_string()
    };
    let flags = field("flags");
    let simd = ["avx512f", "avx2", "sse4_2", "sse2"].into_iter().find(|f| flags.split(' ').any(|x| x == *f));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load = load.split(' ').next().unwrap_or("unknown").to_string();
    let commit = first_line("git", &["rev-parse", "--short", "HEAD"]);
    format!(
        "Machine: {} ({} MHz), {cores} cores, {}; {}; commit {commit}; load {load} at the start.",
        field("model name"),
        field("cpu MHz"),
        simd.unwrap_or("SIMD unknown"),
        first_line("rustc", &["--version"]),
    )
}
