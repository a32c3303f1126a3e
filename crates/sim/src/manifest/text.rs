//! The words of the widgets, read from `assets/widgets.ron`.

use super::hint_task::HintTask;
use motion_lab_core::picture::Role;
use serde::Deserialize;
use std::sync::LazyLock;

/// The words of one widget.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WidgetText {
    /// Its id, by which a page names it.
    pub id: String,
    /// Its title.
    pub title: String,
    /// Its title on the rail.
    short: String,
    /// The misconception it removes, in one line.
    pub misconception: String,
    /// A description of the widget, for readers who do not see it.
    pub description: String,
    /// The colour key.
    pub key: Vec<KeyText>,
    /// First things for a new reader to try.
    pub hints: Vec<Hint>,
}

/// A first thing to try.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hint {
    /// What it asks for.
    pub task: HintTask,
    /// Its words.
    pub text: String,
    /// What it teaches, in one sentence, for its end.
    pub learnt: String,
    /// Whether it is about the arm with two links alone.
    #[serde(default)]
    pub arm: bool,
}

/// An entry of a colour key.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeyText {
    role: String,
    /// The meaning of the role in this widget.
    pub text: String,
    /// Whether it is about the arm with two links alone.
    #[serde(default)]
    pub arm: bool,
}

impl WidgetText {
    /// Its title on the rail, one word.
    pub fn short(&self) -> &str {
        &self.short
    }
}

impl KeyText {
    /// The role; `Role::Text` for an unknown name, which a test excludes.
    pub fn role(&self) -> Role {
        Role::ALL.into_iter().find(|r| r.name() == self.role).unwrap_or(Role::Text)
    }
}

static WIDGETS: LazyLock<Vec<WidgetText>> =
    LazyLock::new(|| ron::from_str(include_str!("../../assets/widgets.ron")).unwrap_or_default());

/// The words of no widget.
static NO_WORDS: LazyLock<WidgetText> = LazyLock::new(WidgetText::default);

/// The words of the widget with this id; none for an id that the manifest lacks, which a test excludes.
pub(super) fn text_of(id: &str) -> &'static WidgetText {
    WIDGETS.iter().find(|w| w.id == id).unwrap_or(&NO_WORDS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manifest::widget::Widget;

    #[test]
    fn the_manifest_is_whole() {
        let parsed: Vec<WidgetText> = ron::from_str(include_str!("../../assets/widgets.ron")).unwrap();
        let ids: Vec<&str> = parsed.iter().map(|words| words.id.as_str()).collect();
        assert_eq!(ids, Widget::ALL.map(Widget::id), "each once, in the order of the rail");
        assert_eq!((Widget::of("cspace"), Widget::of("a cat")), (Some(Widget::Cspace), None));
        for widget in Widget::ALL.map(Widget::text) {
            for words in [&widget.id, &widget.title, &widget.short, &widget.misconception, &widget.description] {
                assert!(!words.trim().is_empty(), "{}", widget.id);
            }
            assert!(!widget.misconception.contains('\n') && !widget.key.is_empty() && !widget.hints.is_empty());
            for hint in &widget.hints {
                // a sentence or two that fit a row of the window
                let learnt = &hint.learnt;
                assert!(learnt.ends_with('.') && learnt.len() <= 105 && !learnt.contains('\n'), "{learnt}");
                assert!(*learnt != hint.text && *learnt != widget.misconception, "{learnt}");
            }
            for entry in &widget.key {
                assert_eq!(entry.role().name(), entry.role, "{}", widget.id);
            }
        }
    }
}
