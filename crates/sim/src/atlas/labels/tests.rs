use super::*;

impl Plate {
    fn overlaps(&self, other: &Plate) -> bool {
        let d = self.middle - other.middle;
        d.x.abs() < self.half.x + other.half.x && d.y.abs() < self.half.y + other.half.y
    }
}

fn plates(items: &[Item], px_per_metre: f64) -> Vec<(String, Plate)> {
    let plates = items.iter().filter_map(|item| match &item.drawing {
        Drawing::Label { at, text, size_px, .. } => {
            let half = Vector2::new(0.5 * 0.5 * size_px * text.chars().count() as f64, 0.5 * size_px) / px_per_metre;
            Some((text.clone(), Plate { middle: *at, half }))
        }
        _ => None,
    });
    plates.collect()
}

#[test]
fn names_overlap_nothing_at_any_size_and_the_last_drop_out_first() {
    for (world, missing) in [
        // the least number of names left out on paper 560, 380 and 240 pixels high
        (World::apartment(), [4, 14, 26]),
        (World::workbench(), [0, 0, 0]),
        (World::lot(), [0, 4, 8]),
    ] {
        for (height, most_missing) in [560.0, 380.0, 240.0].into_iter().zip(missing) {
            let scale = height / (world.bounds.max.y - world.bounds.min.y);
            let atlas = Atlas::new(world.clone());
            let items = names(&atlas, scale);
            let plates = plates(&items, scale);
            let all = named(&world);
            let case = format!("{} at {height}: {} of {}", world.name, plates.len(), all.len());
            assert!(plates.len() + most_missing >= all.len(), "{case}");
            let sheet = LabelObstacles::of(&atlas, 1.0 / scale);
            let leader = |item: &Item| match &item.drawing {
                Drawing::Polyline(points) => Some(Segment::new(points[0], points[1])),
                _ => None,
            };
            let leaders: Vec<Segment> = items.iter().filter_map(leader).collect();
            assert_eq!(leaders.len(), plates.len());
            for (i, (name, plate)) in plates.iter().enumerate() {
                let narrow = Plate { half: plate.half * 0.9, ..*plate };
                assert!(narrow.covers(leaders[i].b), "{case}: a leader ends short of {name}");
                assert!(!sheet.solid.intersects(&plate.area()), "{case}: {name} on something solid");
                assert!(!sheet.marks.intersects(&plate.area()), "{case}: {name} on a mark");
                assert!(!sheet.dots.iter().any(|d| plate.covers(*d)), "{case}: {name} on an arrow");
                let others = leaders.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, s)| *s);
                let lines = Scene::of_walls(&others.collect::<Vec<_>>());
                assert!(!lines.intersects(&plate.area()), "{case}: a line through {name}");
                for (other, p) in &plates[..i] {
                    assert!(!plate.overlaps(p), "{case}: {name} and {other}");
                }
            }
            // obstacles have the first choice
            let share = |list: &str| {
                let of_list: Vec<&LabelledThing> = all.iter().filter(|n| n.list == list).collect();
                let shown = of_list.iter().filter(|n| plates.iter().any(|(p, _)| *p == n.name)).count();
                if of_list.is_empty() { 0.0 } else { shown as f64 / of_list.len() as f64 }
            };
            assert!(share("obstacles") > 0.0 && share("obstacles") + 1e-9 >= share("walls"), "{case}");
        }
    }
}

#[test]
fn every_named_thing_is_found() {
    let world = World::lot();
    let all = named(&world);
    let count = world.obstacles.len() + world.doors.len() + world.places.len() + world.marks.len() + world.robots.len();
    assert_eq!(all.len(), count);
    assert!(all.iter().all(|n| !n.at.is_empty() && n.at.iter().all(|p| p.x.is_finite())));
}
