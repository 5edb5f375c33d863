//! The OBJ reader and writer.

mod bad;
mod good;
mod models;
mod mutations;
mod round_trip;
