//! `hyperbody slice`: the three-dimensional section of a shape, as a file for other programs.

mod project;

use std::path::{Path, PathBuf};

use clap::Args;
use hyperbody::geometry::{SectionPolytope, SliceFrame, Solid, Surface, cut_pieces};
use hyperbody::math::{Dim, EvenAlgebra, Vector};
use hyperbody_scene::ShapeFile;
use serde::Serialize;

use crate::failure::Failure;
use crate::files::Target;
use crate::numbers::whole;
use crate::output::{labelled, number, print, print_json};
use crate::source;

use project::Eye;

#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    hyperbody slice 24-cell -o middle.stl                                  across w, through the origin\n  \
    hyperbody slice 24-cell.off -o corner.glb --normal 1,1,1,1 --offset 0.5\n  \
    hyperbody slice duocylinder.json -o round.obj --tolerance 0.0001       a curved shape, to a tenth of a millimetre\n  \
    hyperbody slice 24-cell.off -o wires.obj --project --eye 3              all edges and faces, in perspective\n  \
    hyperbody slice 24-cell.off -o shadow.stl --project                     what the whole shape covers, seen along w\n  \
    hyperbody slice dodecahedron -o dice.stl                                a shape of 3D, as it is\n\n\
    The axes of the section are those of the shape after the shortest turn that takes its last axis to the normal: across \
    w, they are x, y and z; across −w the turn is half a turn in the plane xw, so that x points back. Faces keep the number of \
    the cell of a convex shape that they were cut from: as groups in .obj and as colours in .glb. Shapes that are not convex are \
    cut as convex pieces and written as one closed surface without the walls on which they meet; faces have numbers of cells of the \
    pieces, one that several share the smallest.")]
pub(crate) struct SliceArguments {
    /// The shape: an OFF file, the shape of a scene as .json, or the name of a regular polytope of circumradius 1
    pub(crate) file: PathBuf,
    /// The file to write: .stl, .obj, .off or .glb
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// Normal of the hyperplane, of any length, as numbers with commas between them; once for each dimension above three
    /// [default: the last axes]
    #[arg(long, value_name = "X,Y,…", value_parser = numbers, allow_hyphen_values = true)]
    pub(crate) normal: Vec<Numbers>,
    /// Where the hyperplane is: all points p with normal·p = offset; once for each normal [default: 0]
    #[arg(long, value_name = "C", allow_hyphen_values = true)]
    pub(crate) offset: Vec<f64>,
    /// Drop the whole shape along the normals instead of cutting it: all edges and faces as .obj, the outline as any other
    /// format
    #[arg(long)]
    pub(crate) project: bool,
    /// With --project, perspective: the distance of the eye from the hyperplane, in metres, on the side of the normal; for
    /// shapes of polytopes, as curved ones are projected in parallel only
    #[arg(long, value_name = "METRES", requires = "project", allow_hyphen_values = true)]
    pub(crate) eye: Option<f64>,
    /// For curved shapes, how far the shape may reach beyond the facets of the file, in metres [default: a thousandth of the
    /// size of the shape]
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    pub(crate) tolerance: Option<f64>,
    /// Dimension of a shape that does not tell, such as a ball
    #[arg(long, value_name = "N", value_parser = whole::<u8>(2..=6), allow_negative_numbers = true)]
    pub(crate) dimension: Option<u8>,
    /// Print one JSON object and nothing else
    #[arg(long)]
    pub(crate) json: bool,
}

/// A list of numbers given as one argument.
#[derive(Clone, Debug)]
pub(crate) struct Numbers(Vec<f64>);

fn numbers(text: &str) -> Result<Numbers, String> {
    let parse = |part: &str| part.trim().parse::<f64>().map_err(|_| format!("\"{part}\" is not a number"));
    text.split(',').map(parse).collect::<Result<_, _>>().map(Numbers)
}

#[derive(Serialize)]
struct Report {
    file: String,
    vertices: usize,
    faces: usize,
    /// Of the section, in m³; parts of a compound add up. Exact for polytopes and balls; curved sections of a shape of four
    /// dimensions are measured themselves, to about 1e-7, and below further cuts it is what the faces enclose. Null where
    /// outlines may lie in each other.
    volume: Option<f64>,
    /// What the faces enclose, in m³; null likewise.
    enclosed: Option<f64>,
    /// Whether outlines of several pieces may lie in each other, so that no volume is that of what they cover.
    overlapping: bool,
    /// Convex pieces, each with a surface of its own.
    pieces: usize,
}

