//! Which sites are connected so far: union by size with path halving (Tarjan).

/// Disjoint sets of numbers.
pub(crate) struct Union {
    parent: Vec<u32>,
    size: Vec<u32>,
}

impl Union {
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..).take(count).collect(), size: vec![1; count] }
    }

    /// The number that stands for the set of `item`.
    pub(crate) fn find(&mut self, mut item: u32) -> u32 {
        while self.parent[item as usize] != item {
            let grandparent = self.parent[self.parent[item as usize] as usize];
            self.parent[item as usize] = grandparent;
            item = grandparent;
        }
        item
    }

    /// Joins two sets; whether they were two.
    pub(crate) fn join(&mut self, [a, b]: [u32; 2]) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        let [large, small] = if self.size[a as usize] >= self.size[b as usize] { [a, b] } else { [b, a] };
        if large != small {
            self.parent[small as usize] = large;
            self.size[large as usize] += self.size[small as usize];
        }
        large != small
    }
}
