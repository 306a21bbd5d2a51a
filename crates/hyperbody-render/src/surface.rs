//! What a ray of the picture sees: the surface, its colours, and what lies transparently before it.

use hyperbody::collision::RayStack;
use hyperbody::collision::ray::{Ray, RayHit};
use hyperbody::geometry::shape::Piece;
use hyperbody::geometry::{Convex, Core};
use hyperbody::math::Vector;

use crate::colour::Rgb;
use crate::light::smooth;
use crate::solid::Solid;
use crate::stage::{GHOST_REACH, Plane, Stage};

/// One sample of the picture, before light.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Seen {
    /// Equal for samples of one facet of one body: [`SKY`], [`FLOOR`], or a mix of the numbers of solid and facet.
    pub(crate) key: u32,
    /// Number of the solid among those that the slice cuts, or [`NO_SOLID`]: a ray nearby may well meet it too.
    pub(crate) solid: u32,
    pub(crate) distance: f64,
    pub(crate) point: Vector<3>,
    /// Of the surface.
    pub(crate) normal: Vector<3>,
    /// Of the surface as it takes light: bent at edges, as if they were worn.
    pub(crate) bent_normal: Vector<3>,
    pub(crate) albedo: Rgb,
    /// 0 for matt, 1 for polished.
    pub(crate) gloss: f32,
    /// How much of the colour is the sky's: far floor fades into the horizon.
    pub(crate) haze: f32,
    /// What lies before it: colour times coverage, and coverage.
    pub(crate) veil: Rgb,
    pub(crate) veil_cover: f32,
}

/// Where no solid is seen.
pub(crate) const NO_SOLID: u32 = u32::MAX;

pub(crate) const SKY: u32 = 0;
pub(crate) const FLOOR: u32 = 1;

/// Working memory of one thread.
#[derive(Default)]
pub(crate) struct Scratch<const N: usize> {
    pub(crate) stack: RayStack,
    ghosts: Vec<(u32, RayHit<N>)>,
    veils: Vec<(f64, Rgb, f32)>,
}

/// What a facet's section looks like at a point: how far its nearest edge is, and the normal beyond that edge.
struct Edge {
    distance: f64,
    normal_beyond: Vector<3>,
}

/// Width of worn edges, in sizes of a body.
const BEVEL: f64 = 0.045;

impl<const N: usize> Stage<N> {
    /// What a ray sees. `pixel_angle` is the width of a pixel at unit distance, for lines that are as wide as they are;
    /// `guess` is a solid that it may meet, or [`NO_SOLID`].
    pub(crate) fn look(
        &self,
        ray: &Ray<3>,
        pixel_angle: f64,
        ghosts: bool,
        guess: u32,
        scratch: &mut Scratch<N>,
    ) -> Seen {
        let hit = self.cut.first_hit(ray, guess, &mut scratch.stack);
        let mut seen = match &hit {
            Some((index, hit)) => self.body_surface(*index, hit, ray, pixel_angle),
            None => Seen { key: SKY, solid: NO_SOLID, distance: f64::INFINITY, haze: 1.0, ..Seen::default() },
        };
        scratch.veils.clear();
        for plane in &self.planes {
            let height = plane.normal.dot(ray.origin) - plane.offset;
            let closing = -plane.normal.dot(ray.direction);
            if height <= 0.0 || closing <= 0.0 {
                continue;
            }
            let distance = height / closing;
            if distance < seen.distance && plane.is_floor {
                seen = self.floor_surface(plane, ray, distance, pixel_angle);
            } else if !plane.is_floor {
                let (colour, cover) = self.wall(plane, ray.at(distance), distance * pixel_angle);
                scratch.veils.push((distance, colour, cover));
            }
        }
        if ghosts {
            self.add_ghost_veils(ray, seen.distance, pixel_angle, scratch);
        }
        veil(&mut seen, &mut scratch.veils);
        seen
    }

