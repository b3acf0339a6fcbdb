//! Denoises pictures with [Open Image Denoise](https://www.openimagedenoise.org), where it
//! is installed.
//!
//! The library is loaded at run time, not linked: it is larger than all of frisure, and pictures with enough samples
//! need none. Versions 1.4 and 2 have the functions that
//! are used here, under two names for one of them.
//!
//! What comes out is a guess: pleasant, not unbiased, and not the same bytes with another version of the
//! library or on another machine.

mod functions;

use std::error::Error;
use std::ffi::{CStr, OsStr, OsString, c_void};
use std::mem::ManuallyDrop;

use libloading::Library;
use thiserror::Error;

use functions::{Functions, Handle};

/// The environment variable that names the library's file.
pub const VARIABLE: &str = "FRISURE_OIDN";

/// What the library is called on the systems that have it.
const NAMES: [&str; 5] = [
    "libOpenImageDenoise.so.2",
    "libOpenImageDenoise.so.1",
    "libOpenImageDenoise.so",
    "libOpenImageDenoise.dylib",
    "OpenImageDenoise.dll",
];

/// Why a picture cannot be denoised.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DenoiseError {
    /// No library, or one that cannot be used.
    #[error("Open Image Denoise cannot be used: {0}")]
    Library(String),
    /// A layer is not of the picture's size.
    #[error("`{layer}` has {found} pixels, the picture has {width} × {height}")]
    Size {
        /// The layer.
        layer: &'static str,
        /// Its pixels.
        found: usize,
        /// Pixels across.
        width: usize,
        /// Pixels down.
        height: usize,
    },
    /// The library reported an error.
    #[error("Open Image Denoise says: {0}")]
    Refused(String),
}

/// A noisy picture, rows from the top, linear light; and what guides the denoiser.
#[derive(Clone, Copy, Debug)]
pub struct Noisy<'a> {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Light, premultiplied.
    pub light: &'a [[f32; 3]],
    /// Reflectance of what is seen first, 0 to 1.
    pub albedo: &'a [[f32; 3]],
    /// Direction that tells one hair from the next: tangents of hair, normals of all else.
    pub direction: &'a [[f32; 3]],
}

/// The library, loaded once and for all: it keeps threads of its own, which do not survive that their code
/// is taken away.
#[derive(Clone, Copy, Debug)]
pub struct Denoiser {
    functions: Functions,
}

impl Denoiser {
    /// Loads the library: from the file that [`VARIABLE`] names, or from where the system keeps its own.
    ///
    /// # Errors
    /// [`DenoiseError::Library`], which says what was tried.
    pub fn find() -> Result<Self, DenoiseError> {
        let named = std::env::var_os(VARIABLE).filter(|name| !name.is_empty());
        let names: Vec<OsString> = match named {
            Some(name) => vec![name],
            None => NAMES.iter().map(OsString::from).collect(),
        };
        let mut tried = Vec::new();
        for name in names {
            match Self::load(&name) {
                Ok(denoiser) => return Ok(denoiser),
                Err(error) => tried.push(attempt(&name, &error)),
            }
        }
        Err(DenoiseError::Library(tried.join("; ")))
    }

    fn load(name: &OsStr) -> Result<Self, libloading::Error> {
        // SAFETY: loading runs the library's initialisers, which is what whoever installed it, or named it
        // in the variable, asked for. There is no other way to use a library that may be absent.
        let library = ManuallyDrop::new(unsafe { Library::new(name) }?);
        Ok(Self { functions: Functions::of(&library)? })
    }