/// What goes into the file.
struct Written {
    surface: Surface,
    volume: f64,
    enclosed: f64,
    pieces: usize,
    /// Whether surfaces of pieces may lie in each other.
    overlapping: bool,
}

pub(crate) fn slice(arguments: &SliceArguments) -> Result<(), Failure> {
    let target = Target::new("--output", &arguments.output, &["stl", "obj", "off", "glb"])?;
    target.refuse_inputs("--output", std::slice::from_ref(&arguments.file))?;
    let file = load(&arguments.file, arguments.dimension)?;
    target.refuse_inputs("--output", &source::files_of_shape(&file)?)?;
    let planes = hyperplanes(arguments, file.dimension)?;
    if arguments.project {
        return project(arguments, &target, &file, &planes);
    }
    let written = match file.dimension {
        3 => uncut(&file, arguments)?,
        4 => surface(down::<4, 3>(solids(&file)?, &planes)?.0, 1, arguments)?,
        5 => {
            let (solids, planes) = down::<5, 4>(solids(&file)?, &planes)?;
            surface(down::<4, 3>(solids, &planes)?.0, 2, arguments)?
        }
        _ => {
            let (solids, planes) = down::<6, 5>(solids(&file)?, &planes)?;
            let (solids, planes) = down::<5, 4>(solids, &planes)?;
            surface(down::<4, 3>(solids, &planes)?.0, 3, arguments)?
        }
    };
    target.write(&content(&written.surface, target.extension()))?;
    tell(arguments, &written)
}

fn tell(arguments: &SliceArguments, written: &Written) -> Result<(), Failure> {
    let report = Report {
        file: arguments.output.display().to_string(),
        vertices: written.surface.vertices().len(),
        faces: written.surface.polygon_count(),
        volume: (!written.overlapping).then_some(written.volume),
        enclosed: (!written.overlapping).then_some(written.enclosed),
        overlapping: written.overlapping,
        pieces: written.pieces,
    };
    if arguments.json {
        return print_json(&report);
    }
    let mut lines = vec![("vertices", report.vertices.to_string()), ("faces", report.faces.to_string())];
    if let (Some(volume), Some(enclosed)) = (report.volume, report.enclosed) {
        lines.push(("volume", format!("{} m³", number(volume))));
        if (enclosed - volume).abs() > 1e-9 * volume {
            lines.push(("enclosed", format!("{} m³, by the faces of the file", number(enclosed))));
        }
    }
    if report.pieces > 1 {
        let also = if report.overlapping {
            "each has an outline of its own in the file, and where these lie in each other there is no volume to tell"
        } else if arguments.project {
            "each has an outline of its own in the file, apart from the others"
        } else {
            "walls between them are left out where they lie on each other"
        };
        lines.push(("pieces", format!("{}: {also}", report.pieces)));
    }
    print(format!("{}\n\n{}", report.file, labelled(lines)))
}

/// The projection in place of the section; the report is that of the outline.
fn project(arguments: &SliceArguments, target: &Target, file: &ShapeFile, planes: &[Plane]) -> Result<(), Failure> {
    let eye = Eye(arguments.eye);
    let seen = match file.dimension {
        4 => project::first::<4, 3>(&solids(file)?, planes, eye)?.0,
        5 => {
            let (seen, planes) = project::first::<5, 4>(&solids(file)?, planes, eye)?;
            project::next::<4, 3>(&seen, &planes, eye)?.0
        }
        _ => {
            let (seen, planes) = project::first::<6, 5>(&solids(file)?, planes, eye)?;
            let (seen, planes) = project::next::<5, 4>(&seen, &planes, eye)?;
            project::next::<4, 3>(&seen, &planes, eye)?.0
        }
    };
    let written = project::outlines(&seen, arguments.tolerance)?;
    let wires = if target.extension() == "obj" { project::wires_as_obj(&seen) } else { None };
    target.write(&wires.map_or_else(|| content(&written.surface, target.extension()), String::into_bytes))?;
    tell(arguments, &written)
}

fn content(surface: &Surface, extension: &str) -> Vec<u8> {
    match extension {
        "stl" => surface.to_stl(),
        "glb" => surface.to_glb(),
        "obj" => surface.to_obj().into_bytes(),
        _ => surface.to_off().into_bytes(),
    }
}

