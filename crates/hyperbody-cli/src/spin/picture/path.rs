//! The path of the momentum in the body, on its sphere or spheres.
//!
//! In 3D the momentum keeps its length: its tip moves on a sphere, along the curves in which surfaces of equal energy cut
//! it; the separatrix through the poles of the middle plane is drawn with it. In 4D the momentum is the sum of a self-dual
//! and an anti-self-dual part, two vectors of three numbers each, and both keep their lengths, since their squares are
//! ½|M|² ± the Pfaffian: two spheres. From 5D on the path is shown in the three planes that take most part in it, inside
//! the smallest ball that holds it.

use hyperbody::math::scalar;
use plotters::element::{Circle, PathElement};
use plotters::prelude::Color;
use plotters::style::text_anchor::HPos;

use super::chart::LEFT;
use super::style::{
    BLUE, GREEN, GREY, INK, LABEL, LINE, PALE, SKY, SMALL, Stroke, THIN, TITLE, VERMILLION, line, units, write,
};
use super::{Area, Drawn, WIDTH};
use crate::output::number;
use crate::spin::report::Report;

/// Radius of a sphere in the picture, in pixels.
const RADIUS: f64 = 290.0;

/// From where the spheres are seen: turned about the vertical, then tilted, in radians.
const AZIMUTH: f64 = 0.62;
const ELEVATION: f64 = 0.38;

type Point = [f64; 3];

/// A vector of three numbers that moves.
struct Sphere {
    title: String,
    axes: [String; 3],
    /// Largest length, kg m²/s or m²/s.
    radius: f64,
    points: Vec<Point>,
    /// Curves to compare with, on the unit sphere.
    guides: Vec<Vec<Point>>,
    /// Whether the points lie on the sphere and not inside.
    on_surface: bool,
}

/// Draws the spheres of a run over the whole area.
pub(super) fn draw(area: &Area<'_>, report: &Report) -> Drawn {
    let spheres = spheres(report);
    let title = "Path of the angular momentum in the body";
    write(area, title, (LEFT, 34.0), TITLE, INK, HPos::Left)?;
    let step = WIDTH / spheres.len() as f64;
    for (index, sphere) in spheres.iter().enumerate() {
        let centre = ((0.5 + index as f64) * step, 410.0);
        sphere.draw(area, centre)?;
    }
    draw_legend(area, &spheres)
}

fn spheres(report: &Report) -> Vec<Sphere> {
    let momentum = &report.angular_momentum_in_body.0;
    let of =
        |name: &str| momentum.iter().find(|(plane, _)| plane == name).map_or(&[][..], |(_, values)| values.as_slice());
    let unit = if report.moments_unit == "m²" { "m²/s" } else { "kg m²/s" };
    let combine = |first: [&str; 3], second: [&str; 3], signs: [f64; 3], scale: f64| -> Vec<Point> {
        (0..report.times.len())
            .map(|k| {
                std::array::from_fn(|axis| {
                    let partner = of(second[axis]).get(k).copied().unwrap_or(0.0);
                    scale * (of(first[axis]).get(k).copied().unwrap_or(0.0) + signs[axis] * partner)
                })
            })
            .collect()
    };
    match report.dimension {
        3 => {
            let points = combine(["yz", "xz", "xy"], [""; 3], [0.0; 3], 1.0);
            // The momentum about y is that of plane zx.
            let points: Vec<Point> = points.into_iter().map(|[x, y, z]| [x, -y, z]).collect();
            let mut sphere = Sphere::new(String::new(), ["yz", "zx", "xy"].map(str::to_owned), points, true);
            sphere.title = format!("|M| = {} {unit}", number(sphere.radius));
            sphere.guides = separatrix(&report.moments);
            vec![sphere]
        }
        4 => [1.0, -1.0]
            .map(|sign| {
                // Self-dual: xy + zw, xz − yw, xw + yz; anti-self-dual: the other signs.
                let signs = [sign, -sign, sign];
                let points = combine(["xy", "xz", "xw"], ["zw", "yw", "yz"], signs, 0.5_f64.sqrt());
                let join = |sign: f64| if sign > 0.0 { "+" } else { "−" };
                let name = |first: &str, second: &str, sign: f64| format!("{first} {} {second}", join(sign));
                let axes = [name("xy", "zw", signs[0]), name("xz", "yw", signs[1]), name("xw", "yz", signs[2])];
                let kind = if sign > 0.0 { "self-dual" } else { "anti-self-dual" };
                let mut sphere = Sphere::new(String::new(), axes, points, true);
                sphere.title = format!("{kind} part, length {} {unit}", number(sphere.radius));
                sphere
            })
            .into(),
        _ => {
            let mut order: Vec<usize> = (0..momentum.len()).collect();
            let reach = |index: usize| {
                let values = &momentum[index].1;
                let (low, high) =
                    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
                high - low
            };
            order.sort_by(|&a, &b| reach(b).total_cmp(&reach(a)));
            let names: [&str; 3] =
                std::array::from_fn(|k| order.get(k).map_or("", |&index| momentum[index].0.as_str()));
            let points = combine(names, [""; 3], [0.0; 3], 1.0);
            let mut sphere = Sphere::new(String::new(), names.map(str::to_owned), points, false);
            let (reach, whole) = (number(sphere.radius), number(report.conserved.angular_momentum_sq.sqrt()));
            sphere.title = format!("three of {} planes: radius {reach}, |M| = {whole} {unit}", momentum.len());
            vec![sphere]
        }
    }
}

