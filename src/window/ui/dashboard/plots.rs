//! Plots of the run's history, with a cursor at the present tick.

use bevy_egui::egui::{FontId, Rangef, RichText, ScrollArea, TextStyle, TextWrapMode, Ui};
use egui_plot::{AxisHints, GridMark, Line, LineStyle, Plot, PlotPoints, VLine};

use crate::window::ui::{Command, Dashboard, FrameColours, UiState};
use motion_lab_core::configuration::RobotKind;
use motion_lab_core::picture::Role;
use motion_lab_sim::run::DT;
use motion_lab_sim::simulation::{History, Trail, TransportCommand};

/// Largest number of points of a line.
const POINTS: usize = 400;

/// Least height of a plot with its axis, points: three numbers fit beside it.
const MIN_HEIGHT: f32 = 96.0;

/// Height of a plot's title, points.
const ROW: f32 = 20.0;

/// Size of the numbers at the axes, points.
const TICK_SIZE: f32 = 10.0;

/// A line of a plot: which robots it is drawn for, its name, its value.
struct Channel {
    /// Whether it has a line for robots of a kind.
    shows: fn(&RobotKind) -> bool,
    name: &'static str,
    value: fn(&Trail) -> Option<f64>,
}

/// The value of a line.
#[derive(Clone, Copy)]
enum PlotValue {
    Of(fn(&Trail) -> Option<f64>),
    /// A coordinate of the configuration.
    Coordinate(usize),
}

impl PlotValue {
    fn of(self, trail: &Trail) -> Option<f64> {
        match self {
            PlotValue::Of(value) => value(trail),
            PlotValue::Coordinate(i) => trail.coordinates.get(i).copied(),
        }
    }
}

struct Graph {
    title: &'static str,
    /// Whether its values are angles in (-pi, pi].
    wraps: bool,
    channels: &'static [Channel],
    /// Whether it also has a line for each angle of robots of a kind, under the coordinate's name.
    angles: fn(&RobotKind) -> bool,
}

const GRAPHS: [Graph; 4] = [
    Graph {
        title: "Distance to the nearest obstacle, m",
        wraps: false,
        channels: &[Channel { shows: |_| true, name: "", value: |t| Some(t.clearance).filter(|c| c.is_finite()) }],
        angles: |_| false,
    },
    Graph { title: "Headings, rad", wraps: true, channels: &[], angles: |k| !k.is_arm() },
    Graph {
        title: "Encoders against true travel, m",
        wraps: false,
        channels: &[
            Channel { shows: |k| k.has_encoders, name: "encoders", value: |t| t.encoders },
            Channel { shows: |k| k.has_encoders, name: "true", value: |t| Some(t.travelled) },
        ],
        angles: |_| false,
    },
    Graph { title: "Joint angles, rad", wraps: true, channels: &[], angles: RobotKind::is_arm },
];

/// The pieces of a line, which is broken where an angle wraps.
fn unbroken(points: &[[f64; 2]], wraps: bool) -> impl Iterator<Item = &[[f64; 2]]> {
    points.chunk_by(move |a, b| !wraps || (b[1] - a[1]).abs() < std::f64::consts::PI)
}

/// The colour and the dash of a line. Lines differ in both.
fn line_of(number: usize, look: &FrameColours) -> (bevy_egui::egui::Color32, LineStyle) {
    match number % 4 {
        0 => (look.colour(Role::Robot), LineStyle::Solid),
        1 => (look.colour(Role::Witness), LineStyle::Dashed { length: 6.0 }),
        2 => (look.colour(Role::Free), LineStyle::Dashed { length: 2.5 }),
        _ => (look.colour(Role::Path), LineStyle::Dashed { length: 12.0 }),
    }
}

