//! The regular convex polytopes, by name and by Schläfli symbol, centred at the origin.
//!
//! Every dimension has the simplex {3, …, 3}, the cube {4, 3, …, 3} and the cross-polytope {3, …, 3, 4}; in the plane
//! there are all polygons {p}, in three dimensions also {5, 3} and {3, 5}, in four {3, 4, 3}, {5, 3, 3} and {3, 3, 5},
//! and beyond that nothing (L. Schläfli, 1852).
//!
//! Orientation: cubes, the 24-cell and the 120-cell have facets orthogonal to the axes; cross-polytopes and the 600-cell
//! have vertices on them; simplices and polygons stand on a facet orthogonal to y.

mod coordinates;

use hyperbody_math::Vector;

use crate::error::GeometryErrorKind::{BadCount, BadNumber, UnknownName};
use crate::star::tiled_by;
use crate::tolerances::{MAX_LENGTH, MAX_POLYGON, MIN_LENGTH};
use crate::{GeometryError, Polytope, Result};

/// A regular convex polytope of some dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regular {
    /// {3, …, 3}.
    Simplex,
    /// {4, 3, …, 3}.
    Cube,
    /// {3, …, 3, 4}.
    CrossPolytope,
    /// {p}, with this many vertices; two dimensions only.
    Polygon(usize),
    /// {5, 3}; three dimensions only.
    Dodecahedron,
    /// {3, 5}; three dimensions only.
    Icosahedron,
    /// {3, 4, 3}; four dimensions only.
    Cell24,
    /// {5, 3, 3}; four dimensions only.
    Cell120,
    /// {3, 3, 5}; four dimensions only.
    Cell600,
}

/// How large a regular polytope is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// Distance of the vertices from the centre, in metres.
    Circumradius(f64),
    /// Length of the edges, in metres.
    Edge(f64),
}

/// Names by dimension (0 for every dimension): the first name of each polytope is the one that messages use.
const NAMES: &[(usize, Regular, &[&str])] = &[
    (2, Regular::Simplex, &["triangle"]),
    (2, Regular::Cube, &["square"]),
    (2, Regular::Polygon(5), &["pentagon"]),
    (2, Regular::Polygon(6), &["hexagon"]),
    (2, Regular::Polygon(7), &["heptagon"]),
    (2, Regular::Polygon(8), &["octagon"]),
    (2, Regular::Polygon(9), &["nonagon", "enneagon"]),
    (2, Regular::Polygon(10), &["decagon"]),
    (2, Regular::Polygon(11), &["hendecagon", "undecagon"]),
    (2, Regular::Polygon(12), &["dodecagon"]),
    (3, Regular::Simplex, &["tetrahedron"]),
    (3, Regular::Cube, &["cube", "hexahedron"]),
    (3, Regular::CrossPolytope, &["octahedron"]),
    (3, Regular::Dodecahedron, &["dodecahedron"]),
    (3, Regular::Icosahedron, &["icosahedron"]),
    (4, Regular::Simplex, &["5-cell", "pentachoron", "pentatope", "hypertetrahedron"]),
    (4, Regular::Cube, &["8-cell", "tesseract", "octachoron"]),
    (4, Regular::CrossPolytope, &["16-cell", "hexadecachoron"]),
    (4, Regular::Cell24, &["24-cell", "icositetrachoron", "octaplex"]),
    (4, Regular::Cell120, &["120-cell", "hecatonicosachoron", "dodecaplex"]),
    (4, Regular::Cell600, &["600-cell", "hexacosichoron", "tetraplex"]),
    (5, Regular::Simplex, &["5-simplex", "hexateron"]),
    (5, Regular::Cube, &["5-cube", "penteract"]),
    (5, Regular::CrossPolytope, &["5-orthoplex", "pentacross"]),
    (6, Regular::Simplex, &["6-simplex", "heptapeton"]),
    (6, Regular::Cube, &["6-cube", "hexeract"]),
    (6, Regular::CrossPolytope, &["6-orthoplex", "hexacross"]),
    (0, Regular::Simplex, &["simplex"]),
    (0, Regular::Cube, &["hypercube", "cube", "measure-polytope"]),
    (0, Regular::CrossPolytope, &["cross-polytope", "orthoplex", "hyperoctahedron"]),
];

