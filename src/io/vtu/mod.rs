//! The vtu format.