/// Shows the titles of all plots one under the other, each with a check box, and under it the plot if it is chosen. A
/// click on a plot goes to that time.
pub fn plots(
    ui: &mut Ui,
    model: &Dashboard,
    history: &History,
    look: &FrameColours,
    state: &mut UiState,
    commands: &mut Vec<Command>,
) {
    ui.spacing_mut().interact_size.y = ROW;
    let shown = (0..GRAPHS.len()).filter(|i| !state.hidden_plots.contains(i)).count();
    let titles = (ROW + ui.spacing().item_spacing.y) * GRAPHS.len() as f32;
    let room = ui.max_rect().bottom() - ui.cursor().top() - titles;
    // the names of its lines take up to two rows
    let names = 2.0 * ui.text_style_height(&TextStyle::Small) + 12.0;
    let height = (room / shown.max(1) as f32 - names).clamp(MIN_HEIGHT, 260.0);
    // where not all fit, none is cut
    ScrollArea::vertical().id_salt("plots").auto_shrink(false).show(ui, |ui| {
        for (i, graph) in GRAPHS.iter().enumerate() {
            let mut on = !state.hidden_plots.contains(&i);
            if ui.checkbox(&mut on, RichText::new(graph.title).small()).changed() {
                state.hidden_plots.retain(|hidden| *hidden != i);
                if !on {
                    state.hidden_plots.push(i);
                }
            }
            if on {
                legend(ui, graph, model, look);
                plot(ui, graph, height, model, history, look, commands);
            }
        }
    });
}

/// The lines of a plot: the id of the robot, its name with the channel's or the coordinate's, and the value.
fn lines<'a>(graph: &'a Graph, model: &'a Dashboard) -> impl Iterator<Item = (u32, String, PlotValue)> {
    let robots = || model.cockpits.iter().flat_map(|c| &c.robots).map(|r| (r.id, r));
    let channels = graph.channels.iter().flat_map(move |channel| {
        // a kind without a description has the lines of every robot
        let of = robots().filter(move |(_, r)| r.about.map_or(channel.name.is_empty(), channel.shows));
        of.map(|(id, r)| (id, format!("{} {}", r.name, channel.name).trim().to_owned(), PlotValue::Of(channel.value)))
    });
    let described = move || robots().filter_map(|(id, r)| Some((id, r, r.about.filter(|k| (graph.angles)(k))?)));
    let most = described().map(|(_, _, kind)| kind.coordinates.len()).max().unwrap_or(0);
    let angles = (0..most).flat_map(move |i| {
        let of = described().filter(move |(_, _, kind)| i >= kind.lengths);
        of.filter_map(move |(id, r, kind)| {
            Some((id, format!("{} {}", r.name, kind.coordinates.get(i)?), PlotValue::Coordinate(i)))
        })
    });
    channels.chain(angles)
}

/// Shows the names of a plot's lines, each with its colour and dash.
fn legend(ui: &mut Ui, graph: &Graph, model: &Dashboard, look: &FrameColours) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().interact_size.y = ui.text_style_height(&TextStyle::Small);
        ui.spacing_mut().item_spacing.x = 6.0;
        // a name goes to the next row as a whole
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        for (number, (_, name, _)) in lines(graph, model).enumerate() {
            let (colour, style) = line_of(number, look);
            let dash = match style {
                LineStyle::Solid => "\u{2014}",
                LineStyle::Dashed { length } if length < 4.0 => "\u{b7}\u{b7}\u{b7}",
                _ => "- -",
            };
            ui.label(RichText::new(format!("{dash} {name}")).small().color(colour));
        }
    });
}

/// Marks of an axis from `least` to `most`: at least three and at most six, at multiples of 1, 2, 2.5 or 5 times a
/// power of ten.
fn marks(least: f64, most: f64) -> Vec<GridMark> {
    let multiples = |step: f64| ((least / step).ceil(), (most / step).floor());
    let powers = [1e6, 1e5, 1e4, 1e3, 100.0, 10.0, 1.0, 0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6];
    let mut steps = powers.into_iter().flat_map(|power| [5.0, 2.5, 2.0, 1.0].map(|times| times * power));
    let is_fine = |step: &f64| {
        let (first, last) = multiples(*step);
        last - first >= 2.0 && last - first < 100.0
    };
    let Some(step_size) = steps.find(is_fine) else { return vec![] };
    let (first, last) = multiples(step_size);
    let count = (last - first) as usize;
    (0..=count).map(|i| GridMark { value: (first + i as f64) * step_size, step_size }).collect()
}

