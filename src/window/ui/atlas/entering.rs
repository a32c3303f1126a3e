//! What is typed into the fields of the editor, entered for the thing that each belongs to.

use super::field::{NumberField, TypedText};
use crate::window::ui::AtlasState;
use crate::window::ui::number::{no_length, no_number, number, turns};
use motion_lab_core::worlds::World;
use motion_lab_sim::atlas::{Number, Op};

impl AtlasState {
    /// The numbers that the panel shows: those of the selected thing, or the world's bounds if none is selected. While
    /// a hull or polygon stays selected, its corners keep their numbers, even where the world stores them in another
    /// order.
    pub(super) fn numbers(&self) -> Vec<Number> {
        let Some(name) = &self.selected else { return self.seen().bounds() };
        let shape = self.seen().shape(name).zip(self.shape.as_ref());
        shape.map_or_else(|| self.seen().numbers(name), |(shape, known)| shape.ordered_as(known).numbers())
    }

    /// The change that sets the number of a field.
    pub(super) fn setting(&self, field: &NumberField, to: f64) -> Op {
        let number = field.number;
        let Some(name) = field.thing.clone() else { return Op::SetBounds { number, to } };
        let known = self.shape.as_ref().filter(|_| self.selected == field.thing);
        match known.and_then(|shape| shape.with_number(number, to)) {
            Some(shape) => Op::Reshape { name, shape },
            None => Op::SetNumber { name, number, to },
        }
    }

    /// Enters what was typed into a field, a name or a number, for the thing that the field belongs to. A text that is
    /// no number changes nothing, and is reported in `message`.
    pub(crate) fn enter(&mut self) {
        if std::mem::take(&mut self.is_naming) {
            let to = self.name_text.trim().to_owned();
            match self.selected.clone() {
                Some(name) => self.change(&Op::Rename { name, to: to.clone() }, Some(to)),
                None if self.is_taken(&to) => {
                    self.forget_name();
                    self.message = Some(format!("another world is named {to}"));
                }
                None => self.change(&Op::RenameWorld(to), None),
            }
        }
        self.enter_number();
    }

    /// Whether another world has this name: one that is edited, or a built-in one that this one did not begin as.
    fn is_taken(&self, name: &str) -> bool {
        let books = World::built_in_names().into_iter().filter(|book| self.built_in() != Some(*book));
        let mut taken = self.others.iter().cloned().chain(books.filter_map(World::built_in).map(|world| world.name));
        self.world().name != name && taken.any(|taken| taken == name)
    }

    /// Enters what was typed into a number field.
    pub(super) fn enter_number(&mut self) {
        let Some(TypedText { field, text, .. }) = self.typed.take() else { return };
        if field.thing.as_ref().is_some_and(|name| !self.editor.holds(name)) {
            return;
        }
        let numbers = field.thing.as_ref().map_or_else(|| self.seen().bounds(), |name| self.seen().numbers(name));
        let is_length = numbers.get(field.number).is_some_and(|shown| shown.unit == "m");
        match number(&text) {
            Some(to) if to.is_degrees() && is_length => self.message = Some(no_length(&text)),
            Some(to) => {
                self.change(&self.setting(&field, to.value()), self.selected.clone());
                if let Some(turns) = turns(&text).filter(|_| !is_length && self.message.is_none()) {
                    self.message = Some(turns);
                }
            }
            None if text.trim().is_empty() => {}
            None => self.message = Some(no_number(&text)),
        }
    }

    /// Shows the present name again instead of what was typed.
    pub(super) fn forget_name(&mut self) {
        self.is_naming = false;
        self.name_text = self.selected.clone().unwrap_or_else(|| self.world().name.clone());
    }

    /// Begins a drag in a number field.
    pub(super) fn hold(&mut self, field: NumberField) {
        self.enter();
        self.held = Some(field);
    }

    /// Drops the drag under way, on the paper or in a field: the world is shown as it is. Returns whether there was
    /// one.
    pub(super) fn drop_drag(&mut self) -> bool {
        let is_dragged = self.drag.is_some() || self.held.is_some() || self.preview.is_some();
        if is_dragged {
            self.redraw();
            self.message = None;
        }
        is_dragged
    }

    /// Leaves the editor: enters what was typed, and drops a drag under way. To be called while it is not in sight.
    pub(crate) fn put_down(&mut self) {
        self.enter();
        self.drop_drag();
    }
}
