//! The mesh formats beside OBJ: what is written reads back, what others wrote is read, and what is
//! wrong is told.

mod allocation;
mod broken;
mod foreign;
mod glb;
mod golden;
mod groups;
mod hidden;
mod hostile;
mod mutations;
mod round_trip;
mod second_order;
mod second_order_read;
mod several_groups;
mod stl;
mod structured;
mod worlds;