/// The great circles through the poles of the middle plane that part the motions about the others (3D).
fn separatrix(moments: &[f64]) -> Vec<Vec<Point>> {
    let inertia = [moments[1] + moments[2], moments[2] + moments[0], moments[0] + moments[1]];
    let mut order = [0, 1, 2];
    order.sort_by(|&a: &usize, &b: &usize| inertia[a].total_cmp(&inertia[b]));
    let [low, middle, high] = order;
    let below = 1.0 / inertia[low] - 1.0 / inertia[middle];
    let above = 1.0 / inertia[middle] - 1.0 / inertia[high];
    if below <= 0.0 || above <= 0.0 {
        return Vec::new();
    }
    let slope = (below / above).sqrt();
    let length = (1.0 + slope * slope).sqrt();
    [slope, -slope]
        .map(|slope| {
            (0..=180)
                .map(|k| {
                    let (sin, cos) = scalar::sin_cos(f64::from(k) * 2.0_f64.to_radians());
                    let mut point = [0.0; 3];
                    point[middle] = cos;
                    point[low] = sin / length;
                    point[high] = sin * slope / length;
                    point
                })
                .collect()
        })
        .into()
}

impl Sphere {
    fn new(title: String, axes: [String; 3], points: Vec<Point>, on_surface: bool) -> Self {
        let length = |p: &Point| (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
        let radius = points.iter().map(length).fold(0.0, f64::max);
        Self { title, axes, radius, points, guides: Vec::new(), on_surface }
    }

    fn draw(&self, area: &Area<'_>, centre: (f64, f64)) -> Drawn {
        area.draw(&Circle::new((units(centre.0), units(centre.1)), units(RADIUS), line(GREY, THIN)))?;
        if self.on_surface {
            for circle in graticule() {
                draw_curve(area, centre, &circle, |front| front.then_some((PALE, THIN)))?;
            }
            for guide in &self.guides {
                draw_guide(area, centre, guide)?;
            }
        }
        self.draw_axes(area, centre)?;
        if self.radius > 0.0 {
            let path: Vec<Point> = self.points.iter().map(|p| p.map(|c| c / self.radius)).collect();
            if self.on_surface {
                draw_curve(area, centre, &path, |front| (!front).then_some((SKY, 0.6 * LINE)))?;
                draw_curve(area, centre, &path, |front| front.then_some((BLUE, LINE)))?;
            } else {
                draw_curve(area, centre, &path, |_| Some((BLUE, 0.7 * LINE)))?;
            }
            if let Some(start) = path.first() {
                let at = place(centre, *start);
                area.draw(&Circle::new((units(at.0), units(at.1)), units(9.0), GREEN.filled()))?;
            }
        }
        let below = (centre.0, centre.1 + RADIUS + 44.0);
        write(area, &self.title, below, LABEL, INK, HPos::Center)
    }

    /// The axes from the surface outwards, those in front in full.
    fn draw_axes(&self, area: &Area<'_>, centre: (f64, f64)) -> Drawn {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let end = |length: f64| {
                    let mut point = [0.0; 3];
                    point[axis] = sign * length;
                    place(centre, point)
                };
                let mut tip = [0.0; 3];
                tip[axis] = sign;
                let front = depth(tip) >= 0.0;
                let (from, to) = (end(1.0), end(1.12));
                let colour = if front { INK } else { GREY };
                let points = vec![(units(from.0), units(from.1)), (units(to.0), units(to.1))];
                area.draw(&PathElement::new(points, line(colour, THIN)))?;
                if sign > 0.0 {
                    let name = end(1.2);
                    let anchor = if name.0 < centre.0 - 40.0 {
                        HPos::Right
                    } else if name.0 > centre.0 + 40.0 {
                        HPos::Left
                    } else {
                        HPos::Center
                    };
                    write(area, &self.axes[axis], name, SMALL, colour, anchor)?;
                }
            }
        }
        Ok(())
    }
}

