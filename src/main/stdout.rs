//! Whether stdout was open when the program was started. Rust's runtime opens `/dev/null` in its place where it was not, and whatever is
//! written is lost without a word. So this is looked at before the runtime starts.

use std::io;

/// # Errors
/// Nothing takes what is written to stdout.
pub fn check() -> io::Result<()> {
    if at_start::was_closed() {
        Err(io::Error::other("it is closed"))
    } else {
        Ok(())
    }
}

#[cfg(any(target_os = "linux", target_os = "macos"))]
mod at_start {
    // A section that names a function to run before `main`: there is no other way to be there early enough.
    #![allow(unsafe_code)]

    use std::os::fd::BorrowedFd;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

    static WAS_CLOSED: AtomicBool = AtomicBool::new(false);

    #[used]
    #[cfg_attr(target_os = "linux", unsafe(link_section = ".init_array"))]
    #[cfg_attr(target_os = "macos", unsafe(link_section = "__DATA,__mod_init_func"))]
    static LOOK: extern "C" fn() = look;

    /// Asks the system alone: nothing of the runtime is there yet.
    extern "C" fn look() {
        // SAFETY: the number is only asked about, and closed nowhere.
        let stdout = unsafe { BorrowedFd::borrow_raw(1) };
        let is_closed = rustix::io::fcntl_getfd(stdout).is_err();
        WAS_CLOSED.store(is_closed, Relaxed);
    }

    pub fn was_closed() -> bool {
        WAS_CLOSED.load(Relaxed)
    }
}

#[cfg(not(any(target_os = "linux", target_os = "macos")))]
mod at_start {
    pub fn was_closed() -> bool {
        false
    }
}
