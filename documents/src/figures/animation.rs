//! Animated bodies: boxes with axes of inertia, or the parts that a problem defines.

use super::{Body, Figure, Look, Panel, Role};
use crate::problem::Solid;
use crate::rows::RunRows;
use affinor::Error;
use affinor::mechanics::Inertia;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// The number of frames per second.
const RATE: f64 = 25.0;
/// The largest number of frames.
const FRAMES: f64 = 2400.0;
/// The largest number of corners of parts in all frames together. It limits a picture to about 2
/// MB.
const CORNERS: usize = 120_000;
/// The rotation between two frames, in radians. It is larger if the number of frames would exceed
/// its limit.
const TURN: f64 = 0.25;
/// Half the diagonal of the box, in radii of the picture: for a body that rotates about a fixed
/// point, and for a body on a path.
const SIZES: [f64; 2] = [0.62, 0.2];
/// The smallest edge of the box, relative to its diagonal.
const THINNEST: f64 = 0.06;
/// The distance of the farthest corner of the parts in the sphere of the axes, in radii of the
/// picture.
const PARTS: f64 = 0.9;
/// The roles whose colours distinguish bodies.
const COLORS: [Role; 6] =
    [Role::Left, Role::Velocity, Role::Right, Role::Carried, Role::Direction, Role::Frame(0)];

/// A body that moves in a trajectory.
#[derive(Clone, Debug)]
pub struct Moving {
    /// The number of the factor of the body in a product of groups; `None` for a single group.
    pub factor: Option<usize>,
    /// The inertia of the body.
    pub inertia: Inertia,
    /// The parts of the body. If the list is empty, the body is drawn as a homogeneous box with the
    /// same axes and ratios of inertia.
    pub solids: Vec<Solid>,
}

/// A body with its attitudes, and with its positions if it has a position.
struct Track<'m> {
    moving: &'m Moving,
    attitudes: Vec<Matrix3<f64>>,
    places: Option<Vec<Vector3<f64>>>,
}

/// Animates the bodies of a run; the animation lasts `seconds`. Bodies with a position move along
/// their paths in one panel. Each other body rotates about its fixed point in its own panel, which
/// shows the path of the axis of inertia that moves least.
///
/// # Errors
/// [`Error::Name`] for a trajectory without an attitude; [`Error::Invalid`] for elements that are not rotations.
pub fn animation(run: &RunRows, bodies: &[Moving], seconds: f64) -> Result<Figure, Error> {
    let times = run.column("t")?;
    let (Some(&first), Some(&last)) = (times.first(), times.last()) else {
        let reason = "there are no rows".into();
        return Err(Error::Invalid { what: "trajectory", reason });
    };
    let mut tracks = vec![];
    for moving in bodies {
        let attitudes = run.attitudes(moving.factor)?;
        tracks.push(Track { moving, attitudes, places: run.positions(moving.factor).ok() });
    }
    let whole = tracks.iter().map(Track::turn).fold(0.0, f64::max);
    let corners = |solid: &Solid| solid.faces.iter().map(Vec::len).sum::<usize>();
    let solids = || bodies.iter().flat_map(|moving| &moving.solids);
    // counts corners several times, because a part that overlaps with others in depth is drawn in
    // several layers
    let drawn = solids().map(corners).sum::<usize>() * solids().count().clamp(1, 3);
    let most = FRAMES.min((CORNERS / drawn.max(1)) as f64);
    let count = (whole / TURN).max(RATE * seconds).min(most).max(1.0).ceil() as u32;
    let film =
        Film { times: &times, span: [first, last], count, turn: whole / f64::from(count), seconds };
    let (placed, turning): (Vec<Track>, Vec<Track>) =
        tracks.into_iter().partition(|track| track.places.is_some());
    let alone = placed.len() + turning.len() == 1;
    let mut panels = vec![];
    if !placed.is_empty() {
        panels.push(space(&placed, &film));
    }
    for track in &turning {
        let title = if alone { String::new() } else { track.name() };
        panels.push(sphere(track, title, &film));
    }
    let bodies = if alone { "the body" } else { "the bodies" };
    Ok(Figure { title: format!("{}: {bodies} in motion", run.name), panels })
}

/// The times and frames of an animation.
struct Film<'t> {
    /// The times of the rows.
    times: &'t [f64],
    span: [f64; 2],
    /// The number of intervals between frames.
    count: u32,
    turn: f64,
    seconds: f64,
}

impl Film<'_> {
    /// The animated body of a track. The columns of `axes` are the axes of its frame, and its
    /// positions are relative to `centre`.
    fn body(&self, track: &Track, look: Look, axes: &Matrix3<f64>, centre: &Vector3<f64>) -> Body {
        let [first, last] = self.span;
        let pose = |k: u32| {
            let share = f64::from(k) / f64::from(self.count);
            let (at, share) = between(self.times, first + (last - first) * share);
            let next = (at + 1).min(self.times.len() - 1);
            let place =
                track.places.as_ref().map_or(*centre, |all| all[at].lerp(&all[next], share));
            let attitude = |at: usize| track.attitudes[at] * axes;
            (turned(&attitude(at), &attitude(next), share), place - centre)
        };
        let poses = (0..=self.count).map(pose).collect();
        Body { look, poses, times: self.span, turn: self.turn, seconds: self.seconds }
    }
}

