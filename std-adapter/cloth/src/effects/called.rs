//! The effects of a scene, and the cloths on which each of them acts.
//!
//! A scene has effects, and a cloth may have some of its own. The table of a cloth's own effect is part of the cloth's table, and
//! has the same name and keys as the scene's. So effects need no list of cloths.

use super::registration::{Effect, Scope};
use super::registry::{rank, registration_of};
use super::{Bend, Shear, Stretch};
use crate::effects::plan::{Fabric, Plan};
use crate::identity::{Identify, Identity};
use crate::input::ValueError;
use crate::world::{Cloth, Material, SceneParts};
use std::sync::Arc;

/// Effects in the order in which they run. No two have the same name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Effects(Vec<Arc<dyn Effect>>);

impl Effects {
    /// Adds an effect. It replaces one of the same name.
    pub(crate) fn add(&mut self, effect: impl Effect + 'static) {
        self.add_shared(Arc::new(effect));
    }

    pub(crate) fn add_shared(&mut self, effect: Arc<dyn Effect>) {
        let name = effect.name();
        self.0.retain(|other| other.name() != name);
        let place = self.0.partition_point(|other| rank(other.name()) <= rank(name));
        self.0.insert(place, effect);
    }

    pub(crate) fn get(&self, name: &str) -> Option<&dyn Effect> {
        self.0.iter().map(|effect| &**effect).find(|effect| effect.name() == name)
    }

    pub(crate) fn shared(&self, name: &str) -> Option<Arc<dyn Effect>> {
        self.0.iter().find(|effect| effect.name() == name).cloned()
    }

    pub(crate) fn keep(&mut self, names: &[&str]) {
        self.0.retain(|effect| names.contains(&effect.name()));
    }

    fn names(&self) -> impl Iterator<Item = &'static str> {
        self.0.iter().map(|effect| effect.name())
    }
}

impl Identify for Effects {
    fn identify(&self, identity: &mut Identity) {
        for effect in &self.0 {
            effect.name().identify(identity);
            effect.identify(identity);
        }
    }
}

fn of_material(material: &Material) -> [Arc<dyn Effect>; 3] {
    [
        Arc::new(Stretch::of_material(material)),
        Arc::new(Shear::of_material(material)),
        Arc::new(Bend::of_material(material)),
    ]
}

/// The scene's effects, its cloths, and the effects that single cloths have instead of the scene's.
#[derive(Clone, Debug)]
pub(crate) struct Called<'a> {
    by_scene: &'a Effects,
    cloths: &'a [Cloth],
    own: Vec<Effects>,
}

/// An invalid effect, of the scene or of one cloth.
#[derive(Debug)]
pub(crate) struct Wrong {
    pub(crate) name: &'static str,
    /// The cloth that owns the effect.
    pub(crate) cloth: Option<usize>,
    pub(crate) error: ValueError,
}

impl<'a> Called<'a> {
    /// Collects effects. `own` are the effects of single cloths, in their order. A cloth of a material gets the effects that
    /// neither it nor the scene has.
    pub(crate) fn new(by_scene: &'a Effects, cloths: &'a [Cloth], mut own: Vec<Effects>) -> Self {
        for (cloth, own) in cloths.iter().zip(&mut own) {
            for effect in cloth.material.iter().flat_map(of_material) {
                if by_scene.get(effect.name()).or(own.get(effect.name())).is_none() {
                    own.add_shared(effect);
                }
            }
        }
        Self { by_scene, cloths, own }
    }

    pub(crate) fn own(&self) -> &[Effects] {
        &self.own
    }

