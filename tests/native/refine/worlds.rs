//! Named small surfaces.

use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh};

/// A surface from coordinates and faces.
pub fn surface(positions: &[[f64; 3]], faces: &[&[u32]]) -> PolygonMesh {
    let mut mesh =
        PolygonMesh { positions: positions.iter().map(|&p| Point::from(p)).collect(), ..Default::default() };
    for face in faces {
        mesh.push_face(face.iter().map(|&n| NodeId(n)));
    }
    mesh
}

/// `nx` by `ny` unit squares in the plane z = 0.
pub fn grid(nx: u32, ny: u32) -> PolygonMesh {
    mapped_grid(nx, ny, |x, y| Point::new(x, y, 0.0))
}

/// `nx` by `ny` quads whose nodes are the images of (0..=nx, 0..=ny).
pub fn mapped_grid(nx: u32, ny: u32, at: impl Fn(f64, f64) -> Point) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for y in 0..=ny {
        mesh.positions.extend((0..=nx).map(|x| at(f64::from(x), f64::from(y))));
    }
    for y in 0..ny {
        for x in 0..nx {
            let node = |dx, dy| NodeId((y + dy) * (nx + 1) + x + dx);
            mesh.push_face([node(0, 0), node(1, 0), node(1, 1), node(0, 1)]);
        }
    }
    mesh
}

/// The six faces of a cube, outward.
pub fn cube() -> PolygonMesh {
    let positions: Vec<[f64; 3]> =
        (0..8).map(|c| [f64::from(c & 1), f64::from(c >> 1 & 1), f64::from(c >> 2)]).collect();
    let faces: [&[u32]; 6] =
        [&[0, 2, 3, 1], &[4, 5, 7, 6], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 4, 6, 2], &[1, 3, 7, 5]];
    surface(&positions, &faces)
}

/// Three unit squares that share the edge from node 0 to node 1: a non-manifold surface.
pub fn three_sheets() -> PolygonMesh {
    let positions = [
        [0., 0., 0.],
        [1., 0., 0.],
        [1., 1., 0.],
        [0., 1., 0.],
        [1., -1., 0.],
        [0., -1., 0.],
        [1., 0., 1.],
        [0., 0., 1.],
    ];
    surface(&positions, &[&[0, 1, 2, 3], &[1, 0, 5, 4], &[0, 1, 6, 7]])
}

/// A square with a square hole: eight unit squares around a missing ninth.
pub fn ring() -> PolygonMesh {
    let full = grid(3, 3);
    let mut mesh = PolygonMesh { positions: full.positions.clone(), ..Default::default() };
    for (f, face) in full.faces().enumerate() {
        if f != 4 {
            mesh.push_face(face.iter().copied());
        }
    }
    mesh
}

/// A triangle, a quad and a pentagon in a strip.
pub fn mixed_strip() -> PolygonMesh {
    let positions = [
        [0., 0., 0.],
        [1., 0., 0.],
        [1., 1., 0.],
        [2., 0., 0.],
        [2., 1., 0.],
        [3., 0., 0.],
        [3.5, 0.5, 0.],
        [3., 1., 0.],
    ];
    surface(&positions, &[&[0, 1, 2], &[1, 3, 4, 2], &[3, 5, 6, 7, 4]])
}
