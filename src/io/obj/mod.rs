//! The obj format.
