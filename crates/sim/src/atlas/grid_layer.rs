//! `GridLayer`, a world's occupancy grid and its distance transform, with the exact distance for comparison.

use motion_lab_core::collision::{Collision, Scene};
use motion_lab_core::cspace::rectangles::rectangles;
use motion_lab_core::geometry::{Footprint, Point2};
use motion_lab_core::num::{greater, sqrt};
use motion_lab_core::picture::{Drawing, Fill, Item, Line, Picture, Role};
use motion_lab_core::worlds::{DistanceTransform, Grid, GridError, World};

/// Number of shades of distance.
const SHADES: u32 = 8;

/// Largest number of cells to a side of a grid that is drawn with shades.
const DRAWN: u32 = 2048;

/// The grid of a world at one resolution, and its distance transform.
#[derive(Clone, Debug)]
pub struct GridLayer {
    name: String,
    bounds: motion_lab_core::geometry::Aabb,
    grid: Grid,
    transform: DistanceTransform,
    scene: Scene,
}

/// The distances of a point by the grid and by geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// The column and row of its cell.
    pub cell: (u32, u32),
    /// Whether the cell is occupied.
    pub occupied: bool,
    /// The transform's distance, from the cell's centre to the centre of the nearest occupied cell, metres.
    pub derived: f64,
    /// The exact distance from the point to the nearest obstacle, metres.
    pub exact: f64,
    /// Largest difference between the two distances, metres. The point is up to half a diagonal from its cell's centre,
    /// and the transform errs by up to another half. The bound holds where the nearest obstacle point lies within the
    /// world's bounds.
    pub most_apart: f64,
}

