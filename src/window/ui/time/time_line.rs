//! The time line: where the run stands, a handle to any tick it has reached, and above it lanes of what happened. The
//! wheel shows less time or more; a thumb then says which part of the run it is.

use bevy_egui::egui::{
    Align2, Rect, Response, Sense, Shape, Slider, SliderClamping, Stroke, TextStyle, Ui, WidgetInfo, WidgetType, pos2,
    text::{LayoutJob, TextWrapping},
    vec2,
};

use super::span::{ShownSpan, TickSpan};
use super::way_out_sign::way_out_sign;
use crate::window::ui::{Command, Dashboard, FrameColours, SessionCommand, ShownChance};
use motion_lab_core::num::exp;
use motion_lab_core::picture::Role;
use motion_lab_sim::run::seconds;
use motion_lab_sim::simulation::{Happening, History, TickMark, TransportCommand};

/// Height of a lane, of a lane that is alone, and of the axis, points.
const LANE: f32 = 12.0;
const ONLY: f32 = 11.0;
const AXIS: f32 = 15.0;

/// Height of a narrow screen below which all robots share a lane, points.
const SHORT: f32 = 700.0;

/// Width of the names before the lanes, points: on a narrow screen the slider's large handle leaves them more.
const NAMES: f32 = 52.0;
const NARROW_NAMES: f32 = 24.0;

/// Number of robots up to which each has a lane.
const MAX_LANES: usize = 3;

/// Width of the strip of time in which contacts are counted together, points.
const BIN: f32 = 3.0;

/// Way of a finger up to which it is a tap, points.
const TAP: f32 = 6.0;

/// Least distance between two labels of the axis, points.
const APART: f32 = 64.0;

/// The span of time that the line shows, and where.
struct Scale {
    /// The lanes' rectangle, as wide as the way of the slider's handle.
    lanes: Rect,
    /// The ticks shown, the last included.
    span: TickSpan,
}

impl Scale {
    fn x(&self, tick: u64) -> f32 {
        let TickSpan { from, to } = self.span;
        let share = (tick as f64 - from as f64) / to.saturating_sub(from).max(1) as f64;
        self.lanes.left() + self.lanes.width() * share as f32
    }

    /// How far along the line this is, from 0 to 1.
    fn share(&self, x: f32) -> f32 {
        ((x - self.lanes.left()) / self.lanes.width()).clamp(0.0, 1.0)
    }

    /// The rectangle of a lane, of this many.
    fn lane(&self, lane: usize, lanes: usize) -> Rect {
        let height = self.lanes.height() / lanes.max(1) as f32;
        let top = self.lanes.top() + lane as f32 * height;
        Rect::from_x_y_ranges(self.lanes.x_range(), top..=top + height)
    }

    fn tick(&self, x: f32) -> u64 {
        let TickSpan { from, to } = self.span;
        from + (f64::from(self.share(x)) * to.saturating_sub(from) as f64).round() as u64
    }
}

struct Lane<'a> {
    /// The robot whose marks it has, if not those of all.
    robot: Option<u32>,
    name: &'a str,
}

impl Lane<'_> {
    /// The ticks at which something happened to its robots, in ascending order.
    fn of(&self, marks: &[TickMark], what: Happening) -> impl Iterator<Item = u64> {
        let robot = self.robot;
        let is_own = move |mark: &&TickMark| mark.what == what && robot.is_none_or(|id| id == mark.robot);
        marks.iter().filter(is_own).map(|mark| mark.tick)
    }
}

/// A lane for each robot; one for all where they are many.
fn lanes(model: &Dashboard) -> Vec<Lane<'_>> {
    let robots = || model.cockpits.iter().flat_map(|cockpit| &cockpit.robots);
    let has_crowd = model.cockpits.iter().any(|cockpit| cockpit.crowd.is_some());
    if has_crowd || robots().count() > MAX_LANES {
        return vec![Lane { robot: None, name: "" }];
    }
    robots().map(|robot| Lane { robot: Some(robot.id), name: &robot.name }).collect()
}

/// The time line of a run.
pub struct TimeLine<'a> {
    /// The run.
    pub model: &'a Dashboard,
    /// Its marks.
    pub history: &'a History,
    pub look: &'a FrameColours,
    /// Whether the wheel zooms.
    pub wheel: bool,
    /// The last chance to avoid a contact, if one was asked about.
    pub chance: Option<&'a ShownChance>,
}

