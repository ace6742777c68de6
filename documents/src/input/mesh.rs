//! Reads meshes of bodies from files: STL, as text or binary, and OBJ.

use super::file::{MAX_BYTES, bytes};
use super::{InputError, shown};
use super::{Place, Source};
use affinor::mechanics::Mesh;
use nalgebra::Vector3;
use std::io::Cursor;

type Corners = Vec<[Vector3<f64>; 3]>;

/// Sizes in a binary STL file, in bytes: the header, which ends with the number of triangles, and
/// each triangle.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;

/// Reads a closed mesh from a file whose name ends in `.stl` or `.obj`, or from standard input for `-`.
///
/// # Errors
/// Those of [`mesh`]; an error for a file that cannot be read.
pub fn read_mesh(path: &str) -> Result<Mesh, InputError> {
    let (name, bytes) = bytes(path, MAX_BYTES)?;
    mesh(&name, &bytes)
}

/// Reads a closed mesh from the bytes of a file; the file name extension determines the format.
///
/// Vertices with equal coordinates are identified. All solids of an STL file, and all objects of an
/// OBJ file, form a single mesh. Polygons are divided into triangles. Coordinates in a binary STL
/// file have the precision of `f32`; coordinates in a text file have the precision of `f64`.
///
/// ```
/// use affinor_documents::input::mesh;
/// let pyramid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4";
/// assert!((mesh("pyramid.obj", pyramid.as_bytes())?.mass_properties().mass() - 1.0 / 6.0).abs() < 1e-16);
///
/// let error = mesh("pyramid.obj", pyramid.replace("2 4", "2 5").as_bytes()).unwrap_err();
/// assert_eq!(error.to_string(), "not a valid OBJ file: the file has no vertex 5");
/// assert_eq!(error.at.unwrap().text(), Some("f 1 2 5"));
/// # Ok::<(), affinor_documents::input::InputError>(())
/// ```
///
/// # Errors
/// An error with its location for a file that is neither STL nor OBJ; otherwise those of
/// [`Mesh::new`].
pub fn mesh(name: &str, bytes: &[u8]) -> Result<Mesh, InputError> {
    let ending = name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
    let corners = match ending.as_str() {
        "stl" => stl(name, bytes)?,
        "obj" => obj(&Source::new(name, &String::from_utf8_lossy(bytes)))?,
        _ => {
            let error =
                InputError::usage(format!("{} does not have the name of a mesh file", shown(name)));
            return Err(error.help("the name of a mesh file must end in .stl or .obj"));
        }
    };
    Mesh::from_triangles(corners).map_err(|error| {
        let error = InputError::from(error).at(&Place::within(Source::new(name, "")));
        error.help("the mesh must be closed, with triangles counterclockwise as seen from outside")
    })
}

fn stl(name: &str, bytes: &[u8]) -> Result<Corners, InputError> {
    // recognizes text: a binary file may also begin with the word `solid`, but its number of
    // triangles contains a zero byte
    let begins = bytes.trim_ascii_start().get(..5);
    if begins.is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !bytes.contains(&0) {
        return text_stl(&Source::new(name, &String::from_utf8_lossy(bytes)));
    }
    let count = bytes.get(HEAD - 4..HEAD).and_then(|count| count.try_into().ok());
    let count = count.map(|count| u32::from_le_bytes(count) as usize);
    let size = count.map(|count| HEAD + TRIANGLE * count);
    let refused =
        |message: String| Err(InputError::usage(message).at(&Place::within(Source::new(name, ""))));
    let (Some(count), Some(size)) = (count, size) else {
        return refused(
            "not a valid STL file: it neither begins with `solid` nor has a binary head".into(),
        );
    };
    if bytes.len() < size {
        let length = bytes.len();
        return refused(format!(
            "not a valid STL file: {count} triangles need {size} bytes, but the file has {length}"
        ));
    }
    // overwrites the first byte of the header, so that the reader does not take the file for text
    let mut bytes = bytes.to_vec();
    bytes[0] = 0;
    triangles(bytes)
        .or_else(|(at, reason)| refused(format!("not a valid STL file: triangle {at}: {reason}")))
}

/// Reads the triangles. The error is the number of the first invalid triangle, with the reason.
fn triangles(bytes: Vec<u8>) -> Result<Corners, (usize, String)> {
    let mut bytes = Cursor::new(bytes);
    let reader = stl_io::create_stl_reader(&mut bytes).map_err(|error| (1, error.to_string()))?;
    let corners = reader.enumerate().map(|(at, triangle)| {
        let triangle = triangle.map_err(|error| (at + 1, shown(&error.to_string())))?;
        match triangle.vertices.iter().flat_map(|v| v.0).find(|x| !x.is_finite()) {
            Some(x) => Err((at + 1, format!("the coordinate {x} is not finite"))),
            None => Ok(triangle.vertices.map(|v| Vector3::from(v.0.map(f64::from)))),
        }
    });
    corners.collect()
}

