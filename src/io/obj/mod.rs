//! Wavefront OBJ.
//!
//! # What is read
//!
//! | statement | becomes |
//! |---|---|
//! | `v x y z`, with a weight `w`, a colour `r g b`, or both | a node; weight and colour are dropped |
//! | `f`, `fo` with corners `v`, `v/vt`, `v//vn`, `v/vt/vn` | a face of three nodes or more |
//! | `l` with nodes `v`, `v/vt` | a polyline of two nodes or more |
//! | `o`, `g`, `usemtl` | the tags of the faces that follow |
//! | `t crease`, `t corner`, `t interpolateboundary` | OpenSubdiv's sharpness tags; their vertices count from 0 |
//!
//! Vertices count from 1 in the order of the file, or back from the last one if negative. A face may
//! stand before its vertices. Indices of `vt` and `vn` must be whole numbers and are dropped.
//!
//! Lines end in LF, CRLF or CR, `\` before the end of a line continues it, `#` starts a comment, and a
//! byte order mark is skipped. The names of `o` and `usemtl` reach to the end of the line, so they may
//! hold spaces and `#`; names in other encodings than UTF-8 are taken for Latin-1. Numbers are rounded
//! correctly; `D` may stand for `E` in an exponent (Fortran). Hexadecimal numbers, NaN and infinity are
//! refused.
//!
//! Statements of appearance (`vt`, `vn`, `mtllib`, `s`, ...) and unknown statements that start with a
//! word are skipped; free-form curves and surfaces are refused, since dropping them would lose shape.
//!
//! Source: Wavefront Advanced Visualizer manual, appendix B1 ("Object Files"), and OpenSubdiv's
//! `regression/common/shape_utils.cpp` for `t`.

mod cursor;
mod names;
mod read;
mod sharpness;
mod write;

pub use read::read;
pub use write::write;
