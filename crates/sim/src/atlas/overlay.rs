//! Overlays of the atlas: a refusal with its offer, a probe of the grid, a selected thing with its handles.

use super::{Atlas, Editor, GridLayer, Handle, TeleportRefusal};
use motion_lab_core::collision::Collision;
use motion_lab_core::configuration::AnyConfiguration;
use motion_lab_core::geometry::{Aabb, Footprint, Part, Placed, Point2};
use motion_lab_core::picture::{Anchor, Dash, Drawing, Face, Glyph, Item, Line, Role, footprint, outline, polygon_of};
use motion_lab_core::robots::{AnyRobot, Robot};
use motion_lab_core::worlds::Obstacle;

/// Words on a plate over or under a point.
fn label(id: &str, at: Point2, anchor: Anchor, text: String) -> Item {
    let name = text.clone();
    let drawing = Drawing::Label { at, text, anchor, face: Face::Sans, size_px: 12.0, plate: true };
    Item::new(id, name, Role::Text, drawing)
}

impl Atlas {
    /// A refused teleport of robot number `index` to `wanted`: a red ghost with the reason, the outlines of everything
    /// it would overlap, and the nearest free configuration as a ghost with the way to it.
    pub fn refusal_items(&self, index: usize, wanted: &AnyConfiguration, refusal: &TeleportRefusal) -> Vec<Item> {
        let Some(resident) = self.robots().get(index) else { return Vec::new() };
        let robot = resident.robot;
        let mut items = Vec::new();
        let at = robot.reference(wanted);
        if let TeleportRefusal::Overlap { names, nearest } = refusal {
            for name in names {
                let outline = self.world().obstacle(name).map_or_else(Vec::new, around);
                let region = Drawing::Region { pieces: Vec::new(), outline };
                let id = format!("refused/{name}");
                items
                    .push(Item::new(id, format!("{name} is in the way"), Role::Goal, region).stroked(Line::solid(2.0)));
            }
            items.extend(footprint("refused/ghost", "where it cannot be", &robot.footprint(wanted), Role::Goal, 0.3));
            if let Some(offer) = nearest {
                let ghost = robot.footprint(&offer.q);
                items.extend(footprint("offer/ghost", "the nearest free place", &ghost, Role::Robot, 0.3));
                let way = Drawing::segment(at, robot.reference(&offer.q));
                items.push(
                    Item::new("offer/way", "the way to it", Role::Focus, way)
                        .stroked(Line::solid(1.5).dashed(Dash::Dashed)),
                );
                let ring = Drawing::Mark { at: robot.reference(&offer.q), glyph: Glyph::Handle, radius_px: 5.0 };
                items.push(Item::new("offer/handle", "put it there", Role::Focus, ring));
            }
        }
        // the words stand under the ghosts, or over them where there is no room below
        let offered = match refusal {
            TeleportRefusal::Overlap { nearest: Some(offer), .. } => robot.footprint(&offer.q),
            _ => Footprint::default(),
        };
        let shown = robot.footprint(wanted);
        let boxes = shown.parts().iter().chain(offered.parts()).map(|p| p.placed().bounds());
        let Aabb { min: lo, max: hi } = boxes.reduce(|a, b| a.merged(&b)).unwrap_or(Aabb::new(at, at));
        let bounds = self.world().bounds;
        let below = lo.y > bounds.min.y + 0.08 * (bounds.max.y - bounds.min.y);
        let (y, anchor) = if below { (lo.y, Anchor::Below) } else { (hi.y, Anchor::Above) };
        items.push(label("refused/words", Point2::new(0.5 * (lo.x + hi.x), y), anchor, refusal.to_string()));
        items
    }
}

impl GridLayer {
    /// A probe of a point: its cell, the exact shortest way, and both distances. Empty beyond the grid.
    pub fn probe_items(&self, p: Point2) -> Vec<Item> {
        let Some(probe) = self.probe(p) else { return Vec::new() };
        let Aabb { min: lo, max: hi } = self.grid().square(probe.cell.0, probe.cell.1);
        let cell = vec![lo, Point2::new(hi.x, lo.y), hi, Point2::new(lo.x, hi.y), lo];
        let mut items =
            vec![Item::new("probe/cell", "its cell", Role::Focus, Drawing::Polyline(cell)).stroked(Line::solid(1.5))];
        if let Some(w) = self.scene().witness(&Footprint::disc(p, 0.0)).filter(|w| w.dist > 0.0) {
            let way = Drawing::segment(p, w.on_obstacle);
            items.push(Item::new("probe/way", "the shortest way", Role::Witness, way).stroked(Line::solid(2.0)));
            let ring = Drawing::Mark { at: w.on_obstacle, glyph: Glyph::Ring, radius_px: 3.5 };
            items.push(Item::new("probe/b", "the nearest point", Role::Witness, ring));
        }
        let ring = Drawing::Mark { at: p, glyph: Glyph::Ring, radius_px: 3.5 };
        items.push(Item::new("probe/a", "the point", Role::Witness, ring));
        let length = |d: f64| if d.is_finite() { format!("{d:.3} m") } else { "\u{221e}".into() };
        let words = format!("exact {}, by the grid {}", length(probe.exact), length(probe.derived));
        items.push(label("probe/words", p, Anchor::Above, words));
        items
    }
}