impl Regular {
    /// The regular polytope of dimension `n` with a name such as `"24-cell"`, `"tesseract"`, `"simplex"`, `"5-cube"` or
    /// `"7-gon"`, or a Schläfli symbol such as `"{3,4,3}"`. Case, spaces, hyphens and underscores do not matter.
    ///
    /// # Errors
    /// `UnknownName`, with the nearest known name and all names of that dimension.
    pub fn from_name(n: usize, name: &str) -> Result<Self> {
        if let Some(symbol) = parse_symbol(name) {
            return Self::from_symbol(n, &symbol);
        }
        let wanted = plain(name);
        let named = NAMES
            .iter()
            .filter(|(dimension, ..)| *dimension == n || *dimension == 0)
            .find(|(_, _, names)| names.iter().any(|known| plain(known) == wanted));
        if let Some((_, regular, _)) = named {
            return Ok(*regular);
        }
        let prefixed = |suffix: &str| wanted.strip_suffix(suffix).and_then(|digits| digits.parse::<usize>().ok());
        if let Some(p) = prefixed("gon").filter(|_| n == 2) {
            return polygon(p);
        }
        let families = [
            ("simplex", Self::Simplex),
            ("cube", Self::Cube),
            ("orthoplex", Self::CrossPolytope),
            ("crosspolytope", Self::CrossPolytope),
        ];
        match families.iter().find(|(suffix, _)| prefixed(suffix) == Some(n)) {
            Some((_, regular)) => Ok(*regular),
            None => Err(unknown(n, name)),
        }
    }

    /// The regular polytope with a Schläfli symbol of `n − 1` numbers.
    ///
    /// # Errors
    /// `UnknownName` if there is no such convex polytope.
    pub fn from_symbol(n: usize, symbol: &[usize]) -> Result<Self> {
        if symbol.len() + 1 == n {
            if let [p] = symbol {
                return polygon(*p);
            }
            let special = [Self::Dodecahedron, Self::Icosahedron, Self::Cell24, Self::Cell120, Self::Cell600];
            let general = [Self::Simplex, Self::Cube, Self::CrossPolytope];
            for regular in general.into_iter().chain(special) {
                if regular.symbol(n).is_some_and(|known| known == symbol) {
                    return Ok(regular);
                }
            }
        }
        let text: Vec<String> = symbol.iter().map(ToString::to_string).collect();
        let fractions: Vec<(u32, u32)> = symbol.iter().map(|&p| (u32::try_from(p).unwrap_or(u32::MAX), 1)).collect();
        if let Some(space) = tiled_by(&fractions) {
            let message = format!(
                "{{{}}} is a tiling of {space}, not a polytope; in {n} dimensions there are {}",
                text.join(","),
                names(n).join(", ")
            );
            return Err(GeometryError::new(UnknownName, message));
        }
        Err(unknown(n, &format!("{{{}}}", text.join(","))))
    }

    /// The Schläfli symbol in dimension `n`, or `None` if this polytope does not exist there.
    #[must_use]
    pub fn symbol(self, n: usize) -> Option<Vec<usize>> {
        let mut symbol = vec![3; n.checked_sub(1)?];
        let only_in = match self {
            Self::Simplex => return Some(symbol),
            Self::Cube => {
                *symbol.first_mut()? = 4;
                return Some(symbol);
            }
            Self::CrossPolytope => {
                *symbol.last_mut()? = 4;
                return Some(symbol);
            }
            Self::Polygon(p) => vec![p],
            Self::Dodecahedron => vec![5, 3],
            Self::Icosahedron => vec![3, 5],
            Self::Cell24 => vec![3, 4, 3],
            Self::Cell120 => vec![5, 3, 3],
            Self::Cell600 => vec![3, 3, 5],
        };
        (only_in.len() == symbol.len()).then_some(only_in)
    }

    /// The vertices in dimension `N`, centred at the origin, in an order that never changes.
    ///
    /// # Errors
    /// `UnknownName` if this polytope does not exist in `N` dimensions; `BadCount` for polygons with too few or too many
    /// vertices; `BadNumber` if the size is not a number of metres in [`MIN_LENGTH`]..=[`MAX_LENGTH`].
    pub fn vertices<const N: usize>(self, size: Size) -> Result<Vec<Vector<N>>> {
        if self.symbol(N).is_none() || N < 2 {
            return Err(unknown(N, &format!("{self:?}")));
        }
        if let Self::Polygon(p) = self {
            polygon(p)?;
        }
        let coordinates = match self {
            Self::Simplex => coordinates::simplex(N),
            Self::Cube => coordinates::cube(N),
            Self::CrossPolytope => coordinates::cross_polytope(N),
            Self::Polygon(p) => coordinates::polygon(p),
            Self::Dodecahedron => coordinates::dodecahedron(),
            Self::Icosahedron => coordinates::icosahedron(),
            Self::Cell24 => coordinates::cell_24(),
            Self::Cell120 => coordinates::cell_120(),
            Self::Cell600 => coordinates::cell_600(),
        };
        let natural: Vec<Vector<N>> = coordinates.iter().filter_map(|v| Vector::from_slice(v)).collect();
        let (what, wanted, actual) = match size {
            Size::Circumradius(radius) => ("circumradius", radius, natural[0].norm()),
            Size::Edge(edge) => {
                let shortest = natural[1..].iter().map(|v| v.distance(natural[0])).fold(f64::INFINITY, f64::min);
                ("edge", edge, shortest)
            }
        };
        if !(MIN_LENGTH..=MAX_LENGTH).contains(&wanted) {
            return Err(GeometryError::new(
                BadNumber,
                format!(
                    "the {what} of a regular polytope is {wanted}: it must be a number of metres between {MIN_LENGTH:e} and \
                     {MAX_LENGTH:e}"
                ),
            ));
        }
        Ok(natural.into_iter().map(|v| v * (wanted / actual)).collect())
    }

