//! No process and no temporary folder outlives a run, however the run ends.

use std::collections::BTreeSet;
use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::tools::put_compiler;
use crate::cli::{Place, Ran};

/// A compiler that does not end, as a process with a process of its own.
const HANGS: &str = "echo $$ >> PIDS; sleep 300 & echo $! >> PIDS; wait";

/// Commands that call it: by a worker of `verify`, for a user's text.
const LINES: [&str; 2] = [
    "verify --target glsl --method schlick --material none --limit LIMIT",
    "audit f.hlsl --material gold --gpu none --limit LIMIT",
];

/// A folder with such compilers, a file of a user's, and a place for temporary files.
fn place() -> Place {
    let place = Place::new();
    place.put("f.hlsl", "float f(float c) { return c; }\n");
    place.put("tmp/.keep", "");
    for name in ["glslangValidator", "dxc"] {
        let pids = place.path("pids").display().to_string();
        put_compiler(
            &place,
            &format!("bin/{name}"),
            &HANGS.replace("PIDS", &pids),
        );
    }
    place
}

fn command(place: &Place, line: &str, limit: u64) -> Command {
    let line = line.replace("LIMIT", &limit.to_string());
    let words: Vec<&str> = line.split_whitespace().collect();
    let mut command = place.command(&words);
    let path = format!("{}:/usr/bin:/bin", place.path("bin").display());
    command.env("PATH", path).env("TMPDIR", place.path("tmp"));
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Starts it, and waits until a compiler hangs. What it has started is known by then. No signal is ignored: tests may run below `nohup`.
fn started(place: &Place, line: &str, limit: u64) -> (Child, BTreeSet<u32>) {
    let inner = command(place, line, limit);
    let mut heard = Command::new("env");
    heard.arg("--default-signal").arg(inner.get_program());
    heard.args(inner.get_args()).current_dir(place.path(""));
    heard.stdin(Stdio::null());
    for (name, value) in inner.get_envs() {
        heard.env(name, value.unwrap());
    }
    heard.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = heard.spawn().unwrap();
    until("a compiler is asked", || noted(place).len() >= 2);
    let mut all = noted(place);
    all.extend(below(child.id()));
    (child, all)
}

/// The processes that the compilers have noted.
fn noted(place: &Place) -> BTreeSet<u32> {
    let text = fs::read_to_string(place.path("pids")).unwrap_or_default();
    text.lines().filter_map(|line| line.parse().ok()).collect()
}

/// The children of a process.
fn below(parent: u32) -> Vec<u32> {
    let threads = fs::read_dir(format!("/proc/{parent}/task")).unwrap();
    let lists = threads
        .filter_map(|thread| fs::read_to_string(thread.unwrap().path().join("children")).ok());
    let text: String = lists.collect();
    text.split_whitespace()
        .map(|pid| pid.parse().unwrap())
        .collect()
}

/// Whether a process is at work. One that has ended and that nobody has asked about is not.
fn lives(pid: u32) -> bool {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    let state = stat.rsplit(')').next().unwrap_or_default().trim_start();
    !state.is_empty() && !state.starts_with('Z')
}

#[track_caller]
fn until(what: &str, is_so: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(
            start.elapsed() < Duration::from_secs(60),
            "not within a minute: {what}"
        );
        sleep(Duration::from_millis(20));
    }
}

#[track_caller]
fn all_end(processes: &BTreeSet<u32>, within: Duration) {
    let start = Instant::now();
    let left = || {
        processes
            .iter()
            .copied()
            .filter(|pid| lives(*pid))
            .collect::<Vec<_>>()
    };
    while !left().is_empty() && start.elapsed() < within {
        sleep(Duration::from_millis(20));
    }
    let left = left();
    for pid in &left {
        signal("KILL", *pid);
    }
    assert!(
        left.is_empty(),
        "{} of {} processes are left",
        left.len(),
        processes.len()
    );
}

fn signal(name: &str, pid: u32) {
    let words = [format!("-{name}"), pid.to_string()];
    let _ = Command::new("kill")
        .args(words)
        .stderr(Stdio::null())
        .status();
}

