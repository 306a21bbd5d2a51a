//! Where the eye is: what the options say of it, and what is chosen where they are silent.

use hyperbody::math::{Dim, EvenAlgebra, Vector};
use hyperbody_render::{Bodies, Camera, Slice, Viewpoint, frame_from};
use hyperbody_scene::{DimensionVisitor, visit_dimension};

use super::timeline::Timeline;
use super::view::{Sight, View, no_such};
use crate::failure::Failure;
use crate::numbers::shortened;

impl View<'_> {
    /// The camera for all of these.
    pub(super) fn camera(&self, timeline: &Timeline, sights: &[Sight]) -> Result<Camera, Failure> {
        visit_dimension(timeline.dimension(), ChooseCamera { view: self, timeline, sights })
            .unwrap_or_else(|| no_such(timeline))
    }

    /// The camera as the options say it, chosen where they are silent.
    fn chosen<const N: usize>(&self, sights: &[(Bodies<N>, Slice<N>)], aspect: f64) -> Camera {
        let mut viewpoint = Viewpoint::natural(N);
        viewpoint.target = self.arguments.look_at.as_ref().and_then(|list| Vector::from_slice(&list.0));
        if let Some(degrees) = self.arguments.field_of_view {
            viewpoint.field_of_view = degrees.to_radians();
        }
        let Some(list) = &self.arguments.camera else { return frame_from(sights, aspect, &viewpoint) };
        let (azimuth, elevation) = (list.0[0].to_radians(), list.0[1].to_radians());
        match list.0.get(2) {
            // Whoever says the distance as well walks around one point, whatever the angles.
            Some(&distance) => {
                let Camera { target, up, field_of_view, .. } = frame_from(sights, aspect, &viewpoint);
                Camera { field_of_view, ..Camera::around(target, up, distance, azimuth, elevation) }
            }
            None => frame_from(sights, aspect, &Viewpoint { azimuth, elevation, ..viewpoint }),
        }
    }

    /// Says which half-spaces are not to be seen because the slice lies within them.
    fn warn_of_half_spaces<const N: usize>(&self, timeline: &Timeline, sights: &[(Bodies<N>, Slice<N>)]) {
        let mut around: Vec<usize> =
            sights.iter().flat_map(|(bodies, slice)| bodies.half_spaces_around(slice)).collect();
        around.sort_unstable();
        around.dedup();
        let names: Vec<String> =
            around.iter().take(3).map(|&body| format!("\"{}\"", shortened(timeline.body_name(body)))).collect();
        if !names.is_empty() {
            let more = if around.len() > names.len() { " and others" } else { "" };
            eprintln!(
                "warning: the slice lies wholly within the half-space {}{more}; from within there is nothing of it to see, \
                 and it is left out (--slice moves the slice)",
                names.join(", ")
            );
        }
    }
}

/// Choosing a camera, in the dimension of the world.
struct ChooseCamera<'a> {
    view: &'a View<'a>,
    timeline: &'a Timeline,
    sights: &'a [Sight],
}

impl DimensionVisitor for ChooseCamera<'_> {
    type Output = Result<Camera, Failure>;

    fn visit<const N: usize>(self) -> Self::Output
    where
        Dim<N>: EvenAlgebra,
    {
        let mut sights = Vec::with_capacity(self.sights.len());
        for (frame, slice) in self.sights {
            sights.push((self.timeline.bodies::<N>(frame)?, slice.in_dimension::<N>()));
        }
        let (share, aspect) = self.view.room(N);
        self.view.warn_of_half_spaces(self.timeline, &sights);
        Ok(self.view.chosen(&sights, aspect * (1.0 - share)))
    }
}
