//! Where a map is looked up for a pixel that is wrong.

use serde::{Deserialize, Serialize};

/// Where the map that a pass draws is looked up for a pixel that is wrong.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct MapLookup {
    /// The number of the frame, from 0.
    pub frame: u32,
    /// The pixel: column from the left, row from above, both from 0.
    pub pixel: [u32; 2],
    /// The number of the texture among those of the homework.
    pub texture: u32,
    /// The file that looks it up, where that is handed in.
    pub file: Option<String>,
    /// The line of the first lookup.
    pub line: Option<u32>,
    /// Where the answer looks: nowhere, once, or several times.
    pub yours: Vec<MapPlace>,
    /// Where a right answer looks.
    pub right: Vec<MapPlace>,
}

/// A place on a map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct MapPlace {
    /// From 0 to 1 from the left, and from below; beyond that outside of the map.
    pub at: [f64; 2],
    /// What is compared with the map, where the lookup compares.
    pub depth: Option<f64>,
    /// What the map holds there; outside, at the nearest place on its edge.
    pub stored: f64,
}