impl GridLayer {
    /// The layer of a world with cells of `resolution` metres.
    ///
    /// # Errors
    /// [`GridError`] for a resolution that is not finite and positive, or too fine.
    pub fn new(world: &World, resolution: f64) -> Result<Self, GridError> {
        let grid = Grid::rasterize(world, resolution)?;
        let transform = DistanceTransform::of(&grid);
        Ok(GridLayer { name: world.name.clone(), bounds: world.bounds, grid, transform, scene: Scene::of_world(world) })
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The distance transform.
    pub fn transform(&self) -> &DistanceTransform {
        &self.transform
    }

    /// The world's obstacles.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The distances of a point by the grid and by geometry; `None` beyond the grid.
    pub fn probe(&self, p: Point2) -> Option<Probe> {
        let cell = self.grid.cell_at(p)?;
        Some(Probe {
            cell,
            occupied: self.grid.is_occupied(cell.0, cell.1),
            derived: self.transform.distance(cell.0, cell.1),
            exact: self.scene.distance(&Footprint::disc(p, 0.0)),
            most_apart: self.grid.resolution() * sqrt(2.0),
        })
    }

    /// The layer as a picture: occupied cells solid, the others shaded by their distance, the farther the stronger. A
    /// grid of at most 64 cells to a side has lines between its cells. A grid of more than 2048 cells to a side has no
    /// shades.
    pub fn picture(&self) -> Picture {
        let (columns, rows) = (self.grid.columns(), self.grid.rows());
        let each = || (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)));
        let farthest = each()
            .map(|(c, r)| self.transform.distance(c, r))
            .filter(|d| d.is_finite())
            .fold(0.0, |m, d| greater(d, m));
        // 0 for an occupied cell, then 1 to SHADES by distance
        let shade = |(c, r): (u32, u32)| match self.transform.distance(c, r) {
            0.0 => 0,
            d if d.is_finite() && farthest > 0.0 => {
                1 + ((d / farthest * f64::from(SHADES)).ceil() as u32 - 1).min(SHADES - 1)
            }
            _ => SHADES,
        };
        let image: Vec<u32> = each().map(shade).collect();
        let fine = columns > DRAWN || rows > DRAWN;
        let mut items = Vec::new();
        for level in (1..=SHADES).filter(|_| !fine) {
            let far = farthest * f64::from(level) / f64::from(SHADES);
            let opacity = 0.05 + 0.05 * f64::from(level);
            items.push(
                self.cells(&image, level, format!("distance/{level}"), format!("up to {far:.2} m"), Role::Free)
                    .filled(Fill::Tint(opacity)),
            );
        }
        items.push(
            self.cells(&image, 0, "occupied".into(), "occupied cells".into(), Role::Unknown).filled(Fill::Tint(0.55)),
        );
        if columns <= 64 && rows <= 64 {
            items.push(self.lines());
        }
        Picture::new(format!("grid of {}", self.name), self.bounds).with(items)
    }

    /// The cells of one shade.
    fn cells(&self, image: &[u32], shade: u32, id: String, name: String, role: Role) -> Item {
        let pieces = rectangles(image, self.grid.columns(), |s| *s == shade).into_iter().map(|r| {
            let lo = self.grid.square(r.left, r.low).min;
            let hi = self.grid.square(r.right - 1, r.high - 1).max;
            let hi = Point2::new(
                motion_lab_core::num::lesser(hi.x, self.bounds.max.x),
                motion_lab_core::num::lesser(hi.y, self.bounds.max.y),
            );
            vec![lo, Point2::new(hi.x, lo.y), hi, Point2::new(lo.x, hi.y)]
        });
        Item::new(format!("grid/{id}"), name, role, Drawing::Region { pieces: pieces.collect(), outline: Vec::new() })
    }

    fn lines(&self) -> Item {
        let (min, max) = (self.bounds.min, self.bounds.max);
        let upright = (1..self.grid.columns()).map(|k| {
            let x = self.grid.square(k, 0).min.x;
            vec![Point2::new(x, min.y), Point2::new(x, max.y)]
        });
        let level = (1..self.grid.rows()).map(|k| {
            let y = self.grid.square(0, k).min.y;
            vec![Point2::new(min.x, y), Point2::new(max.x, y)]
        });
        let outline = upright.chain(level).collect();
        Item::new("grid/lines", "the cells", Role::Hairline, Drawing::Region { pieces: Vec::new(), outline })
            .stroked(Line::solid(0.5))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::random::{Seed, Stream};

    #[test]
    fn grid_and_geometry_agree_as_far_as_they_must() {
        let mut s = Stream::new(Seed(6), "probe");
        for world in [World::apartment(), World::workbench(), World::lot()] {
            for resolution in [0.05, 0.2] {
                let layer = GridLayer::new(&world, resolution).unwrap();
                let mut largest: f64 = 0.0;
                for _ in 0..300 {
                    let (min, max) = (world.bounds.min, world.bounds.max);
                    let p = Point2::new(s.uniform(min.x, max.x), s.uniform(min.y, max.y));
                    let probe = layer.probe(p).unwrap();
                    let apart = (probe.derived - probe.exact).abs();
                    assert!(apart <= probe.most_apart + 1e-12, "{p} {probe:?}");
                    largest = greater(largest, apart);
                    assert_eq!(probe.occupied, probe.derived == 0.0);
                }
                assert!(largest > 0.1 * resolution, "they do differ, or nothing is compared");
            }
        }
        let layer = GridLayer::new(&World::lot(), 0.5).unwrap();
        assert_eq!(layer.probe(Point2::new(-1.0, 0.0)), None);
        assert!(GridLayer::new(&World::lot(), 0.0).is_err());
    }

    #[test]
    fn the_picture_tiles_the_bounds() {
        for (world, resolution) in [(World::workbench(), 0.1), (World::lot(), 0.3)] {
            let layer = GridLayer::new(&world, resolution).unwrap();
            let area: f64 = layer
                .picture()
                .items
                .iter()
                .filter_map(|i| if let Drawing::Region { pieces, .. } = &i.drawing { Some(pieces) } else { None })
                .flatten()
                .map(|p| (p[2].x - p[0].x) * (p[2].y - p[0].y))
                .sum();
            let (min, max) = (world.bounds.min, world.bounds.max);
            let whole = (max.x - min.x) * (max.y - min.y);
            assert!((area - whole).abs() < 1e-9 * whole, "{}: {area} of {whole}", world.name);
        }
    }
}
