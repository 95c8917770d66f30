//! The program: parses the command line, runs it, prints. The only place that touches the terminal.

use std::io::{self, IsTerminal, Write};
use std::panic::resume_unwind;
use std::process::ExitCode;
use std::thread;

use clap::Parser;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue};
use indicatif::{ProgressBar, ProgressStyle};

use fresnel_gen::cli::{Cli, first_help, legible, run, with_names_of_today};
use fresnel_gen::language::methods;
use fresnel_gen::physics::foreign::one_line;
use fresnel_gen::physics::num::{POINT_NOT_COMMA, has_decimal_commas};

#[path = "main/stdout.rs"]
mod stdout;

/// The work has a stack of its own size: that of the first thread is the shell's to choose (`ulimit -s`), and too small on some systems.
const STACK_BYTES: usize = 8 << 20;

fn main() -> ExitCode {
    let thread = thread::Builder::new()
        .name("main".to_owned())
        .stack_size(STACK_BYTES);
    match thread.spawn(work) {
        Ok(working) => working.join().unwrap_or_else(|panic| resume_unwind(panic)),
        // No room for a thread: the first one's stack has to do.
        Err(_) => work(),
    }
}

fn work() -> ExitCode {
    outlive_file_limit();
    open_many_files();
    let (words, renamed) = with_names_of_today(std::env::args_os(), methods::RENAMED);
    let names_nothing = words.len() < 2;
    let cli = match Cli::try_parse_from(words) {
        Ok(cli) => cli,
        Err(error) => return refused(&with_foreign_words(error)),
    };
    renamed.iter().for_each(|remark| say(remark));
    let mut bar: Option<ProgressBar> = None;
    let mut progress = |done, whole, what: &str| show(&mut bar, done, whole, what);
    let help = names_nothing.then(|| first_help(&cli.generate));
    let outcome = match help.flatten() {
        Some(help) => Ok(help),
        None => run(&cli, &mut progress, &say),
    };
    if let Some(bar) = bar {
        bar.finish_and_clear();
    }
    match outcome {
        Ok(output) => {
            output.remarks.iter().for_each(|remark| say(remark));
            let stdout = if output.is_file {
                output.stdout
            } else {
                legible(&String::from_utf8_lossy(&output.stdout)).into_bytes()
            };
            ExitCode::from(printed(&stdout, output.code))
        }
        Err(error) => {
            say(&format!("error: {error}"));
            ExitCode::from(error.exit_code())
        }
    }
}

/// A limit on the size of files (`ulimit -f`) ends a process by a signal that says nothing. Where somebody hears the signal, the write
/// fails instead, as on a full disk.
fn outlive_file_limit() {
    #[cfg(unix)]
    {
        let heard = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(false));
        // Who cannot be heard is ended as before.
        let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, heard);
    }
}

/// The same error with the words of the command line as a message may have them.
fn with_foreign_words(mut error: clap::Error) -> clap::Error {
    let shown = |value: &ContextValue| match value {
        ContextValue::String(word) => ContextValue::String(one_line(word)),
        ContextValue::Strings(words) => {
            ContextValue::Strings(words.iter().map(|word| one_line(word)).collect())
        }
        ContextValue::StyledStrs(words) => {
            ContextValue::StyledStrs(words.iter().map(styled).collect())
        }
        other => other.clone(),
    };
    let shown: Vec<_> = error
        .context()
        .map(|(kind, value)| (kind, shown(value)))
        .collect();
    for (kind, value) in shown {
        error.insert(kind, value);
    }
    with_decimal_commas(error)
}

/// The same error with a word about the comma, where the value that it refuses has one for a decimal point.
fn with_decimal_commas(mut error: clap::Error) -> clap::Error {
    let is_refused = |value: &ContextValue| matches!(value, ContextValue::String(word) if has_decimal_commas(word));
    if error.get(ContextKind::InvalidValue).is_some_and(is_refused) {
        let said = vec![POINT_NOT_COMMA.into()];
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(said));
    }
    error
}

/// A styled word; it keeps its style where nothing in it is obeyed.
fn styled(word: &StyledStr) -> StyledStr {
    let plain = word.to_string();
    match one_line(&plain) {
        shown if shown == plain => word.clone(),
        shown => shown.into(),
    }
}

/// Files that wait to be put in place are held open, each with its lock: some thousands where pictures of all materials are wanted.
/// Many systems let a process open 1024 or 256 unless it asks for more.
fn open_many_files() {
    #[cfg(unix)]
    {
        use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
        /// As many as macOS allows at most.
        const WANTED: u64 = 10_240;
        let limit = getrlimit(Resource::Nofile);
        let most = limit.maximum.map_or(WANTED, |maximum| maximum.min(WANTED));
        if limit.current.is_some_and(|current| current < most) {
            let current = Some(most);
            // Who is refused opens as many as before, and a write that fails says so.
            let _ = setrlimit(Resource::Nofile, Rlimit { current, ..limit });
        }
    }
}

/// What the parser of the command line says. It colours its own words; where a user's hold what a terminal obeys, none is.
fn refused(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    if legible(&text) == text {
        let is_for_stdout = !error.use_stderr();
        let open = if is_for_stdout {
            stdout::check()
        } else {
            Ok(())
        };
        let printed = open.and_then(|()| error.print());
        let printed = printed.and_then(|()| io::stdout().flush());
        if is_failure(&printed) {
            return ExitCode::from(2);
        }
    } else {
        say(text.trim_end());
    }
    ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
}

/// Says something on stderr. Where that is closed or full there is nobody to tell.
fn say(line: &str) {
    let _ = writeln!(io::stderr(), "{}", legible(line));
}

/// Writes to stdout. A reader that has seen enough closes the pipe, and that is no error.
fn printed(bytes: &[u8], code: u8) -> u8 {
    if bytes.is_empty() {
        return code;
    }
    let mut out = io::stdout().lock();
    let open = stdout::check().and_then(|()| out.write_all(bytes));
    if is_failure(&open.and_then(|()| out.flush())) {
        2
    } else {
        code
    }
}

/// Whether stdout could not be written to, which is said then.
fn is_failure(printed: &io::Result<()>) -> bool {
    match printed {
        Err(why) if why.kind() != io::ErrorKind::BrokenPipe => {
            say(&format!("error: cannot write to stdout: {why}"));
            true
        }
        _ => false,
    }
}

/// A progress bar on a terminal, none in a pipe.
fn show(bar: &mut Option<ProgressBar>, done: u64, whole: u64, what: &str) {
    if !io::stderr().is_terminal() {
        return;
    }
    let bar = bar.get_or_insert_with(|| {
        let style = ProgressStyle::with_template("{msg:30} {wide_bar} {percent:>3} %");
        ProgressBar::new(whole).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
    });
    bar.set_message(legible(what));
    bar.set_position(done);
}