    /// The polytope in dimension `N`, centred at the origin.
    ///
    /// # Errors
    /// As [`Regular::vertices`].
    pub fn polytope<const N: usize>(self, size: Size) -> Result<Polytope<N>> {
        Polytope::from_points(&self.vertices(size)?)
    }
}

/// The regular polytope of `N` dimensions with a name or a Schläfli symbol: see [`Regular::from_name`].
///
/// # Errors
/// `UnknownName`, with the nearest known name; `BadNumber` for a bad size.
///
/// ```
/// use hyperbody_geometry::regular::{Size, polytope};
/// let cell = polytope::<4>("{3,4,3}", Size::Circumradius(1.0))?;
/// assert_eq!(cell.face_lattice().face_counts(), [24, 96, 96, 24]);
/// # Ok::<(), hyperbody_geometry::GeometryError>(())
/// ```
pub fn polytope<const N: usize>(name: &str, size: Size) -> Result<Polytope<N>> {
    Regular::from_name(N, name)?.polytope(size)
}

/// The name that messages use for each regular polytope of dimension `n`.
#[must_use]
pub fn names(n: usize) -> Vec<&'static str> {
    let of = |dimension: usize| NAMES.iter().filter(move |entry| entry.0 == dimension).map(|entry| entry.2[0]);
    let own: Vec<&str> = of(n).collect();
    if own.is_empty() { of(0).collect() } else { own }
}

fn polygon(p: usize) -> Result<Regular> {
    match p {
        3 => Ok(Regular::Simplex),
        4 => Ok(Regular::Cube),
        5..=MAX_POLYGON => Ok(Regular::Polygon(p)),
        _ => Err(GeometryError::new(
            BadCount,
            format!("a polygon with {p} vertices: it needs 3 to {MAX_POLYGON}; use a ball for a disc"),
        )),
    }
}

/// The numbers of `"{3,4,3}"`, with or without braces, separated by commas or spaces; `None` if it is something else.
fn parse_symbol(name: &str) -> Option<Vec<usize>> {
    let name = name.trim();
    let inner = name.strip_prefix('{').and_then(|rest| rest.strip_suffix('}')).unwrap_or(name);
    inner
        .split([',', ' '])
        .filter(|part| !part.is_empty())
        .map(|part| part.parse().ok())
        .collect::<Option<Vec<_>>>()
        .filter(|s| !s.is_empty())
}

fn plain(name: &str) -> String {
    name.chars().filter(|c| !c.is_whitespace() && !"-_".contains(*c)).flat_map(char::to_lowercase).collect()
}

/// The error for a name that is none in dimension `n`: it may be one in another.
fn unknown(n: usize, name: &str) -> GeometryError {
    let wanted = plain(name);
    let all = || NAMES.iter().flat_map(|(dimension, _, names)| names.iter().map(move |known| (*dimension, *known)));
    let hint = if let Some((dimension, known)) = all().find(|(_, known)| plain(known) == wanted) {
        format!("\"{known}\" has {dimension} dimensions")
    } else {
        // Names of the right dimension win over equally near ones of others.
        let nearest = all()
            .filter(|(dimension, _)| *dimension == n || *dimension == 0)
            .chain(all())
            .min_by_key(|(_, known)| strsim::osa_distance(&plain(known), &wanted));
        nearest.map_or(String::new(), |(_, known)| format!("the nearest known name is \"{known}\""))
    };
    GeometryError::new(
        UnknownName,
        format!(
            "there is no regular polytope \"{name}\" in {n} dimensions; {hint}; in {n} dimensions there are {}, and their \
             Schläfli symbols such as {}",
            names(n).join(", "),
            match n {
                2 => "{5}",
                3 => "{4,3}",
                4 => "{3,4,3}",
                _ => "{3,…,3,4}",
            }
        ),
    )
}
