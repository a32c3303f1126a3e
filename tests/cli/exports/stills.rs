//! Pictures of a driven run at its ticks. The words of the SVG and the place of the car in it agree with the frames and
//! the car's dimensions. PNG and GIF show the ticks asked for.

use std::fs;
use std::path::Path;

use motion_lab::num::{cos, sin};
use motion_lab::run::Frame;

use crate::cli::run;
use crate::cli::runs::columns::{driven, frames};

fn svg(file: &Path, tick: u64) -> String {
    run(&["export", file.to_str().unwrap(), "--format", "svg", "--tick", &tick.to_string()]).done()
}

/// The figure's description of the run after a tick: the contacts so far and the robots' places, to a millimetre.
fn description(frame: &Frame) -> String {
    let [rusty, reach, hitch] = [0, 1, 2].map(|id| &frame.robots[id].configuration);
    let body = format!("Pose2 {{ x: {:.3}, y: {:.3}, theta: {:.3} }}", hitch[0], hitch[1], hitch[2]);
    let ends = [
        format!("Pose2 {{ x: {:.3}, y: {:.3} }}", rusty[0], rusty[1]),
        format!("T2 {{ th1: {:.3}, th2: {:.3} }}", reach[0], reach[1]),
        hitch.get(3).map_or(body.clone(), |psi| format!("HitchCfg {{ body: {body}, trailer: Some({psi:.3}) }}")),
    ];
    let sentence = |id: usize| {
        let (world, name) = [("Apartment", "Rusty"), ("Workbench", "Reach"), ("Lot", "Hitch")][id];
        let times = match frame.robots[id].contacts {
            0 => "nothing".to_owned(),
            1 => "something once".to_owned(),
            n => format!("something {n} times"),
        };
        format!("In the world {world}, {name} touches {times} and ends at {}.", ends[id])
    };
    [0, 1, 2].map(sentence).join(" ")
}

/// The text between two others.
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    let (_, rest) = text.split_once(before).unwrap_or_else(|| panic!("no {before} in {text}"));
    rest.split_once(after).unwrap().0
}

/// The points of the first path of a group.
fn path(svg: &str, group: &str) -> Vec<[f64; 2]> {
    let path = between(between(svg, &format!("<g id=\"{group}\""), "</g>"), " d=\"", "\"");
    let points = path.split(['M', 'L', 'Z']).filter(|point| !point.is_empty());
    let point = |point: &str| {
        let (x, y) = point.split_once(' ').unwrap();
        [x.parse().unwrap(), y.parse().unwrap()]
    };
    points.map(point).collect()
}

/// The corners of the car's chassis, right rear, right front, left front, left rear: 0.7 m behind the rear axle, 3.2 m
/// ahead, 1.7 m wide.
fn chassis(frame: &Frame) -> [[f64; 2]; 4] {
    let q = &frame.robots[2].configuration;
    let (c, s) = (cos(q[2]), sin(q[2]));
    [(-0.7, -0.85), (3.2, -0.85), (3.2, 0.85), (-0.7, 0.85)].map(|(u, v)| [q[0] + c * u - s * v, q[1] + s * u + c * v])
}

/// Checks that two points of the sheet agree to a tenth of a pixel, which is less than half a centimetre.
#[track_caller]
fn assert_at(found: [f64; 2], expected: [f64; 2], what: &str) {
    let near = (found[0] - expected[0]).abs() < 0.1 && (found[1] - expected[1]).abs() < 0.1;
    assert!(near, "{what} is drawn at {found:?}, not at {expected:?}");
}

