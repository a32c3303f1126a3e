//! Checks the routes of a world, and the robots that follow them.

use std::collections::BTreeMap;

use super::description::{RobotText, RouteText};
use super::items::{Budget, make_point};
use crate::configuration::{CarSizes, RobotKind, Sizes};
use crate::num;
use crate::worlds::{Resident, Route, WorldProblem};

/// The radii of the routes' corners, metres, by the routes' names.
pub(super) type Radii<'a> = BTreeMap<&'a str, f64>;

pub(super) fn make_route(text: &RouteText, budget: &mut Budget) -> Result<Route, WorldProblem> {
    budget.spend_corners_of_routes(text.points.len())?;
    let points = text.points.iter().map(|&xy| make_point(xy)).collect::<Result<_, _>>()?;
    let route = Route { name: text.name.clone(), points, radius: text.radius, speed: text.speed };
    route.path()?;
    Ok(route)
}

/// Gives a resident its route. It must be one that it can follow.
pub(super) fn routed(resident: Resident, text: &RobotText, radii: &Radii<'_>) -> Result<Resident, WorldProblem> {
    let Some(name) = &text.route else { return Ok(resident) };
    let kind = RobotKind::of(&resident.kind);
    if kind.is_some_and(|known| !known.drives) {
        return Err(WorldProblem::NotRouted(resident.kind));
    }
    let Some(&radius) = radii.get(name.as_str()) else {
        return Err(WorldProblem::NoSuchRoute(name.clone()));
    };
    let sizes = resident.sizes.clone().or_else(|| Sizes::of_kind(&resident.kind));
    if let Some(Sizes::Car(CarSizes { wheelbase, max_steer, .. })) = sizes {
        let least = wheelbase / num::tan(max_steer);
        if radius < least {
            return Err(WorldProblem::TightRoute { route: name.clone(), radius, least });
        }
    }
    Ok(Resident { route: Some(name.clone()), ..resident })
}
