//! Rays and distances by Box2D 3, in single precision, through the crate `boxdd`, whose checks are part of what is
//! measured.
//!
//! <https://docs.rs/boxdd/0.6.0/boxdd/struct.Query.html#method.cast_ray_closest> and
//! <https://docs.rs/boxdd/0.6.0/boxdd/collision/fn.shape_distance.html>. Box2D has no search for the nearest: as its
//! users do, its tree is asked for what is near a link, and again within a greater distance where nothing is.

use boxdd::{
    Aabb, BodyBuilder, DistanceInput, DynamicTree, Foundation, Position, QueryFilter, ShapeDef, ShapeProxy,
    SimplexCache, Transform, Vec2, World, WorldBuilder, shape_distance,
};

use crate::rivals::{By, Contender, Task};

fn vector(p: &[f64]) -> Vec2 {
    Vec2::new(p[0] as f32, p[1] as f32)
}

struct Rays {
    world: World,
    fans: Vec<(Position, Vec<Vec2>)>,
    range: f64,
    ranges: Vec<f64>,
}

impl Contender for Rays {
    fn name(&self) -> &'static str {
        "Box2D"
    }

    fn work(&mut self, case: usize) -> f64 {
        let (from, ways) = &self.fans[case];
        let query = self.world.query().expect("a world");
        for (way, range) in ways.iter().zip(&mut self.ranges) {
            let hit = query.cast_ray_closest(*from, *way, QueryFilter::default()).expect("a finite ray");
            *range = hit.map_or(f64::INFINITY, |hit| f64::from(hit.fraction) * self.range);
        }
        self.ranges[0]
    }

    fn answers(&mut self, case: usize) -> Vec<f64> {
        self.work(case);
        self.ranges.clone()
    }
}

fn rays(task: &Task) -> boxdd::Result<Rays> {
    let foundation = Foundation::initialize_default()?;
    let mut world = foundation.create_world(WorldBuilder::from(foundation.world_def()).build()?)?;
    let body = world.create_body(BodyBuilder::from(foundation.body_def()).build()?)?;
    for wall in &task.obstacles {
        let (a, b) = (vector(&wall[1..]), vector(&wall[3..]));
        world.body(body)?.create_segment_between(&ShapeDef::builder().build()?, a, b)?;
    }
    _ = world.step(1.0 / 60.0, 1)?; // builds the trees
    let range = task.settings[0];
    let fan = |case: &Vec<f64>| {
        let ways = case[2..].chunks(2).map(|d| vector(&[range * d[0], range * d[1]])).collect();
        (Position::new(case[0] as _, case[1] as _), ways)
    };
    let fans: Vec<(Position, Vec<Vec2>)> = task.cases.iter().map(fan).collect();
    Ok(Rays { world, range, ranges: vec![0.0; fans[0].1.len()], fans })
}

fn bounds(points: &[Vec2], margin: f32) -> Aabb {
    let fold = |pick: fn(f32, f32) -> f32| {
        let first = points[0];
        points.iter().fold(first, |a, b| Vec2::new(pick(a.x, b.x), pick(a.y, b.y)))
    };
    let (low, high) = (fold(f32::min), fold(f32::max));
    Aabb::new(Vec2::new(low.x - margin, low.y - margin), Vec2::new(high.x + margin, high.y + margin)).expect("finite")
}

/// The least distance of a link's segment from the obstacles.
fn nearest(tree: &DynamicTree, shapes: &[ShapeProxy], near: &mut Vec<usize>, link: &[Vec2], limit: f32) -> f32 {
    let proxy = ShapeProxy::new(link.iter().copied(), 0.0).expect("two points");
    let mut within = if limit < 0.25 { limit } else { 0.25 };
    loop {
        near.clear();
        tree.query_all(bounds(link, within), &mut |_, i| {
            near.push(i as usize);
            true
        })
        .expect("a tree");
        let mut best = limit;
        for i in &*near {
            let input = DistanceInput::new(proxy, shapes[*i], Transform::IDENTITY).expect("finite");
            let distance = shape_distance(input, &mut SimplexCache::default()).expect("two shapes").distance;
            best = if distance < best { distance } else { best };
        }
        if best <= within || within >= limit {
            return best;
        }
        within *= 4.0;
    }
}

fn distances(task: &Task) -> boxdd::Result<Box<dyn Contender>> {
    Foundation::initialize_default()?;
    let mut tree = DynamicTree::with_capacity(task.obstacles.len())?;
    let mut shapes = Vec::new();
    for (i, obstacle) in task.obstacles.iter().enumerate() {
        let points: Vec<Vec2> = obstacle[1..].chunks(2).map(vector).collect();
        tree.create_proxy(bounds(&points, 0.0), u64::MAX, i as u64)?;
        shapes.push(ShapeProxy::new(points, 0.0)?);
    }
    tree.rebuild(true)?;
    let radius = task.settings[0] as f32;
    let link = |p: &[f64]| [vector(p), vector(&p[2..])];
    let arms: Vec<Vec<[Vec2; 2]>> = task.cases.iter().map(|case| case.chunks(4).map(link).collect()).collect();
    let mut near = Vec::new();
    let ask = move |case: usize| {
        let nearest = arms[case].iter().fold(1e6, |best, link| nearest(&tree, &shapes, &mut near, link, best));
        f64::from(if nearest > radius { nearest - radius } else { 0.0 })
    };
    Ok(Box::new(By { name: "Box2D", ask }))
}

pub fn contenders(task: &Task) -> Vec<Box<dyn Contender>> {
    match task.kind.as_str() {
        "scan" => vec![Box::new(rays(task).expect("a world of walls"))],
        "distance" => vec![distances(task).expect("a tree of obstacles")],
        _ => Vec::new(),
    }
}
