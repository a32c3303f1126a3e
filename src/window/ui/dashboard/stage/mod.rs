//! The stage: one cockpit in front and the others small beside it, all side by side, or one alone, on a narrow screen
//! or over the whole window.

mod places;
mod swipe;

use bevy_egui::egui::{
    Align, Align2, CursorIcon, Id, Layout, Pos2, Rect, RichText, ScrollArea, Sense, Stroke, StrokeKind, TextStyle, Ui,
    UiBuilder, WidgetInfo, WidgetType, pos2, vec2,
};

use self::places::{StagePlaces, WIDE, below_paper, places, share};
use self::swipe::swiped;
use super::hand::{drive, pad};
use super::in_hand;
use super::pane::{self, NARROW_TEXT, text_height};
use super::twins::shown_twin;
use super::words::{height_of, words_apart, words_in};
use crate::window::ui::crowd::pane::{CrowdPane, crowd_pane};
use crate::window::ui::cspace::linked::Linked;
use crate::window::ui::keys::{SessionAction, hint};
use crate::window::ui::paint::scale_bar::scale_bar;
use crate::window::ui::paint::touch::touched;
use crate::window::ui::paint::{canvas, frame};
use crate::window::ui::{Cockpit, Command, Dashboard, FrameColours, Grasp, UiState, menu};
use motion_lab_core::picture::{Picture, Role};
use motion_lab_sim::simulation::History;
pub use places::GAP;

/// Largest height of a small cockpit's paper, points, and its share of the room.
const SMALL: f32 = 190.0;
const SHARE_OF_SMALL: f32 = 0.3;

/// Rows of words under the cockpit in front.
const FOOT: f32 = 3.0;

/// Height kept free for the words under the pictures of a narrow screen, where they scroll, points.
const NARROW_WORDS: f32 = 104.0;

/// Width of the menu beside the tabs, points.
const MENU: f32 = 70.0;

/// Least width for the words beside the cockpit in front in a low room, points.
const MIN_WORDS: f32 = 170.0;

/// Least height for the configuration under the cockpit in front in a low room, points.
const LEAST_UNDER: f32 = 120.0;

/// Width of the window from which three equal panes are offered, points.
const ROOMY: f32 = 1600.0;

/// What the stage shows.
pub struct Stage<'a> {
    /// The dashboard.
    pub model: &'a Dashboard,
    /// The run's history.
    pub history: &'a History,
    /// The look.
    pub look: &'a FrameColours,
}

