//! One table: how closely the volumes of sections, integrated over the offset, are the volume of the body, for every sort of shape in
//! every dimension that it exists in, along an oblique direction.

use std::collections::BTreeMap;

use crate::common::Random;
use crate::second_hull::{simplices_of_hull, surface};
use crate::section_volumes::{GAUSS, integrated};
use hyperbody_geometry::decompose::convex_cells;
use hyperbody_geometry::product::Factor;
use hyperbody_geometry::regular::{Size, names, polytope};
use hyperbody_geometry::{MassProperties, Polytope, Shape, SliceFrame, star};
use hyperbody_math::{Pose, Vector};

/// What the integral over the offset may be off by, relative.
const LIMIT: f64 = 1e-6;

/// Tolerance of each section, in parts of its box.
const TOLERANCE: f64 = 1e-7;

/// The worst error by sort of shape, in dimensions 2 to 6.
#[derive(Default)]
struct Table(BTreeMap<&'static str, [Option<f64>; 5]>);

impl Table {
    fn add<const N: usize>(&mut self, sort: &'static str, sections: f64, volume: f64) {
        let error = (sections / volume - 1.0).abs();
        println!("  {N}D {sort}: {error:.1e}");
        assert!(error < LIMIT, "{N}D {sort}: the sections add up to {sections}, the volume is {volume}");
        let worst = &mut self.0.entry(sort).or_default()[N - 2];
        *worst = Some(worst.unwrap_or(0.0).max(error));
    }

    fn add_shape<const N: usize>(&mut self, sort: &'static str, shape: &Shape<N>) {
        let sections = integrated(shape, oblique(), TOLERANCE);
        self.add::<N>(sort, sections, shape.mass_properties(1.0).unwrap().mass);
    }

    fn print(&self) {
        println!("{:<34}{}", "relative error", (2..=6).map(|n| format!("{:>9}", format!("{n}D"))).collect::<String>());
        for (sort, errors) in &self.0 {
            let cell = |error: &Option<f64>| error.map_or_else(|| format!("{:>9}", "-"), |e| format!("{e:>9.1e}"));
            println!("{sort:<34}{}", errors.iter().map(cell).collect::<String>());
        }
    }
}

/// A direction that is orthogonal to no face of any shape here.
fn oblique<const N: usize>() -> Vector<N> {
    Vector::from_fn(|i| [0.53, -0.71, 0.37, 0.61, -0.29, 0.43][i]).normalize_or_zero()
}

fn regular<const N: usize>(name: &str, circumradius: f64) -> Shape<N> {
    Shape::polytope(polytope(name, Size::Circumradius(circumradius)).unwrap().into()).unwrap()
}

fn factor<const N: usize>(from: usize, shape: &Shape<N>) -> Factor {
    Factor::new(std::array::from_fn::<usize, N, _>(|i| from + i), shape).unwrap()
}

fn ball<const N: usize>(from: usize) -> Factor {
    factor(from, &Shape::<N>::ball(0.5).unwrap())
}

fn capsule<const N: usize>(from: usize) -> Factor {
    factor(from, &Shape::<N>::capsule(0.4, 0.3, 1).unwrap())
}

fn cuboid<const N: usize>(from: usize) -> Factor {
    factor(from, &Shape::<N>::cuboid(Vector::from_fn(|i| 0.3 + 0.1 * i as f64)).unwrap())
}

fn rounded_box<const N: usize>(from: usize) -> Factor {
    let core = Shape::<N>::cuboid(Vector::from_fn(|i| 0.3 + 0.1 * i as f64)).unwrap();
    factor(from, &Shape::rounded(core, 0.2).unwrap())
}

fn rounded_polytope<const N: usize>(from: usize, name: &str) -> Factor {
    factor(from, &Shape::rounded(regular::<N>(name, 0.5), 0.2).unwrap())
}

/// What there is in every dimension.
fn common<const N: usize>(table: &mut Table) {
    let mut random = Random(2200 + N as u64);
    table.add_shape("ball", &Shape::<N>::ball(0.7).unwrap());
    table.add_shape("box", &Shape::cuboid(Vector::<N>::from_fn(|i| 0.3 + 0.1 * i as f64)).unwrap());
    table.add_shape("capsule", &Shape::<N>::capsule(0.6, 0.4, 0).unwrap());
    for name in names(N) {
        table.add_shape("regular polytopes, each", &regular::<N>(name, 0.8));
    }
    let hull = Polytope::from_points(&random.points::<N>(N + 8)).unwrap();
    table.add_shape("hull of random points", &Shape::polytope(hull.into()).unwrap());
    let place = |shape, random: &mut Random| (Pose::new(random.rotation(), random.vector() * 0.5), shape);
    let parts = vec![
        place(regular::<N>("simplex", 0.8), &mut random),
        place(Shape::capsule(0.4, 0.2, 1).unwrap(), &mut random),
        place(Shape::ball(0.3).unwrap(), &mut random),
    ];
    table.add_shape("compound", &Shape::compound(parts).unwrap());
    mesh::<N>(table, &mut random);
}

/// What a random closed surface bounds, cut as the convex cells that a body is made of.
fn mesh<const N: usize>(table: &mut Table, random: &mut Random) {
    // Cutting takes long where facets are many.
    let points = random.points::<N>(if N < 6 { N + 5 } else { N + 2 });
    let all = simplices_of_hull(&points);
    let some: Vec<Vec<u32>> = all.iter().enumerate().filter(|(i, _)| i % 3 != 1).map(|(_, s)| s.clone()).collect();
    let surface = surface(&points, &some);
    let volume = MassProperties::of_closed_boundary(&points, &surface).unwrap().mass;
    let cells = convex_cells(&points, &surface).unwrap();
    assert!(N == 6 || cells.len() > 1, "{N}D: a mesh that is not convex");
    let parts = cells.into_iter().map(|cell| (Pose::IDENTITY, Shape::polytope(cell.into()).unwrap())).collect();
    table.add::<N>("mesh", integrated(&Shape::compound(parts).unwrap(), oblique(), TOLERANCE), volume);
}

fn stars<const N: usize>(table: &mut Table, symbols: &[&str]) {
    for symbol in symbols {
        let cells = star::cells::<N>(&star::symbol(symbol).unwrap(), Size::Circumradius(1.0), 4096).unwrap();
        let volume = cells.iter().map(|cell| MassProperties::of_polytope(cell).mass).sum();
        let parts = cells.into_iter().map(|cell| (Pose::IDENTITY, Shape::polytope(cell.into()).unwrap())).collect();
        table.add::<N>("star", integrated(&Shape::compound(parts).unwrap(), oblique(), TOLERANCE), volume);
    }
}

fn products(table: &mut Table) {
    fn add<const N: usize>(table: &mut Table, sort: &'static str, factors: Vec<Factor>) {
        table.add_shape(sort, &Shape::<N>::product(factors).unwrap());
    }
    const BALLS: &str = "product of balls (duocylinder …)";
    const FLAT: &str = "product of balls and polytopes";
    const CAPSULE: &str = "product with a capsule";
    const ROUNDED: &str = "product with a rounded box";
    const ROUNDED_POLYTOPE: &str = "product with a rounded polytope";
    const PRISM: &str = "product of polytopes (duoprism …)";
    add::<4>(table, BALLS, vec![ball::<2>(0), ball::<2>(2)]);
    add::<5>(table, BALLS, vec![ball::<2>(0), ball::<3>(2)]);
    add::<6>(table, BALLS, vec![ball::<2>(0), ball::<4>(2)]);
    add::<6>(table, BALLS, vec![ball::<3>(0), ball::<3>(3)]);
    add::<6>(table, BALLS, vec![ball::<2>(0), ball::<2>(2), ball::<2>(4)]);
    add::<3>(table, FLAT, vec![ball::<2>(0), cuboid::<1>(2)]);
    add::<4>(table, FLAT, vec![ball::<3>(0), cuboid::<1>(3)]);
    add::<4>(table, FLAT, vec![ball::<2>(0), cuboid::<2>(2)]);
    add::<4>(table, FLAT, vec![ball::<2>(0), factor(2, &regular::<2>("triangle", 0.6))]);
    add::<5>(table, FLAT, vec![ball::<2>(0), ball::<2>(2), cuboid::<1>(4)]);
    add::<5>(table, FLAT, vec![ball::<2>(0), factor(2, &regular::<3>("dodecahedron", 0.6))]);
    add::<5>(table, FLAT, vec![ball::<4>(0), cuboid::<1>(4)]);
    add::<6>(table, FLAT, vec![ball::<2>(0), factor(2, &regular::<4>("24-cell", 0.6))]);
    add::<6>(table, FLAT, vec![ball::<3>(0), ball::<2>(3), cuboid::<1>(5)]);
    add::<6>(table, FLAT, vec![ball::<3>(0), cuboid::<3>(3)]);
    add::<3>(table, CAPSULE, vec![capsule::<2>(0), cuboid::<1>(2)]);
    add::<4>(table, CAPSULE, vec![capsule::<3>(0), cuboid::<1>(3)]);
    add::<4>(table, CAPSULE, vec![capsule::<2>(0), ball::<2>(2)]);
    add::<5>(table, CAPSULE, vec![capsule::<3>(0), ball::<2>(3)]);
    add::<6>(table, CAPSULE, vec![capsule::<4>(0), cuboid::<2>(4)]);
    add::<3>(table, ROUNDED, vec![rounded_box::<2>(0), cuboid::<1>(2)]);
    add::<4>(table, ROUNDED, vec![rounded_box::<3>(0), cuboid::<1>(3)]);
    add::<5>(table, ROUNDED, vec![rounded_box::<3>(0), cuboid::<2>(3)]);
    add::<5>(table, ROUNDED, vec![rounded_box::<3>(0), ball::<2>(3)]);
    add::<5>(table, ROUNDED, vec![rounded_box::<4>(0), cuboid::<1>(4)]);
    add::<6>(table, ROUNDED, vec![rounded_box::<3>(0), ball::<3>(3)]);
    add::<6>(table, ROUNDED, vec![rounded_box::<4>(0), ball::<2>(4)]);
    add::<4>(table, ROUNDED_POLYTOPE, vec![rounded_polytope::<3>(0, "octahedron"), cuboid::<1>(3)]);
    add::<5>(table, ROUNDED_POLYTOPE, vec![rounded_polytope::<3>(0, "tetrahedron"), ball::<2>(3)]);
    add::<6>(table, ROUNDED_POLYTOPE, vec![rounded_polytope::<4>(0, "simplex"), ball::<2>(4)]);
    add::<6>(table, ROUNDED, vec![rounded_box::<3>(0), cuboid::<3>(3)]);
    let polygon = |from, name| factor(from, &regular::<2>(name, 0.6));
    add::<3>(table, PRISM, vec![polygon(0, "7-gon"), cuboid::<1>(2)]);
    add::<4>(table, PRISM, vec![polygon(0, "triangle"), polygon(2, "pentagon")]);
    add::<5>(table, PRISM, vec![factor(0, &regular::<3>("icosahedron", 0.6)), polygon(3, "pentagon")]);
    add::<6>(table, PRISM, vec![polygon(0, "triangle"), polygon(2, "pentagon"), polygon(4, "square")]);
}

fn pyramids(table: &mut Table) {
    fn add<const N: usize>(table: &mut Table, sort: &'static str, base: Factor) {
        table.add_shape(sort, &Shape::<N>::pyramid(base, 0.9).unwrap());
    }
    const FLAT: &str = "pyramid";
    const BALL: &str = "cone over a ball";
    const CAPSULE: &str = "cone over a capsule";
    const ROUNDED: &str = "cone over a rounded box";
    add::<3>(table, FLAT, factor(0, &regular::<2>("pentagon", 0.6)));
    add::<4>(table, FLAT, factor(0, &regular::<3>("dodecahedron", 0.6)));
    add::<5>(table, FLAT, factor(0, &regular::<4>("24-cell", 0.6)));
    add::<6>(table, FLAT, factor(0, &regular::<5>("orthoplex", 0.6)));
    add::<3>(table, BALL, ball::<2>(0));
    add::<4>(table, BALL, ball::<3>(0));
    add::<5>(table, BALL, ball::<4>(0));
    add::<3>(table, CAPSULE, capsule::<2>(0));
    add::<4>(table, CAPSULE, capsule::<3>(0));
    add::<5>(table, CAPSULE, capsule::<4>(0));
    add::<3>(table, ROUNDED, rounded_box::<2>(0));
    add::<4>(table, ROUNDED, rounded_box::<3>(0));
    add::<5>(table, ROUNDED, rounded_box::<4>(0));
    add::<5>(table, "cone over a rounded polytope", rounded_polytope::<4>(0, "simplex"));
}

/// ∫ of sections that take long: five nodes between each two of these parts of the way to the ends, more of them near the ends, on
/// two threads.
fn integrated_sparsely<const N: usize>(shape: &Shape<N>, panels: u32) -> f64 {
    let normal = oblique::<N>();
    let solid = &shape.solids()[0];
    let (low, high) = (-solid.reach(-normal), solid.reach(normal));
    let part = |first: u32| {
        let mut sum = 0.0;
        for panel in (first..panels).step_by(2) {
            for (node, weight) in GAUSS {
                let t = (f64::from(panel) + 0.5 * (1.0 + node)) / f64::from(panels);
                let frame = SliceFrame::from_normal(normal, low + (high - low) * t * t * (3.0 - 2.0 * t)).unwrap();
                let section = solid.section_volume(&frame, TOLERANCE).unwrap();
                sum += 3.0 * (high - low) * t * (1.0 - t) * weight / f64::from(panels) * section;
            }
        }
        sum
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(|| part(1));
        part(0) + other.join().expect("no panic")
    })
}

