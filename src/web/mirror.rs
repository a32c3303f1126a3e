//! `Mirrored`, a widget of egui's accessibility tree, reduced to what a page needs for a control of its own.

use bevy_egui::egui::accesskit::{Action, Live, Node, NodeId, Role, Toggled, TreeUpdate};
use serde::Serialize;

/// One widget of the canvas, as a page shows it to those who do not see the canvas.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Mirrored {
    /// Its number, a string because it has 64 bits.
    pub id: String,
    /// The kind of control.
    pub kind: ControlKind,
    /// Its accessible name.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// The text or number it holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<String>,
    /// Least, greatest and step of a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 3]>,
    /// Whether it is on; `None` for a control that can't be on or off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<bool>,
    /// Whether what it folds is open; `None` for what folds nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub open: Option<bool>,
    /// Whether it is disabled.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub off_limits: bool,
    /// Whether its text is to be read aloud when it changes.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub live: bool,
    /// Its rectangle on the canvas: left, top, width and height, whole points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place: Option<[i32; 4]>,
    /// The number of the layer above the rest that it lies in: a menu's, a list's, a notice's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layer: Option<String>,
    /// Whether it has the focus in the canvas.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub focus: bool,
}

/// The controls that a page knows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ControlKind {
    /// Words.
    #[default]
    Text,
    /// A picture that nothing can be done with.
    Image,
    /// A button or a link.
    Button,
    /// A button that opens a list; its value is what is chosen.
    Combo,
    /// A check box or a radio button.
    Check,
    /// A number on a scale.
    Slider,
    /// A number to type or to step.
    Number,
    /// Text to type.
    Field,
    /// A control that takes the arrow keys while it has the focus: a painted handle or a pane.
    Handle,
}

/// The widgets of an update in reading order. Groups are dissolved; widgets with neither name nor value are left out.
pub fn mirror(update: &TreeUpdate) -> Vec<Mirrored> {
    let find = |id: NodeId| update.nodes.iter().find(|(n, _)| *n == id).map(|(_, node)| node);
    let mut found = Vec::new();
    let Some(root) = update.tree.as_ref().and_then(|t| find(t.root)) else { return found };
    // the layer at the bottom is the first in which there is anything
    let mut bottom = None;
    for layer in root.children() {
        let before = found.len();
        let mut open = vec![*layer];
        while let Some(id) = open.pop() {
            let Some(node) = find(id) else { continue };
            let labels = node.labelled_by().iter().filter_map(|l| find(*l)).filter_map(|l| l.value().or(l.label()));
            let mirrored = mirrored(id, node, labels.collect::<Vec<_>>().join(" "), update.focus == id);
            let number = bottom.is_some().then(|| layer.0.to_string());
            found.extend(mirrored.map(|mirrored| Mirrored { layer: number, ..mirrored }));
            // the text runs of a field repeat its value
            if node.role() != Role::TextInput {
                open.extend(node.children().iter().rev());
            }
        }
        if found.len() > before {
            bottom = bottom.or(Some(layer));
        }
    }
    found
}

