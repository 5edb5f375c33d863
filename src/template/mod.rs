//! Refinement templates as data: the nodes a template uses, by what they divide, and its cells.
//!
//! A template never holds coordinates that matter to topology; its nodes divide edges and faces of the element
//! it is applied to, and its inside, so that two neighbours that divide the same edge or face share the nodes
//! there by identity.

pub mod hex;
pub mod quad;
