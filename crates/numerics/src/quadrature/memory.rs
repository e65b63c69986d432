//! Where the panels of an integration are kept.

use super::Panel;

/// Memory for panels.
pub trait Memory<const K: usize> {
    /// Forgets all panels.
    fn clear(&mut self);
    /// The panels.
    fn panels(&self) -> &[Panel<K>];
    /// The panels, to be replaced.
    fn panels_mut(&mut self) -> &mut [Panel<K>];
    /// Adds a panel; false where there is no room.
    fn push(&mut self, panel: Panel<K>) -> bool;
    /// Whether there is no room for another panel.
    fn is_full(&self) -> bool;
}

/// Room for N panels, without allocation.
#[derive(Clone, Debug)]
pub struct OnStack<const K: usize, const N: usize> {
    panels: [Panel<K>; N],
    count: usize,
}

impl<const K: usize, const N: usize> Default for OnStack<K, N> {
    fn default() -> Self {
        let empty = Panel { part: 0, from: 0.0, to: 0.0, values: [0.0; K], sizes: [0.0; K], errors: [0.0; K] };
        Self { panels: [empty; N], count: 0 }
    }
}

impl<const K: usize, const N: usize> Memory<K> for OnStack<K, N> {
    fn clear(&mut self) {
        self.count = 0;
    }
    fn panels(&self) -> &[Panel<K>] {
        &self.panels[..self.count]
    }
    fn panels_mut(&mut self) -> &mut [Panel<K>] {
        &mut self.panels[..self.count]
    }
    fn push(&mut self, panel: Panel<K>) -> bool {
        let room = self.panels.get_mut(self.count).map(|room| *room = panel);
        self.count += usize::from(room.is_some());
        room.is_some()
    }
    fn is_full(&self) -> bool {
        self.count == N
    }
}

/// Room that grows with the panels, up to a bound.
#[derive(Clone, Debug)]
pub struct Growing<const K: usize> {
    panels: Vec<Panel<K>>,
    most: usize,
}

impl<const K: usize> Growing<K> {
    /// Room for up to `most` panels.
    #[must_use]
    pub const fn up_to(most: usize) -> Self {
        Self { panels: Vec::new(), most }
    }
}

impl<const K: usize> Memory<K> for Growing<K> {
    fn clear(&mut self) {
        self.panels.clear();
    }
    fn panels(&self) -> &[Panel<K>] {
        &self.panels
    }
    fn panels_mut(&mut self) -> &mut [Panel<K>] {
        &mut self.panels
    }
    fn push(&mut self, panel: Panel<K>) -> bool {
        let has_room = !self.is_full();
        if has_room {
            self.panels.push(panel);
        }
        has_room
    }
    fn is_full(&self) -> bool {
        self.most <= self.panels.len()
    }
}
