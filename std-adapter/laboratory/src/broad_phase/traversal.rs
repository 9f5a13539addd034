//! Hands the candidates down the groups until each triangle has its partners.

use std::sync::atomic::{AtomicU64, Ordering};

use super::candidates::{CandidateList, Partners};
use super::hierarchy::{BRANCHES, Hierarchy};
use selvedge::broad_phase::LEAF;
use selvedge::parallel;

/// The lowest level with no more groups than this is handed out to the threads, a group at a time.
const MAXIMUM_TASKS: usize = 512;

/// Kept memory of the traversal, and its result.
#[derive(Debug, Default)]
pub(super) struct Traversal {
    /// The candidates of each group, for the tasks' level and those above it up to the top, where
    /// everything is a candidate.
    upper: Vec<Vec<CandidateList>>,
    tasks: Vec<Task>,
    /// The most triangles in a task.
    task_size: usize,
    /// By position of the triangle.
    runs: Vec<Run>,
}

/// Finds the partners of a group of triangles.
#[derive(Debug, Default)]
struct Task {
    /// The candidates of the group in hand, for each level below the task's.
    lower: Vec<CandidateList>,
    partners: Partners,
}

/// Where the partners of a triangle lie within its task's.
#[derive(Clone, Copy, Debug, Default)]
struct Run {
    start: usize,
    len: usize,
}

impl Traversal {
    /// Finds all partners. Returns the number of blocks tested.
    pub(super) fn run(&mut self, hierarchy: &Hierarchy, everything: &CandidateList) -> u64 {
        let levels = &hierarchy.levels;
        let Some(task_level) = levels.iter().position(|level| level.groups.len() <= MAXIMUM_TASKS) else {
            return 0;
        };
        self.prepare(hierarchy, task_level);

        let tests = AtomicU64::new(0);
        let count = |blocks: u64| tests.fetch_add(blocks, Ordering::Relaxed);
        for level in (task_level..levels.len() - 1).rev() {
            let (here, above) = self.upper.split_at_mut(level - task_level + 1);
            parallel::for_each(&mut here[level - task_level], |index, candidates| {
                let group = &levels[level].groups[index];
                let parent = above.first().map_or(everything, |parents| &parents[index / BRANCHES]);
                count(candidates.assign_overlapping(parent, &group.bounds, group.first));
                candidates.settle();
            });
        }
        let upper = &self.upper;
        parallel::for_each_with_chunk(&mut self.tasks, &mut self.runs, self.task_size, |index, task, runs| {
            let candidates = upper.first().map_or(everything, |groups| &groups[index]);
            task.partners.clear();
            let mut descent = Descent {
                hierarchy,
                runs,
                partners: &mut task.partners,
                offset: index * self.task_size,
                tests: 0,
            };
            descent.group(task_level, index, candidates, &mut task.lower);
            count(descent.tests);
            task.partners.settle();
            task.lower.iter_mut().for_each(CandidateList::settle);
        });
        tests.into_inner()
    }

    fn prepare(&mut self, hierarchy: &Hierarchy, task_level: usize) {
        let levels = &hierarchy.levels[task_level..];
        self.upper.resize_with(levels.len() - 1, Vec::new);
        for (lists, level) in self.upper.iter_mut().zip(levels) {
            lists.resize_with(level.groups.len(), CandidateList::default);
        }
        self.task_size = levels[0].size;
        self.tasks.resize_with(levels[0].groups.len(), Task::default);
        for task in &mut self.tasks {
            task.lower.resize_with(task_level, CandidateList::default);
        }
        self.runs.resize(hierarchy.len(), Run::default());
    }

    /// The triangles after the one at `position` whose boxes overlap its box, in order.
    pub(super) fn partners(&self, position: usize) -> &[u32] {
        let run = self.runs[position];
        self.tasks[position / self.task_size].partners.get(run.start, run.len)
    }

    /// The number of them.
    pub(super) fn count(&self, position: usize) -> usize {
        self.runs[position].len
    }
}

/// A task at work.
struct Descent<'a> {
    hierarchy: &'a Hierarchy,
    partners: &'a mut Partners,
    /// The task's runs, of which the first is at position `offset`.
    runs: &'a mut [Run],
    offset: usize,
    tests: u64,
}

impl Descent<'_> {
    fn group(&mut self, level: usize, index: usize, candidates: &CandidateList, lower: &mut [CandidateList]) {
        let Some((inside, lower)) = lower.split_last_mut() else {
            return self.leaf(index, candidates);
        };
        let children = self.hierarchy.levels[level - 1].groups.iter().enumerate();
        for (child, group) in children.skip(index * BRANCHES).take(BRANCHES) {
            self.tests += inside.assign_overlapping(candidates, &group.bounds, group.first);
            self.group(level - 1, child, inside, lower);
        }
    }

    fn leaf(&mut self, index: usize, candidates: &CandidateList) {
        let first = index * LEAF;
        for position in first..self.hierarchy.len().min(first + LEAF) {
            let start = self.partners.len();
            let bounds = &self.hierarchy.bounds[position];
            self.tests += candidates.append_overlapping(bounds, self.hierarchy.triangles[position], self.partners);
            self.runs[position - self.offset] = Run {
                start,
                len: self.partners.len() - start,
            };
        }
    }
}
