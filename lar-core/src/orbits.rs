//! Orbits of permutations.

use crate::Cells;

/// Why a list is no permutation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PermutationError {
    /// An image is not below the number of elements.
    #[error("element {element} of {n} is mapped to {image}")]
    OutOfRange {
        /// The element.
        element: usize,
        /// Its image.
        image: u32,
        /// The number of elements.
        n: usize,
    },
    /// Two elements have one image.
    #[error("elements {first} and {second} are both mapped to {image}")]
    NotInjective {
        /// The smaller element.
        first: usize,
        /// The larger element.
        second: usize,
        /// Their image.
        image: u32,
    },
}

/// The orbits of the permutation i → `images[i]` of 0..n: each the elements met from p(i) on until i, i its
/// smallest element, in the order of their smallest elements. O(n).
///
/// # Errors
/// When `images` is no permutation of 0..n.
///
/// ```
/// use lar_core::permutation_orbits;
/// let orbits = permutation_orbits(&[2, 1, 3, 0]).unwrap();
/// assert_eq!(orbits.iter().collect::<Vec<_>>(), [&[2, 3, 0][..], &[1]]);
/// ```
#[doc(alias = "permutationOrbits")]
pub fn permutation_orbits(images: &[u32]) -> Result<Cells, PermutationError> {
    check_permutation(images)?;
    let mut seen = vec![false; images.len()];
    let mut orbits = Cells::with_capacity(0, images.len());
    let mut orbit = Vec::new();
    for start in 0..images.len() {
        let mut at = start;
        while !std::mem::replace(&mut seen[at], true) {
            orbit.push(images[at]);
            at = images[at] as usize;
        }
        if !orbit.is_empty() {
            orbits.push(&orbit);
            orbit.clear();
        }
    }
    Ok(orbits)
}

fn check_permutation(images: &[u32]) -> Result<(), PermutationError> {
    let n = images.len();
    let mut source: Vec<Option<usize>> = vec![None; n];
    for (element, &image) in images.iter().enumerate() {
        let Some(known) = source.get_mut(image as usize) else {
            return Err(PermutationError::OutOfRange { element, image, n });
        };
        if let Some(first) = known.replace(element) {
            return Err(PermutationError::NotInjective { first, second: element, image });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Numbered from 1, as in the sources.
    #[track_caller]
    fn check(images: &[u32], expected: &[&[u32]]) {
        let from_zero: Vec<u32> = images.iter().map(|i| i - 1).collect();
        let found = permutation_orbits(&from_zero).unwrap();
        let from_one: Vec<Vec<u32>> = found.iter().map(|o| o.iter().map(|i| i + 1).collect()).collect();
        assert_eq!(from_one, expected);
    }

    #[test]
    fn orbits() {
        check(&[], &[]);
        check(&[2, 3, 4, 5, 6, 7, 8, 1], &[&[2, 3, 4, 5, 6, 7, 8, 1]]);
        check(&[3, 9, 8, 12, 10, 7, 2, 11, 6, 4, 1, 5], &[&[3, 8, 11, 1], &[9, 6, 7, 2], &[12, 5, 10, 4]]);
    }

    #[test]
    fn refusals() {
        let message = |images: &[u32]| permutation_orbits(images).unwrap_err().to_string();
        assert_eq!(message(&[0, 3, 1]), "element 1 of 3 is mapped to 3");
        assert_eq!(message(&[0, 1, 0]), "elements 0 and 2 are both mapped to 0");
    }

    proptest! {
        #[test]
        fn each_element_follows_its_preimage(images in Just((0..40_u32).collect::<Vec<_>>()).prop_shuffle()) {
            let orbits = permutation_orbits(&images).unwrap();
            prop_assert_eq!(orbits.indices().len(), 40);
            for orbit in orbits.iter() {
                prop_assert_eq!(orbit.iter().min(), orbit.last());
                for (i, &element) in orbit.iter().enumerate() {
                    prop_assert_eq!(images[element as usize], orbit[(i + 1) % orbit.len()]);
                }
            }
        }
    }
}
