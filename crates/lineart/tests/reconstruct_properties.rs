//! What has to hold of reconstructions for any points, and for points moved, scaled and renumbered.

use std::collections::BTreeSet;

use feature_sampling::geometry::Point;
use lineart::reconstruct::{Algorithm, HnnCrust, Peel, Reconstruction, Sites, gabriel, influence, urquhart};
use proptest::prelude::*;

type Edges = BTreeSet<(usize, usize)>;

fn sites(points: &[Point<f64>]) -> Sites {
    Sites::new(points).expect("finite")
}

fn edges(algorithm: Algorithm, points: &[Point<f64>]) -> Edges {
    algorithm.edges(&sites(points)).into_iter().collect()
}

/// Points in general position, also after shrinking: each is moved by an amount of its own, so that no two are equal.
fn cloud() -> impl Strategy<Value = Vec<Point<f64>>> {
    prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64), 3..60).prop_map(|list| {
        let own = |i: f64, by: f64| 0.1 * (i * by).fract();
        let moved = list.into_iter().zip(0_u32..).map(|((x, y), i)| {
            let i = f64::from(i + 1);
            Point::new(x + own(i, 0.618_033_988_75), y + own(i, 0.754_877_666_25))
        });
        moved.collect()
    })
}

/// Points of a small grid, with ties, right angles, repetitions and lines.
fn grid() -> impl Strategy<Value = Vec<Point<f64>>> {
    prop::collection::vec((0..7_i32, 0..7_i32), 0..50)
        .prop_map(|list| list.into_iter().map(|(x, y)| Point::new(f64::from(x), f64::from(y))).collect())
}

fn degrees(edges: &Edges, count: usize) -> Vec<usize> {
    let mut degrees = vec![0; count];
    for &(a, b) in edges {
        degrees[a] += 1;
        degrees[b] += 1;
    }
    degrees
}

