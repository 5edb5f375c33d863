//! The medit format.
