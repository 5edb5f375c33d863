//! The mesh formats beside OBJ: what is written reads back, what others wrote is read, and what is
//! wrong is told.

mod vtu;
mod worlds;
