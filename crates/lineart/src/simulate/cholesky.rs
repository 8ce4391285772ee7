//! Sparse Cholesky factorisation, multifrontal, for meshes in the plane.
//!
//! A = L Lᵀ for a symmetric positive definite matrix whose unknowns have places ([`super::dissect`]). Blocks of unknowns are
//! eliminated one after the other (Duff and Reid 1983): a dense matrix, the *front*, collects the block's columns of A and
//! what its children left over; its first columns are factored; what remains below them is left over for the parent. All
//! the work is in dense columns.
//!
//! [`Plan`] is what depends on the mesh alone (order, fronts); [`Plan::factor`] needs the numbers, and [`Factor::solve`] a
//! right-hand side: change what you need to.
//!
//! Only + − × ÷ √ in a fixed order: results agree to the bit on every machine, which is not so for libraries that choose
//! their instructions by the processor they find.

use feature_sampling::geometry::Point;

use super::dissect::{Dissection, Graph, dissect};

/// A symmetric matrix: its diagonal, and what stands beside the edges of a graph, each edge from both its ends.
#[derive(Clone, Debug, Default)]
pub(super) struct Matrix {
    pub(super) graph: Graph,
    pub(super) diagonal: Vec<f64>,
    /// In step with the graph's `to`.
    pub(super) beside: Vec<f64>,
}

impl Matrix {
    /// A times a vector.
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        let row = |i: usize| {
            let range = self.graph.first[i]..self.graph.first[i + 1];
            let beside = self.graph.to[range.clone()].iter().zip(&self.beside[range]);
            beside.fold(self.diagonal[i] * x[i], |sum, (&j, value)| sum + value * x[j as usize])
        };
        (0..self.diagonal.len()).map(row).collect()
    }
}

/// The matrix is not positive definite: this unknown's pivot is not above zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NotDefinite {
    pub(super) unknown: usize,
}

/// A front: the unknowns eliminated in it, a range of the order, and the later ones that it touches, by their places in
/// the order, ascending.
#[derive(Clone, Debug)]
struct Front {
    from: usize,
    to: usize,
    below: Vec<u32>,
    children: Vec<usize>,
}

impl Front {
    fn width(&self) -> usize {
        self.to - self.from
    }

    fn height(&self) -> usize {
        self.width() + self.below.len()
    }
}

/// How a mesh is factored; see the module.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    order: Vec<u32>,
    /// The place of each unknown in the order.
    place: Vec<u32>,
    fronts: Vec<Front>,
}

/// Columns of L, front by front: dense, column after column, each as high as its front.
#[derive(Clone, Debug)]
pub(super) struct Factor {
    columns: Vec<Vec<f64>>,
}

impl Plan {
    pub(super) fn new(graph: &Graph, points: &[Point<f64>]) -> Self {
        let Dissection { order, blocks } = dissect(graph, points);
        let mut place = vec![0; order.len()];
        for (i, &unknown) in (0..).zip(&order) {
            place[unknown as usize] = i;
        }
        let mut fronts: Vec<Front> = Vec::with_capacity(blocks.len());
        for block in blocks {
            let end = u32::try_from(block.to).unwrap_or(u32::MAX);
            let own = order[block.from..block.to].iter();
            let mut below: Vec<u32> =
                own.flat_map(|&v| graph.neighbours(v as usize)).map(|&w| place[w as usize]).collect();
            below.extend(block.children.iter().flat_map(|&child| &fronts[child].below));
            below.retain(|&row| row >= end);
            below.sort_unstable();
            below.dedup();
            fronts.push(Front { from: block.from, to: block.to, below, children: block.children });
        }
        Self { order, place, fronts }
    }

    /// Entries of the factor.
    pub(super) fn entries(&self) -> usize {
        self.fronts.iter().map(|front| front.width() * front.height()).sum()
    }

