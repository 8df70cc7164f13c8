//! What the keys do: one table, which the help overlay shows.

use egui::{Event, Key, Modifiers, Ui};

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    LookFrom(usize),
    Fit,
    Projection,
    Plane,
    Trackball,
    Layer(u8),
    Hide,
    Isolate,
    ShowAll,
    Undo,
    Redo,
    Boundary,
    Coboundary,
    Back,
    Measure,
    Screenshot,
    Next,
    Previous,
    Help,
    Leave,
}

/// A key with or without the control key (command on macOS), its name, and what it does, in words.
struct Binding {
    key: Key,
    modifiers: Modifiers,
    action: Action,
}

/// A line of the help: keys or mouse, and what they do.
pub(crate) const HELP: [(&str, &str); 24] = [
    ("left drag", "turn (in 2D: move)"),
    ("right, middle or shift drag", "move"),
    ("wheel, pinch", "zoom to the cursor"),
    ("click", "select what is under the cursor"),
    ("double click", "turn about the point under the cursor"),
    ("1 … 6", "front, back, right, left, top, bottom"),
    ("7", "isometric"),
    ("F", "fit everything visible"),
    ("P", "perspective or orthographic"),
    ("D", "2D: straight down, locked"),
    ("T", "turntable or trackball"),
    ("V  E  G  C", "vertices, edges, faces, cells on or off"),
    ("H", "hide the selected cell"),
    ("I", "isolate the selected cell"),
    ("A", "show all"),
    ("Ctrl Z, Ctrl Shift Z", "undo, redo of visibility"),
    ("B", "boundary chain of the selected cell"),
    ("K", "coboundary chain of the selected cell"),
    ("Backspace", "what was selected before"),
    ("M", "measure distances and angles"),
    ("S", "save the picture as PNG"),
    (", and .", "step through gift wrapping"),
    ("F1 or ?", "this help"),
    ("Esc", "leave help, replay, chain, selection; then the window"),
];

fn bindings() -> impl Iterator<Item = Binding> {
    let plain = |(key, action)| Binding { key, modifiers: Modifiers::NONE, action };
    let digits = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7];
    let views = digits.into_iter().enumerate().map(|(i, key)| (key, Action::LookFrom(i)));
    let layers = [Key::V, Key::E, Key::G, Key::C].into_iter().zip((0..4).map(Action::Layer));
    let others = [
        (Key::F, Action::Fit),
        (Key::P, Action::Projection),
        (Key::D, Action::Plane),
        (Key::T, Action::Trackball),
        (Key::H, Action::Hide),
        (Key::I, Action::Isolate),
        (Key::A, Action::ShowAll),
        (Key::B, Action::Boundary),
        (Key::K, Action::Coboundary),
        (Key::Backspace, Action::Back),
        (Key::M, Action::Measure),
        (Key::S, Action::Screenshot),
        (Key::Period, Action::Next),
        (Key::Comma, Action::Previous),
        (Key::F1, Action::Help),
        (Key::Questionmark, Action::Help),
        (Key::Escape, Action::Leave),
    ];
    let control = [
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::Z, Action::Redo),
        (Modifiers::COMMAND, Key::Z, Action::Undo),
        (Modifiers::COMMAND, Key::Y, Action::Redo),
    ];
    let control = control.into_iter().map(|(modifiers, key, action)| Binding { key, modifiers, action });
    control.chain(views.chain(layers).chain(others).map(plain))
}

/// The actions whose keys were pressed in this frame, in their order. Keys belong to a text field while one is written in.
pub(crate) fn pressed(ui: &Ui) -> Vec<Action> {
    if ui.ctx().text_edit_focused() {
        return Vec::new();
    }
    ui.input(|i| i.events.iter().filter_map(action).collect())
}

fn action(event: &Event) -> Option<Action> {
    let &Event::Key { key, pressed: true, modifiers, .. } = event else { return None };
    let matches = |b: &Binding| {
        b.key == key
            && if b.modifiers == Modifiers::NONE {
                // Question marks need shift on most keyboards, so plain keys do not ask for its absence.
                !modifiers.command
            } else {
                modifiers.matches_logically(b.modifiers)
            }
    };
    bindings().find(matches).map(|b| b.action)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_is_bound_twice() {
        let keys: Vec<_> = bindings().map(|b| (b.key, b.modifiers)).collect();
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{key:?}");
        }
    }
}
