//! STL: triangles with the coordinates of each corner, as text or in binary.
//!
//! A binary file is 80 bytes of anything, the number of facets, and 50 bytes a facet; exporters do begin the
//! 80 bytes with the word `solid`, which is how a text begins. So the form is told by whether the length fits
//! the number announced. Equal corners are welded; facets that lose a corner thereby are left out and counted.
//!
//! Reference: M. Burns, "Automated Fabrication", 1993, section 6.5, "The StL Format".

mod read;
mod write;

pub(crate) use read::{announced, binary_len, form, read_binary, read_text};
pub(crate) use write::{write_binary, write_text};

const HEADER: usize = 80;
const FACET: usize = 50;
