//! Silences the log of the Wayland library. Mesa looks for a Wayland display, and without the variable XDG_RUNTIME_DIR the
//! library says on stderr that there is none. No display is needed here.
#![allow(unsafe_code)]

use std::sync::Once;

/// Silences the Wayland library where the variable is not set. No program that shows a window runs without it.
pub(super) fn hush() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        #[cfg(target_os = "linux")]
        if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
            wayland();
        }
    });
}

/// The type of the Wayland library's log handler: a format as of `printf`, and its values.
#[cfg(target_os = "linux")]
type Log = unsafe extern "C" fn(format: *const std::ffi::c_char, values: *mut std::ffi::c_void);

#[cfg(target_os = "linux")]
fn wayland() {
    unsafe extern "C" fn nobody(_: *const std::ffi::c_char, _: *mut std::ffi::c_void) {}
    // SAFETY: loading the library runs its initialisers, as Mesa does itself in a moment. The symbol has had this
    // signature since Wayland 1.0; a `va_list` is passed as a pointer or by hidden reference, and not looked at. The
    // library is never unloaded, and the function lives as long as the program.
    unsafe {
        let Ok(library) = libloading::Library::new("libwayland-client.so.0") else {
            return;
        };
        if let Ok(set) = library.get::<unsafe extern "C" fn(Log)>(b"wl_log_set_handler_client\0") {
            set(nobody);
        }
        std::mem::forget(library);
    }
}
