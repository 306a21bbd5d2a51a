//! Contacts and what pairs remember as bytes: the memory between two steps that the next one starts from.

use hyperbody_geometry::bytes::{BytesError, Reader, Stored, Writer};
use hyperbody_geometry::{stored, stored_choice};

use crate::MAX_POINTS;
use crate::box_sat::Feature;
use crate::gjk::Seeds;
use crate::manifold::{ContactPoint, Manifold, max_points};
use crate::narrow::PairCache;
use crate::patch::PatchMemory;
use crate::simplex::MAX_SIMPLEX;

stored_choice!(Feature { None = 0, FacetOfA = 1, FacetOfB = 2, Mixed = 3 });
stored!(ContactPoint<N> { position, separation, id });

/// Reads up to `most` elements into the front of an array of which the rest stays as it is.
fn read_front<T: Stored>(from: &mut Reader<'_>, places: &mut [T], most: usize) -> Result<u32, BytesError> {
    let length = from.length()?;
    if length > most.min(places.len()) {
        return Err(from.error(format!("a list of {length} elements stands where at most {most} fit")));
    }
    for place in &mut places[..length] {
        *place = T::read(from)?;
    }
    Ok(length as u32)
}

fn write_front<T: Stored>(elements: &[T], out: &mut Writer) {
    out.length(elements.len());
    elements.iter().for_each(|element| element.write(out));
}

impl<const N: usize> Stored for Manifold<N> {
    fn write(&self, out: &mut Writer) {
        self.normal.write(out);
        write_front(self.points(), out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let mut manifold = Self::EMPTY;
        manifold.normal = Stored::read(from)?;
        manifold.len = read_front(from, &mut manifold.points, max_points(N))?;
        Ok(manifold)
    }
}

impl Stored for Seeds {
    fn write(&self, out: &mut Writer) {
        write_front(self.keys(), out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let mut seeds = Self::default();
        seeds.len = read_front(from, &mut seeds.keys, MAX_SIMPLEX)?;
        Ok(seeds)
    }
}

impl Stored for PatchMemory {
    fn write(&self, out: &mut Writer) {
        self.reference_is_b.write(out);
        self.facets.write(out);
        write_front(self.previous_ids(), out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let mut memory = Self { reference_is_b: Stored::read(from)?, facets: Stored::read(from)?, ..Self::default() };
        memory.len = read_front(from, &mut memory.ids, MAX_POINTS)?;
        Ok(memory)
    }
}

impl<const N: usize> Stored for PairCache<N> {
    fn write(&self, out: &mut Writer) {
        self.normal.write(out);
        (self.feature, (self.facet, self.unconfirmed)).write(out);
        self.seeds.write(out);
        self.patch.write(out);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, BytesError> {
        let normal = Stored::read(from)?;
        let (feature, (facet, unconfirmed)) = Stored::read(from)?;
        let seeds = Seeds::read(from)?;
        if seeds.keys().len() > N + 1 {
            return Err(from.error(format!("a simplex has {} vertices; it has at most {}", seeds.keys().len(), N + 1)));
        }
        Ok(Self { normal, feature, facet, unconfirmed, seeds, patch: Stored::read(from)? })
    }
}
