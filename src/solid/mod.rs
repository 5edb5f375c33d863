//! The solid to mesh: a closed surface of triangles with its features: corners, curves and surfaces.