/// Parallels and meridians.
fn graticule() -> Vec<Vec<Point>> {
    let circle = |point: &dyn Fn(f64, f64) -> Point| -> Vec<Point> {
        (0..=120)
            .map(|k| {
                let (sin, cos) = scalar::sin_cos(f64::from(k) * 3.0_f64.to_radians());
                point(sin, cos)
            })
            .collect()
    };
    let mut circles = Vec::new();
    for step in -2..=2 {
        let (height, width) = scalar::sin_cos(f64::from(step) * 30.0_f64.to_radians());
        circles.push(circle(&|sin, cos| [width * cos, width * sin, height]));
    }
    for step in 0..6 {
        let (y, x) = scalar::sin_cos(f64::from(step) * 30.0_f64.to_radians());
        circles.push(circle(&|sin, cos| [x * sin, y * sin, cos]));
    }
    circles
}

/// Towards the viewer.
fn depth([x, y, z]: Point) -> f64 {
    let outwards = x * scalar::cos(AZIMUTH) + y * scalar::sin(AZIMUTH);
    outwards * scalar::cos(ELEVATION) + z * scalar::sin(ELEVATION)
}

/// Where a point of the unit sphere lies in the picture, in pixels.
fn place(centre: (f64, f64), [x, y, z]: Point) -> (f64, f64) {
    let right = -x * scalar::sin(AZIMUTH) + y * scalar::cos(AZIMUTH);
    let outwards = x * scalar::cos(AZIMUTH) + y * scalar::sin(AZIMUTH);
    let up = z * scalar::cos(ELEVATION) - outwards * scalar::sin(ELEVATION);
    (centre.0 + RADIUS * right, centre.1 - RADIUS * up)
}

/// Draws the parts of a curve in front and behind as `style` says; `None` leaves a part out.
fn draw_curve(
    area: &Area<'_>,
    centre: (f64, f64),
    points: &[Point],
    style: impl Fn(bool) -> Option<(plotters::style::RGBColor, f64)>,
) -> Drawn {
    for (front, piece) in pieces(points) {
        if let Some((colour, width)) = style(front) {
            let places = piece.iter().map(|&point| place(centre, point)).map(|(x, y)| (units(x), units(y)));
            area.draw(&PathElement::new(places.collect::<Vec<_>>(), line(colour, width)))?;
        }
    }
    Ok(())
}

fn draw_guide(area: &Area<'_>, centre: (f64, f64), points: &[Point]) -> Drawn {
    for (front, piece) in pieces(points) {
        if front {
            let places = piece.iter().map(|&point| place(centre, point)).map(|(x, y)| (units(x), units(y)));
            Stroke::dashed(VERMILLION).draw(area, &places.collect::<Vec<_>>(), THIN)?;
        }
    }
    Ok(())
}

/// A curve in pieces that lie in front or behind; neighbours share a point.
fn pieces(points: &[Point]) -> Vec<(bool, Vec<Point>)> {
    let mut pieces: Vec<(bool, Vec<Point>)> = Vec::new();
    for &point in points {
        let front = depth(point) >= 0.0;
        match pieces.last_mut() {
            Some((side, piece)) if *side == front => piece.push(point),
            Some((_, piece)) => {
                piece.push(point);
                pieces.push((front, vec![point]));
            }
            None => pieces.push((front, vec![point])),
        }
    }
    pieces
}

fn draw_legend(area: &Area<'_>, spheres: &[Sphere]) -> Drawn {
    let y = 34.0;
    let mut x = 900.0;
    let mut entry = |draw: &dyn Fn(f64) -> Drawn, words: &str, width: f64| -> Drawn {
        draw(x)?;
        write(area, words, (x + 52.0, y), SMALL, INK, HPos::Left)?;
        x += width;
        Ok(())
    };
    let bar = |x: f64| [(units(x), units(y)), (units(x + 42.0), units(y))];
    entry(&|x| Ok(area.draw(&Circle::new((units(x + 34.0), units(y)), units(9.0), GREEN.filled()))?), "start", 150.0)?;
    if spheres.iter().all(|sphere| sphere.on_surface) {
        let colours = [(BLUE, LINE, "in front", 160.0), (SKY, 0.6 * LINE, "behind", 150.0)];
        for (colour, width, words, room) in colours {
            entry(&|x| Ok(area.draw(&PathElement::new(bar(x).to_vec(), line(colour, width)))?), words, room)?;
        }
    }
    if spheres.iter().any(|sphere| !sphere.guides.is_empty()) {
        entry(&|x| Stroke::dashed(VERMILLION).draw(area, &bar(x), THIN), "separatrix", 200.0)?;
    }
    Ok(())
}
