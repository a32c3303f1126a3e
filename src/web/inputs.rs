//! The inputs of a script in few bytes, for addresses.
//!
//! All numbers are LEB128: seven bits a byte, the lowest first, the eighth bit set on all but the last. Signed ones are
//! zigzag: 0, -1, 1, -2, .. as 0, 1, 2, 3, .. First come the robots' names: their number, then each one's length in
//! bytes and its UTF-8. Then come the inputs: the ticks since the input before, eight times the robot's number plus the
//! kind, and what the kind needs:
//!
//! | kind | input | what follows |
//! |---|---|---|
//! | 0 | `Drive`, both channels above -128 | a byte for each channel: the channel plus 127 |
//! | 1 | `Drive` | two signed numbers |
//! | 2, 3 | `MoveTo`, `Teleport` | the number of coordinates; of each the signed difference to the robot's last one |
//! | 4, 5 | `SetTrailer`: on, off | |
//! | 6 | `Release` | |
//!
//! The bytes are written in the URL's own base 64 (RFC 4648, section 5), without padding.

use base64::prelude::{BASE64_URL_SAFE_NO_PAD, Engine};

use motion_lab_sim::run::{Event, Quantized, RobotInput};

/// Largest length of a robot's name, bytes: every input has it again once it is read.
const MAX_NAME: u64 = 200;

/// The inputs as text; `None` where their ticks go back, which no script that runs has, or a robot's name is too long.
pub fn encode(events: &[Event]) -> Option<String> {
    let mut names: Vec<&str> = Vec::new();
    for event in events {
        if event.robot.len() as u64 > MAX_NAME {
            return None;
        }
        if !names.contains(&event.robot.as_str()) {
            names.push(&event.robot);
        }
    }
    let mut out = Vec::new();
    put(&mut out, names.len() as u64);
    for name in &names {
        put(&mut out, name.len() as u64);
        out.extend_from_slice(name.as_bytes());
    }
    let (mut tick, mut last) = (0, vec![Vec::new(); names.len()]);
    for event in events {
        let robot = names.iter().position(|name| *name == event.robot)?;
        put(&mut out, event.tick.checked_sub(tick)?);
        tick = event.tick;
        let kind = |out: &mut Vec<u8>, kind: u64| put(out, 8 * robot as u64 + kind);
        match &event.input {
            RobotInput::Drive(a, b) => match [a, b].map(|channel| u8::try_from(channel.saturating_add(127))) {
                [Ok(a), Ok(b)] => {
                    kind(&mut out, 0);
                    out.extend([a, b]);
                }
                _ => {
                    kind(&mut out, 1);
                    [a, b].into_iter().for_each(|channel| put(&mut out, zigzag(i64::from(*channel))));
                }
            },
            RobotInput::MoveTo(to) => {
                kind(&mut out, 2);
                put_place(&mut out, &mut last[robot], to);
            }
            RobotInput::Teleport(to) => {
                kind(&mut out, 3);
                put_place(&mut out, &mut last[robot], to);
            }
            RobotInput::SetTrailer(on) => kind(&mut out, if *on { 4 } else { 5 }),
            RobotInput::Release => kind(&mut out, 6),
        }
    }
    Some(BASE64_URL_SAFE_NO_PAD.encode(out))
}

/// The inputs that a text holds; else the number of the byte, from 0, at which it makes no sense.
pub fn decode(text: &str) -> Result<Vec<Event>, usize> {
    let bytes = BASE64_URL_SAFE_NO_PAD.decode(text).map_err(|_| 0_usize)?;
    let mut rest = Reader { bytes: &bytes, at: 0 };
    rest.events().ok_or(rest.at)
}

fn put(out: &mut Vec<u8>, mut number: u64) {
    while number > 127 {
        out.push(number as u8 | 128);
        number >>= 7;
    }
    out.push(number as u8);
}

fn put_place(out: &mut Vec<u8>, last: &mut Vec<i64>, to: &[Quantized]) {
    put(out, to.len() as u64);
    last.resize(to.len(), 0);
    for (last, Quantized(x)) in last.iter_mut().zip(to) {
        put(out, zigzag(x.wrapping_sub(*last)));
        *last = *x;
    }
}

const fn zigzag(number: i64) -> u64 {
    ((number << 1) ^ (number >> 63)) as u64
}

