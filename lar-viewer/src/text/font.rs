//! The vector font: each printable ASCII character as a 1-complex on a small integer grid.
//!
//! The grid has its baseline at y = 2, lower-case letters reach up to 6, capitals and digits to 8, descenders down to 0,
//! brackets from 1 to 9. A glyph is written as polylines, one after the other with a blank between, each a list of grid
//! points of two digits, x and y; a point twice is a dot. Curves are cut corners: at the size of labels, ten pixels or so,
//! rounder ones look the same.

/// Height of the baseline.
pub(super) const BASELINE: i16 = 2;
/// Height of capitals over the baseline; a text's size is this height.
pub(super) const CAP_HEIGHT: i16 = 6;
/// Free columns after each glyph.
pub(super) const GAP: i16 = 2;
/// First character of the table.
const FIRST: u32 = 32;

/// The characters from the blank to the tilde.
const GLYPHS: [&str; 95] = [
    "",
    "0804 0202",
    "0806 2826",
    "1218 3238 0444 0646",
    "473818070615354443321203 2921",
    "0248 0818170708 3343423233",
    "4216172837360403122244",
    "0806",
    "29070321",
    "09272301",
    "2327 0446 0644",
    "2327 0545",
    "1201",
    "0535",
    "0202",
    "0248",
    "120307183847433212",
    "062822 0242",
    "07183847460242",
    "07183847463515 354443321203",
    "32380444",
    "480805354443321203",
    "4738180703123243443505",
    "084812",
    "15060718384746351504031232434435",
    "4515060718384743321203",
    "0202 0505",
    "1201 1515",
    "380532",
    "0444 0646",
    "083502",
    "07183847462524 2222",
    "5342120307185867644446262444",
    "022842 1535",
    "02083847463505 3544433202",
    "4738180703123243",
    "02083847433202",
    "42020848 0535",
    "020848 0535",
    "47381807031232434525",
    "0208 4248 0545",
    "0222 0828 1218",
    "0312324348",
    "0208 4804 1542",
    "080242",
    "0208244842",
    "02084248",
    "120307183847433212",
    "02083847463505",
    "120307183847433212 2442",
    "02083847463505 2542",
    "473818070615354443321203",
    "0848 2822",
    "080312324348",
    "082248",
    "0812263248",
    "0842 0248",
    "082548 2522",
    "08480242",
    "29090121",
    "0842",
    "09292101",
    "062846",
    "0141",
    "0817",
    "4642 4536160503123243",
    "0802 0516364543321203",
    "4536160503123243",
    "4842 4536160503123243",
    "04444536160503123243",
    "38281712 0636",
    "4641301001 4536160503123243",
    "0802 0516364542",
    "0602 0808",
    "26211000 2828",
    "0802 3603 1432",
    "080312",
    "0602 0516263532 3546566562",
    "0602 0516364542",
    "120305163645433212",
    "0600 0516364543321203",
    "4640 4536160503123243",
    "0602 05162635",
    "45361605143443321203",
    "18132232 0636",
    "0603123243 4642",
    "062246",
    "0612253246",
    "0642 0246",
    "0622 461000",
    "06460242",
    "29181605141221",
    "0901",
    "09181625141201",
    "04163446",
];

/// What stands for a character that the font does not have: a box.
const UNKNOWN: &str = "0208484202 0248";
/// Width of a blank.
const BLANK: i16 = 3;

/// One character: vertices on the grid, edges between them, and the columns it takes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Glyph {
    pub(super) width: i16,
    pub(super) strokes: Vec<[[i16; 2]; 2]>,
}

/// The glyph of a character, with the baseline at y = 0.
pub(super) fn glyph(character: char) -> Glyph {
    let index = (character as u32).checked_sub(FIRST).map(|i| i as usize);
    let source = index.and_then(|i| GLYPHS.get(i)).copied().unwrap_or(UNKNOWN);
    let lines: Vec<Vec<[i16; 2]>> = source.split_ascii_whitespace().map(polyline).collect();
    let width = lines.iter().flatten().map(|p| p[0]).max().unwrap_or(BLANK);
    let strokes = lines.iter().flat_map(|line| line.windows(2).map(|w| [w[0], w[1]])).collect();
    Glyph { width, strokes }
}

fn polyline(digits: &str) -> Vec<[i16; 2]> {
    let pairs = digits.as_bytes().chunks_exact(2);
    pairs.map(|pair| [i16::from(pair[0] - b'0'), i16::from(pair[1] - b'0') - BASELINE]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_is_drawn_within_the_grid_and_differs_from_all_others() {
        for (i, source) in GLYPHS.iter().chain([&UNKNOWN]).enumerate() {
            let lines: Vec<&str> = source.split(' ').filter(|l| !l.is_empty()).collect();
            for line in lines {
                assert!(line.bytes().all(|b| b.is_ascii_digit()), "{i}: {line}");
                assert!(4 <= line.len() && line.len() % 2 == 0, "glyph {i}: {line} is no polyline");
                let points: Vec<_> = polyline(line);
                assert!(points.iter().all(|p| (0..=6).contains(&p[0]) && (-2..=7).contains(&p[1])), "{i}");
                assert!(points.windows(2).all(|w| w[0] != w[1]) || points.len() == 2, "{i}: {line}");
            }
        }
        let all: Vec<Glyph> = (' '..='~').map(glyph).collect();
        assert_eq!(all.len(), GLYPHS.len());
        for (i, a) in all.iter().enumerate() {
            // The letter O and the digit 0 are the same ring.
            let same = all[..i].iter().position(|b| a == b);
            assert!(same.is_none() || same == Some(usize::from(b'0' - b' ')), "{i} looks like {same:?}");
        }
        assert_eq!(glyph('é'), glyph('\u{7f}'), "a box for what is not there");
    }

    #[test]
    fn capitals_stand_on_the_baseline_and_reach_the_cap_height() {
        for character in ('A'..='Z').chain('0'..='9') {
            let heights = glyph(character).strokes.into_iter().flatten().map(|p| p[1]);
            assert_eq!(heights.clone().min(), Some(0), "{character}");
            assert_eq!(heights.max(), Some(CAP_HEIGHT), "{character}");
        }
        for character in "gjpqy".chars() {
            assert!(glyph(character).strokes.iter().flatten().any(|p| p[1] < 0), "{character}");
        }
    }
}
