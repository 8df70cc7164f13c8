//! Text on its way to a file: words and numbers gathered in a buffer that is passed on in large blocks.

use std::io::{self, Write};

/// Bytes that are gathered before they are passed on.
const BLOCK: usize = 1 << 16;

pub(crate) struct TextWriter<'a> {
    out: &'a mut dyn Write,
    buffer: Vec<u8>,
}

impl<'a> TextWriter<'a> {
    pub(crate) fn new(out: &'a mut dyn Write) -> Self {
        Self { out, buffer: Vec::with_capacity(BLOCK + 1024) }
    }

    pub(crate) fn push(&mut self, text: &str) {
        self.buffer.extend_from_slice(text.as_bytes());
    }

    pub(crate) fn number(&mut self, x: f64) {
        push_number(&mut self.buffer, x);
    }

    pub(crate) fn integer(&mut self, n: u64) {
        self.push(itoa::Buffer::new().format(n));
    }

    /// Ends a line.
    pub(crate) fn end_line(&mut self) -> io::Result<()> {
        self.buffer.push(b'\n');
        if self.buffer.len() < BLOCK { Ok(()) } else { self.pass_on() }
    }

    /// Passes on what has been gathered.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        self.pass_on()
    }

    fn pass_on(&mut self) -> io::Result<()> {
        self.out.write_all(&self.buffer)?;
        self.buffer.clear();
        Ok(())
    }
}

/// The shortest decimal that reads back as the finite number `x`; small and large numbers take the exponent form.
pub(crate) fn push_number(text: &mut Vec<u8>, x: f64) {
    let mut buffer = zmij::Buffer::new();
    let shortest = buffer.format_finite(x);
    let number = shortest.strip_suffix(".0").unwrap_or(shortest).as_bytes();
    // A positive exponent, which no number below 10^15 has, is written without its sign.
    let signed = if x.abs() < 1e15 { None } else { number.iter().position(|&byte| byte == b'+') };
    match signed {
        None => text.extend_from_slice(number),
        Some(sign) => {
            text.extend_from_slice(&number[..sign]);
            text.extend_from_slice(&number[sign + 1..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn written(x: f64) -> String {
        let mut text = Vec::new();
        push_number(&mut text, x);
        String::from_utf8(text).unwrap()
    }

    /// As the standard library writes numbers.
    fn expected(x: f64) -> String {
        if x == 0. || (1e-5..1e16).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
    }

    #[test]
    fn forms() {
        for x in
            [0., -0., 1., -12., 0.1, 1e-5, 9.999e-6, 1e15, 1e16, 123_456_789e12, 1e300, -2.5e-300, f64::MAX]
        {
            assert_eq!(written(x), expected(x));
        }
    }

    proptest! {
        #[test]
        fn shortest_decimals(bits: u64, digits in -10_000_000i64..10_000_000, scale in 0..9) {
            let x = f64::from_bits(bits);
            prop_assume!(x.is_finite());
            prop_assert_eq!(written(x), expected(x));
            let x = digits as f64 / 10_f64.powi(scale);
            prop_assert_eq!(written(x), expected(x));
        }
    }
}
