//! Bodies bounded by triangle meshes.

use super::MassProperties;
use crate::Error;
use nalgebra::{Matrix3, Vector3};
use std::collections::HashMap;

/// If the ratio of the volume to the sum of its parts is below this value, the volume counts as
/// rounding error.
const FLAT: f64 = 1e-12;

/// A closed surface of triangles. The vertices are counterclockwise as seen from outside.
///
/// Every edge belongs to exactly two triangles, in opposite directions, so the surface bounds a
/// volume of one or several pieces. The triangles of a cavity are counterclockwise as seen from
/// within the cavity. Intersections of pieces are not checked; where pieces overlap, the volume
/// counts twice.
///
/// ```
/// use affinor::mechanics::Mesh;
/// use nalgebra::Vector3;
/// let corners = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
/// let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
/// let body = Mesh::new(corners.to_vec(), faces.to_vec())?.mass_properties();
/// assert!((body.mass() - 1.0 / 6.0).abs() < 1e-16);
/// assert!((body.centre() - Vector3::repeat(0.25)).norm() < 1e-16);
///
/// let open = Mesh::new(corners.to_vec(), faces[1..].to_vec()).unwrap_err();
/// let reason = "invalid solid: the edge from (1, 0, 0) to (0, 0, 0) belongs to no triangle, but triangle 1 has the opposite edge";
/// assert_eq!(open.to_string(), reason);
/// # Ok::<(), affinor::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    vertices: Vec<Vector3<f64>>,
    triangles: Vec<[usize; 3]>,
    /// The mass, the centre and the second moments at density 1.
    solid: MassProperties,
}

impl Mesh {
    /// A solid bounded by triangles. Each triangle contains the indices of its vertices.
    ///
    /// Triangles in which a vertex occurs twice are ignored.
    ///
    /// # Errors
    /// [`Error::Invalid`], with an edge, if the surface is not closed, if it branches, or if its
    /// orientations are inconsistent. [`Error::Invalid`] also for a surface without volume or with
    /// inward orientation, and for an index without a vertex. [`Error::Overflow`] for vertices that
    /// are not finite, or too large.
    pub fn new(vertices: Vec<Vector3<f64>>, triangles: Vec<[usize; 3]>) -> Result<Self, Error> {
        for (at, vertex) in vertices.iter().enumerate() {
            if let Some(value) = vertex.iter().find(|value| !value.is_finite()) {
                let component = format!("a coordinate of vertex {}", at + 1);
                return Err(Error::Overflow { component, value: value.to_string() });
            }
        }
        for (at, triangle) in triangles.iter().enumerate() {
            if let Some(index) = triangle.iter().find(|index| **index >= vertices.len()) {
                let (at, index, count) = (at + 1, index + 1, vertices.len());
                return Err(refused(format!(
                    "triangle {at} refers to vertex {index}, but there are {count} vertices"
                )));
            }
        }
        expect_closed(&vertices, &triangles)?;
        let solid = solid(&vertices, &triangles)?;
        Ok(Mesh { vertices, triangles, solid })
    }

    /// A solid bounded by triangles. Each triangle contains its corners; corners with equal
    /// coordinates are the same vertex.
    ///
    /// # Errors
    /// The errors of [`Mesh::new`].
    pub fn from_triangles(
        corners: impl IntoIterator<Item = [Vector3<f64>; 3]>,
    ) -> Result<Self, Error> {
        let (mut vertices, mut known) = (Vec::new(), HashMap::new());
        let mut index = |corner: Vector3<f64>| {
            // adds 0, so that -0 and 0 have the same bits
            let bits: [u64; 3] = corner.map(|x| (x + 0.0).to_bits()).into();
            *known.entry(bits).or_insert_with(|| {
                vertices.push(corner);
                vertices.len() - 1
            })
        };
        let triangles = corners.into_iter().map(|corners| corners.map(&mut index)).collect();
        Self::new(vertices, triangles)
    }

    /// The vertices.
    pub fn vertices(&self) -> &[Vector3<f64>] {
        &self.vertices
    }

    /// The triangles. Each contains the indices of its vertices.
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// The body of density 1. It is a signed sum over the tetrahedra between a point and the
    /// triangles. With the vertices `a, b, c` relative to this point, and `s = a + b + c`,
    ///
    /// ```text
    /// V = det(a, b, c)/6    int X dV = V s/4    int X X^T dV = V (a a^T + b b^T + c c^T + s s^T)/20
    /// ```
    ///
    /// S. Lien and J. Kajiya, *IEEE Computer Graphics and Applications* 4(10) (1984) 35-42; F.
    /// Tonon, *J. Mathematics and Statistics* 1 (2005) 8-11.
    pub fn mass_properties(&self) -> MassProperties {
        self.solid
    }
}

fn refused(reason: String) -> Error {
    Error::Invalid { what: "solid", reason }
}

/// Checks that every directed edge occurs in one triangle, and that another triangle contains the
/// opposite edge.
fn expect_closed(vertices: &[Vector3<f64>], triangles: &[[usize; 3]]) -> Result<(), Error> {
    let edges = || {
        let whole =
            triangles.iter().enumerate().filter(|(_, [a, b, c])| a != b && b != c && c != a);
        whole.flat_map(|(at, [a, b, c])| [(*a, *b), (*b, *c), (*c, *a)].map(|edge| (edge, at + 1)))
    };
    let written = |(from, to): (usize, usize)| {
        let place = |v: &Vector3<f64>| format!("({}, {}, {})", v.x, v.y, v.z);
        format!("the edge from {} to {}", place(&vertices[from]), place(&vertices[to]))
    };
    let mut owners = HashMap::new();
    for (edge, triangle) in edges() {
        if let Some(other) = owners.insert(edge, triangle) {
            let edge = written(edge);
            return Err(refused(format!(
                "{edge} is in triangle {other} and, in the same direction, in triangle {triangle}"
            )));
        }
    }
    for ((from, to), triangle) in edges() {
        if !owners.contains_key(&(to, from)) {
            let edge = written((to, from));
            return Err(refused(format!(
                "{edge} belongs to no triangle, but triangle {triangle} has the opposite edge"
            )));
        }
    }
    Ok(())
}

fn solid(vertices: &[Vector3<f64>], triangles: &[[usize; 3]]) -> Result<MassProperties, Error> {
    // uses coordinates relative to the mean of the vertices, to avoid cancellation if the mesh is
    // far from the origin
    let count = vertices.len().max(1) as f64;
    let middle = vertices.iter().fold(Vector3::zeros(), |sum, v| sum + v / count);
    let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
    // sums of magnitudes, which bound the rounding errors of the sums
    let (mut size, mut size_of_second) = (0.0, 0.0);
    for triangle in triangles {
        let [a, b, c] = triangle.map(|at| vertices[at] - middle);
        let part = a.dot(&b.cross(&c)) / 6.0;
        let s = a + b + c;
        let products = [a, b, c, s].iter().fold(Matrix3::zeros(), |sum, x| sum + x * x.transpose());
        volume += part;
        first += s * (part / 4.0);
        second += products * (part / 20.0);
        size += part.abs();
        size_of_second += products.norm() * part.abs() / 20.0;
    }
    if size.is_finite() && volume <= FLAT * size {
        let flat = volume.abs() <= FLAT * size;
        let what = if flat { "encloses no volume" } else { "is inside out" };
        return Err(refused(format!(
            "the surface {what}: its volume with this orientation is {volume}"
        )));
    }
    let offset = first / volume;
    second -= offset * offset.transpose() * volume;
    MassProperties::of_moments(volume, middle + offset, second)?.checked(size_of_second)
}