impl Stage<'_> {
    /// Shows the cockpits in what is left of `ui`.
    pub fn show(&self, ui: &mut Ui, state: &mut UiState, commands: &mut Vec<Command>) {
        let cockpits = &self.model.cockpits;
        state.screen.scrolls = cockpits.len() > 3 && !self.look.narrow && !state.screen.fills;
        let has_crowd = cockpits.iter().any(|cockpit| cockpit.crowd.is_some());
        if cockpits.is_empty() {
            ui.weak("No world is loaded.");
        } else if state.screen.fills {
            self.filling(ui, state, commands);
        } else if self.look.low && !has_crowd {
            self.lying(ui, state, commands);
        } else if self.look.narrow {
            self.alone(ui, state, commands);
        } else if has_crowd || cockpits.len() > 3 {
            self.side_by_side(ui, state, commands);
        } else {
            self.in_front(ui, state, commands);
        }
    }

    /// Shows the cockpit in front on the left, and on the right the others, small, over what there is to say of it; in
    /// a room that is taller than wide, all this below it.
    fn in_front(&self, ui: &mut Ui, state: &mut UiState, commands: &mut Vec<Command>) {
        let is_roomy = ui.ctx().content_rect().width() >= ROOMY;
        if is_roomy && state.settings.side_by_side {
            if ui.link("One in front").clicked() {
                state.settings.side_by_side = false;
            }
            return self.side_by_side(ui, state, commands);
        }
        let Some((chosen, cockpit)) = front(&self.model.cockpits, state) else { return };
        let room = ui.available_rect_before_wrap();
        let row = ui.text_style_height(&TextStyle::Body) + ui.spacing().item_spacing.y;
        let StagePlaces { sheet, foot, mut beside } = places(cockpit, room, FOOT * row + 6.0);
        let linked = self.linked(cockpit, state);
        let way = linked.as_ref().map_or_else(Vec::new, Linked::way);
        let fit = pane::paper(ui, cockpit, sheet, way, self.look, state, commands);
        let others: Vec<(usize, &Cockpit)> =
            self.model.cockpits.iter().enumerate().filter(|(i, _)| *i != chosen).collect();
        let is_below = beside.top() > sheet.bottom() && beside.width() >= WIDE;
        let mut apart = None;
        if is_below {
            // the words have the left half, the small ones and the configuration the right
            let (words, rest) = beside.split_left_right_at_fraction(0.5);
            (apart, beside) = (Some(words.with_max_x(words.right() - GAP)), rest);
        }
        if !others.is_empty() {
            let bottom = self.small_ones(ui, &others, beside, state, commands);
            beside = beside.with_min_y(bottom);
            if is_roomy {
                let at = Rect::from_min_size(beside.min, vec2(beside.width(), 20.0));
                let mut row = ui.new_child(UiBuilder::new().max_rect(at));
                state.settings.side_by_side |= row.link("All side by side").clicked();
                beside = beside.with_min_y(at.bottom());
            }
            beside = beside.with_min_y(beside.top() + 12.0);
        }
        let (words, space) = match apart {
            Some(words) => (words, Some(beside)),
            None => share(beside, height_of(ui, cockpit, beside.width())),
        };
        match foot {
            Some(foot) => words_apart(ui, [words, foot], cockpit, &fit, self.look, state, commands),
            None => words_in(ui, words, cockpit, &fit, self.look, state, commands),
        }
        if let (Some(linked), Some(space)) = (linked, space) {
            linked.show(ui, space, self.look, &mut state.linked, commands);
        }
    }

    /// The robot of a cockpit that can be taken in hand, with its past.
    fn linked<'a>(&'a self, cockpit: &'a Cockpit, state: &UiState) -> Option<Linked<'a>> {
        let robot = in_hand::chosen(cockpit, state)?;
        let way = state.twin.as_ref().is_some_and(|asked| asked.is_way_of(&robot.name));
        let twin = shown_twin(robot, state).filter(|_| cockpit.robots.len() == 1);
        Linked::new(cockpit, robot, twin, way, state.is_red(robot), (self.history, self.model.tick))
    }

    /// Shows cockpits small in a row at the top of `room`. Returns where the row ends.
    fn small_ones(
        &self,
        ui: &mut Ui,
        cockpits: &[(usize, &Cockpit)],
        room: Rect,
        state: &mut UiState,
        commands: &mut Vec<Command>,
    ) -> f32 {
        let gap = 0.6 * GAP;
        let papers = equally_high(cockpits, room, gap);
        let line = ui.text_style_height(&TextStyle::Small);
        let bottom = papers.iter().fold(room.top(), |low, paper| low.max(paper.bottom())) + 4.0 + line;
        for ((index, cockpit), paper) in cockpits.iter().zip(papers) {
            let whole = paper.with_max_y(bottom);
            if self.small(ui, cockpit, SmallCockpit { index: *index, whole, paper }, state) {
                drive::let_go(state, commands);
                state.focus.next_grasp = Some(Grasp::Leave);
                state.settings.world = *index as u32;
            }
        }
        bottom
    }

    /// Shows a cockpit small: its world, its robots, its name. Returns whether it was clicked.
    fn small(&self, ui: &mut Ui, cockpit: &Cockpit, place: SmallCockpit, state: &mut UiState) -> bool {
        let SmallCockpit { index, whole, paper } = place;
        let look = self.look;
        let response = ui.interact(whole, Id::new(("small", &cockpit.world.name)), Sense::click());
        let words = format!("Bring {} to the front ({})", cockpit.heading(), index + 1);
        response
            .widget_info(|| WidgetInfo::labeled(WidgetType::Button, true, format!("{words}. {}", cockpit.described())));
        let painter = ui.painter_at(whole.expand(1.0));
        let fit = canvas::fit(&cockpit.world, paper);
        canvas::paint_cached(&painter, &cockpit.world, paper, &fit, look);
        let robots = pane::robots(ui, cockpit, state);
        let over = Picture::new(&cockpit.world.name, cockpit.world.bounds).with(robots);
        canvas::paint(&ui.painter_at(paper), &over, &fit, look);
        let is_marked = response.hovered() || response.has_focus();
        // gold is the frame of the robot in hand, and of the focus
        let role = match (response.has_focus(), is_marked) {
            (true, _) => Role::Focus,
            (false, true) => Role::Muted,
            (false, false) => Role::Hairline,
        };
        painter.rect_stroke(paper, 0.0, Stroke::new(1.0, look.colour(role)), StrokeKind::Inside);
        let at = Pos2::new(paper.left(), paper.bottom() + 4.0);
        let colour = look.colour(if is_marked { Role::Text } else { Role::Muted });
        painter.text(at, Align2::LEFT_TOP, cockpit.heading(), TextStyle::Small.resolve(ui.style()), colour);
        let response = response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(words);
        response.clicked()
    }

    /// Shows one cockpit in a low room: its world as high as the room, under it, where there is room, its space, and at
    /// the right of both its words.
    fn lying(&self, ui: &mut Ui, state: &mut UiState, commands: &mut Vec<Command>) {
        let Some((_, cockpit)) = front(&self.model.cockpits, state) else { return };
        let room = ui.available_rect_before_wrap();
        let sheet = canvas::proportioned(&cockpit.world, room.with_max_x(room.right() - MIN_WORDS - 12.0));
        let under = Rect::from_min_max(sheet.left_bottom() + vec2(0.0, 6.0), pos2(sheet.right(), room.bottom()));
        let linked = self.linked(cockpit, state).filter(|_| under.height() >= LEAST_UNDER);
        let way = linked.as_ref().map_or_else(Vec::new, Linked::way);
        let fit = pane::paper(ui, cockpit, sheet, way, self.look, state, commands);
        if let Some(linked) = linked {
            linked.show(ui, under, self.look, &mut state.linked, commands);
        }
        let beside = room.with_min_x(sheet.right() + 12.0);
        let mut ui = ui.new_child(UiBuilder::new().max_rect(beside).layout(Layout::top_down(Align::Min)));
        header(&mut ui, self.model, self.look, state, commands);
        let words = beside.with_min_y(ui.cursor().top() + 4.0);
        words_in(&mut ui, words, cockpit, &fit, self.look, state, commands);
    }

    /// Shows one cockpit: its world, under it its configuration, for fingers with the pad beside it, and under both its
    /// words.
    fn alone(&self, ui: &mut Ui, state: &mut UiState, commands: &mut Vec<Command>) {
        let Some((index, cockpit)) = front(&self.model.cockpits, state) else { return };
        let room = ui.available_rect_before_wrap();
        let linked = self.linked(cockpit, state).filter(|_| cockpit.crowd.is_none());
        let Some(linked) = linked else { return self.pane(ui, cockpit, room, state, commands) };
        let most = room.with_max_y((room.bottom() - NARROW_TEXT).max(room.top() + 60.0));
        let sheet = canvas::proportioned(&cockpit.world, most);
        let below = room.with_min_y(sheet.bottom() + 6.0);
        // a picture that has half of the screen needs no other beside it
        let is_large = sheet.height() >= 0.5 * ui.ctx().content_rect().height();
        let (mut space, words) = if is_large { (None, below) } else { below_paper(below, NARROW_WORDS) };
        let driven = in_hand::chosen(cockpit, state).filter(|robot| robot.drivable && touched(ui));
        if let Some((place, rest)) = space.filter(|_| driven.is_some()).and_then(pad::at_right_of) {
            (state.hand.pad_place, space) = (Some(place), Some(rest));
        }
        let fit = pane::paper(ui, cockpit, sheet, linked.way(), self.look, state, commands);
        // where no robot is in hand, the pad takes its own
        if let Some((place, robot)) = state.hand.pad_place.take().zip(driven)
            && pad::pad(ui, &robot.name, place, self.look, state)
        {
            in_hand::take_in_hand(cockpit, Some(robot), state, commands);
        }
        let is_whole = state.cameras.get(&cockpit.world.name).is_none_or(|camera| camera.zoom <= 1.0);
        // a magnified world is moved instead
        let to = index as i32 + if is_whole { swiped(ui, sheet) } else { 0 };
        if to != index as i32 && (0..self.model.cockpits.len() as i32).contains(&to) {
            drive::let_go(state, commands);
            state.focus.next_grasp = Some(Grasp::Leave);
            state.settings.world = to as u32;
        }
        if let Some(space) = space {
            linked.show(ui, space, self.look, &mut state.linked, commands);
        }
        words_in(ui, words, cockpit, &fit, self.look, state, commands);
    }

    /// Shows the world in front over all the room, and under it a row: its name, the way back, the scale.
    fn filling(&self, ui: &mut Ui, state: &mut UiState, commands: &mut Vec<Command>) {
        let Some((_, cockpit)) = front(&self.model.cockpits, state) else { return };
        let room = ui.available_rect_before_wrap();
        let row = ui.spacing().interact_size.y;
        let (above, foot) = room.split_top_bottom_at_y(room.bottom() - row);
        let fit = if cockpit.crowd.is_some() {
            self.pane(ui, cockpit, above, state, commands);
            None
        } else {
            let above = above.with_max_y(above.bottom() - 6.0);
            let sheet = canvas::proportioned(&cockpit.world, above);
            // a world that is magnified has all the room
            let is_whole = state.cameras.get(&cockpit.world.name).is_none_or(|camera| camera.zoom <= 1.0);
            let centred = sheet.translate(vec2(0.5 * (above.width() - sheet.width()), 0.0));
            let way = self.linked(cockpit, state).map_or_else(Vec::new, |linked| linked.way());
            Some(pane::paper(ui, cockpit, if is_whole { centred } else { above }, way, self.look, state, commands))
        };
        let mut ui = ui.new_child(UiBuilder::new().max_rect(foot).layout(Layout::left_to_right(Align::Center)));
        if cockpit.crowd.is_none() {
            ui.label(RichText::new(cockpit.heading()).color(self.look.colour(Role::Text)));
        }
        if ui.link("Show all").on_hover_text(hint(SessionAction::Fill)).clicked() {
            state.screen.fills = false;
        }
        if let Some(fit) = fit {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| scale_bar(ui, fit.px_per_metre(), self.look));
        }
    }

    /// Shows all cockpits, three in a row.
    fn side_by_side(&self, ui: &mut Ui, state: &mut UiState, commands: &mut Vec<Command>) {
        let count = self.model.cockpits.len();
        let columns = count.min(3);
        let room = ui.available_rect_before_wrap();
        let width = (room.width() - GAP * (columns as f32 - 1.0)) / columns as f32;
        let mut rows = |ui: &mut Ui, height: f32| {
            for row in self.model.cockpits.chunks(columns) {
                let (rect, _) = ui.allocate_exact_size(vec2(room.width(), height), Sense::hover());
                for (i, cockpit) in row.iter().enumerate() {
                    let left = rect.left() + i as f32 * (width + GAP);
                    let rect = Rect::from_min_size(pos2(left, rect.top()), vec2(width, height));
                    self.pane(ui, cockpit, rect, state, commands);
                }
            }
        };
        if count == columns {
            rows(ui, room.height());
        } else {
            // more than three worlds do not fit a screen: only then is there something to scroll
            let height = (width + text_height(ui, 1)).min(room.height());
            ScrollArea::vertical().show(ui, |ui| rows(ui, height));
        }
    }

    /// Shows a cockpit in `rect`, its robots one by one or as a crowd.
    fn pane(&self, ui: &mut Ui, cockpit: &Cockpit, rect: Rect, state: &mut UiState, commands: &mut Vec<Command>) {
        match &cockpit.crowd {
            Some(crowd) => {
                let shown = CrowdPane { cockpit, crowd, history: self.history, tick: self.model.tick };
                crowd_pane(ui, &shown, rect, self.look, state, commands);
            }
            None => pane::pane(ui, cockpit, rect, self.look, state, commands),
        }
    }
}

