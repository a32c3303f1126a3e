//! All digits of the numbers of a link.

use super::super::*;
use super::built_in;
use motion_lab_core::random::Stream;
use motion_lab_sim::run::{Event, Quantized, RobotInput, WorldChange, WorldEvent};

/// The fields of a query by another reader: each one's name and its text.
fn fields(query: &str) -> Vec<(String, String)> {
    let plain = |text: &str| {
        let (mut bytes, mut rest) = (Vec::new(), text.as_bytes());
        while let [first, more @ ..] = rest {
            let coded = *first == b'%';
            bytes.push(if coded {
                u8::from_str_radix(std::str::from_utf8(&more[..2]).unwrap(), 16).unwrap()
            } else {
                *first
            });
            rest = if coded { &more[2..] } else { more };
        }
        String::from_utf8(bytes).unwrap()
    };
    query.split('&').filter_map(|pair| pair.split_once('=')).map(|(name, text)| (name.into(), plain(text))).collect()
}

/// Any bits at all.
fn bits(draws: &mut Stream) -> u64 {
    (draws.below(1 << 32) << 32) | draws.below(1 << 32)
}

/// A number of this size and all digits.
fn digits(draws: &mut Stream, from: f64, to: f64) -> f64 {
    loop {
        // the middle of the range may be rounded to few digits; the last bits are drawn anew
        let x = f64::from_bits((draws.uniform(from, to).to_bits() & !0xffff) | draws.below(1 << 16));
        if (from..to).contains(&x) {
            return x;
        }
    }
}

#[test]
fn every_number_of_a_link_has_all_its_digits() {
    let mut draws = Stream::new(Seed(90), "digits");
    for round in 0..200 {
        let finite = |draws: &mut Stream| loop {
            let x = f64::from_bits(bits(draws));
            if x.is_finite() {
                return x;
            }
        };
        // of every size; and of the sizes that robots have
        let mut q: Vec<f64> = (0..6).map(|_| finite(&mut draws)).collect();
        q.extend((0..6).map(|_| digits(&mut draws, 1e-3, 10.0)));
        q.extend([-0.0, 5e-324, f64::MAX, 0.1 + 0.2].into_iter().take(round % 5));
        let seed = Seed(bits(&mut draws));
        let sensor = RangeSensor { n_rays: 1 + draws.below(400) as u32, max_range: digits(&mut draws, 1e-3, 30.0) };
        let (tick, digest) = (draws.below(40_000), format!("{:016x}{:016x}", bits(&mut draws), bits(&mut draws)));
        // up to 1000 m in units of 2^-20 m
        let mut unit = || Quantized(draws.below(1 << 31) as i64 - (1 << 30));
        let event = |tick, robot: &str, input| Event { tick, robot: robot.into(), input };
        let to = vec![unit(), unit()];
        let change = WorldChange::Move { name: "A's bed".into(), to: (unit(), unit(), unit()) };
        let script = Script::new(
            vec![event(1, "Reach", RobotInput::MoveTo(to.clone())), event(2, "Reach", RobotInput::Teleport(to))],
            vec![WorldEvent { tick: 1, world: "Apartment".into(), change }],
        );
        let anatomy = LinkedAnatomy { step: q.clone(), q, ..LinkedAnatomy::default() };
        let link =
            Link { seed, sensor: Some(sensor), tick, anatomy, script, digest: Some(digest.clone()), ..Link::default() };
        let query = link.query().unwrap();
        let read = Link::parse(&query).unwrap();
        assert_eq!(read, link);
        let of = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let q = &link.anatomy.q;
        assert_eq!([&read.anatomy.q, &read.anatomy.step].map(|all| of(all)), [of(q), of(q)], "zero has its sign too");
        assert_eq!(read.sensor.unwrap().max_range.to_bits(), sensor.max_range.to_bits());
        // by the other reader
        let fields = fields(&query);
        let text = |name: &str| fields.iter().find(|field| field.0 == name).unwrap().1.clone();
        for name in ["q", "step"] {
            let numbers: Vec<f64> = text(name).split(',').map(|x| x.parse().unwrap()).collect();
            assert_eq!(of(&numbers), of(q), "{name}");
        }
        assert_eq!((text("seed"), text("tick"), text("digest")), (seed.0.to_string(), tick.to_string(), digest));
        let (rays, range) = text("sensor").split_once(',').map(|(n, r)| (n.to_owned(), r.to_owned())).unwrap();
        assert_eq!((rays, range.parse()), (sensor.n_rays.to_string(), Ok(sensor.max_range)));
    }
}

#[test]
fn a_world_of_a_link_has_all_the_digits_of_its_file() {
    let mut draws = Stream::new(Seed(91), "digits of worlds");
    for _ in 0..40 {
        let mut world = built_in(&["lot"]).remove(0);
        let mut numbers = Vec::new();
        let mut number = |from: f64, to: f64| {
            let x = digits(&mut draws, from, to);
            numbers.push(x);
            x
        };
        world.bounds.max.x = number(20.0, 40.0);
        world.places[0].pose.x = number(1.0, 5.0);
        world.marks[0].points[0].y = number(1.0, 5.0);
        for x in &mut world.robots[0].start {
            *x = number(1.0, 3.0);
        }
        let config = TourConfig { worlds: vec![world.clone()], ticks: 1, sensor: None };
        let recipe = Recipe::new(config, Seed(1));
        let query = Link::of(&recipe).unwrap().query().unwrap();
        assert_eq!(Link::parse(&query).unwrap().recipe(), recipe);
        // by the other reader: all numbers of the text
        let file = fields(&query).into_iter().find(|field| field.0 == "file").unwrap().1;
        let words = file.split(|c: char| !(c.is_ascii_alphanumeric() || ".+-".contains(c)));
        let written: Vec<u64> = words.filter_map(|word| word.parse().ok()).map(f64::to_bits).collect();
        for x in &numbers {
            assert!(written.contains(&x.to_bits()), "{x} is not in {file}");
        }
    }
}

/// Long links have their inputs in few bytes, which hold all bits of them.
#[test]
fn inputs_in_few_bytes_have_all_their_digits() {
    let mut draws = Stream::new(Seed(92), "digits of inputs");
    let mut tick = 0;
    let events: Vec<Event> = (0..400)
        .map(|k: usize| {
            tick += draws.below(40);
            let mut unit = || Quantized(draws.below(1 << 36) as i64 - (1 << 35));
            let input = match k % 5 {
                0 => RobotInput::MoveTo(vec![unit(), unit()]),
                1 => RobotInput::Teleport(vec![unit(), unit()]),
                2 => RobotInput::Drive(-128, 127),
                3 => RobotInput::Drive(unit().0.rem_euclid(257) as i16 - 128, unit().0.rem_euclid(257) as i16 - 128),
                _ => RobotInput::SetTrailer(unit().0 % 2 == 0),
            };
            Event { tick: tick.max(1), robot: ["Reach", "Rusty", "Hitch"][k % 3].into(), input }
        })
        .collect();
    assert_eq!(inputs::decode(&inputs::encode(&events).unwrap()), Ok(events));
}
