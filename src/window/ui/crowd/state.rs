//! `CrowdState`, which robot of a crowd is picked, and how its world is shown.

use std::sync::Arc;

use super::values::CrowdView;

/// The state of the panes that show crowds.
#[derive(Clone, Debug, Default)]
pub struct CrowdState {
    /// The robot that is picked. Its words and its scan are shown, and it can be followed and driven.
    pub picked: Option<Picked>,
    /// Whether the view follows the robot that is picked.
    pub follows: bool,
    /// Whether the places where contacts began are shown.
    pub heat: bool,
    /// What is searched in the list.
    pub search: String,
    /// Whether the list holds only robots with contacts.
    pub with_contacts: bool,
    /// The robots found last.
    pub found: Option<NameMatches>,
}

/// A robot that is picked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picked {
    /// Its id.
    pub id: u32,
    /// Its name.
    pub name: String,
}

/// The robots whose names hold what was searched.
#[derive(Clone, Debug)]
pub struct NameMatches {
    names: Arc<[String]>,
    search: String,
    /// Their ids, ascending.
    ids: Arc<[u32]>,
}

impl CrowdState {
    /// The robot of this crowd that is picked.
    pub fn picked_in(&self, crowd: &CrowdView) -> Option<&Picked> {
        self.picked.as_ref().filter(|p| crowd.name(p.id) == Some(&p.name))
    }

    /// Picks a robot of this crowd, or none.
    pub fn pick(&mut self, crowd: &CrowdView, id: Option<u32>) {
        self.picked = id.and_then(|id| Some(Picked { id, name: crowd.name(id)?.to_owned() }));
        self.follows &= self.picked.is_some();
    }

    /// The ids of the robots whose names hold the search, whatever the case of its letters.
    pub fn found(&mut self, crowd: &CrowdView) -> Arc<[u32]> {
        let search = self.search.trim().to_lowercase();
        let is_same = |f: &&NameMatches| Arc::ptr_eq(&f.names, &crowd.names) && f.search == search;
        let found = match self.found.as_ref().filter(is_same) {
            Some(found) => Arc::clone(&found.ids),
            None => {
                let all = crowd.names.iter().zip(crowd.first..);
                let ids = all.filter(|(name, _)| name.to_lowercase().contains(&search)).map(|(_, id)| id).collect();
                let found = NameMatches { names: Arc::clone(&crowd.names), search, ids };
                Arc::clone(&self.found.insert(found).ids)
            }
        };
        if !self.with_contacts {
            return found;
        }
        let has_contacts =
            |id: &u32| crowd.place(*id).is_some_and(|i| crowd.now.get(i).is_some_and(|r| r.contacts > 0));
        found.iter().copied().filter(has_contacts).collect()
    }
}