fn rounded<const N: usize>(table: &mut Table, name: &str, panels: u32) {
    let core = match name {
        "box" => Shape::cuboid(Vector::<N>::from_fn(|i| 0.3 + 0.05 * i as f64)).unwrap(),
        _ => regular::<N>(name, 0.7),
    };
    let sort = if name == "box" { "rounded box" } else { "rounded polytope" };
    let shape = Shape::rounded(core, 0.3).unwrap();
    let start = std::time::Instant::now();
    let sections = integrated_sparsely(&shape, panels);
    println!("{N}D rounded {name}: {} sections in {:.1} s", 5 * panels, start.elapsed().as_secs_f64());
    table.add::<N>(sort, sections, shape.mass_properties(1.0).unwrap().mass);
}

#[test]
fn sections_of_shapes_of_every_dimension_add_up_to_the_volume() {
    let mut table = Table::default();
    common::<2>(&mut table);
    common::<3>(&mut table);
    common::<4>(&mut table);
    common::<5>(&mut table);
    common::<6>(&mut table);
    table.print();
}

#[test]
fn sections_of_products_of_all_sorts_add_up_to_the_volume() {
    let mut table = Table::default();
    products(&mut table);
    table.print();
}

#[test]
fn sections_of_pyramids_and_cones_add_up_to_the_volume() {
    let mut table = Table::default();
    pyramids(&mut table);
    table.print();
}