fn load(path: &Path, dimension: Option<u8>) -> Result<ShapeFile, Failure> {
    if path.is_file() && ShapeFile::holds_scene(path)? {
        let message = "holds a scene; name a shape: an OFF file, or what stands under \"shape\" in a scene as .json";
        return Err(Failure::Input(format!("{}: {message}", path.display())));
    }
    let dimension = dimension.map(usize::from);
    let named = path.to_str().filter(|_| !path.exists()).and_then(|name| ShapeFile::named(name, dimension));
    if named.is_none() {
        source::refuse_unknown_shape(&path.to_string_lossy(), &[])?;
    }
    let file = named.unwrap_or_else(|| ShapeFile::load(path, dimension)).map_err(source::with_dimension_hint)?;
    if !(3..=6).contains(&file.dimension) {
        let message = format!(
            "is a shape of {} dimensions; sections in 3D are those of 4 to 6, and shapes of 3 are written as they are",
            file.dimension
        );
        return Err(Failure::Input(format!("{}: {message}", path.display())));
    }
    Ok(file)
}

/// A hyperplane in coordinates of as many dimensions as there are still: all points p with normal·p = offset.
struct Plane {
    normal: Vec<f64>,
    offset: f64,
    /// The offset as it was asked for, before the origin moved into other hyperplanes.
    asked: f64,
}

/// One hyperplane for each dimension above three.
fn hyperplanes(arguments: &SliceArguments, dimension: usize) -> Result<Vec<Plane>, Failure> {
    let wanted = dimension - 3;
    let refuse = |message: String| Err(Failure::Input(message));
    let given = [
        ("--normal", !arguments.normal.is_empty()),
        ("--offset", !arguments.offset.is_empty()),
        ("--project", arguments.project),
    ];
    if let Some((option, _)) = given.iter().find(|(_, given)| wanted == 0 && *given) {
        return refuse(format!(
            "{option} is for shapes of 4 to 6 dimensions: one of 3 is written as it is, and neither cut to 2 nor projected"
        ));
    }
    let mut normals: Vec<Vec<f64>> = arguments.normal.iter().map(|normal| normal.0.clone()).collect();
    if normals.is_empty() {
        let axis = |k: usize| (0..dimension).map(|i| if i == dimension - 1 - k { 1.0 } else { 0.0 }).collect();
        normals = (0..wanted).map(axis).collect();
    }
    let mut offsets = arguments.offset.clone();
    if offsets.is_empty() {
        offsets = vec![0.0; wanted];
    }
    for (what, count) in [("--normal", normals.len()), ("--offset", offsets.len())] {
        if count != wanted {
            return refuse(format!(
                "{what} is given {count} times; from {dimension} dimensions down to 3 it has to be {wanted}"
            ));
        }
    }
    if let Some(normal) = normals.iter().find(|normal| normal.len() != dimension) {
        return refuse(format!(
            "--normal has {} numbers; in {dimension} dimensions it needs {dimension}",
            normal.len()
        ));
    }
    let plane = |(normal, offset)| Plane { normal, offset, asked: offset };
    Ok(normals.into_iter().zip(offsets).map(plane).collect())
}

/// Pieces with the first of the numbers that their faces have.
type Pieces<const N: usize> = Vec<(u32, Solid<N>)>;

fn solids<const N: usize>(file: &ShapeFile) -> Result<Pieces<N>, Failure>
where
    Dim<N>: EvenAlgebra,
{
    let mut first_source = 0;
    let numbered = file.build::<N>()?.solids().into_iter().map(|solid| {
        let first = first_source;
        first_source += if let Solid::Polytope(polytope) = &solid { polytope.facet_sources().len() as u32 } else { 1 };
        (first, solid)
    });
    Ok(numbered.collect())
}

/// Cuts with the first hyperplane; the others follow in its coordinates.
fn down<const N: usize, const M: usize>(
    solids: Pieces<N>,
    planes: &[Plane],
) -> Result<(Pieces<M>, Vec<Plane>), Failure> {
    let (frame, lower) = frame_and_rest::<N, M>(planes)?;
    let (firsts, solids): (Vec<u32>, Vec<Solid<N>>) = solids.into_iter().unzip();
    let cut = |((first, solid), cut): ((u32, &Solid<N>), bool)| {
        Some((first, if cut { solid.section::<M>(&frame)? } else { return None }))
    };
    let left: Pieces<M> = firsts.into_iter().zip(&solids).zip(cut_pieces(&solids, &frame)).filter_map(cut).collect();
    if left.is_empty() {
        return Err(Failure::Input(missed(&solids, &planes[0], &frame)));
    }
    Ok((left, lower))
}

