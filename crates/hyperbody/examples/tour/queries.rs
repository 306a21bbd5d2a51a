//! Questions to a world: what is where. Nothing moves by being asked.

use hyperbody::prelude::*;

use crate::{Outcome, claim, world_with_ground};

pub(crate) fn run() -> Outcome {
    let (mut world, ground) = world_with_ground()?;
    let tesseract = Shape::cuboid([0.5; 4])?;
    let near = world.add_body(BodyDef::fixed(tesseract.clone()).position([3.0, 0.5, 0.0, 0.0]))?;
    let far = world.add_body(BodyDef::fixed(tesseract.clone()).position([6.0, 0.5, 0.0, 0.0]))?;
    let aside = world.add_body(BodyDef::fixed(tesseract.clone()).position([4.5, 0.5, 0.0, 2.0]))?;

    let queries = world.queries();
    let mut scratch = QueryScratch::default();
    let ray = Ray::new([0.0, 0.5, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]);
    let first = queries.ray_cast(&ray, &mut scratch, &QueryFilter::ALL).ok_or("something is there")?;
    claim(first.body == near, "a ray along x meets the nearest tesseract, and not the one beside it in w")?;
    let behind = queries.ray_cast(&ray, &mut scratch, &QueryFilter::new().excluding(near)).ok_or("there is another")?;
    claim(behind.body == far, "a filter lets it look behind")?;

    // A ball that flies along x: it is as wide in w as in the other directions, and so are its ways.
    let motion = Motion::linear(Pose::from_translation(Vector([0.0, 0.7, 0.0, 1.0])), [1.0, 0.0, 0.0, 0.0]);
    let ball = Shape::ball(0.6)?;
    let met = queries.shape_cast(&ball, &motion, 100.0, 0.0, &mut scratch, &QueryFilter::new().excluding(ground));
    println!("  the ball flies for {:.3} s", met.as_ref().ok_or("it meets something")?.hit.time);
    claim(met.is_some_and(|met| met.body == near), "a ball beside the row still meets it")?;

    let mut bodies = Vec::new();
    queries.bodies_at([4.5, 0.5, 0.0, 1.9], &mut scratch, &QueryFilter::ALL, &mut bodies);
    claim(bodies == [aside], "a point is inside of the third one")?;
    let filter = QueryFilter::new().excluding(ground);
    let nearest = queries.nearest_to_point([6.0, 4.0, 0.0, 0.0], f64::INFINITY, &mut scratch, &filter);
    claim(nearest.is_some_and(|nearest| nearest.body == far), "and what is nearest can be asked, too")
}