#[test]
fn sections_of_stars_add_up_to_the_volume() {
    let mut table = Table::default();
    stars::<2>(&mut table, &["{5/2}", "{7/2}", "{7/3}"]);
    stars::<3>(&mut table, &["{5/2,5}", "{5,5/2}", "{5/2,3}", "{3,5/2}"]);
    stars::<4>(&mut table, &["{5/2,5,3}", "{5/2,3,5}", "{5,5/2,5}", "{3,5,5/2}", "{3,5/2,5}"]);
    table.print();
}

#[test]
fn sections_of_rounded_shapes_add_up_to_the_volume() {
    let mut table = Table::default();
    rounded::<2>(&mut table, "box", 100);
    rounded::<2>(&mut table, "pentagon", 100);
    rounded::<3>(&mut table, "box", 60);
    rounded::<3>(&mut table, "dodecahedron", 60);
    rounded::<4>(&mut table, "box", 30);
    rounded::<4>(&mut table, "simplex", 30);
    rounded::<4>(&mut table, "24-cell", 30);
    rounded::<5>(&mut table, "box", 16);
    rounded::<5>(&mut table, "simplex", 16);
    rounded::<5>(&mut table, "orthoplex", 16);
    rounded::<6>(&mut table, "box", 10);
    rounded::<6>(&mut table, "simplex", 16);
    table.print();
}