    /// The picture without its noise.
    ///
    /// # Errors
    /// [`DenoiseError`], if a layer is of another size, or the library refuses.
    pub fn denoise(&self, noisy: &Noisy<'_>) -> Result<Vec<[f32; 3]>, DenoiseError> {
        let Noisy { width, height, light, albedo, direction } = *noisy;
        for (layer, pixels) in [("light", light), ("albedo", albedo), ("direction", direction)] {
            if pixels.len() != width * height || pixels.is_empty() {
                return Err(DenoiseError::Size { layer, found: pixels.len(), width, height });
            }
        }
        let mut clean = vec![[0.0_f32; 3]; width * height];
        let session = Session::new(&self.functions)?;
        // Images that are read are handed over as mutable pointers, too: the library takes no others.
        for (name, pixels) in [(c"color", light), (c"albedo", albedo), (c"normal", direction)] {
            session.image(name, pixels.as_ptr().cast_mut().cast(), width, height);
        }
        session.image(c"output", clean.as_mut_ptr().cast(), width, height);
        session.run()?;
        Ok(clean)
    }
}

/// A device with a filter for one picture; both are given back when it ends.
struct Session<'a> {
    functions: &'a Functions,
    device: Handle,
    filter: Handle,
}

impl<'a> Session<'a> {
    fn new(functions: &'a Functions) -> Result<Self, DenoiseError> {
        /// The kind of device that works in the machine's own memory.
        const CPU: i32 = 1;
        // SAFETY: the functions are the library's own, with its own signatures (see `Functions`); each handle
        // is used only if it is not null, and until it is released.
        unsafe {
            let device = (functions.new_device)(CPU);
            if device.is_null() {
                return Err(DenoiseError::Refused("no device".into()));
            }
            (functions.commit_device)(device);
            let filter = (functions.new_filter)(device, c"RT".as_ptr());
            if filter.is_null() {
                let error = device_error(functions, device).unwrap_or_else(|| "no filter".into());
                (functions.release_device)(device);
                return Err(DenoiseError::Refused(error));
            }
            (functions.set_bool)(filter, c"hdr".as_ptr(), true);
            // "The layers have no noise": they have far less than the light after the same paths. Without it the filter blurs
            // what is as fine as a hair.
            (functions.set_bool)(filter, c"cleanAux".as_ptr(), true);
            Ok(Self { functions, device, filter })
        }
    }

    /// Hands over an image of three floats per pixel, packed, which outlives the session.
    fn image(&self, name: &CStr, pixels: *mut c_void, width: usize, height: usize) {
        /// Three floats.
        const FLOAT3: i32 = 3;
        // SAFETY: `denoise` checked that the image has width × height pixels of three floats, and holds on to
        // it until the session is over; the library reads inputs, and writes the output, only in `run`.
        unsafe {
            (self.functions.set_image)(
                self.filter,
                name.as_ptr(),
                pixels,
                FLOAT3,
                width,
                height,
                0,
                0,
                0,
            );
        }
    }

    fn run(&self) -> Result<(), DenoiseError> {
        // SAFETY: filter and device are valid until the session is dropped.
        unsafe {
            (self.functions.commit_filter)(self.filter);
            (self.functions.execute_filter)(self.filter);
        }
        device_error(self.functions, self.device)
            .map_or(Ok(()), |error| Err(DenoiseError::Refused(error)))
    }
}

impl Drop for Session<'_> {
    fn drop(&mut self) {
        // SAFETY: both were made by the library, and are not used again.
        unsafe {
            (self.functions.release_filter)(self.filter);
            (self.functions.release_device)(self.device);
        }
    }
}

/// The system's message about a file.
fn attempt(name: &OsStr, error: &libloading::Error) -> String {
    let name = name.to_string_lossy();
    match error.source() {
        Some(cause) => format!("`{name}`: {cause}"),
        None => format!("`{name}`: {error}"),
    }
}

/// The error of a device since the last call.
fn device_error(functions: &Functions, device: Handle) -> Option<String> {
    let mut message = std::ptr::null();
    // SAFETY: the device is valid; the library leaves the message alone or points it at a C string that
    // lives until the next call.
    unsafe {
        let code = (functions.device_error)(device, &raw mut message);
        (code != 0).then(|| match message.is_null() {
            true => format!("error {code}"),
            false => CStr::from_ptr(message).to_string_lossy().into_owned(),
        })
    }
}