    /// Returns all names, in the order in which the effects run.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        let own = self.own.iter().flat_map(Effects::names);
        let mut names = Vec::new();
        for name in self.by_scene.names().chain(own) {
            if !names.contains(&name) {
                let place = names.partition_point(|known| rank(known) <= rank(name));
                names.insert(place, name);
            }
        }
        names
    }

    /// Returns the effects of a name, each with the cloth on which it acts, or `None` for the whole scene.
    pub(crate) fn acting(&self, name: &str) -> Vec<(Option<usize>, &dyn Effect)> {
        let of_scene = self.by_scene.get(name);
        match of_scene {
            Some(effect) if effect.scope() == Scope::Scene => vec![(None, effect)],
            _ => {
                let of_cloth = |(index, cloth): (usize, &Cloth)| {
                    let effect = self.own[index].get(name).or(of_scene)?;
                    effect.acts_on().is_in(cloth).then_some((Some(index), effect))
                };
                self.cloths.iter().enumerate().filter_map(of_cloth).collect()
            }
        }
    }

    /// Returns the properties of each cloth that effects announce.
    pub(crate) fn fabrics(&self) -> Vec<Fabric> {
        let mut fabrics = vec![Fabric::default(); self.cloths.len()];
        for name in self.names() {
            for (cloth, effect) in self.acting(name) {
                effect.announce(&mut fabrics[cloth.unwrap_or(0)]);
            }
        }
        fabrics
    }

    pub(crate) fn check(&self, world: &SceneParts<'_>) -> Result<(), Wrong> {
        let names = self.names();
        let fabrics = self.fabrics();
        for &name in &names {
            let own = self.own.iter().position(|own| own.get(name).is_some());
            let complain = |error| {
                let cloth = own.filter(|_| self.by_scene.get(name).is_none());
                Wrong { name, cloth, error }
            };
            if let Some(registration) = registration_of(name) {
                let checked = registration.check_needs(name, |other| names.contains(&other));
                checked.map_err(complain)?;
            }
            let acting = self.acting(name);
            self.check_scope(name, own, acting.len())?;
            self.check_acts(name, acting.len())?;
            for (cloth, effect) in acting {
                let world = world.of_cloth(cloth);
                let checked = effect.check(&world).and_then(|()| effect.check_fabrics(&world, &fabrics));
                checked.map_err(|error| self.wrong(name, cloth, error))?;
            }
        }
        Ok(())
    }

    /// Checks that a cloth's own effect may belong to one cloth, and that effects between cloths belong to all of them.
    fn check_scope(&self, name: &'static str, own: Option<usize>, acting: usize) -> Result<(), Wrong> {
        let Some(cloth) = own else { return Ok(()) };
        let wrong = |message| Err(self.wrong(name, own, ValueError::new("", message)));
        match self.own[cloth].get(name).map(Effect::scope) {
            Some(Scope::Scene) => wrong(format!(
                "'{name}' acts on the whole scene, so no cloth may have its own: name it in [effects.{name}]"
            )),
            Some(Scope::AllCloths) if acting < self.cloths.len() => wrong(format!(
                "'{name}' acts between cloths: name it in [effects.{name}] for all of them, or in every cloth"
            )),
            _ => Ok(()),
        }
    }

    /// Checks that each effect has something to act on.
    fn check_acts(&self, name: &'static str, acting: usize) -> Result<(), Wrong> {
        let wrong = |index: Option<usize>, effect: &dyn Effect| {
            let message = effect.acts_on().complaint(name, index.map(|index| &self.cloths[index]));
            Err(self.wrong(name, index, ValueError::new("", message)))
        };
        for (index, (cloth, own)) in self.cloths.iter().zip(&self.own).enumerate() {
            if let Some(effect) = own.get(name).filter(|effect| !effect.acts_on().is_in(cloth)) {
                return wrong(Some(index), effect);
            }
        }
        match self.by_scene.get(name) {
            Some(effect) if acting == 0 => wrong(None, effect),
            _ => Ok(()),
        }
    }

    fn wrong(&self, name: &'static str, cloth: Option<usize>, error: ValueError) -> Wrong {
        let of = match cloth {
            Some(cloth) if self.cloths.len() > 1 => format!("{name} of '{}'", self.cloths[cloth].name),
            _ => name.to_owned(),
        };
        Wrong {
            name,
            cloth: cloth.filter(|&cloth| self.own[cloth].get(name).is_some()),
            error: error.with_owner(&of),
        }
    }

    /// Registers all effects with the plan; returns their names.
    pub(crate) fn register(&self, plan: &mut Plan<'_>) -> Vec<&'static str> {
        plan.fabrics = self.fabrics();
        let names = self.names();
        for (index, name) in names.iter().enumerate() {
            for (cloth, effect) in self.acting(name) {
                plan.begin(index, cloth);
                effect.register(plan);
            }
        }
        names
    }
}
