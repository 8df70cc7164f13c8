//! Which of the events that wait make one frame.

use egui::{Event, Key, Pos2};

/// Points between the clicks of a double click, at most; egui allows as many between press and release.
const SAME_PLACE: f32 = 6.0;

/// Keeps the events of one frame and returns those after it; `down` is where a button was pressed in an earlier frame, that is
/// still down.
///
/// A click puts the cursor into a field or out of it, Esc, Enter and Tab take it out. Within a frame clicks come first,
/// whatever their order, and panels find out in the middle of it where the cursor is; and all clicks of a frame are one, where the
/// mouse is at the end. On a slow driver much arrives in the time of a frame. So what is typed has a frame to itself, which
/// ends with a key that moves the cursor, and so have clicks at different places. A drag has a frame between those that press
/// and release the button: what the mouse moves in either of them does not count.
pub(crate) fn split_off_later(events: &mut Vec<Event>, down: Option<Pos2>) -> Vec<Event> {
    let (mut typed, mut left, mut released) = (false, false, None::<(usize, Pos2)>);
    let mut pressed = down.map(|at| (0, at));
    let is_drag = |from: Option<(usize, Pos2)>, to: Pos2| from.filter(|(_, at)| SAME_PLACE < at.distance(to));
    for (i, event) in events.iter().enumerate() {
        match event {
            Event::PointerButton { .. } if typed => return events.split_off(i),
            Event::PointerMoved(to) => {
                if let Some((start, _)) = is_drag(pressed, *to).filter(|(start, _)| 0 < *start) {
                    return events.split_off(start);
                }
            }
            Event::PointerButton { pos, pressed: false, .. } if 0 < i && is_drag(pressed, *pos).is_some() => {
                return events.split_off(i);
            }
            Event::PointerButton { pos, pressed: true, .. } => {
                pressed = Some((i + 1, *pos));
                if let Some((end, _)) = released.filter(|(_, at)| SAME_PLACE < at.distance(*pos)) {
                    // With the way to where it is pressed next.
                    return events.split_off(end);
                }
            }
            Event::PointerButton { pos, .. } => (pressed, released) = (None, Some((i + 1, *pos))),
            event if is_typed(event) => {
                if left || released.is_some() {
                    return events.split_off(i);
                }
                typed = true;
                left |= leaves(event);
            }
            _ => {}
        }
    }
    Vec::new()
}

fn leaves(event: &Event) -> bool {
    matches!(event, Event::Key { key: Key::Escape | Key::Enter | Key::Tab, .. })
}

fn is_typed(event: &Event) -> bool {
    matches!(
        event,
        Event::Key { pressed: true, .. }
            | Event::Text(_)
            | Event::Ime(_)
            | Event::Copy
            | Event::Cut
            | Event::Paste(_)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Modifiers, PointerButton, pos2};

    fn key(key: Key) -> [Event; 2] {
        [true, false].map(|pressed| {
            let modifiers = Modifiers::NONE;
            Event::Key { key, physical_key: None, pressed, repeat: false, modifiers }
        })
    }

    fn click(x: f32) -> [Event; 2] {
        let (pos, button, modifiers) = (pos2(x, 2.0), PointerButton::Primary, Modifiers::NONE);
        [true, false].map(|pressed| Event::PointerButton { pos, button, pressed, modifiers })
    }

    /// All of the events as frames, each as the number of its events.
    #[track_caller]
    fn check(events: &[[Event; 2]], expected: &[usize]) {
        let all = events.concat();
        let (mut frames, mut rest, mut down) = (Vec::new(), all.clone(), None);
        while !rest.is_empty() {
            let later = split_off_later(&mut rest, down);
            for event in &rest {
                if let Event::PointerButton { pos, pressed, .. } = event {
                    down = pressed.then_some(*pos);
                }
            }
            frames.push(std::mem::replace(&mut rest, later));
        }
        assert_eq!(frames.iter().map(Vec::len).collect::<Vec<_>>(), expected);
        assert_eq!(frames.concat(), all, "none is lost, and their order stays");
    }

    #[test]
    fn what_is_typed_has_frames_to_itself() {
        let text = |t: &str| [Event::Text(t.into()), Event::PointerMoved(pos2(0.0, 0.0))];
        check(&[], &[]);
        check(&[key(Key::A), text("a"), key(Key::B)], &[6]);
        check(&[key(Key::A), click(1.0)], &[2, 2]);
        check(&[click(1.0), key(Key::A), text("a")], &[2, 4]);
        check(&[click(1.0), click(1.0), text("a"), click(1.0), text("b")], &[4, 2, 2, 2]);
        check(&[key(Key::Escape), key(Key::Escape)], &[2, 2]);
        check(&[key(Key::A), key(Key::Tab), text("b")], &[4, 2]);
    }

    #[test]
    fn clicks_at_different_places_have_frames_of_their_own() {
        check(&[click(1.0), click(2.0)], &[4]);
        let way = |x: f32| [Event::PointerMoved(pos2(5.0, 2.0)), Event::PointerMoved(pos2(x, 2.0))];
        check(&[way(1.0), click(1.0), way(20.0), click(20.0), click(20.0)], &[4, 6]);
    }

    #[test]
    fn drags_have_a_frame_between_press_and_release() {
        let [press, _] = click(1.0);
        let [_, release] = click(30.0);
        let way = [Event::PointerMoved(pos2(15.0, 2.0)), Event::PointerMoved(pos2(30.0, 2.0))];
        let start = [Event::PointerMoved(pos2(0.0, 9.0)), Event::PointerMoved(pos2(1.0, 2.0))];
        let [first, second] = way.clone();
        let drag = [[press, first], [second, release]];
        check(&drag, &[1, 2, 1]);
        check(&[start, drag[0].clone(), drag[1].clone(), click(30.0)], &[3, 2, 3]);
    }

    /// A frame may end between press and way.
    #[test]
    fn drags_that_began_in_an_earlier_frame_end_in_another() {
        let down = Some(pos2(1.0, 2.0));
        let check = |x: f32, down: Option<Pos2>, expected: usize| {
            let [_, release] = click(x);
            let mut events = vec![
                Event::PointerMoved(pos2(0.5 * x, 2.0)),
                Event::PointerMoved(pos2(x, 2.0)),
                release.clone(),
            ];
            assert_eq!(split_off_later(&mut events, down).len(), expected, "to {x}");
            assert_eq!(split_off_later(&mut vec![release], down), [], "a frame has an event");
        };
        check(30.0, down, 1);
        check(2.0, down, 0);
        check(30.0, None, 0);
    }
}
