//! Long lists in one-line messages.

use std::fmt::Display;

/// The first three items and how many more there are, separated by semicolons.
pub(crate) fn first_few<T: Display>(items: &[T]) -> String {
    let mut text = items.iter().take(3).map(ToString::to_string).collect::<Vec<_>>().join("; ");
    if items.len() > 3 {
        text.push_str(&format!("; and {} more", items.len() - 3));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::first_few;

    #[test]
    fn lengths() {
        assert_eq!(first_few::<u8>(&[]), "");
        assert_eq!(first_few(&[1, 2, 3]), "1; 2; 3");
        assert_eq!(first_few(&[1, 2, 3, 4, 5]), "1; 2; 3; and 2 more");
    }
}
