//! Sizes of pictures on the command line.

use std::str::FromStr;

/// Pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl FromStr for Size {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parsed =
            text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        match parsed {
            Some([width, height]) if 0 < width && 0 < height => Ok(Self { width, height }),
            _ => Err("a size is WIDTHxHEIGHT in pixels, both at least 1"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_size(text: &str, expected: Option<[u32; 2]>) {
        assert_eq!(text.parse::<Size>().ok().map(|s| [s.width, s.height]), expected, "{text}");
    }

    #[test]
    fn sizes() {
        check_size("320x200", Some([320, 200]));
        check_size("1X1", Some([1, 1]));
        for text in ["", "x", "0x5", "5x0", "5", "-1x5", "1x2x3", "1.5x2", "99999999999x1"] {
            check_size(text, None);
        }
    }
}
