//! The glb format.