    fn body_surface(&self, index: u32, hit: &RayHit<N>, ray: &Ray<3>, pixel_angle: f64) -> Seen {
        let solid = &self.cut.solids[index as usize];
        let look = &self.bodies[solid.body as usize];
        let normal = solid.seen_normal(hit.normal, ray.direction).try_normalize().unwrap_or(-ray.direction);
        let distance = hit.fraction;
        let mut bent_normal = normal;
        let mut albedo = look.colour;
        if let (Some(facet), false) = (hit.facet, is_rounded(&solid.piece)) {
            albedo = tinted(albedo, facet, solid.part);
            let width = (BEVEL * self.size) as f32;
            let pixel = (distance * pixel_angle) as f32;
            if let Some(edge) = edge(solid, facet, hit.point, normal, f64::from(width.max(pixel))) {
                let away = edge.distance as f32;
                // Where a bevel is narrower than a pixel, its share of the pixel is left.
                let strength = (width / pixel).min(1.0);
                let near = 1.0 - smooth(0.0, width.max(pixel), away);
                bent_normal = (normal + edge.normal_beyond * f64::from(near * near * strength)).normalize_or_zero();
                albedo = albedo.mix(albedo.saturated(0.75) * 1.25 + Rgb::grey(0.06), near * strength * 0.55);
            }
        }
        let key = 2
            + (index.wrapping_mul(0x9e37_79b1) ^ hit.facet.map_or(0, |facet| facet + 1).wrapping_mul(0x85eb_ca6b))
                % 0xffff_fff0;
        let point = ray.at(distance);
        Seen { key, solid: index, distance, point, normal, bent_normal, albedo, gloss: 1.0, ..Seen::default() }
    }

    fn floor_surface(&self, plane: &Plane, ray: &Ray<3>, distance: f64, pixel_angle: f64) -> Seen {
        let point = ray.at(distance);
        let grazing = (-plane.normal.dot(ray.direction)).max(1e-3);
        // Seen at a slant, a pixel covers more of the floor one way than the other.
        let footprint = distance * pixel_angle;
        let reach = 30.0 * self.size + 5.0 * self.spread;
        let far = (distance / reach).min(10.0);
        let lines = self.grid(plane, point, footprint / grazing.sqrt());
        let albedo = self.tones.floor.mix(self.tones.lines, lines * 0.6);
        let haze = 1.0 - hyperbody::math::scalar::exp(-far * far) as f32;
        Seen {
            key: FLOOR,
            solid: NO_SOLID,
            distance,
            point,
            normal: plane.normal,
            bent_normal: plane.normal,
            albedo,
            gloss: 0.15,
            haze,
            ..Seen::default()
        }
    }

    /// How much of a pixel is covered by the lines of the grid, by the line's share of the footprint.
    fn grid(&self, plane: &Plane, point: Vector<3>, footprint: f64) -> f32 {
        // In meshes.
        let (point, footprint) = (point * (1.0 / self.mesh), footprint / self.mesh);
        let width = 0.012 * self.size.max(0.3) / self.mesh;
        let mut cover = 0.0_f32;
        for axis in 0..3 {
            let slope = (1.0 - plane.normal[axis] * plane.normal[axis]).max(0.0).sqrt();
            // Axes along the plane's normal have no lines in it.
            if slope < 0.5 {
                continue;
            }
            let away = (point[axis] - point[axis].round()).abs() / slope;
            let reach = 0.5 * (width + footprint);
            let share = ((reach - away) / footprint).clamp(0.0, 1.0) * (width / footprint).min(1.0);
            cover = cover.max(share as f32);
        }
        // Meshes smaller than a few pixels become an even tone.
        let even = (2.0 * width) as f32;
        cover + (even - cover) * smooth(0.15, 0.6, footprint as f32)
    }

    /// A wall: a fence of glass that fades with height, so that what stands behind it stays in sight.
    fn wall(&self, plane: &Plane, point: Vector<3>, footprint: f64) -> (Rgb, f32) {
        let height = (self.up.dot(point) - self.floor_height) / (3.2 * self.size);
        if !(-0.01..1.0).contains(&height) {
            return (Rgb::BLACK, 0.0);
        }
        let fade = (1.0 - height as f32) * (1.0 - height as f32);
        let lines = self.grid(plane, point, footprint);
        (self.tones.wall, fade * (0.05 + 0.4 * lines))
    }

