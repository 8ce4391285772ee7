//! An order of elimination: nested dissection by coordinates.
//!
//! A Cholesky factor fills up between the neighbours of what is eliminated. Cut the plane in two: if the vertices along the
//! cut come last, nothing fills up across it. Each half is cut again (George 1973; Lipton, Rose and Tarjan 1979); a plane
//! mesh of n vertices then has O(n log n) entries in its factor. A mesh knows where its vertices are, so a cut is a median:
//! no order of a general graph, found without coordinates, is better or quicker here.
//!
//! The tree of cuts is also the plan of the factorisation: a *block* of vertices (a cut, or what is too small to be cut)
//! is eliminated in one go as a dense matrix, after the two blocks below it.

use feature_sampling::geometry::{Aabb, Point};

/// Below so many vertices nothing is cut: dense elimination of few columns is quicker. Found by experiment on meshes of
/// ten to a hundred thousand vertices; twice or half as many cost a tenth.
const LEAF: usize = 24;

/// Vertices eliminated together.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    /// The vertices, a range of the order.
    pub(super) from: usize,
    pub(super) to: usize,
    /// Blocks that feed into it, earlier in the list.
    pub(super) children: Vec<usize>,
}

/// The order and its tree, children before parents.
#[derive(Clone, Debug, Default)]
pub(super) struct Dissection {
    pub(super) order: Vec<u32>,
    pub(super) blocks: Vec<Block>,
}

/// A graph: the neighbours of vertex i are `to[first[i]..first[i + 1]]`.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    pub(super) first: Vec<usize>,
    pub(super) to: Vec<u32>,
}

impl Graph {
    pub(super) fn neighbours(&self, vertex: usize) -> &[u32] {
        match self.first.get(vertex..vertex + 2) {
            Some(&[from, to]) => self.to.get(from..to).unwrap_or_default(),
            _ => &[],
        }
    }
}

/// Dissects a graph whose vertices lie at points.
pub(super) fn dissect(graph: &Graph, points: &[Point<f64>]) -> Dissection {
    let mut out = Dissection::default();
    let mut vertices: Vec<u32> = (0..).zip(points).map(|(i, _)| i).collect();
    let mut side = vec![0_u32; points.len()];
    let mut mark = 0;
    cut(graph, points, &mut vertices, &mut side, &mut mark, &mut out);
    out
}

/// Orders some vertices; answers the block that they end with.
fn cut(
    graph: &Graph,
    points: &[Point<f64>],
    vertices: &mut [u32],
    side: &mut [u32],
    mark: &mut u32,
    out: &mut Dissection,
) -> Option<usize> {
    if vertices.is_empty() {
        return None;
    }
    let mut children = Vec::new();
    let mut own = vertices.len();
    if vertices.len() > LEAF {
        let extent = Aabb::around(vertices.iter().map(|&v| &points[v as usize])).extent();
        let by_y = extent.y > extent.x;
        // Ties by number: the order is a function of the mesh alone.
        let key = |v: u32| if by_y { points[v as usize].y } else { points[v as usize].x };
        let middle = vertices.len() / 2;
        vertices.select_nth_unstable_by(middle, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
        // Those of the high half that have a neighbour in the low half come last.
        *mark += 1;
        let low = *mark;
        vertices[..middle].iter().for_each(|&v| side[v as usize] = low);
        let is_border = |v: u32| graph.neighbours(v as usize).iter().any(|&w| side[w as usize] == low);
        let mut inner = middle;
        for i in middle..vertices.len() {
            if !is_border(vertices[i]) {
                vertices.swap(i, inner);
                inner += 1;
            }
        }
        // Sorted, so that where a swap put a vertex does not matter, and neighbours stay near each other.
        vertices[inner..].sort_unstable();
        own = vertices.len() - inner;
        let (rest, _) = vertices.split_at_mut(inner);
        let (first, second) = rest.split_at_mut(middle);
        children.extend(cut(graph, points, first, side, mark, out));
        children.extend(cut(graph, points, second, side, mark, out));
    } else {
        vertices.sort_unstable();
    }
    let from = out.order.len();
    out.order.extend(&vertices[vertices.len() - own..]);
    out.blocks.push(Block { from, to: out.order.len(), children });
    Some(out.blocks.len() - 1)
}
