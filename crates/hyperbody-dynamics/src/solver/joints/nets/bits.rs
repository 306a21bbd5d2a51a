//! Whatever instructions a machine has, nets do the same on it, to the bit.

use super::layout::{Ground, Swept};
use super::pairing::vectors;
use super::place::Refresh;
use super::plan::{Block, NetPlan};
use super::sweep::{Move, Numbers, Settle};
use super::{Chebyshev, Softness};
use crate::solver::joints::cluster::Link;
use crate::solver::joints::place::Moment;
use crate::solver::lanes::{Lanes, Real, WIDTH};
use crate::solver::machine::{Pass, Plain, Processor};

/// A net of 6 × 6 bodies of which the first is not moved by impulses.
fn links() -> Vec<Link> {
    let mut links = Vec::new();
    let mut tie = |a: u32, b: u32| {
        let joint = u32::try_from(links.len()).unwrap();
        links.push(Link { joint, apart: false, bounded: false, plain: true, bodies: [a, b], rows: 3 });
    };
    for body in 0..36 {
        if body % 6 > 0 {
            tie(body - 1, body);
        }
        if body >= 6 {
            tie(body - 6, body);
        }
    }
    links
}

#[test]
fn what_is_swept_side_by_side_shares_no_moving_body() {
    let links = links();
    let plan = NetPlan::new(&links);
    let mut joints: Vec<u32> = plan.blocks.iter().flat_map(|block| block.joints).collect();
    joints.sort_unstable();
    joints.retain(|&joint| joint != Block::EMPTY);
    assert!(joints.into_iter().eq(0..60));
    assert!(plan.blocks.len() <= 10 && plan.ends.last() == Some(&plan.blocks.len()));
    for block in &plan.blocks {
        let mut bodies: Vec<u32> = block.a.iter().chain(&block.b).copied().filter(|&body| body != 0).collect();
        let all = bodies.len();
        bodies.sort_unstable();
        bodies.dedup();
        assert_eq!(bodies.len(), all);
    }
}

/// A substep of a net whose numbers are drawn by lot; everything that it changed.
fn substep<const N: usize>(wide: bool, farthest: f64) -> Vec<Lanes> {
    let plan = NetPlan::new(&links());
    let mut seed = 7_u64;
    let mut lots = |count: usize, size: f64| -> Vec<Lanes> {
        let mut lot = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (((seed >> 40) as f64 / f64::from(1 << 24) - 0.5) * size) as Real
        };
        (0..count).map(|_| Lanes(std::array::from_fn(|_| lot()))).collect()
    };
    let (blocks, bodies) = (plan.blocks.len(), plan.bodies.len() * vectors::<N>());
    let mut swept = lots(blocks * Swept::<N>::LEN, 1.0);
    let mut ground = lots(blocks * Ground::<N>::LEN, farthest);
    let (mut impulses, mut velocities) = (lots(blocks * N, 1.0), lots(bodies, 1.0));
    let displacements = lots(bodies, 0.01);
    for swept in swept.chunks_exact_mut(Swept::<N>::LEN) {
        for lane in 0..WIDTH {
            for mass in [Swept::<N>::MASS_A, Swept::<N>::MASS_B] {
                swept[mass].0[lane] = 1.0 + swept[mass].0[lane].abs();
            }
        }
    }
    let moment = Moment::new(1, 1, 1.0 / 240.0);
    let mut chebyshev = Chebyshev::default();
    let soft = Softness::uncapped(120.0, 5.0, moment.h);
    let refresh = Refresh::<N> {
        blocks: &plan.blocks,
        swept: &mut swept,
        ground: &mut ground,
        displacements: &displacements,
        moment: &moment,
    };
    run(wide, refresh);
    for moves in [true, false] {
        let numbers = Numbers {
            plan: &plan,
            swept: &mut swept,
            ground: &mut ground,
            impulses: &mut impulses,
            velocities: &mut velocities,
            chebyshev: &mut chebyshev,
        };
        if moves {
            run(wide, Move::<N> { numbers, soft, h: moment.h });
        } else {
            run(wide, Settle::<N> { numbers });
        }
    }
    [swept, ground, impulses, velocities].concat()
}

fn run(wide: bool, pass: impl Pass) {
    if wide {
        Processor::of_this_machine().run(pass);
    } else {
        pass.run(Plain);
    }
}

#[test]
fn machines_sweep_nets_alike() {
    fn check<const N: usize>() {
        // Slow bodies, fast ones, and such as go round within a step.
        for farthest in [0.5, 20.0, 1000.0] {
            let (plain, wide) = (substep::<N>(false, farthest), substep::<N>(true, farthest));
            let bits = |lanes: &Lanes| lanes.0.map(Real::to_bits);
            assert!(plain.iter().flat_map(|lanes| lanes.0).all(Real::is_finite), "{N}D, {farthest}");
            assert!(plain.iter().map(bits).eq(wide.iter().map(bits)), "{N}D, {farthest}");
        }
    }
    check::<2>();
    check::<3>();
    check::<4>();
    check::<6>();
}
