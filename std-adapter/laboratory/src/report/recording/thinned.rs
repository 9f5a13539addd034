//! Thins out entries that are offered after steps: evenly spread over a run of unknown length, in bounded memory.

use selvedge_files::bytes::Reader;

pub(super) type AfterStep<N> = (u64, Vec<N>);

/// When the limit is reached, every other entry is dropped, and from then on every other one is skipped. The first is always
/// kept, and the last is remembered in addition.
#[derive(Clone, Debug)]
pub(super) struct Thinned<N> {
    kept: Vec<AfterStep<N>>,
    /// The limit, at least two.
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

    pub(super) fn save(&self, bytes: &mut Vec<u8>, put: impl Fn(&N, &mut Vec<u8>)) {
        bytes.extend([self.stride, self.offered].into_iter().flat_map(u64::to_le_bytes));
        for list in [&self.kept[..], self.skipped.as_slice()] {
            bytes.extend((list.len() as u64).to_le_bytes());
            for (step, values) in list {
                bytes.extend(step.to_le_bytes());
                values.iter().for_each(|value| put(value, bytes));
            }
        }
    }

    /// Reads saved entries, with `count` values after each step. Returns `None` if they are damaged.
    pub(super) fn restore(
        &mut self,
        reader: &mut Reader<'_>,
        count: usize,
        get: impl Fn(&mut Reader<'_>) -> Option<N>,
    ) -> Option<()> {
        self.stride = reader.u64()?;
        self.offered = reader.u64()?;
        let mut list = || {
            let items = reader.count(size_of::<u64>())?;
            let mut item = |_| {
                let step = reader.u64()?;
                let values = (0..count).map(|_| get(reader)).collect::<Option<_>>()?;
                Some((step, values))
            };
            (0..items).map(&mut item).collect::<Option<Vec<_>>>()
        };
        self.kept = list()?;
        self.skipped = list()?.pop();
        (self.stride > 0).then_some(())
    }
}