/// The number at a mark, with the decimals that its step needs.
fn number(mark: &GridMark) -> String {
    let is_whole = |decimals: &usize| {
        let scaled = [1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6][*decimals] * mark.step_size;
        (scaled - scaled.round()).abs() < 1e-6 * scaled
    };
    let decimals = (0..6).find(is_whole).unwrap_or(6);
    format!("{:.decimals$}", mark.value + 0.0).replace('-', "\u{2212}")
}

fn plot(
    ui: &mut Ui,
    graph: &Graph,
    height: f32,
    model: &Dashboard,
    history: &History,
    look: &FrameColours,
    commands: &mut Vec<Command>,
) {
    let end = DT * model.frontier.max(1) as f64;
    let axis = |hints: AxisHints<'static>, least: f32, unit: &'static str| {
        hints
            .formatter(move |mark, _| number(&mark) + unit)
            .label_spacing(Rangef::new(least, least + 1.0))
            .tick_label_font(FontId::proportional(TICK_SIZE))
            .tick_label_color(look.colour(Role::Muted))
    };
    let response = Plot::new(graph.title)
        .custom_x_axes(vec![axis(AxisHints::new_x(), 24.0, " s")])
        .custom_y_axes(vec![axis(AxisHints::new_y(), 6.0, "")])
        .x_grid_spacer(|input| marks(input.bounds.0, input.bounds.1))
        .y_grid_spacer(|input| marks(input.bounds.0, input.bounds.1))
        .height(height)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .show_x(false)
        .include_x(0.0)
        .include_x(end)
        .y_axis_min_width(28.0)
        .show(ui, |plot| {
            for (number, (id, name, value)) in lines(graph, model).enumerate() {
                let samples = history.series(id, POINTS, |trail| value.of(trail)).into_iter();
                let points: Vec<[f64; 2]> = samples.map(|(tick, value)| [DT * tick as f64, value]).collect();
                let (colour, style) = line_of(number, look);
                for piece in unbroken(&points, graph.wraps) {
                    let piece = PlotPoints::from(piece.to_vec());
                    plot.line(Line::new(name.clone(), piece).color(colour).style(style).width(1.25));
                }
            }
            let cursor = VLine::new("", DT * model.tick as f64).color(look.colour(Role::Focus)).width(1.5);
            plot.vline(cursor);
            plot.pointer_coordinate().map(|p| p.x)
        });
    let pressed = response.response.clicked() || response.response.dragged();
    if let Some(seconds) = response.inner.filter(|_| pressed) {
        let tick = (seconds.clamp(0.0, end) / DT).round() as u64;
        if tick != model.tick {
            commands.push(Command::from(TransportCommand::Seek(tick.min(model.frontier))));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_broken_where_an_angle_wraps() {
        let points = [[0.0, 3.0], [1.0, 3.1], [2.0, -3.1], [3.0, -3.0], [4.0, 3.1]];
        let lengths = |wraps| unbroken(&points, wraps).map(<[_]>::len).collect::<Vec<_>>();
        assert_eq!(lengths(true), [2, 2, 1]);
        assert_eq!(lengths(false), [5]);
    }
    #[test]
    fn an_axis_has_three_to_six_round_numbers() {
        let said = |least, most| marks(least, most).iter().map(number).collect::<Vec<_>>();
        assert_eq!(said(-0.1, 1.05), ["0.0", "0.5", "1.0"]);
        assert_eq!(said(-3.3, 3.3), ["\u{2212}2.5", "0.0", "2.5"]);
        assert_eq!(said(0.0, 60.0), ["0", "25", "50"]);
        assert_eq!(said(1.001, 1.0042), ["1.001", "1.002", "1.003", "1.004"]);
        assert!(said(0.0, 0.0).is_empty() && said(f64::NAN, 1.0).is_empty() && said(0.0, f64::INFINITY).is_empty());
        let mut width = 1e-4;
        while width < 1e5 {
            for least in [-0.37 * width, 0.0, 0.81 * width, 17.3 * width] {
                let found = marks(least, least + width);
                assert!((3..=6).contains(&found.len()), "{least} and {width} on: {found:?}");
                assert!(found.iter().all(|m| (least..=least + width).contains(&m.value)));
            }
            width *= 1.13;
        }
    }
}
