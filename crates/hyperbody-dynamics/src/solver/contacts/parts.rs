//! The rows of one block, cut once into their parts: where the number of points is a constant, so are all sizes, and one check of
//! the whole length is left of those of the parts.

use super::{Block, Layout};
use crate::solver::lanes::Lanes;

/// See [`Layout`].
pub(super) struct Parts<'a> {
    pub(super) header: &'a mut [Lanes],
    pub(super) slides: &'a mut [Lanes],
    pub(super) slide_mass: &'a mut [Lanes],
    pub(super) twists: &'a mut [Lanes],
    pub(super) field: &'a mut [Lanes],
    pub(super) points: &'a mut [Lanes],
    pub(super) response: &'a mut [Lanes],
    /// From here on, where anything resists.
    pub(super) resistance: &'a mut [Lanes],
}

impl<'a> Parts<'a> {
    /// `rows` start with those of the block, whose most points are `count`.
    #[inline(always)]
    pub(super) fn cut<const N: usize>(block: &Block, count: usize, rows: &'a mut [Lanes]) -> Self {
        let twists = if count > 1 { Layout::<N>::TWISTS } else { block.twists } * Layout::<N>::TWIST_ROW;
        let field = if count > 1 { N } else { Layout::<N>::field_rows(block) } * Layout::<N>::FIELD_ROW;
        let (points, response) = (count * Layout::<N>::POINT_ROW, count * (count + 1) / 2);
        let (rows, resistance) = rows.split_at_mut(Layout::<N>::TWIST_ROWS + twists + field + points + response);
        let (header, rows) = rows.split_at_mut(Layout::<N>::HEADER);
        let (slides, rows) = rows.split_at_mut(Layout::<N>::SLIDES * Layout::<N>::SLIDE_ROW);
        let (slide_mass, rows) = rows.split_at_mut(Layout::<N>::SLIDE_MASS_LEN);
        let (twists, rows) = rows.split_at_mut(twists);
        let (field, rows) = rows.split_at_mut(field);
        let (points, response) = rows.split_at_mut(points);
        Self { header, slides, slide_mass, twists, field, points, response, resistance }
    }
}
