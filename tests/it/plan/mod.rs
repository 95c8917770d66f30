//! Plans for scenes: what frames show, whoever drew them.

mod gbuffer;
