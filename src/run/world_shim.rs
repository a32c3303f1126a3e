//! Stands in for the world file format until it is there.

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;
use crate::worlds::{Bounds, Resident, World};

#[derive(Serialize, Deserialize)]
struct Text {
    name: String,
    bounds: [f64; 4],
    robots: Vec<(String, String, Vec<f64>)>,
}

impl World {
    pub(crate) fn to_ron(&self) -> String {
        let b = self.bounds;
        let robots = self.robots.iter().map(|r| (r.name.clone(), r.kind.clone(), r.start.clone())).collect();
        let text = Text { name: self.name.clone(), bounds: [b.min.x, b.min.y, b.max.x, b.max.y], robots };
        ron::to_string(&text).unwrap_or_default()
    }

    pub(crate) fn content_hash(&self) -> u128 {
        xxhash_rust::xxh3::xxh3_128(self.to_ron().as_bytes())
    }

    pub(crate) fn parse(_source: &str, text: &str) -> Result<World, ron::error::SpannedError> {
        let t: Text = ron::from_str(text)?;
        let [a, b, c, d] = t.bounds;
        let robots = t.robots.into_iter().map(|(name, kind, start)| Resident { name, kind, start }).collect();
        Ok(World {
            name: t.name,
            bounds: Bounds { min: Point2::new(a, b), max: Point2::new(c, d) },
            obstacles: vec![],
            places: vec![],
            marks: vec![],
            robots,
        })
    }
}