impl TimeLine<'_> {
    /// Shows the line over the whole width, of the ticks `shown`, or of all. Clicking and dragging seek; so do the
    /// arrow keys while it has the focus.
    pub fn show(&self, ui: &mut Ui, shown: &mut ShownSpan, commands: &mut Vec<Command>) {
        let TimeLine { model, history, look, wheel, chance } = *self;
        let end = model.frontier.max(model.tick);
        let span = shown.follow(model.tick, end, model.playing);
        // a low screen has one lane for all
        let is_short = look.narrow && ui.ctx().content_rect().height() < SHORT;
        let lanes = if is_short { vec![Lane { robot: None, name: "" }] } else { lanes(model) };
        let height = if lanes.len() == 1 { ONLY } else { LANE } * lanes.len() as f32;
        let names = match lanes.len() {
            0 | 1 => 0.0,
            _ if look.narrow => NARROW_NAMES,
            _ => NAMES,
        };
        let (strip, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
        let mut tick = model.tick;
        let response = ui
            .horizontal(|ui| {
                ui.add_space(names);
                ui.spacing_mut().slider_width = ui.available_width();
                let line = Slider::new(&mut tick, span.from..=span.to.max(span.from + 1))
                    .show_value(false)
                    .trailing_fill(true)
                    // out of sight, the tick is still what the arrow keys go on from
                    .clamping(SliderClamping::Never)
                    .step_by(1.0);
                ui.add_enabled(end > 0, line)
            })
            .inner;
        response.widget_info(|| WidgetInfo::slider(end > 0, model.tick as f64, "time line, in ticks"));
        // the slider's handle keeps off the ends by its radius
        let across = response.rect.x_range().shrink(response.rect.height() / 2.5);
        let scale = Scale { lanes: Rect::from_x_y_ranges(across, strip.y_range()), span };
        zoom(ui, &scale, end, wheel, shown);
        show_lanes(ui, model, history.marks(), &lanes, &scale, look, commands);
        if let Some(chance) = chance
            && let Some(lane) = lanes.iter().position(|lane| lane.robot.is_none_or(|id| id == chance.robot))
            && way_out_sign(ui, chance, scale.lane(lane, lanes.len()), |tick| scale.x(tick), look)
        {
            commands.push(Command::Session(SessionCommand::PlayWayOut));
        }
        axis(ui, &scale, look);
        out_of_sight(ui, &scale, model.tick, response.rect, look);
        if response.changed() && tick.min(end) != model.tick && is_meant(ui) {
            commands.push(Command::from(TransportCommand::Seek(tick.min(end))));
        }
    }
}

/// Shows an arrow in place of the handle where the present tick is before or after what is shown.
fn out_of_sight(ui: &Ui, scale: &Scale, tick: u64, line: Rect, look: &FrameColours) {
    if scale.span.holds(tick) {
        return;
    }
    let (x, way) = if tick < scale.span.from { (line.left(), 1.0) } else { (line.right(), -1.0) };
    let (tip, half) = (pos2(x, line.center().y), 0.5 * line.height());
    let handle = Rect::from_two_pos(tip - vec2(2.0 * way, half), tip + vec2(way * line.height(), half));
    ui.painter().rect_filled(handle, 0.0, look.colour(Role::Paper));
    let corners = vec![tip, tip + vec2(way * half, -0.7 * half), tip + vec2(way * half, 0.7 * half)];
    ui.painter().add(Shape::convex_polygon(corners, look.colour(Role::Text), Stroke::NONE));
}

/// Whether a change of the time line is to seek: a finger that goes up or down wants to scroll, and one that has not
/// moved yet may still.
fn is_meant(ui: &Ui) -> bool {
    ui.input(|i| {
        let moved = i.pointer.press_origin().zip(i.pointer.latest_pos()).map(|(from, to)| to - from);
        let is_sideways = moved.is_some_and(|by| by.x.abs() > TAP && by.x.abs() > by.y.abs());
        let is_by_finger = i.has_touch_screen() && (i.pointer.any_down() || i.pointer.any_released());
        !is_by_finger || i.pointer.any_click() || is_sideways
    })
}