impl Editor {
    /// The selected thing of this name: its outline in the focus colour, and its handles. Handles that make a corner
    /// are rings. A robot is outlined where it starts. Empty for a name that nothing has.
    pub fn selected_items(&self, name: &str) -> Vec<Item> {
        let world = self.world();
        let mark = world.marks.iter().find(|mark| mark.name == name).map(|mark| vec![mark.points.clone()]);
        let heading =
            world.place(name).map(|_| self.handles(name).iter().map(|h| vec![h.at]).collect::<Vec<_>>().concat());
        let door = world.door(name).map(|door| vec![vec![door.a, door.b]]);
        let robot = || {
            let resident = world.robots.iter().find(|robot| robot.name == name)?;
            let own = AnyRobot::of_resident(resident).map(|(robot, q)| robot.footprint(&q));
            let footprint = own.or_else(|| self.kinds().footprint(&resident.kind, &resident.start));
            Some(footprint.map_or_else(Vec::new, |f| lines_around(f.parts().iter().map(Part::placed))))
        };
        let lines =
            world.obstacle(name).map(around).or(door).or(mark).or(heading.map(|line| vec![line])).or_else(robot);
        let Some(outline) = lines else { return Vec::new() };
        let region = Drawing::Region { pieces: Vec::new(), outline };
        let mut items = vec![Item::new("selected", name, Role::Focus, region).stroked(Line::solid(2.0))];
        items.extend(self.handles(name).into_iter().map(|Handle { index, at, makes_corner }| {
            let (glyph, radius_px) = if makes_corner { (Glyph::Ring, 3.5) } else { (Glyph::Handle, 5.0) };
            let mark = Drawing::Mark { at, glyph, radius_px };
            Item::new(format!("handle/{index}"), format!("handle {} of {name}", index + 1), Role::Focus, mark)
        }));
        items
    }
}

/// The outline of an obstacle, its pieces as one.
fn around(obstacle: &Obstacle) -> Vec<Vec<Point2>> {
    let placed: Vec<Placed> = obstacle.placed().collect();
    lines_around(placed.iter())
}

/// The outline of shapes, as one.
fn lines_around<'a>(placed: impl Iterator<Item = &'a Placed>) -> Vec<Vec<Point2>> {
    let (mut lines, pieces): (Vec<_>, Vec<_>) = placed.map(polygon_of).partition(|p| p.len() == 2);
    lines.extend(outline(&pieces));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use motion_lab_core::worlds::World;

    fn ids(items: &[Item]) -> Vec<&str> {
        items.iter().map(|i| i.id.as_str()).collect()
    }

    #[test]
    fn a_refusal_shows_what_is_in_the_way_and_the_offer() {
        let mut atlas = Atlas::new(World::lot());
        let wanted = atlas.robots()[0].q.with(0, 5.5).with(1, 5.0).with(2, 1.2);
        let refusal = atlas.teleport(0, wanted).unwrap().unwrap_err();
        let items = atlas.refusal_items(0, &wanted, &refusal);
        let expected = [
            "refused/the west pillar",
            "refused/ghost/0",
            "offer/ghost/0",
            "offer/way",
            "offer/handle",
            "refused/words",
        ];
        assert_eq!(ids(&items), expected);
        assert_eq!((items[0].role, items[5].name.as_str()), (Role::Goal, "would overlap the west pillar"));
    }

    #[test]
    fn a_probe_shows_both_distances() {
        let layer = GridLayer::new(&World::workbench(), 0.1).unwrap();
        let items = layer.probe_items(Point2::new(0.75, 0.52));
        assert_eq!(ids(&items), ["probe/cell", "probe/way", "probe/b", "probe/a", "probe/words"]);
        // 0.48 m below the block, and five cells by the grid: the row above 1.0 is the first occupied one
        assert!(items[4].name.starts_with("exact 0.480 m, by the grid 0."), "{}", items[4].name);
        assert!(layer.probe_items(Point2::new(9.0, 0.0)).is_empty());
        let inside = layer.probe_items(Point2::new(0.75, 1.25));
        assert_eq!(inside.last().unwrap().name, "exact 0.000 m, by the grid 0.000 m");
    }

    #[test]
    fn what_is_selected_has_handles_where_its_corners_are() {
        let editor = Editor::new(World::workbench());
        let items = editor.selected_items("the block");
        assert_eq!(ids(&items), ["selected", "handle/0", "handle/1", "handle/2", "handle/3"]);
        for (item, handle) in items[1..].iter().zip(editor.handles("the block")) {
            let Drawing::Mark { at, .. } = item.drawing else { panic!("a mark") };
            assert_eq!(at, handle.at);
        }
        assert_eq!(
            ids(&editor.selected_items("the base")),
            ["selected", "handle/0", "handle/1"],
            "where it is, and faces"
        );
        assert!(editor.selected_items("nobody").is_empty());
    }
}
