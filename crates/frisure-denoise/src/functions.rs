//! The functions of Open Image Denoise that are used, as its header `oidn.h` declares them.

use std::ffi::{c_char, c_void};

use libloading::{Error, Library, Symbol};

/// A device or a filter of the library.
pub(crate) type Handle = *mut c_void;

type SetImage = unsafe extern "C" fn(
    filter: Handle,
    name: *const c_char,
    pixels: *mut c_void,
    format: i32,
    width: usize,
    height: usize,
    offset: usize,
    pixel_stride: usize,
    row_stride: usize,
);

type SetBool = unsafe extern "C" fn(filter: Handle, name: *const c_char, value: bool);

/// The functions; valid as long as the library is loaded, which is for ever.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Functions {
    pub(crate) new_device: unsafe extern "C" fn(kind: i32) -> Handle,
    pub(crate) commit_device: unsafe extern "C" fn(device: Handle),
    pub(crate) device_error:
        unsafe extern "C" fn(device: Handle, message: *mut *const c_char) -> i32,
    pub(crate) release_device: unsafe extern "C" fn(device: Handle),
    pub(crate) new_filter: unsafe extern "C" fn(device: Handle, kind: *const c_char) -> Handle,
    pub(crate) set_image: SetImage,
    pub(crate) set_bool: SetBool,
    pub(crate) commit_filter: unsafe extern "C" fn(filter: Handle),
    pub(crate) execute_filter: unsafe extern "C" fn(filter: Handle),
    pub(crate) release_filter: unsafe extern "C" fn(filter: Handle),
}

impl Functions {
    /// Those of a library.
    pub(crate) fn of(library: &Library) -> Result<Self, Error> {
        // SAFETY: the types are those of `oidn.h` in versions 1.4 and 2, of which these symbols are the public
        // interface; `OIDNDeviceType`, `OIDNFormat` and `OIDNError` are C enums of the size of an int.
        unsafe {
            // Version 2 has another name for what is the same.
            let set_bool: Result<Symbol<'_, SetBool>, Error> = library.get(c"oidnSetFilterBool");
            Ok(Self {
                new_device: *library.get(c"oidnNewDevice")?,
                commit_device: *library.get(c"oidnCommitDevice")?,
                device_error: *library.get(c"oidnGetDeviceError")?,
                release_device: *library.get(c"oidnReleaseDevice")?,
                new_filter: *library.get(c"oidnNewFilter")?,
                set_image: *library.get(c"oidnSetSharedFilterImage")?,
                set_bool: match set_bool {
                    Ok(found) => *found,
                    Err(_) => *library.get(c"oidnSetFilter1b")?,
                },
                commit_filter: *library.get(c"oidnCommitFilter")?,
                execute_filter: *library.get(c"oidnExecuteFilter")?,
                release_filter: *library.get(c"oidnReleaseFilter")?,
            })
        }
    }
}