/// Shows less time or more as the wheel turns over the lanes; what is under the pointer stays there. Where not all of
/// the run is shown, a thumb over the lanes says which part of it is.
fn zoom(ui: &mut Ui, scale: &Scale, end: u64, wheel: bool, shown: &mut ShownSpan) {
    let over = scale.lanes.expand2(vec2(0.0, 4.0));
    // a list that is open over the lanes keeps the wheel
    if let Some(at) = ui.input(|i| i.pointer.hover_pos()).filter(|_| ui.rect_contains_pointer(over)) {
        let fingers = ui.input(|i| i.zoom_delta());
        let wheel = if wheel { ui.input_mut(|i| std::mem::take(&mut i.smooth_scroll_delta.y)) } else { 0.0 };
        let factor = f64::from(fingers) * exp(f64::from(wheel) / 240.0);
        if factor != 1.0 {
            shown.zoom(scale.span, f64::from(scale.share(at.x)), factor, end);
        }
    }
    if scale.span != (TickSpan { from: 0, to: end }) {
        let whole = Scale { lanes: scale.lanes, span: TickSpan { from: 0, to: end } };
        let top = scale.lanes.top() - 3.0;
        let thumb = Rect::from_x_y_ranges(whole.x(scale.span.from)..=whole.x(scale.span.to), top..=top + 3.0);
        ui.painter().hline(scale.lanes.x_range(), top + 1.5, Stroke::new(1.0, ui.visuals().weak_text_color()));
        ui.painter().rect_filled(thumb, 0.0, ui.visuals().text_color());
    }
}