impl Track<'_> {
    /// The caption of the body.
    fn name(&self) -> String {
        self.moving.factor.map_or("the body".into(), |number| format!("body {number}"))
    }

    /// The total angle through which the body rotates.
    fn turn(&self) -> f64 {
        self.attitudes.windows(2).map(|pair| angle(&pair[0], &pair[1])).sum()
    }

    /// The directions of the axes of inertia at each time.
    fn axes(&self) -> Vec<Matrix3<f64>> {
        self.attitudes.iter().map(|r| r * self.moving.inertia.axes()).collect()
    }

    /// A homogeneous box with the same ratios of inertia; `diagonal` is half its diagonal.
    fn cuboid(&self, diagonal: f64, reach: f64) -> Look {
        let moments = self.moving.inertia.principal_moments();
        let captions = [0, 1, 2].map(|i| {
            let axis = ["1", "2", "3"][i];
            format!("axis {axis} of inertia, moment {}", (moments[i] * 1e6).round() / 1e6)
        });
        let edges = self.moving.inertia.box_edges();
        let edges = edges.map(|edge| edge.max(THINNEST * edges.norm()));
        Look::Box { half: (edges * (diagonal / edges.norm())).into(), reach, captions }
    }

    /// The largest distance of a corner of the body from the origin of its frame; 0 for a body
    /// without parts.
    fn reach(&self) -> f64 {
        self.moving.solids.iter().map(Solid::reach).fold(0.0, f64::max)
    }

    /// The parts of the body, scaled.
    fn parts(&self, scale: f64, role: Role, caption: String) -> Look {
        let scaled = |solid: &Solid| {
            let corners = solid.corners.iter().map(|x| x * scale).collect();
            Solid { corners, faces: solid.faces.clone() }
        };
        Look::Parts { solids: self.moving.solids.iter().map(scaled).collect(), role, caption }
    }
}

/// The panel of a body that rotates about a fixed point.
fn sphere(track: &Track, title: String, film: &Film) -> Panel {
    let mut panel = Panel::new(title, 1.0, ["X", "Y", "Z"]);
    let (i, path) = calmest(&track.axes());
    panel.path(Role::Frame(i), &format!("path of axis {}", i + 1), path);
    let origin = Vector3::zeros();
    panel.bodies.push(if track.moving.solids.is_empty() {
        film.body(track, track.cuboid(SIZES[0], 1.0), track.moving.inertia.axes(), &origin)
    } else {
        let look = track.parts(PARTS / track.reach(), COLORS[0], "the body".into());
        film.body(track, look, &Matrix3::identity(), &origin)
    });
    panel
}

/// The panel of bodies that move along their paths in space, with a margin around them.
fn space(tracks: &[Track], film: &Film) -> Panel {
    let places = || tracks.iter().flat_map(|track| track.places.iter().flatten());
    let start = places().next().copied().unwrap_or_default();
    let corners = places().fold((start, start), |(low, high), x| (low.inf(x), high.sup(x)));
    let center = (corners.0 + corners.1) * 0.5;
    let farthest = places().map(|x| (x - center).norm()).fold(0.0, f64::max);
    // boxes have no given size, so their size is a fraction of the radius
    let has_boxes = tracks.iter().any(|track| track.moving.solids.is_empty());
    let mut radius = if has_boxes { farthest / (1.0 - SIZES[1]) } else { 0.0 };
    for track in tracks {
        let places = track.places.iter().flatten();
        let own = places.map(|x| (x - center).norm()).fold(0.0, f64::max);
        radius = radius.max(own + track.reach());
    }
    let mut panel = Panel::new("", if radius > 0.0 { radius } else { 1.0 }, ["X", "Y", "Z"]);
    panel.sphere = false;
    if center.norm() < panel.radius {
        panel.mark("O", "", -center);
    }
    for (at, track) in tracks.iter().enumerate() {
        let name = track.name();
        let path = track.places.iter().flatten().map(|place| place - center).collect();
        let role = if tracks.len() > 1 { COLORS[at % COLORS.len()] } else { Role::Motion };
        panel.path(role, &format!("path of {name}"), path);
        panel.bodies.push(if track.moving.solids.is_empty() {
            let size = SIZES[1] * panel.radius;
            film.body(track, track.cuboid(size, 1.5 * size), track.moving.inertia.axes(), &center)
        } else {
            let look = track.parts(1.0, COLORS[at % COLORS.len()], name);
            film.body(track, look, &Matrix3::identity(), &center)
        });
    }
    panel
}

/// Finds the axis with the shortest path on the sphere. Returns its number, and the path.
fn calmest(turns: &[Matrix3<f64>]) -> (usize, Vec<Vector3<f64>>) {
    let path = |i: usize| turns.iter().map(move |r| r.column(i).into_owned()).collect::<Vec<_>>();
    let length = |i: usize| -> f64 {
        turns.windows(2).map(|pair| (pair[1].column(i) - pair[0].column(i)).norm()).sum()
    };
    let lengths = [0, 1, 2].map(length);
    let shortest = (0..3).min_by(|i, j| lengths[*i].total_cmp(&lengths[*j])).unwrap_or(0);
    (shortest, path(shortest))
}

fn rotation(r: &Matrix3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*r))
}

fn angle(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    rotation(a).angle_to(&rotation(b))
}

/// The rotation at the fraction `share` of the way from one rotation to another.
fn turned(a: &Matrix3<f64>, b: &Matrix3<f64>, share: f64) -> Matrix3<f64> {
    let (a, b) = (rotation(a), rotation(b));
    let between = a.try_slerp(&b, share, 1e-9).unwrap_or(a);
    between.to_rotation_matrix().into_inner()
}

/// The index of the last row before a time, and the fraction of the interval from this row to the
/// next row.
fn between(times: &[f64], time: f64) -> (usize, f64) {
    let forwards = times[times.len() - 1] >= times[0];
    let passed = times.partition_point(|t| if forwards { *t <= time } else { *t >= time });
    let at = passed.saturating_sub(1);
    let Some(next) = times.get(at + 1) else { return (at, 0.0) };
    (at, ((time - times[at]) / (next - times[at])).clamp(0.0, 1.0))
}