/// Reads the solids of a text file one after the other.
fn text_stl(source: &Source) -> Result<Corners, InputError> {
    let mut corners = vec![];
    let mut rest = &*source.text;
    while !rest.trim().is_empty() {
        let begins = |line: &str, word: &str| {
            line.trim_start().get(..word.len()).is_some_and(|w| w.eq_ignore_ascii_case(word))
        };
        let start = rest.trim_start();
        let (head, body) = start.split_once('\n').unwrap_or((start, ""));
        if !begins(head, "solid") {
            let place = source.find(head, 0..head.trim_end().len());
            return Err(
                InputError::usage("not a valid STL file: `solid` is expected here").at(&place)
            );
        }
        let mut lines = body.split_inclusive('\n');
        let before: usize =
            lines.by_ref().take_while(|l| !begins(l, "endsolid")).map(str::len).sum();
        let end = body.len() - lines.map(str::len).sum::<usize>();
        let (solid, after) = body.split_at(end);
        // removes the name of the solid, which is optional and ignored
        let normal = format!("solid \n{}", solid.to_ascii_lowercase());
        let rounded = triangles(normal.into_bytes()).map_err(|(at, reason)| {
            let mut facets = solid[..before].lines().filter(|line| begins(line, "facet"));
            let line = facets.nth(at - 1).or_else(|| solid.lines().last()).unwrap_or(head);
            let place = source.find(line, 0..line.len());
            InputError::usage(format!("not a valid STL file: triangle {at}: {reason}")).at(&place)
        })?;
        // parses the coordinates again, because the reader rounds them to `f32`
        let vertices = solid.lines().filter(|line| begins(line, "vertex")).filter_map(position);
        let vertices: Vec<Vector3<f64>> = vertices.collect();
        match vertices.as_chunks::<3>() {
            (exact, []) if exact.len() == rounded.len() => corners.extend_from_slice(exact),
            _ => corners.extend(rounded),
        }
        rest = after;
    }
    Ok(corners)
}

/// The coordinates of a line `vertex x y z`.
fn position(line: &str) -> Option<Vector3<f64>> {
    let coordinates: Result<Vec<f64>, _> =
        line.split_whitespace().skip(1).map(str::parse).collect();
    Some(Vector3::from(<[f64; 3]>::try_from(coordinates.ok()?).ok()?))
}

/// Reads the faces of an OBJ file, divided into triangles. Colours, textures, normals and materials
/// are ignored.
fn obj(source: &Source) -> Result<Corners, InputError> {
    let refused = |line: &str, reason: &str| {
        InputError::usage(format!("not a valid OBJ file: {reason}")).at(&source.whole(line))
    };
    let (mut vertices, mut faces) = (vec![], vec![]);
    for line in source.text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut position = Vector3::zeros();
                for coordinate in position.iter_mut() {
                    let word = words.next().unwrap_or_default();
                    *coordinate =
                        word.parse().map_err(|_| refused(line, "a vertex needs three numbers"))?;
                    if !f64::is_finite(*coordinate) {
                        return Err(refused(
                            line,
                            &format!("the coordinate {} is not finite", shown(word)),
                        ));
                    }
                }
                vertices.push(position);
            }
            Some("f") => {
                let index = |word: &str| word.split('/').next()?.parse().ok();
                let indices = words.map(index).collect::<Option<Vec<i64>>>();
                let indices = indices.filter(|indices| indices.len() >= 3);
                let indices = indices.ok_or_else(|| {
                    refused(line, "the vertices of a face must be three or more integers")
                })?;
                faces.push((line, vertices.len() as i64, indices));
            }
            _ => {}
        }
    }
    let mut corners = vec![];
    for (line, before, indices) in faces {
        // a positive index counts from 1, a negative index counts backwards from the face
        let vertex = |index: &i64| {
            let at = if *index < 0 { before + index } else { index - 1 };
            let found = usize::try_from(at).ok().and_then(|at| vertices.get(at).copied());
            found.ok_or_else(|| refused(line, &format!("the file has no vertex {index}")))
        };
        let polygon = indices.iter().map(vertex).collect::<Result<Vec<_>, _>>()?;
        let edges = polygon[1..].windows(2);
        corners.extend(edges.map(|edge| [polygon[0], edge[0], edge[1]]));
    }
    Ok(corners)
}
