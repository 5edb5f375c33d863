//! Forests: a tree of elements over every coarse element, a level at a time.
//!
//! A forest of quadtrees is held as the paper holds it (Ebeida et al., section 2): one sub-mesh per level,
//! the union of all elements at that level. Its promises:
//!
//! - **Nodes are identified by what they divide.** An edge of a level is divided at most once, and whoever
//!   divides it gets the same node; nothing compares coordinates.
//! - **Elements of level 1 and deeper alternate**: local nodes 1 and 3 are edge nodes, 0 and 2 are not. An
//!   edge of such a level joins an edge node to another node, and is stored in that order.
//! - A node is an edge node at one level only, the level of the elements that were made with it; for deeper
//!   levels it is a corner like any other.
//! - The order of nodes, edges and elements depends on the input alone, not on threads.
//!
//! A forest of octrees is held in the same way ([`HexForest`], section 3). Nodes are told apart by [`NodeKind`], and
//! [`HexForest::close`] refines further what the rules of conforming refinement ask for.

mod balance;
mod base;
mod closure;
mod heirs;
mod hex_base;
mod octree;
mod quadtree;
#[cfg(test)]
mod testing;

pub use base::BaseError;
pub use closure::{Admits, CloseError, Closure, admits_method_one};
pub use octree::{HexForest, HexLevel, NodeKind};
pub use quadtree::{Level, QuadForest};
pub(crate) use quadtree::{center, midpoint};
