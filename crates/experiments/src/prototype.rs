//! The sampler of Ohrhallinger, Mitchell and Wimmer (2016), re-created from what the paper says of it: single floats, a discretised medial axis, quadratic.
//!
//! Ohrhallinger, Mitchell and Wimmer's prototype knows the curve by its foot points only. For each of them the largest empty
//! tangent disk is the smallest one through any *other foot point*, and lfs is the distance to the nearest centre. Both
//! search all points. In single precision the quotient |q − f|² / (2 n·(q − f)) of neighbours q, f loses all its digits when
//! they come close: the error grows with the number of points, as the paper's own Table 1 shows. The nearer of the two
//! sides is kept, as there.

use feature_sampling::curve::CurveParam;
use feature_sampling::geometry::Point;
use feature_sampling::lfs::FeatureSize;
use feature_sampling::model::CurveModel;

/// Foot points, medial points and lfs, in single precision, segment after segment.
#[derive(Debug)]
pub struct Prototype {
    steps: u32,
    mx: Vec<f32>,
    my: Vec<f32>,
    lfs: Vec<f32>,
}

/// Coordinates of the foot points, and unit normals there.
struct Feet {
    x: Vec<f32>,
    y: Vec<f32>,
    nx: Vec<f32>,
    ny: Vec<f32>,
}

/// Lanes that are kept apart, so that the compiler can use wide registers; the result does not depend on their number.
const LANES: usize = 8;

impl Feet {
    fn new(model: &CurveModel<f32>, steps: u32) -> Self {
        let mut feet = Self { x: vec![], y: vec![], nx: vec![], ny: vec![] };
        for segment in model.curve().segments {
            for i in 0..steps {
                let t = i as f32 / steps as f32;
                let (p, n) = (segment.point(&t), segment.tangent(&t).left());
                feet.x.push(p.x);
                feet.y.push(p.y);
                feet.nx.push(n.x);
                feet.ny.push(n.y);
            }
        }
        feet
    }

    /// The largest curvature 1/r of tangent disks at foot i that touch another foot, to the left and to the right.
    fn bends(&self, i: usize) -> [f32; 2] {
        let (fx, fy, nx, ny) = (self.x[i], self.y[i], self.nx[i], self.ny[i]);
        let (mut left, mut right) = ([0.0_f32; LANES], [0.0_f32; LANES]);
        let one = |x: f32, y: f32| {
            let (dx, dy) = (x - fx, y - fy);
            // 0/0 at the foot itself: not a number, which no comparison prefers.
            2.0 * (nx * dx + ny * dy) / (dx * dx + dy * dy)
        };
        let (xs, ys) = (self.x.chunks_exact(LANES), self.y.chunks_exact(LANES));
        let rest = xs.remainder().iter().zip(ys.remainder());
        for (x, y) in xs.zip(ys) {
            for lane in 0..LANES {
                let bend = one(x[lane], y[lane]);
                left[lane] = if bend > left[lane] { bend } else { left[lane] };
                right[lane] = if -bend > right[lane] { -bend } else { right[lane] };
            }
        }
        for (x, y) in rest {
            let bend = one(*x, *y);
            left[0] = if bend > left[0] { bend } else { left[0] };
            right[0] = if -bend > right[0] { -bend } else { right[0] };
        }
        [left, right].map(|lanes| lanes.into_iter().fold(0.0, f32::max))
    }
}

/// Distance from a point to the nearest of some points.
fn nearest(x: f32, y: f32, xs: &[f32], ys: &[f32]) -> f32 {
    let mut least = [f32::INFINITY; LANES];
    let (cx, cy) = (xs.chunks_exact(LANES), ys.chunks_exact(LANES));
    for (px, py) in cx.remainder().iter().zip(cy.remainder()) {
        least[0] = least[0].min((px - x) * (px - x) + (py - y) * (py - y));
    }
    for (px, py) in cx.zip(cy) {
        for lane in 0..LANES {
            let (dx, dy) = (px[lane] - x, py[lane] - y);
            let d = dx * dx + dy * dy;
            least[lane] = if d < least[lane] { d } else { least[lane] };
        }
    }
    least.into_iter().fold(f32::INFINITY, f32::min).sqrt()
}

impl Prototype {
    /// With `steps` foot points a segment: quadratic time in their number.
    pub fn new(model: &CurveModel<f32>, steps: u32) -> Self {
        let feet = Feet::new(model, steps);
        let mut this = Self { steps, mx: vec![], my: vec![], lfs: vec![] };
        for i in 0..feet.x.len() {
            let [left, right] = feet.bends(i);
            let (bend, sign) = if left >= right { (left, 1.0) } else { (right, -1.0) };
            if bend > 0.0 {
                let r = sign / bend;
                this.mx.push(feet.x[i] + r * feet.nx[i]);
                this.my.push(feet.y[i] + r * feet.ny[i]);
            }
        }
        this.lfs = feet.x.iter().zip(&feet.y).map(|(x, y)| nearest(*x, *y, &this.mx, &this.my)).collect();
        this
    }

    /// Distance from a point to the nearest medial point; infinite if there are none.
    #[expect(clippy::cast_possible_truncation, reason = "single precision is what it computes in")]
    pub fn distance(&self, p: &Point<f64>) -> f64 {
        f64::from(nearest(p.x as f32, p.y as f32, &self.mx, &self.my))
    }

    /// lfs of the foot point nearest in parameter to a place.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a parameter in [0, 1] times the steps"
    )]
    pub fn lfs_at(&self, segment: u32, t: f64) -> f64 {
        let i = (t * f64::from(self.steps)).round().max(0.0) as usize + segment as usize * self.steps as usize;
        // The end of the last segment has no foot of its own.
        self.lfs.get(i).or_else(|| self.lfs.last()).map_or(f64::INFINITY, |lfs| f64::from(*lfs))
    }
}

impl FeatureSize<f32> for Prototype {
    #[expect(clippy::cast_possible_truncation, reason = "it was single precision before")]
    fn lfs(&self, at: &CurveParam<f32>, _p: &Point<f32>) -> f32 {
        self.lfs_at(at.segment, f64::from(at.t)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Source;
    use feature_sampling::bezier::Cubic;
    use feature_sampling::medial::Resolution;
    use feature_sampling::model::MedialModel;

    #[test]
    fn roughly_right_with_few_points() {
        let cubic = |p: [[f64; 2]; 4]| Cubic { points: p.map(|[x, y]| Point::new(x, y)) };
        let line = |y: f64| (false, vec![cubic([[0.0, y], [30.0, y + 5.0], [70.0, y + 5.0], [100.0, y]])]);
        let source = Source { name: "two".into(), shipped: true, paths: vec![line(0.0), line(20.0)] };
        let model = source.model::<f64>(1.0).expect("a curve");
        let medial = MedialModel::new(&model, &Resolution::Tolerance(1e-6));
        let prototype = Prototype::new(&source.model::<f32>(1.0).expect("a curve"), 200);
        let curve = model.curve();
        for i in 20..=180 {
            let t = f64::from(i) / 200.0;
            let p = curve.segments[0].point(&t);
            let (found, known) = (prototype.lfs_at(0, t), medial.lfs(&p));
            assert!((found / known - 1.0).abs() < 0.02, "{t}: {found} {known}");
        }
    }
}