    fn add_ghost_veils(&self, ray: &Ray<3>, before: f64, pixel_angle: f64, scratch: &mut Scratch<N>) {
        let mut hits = std::mem::take(&mut scratch.ghosts);
        self.ghosts.all_hits(&ray.up_to(before), &mut scratch.stack, &mut hits);
        for (index, hit) in &hits {
            let solid = &self.ghosts.solids[*index as usize];
            let look = &self.bodies[solid.body as usize];
            let normal = solid.seen_normal(hit.normal, ray.direction).try_normalize().unwrap_or(-ray.direction);
            let fade = 1.0 - look.gap().unwrap_or(0.0) / (GHOST_REACH * self.size);
            let facing = (-normal.dot(ray.direction)).clamp(0.0, 1.0) as f32;
            let rim = (1.0 - facing) * (1.0 - facing);
            let mut cover = 0.07 + 0.4 * rim;
            let pixel = (hit.fraction * pixel_angle) as f32;
            let width = (0.018 * self.size) as f32;
            if let (Some(facet), false) = (hit.facet, is_rounded(&solid.piece))
                && let Some(edge) = edge(solid, facet, hit.point, normal, f64::from(width + 1.5 * pixel))
            {
                let line = 1.0 - smooth(width, width + 1.5 * pixel, edge.distance as f32);
                cover = cover.max(0.75 * line * (width / pixel).min(1.0));
            }
            scratch.veils.push((hit.fraction, look.glass, cover * (fade.max(0.0) as f32)));
        }
        scratch.ghosts = hits;
    }
}

/// Lays what is transparent over what is behind, from near to far.
fn veil(seen: &mut Seen, veils: &mut [(f64, Rgb, f32)]) {
    veils.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut left = 1.0;
    for (_, colour, cover) in veils.iter().filter(|(distance, ..)| *distance < seen.distance) {
        seen.veil += *colour * (left * cover);
        left *= 1.0 - cover;
    }
    seen.veil_cover = 1.0 - left;
}

fn is_rounded<const N: usize>(piece: &Piece<N>) -> bool {
    !matches!(piece, Piece::Convex(Convex { radius, .. }) if *radius == 0.0)
}

/// Every cell its own shade of the body's colour.
fn tinted(albedo: Rgb, facet: u32, part: u32) -> Rgb {
    // Multiples of the golden ratio spread evenly, and neighbours far apart.
    let spread = f64::from(facet + 5 * part) * 0.618_033_988_749_895 + 0.3;
    let shade = (spread - spread.floor()) as f32 - 0.5;
    (albedo * (1.0 + 0.34 * shade)).saturated(1.0 - 0.25 * shade)
}

/// The nearest edge of a facet's section that is less than `within` away: the facets beside it, each with its distance along
/// the section.
fn edge<const N: usize>(
    solid: &Solid<N>,
    facet: u32,
    local: Vector<N>,
    normal: Vector<3>,
    within: f64,
) -> Option<Edge> {
    let mut nearest: Option<Edge> = None;
    let mut least = within;
    let mut consider = |gap: f64, beside: Vector<N>| {
        // Along the section it is as far as through the body, or farther.
        if gap >= least {
            return;
        }
        let seen = solid.seen_normal(beside, -normal);
        let along = (seen - normal * normal.dot(seen)).norm();
        if along > 1e-6 {
            let distance = (gap / along).max(0.0);
            if distance < least {
                least = distance;
                nearest = Some(Edge { distance, normal_beyond: seen.normalize_or_zero() });
            }
        }
    };
    match &solid.piece {
        Piece::Convex(Convex { core: Core::Box { half_extents }, .. }) => {
            for axis in (0..N).filter(|&axis| axis != facet as usize / 2) {
                consider(half_extents[axis] - local[axis], Vector::unit(axis));
                consider(half_extents[axis] + local[axis], -Vector::unit(axis));
            }
        }
        Piece::Convex(Convex { core: Core::Polytope(polytope), .. }) => {
            for &beside in &polytope.facets()[facet as usize].neighbours {
                let plane = &polytope.facets()[beside as usize];
                consider(plane.offset - plane.normal.dot(local), plane.normal);
            }
        }
        _ => {}
    }
    nearest
}
