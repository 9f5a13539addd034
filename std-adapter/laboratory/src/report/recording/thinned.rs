//! Thins out entries that are offered after steps: evenly spread over a run of unknown length, in bounded memory.

use serde::{Deserialize, Serialize};

pub(super) type AfterStep<N> = (u64, Vec<N>);

/// When the limit is reached, every other entry is dropped, and from then on every other one is skipped. The first is always
/// kept, and the last is remembered in addition.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Thinned<N> {
    kept: Vec<AfterStep<N>>,
    /// The limit, at least two.
    #[serde(skip)]
    most: usize,
    /// The number of offered entries of which one is kept.
    stride: u64,
    /// The number of entries offered so far.
    offered: u64,
    /// The last entry offered, if it was not kept.
    skipped: Option<AfterStep<N>>,
}

impl<N> Thinned<N> {
    pub(super) const fn new(most: usize) -> Self {
        Self {
            kept: Vec::new(),
            most,
            stride: 1,
            offered: 0,
            skipped: None,
        }
    }

    pub(super) const fn set_most(&mut self, most: usize) {
        self.most = most;
    }

    /// Returns whether the next entry is kept, or only remembered in case it is the last.
    const fn wants_next(&self) -> bool {
        self.offered.is_multiple_of(self.stride)
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.offered == 0
    }

    /// Offers values. Steps must increase; a second offer after the same step replaces the first.
    pub(super) fn offer(&mut self, step: u64, values: impl Iterator<Item = N>) {
        let last = self.skipped.as_mut().or(self.kept.last_mut());
        if let Some((_, state)) = last.filter(|(last, _)| *last == step) {
            state.clear();
            state.extend(values);
            return;
        }
        // This reuses its memory.
        let (_, mut state) = self.skipped.take().unwrap_or_default();
        state.clear();
        state.extend(values);
        if self.wants_next() && self.kept.len() == self.most {
            let mut index = 0;
            self.kept.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.stride *= 2;
        }
        if self.wants_next() {
            self.kept.push((step, state));
        } else {
            self.skipped = Some((step, state));
        }
        self.offered += 1;
    }

    /// Changes all values so far.
    pub(super) fn change(&mut self, mut change: impl FnMut(&mut Vec<N>)) {
        let all = self.kept.iter_mut().chain(&mut self.skipped);
        all.for_each(|(_, values)| change(values));
    }

    /// Returns all entries that are kept, and the last.
    pub(super) fn finish(mut self) -> Vec<AfterStep<N>> {
        self.kept.extend(self.skipped);
        self.kept
    }

    /// Continues with saved entries. Returns `None` if they are damaged: each has `count` values that are `valid`.
    pub(super) fn restore(&mut self, saved: Self, count: usize, valid: impl Fn(&N) -> bool) -> Option<()> {
        let mut entries = saved.kept.iter().chain(&saved.skipped);
        let are_valid = entries.all(|(_, values)| values.len() == count && values.iter().all(&valid));
        let most = self.most;
        *self = Self { most, ..saved };
        (are_valid && self.stride > 0).then_some(())
    }
}
