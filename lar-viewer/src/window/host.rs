//! What a window asks of the system that it runs on.

use crate::ViewerError;

/// The system around a window: a desktop or a browser.
pub trait Host {
    /// Puts a text where it can be pasted from. Where that is refused, the text can still be read below the picture.
    fn copy(&mut self, text: &str);

    /// Keeps a file under this name.
    ///
    /// # Errors
    /// `File` with the path when it cannot be written.
    fn save(&mut self, name: &str, bytes: &[u8]) -> Result<(), ViewerError>;

    /// The first number, from 1, for which a name is free; 1 where files of one name are kept apart anyway.
    fn free(&self, _name: &dyn Fn(u32) -> String) -> u32 {
        1
    }
}

#[cfg(not(target_arch = "wasm32"))]
pub(crate) use desktop::Desktop;

#[cfg(not(target_arch = "wasm32"))]
mod desktop {
    use super::Host;
    use crate::ViewerError;
    use std::path::PathBuf;

    /// A clipboard and a directory.
    pub(crate) struct Desktop {
        directory: PathBuf,
        /// Kept open, since X11 hands out what was copied only as long as someone holds it; `None` where there is none.
        clipboard: Option<arboard::Clipboard>,
    }

    impl Desktop {
        /// Saves in the working directory.
        pub(crate) fn new() -> Self {
            Self { directory: PathBuf::new(), clipboard: arboard::Clipboard::new().ok() }
        }

        /// Saves in a directory; copies nothing.
        #[cfg(test)]
        pub(crate) fn saving_in(directory: &std::path::Path) -> Self {
            Self { directory: directory.to_owned(), clipboard: None }
        }
    }

    impl Host for Desktop {
        fn copy(&mut self, text: &str) {
            if let Some(clipboard) = &mut self.clipboard {
                let _ = clipboard.set_text(text);
            }
        }

        fn save(&mut self, name: &str, bytes: &[u8]) -> Result<(), ViewerError> {
            Ok(lar_core::atomic_write(self.directory.join(name), |file| file.write_all(bytes))?)
        }

        fn free(&self, name: &dyn Fn(u32) -> String) -> u32 {
            (1..u32::MAX).find(|&n| !self.directory.join(name(n)).exists()).unwrap_or(0)
        }
    }
}
