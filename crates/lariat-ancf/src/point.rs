//! Points and vectors in the types that users have.

use nalgebra::Vector3;

/// A point or vector that a function takes: from an array of `f32` or `f64`, nalgebra's
/// `Vector3<f64>`, or, with feature `glam`, glam's `Vec3` and `DVec3`; and back.
///
/// ```
/// use lariat_ancf::{Cable, Point, Section, Vector3};
///
/// let section = Section::wire_rope(0.012)?;
/// let a = Cable::builder().points([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0]]).section(section).build()?;
/// let b = Cable::builder().points([Vector3::zeros(), Vector3::new(4.0, 0.0, 0.0)]).section(section).build()?;
/// assert_eq!(a.positions(), b.positions());
/// let middle: [f32; 3] = Point(a.sample(2.0)?.position).into();
/// assert_eq!(middle[0], 2.0);
/// # Ok::<(), lariat_ancf::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point(pub Vector3<f64>);

impl From<[f64; 3]> for Point {
    fn from(p: [f64; 3]) -> Self {
        Point(p.into())
    }
}

impl From<[f32; 3]> for Point {
    fn from(p: [f32; 3]) -> Self {
        Point(p.map(f64::from).into())
    }
}

impl From<Vector3<f64>> for Point {
    fn from(p: Vector3<f64>) -> Self {
        Point(p)
    }
}

impl From<Point> for [f64; 3] {
    fn from(p: Point) -> Self {
        p.0.into()
    }
}

impl From<Point> for [f32; 3] {
    fn from(p: Point) -> Self {
        p.0.map(|x| x as f32).into()
    }
}

#[cfg(feature = "glam")]
mod glam_vectors {
    use super::Point;

    impl From<glam::Vec3> for Point {
        fn from(p: glam::Vec3) -> Self {
            p.to_array().into()
        }
    }

    impl From<glam::DVec3> for Point {
        fn from(p: glam::DVec3) -> Self {
            p.to_array().into()
        }
    }

    impl From<Point> for glam::Vec3 {
        fn from(p: Point) -> Self {
            glam::Vec3::from_array(p.into())
        }
    }

    impl From<Point> for glam::DVec3 {
        fn from(p: Point) -> Self {
            glam::DVec3::from_array(p.into())
        }
    }
}