/// Shows the lanes with their names. A click goes to the mark that is pointed at, else to the time.
fn show_lanes(
    ui: &mut Ui,
    model: &Dashboard,
    marks: &[TickMark],
    lanes: &[Lane<'_>],
    scale: &Scale,
    look: &FrameColours,
    commands: &mut Vec<Command>,
) {
    let height = scale.lanes.height() / lanes.len().max(1) as f32;
    for (k, lane) in lanes.iter().enumerate() {
        let rect = scale.lane(k, lanes.len());
        if lanes.len() > 1 {
            let gap = if look.narrow { 6.0 } else { 12.0 };
            let across = ui.max_rect().left()..=rect.left() - gap;
            name(ui, lane.name, Rect::from_x_y_ranges(across, rect.y_range()), look);
        }
        ui.painter().hline(rect.x_range(), rect.center().y, Stroke::new(1.0, look.colour(Role::Hairline)));
        contacts(ui, lane.of(marks, Happening::Contact), rect, scale, look);
        takeovers(ui, lane.of(marks, Happening::Takeover), rect, scale, look);
    }
    // one response for all marks, whatever their number
    let response = ui.interact(scale.lanes, ui.id().with("marks"), Sense::click());
    response.widget_info(|| {
        let contacts = marks.iter().filter(|m| m.what == Happening::Contact).count();
        let counted = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let (contacts, takeovers) = (counted(contacts, "contact"), counted(marks.len() - contacts, "takeover"));
        let words = format!("{contacts} and {takeovers} so far: a click goes to one");
        WidgetInfo::labeled(WidgetType::Button, true, words)
    });
    let Some(pointer) = response.hover_pos() else { return };
    let lane = lanes.get(((pointer.y - scale.lanes.top()) / height) as usize);
    let own = marks.iter().filter(|mark| lane.and_then(|lane| lane.robot).is_none_or(|id| id == mark.robot));
    let off = |mark: &&TickMark| (scale.x(mark.tick) - pointer.x).abs();
    let nearest = own.min_by(|a, b| off(a).total_cmp(&off(b))).filter(|mark| off(mark) < 6.0);
    let to = nearest.map_or_else(|| scale.tick(pointer.x), |mark| mark.tick);
    if response.clicked() && scale.span.to > 0 {
        commands.push(Command::from(TransportCommand::Seek(to)));
    }
    say(response, model, nearest, to);
}

/// Shows the name of a lane at the right end of `room`. One that is too long ends in an ellipsis, and is said in whole
/// on hover.
fn name(ui: &Ui, name: &str, room: Rect, look: &FrameColours) {
    let (font, colour) = (TextStyle::Small.resolve(ui.style()), look.colour(Role::Muted));
    let mut job = LayoutJob::simple_singleline(name.to_owned(), font, colour);
    job.wrap = TextWrapping::truncate_at_width(room.width());
    let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let at = Align2::RIGHT_CENTER.align_size_within_rect(galley.size(), room);
    if galley.elided {
        ui.interact(room, ui.id().with(("lane", name)), Sense::hover()).on_hover_text(name);
    }
    ui.painter().galley(at.min, galley, colour);
}

/// Says what happened at a mark, or only when it is.
fn say(response: Response, model: &Dashboard, mark: Option<&TickMark>, tick: u64) {
    let when = format!("{:.2} s, tick {tick}", seconds(tick));
    let words = match mark {
        None => when,
        Some(mark) => {
            let name = model.name_of(mark.robot).unwrap_or("a robot");
            match mark.what {
                Happening::Contact => format!("{when}: {name} touches something"),
                Happening::Takeover => format!("{when}: {name} is taken over"),
            }
        }
    };
    response.on_hover_text_at_pointer(words);
}

/// Shows contacts as ticks where they are few; where several fall together, the more there are, the stronger.
fn contacts(ui: &Ui, ticks: impl Iterator<Item = u64>, lane: Rect, scale: &Scale, look: &FrameColours) {
    let ticks = ticks.filter(|tick| scale.span.holds(*tick));
    let counts = binned(ticks.map(|tick| scale.x(tick) - lane.left()), lane.width());
    let most = counts.iter().copied().max().unwrap_or(1);
    for (bin, count) in counts.into_iter().enumerate().filter(|(_, count)| *count > 0) {
        let x = lane.left() + BIN * bin as f32;
        let bar = Rect::from_x_y_ranges(x..=x + 2.0, lane.shrink2(vec2(0.0, 1.0)).y_range());
        let strength = if most == 1 { 1.0 } else { 0.35 + 0.65 * f64::from(count) / f64::from(most) };
        ui.painter().rect_filled(bar, 0.0, look.tint(Role::Goal, strength));
    }
}

/// How much falls into each bin of a row of some width.
fn binned(xs: impl Iterator<Item = f32>, width: f32) -> Vec<u32> {
    let mut counts = vec![0; (width / BIN).max(0.0) as usize + 1];
    let last = counts.len() - 1;
    for x in xs {
        counts[((x / BIN).max(0.0) as usize).min(last)] += 1;
    }
    counts
}

/// Shows takeovers as diamonds, at least five points apart.
fn takeovers(ui: &Ui, ticks: impl Iterator<Item = u64>, lane: Rect, scale: &Scale, look: &FrameColours) {
    let mut last = f32::NEG_INFINITY;
    for tick in ticks.filter(|tick| scale.span.holds(*tick)) {
        let at = pos2(scale.x(tick), lane.center().y);
        if at.x - last < 5.0 {
            continue;
        }
        last = at.x;
        let corners = [vec2(0.0, -4.5), vec2(4.5, 0.0), vec2(0.0, 4.5), vec2(-4.5, 0.0)].map(|d| at + d);
        ui.painter().add(Shape::convex_polygon(corners.to_vec(), look.colour(Role::Focus), Stroke::NONE));
    }
}

/// Shows the axis in seconds.
fn axis(ui: &mut Ui, scale: &Scale, look: &FrameColours) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), AXIS), Sense::hover());
    let font = TextStyle::Small.resolve(ui.style());
    let (from, to, width) = (seconds(scale.span.from), seconds(scale.span.to), scale.lanes.width());
    let step = step_of(to - from, width);
    let first = (from / step).ceil() as u64;
    for k in first..=(to / step).floor() as u64 {
        let x = scale.lanes.left() + width * ((k as f64 * step - from) / (to - from)) as f32;
        let colour = look.colour(Role::Muted);
        ui.painter().vline(x, rect.top()..=rect.top() + 3.0, Stroke::new(1.0, colour));
        let unit = if k == first { " s" } else { "" };
        let label = format!("{}{unit}", shortest(k as f64 * step));
        ui.painter().text(pos2(x, rect.top() + 3.0), Align2::CENTER_TOP, label, font.clone(), colour);
    }
}

/// The distance of the axis's labels, seconds: 1, 2 or 5 times a power of ten, or 15, 30 and 60 s and their multiples,
/// such that they stand apart.
fn step_of(whole: f64, width: f32) -> f64 {
    const STEPS: [f64; 19] = [
        0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1200.0, 1800.0, 3600.0,
        7200.0, 18000.0,
    ];
    let is_apart = |step: &f64| *step / whole * f64::from(width) >= f64::from(APART);
    STEPS.into_iter().find(is_apart).unwrap_or(whole)
}

/// A number of seconds without needless digits.
fn shortest(seconds: f64) -> String {
    let text = format!("{seconds:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests;
