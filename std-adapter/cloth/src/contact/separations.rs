//! The separation that each pair is certified to keep in a step.

use super::candidate::Candidate;
use super::exempt::Exempt;
use super::settings::ContactSettings;

/// The separations of all pairs in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Separations<'a> {
    /// The separations of pairs of cloth, and of cloth and bodies, if all such pairs have the same. This is so in most scenes;
    /// then no pair needs a look-up.
    of_all: Option<[Option<f64>; 2]>,
    settings: &'a ContactSettings,
    exempt: &'a Exempt,
}

impl<'a> Separations<'a> {
    /// Makes the separations of pairs; `exempt` pairs have none.
    pub(super) fn new(settings: &'a ContactSettings, exempt: &'a Exempt) -> Self {
        let of_all = settings.of_all().filter(|_| exempt.is_empty());
        Self {
            of_all: of_all.map(|of_all| of_all.map(|thickness| thickness.map(|thickness| thickness.separation))),
            settings,
            exempt,
        }
    }

    /// The separation that a pair has to keep; `None` if it is exempt.
    ///
    /// A pair of neighbours may have a [thickness of its own](super::candidate::Aim) below the separation, since it is nearer at
    /// rest. It keeps no more than that; otherwise it could come apart, but never return to its distance at rest.
    #[inline(always)]
    pub(super) fn of(&self, pair: &Candidate) -> Option<f64> {
        let separation = match self.of_all {
            Some(of_all) => of_all[usize::from(pair.data.is_with_body())],
            None => self.of_single(pair),
        };
        separation.map(|separation| separation.min(pair.data.aim.length()))
    }

    #[cold]
    #[inline(never)]
    fn of_single(&self, pair: &Candidate) -> Option<f64> {
        if self.exempt.has(pair) {
            return None;
        }
        self.settings.of(pair).map(|thickness| thickness.separation)
    }
}