#[test]
fn the_figure_at_a_tick_shows_the_run_as_it_is_then() {
    let folder = tempfile::tempdir().unwrap();
    let (file, log) = driven(folder.path());
    let all: Vec<&Frame> = frames(&log).collect();
    let rear_axle = |tick: usize| [all[tick].robots[2].configuration[0], all[tick].robots[2].configuration[1]];
    for tick in [0, 1, 37, 99, 232, 320] {
        let (svg, frame) = (svg(&file, tick as u64), all[tick]);
        assert_eq!(between(&svg, "<desc id=\"desc\">", "</desc>"), description(frame), "tick {tick}");
        let so_far = if tick == 320 { "320 ticks".to_owned() } else { format!("tick {tick} of 320") };
        let seconds = format!("{}.{:02}", tick / 20, 5 * (tick % 20));
        assert!(svg.contains(&format!("Seed 2005, {so_far} ({seconds} s).")), "tick {tick}");
        for (robot, name) in frame.robots.iter().zip(["Rusty", "Reach", "Hitch"]) {
            let crosses = (1..9).take_while(|k| svg.contains(&format!("<title>contact {k} of {name}</title>")));
            assert_eq!(crosses.count(), robot.contacts as usize, "{name} at tick {tick}");
        }
        // the sheet's scale comes from the start of the car, which is unturned: x to the right and y up
        let (start, drawn) = (chassis(all[0]), path(&svg, "Lot-start-Hitch-0"));
        let scale = (drawn[1][0] - drawn[0][0]) / 3.9;
        let sheet =
            |[x, y]: [f64; 2]| [drawn[0][0] + scale * (x - start[0][0]), drawn[0][1] - scale * (y - start[0][1])];
        assert!(scale > 10.0 && all[0].robots[2].configuration[2] == 0.0, "{scale} pixels a metre");
        assert_at(drawn[2], sheet(start[2]), "the start's left front");
        for (found, corner) in path(&svg, "Lot-robot-Hitch-0").into_iter().zip(chassis(frame)) {
            assert_at(found, sheet(corner), &format!("at tick {tick} a corner of the car"));
        }
        if tick > 0 {
            let way = path(&svg, "Lot-path-Hitch");
            assert_at(way[0], sheet(rear_axle(0)), "the beginning of its way");
            assert_at(way[way.len() - 1], sheet(rear_axle(tick)), "the end of its way");
        }
        // a cross where the rear axle was at the first tick of each contact
        let hits = (1..=tick).filter(|&t| all[t].robots[2].contacts > all[t - 1].robots[2].contacts);
        for (k, hit) in hits.enumerate() {
            let cross = path(&svg, &format!("Lot-contact-Hitch-{}", k + 1));
            let middle = [0.5 * (cross[0][0] + cross[1][0]), 0.5 * (cross[0][1] + cross[1][1])];
            assert_at(middle, sheet(rear_axle(hit)), "a cross");
        }
    }
    assert_eq!(all[320].robots[2].contacts, 2, "it touches something");
}

/// The pixels of a PNG, three bytes each.
fn still(file: &Path, tick: u64, to: &Path) -> Vec<u8> {
    let (file, out, tick) = (file.to_str().unwrap(), to.to_str().unwrap(), tick.to_string());
    run(&["export", file, "--format", "png", "--tick", &tick, "--width", "320", "-o", out]).done();
    let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(to).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    pixels
}

#[test]
fn the_pictures_of_a_film_are_those_of_its_ticks_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let (file, _) = driven(folder.path());
    let stills = [15, 35].map(|tick| still(&file, tick, &folder.path().join("still.png")));
    let film = folder.path().join("film.gif");
    let span = ["--from", "15", "--to", "39", "--every", "20", "--width", "320", "-o", film.to_str().unwrap()];
    run(&[&["export", file.to_str().unwrap(), "--format", "gif"], &span[..]].concat()).done();
    let bytes = fs::read(&film).unwrap();
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(&bytes[..]).unwrap();
    let mut pictures: Vec<Vec<u8>> = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!(frame.delay, 100, "a second for 20 ticks");
        pictures.push(frame.buffer.to_vec());
    }
    // a film has fewer colours than a still, but its picture is nearer to the still of its own tick than to another
    let difference = |picture: &[u8], still: &[u8]| -> u64 {
        let pixels = picture.chunks(4).zip(still.chunks(3));
        pixels
            .flat_map(|(p, s)| p.iter().zip(s))
            .map(|(a, b)| u64::from(a.abs_diff(*b)) * u64::from(a.abs_diff(*b)))
            .sum()
    };
    assert_eq!(pictures.len(), 2);
    for (i, picture) in pictures.iter().enumerate() {
        assert_eq!(picture.len() / 4, stills[i].len() / 3, "as large as the stills");
        let [own, other] = [i, 1 - i].map(|k| difference(picture, &stills[k]));
        assert!(own < other, "picture {i}: {own} off its own tick, {other} off the other");
    }
}