/// The papers of small cockpits in a row at the top of a room: equally high, as wide as their worlds are, and together
/// no wider than the room.
fn equally_high(cockpits: &[(usize, &Cockpit)], room: Rect, gap: f32) -> Vec<Rect> {
    let high = SMALL.min(SHARE_OF_SMALL * room.height());
    let width = |cockpit: &Cockpit, height: f32| {
        canvas::proportioned(&cockpit.world, Rect::from_min_size(room.min, vec2(f32::MAX, height))).width()
    };
    let whole: f32 = cockpits.iter().map(|(_, cockpit)| width(cockpit, high)).sum();
    let free = (room.width() - gap * (cockpits.len() as f32 - 1.0)).max(1.0);
    let height = high * (free / whole).min(1.0);
    let mut left = room.left();
    let place = |(_, cockpit): &(usize, &Cockpit)| {
        let paper = Rect::from_min_size(pos2(left, room.top()), vec2(width(cockpit, height), height));
        left = paper.right() + gap;
        paper
    };
    cockpits.iter().map(place).collect()
}

/// The cockpit in front, and its index: where panes lie side by side the one with the robot in hand, else the one
/// chosen last.
pub fn front<'a>(cockpits: &'a [Cockpit], state: &UiState) -> Option<(usize, &'a Cockpit)> {
    let is_armed =
        |cockpit: &Cockpit| cockpit.robots.iter().any(|robot| state.hand.armed.as_ref() == Some(&robot.name));
    let chosen = cockpits.iter().position(is_armed).unwrap_or(state.settings.world as usize);
    cockpits.get(chosen).map(|cockpit| (chosen, cockpit)).or(cockpits.first().map(|first| (0, first)))
}

