//! Refinement templates as data: the nodes a template uses, by what they divide, and its cells.
//!
//! A template never holds coordinates that matter to topology; its nodes are the corners, edge nodes and
//! face node of the element it is applied to, so that two neighbours that divide the same edge share its
//! node by identity.

pub mod quad;
