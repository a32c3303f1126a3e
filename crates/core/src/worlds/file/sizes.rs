//! The sizes of a robot in a world file: read, completed by those of its kind, and printed.

use serde::{Deserialize, Deserializer};

use crate::configuration::{ArmSizes, CarSizes, DiscSizes, Sizes, SizesError, TrailerSizes, WrittenCoordinate};
use crate::geometry::Point2;

/// Reads a field that may be left out and is written without `Some`.
pub(super) fn given<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

/// The sizes of a robot as written, at most one of them.
pub(super) struct SizesText<'a> {
    pub disc: Option<&'a DiscText>,
    pub arm: Option<&'a ArmText>,
    pub car: Option<&'a CarText>,
}

/// A disc as written. A number that is left out is the kind's own, here and below.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DiscText {
    #[serde(default, deserialize_with = "given")]
    radius: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    track: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    wheel_radius: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ArmText {
    #[serde(default, deserialize_with = "given")]
    base: Option<(f64, f64)>,
    #[serde(default, deserialize_with = "given")]
    lengths: Option<Vec<f64>>,
    #[serde(default, deserialize_with = "given")]
    radius: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarText {
    #[serde(default, deserialize_with = "given")]
    wheelbase: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    length: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    width: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    rear_overhang: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) max_steer: Option<WrittenCoordinate>,
    #[serde(default, deserialize_with = "given")]
    pub(super) trailer: Option<TrailerText>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TrailerText {
    #[serde(default, deserialize_with = "given")]
    hitch_len: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    width: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    front_overhang: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    rear_overhang: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) jackknife: Option<WrittenCoordinate>,
}

/// The sizes that the text of a robot of this kind gives, checked; `None` where it gives none.
pub(super) fn make_sizes(kind: &str, text: &SizesText<'_>) -> Result<Option<Sizes>, SizesError> {
    let SizesText { disc, arm, car } = *text;
    let own = Sizes::of_kind(kind);
    let given = [disc.map(|_| "disc"), arm.map(|_| "arm"), car.map(|_| "car")];
    let strange = |field: &&str| own.as_ref().is_none_or(|own| own.field() != *field);
    if let Some(found) = given.into_iter().flatten().find(strange) {
        let kind = kind.to_owned();
        return Err(match own {
            Some(own) => SizesError::Kind { kind, found, expected: own.field() },
            None => SizesError::OwnKind { kind, found },
        });
    }
    let sizes = match (own, disc, arm, car) {
        (Some(Sizes::Disc(own)), Some(disc), ..) => Sizes::Disc(disc.over(&own)),
        (Some(Sizes::Arm(own)), _, Some(arm), _) => Sizes::Arm(arm.over(own)),
        (Some(Sizes::Car(own)), .., Some(car)) => Sizes::Car(car.over(&own)),
        _ => return Ok(None),
    };
    sizes.check_for(kind)?;
    Ok(Some(sizes))
}

/// The number given, a negative zero as a positive one, or the kind's own.
fn or(given: Option<f64>, own: f64) -> f64 {
    given.unwrap_or(own) + 0.0
}

impl DiscText {
    fn over(&self, own: &DiscSizes) -> DiscSizes {
        DiscSizes {
            radius: or(self.radius, own.radius),
            track: or(self.track, own.track),
            wheel_radius: or(self.wheel_radius, own.wheel_radius),
        }
    }
}

impl ArmText {
    fn over(&self, own: ArmSizes) -> ArmSizes {
        ArmSizes {
            base: self.base.map_or(own.base, |(x, y)| Point2::new(x + 0.0, y + 0.0)),
            lengths: self.lengths.clone().unwrap_or(own.lengths),
            radius: or(self.radius, own.radius),
        }
    }
}

impl CarText {
    fn over(&self, own: &CarSizes) -> CarSizes {
        CarSizes {
            wheelbase: or(self.wheelbase, own.wheelbase),
            length: or(self.length, own.length),
            width: or(self.width, own.width),
            rear_overhang: or(self.rear_overhang, own.rear_overhang),
            max_steer: or(self.max_steer.map(WrittenCoordinate::value), own.max_steer),
            trailer: self.trailer.as_ref().map_or(own.trailer, |trailer| trailer.over(&own.trailer)),
        }
    }
}

impl TrailerText {
    fn over(&self, own: &TrailerSizes) -> TrailerSizes {
        TrailerSizes {
            hitch_len: or(self.hitch_len, own.hitch_len),
            width: or(self.width, own.width),
            front_overhang: or(self.front_overhang, own.front_overhang),
            rear_overhang: or(self.rear_overhang, own.rear_overhang),
            jackknife: self.jackknife.map(WrittenCoordinate::value).or(own.jackknife),
        }
    }
}

/// Sizes as the field of a robot, every number written, after a comma; empty for none.
pub(super) fn sizes_text(sizes: Option<&Sizes>) -> String {
    let numbers = |fields: &[(&str, f64)]| {
        let texts: Vec<String> = fields.iter().map(|(name, value)| format!("{name}: {:?}", value + 0.0)).collect();
        texts.join(", ")
    };
    let inner = match sizes {
        None => return String::new(),
        Some(Sizes::Disc(DiscSizes { radius, track, wheel_radius })) => {
            numbers(&[("radius", *radius), ("track", *track), ("wheel_radius", *wheel_radius)])
        }
        Some(Sizes::Arm(ArmSizes { base, lengths, radius })) => {
            let base = format!("base: ({:?}, {:?})", base.x + 0.0, base.y + 0.0);
            format!("{base}, lengths: {lengths:?}, {}", numbers(&[("radius", *radius)]))
        }
        Some(Sizes::Car(car)) => {
            let chassis = numbers(&[
                ("wheelbase", car.wheelbase),
                ("length", car.length),
                ("width", car.width),
                ("rear_overhang", car.rear_overhang),
                ("max_steer", car.max_steer),
            ]);
            let trailer = numbers(&[
                ("hitch_len", car.trailer.hitch_len),
                ("width", car.trailer.width),
                ("front_overhang", car.trailer.front_overhang),
                ("rear_overhang", car.trailer.rear_overhang),
            ]);
            let limit = car.trailer.jackknife.map_or(String::new(), |limit| format!(", jackknife: {limit:?}"));
            format!("{chassis}, trailer: ({trailer}{limit})")
        }
    };
    format!(", {}: ({inner})", sizes.map_or("", Sizes::field))
}
