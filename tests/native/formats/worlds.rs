//! Small meshes that the tests write and read.

use hexmill::geometry::Point;
use hexmill::io::{AnyMesh, Document};
use hexmill::mesh::{FaceId, Features, Group, HexMesh, NodeId, PolygonMesh, QuadMesh, TagSet, Tags};

/// A grid of `n` x `n` quads over the unit square, bent out of its plane.
pub fn quad_grid(n: u32) -> QuadMesh {
    let h = 1.0 / f64::from(n);
    let side = n + 1;
    let node = |i, j| NodeId(j * side + i);
    QuadMesh {
        positions: (0..side * side)
            .map(|k| (f64::from(k % side) * h, f64::from(k / side) * h))
            .map(|(x, y)| Point::new(x, y, 0.1 * x * y * y))
            .collect(),
        quads: (0..n * n)
            .map(|k| (k % n, k / n))
            .map(|(i, j)| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)])
            .collect(),
    }
}

/// A grid of `n` x `n` x `n` hexahedra in the unit cube.
pub fn hex_grid(n: u32) -> HexMesh {
    let h = 1.0 / f64::from(n);
    let side = n + 1;
    let node = |i, j, k| NodeId((k * side + j) * side + i);
    HexMesh {
        positions: (0..side * side * side)
            .map(|m| [m % side, m / side % side, m / side / side].map(|c| f64::from(c) * h))
            .map(Point::from)
            .collect(),
        hexes: (0..n * n * n)
            .map(|m| (m % n, m / n % n, m / n / n))
            .map(|(i, j, k)| {
                [(0, 0), (1, 0), (1, 1), (0, 1)]
                    .map(|(a, b)| [node(i + a, j + b, k), node(i + a, j + b, k + 1)])
            })
            .map(|pairs| std::array::from_fn(|c| pairs[c % 4][c / 4]))
            .collect(),
        ..HexMesh::default()
    }
}

/// A triangle, a quad and a pentagon that share edges.
pub fn mixed_polygons() -> PolygonMesh {
    let mut mesh = PolygonMesh {
        positions: [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.5], [0.5, 1.7], [-0.3, 1.4]]
            .map(|[x, y]| Point::new(x, y, -x / 3.0))
            .to_vec(),
        ..PolygonMesh::default()
    };
    for face in [&[1, 4, 2][..], &[0, 1, 2, 3], &[3, 2, 5, 6]] {
        mesh.push_face(face.iter().map(|&n| NodeId(n)));
    }
    mesh.positions.push(Point::new(-1.0, 0.5, 1e-300));
    mesh.push_face([0, 3, 6, 7].map(NodeId));
    mesh.push_face([3, 5, 2, 4, 1].map(NodeId));
    mesh
}

/// Triangles and quads only.
pub fn triangles_and_quads() -> PolygonMesh {
    let mut mesh = PolygonMesh { positions: mixed_polygons().positions, ..PolygonMesh::default() };
    for face in mixed_polygons().faces().filter(|face| face.len() <= 4) {
        mesh.push_face(face.iter().copied());
    }
    mesh
}

/// A document of `mesh` whose cells have the tag sets in turn, with levels and parents.
pub fn document(mesh: AnyMesh, sets: Vec<TagSet>) -> Document {
    let count = match &mesh {
        AnyMesh::Polygons(mesh) => mesh.face_count(),
        AnyMesh::Quads(mesh) => mesh.quads.len(),
        AnyMesh::Hexes(mesh) => mesh.hexes.len(),
    };
    let tags = if sets.is_empty() {
        Tags::default()
    } else {
        let of_element = (0..count as u32).map(|cell| cell % sets.len() as u32).collect();
        Tags { sets, of_element }
    };
    Document {
        tags,
        level: (0..count).map(|cell| (cell % 5) as u8).collect(),
        parent: (0..count as u32).map(|cell| FaceId(cell / 4)).collect(),
        ..Document::new(mesh)
    }
}

/// Two named sets and one that has a number alone.
pub fn some_sets() -> Vec<TagSet> {
    vec![
        TagSet {
            object: Some("hull".into()),
            groups: vec!["wetted".into(), "port side".into()],
            material: Some("steel".into()),
            number: Some(4),
        },
        TagSet { groups: vec![Group::new("deck", 2)], number: Some(2), ..TagSet::default() },
        TagSet { number: Some(9), ..TagSet::default() },
    ]
}

/// What a reader makes of a document: quads come back as polygons, and features are not written.
pub fn as_read(document: &Document) -> Document {
    let mut read = document.clone();
    match &mut read.mesh {
        AnyMesh::Quads(mesh) => {
            let mut polygons = PolygonMesh { positions: mesh.positions.clone(), ..PolygonMesh::default() };
            mesh.quads.iter().for_each(|&quad| polygons.push_face(quad));
            read.mesh = AnyMesh::Polygons(polygons);
        }
        AnyMesh::Polygons(mesh) => mesh.features = Features::default(),
        AnyMesh::Hexes(_) => {}
    }
    read
}