const fn unzigzag(number: u64) -> i64 {
    (number >> 1) as i64 ^ -((number & 1) as i64)
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    fn events(&mut self) -> Option<Vec<Event>> {
        let names: Vec<&str> = self.list(|rest| {
            let length = rest.number().filter(|length| *length <= MAX_NAME)?;
            std::str::from_utf8(rest.take(length)?).ok()
        })?;
        let (mut tick, mut last, mut events) = (0_u64, vec![Vec::new(); names.len()], Vec::new());
        while self.at < self.bytes.len() {
            tick = tick.checked_add(self.number()?)?;
            let head = self.number()?;
            let robot = usize::try_from(head / 8).ok()?;
            let (name, last) = (names.get(robot)?, last.get_mut(robot)?);
            let input = match head % 8 {
                0 => RobotInput::Drive(i16::from(self.byte()?) - 127, i16::from(self.byte()?) - 127),
                1 => RobotInput::Drive(self.channel()?, self.channel()?),
                2 => RobotInput::MoveTo(self.place(last)?),
                3 => RobotInput::Teleport(self.place(last)?),
                4 => RobotInput::SetTrailer(true),
                5 => RobotInput::SetTrailer(false),
                6 => RobotInput::Release,
                _ => return None,
            };
            events.push(Event { tick, robot: (*name).to_owned(), input });
        }
        Some(events)
    }

    /// A list: its length, then its items, of a byte or more each.
    fn list<T>(&mut self, mut item: impl FnMut(&mut Self) -> Option<T>) -> Option<Vec<T>> {
        let length = self.number()?;
        if length > (self.bytes.len() - self.at) as u64 {
            return None;
        }
        (0..length).map(|_| item(self)).collect()
    }

    fn place(&mut self, last: &mut Vec<i64>) -> Option<Vec<Quantized>> {
        let steps = self.list(|rest| rest.number().map(unzigzag))?;
        last.resize(steps.len(), 0);
        last.iter_mut().zip(steps).for_each(|(last, step)| *last = last.wrapping_add(step));
        Some(last.iter().map(|x| Quantized(*x)).collect())
    }

    fn channel(&mut self) -> Option<i16> {
        i16::try_from(unzigzag(self.number()?)).ok()
    }

    fn byte(&mut self) -> Option<u8> {
        let byte = *self.bytes.get(self.at)?;
        self.at += 1;
        Some(byte)
    }

    fn take(&mut self, length: u64) -> Option<&'a [u8]> {
        let end = self.at.checked_add(usize::try_from(length).ok()?)?;
        let taken = self.bytes.get(self.at..end)?;
        self.at = end;
        Some(taken)
    }

    fn number(&mut self) -> Option<u64> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            let bits = u64::from(byte & 127);
            if bits << shift >> shift != bits {
                return None;
            }
            number |= bits << shift;
            if byte < 128 {
                return Some(number);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(tick: u64, robot: &str, input: RobotInput) -> Event {
        Event { tick, robot: robot.into(), input }
    }

    fn bytes(events: &[Event]) -> Vec<u8> {
        BASE64_URL_SAFE_NO_PAD.decode(encode(events).unwrap()).unwrap()
    }

    #[test]
    fn the_bytes_are_the_documented_ones() {
        let place = |x, y| vec![Quantized(x), Quantized(y)];
        let events = [
            event(1, "R", RobotInput::Drive(128, -127)),
            event(1, "é", RobotInput::MoveTo(place(64, -1))),
            event(301, "é", RobotInput::Teleport(place(63, 127))),
            event(301, "R", RobotInput::Drive(-128, 0)),
            event(302, "R", RobotInput::SetTrailer(true)),
            event(302, "R", RobotInput::SetTrailer(false)),
            event(302, "R", RobotInput::Release),
        ];
        let names = [2, 1, b'R', 2, 0xc3, 0xa9];
        let first = [1, 0, 255, 0];
        // 300 = 2 * 128 + 44; from (64, -1) to (63, 127) it is -1 and 128, zigzag 1 and 256
        let places = [0, 10, 2, 128, 1, 1, 172, 2, 11, 2, 1, 128, 2];
        let rest = [0, 1, 255, 1, 0, 1, 4, 0, 5, 0, 6];
        assert_eq!(bytes(&events), [&names[..], &first, &places, &rest].concat());
        assert_eq!(decode(&encode(&events).unwrap()).unwrap(), events);
    }

    #[test]
    fn the_extremes_come_back_as_they_went() {
        let far = vec![Quantized(i64::MAX), Quantized(i64::MIN), Quantized(0)];
        let events = [
            event(0, "", RobotInput::MoveTo(far.clone())),
            event(7, "", RobotInput::Teleport(vec![])),
            event(u64::MAX, "", RobotInput::MoveTo(far.into_iter().rev().collect())),
            event(u64::MAX, "", RobotInput::Drive(i16::MIN, i16::MAX)),
        ];
        assert_eq!(decode(&encode(&events).unwrap()).unwrap(), events);
        assert_eq!(decode(&encode(&[]).unwrap()).unwrap(), []);
        assert_eq!(encode(&[event(2, "", RobotInput::Release), event(1, "", RobotInput::Release)]), None);
        let named = |length| [event(1, &"R".repeat(length), RobotInput::Release)];
        assert_eq!((decode(&encode(&named(200)).unwrap()).unwrap(), encode(&named(201))), (named(200).into(), None));
    }

    #[test]
    fn bytes_that_make_no_sense_are_refused_where_they_do_not() {
        let at = |bytes: &[u8]| decode(&BASE64_URL_SAFE_NO_PAD.encode(bytes)).unwrap_err();
        assert_eq!(decode("%").unwrap_err(), 0, "no base 64");
        assert_eq!(at(&[]), 0);
        assert_eq!(at(&[1]), 1, "a name is missing");
        assert_eq!(at(&[1, 2, b'R']), 2, "it is cut");
        assert_eq!(at(&[1, 1, 0xff]), 3, "no UTF-8");
        assert_eq!(at(&[&[1, 201, 1][..], &[b'R'; 201]].concat()), 3, "a name too long");
        assert_eq!(at(&[1, 1, b'R', 1, 7]), 5, "no kind");
        assert_eq!(at(&[1, 1, b'R', 1, 8]), 5, "no second robot");
        assert_eq!(at(&[1, 1, b'R', 1, 0, 9]), 6, "one channel");
        assert_eq!(at(&[1, 1, b'R', 1, 1, 128, 128, 4, 0]), 8, "65536 zigzag is 32768, beyond 16 bits");
        assert_eq!(at(&[1, 1, b'R', 1, 2, 255, 255, 3, 0]), 8, "more coordinates than bytes");
        let too_large = [&[1, 1, b'R'][..], &[255; 9], &[2]].concat();
        assert_eq!(at(&too_large), 13, "2^64 and more");
        let beyond = [&[1, 1, b'R'][..], &[255; 9], &[1, 6], &[1, 6]].concat();
        assert_eq!(at(&beyond), 15, "a tick beyond the last");
    }
}