fn delaunay(sites: &Sites) -> Edges {
    sites.edges().iter().map(|edge| (edge.ends[0] as usize, edge.ends[1] as usize)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn scale_and_quarter_turns_change_nothing(points in cloud(), power in -200..200_i32) {
        let scale = 2.0_f64.powi(power);
        // Both are exact, so even the rounding is the same.
        let moved: Vec<_> = points.iter().map(|p| Point::new(-p.y * scale, p.x * scale)).collect();
        for algorithm in Algorithm::ALL {
            prop_assert_eq!(edges(algorithm, &points), edges(algorithm, &moved), "{}", algorithm.name());
        }
    }

    #[test]
    fn rigid_motions_change_nothing(points in cloud(), angle in 0.0..6.3_f64, dx in -3.0..3.0_f64, dy in -3.0..3.0_f64) {
        let (sin, cos) = angle.sin_cos();
        let turned = |p: &Point<f64>| Point::new(cos * p.x - sin * p.y + dx, sin * p.x + cos * p.y + dy);
        let moved: Vec<_> = points.iter().map(turned).collect();
        for algorithm in Algorithm::ALL {
            prop_assert_eq!(edges(algorithm, &points), edges(algorithm, &moved), "{}", algorithm.name());
        }
    }

    #[test]
    fn order_of_the_points_changes_nothing(points in cloud(), seed in 0..1000_usize) {
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|i| (i * 7919 + seed * 104_729) % 1009);
        let shuffled: Vec<_> = order.iter().map(|&i| points[i]).collect();
        for algorithm in Algorithm::ALL {
            let renamed = |&(a, b): &(usize, usize)| (order[a].min(order[b]), order[a].max(order[b]));
            let found: Edges = edges(algorithm, &shuffled).iter().map(renamed).collect();
            prop_assert_eq!(edges(algorithm, &points), found, "{}", algorithm.name());
        }
    }

    #[test]
    fn subsets_and_degrees(points in cloud()) {
        let sites = sites(&points);
        let all = delaunay(&sites);
        let chosen = |flags: &[bool]| -> Edges {
            sites.edges().iter().zip(flags).filter(|(_, kept)| **kept)
                .map(|(edge, _)| (edge.ends[0] as usize, edge.ends[1] as usize)).collect()
        };
        let found = |algorithm| edges(algorithm, &points);
        for algorithm in Algorithm::ALL {
            // hnn-crust seeks half-neighbours among near sites, sigdt-components triangulates each component by itself.
            if !matches!(algorithm, Algorithm::HnnCrust | Algorithm::HnnCrustEither | Algorithm::SigdtComponents) {
                prop_assert!(found(algorithm).is_subset(&all), "{} within Delaunay", algorithm.name());
            }
        }
        let nearest: Edges = sites.numbers().filter_map(|p| sites.nearest(p).map(|q| (p.min(q) as usize, p.max(q) as usize))).collect();
        let (gabriel, urquhart, influence) = (chosen(&gabriel(&sites)), chosen(&urquhart(&sites)), chosen(&influence(&sites)));
        prop_assert!(nearest.is_subset(&influence), "nearest neighbours within the spheres of influence");
        prop_assert!(nearest.is_subset(&urquhart) && urquhart.is_subset(&gabriel) , "nearest, Urquhart, Gabriel");
        prop_assert!(found(Algorithm::Peel).is_subset(&urquhart), "peel within Urquhart");
        prop_assert!(found(Algorithm::Crust).is_subset(&gabriel), "crust within Gabriel");
        prop_assert!(found(Algorithm::ConservativeCrust).is_subset(&gabriel), "conservative-crust within Gabriel");
        prop_assert!(found(Algorithm::ConservativeCrustMedial).is_subset(&gabriel), "and its other form");
        for algorithm in [Algorithm::NnCrust, Algorithm::NnCrustDegreeOne, Algorithm::CompatibleCrust, Algorithm::Accord] {
            prop_assert!(nearest.is_subset(&found(algorithm)), "{} has the nearest neighbours", algorithm.name());
        }
        prop_assert!(found(Algorithm::NnCrustDegreeOne).is_subset(&found(Algorithm::NnCrust)), "nn-crust's forms");
        prop_assert!(found(Algorithm::HnnCrust).is_subset(&found(Algorithm::HnnCrustEither)), "hnn-crust's forms");
        for algorithm in [Algorithm::HnnCrust, Algorithm::AccordUnseeded, Algorithm::Peel, Algorithm::Crawl] {
            let degrees = degrees(&found(algorithm), points.len());
            prop_assert!(degrees.iter().all(|d| *d <= 2), "{}: {degrees:?}", algorithm.name());
        }
        for algorithm in [Algorithm::Connect2d, Algorithm::Sigdt] {
            let degrees = degrees(&found(algorithm), points.len());
            // A site that could not be sculptured free is missed.
            prop_assert!(degrees.iter().all(|d| *d == 2 || *d == 0), "{}: {degrees:?}", algorithm.name());
        }
    }

    #[test]
    fn degenerate_points_are_handled(points in grid()) {
        for algorithm in Algorithm::ALL {
            let found = edges(algorithm, &points);
            prop_assert!(found.iter().all(|&(a, b)| a < b && b < points.len()), "{}", algorithm.name());
            prop_assert!(found.iter().all(|&(a, b)| points[a] != points[b]), "{}: no edge of length 0", algorithm.name());
            prop_assert_eq!(&found, &edges(algorithm, &points), "the same again");
        }
    }

    #[test]
    fn repeated_points_change_nothing(points in cloud(), again in 0..1000_usize) {
        let mut more = points.clone();
        more.push(points[again % points.len()]);
        for algorithm in Algorithm::ALL {
            prop_assert_eq!(edges(algorithm, &points), edges(algorithm, &more), "{}", algorithm.name());
        }
    }
}

#[test]
fn collinear_points_make_a_chain() {
    let points: Vec<_> = [3, 1, 4, 0, 5, 2].map(|i| Point::new(f64::from(i * i), 2.0 * f64::from(i * i))).to_vec();
    let chain: Edges = [(1, 3), (1, 5), (0, 5), (0, 2), (2, 4)].into_iter().collect();
    for algorithm in [Algorithm::Crust, Algorithm::Connect2d, Algorithm::Sigdt, Algorithm::Accord, Algorithm::NnCrust] {
        assert_eq!(edges(algorithm, &points), chain, "{}", algorithm.name());
    }
}

#[test]
fn parameters_do_something() {
    let points: Vec<_> = (0..40_u32)
        .map(|i| {
            let t = f64::from(i) * 0.7;
            Point::new(t.sin() * (3.0 + t), (1.3 * t).cos() * (3.0 + t))
        })
        .collect();
    let sites = sites(&points);
    let one = HnnCrust { candidates: 1, ..HnnCrust::default() };
    assert_ne!(one.edges(&sites), HnnCrust::default().edges(&sites), "candidates");
    assert!(!Peel.edges(&sites).is_empty(), "something is found");
}
