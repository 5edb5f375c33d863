//! The inp format.
