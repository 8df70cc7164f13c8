//! Typed ids: what kind of cell an index names is part of its type.

use std::fmt;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $letter:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The id as an index into an array.
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl From<u32> for $name {
            fn from(raw: u32) -> Self {
                Self(raw)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($letter, "{}"), self.0)
            }
        }
    };
}

id!(
    /// A 0-cell: a column of `Points`, a row of ∂1.
    VertexId,
    "v"
);
id!(
    /// A 1-cell: a column of ∂1, a row of ∂2.
    EdgeId,
    "e"
);
id!(
    /// A 2-cell: a column of ∂2, a row of ∂3.
    FaceId,
    "f"
);
id!(
    /// A 3-cell: a column of ∂3. In an arrangement, cell 0 is the exterior.
    CellId,
    "c"
);