/// Shows what stands above the picture where only one cockpit is seen: tabs and the menu. The picture comes first:
/// title, key and hints stand below it.
pub fn header(ui: &mut Ui, model: &Dashboard, look: &FrameColours, state: &mut UiState, commands: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        tabs(ui, model, state, commands);
        // the menu is no tab: it stands at the right end
        ui.add_space((ui.available_size_before_wrap().x - MENU).max(0.0));
        menu::menu_button(ui, model, look, state, commands);
    });
    if look.low {
        frame::sentence_in_rows(ui, model, look, state);
    }
}

/// Shows tabs to choose the cockpit in front. The robot in hand, which would keep its own there, is let go.
fn tabs(ui: &mut Ui, model: &Dashboard, state: &mut UiState, commands: &mut Vec<Command>) {
    for (i, cockpit) in model.cockpits.iter().enumerate() {
        if ui.selectable_label(state.settings.world as usize == i, cockpit.tab()).clicked() {
            drive::let_go(state, commands);
            state.settings.world = i as u32;
            // a narrow screen shows either the plots or a pane
            state.settings.plots = false;
        }
    }
}

/// Where a small cockpit is.
#[derive(Clone, Copy)]
struct SmallCockpit {
    index: usize,
    /// The rectangle that takes clicks.
    whole: Rect,
    /// The rectangle of its world.
    paper: Rect,
}