fn mirrored(id: NodeId, node: &Node, labels: String, focus: bool) -> Option<Mirrored> {
    let kind = match node.role() {
        Role::Image => ControlKind::Image,
        Role::Label | Role::ProgressIndicator => ControlKind::Text,
        Role::Button | Role::Link | Role::ColorWell => ControlKind::Button,
        Role::ComboBox => ControlKind::Combo,
        Role::CheckBox | Role::RadioButton => ControlKind::Check,
        // a number that can't be set is a handle, which takes the arrow keys
        Role::Slider | Role::SpinButton if !node.supports_action(Action::SetValue) => ControlKind::Handle,
        Role::Slider => ControlKind::Slider,
        Role::SpinButton => ControlKind::Number,
        Role::TextInput | Role::MultilineTextInput => ControlKind::Field,
        Role::Unknown if node.supports_action(Action::Focus) => ControlKind::Handle,
        _ => return None,
    };
    let own = node.label().or(node.value().filter(|_| kind == ControlKind::Text));
    let name = own.map_or(labels, str::to_owned);
    let number = node.numeric_value();
    let value = match kind {
        ControlKind::Text => None,
        ControlKind::Slider | ControlKind::Number => number.map(|n| n.to_string()).or(node.value().map(str::to_owned)),
        _ => node.value().map(str::to_owned).or(number.map(|n| n.to_string())),
    };
    if name.is_empty() && value.is_none() {
        return None;
    }
    let bound = |x: Option<f64>, else_: f64| x.filter(|x| x.is_finite()).unwrap_or(else_);
    let range = (kind == ControlKind::Slider || kind == ControlKind::Number).then(|| {
        [
            bound(node.min_numeric_value(), -1e9),
            bound(node.max_numeric_value(), 1e9),
            bound(node.numeric_value_step(), 0.0),
        ]
    });
    Some(Mirrored {
        id: id.0.to_string(),
        kind,
        name,
        value,
        range,
        on: node.toggled().map(|t| t == Toggled::True),
        open: node.is_expanded(),
        off_limits: node.is_disabled(),
        live: node.live().is_some_and(|l| l != Live::Off),
        layer: None,
        place: node.bounds().map(|b| [b.x0, b.y0, b.width(), b.height()].map(|x| x.round() as i32)),
        focus,
    })
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::accesskit::{Rect, Tree, TreeId};

    use super::*;

    fn node(role: Role, fill: impl FnOnce(&mut Node)) -> Node {
        let mut node = Node::new(role);
        fill(&mut node);
        node
    }

    #[test]
    fn widgets_come_in_reading_order_with_what_a_control_needs() {
        let nodes = [
            (0, node(Role::Window, |n| n.set_children([99, 1, 4].map(NodeId::from)))),
            (1, node(Role::GenericContainer, |n| n.set_children([2, 3, 9, 11, 12, 13].map(NodeId::from)))),
            (
                2,
                node(Role::Button, |n| {
                    n.set_label("Play");
                    n.set_bounds(Rect { x0: 1.0, y0: 2.2, x1: 41.0, y1: 30.1 });
                }),
            ),
            (
                3,
                node(Role::Slider, |n| {
                    n.set_label("speed");
                    n.set_numeric_value(0.5);
                    n.set_min_numeric_value(0.125);
                    n.set_max_numeric_value(f64::INFINITY);
                    n.add_action(Action::SetValue);
                    n.set_disabled();
                }),
            ),
            (4, node(Role::Label, |n| n.set_value("Dashboard"))),
            (
                9,
                node(Role::TextInput, |n| {
                    n.push_labelled_by(NodeId::from(4));
                    n.set_value("2005");
                    n.set_children([10].map(NodeId::from));
                }),
            ),
            (
                11,
                node(Role::SpinButton, |n| {
                    n.set_label("elbow");
                    n.set_numeric_value(1.5);
                }),
            ),
            (
                12,
                node(Role::ComboBox, |n| {
                    n.set_label("world");
                    n.set_value("Lot");
                    n.set_expanded(false);
                }),
            ),
            (13, node(Role::Image, |n| n.set_label("the configuration"))),
            (10, node(Role::TextRun, |n| n.set_value("2005"))),
        ];
        let update = TreeUpdate {
            nodes: nodes.into_iter().map(|(id, n)| (NodeId::from(id), n)).collect(),
            tree: Some(Tree::new(NodeId::from(0))),
            tree_id: TreeId::ROOT,
            focus: NodeId::from(2),
        };
        let found = mirror(&update);
        let named: Vec<(&str, ControlKind)> = found.iter().map(|m| (m.name.as_str(), m.kind)).collect();
        assert_eq!(
            named,
            [
                ("Play", ControlKind::Button),
                ("speed", ControlKind::Slider),
                ("Dashboard", ControlKind::Field),
                ("elbow", ControlKind::Handle),
                ("world", ControlKind::Combo),
                ("the configuration", ControlKind::Image),
                ("Dashboard", ControlKind::Text),
            ]
        );
        assert!(found[0].focus && !found[1].focus);
        assert_eq!((found[1].range, found[1].off_limits), (Some([0.125, 1e9, 0.0]), true));
        assert_eq!([0, 4].map(|i| found[i].open), [None, Some(false)]);
        assert_eq!([2, 4].map(|i| found[i].value.as_deref()), [Some("2005"), Some("Lot")]);
        assert_eq!(
            serde_json::to_string(&found[0]).unwrap(),
            r#"{"id":"2","kind":"button","name":"Play","place":[1,2,40,28],"focus":true}"#
        );
        // the layer 99 has nothing in it
        let layers: Vec<Option<&str>> = found.iter().map(|widget| widget.layer.as_deref()).collect();
        assert_eq!(layers, [None, None, None, None, None, None, Some("4")]);
    }
}
