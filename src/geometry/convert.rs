//! Points and vectors to and from `glam` and `kurbo`, behind the features of these names. All conversions are exact.

/// Both directions between a type of ours and one of theirs with fields `x` and `y`.
macro_rules! same_fields {
    ($ours:ty, $theirs:ty) => {
        impl From<$theirs> for $ours {
            #[inline]
            fn from(p: $theirs) -> Self {
                Self::new(p.x, p.y)
            }
        }

        impl From<$ours> for $theirs {
            #[inline]
            fn from(p: $ours) -> Self {
                Self::new(p.x, p.y)
            }
        }
    };
}

#[cfg(feature = "glam")]
mod to_glam {
    use crate::geometry::{Point, Vector};

    same_fields!(Point<f64>, glam::DVec2);
    same_fields!(Vector<f64>, glam::DVec2);
    same_fields!(Point<f32>, glam::Vec2);
    same_fields!(Vector<f32>, glam::Vec2);

    #[cfg(test)]
    #[test]
    fn there_and_back() {
        let p = Point::new(0.1_f64, -7.0);
        assert_eq!(Point::from(glam::DVec2::from(p)), p);
        let v = Vector::new(0.1_f32, -7.0);
        assert_eq!(Vector::from(glam::Vec2::from(v)), v);
    }
}

#[cfg(feature = "kurbo")]
mod to_kurbo {
    use crate::geometry::{Point, Vector};

    same_fields!(Point<f64>, kurbo::Point);
    same_fields!(Vector<f64>, kurbo::Vec2);
}