/// The first hyperplane, and the others in its coordinates.
fn frame_and_rest<const N: usize, const M: usize>(planes: &[Plane]) -> Result<(SliceFrame<N>, Vec<Plane>), Failure> {
    let vector = |numbers: &[f64]| Vector::<N>::from_slice(numbers).unwrap_or(Vector::ZERO);
    let Some((first, rest)) = planes.split_first() else {
        return Err(Failure::Work("a hyperplane is missing".to_owned()));
    };
    let frame = SliceFrame::from_normal(vector(&first.normal), first.offset)
        .map_err(|error| Failure::Input(error.to_string()))?;
    let mut lower = Vec::with_capacity(rest.len());
    for plane in rest {
        let other = vector(&plane.normal);
        let within = frame.direction_to_slice::<M>(other);
        if within.norm() < 1e-9 * other.norm() {
            return Err(Failure::Input("two of the normals are parallel: they leave no section in 3D".to_owned()));
        }
        let offset = plane.offset - other.dot(frame.space_from_slice().translation);
        lower.push(Plane { normal: within.iter().collect(), offset, asked: plane.asked });
    }
    Ok((frame, lower))
}

/// Says where the hyperplane would have met something, in units of the offset that was asked for.
fn missed<const N: usize>(solids: &[Solid<N>], plane: &Plane, frame: &SliceFrame<N>) -> String {
    let reach = |direction: Vector<N>| {
        let reaches = solids.iter().map(|solid| solid.reach(direction));
        reaches.fold(f64::NEG_INFINITY, f64::max)
    };
    let unit = frame.normal();
    // The length of the normal without the overflow of squares.
    let length = unit.iter().zip(&plane.normal).map(|(c, own)| c * own).sum::<f64>();
    let asked = |distance: f64| number(plane.asked - plane.offset + length * distance);
    format!(
        "the hyperplane at offset {} leaves nothing of what there is to cut, where normal·p lies between {} and {}",
        plane.asked,
        asked(-reach(-unit)),
        asked(reach(unit))
    )
}

/// A shape of three dimensions as it is.
fn uncut(file: &ShapeFile, arguments: &SliceArguments) -> Result<Written, Failure> {
    let mass = file.build::<3>()?.mass_properties(1.0).map_err(|error| Failure::Input(error.to_string()))?;
    Ok(Written { volume: mass.mass, ..surface(solids(file)?, 0, arguments)? })
}

/// What the volume of a curved piece may be off by, in parts of the box around it.
const VOLUME_TOLERANCE: f64 = 1e-7;

/// The surface of all pieces, and their volume; `cuts` have led here.
fn surface(solids: Pieces<3>, cuts: usize, arguments: &SliceArguments) -> Result<Written, Failure> {
    let tolerance = arguments.tolerance.unwrap_or_else(|| usual_tolerance(solids.iter().map(|(_, solid)| solid)));
    let refuse = |error: hyperbody::prelude::GeometryError| Failure::Input(error.to_string());
    let mut surface = Surface::new();
    let (mut volume, mut enclosed, mut pieces) = (0.0, 0.0, 0);
    for (first_source, solid) in solids {
        let Some(polytope) = solid.to_polytope(tolerance).map_err(refuse)? else { continue };
        let exact = matches!(solid, Solid::Polytope(_));
        let measured = matches!(solid, Solid::Ball { .. }) || cuts == 1;
        let within = SectionPolytope::mass_properties(&polytope).mass;
        volume += if measured && !exact { solid.volume(VOLUME_TOLERANCE).map_err(refuse)? } else { within };
        enclosed += within;
        pieces += 1;
        surface.add_polytope(&if exact { polytope } else { polytope.with_source(0) }, first_source);
    }
    if pieces > 1 {
        surface = surface.without_walls();
    }
    check_written(&surface)?;
    Ok(Written { surface, volume, enclosed, pieces, overlapping: false })
}

/// A thousandth of half the greatest extent of all pieces, wherever they stand.
fn usual_tolerance<'a>(solids: impl Iterator<Item = &'a Solid<3>> + Clone) -> f64 {
    let reach =
        |direction: Vector<3>| solids.clone().map(|solid| solid.reach(direction)).fold(f64::NEG_INFINITY, f64::max);
    let extent = |axis| reach(Vector::unit(axis)) + reach(-Vector::unit(axis));
    0.5e-3 * (0..3).map(extent).fold(0.0, f64::max)
}

/// Curved pieces that are next to flat have no faces; if that is all, there is nothing to write.
fn check_written(surface: &Surface) -> Result<(), Failure> {
    if surface.polygon_count() > 0 {
        return Ok(());
    }
    let message = "what is left is too thin to be written as a surface: less than 1e-8 of its size in some direction";
    Err(Failure::Input(message.to_owned()))
}
