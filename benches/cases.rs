//! The refinements that are measured: a sheet of 32 by 32 quads, to 1 M and 4 M quads.

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh};
use hexmill::refine::{QuadOptions, RefinedQuads, refine_quads};
use hexmill::sizing::{Region, Shape, Target};

/// An `n` by `n` torus-free sheet of unit squares, slightly bent.
fn sheet(n: u32) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for y in 0..=n {
        mesh.positions.extend((0..=n).map(|x| {
            let (x, y) = (f64::from(x), f64::from(y));
            Point::new(x, y, 0.01 * x * y)
        }));
    }
    for y in 0..n {
        for x in 0..n {
            let node = |dx, dy| NodeId((y + dy) * (n + 1) + x + dx);
            mesh.push_face([node(0, 0), node(1, 0), node(1, 1), node(0, 1)]);
        }
    }
    mesh
}

fn uniform(levels: u8) -> QuadOptions {
    QuadOptions { levels: Some(levels), ..QuadOptions::default() }
}

/// A ball that covers about a third of the sheet, `levels` deep.
fn adaptive(levels: u8) -> QuadOptions {
    let shape = Shape::Sphere { center: Point::new(16.0, 16.0, 2.5), radius: 10.0 };
    let region = Region { shape, target: Target::Level(levels) };
    QuadOptions { regions: vec![region], ..QuadOptions::default() }
}

/// Each case's name, input and options.
pub fn cases() -> impl Iterator<Item = (&'static str, PolygonMesh, QuadOptions)> {
    [
        ("uniform-1M", uniform(5)),
        ("uniform-4M", uniform(6)),
        ("adaptive-1M", adaptive(6)),
        ("adaptive-4M", adaptive(7)),
    ]
    .into_iter()
    .map(|(name, options)| (name, sheet(32), options))
}

/// Refines on `pool`.
pub fn on(pool: &rayon::ThreadPool, mesh: &PolygonMesh, options: &QuadOptions) -> RefinedQuads {
    pool.install(|| refine_quads(mesh, options, &Silent)).expect("within limits")
}

/// A pool of `threads` threads.
pub fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool")
}
