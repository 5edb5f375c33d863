//! Where lines and discs are drawn: among the other things or over them.

use wgpu::CompareFunction;

/// Where something is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Among the other things, faint where something stands before it.
    InScene,
    /// Over everything.
    OnTop,
}

/// One of the times that it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Pass {
    /// Where it is drawn, by its depth and what stands there already.
    pub compare: CompareFunction,
    opacity: f64,
    on_top: f64,
}

/// Opacity where something stands before it.
const HIDDEN_OPACITY: f64 = 0.22;

impl Place {
    /// How to draw there.
    pub fn passes(self) -> &'static [Pass] {
        match self {
            Self::InScene => &[
                Pass { compare: CompareFunction::Greater, opacity: HIDDEN_OPACITY, on_top: 0.0 },
                Pass { compare: CompareFunction::LessEqual, opacity: 1.0, on_top: 0.0 },
            ],
            Self::OnTop => &[Pass { compare: CompareFunction::Always, opacity: 1.0, on_top: 1.0 }],
        }
    }
}

impl Pass {
    /// What the shader is told.
    pub fn constants(self) -> [(&'static str, f64); 2] {
        [("opacity", self.opacity), ("on_top", self.on_top)]
    }
}