    pub(super) fn factor(&self, matrix: &Matrix) -> Result<Factor, NotDefinite> {
        let mut columns = Vec::with_capacity(self.fronts.len());
        // What each front left over, until its parent takes it: dense, square, lower half.
        let mut left: Vec<Vec<f64>> = vec![Vec::new(); self.fronts.len()];
        let mut row_of = vec![0_usize; self.order.len()];
        for (i, front) in self.fronts.iter().enumerate() {
            let (width, height) = (front.width(), front.height());
            for (row, place) in (front.from..front.to).chain(front.below.iter().map(|&b| b as usize)).enumerate() {
                row_of[place] = row;
            }
            let mut dense = vec![0.0; height * height];
            for (column, &unknown) in self.order[front.from..front.to].iter().enumerate() {
                let v = unknown as usize;
                dense[column * height + column] += matrix.diagonal[v];
                for k in matrix.graph.first[v]..matrix.graph.first[v + 1] {
                    let other = self.place[matrix.graph.to[k] as usize] as usize;
                    if other > front.from + column {
                        dense[column * height + row_of[other]] += matrix.beside[k];
                    }
                }
            }
            for &child in &front.children {
                let below = &self.fronts[child].below;
                let from = std::mem::take(&mut left[child]);
                for (c, &column) in below.iter().enumerate() {
                    let target = row_of[column as usize] * height;
                    let source = &from[c * below.len()..(c + 1) * below.len()];
                    for (&row, value) in below[c..].iter().zip(&source[c..]) {
                        dense[target + row_of[row as usize]] += value;
                    }
                }
            }
            if let Err(column) = eliminate(&mut dense, width, height) {
                return Err(NotDefinite { unknown: self.order[front.from + column] as usize });
            }
            let rest = height - width;
            left[i] = Vec::with_capacity(rest * rest);
            for column in width..height {
                left[i].extend_from_slice(&dense[column * height + width..(column + 1) * height]);
            }
            dense.truncate(width * height);
            dense.shrink_to_fit();
            columns.push(dense);
        }
        Ok(Factor { columns })
    }

    /// Solves A x = b.
    pub(super) fn solve(&self, factor: &Factor, b: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = self.order.iter().map(|&unknown| b[unknown as usize]).collect();
        for (front, columns) in self.fronts.iter().zip(&factor.columns) {
            let (width, height) = (front.width(), front.height());
            for (c, column) in columns.chunks_exact(height).enumerate() {
                let value = x[front.from + c] / column[c];
                x[front.from + c] = value;
                for (row, l) in (front.from + c + 1..front.to).zip(&column[c + 1..]) {
                    x[row] -= l * value;
                }
                for (&row, l) in front.below.iter().zip(&column[width..]) {
                    x[row as usize] -= l * value;
                }
            }
        }
        for (front, columns) in self.fronts.iter().zip(&factor.columns).rev() {
            let (width, height) = (front.width(), front.height());
            for (c, column) in columns.chunks_exact(height).enumerate().rev() {
                let mut sum = x[front.from + c];
                for (row, l) in (front.from + c + 1..front.to).zip(&column[c + 1..]) {
                    sum -= l * x[row];
                }
                for (&row, l) in front.below.iter().zip(&column[width..]) {
                    sum -= l * x[row as usize];
                }
                x[front.from + c] = sum / column[c];
            }
        }
        let mut out = vec![0.0; x.len()];
        for (&unknown, value) in self.order.iter().zip(x) {
            out[unknown as usize] = value;
        }
        out
    }
}

/// Columns that are eliminated before the rest of the front is brought up to date.
const PANEL: usize = 32;

