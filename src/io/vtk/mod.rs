//! The vtk format.