fn temporary(place: &Place) -> Vec<String> {
    let entries = fs::read_dir(place.path("tmp")).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name != ".keep").collect()
}

#[test]
fn a_run_that_is_killed_takes_its_processes_with_it_and_the_next_run_its_folders() {
    for line in LINES {
        let place = place();
        let (mut run, processes) = started(&place, line, 300);
        assert!(processes.len() >= 3, "{processes:?}");
        run.kill().unwrap();
        run.wait().unwrap();
        all_end(&processes, Duration::from_secs(10));
        // The next run leaves nothing, neither of this one nor of itself.
        let next = command(
            &place,
            "time --method schlick --material none --backend vulkan --adapter nothing",
            1,
        )
        .output();
        Ran::new("time".to_owned(), next.unwrap()).ends(3);
        assert_eq!(temporary(&place), [""; 0], "{line}");
    }
}

#[test]
fn a_run_that_is_cancelled_leaves_no_process_and_no_folder() {
    for (at, line) in LINES.into_iter().enumerate() {
        // What a terminal sends that closes, a batch system before its time is over, and a limit on the processor's time.
        let signals = match at {
            0 => vec![
                ("TERM", 15),
                ("INT", 2),
                ("HUP", 1),
                ("QUIT", 3),
                ("USR1", 10),
                ("XCPU", 24),
            ],
            _ => vec![("TERM", 15), ("HUP", 1)],
        };
        for (name, number) in signals {
            let place = place();
            let (mut run, processes) = started(&place, line, 300);
            assert!(!temporary(&place).is_empty());
            signal(name, run.id());
            let status = run.wait().unwrap();
            // It ended by the signal, as whoever sent it expects.
            assert_eq!(
                std::os::unix::process::ExitStatusExt::signal(&status),
                Some(number)
            );
            all_end(&processes, Duration::from_secs(10));
            assert_eq!(temporary(&place), [""; 0], "{line}, {name}");
        }
    }
}

/// A signal that a run was told to ignore does not end it, as `nohup` has it.
#[test]
fn an_ignored_signal_stays_ignored() {
    let place = place();
    let inner = command(&place, LINES[0], 300);
    let words: Vec<_> = inner
        .get_args()
        .map(|word| word.to_str().unwrap())
        .collect();
    let script = format!(
        "trap '' HUP; exec '{}' {}",
        crate::cli::PROGRAM,
        words.join(" ")
    );
    let mut outer = Command::new("sh");
    outer.args(["-c", &script]).current_dir(place.path(""));
    for (name, value) in inner.get_envs() {
        outer.env(name, value.unwrap());
    }
    outer.stdout(Stdio::null()).stderr(Stdio::null());
    let mut run = outer.spawn().unwrap();
    until("a compiler is asked", || noted(&place).len() >= 2);
    let processes = noted(&place);
    signal("HUP", run.id());
    sleep(Duration::from_millis(500));
    assert!(run.try_wait().unwrap().is_none(), "it ended");
    signal("TERM", run.id());
    run.wait().unwrap();
    all_end(&processes, Duration::from_secs(10));
    assert_eq!(temporary(&place), [""; 0]);
}

#[test]
fn workers_of_a_run_that_is_stuck_end_by_themselves() {
    let place = place();
    let (mut run, mut processes) = started(&place, LINES[0], 15);
    processes.remove(&run.id());
    signal("STOP", run.id());
    all_end(&processes, Duration::from_secs(30));
    run.kill().unwrap();
    run.wait().unwrap();
}

#[test]
fn a_limit_binds_compilers_too() {
    for line in LINES {
        let place = place();
        let start = Instant::now();
        let output = command(&place, line, 2).output().unwrap();
        let took = start.elapsed();
        // Of a text that only a compiler has seen nothing is known; a file of ours that comes to no end is a fault.
        let code = if line.starts_with("audit") { 3 } else { 1 };
        let ran = Ran::new(line.to_owned(), output).ends(code);
        assert!(ran.err.contains("did not end within 2 s"), "{ran:?}");
        assert!(took < Duration::from_secs(15), "{line}: {took:?}");
        all_end(&noted(&place), Duration::from_secs(2));
        assert_eq!(temporary(&place), [""; 0], "{line}");
    }
}