/// Factors the first `width` columns of a dense symmetric matrix (column after column, lower half) and brings the rest up
/// to date. Fails with the column whose pivot is not positive.
fn eliminate(a: &mut [f64], width: usize, height: usize) -> Result<(), usize> {
    let mut from = 0;
    while from < width {
        let to = (from + PANEL).min(width);
        for k in from..to {
            let pivot = a[k * height + k];
            // Also false for NaN.
            if !(pivot > 0.0 && pivot.is_finite()) {
                return Err(k);
            }
            let root = pivot.sqrt();
            a[k * height + k] = root;
            a[k * height + k + 1..(k + 1) * height].iter_mut().for_each(|value| *value /= root);
            let (done, rest) = a.split_at_mut((k + 1) * height);
            let column = &done[k * height..];
            for j in k + 1..to {
                let factor = column[j];
                let target = &mut rest[(j - k - 1) * height + j..(j - k) * height];
                for (value, l) in target.iter_mut().zip(&column[j..]) {
                    *value -= factor * l;
                }
            }
        }
        let (done, rest) = a.split_at_mut(to * height);
        let panel = &done[from * height..];
        for j in to..height {
            let target = &mut rest[(j - to) * height + j..(j - to + 1) * height];
            let mut columns = panel.chunks_exact(height);
            // Four columns at a time: each value is loaded and stored once for eight operations.
            while columns.len() >= 4 {
                let four: [&[f64]; 4] = std::array::from_fn(|_| columns.next().unwrap_or_default());
                let [p, q, r, s] = four.map(|column| column[j]);
                let [a, b, c, d] = four.map(|column| &column[j..]);
                for ((((value, a), b), c), d) in target.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    *value -= (p * a + q * b) + (r * c + s * d);
                }
            }
            for column in columns {
                let factor = column[j];
                for (value, l) in target.iter_mut().zip(&column[j..]) {
                    *value -= factor * l;
                }
            }
        }
        from = to;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix of a grid with random couplings, diagonally dominant by a little.
    fn grid(n: u32) -> (Matrix, Vec<Point<f64>>) {
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let points: Vec<_> = (0..n * n)
            .map(|i| Point::new(f64::from(i % n) + 0.3 * random(), f64::from(i / n) + 0.3 * random()))
            .collect();
        let weight = |a: u32, b: u32| -0.1 - f64::from((a.min(b) * 7919 + a.max(b) * 104_729) % 101) / 100.0;
        let mut matrix = Matrix { graph: Graph { first: vec![0], to: vec![] }, diagonal: vec![], beside: vec![] };
        for i in 0..n * n {
            let (x, y) = (i % n, i / n);
            let mut sum = 0.01;
            for (ok, j) in
                [(x > 0, i.wrapping_sub(1)), (x + 1 < n, i + 1), (y > 0, i.wrapping_sub(n)), (y + 1 < n, i + n)]
            {
                if ok {
                    matrix.graph.to.push(j);
                    matrix.beside.push(weight(i, j));
                    sum -= weight(i, j);
                }
            }
            matrix.diagonal.push(sum);
            matrix.graph.first.push(matrix.graph.to.len());
        }
        (matrix, points)
    }

    #[test]
    fn solves_what_it_multiplied() {
        for n in [1, 2, 5, 23, 60] {
            let (matrix, points) = grid(n);
            let plan = Plan::new(&matrix.graph, &points);
            let factor = plan.factor(&matrix).expect("positive definite");
            let x: Vec<f64> = (0..n * n).map(|i| f64::from(i % 17) - 8.0).collect();
            let found = plan.solve(&factor, &matrix.times(&x));
            let worst = x.iter().zip(&found).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs()));
            assert!(worst < 1e-10, "{n}: {worst}");
        }
    }

    #[test]
    fn the_factor_stays_sparse() {
        let (matrix, points) = grid(100);
        let entries = Plan::new(&matrix.graph, &points).entries();
        // Nested dissection of an n by n grid leaves 31/4 n² log₂ n (George 1973); the band of rows one after the other n³ = 10⁶.
        assert!((entries as f64) < 7.75 * 10_000.0 * 100.0_f64.log2(), "{entries}");
    }

    #[test]
    fn what_is_not_definite_is_said() {
        let (mut matrix, points) = grid(30);
        let plan = Plan::new(&matrix.graph, &points);
        matrix.diagonal[411] = -1.0;
        assert!(plan.factor(&matrix).is_err(), "a negative diagonal");
        matrix.diagonal[411] = f64::NAN;
        assert!(plan.factor(&matrix).is_err(), "no number");
    }
}
