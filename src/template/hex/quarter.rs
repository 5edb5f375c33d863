//! The 2-refinement transition between a face that stays and one that becomes four (Ebeida et al., figure 7a).
//!
//! ```text
//!   refined face, z = 1      sides y = 0, x = 0       patch x = 1              patch y = 1
//!   t02---t12---t22          t00---t10---t20          t20---t21---t22          t02---t12---t22
//!    |     |     |            |     |     |            |     |     |            |     |     |
//!   t01---t11---t21           |    s1----s2           s2 ---p2----c2            |     q----c2
//!    |     |     |            |   /       |            |   /     /  |           |   /       |
//!   t00---t10---t20          b00--------b10            |  p1---c1   |          r2--------- c1
//!                                                     b10--------b11           b01---------b11
//!   x = 0: r1, r2 for s1, s2; w lies inside
//! ```
//!
//! Corner 0 and corner 4 stand at a corner `k` of the parent, 1 and 5 at an edge node `ex`, 3 and 7 at an edge node
//! `ey`, 2 and 6 at the face node `f`. Edges from the coarse to the refined face are divided in 1 at `k`, 2 at `ex`
//! and `ey`, 3 at `f`. Both outer sides show three quads, the same ones; the patches x = 1 and y = 1 differ. Four
//! quarters around a face node, each the mirror image of the next, make the composite of 28 hexes; they need
//! agree only on which two opposite edge nodes are `ex`.
//!
//! The free positions were found by minimising the sum, over layers half as high as wide and as high as wide, of the
//! 4-mean of `|J|^2 / (3 det J^(2/3))` over the corners of the cells, less twice their softened least scaled
//! Jacobian, so that no two nodes are driven together. The least scaled Jacobian, by the height of the layer:
//!
//! | height | 0.35 | 0.5 | 0.7 | 1 | 1.5 |
//! |---|---|---|---|---|---|
//! | these positions | 0.241 | 0.334 | 0.444 | 0.496 | 0.367 |
//! | side patterns centred at halves, c1 .25, c2 .7, p1 .375, p2 .75, q and w .8 | 0.234 | 0.310 | 0.382 | 0.436 | 0.308 |
//!
//! A block with flat sides cannot pass 0.5.

use super::{LocalNode, Template};

const B00: LocalNode = 0;
const B10: LocalNode = 1;
const B11: LocalNode = 2;
const B01: LocalNode = 3;
const T00: LocalNode = 4;
const T20: LocalNode = 5;
const T22: LocalNode = 6;
const T02: LocalNode = 7;
const T10: LocalNode = 8;
const T21: LocalNode = 9;
const T12: LocalNode = 10;
const T01: LocalNode = 11;
const T11: LocalNode = 12;
const S1: LocalNode = 13;
const S2: LocalNode = 14;
const R1: LocalNode = 15;
const R2: LocalNode = 16;
const C1: LocalNode = 17;
const C2: LocalNode = 18;
const P1: LocalNode = 19;
const P2: LocalNode = 20;
const Q: LocalNode = 21;
const W: LocalNode = 22;

/// The quarter of the composite template: z = 0 is the face that stays, z = 1 the face that is refined.
pub static QUARTER: Template = Template::new(
    [
        [0.5, 0.0, 1.0],       // t10
        [1.0, 0.5, 1.0],       // t21
        [0.5, 1.0, 1.0],       // t12
        [0.0, 0.5, 1.0],       // t01
        [0.5, 0.5, 1.0],       // t11
        [0.522, 0.0, 0.457],   // s1
        [1.0, 0.0, 0.402],     // s2
        [0.0, 0.522, 0.457],   // r1
        [0.0, 1.0, 0.402],     // r2
        [1.0, 1.0, 0.294],     // c1
        [1.0, 1.0, 0.662],     // c2
        [1.0, 0.497, 0.352],   // p1
        [1.0, 0.485, 0.676],   // p2
        [0.482, 1.0, 0.75],    // q
        [0.476, 0.475, 0.769], // w
    ],
    [
        [B00, B10, B11, B01, R1, P1, C1, R2],
        [R1, P1, C1, R2, W, P2, C2, Q],
        [B00, B10, P1, R1, S1, S2, P2, W],
        [B00, S1, W, R1, T00, T10, T11, T01],
        [S1, S2, P2, W, T10, T20, T21, T11],
        [R1, W, Q, R2, T01, T11, T12, T02],
        [W, P2, C2, Q, T11, T21, T22, T12],
    ],
);
