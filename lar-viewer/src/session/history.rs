//! The way back through all that was visible.

use super::{Section, Session, Visibility};
use crate::Outlined;

/// Undone changes that are remembered.
const HISTORY_LIMIT: usize = 200;

/// Everything about a session that says what is visible, and that can be undone.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shown {
    pub(super) visibility: Visibility,
    pub(super) numbers: [bool; 4],
    pub(super) section: Section,
    pub(super) opacity: f32,
    pub(super) outline: Option<Outlined>,
}

/// States that were left, and those that were returned from.
#[derive(Clone, Debug)]
pub(super) struct History<T> {
    past: Vec<T>,
    future: Vec<T>,
}

impl<T> Default for History<T> {
    fn default() -> Self {
        Self { past: Vec::new(), future: Vec::new() }
    }
}

impl<T: PartialEq> History<T> {
    /// Remembers a state that was left for `now`, unless nothing changed.
    pub(super) fn left(&mut self, before: T, now: &T) {
        if before != *now {
            self.future.clear();
            self.past.push(before);
            if HISTORY_LIMIT < self.past.len() {
                self.past.remove(0);
            }
        }
    }

    /// Goes back; returns whether there was somewhere to go.
    pub(super) fn undo(&mut self, state: &mut T) -> bool {
        Self::go(&mut self.past, &mut self.future, state)
    }

    /// Goes forward again.
    pub(super) fn redo(&mut self, state: &mut T) -> bool {
        Self::go(&mut self.future, &mut self.past, state)
    }

    fn go(from: &mut Vec<T>, to: &mut Vec<T>, state: &mut T) -> bool {
        let Some(target) = from.pop() else { return false };
        to.push(std::mem::replace(state, target));
        true
    }

    pub(super) fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    pub(super) fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

impl Session {
    /// Remembers what is visible now as a step that can be undone, if it has changed: to be called when a slider of clip
    /// plane or opacity has come to rest. Commands do it by themselves. O(cells hidden).
    pub fn settle(&mut self) {
        let now = Shown {
            visibility: self.visibility.clone(),
            numbers: self.numbers,
            section: self.section,
            opacity: self.opacity,
            outline: self.outline,
        };
        if let Some(before) = self.settled.replace(now.clone()) {
            self.history.left(before, &now);
        }
    }

    /// Makes what is visible now the first state, which undoing ends at.
    pub fn forget_past(&mut self) {
        (self.history, self.settled) = (History::default(), None);
        self.settle();
    }

    pub(super) fn travel(&mut self, go: fn(&mut History<Shown>, &mut Shown) -> bool) {
        self.settle();
        if let Some(shown) = &mut self.settled
            && go(&mut self.history, shown)
        {
            let Shown { visibility, numbers, section, opacity, outline } = shown.clone();
            (self.visibility, self.numbers, self.section) = (visibility, numbers, section);
            (self.opacity, self.outline) = (opacity, outline);
        }
    }

    /// Whether there is a change of what is visible to take back, and one to make again.
    #[must_use]
    pub fn can_undo_redo(&self) -> [bool; 2] {
        [self.history.can_undo(), self.history.can_redo()]
    }
}
