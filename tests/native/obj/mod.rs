//! The OBJ reader and writer.

mod good;
