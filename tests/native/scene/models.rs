//! Draw buffers and picking on real models.

use glam::DVec2;
use hexmill::{
    io,
    scene::{Axis, Bvh, Scene, Surface, Viewport},
};
