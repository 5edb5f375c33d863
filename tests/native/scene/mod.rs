//! The scene on real models, and the shaders without a GPU.

mod models;
mod shaders;
