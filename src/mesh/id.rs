//! Ids: newtypes over `u32`, so that a node is never taken for a quad.

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, bytemuck::Pod, bytemuck::Zeroable, serde::Serialize)]
        #[repr(transparent)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The id of the element that stands at `index`.
            ///
            /// # Panics
            /// If `index` does not fit 32 bits: sizes are checked before arrays are made.
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).expect("more than 2^32 elements"))
            }

            /// Where the element stands in its array.
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.0.fmt(f)
            }
        }
    )*};
}
pub(crate) use ids;

ids! {
    /// A mesh point.
    NodeId;
    /// A polygon, quad or triangle of a surface mesh.
    FaceId;
    /// An edge between two nodes.
    EdgeId;
    /// A hexahedron.
    HexId;
}
