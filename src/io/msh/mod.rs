//! The msh format.
