//! Colours of everything that is drawn, on light and on dark ground.

/// What stands behind the model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Background {
    /// Near white.
    #[default]
    Light,
    /// Near black.
    Dark,
}

/// Red, green, blue, alpha.
pub type Rgba = [u8; 4];

/// The colours of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Theme {
    /// Ground at the top of the canvas.
    pub ground_top: Rgba,
    /// Ground at the bottom of the canvas.
    pub ground_bottom: Rgba,
    /// Front of a face.
    pub front: Rgba,
    /// Back of a face: another hue, so that a turned face is seen at once.
    pub back: Rgba,
    /// Caps: faces inside a hex mesh that a cut brings to light.
    pub cap: Rgba,
    /// Edges of faces.
    pub edge: Rgba,
    /// Regions.
    pub region: Rgba,
    /// The selected region and its handles.
    pub selected: Rgba,
    /// The plane that cuts a hex mesh, and its handle.
    pub section: Rgba,
    /// Curves at which a solid is convex.
    pub convex: Rgba,
    /// Curves at which it is concave.
    pub concave: Rgba,
    /// Corners of a solid.
    pub corner: Rgba,
    /// What a mesh does not show of a solid.
    pub lost: Rgba,
    /// Inside of handles.
    pub handle: Rgba,
    /// The axes x, y and z.
    pub axes: [Rgba; 3],
}

impl Background {
    /// The colours that go with this background.
    pub fn theme(self) -> Theme {
        match self {
            Self::Light => Theme {
                ground_top: [250, 251, 252, 255],
                ground_bottom: [226, 230, 236, 255],
                front: [222, 227, 233, 255],
                back: [226, 178, 146, 255],
                cap: [160, 200, 238, 255],
                edge: [32, 40, 52, 255],
                region: [196, 112, 0, 255],
                selected: [232, 89, 12, 255],
                section: [36, 83, 201, 255],
                convex: [0, 122, 128, 255],
                concave: [134, 58, 190, 255],
                corner: [10, 78, 92, 255],
                lost: [220, 28, 62, 255],
                handle: [255, 255, 255, 255],
                axes: [[214, 57, 57, 255], [47, 143, 58, 255], [45, 98, 214, 255]],
            },
            Self::Dark => Theme {
                ground_top: [38, 43, 51, 255],
                ground_bottom: [20, 23, 28, 255],
                front: [184, 192, 204, 255],
                back: [184, 134, 104, 255],
                cap: [112, 160, 212, 255],
                edge: [12, 15, 20, 255],
                region: [255, 179, 71, 255],
                selected: [255, 146, 43, 255],
                section: [140, 171, 255, 255],
                convex: [44, 196, 196, 255],
                concave: [196, 132, 250, 255],
                corner: [16, 130, 142, 255],
                lost: [255, 92, 112, 255],
                handle: [255, 255, 255, 255],
                axes: [[255, 107, 107, 255], [105, 219, 124, 255], [116, 162, 255, 255]],
            },
        }
    }
}
