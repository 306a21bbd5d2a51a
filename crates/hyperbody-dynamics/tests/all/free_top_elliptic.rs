//! Elliptic integrals and Jacobi's functions against values computed with 25 digits by another program (mpmath 1.3), and
//! against their own identities.

use std::f64::consts::{FRAC_PI_2, PI};

use hyperbody_dynamics::free_top::elliptic::{
    carlson_rf, carlson_rj, complete_first, incomplete_first, jacobi, third_within_quarter,
};

fn close(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 4e-15 * expected.abs().max(1.0), "{what}: {found} instead of {expected}");
}

#[test]
fn complete_integrals_match_known_values() {
    close(complete_first(1.0), FRAC_PI_2, "K(0)");
    close(complete_first(0.5), 1.854_074_677_301_371_9, "K at k² = 1/2, the lemniscate");
    close(complete_first(0.01), 3.695_637_362_989_874_7, "K at m₁ = 0.01");
    close(complete_first(1e-10), 12.899_219_826_387_6, "K at m₁ = 1e-10");
    assert_eq!(complete_first(0.0), f64::INFINITY);
    // K → ln 4 − ½ ln m₁ near the separatrix.
    close(complete_first(1e-300), 4.0_f64.ln() + 150.0 * 10.0_f64.ln(), "K at m₁ = 1e-300");
}

#[test]
fn jacobi_functions_match_known_values() {
    let cases = [
        (0.5, 0.7, [0.474_215_622_711_820_6, 0.880_408_736_426_462_4, 0.965_678_964_745_951_2]),
        (1.3, 0.19, [0.885_760_198_280_398_9, 0.464_143_158_025_913_8, 0.603_736_188_765_620_9]),
        (-2.7, 0.5, [-0.806_976_989_565_485_9, -0.590_582_880_137_771_7, 0.821_214_995_695_958_3]),
        (7.0, 0.01, [0.372_547_301_307_817_7, -0.928_013_204_802_745_3, 0.928_760_692_108_241_3]),
    ];
    for (u, m1, expected) in cases {
        let (sn, cn, dn) = jacobi(u, m1);
        for (found, expected) in [sn, cn, dn].into_iter().zip(expected) {
            close(found, expected, &format!("u = {u}, m₁ = {m1}"));
        }
    }
    // Small values near the separatrix keep their relative accuracy, up to the conditioning of the argument.
    let (_, cn, dn) = jacobi(11.0, 1e-9);
    close(cn / 0.000_025_919_133_970_437_42, 1.0, "cn near the separatrix");
    close(dn / 0.000_040_887_669_352_821_78, 1.0, "dn near the separatrix");
}

#[test]
fn jacobi_functions_meet_their_limits_and_identities() {
    for step in -40..=40 {
        let u = 0.13 * f64::from(step);
        let (sn, cn, dn) = jacobi(u, 1.0);
        close(sn, u.sin(), "circular");
        close(cn, u.cos(), "circular");
        close(dn, 1.0, "circular");
        let (sn, cn, dn) = jacobi(u, 0.0);
        close(sn, u.tanh(), "hyperbolic");
        close(cn, 1.0 / u.cosh(), "hyperbolic");
        close(dn, cn, "hyperbolic");
        for m1 in [0.9, 0.3, 1e-3, 1e-8] {
            let (sn, cn, dn) = jacobi(u, m1);
            close(sn * sn + cn * cn, 1.0, "sn² + cn²");
            close(dn * dn, m1 + (1.0 - m1) * cn * cn, "dn²");
            let quarter = complete_first(m1);
            let (shifted, _, _) = jacobi(u + quarter, m1);
            close(shifted, cn / dn, "sn(u + K) = cd u");
        }
    }
}

#[test]
fn incomplete_integrals_match_known_values_and_invert_the_amplitude() {
    close(incomplete_first(0.5, 0.7), 0.506_140_211_962_355_3, "F");
    close(incomplete_first(1.5, 0.01), 3.036_014_097_339_71, "F");
    close(incomplete_first(4.0, 0.5), 4.619_520_616_257_107, "F beyond a quarter turn");
    close(incomplete_first(-10.0, 0.2), -14.145_226_112_695_65, "F beyond a turn");
    close(incomplete_first(1.5, 0.0), 3.340_677_542_798_311, "F on the separatrix");
    assert_eq!(incomplete_first(2.0, 0.0), f64::INFINITY);
    for step in -30..=30 {
        let phi = 0.31 * f64::from(step);
        for m1 in [1.0, 0.4, 1e-4] {
            let (sn, cn, _) = jacobi(incomplete_first(phi, m1), m1);
            // Near half turns of a flat amplitude the inverse loses what the slope takes.
            assert!((sn - phi.sin()).abs() < 1e-13 && (cn - phi.cos()).abs() < 1e-13, "φ = {phi}, m₁ = {m1}");
        }
    }
}

#[test]
fn integrals_of_the_third_kind_match_known_values() {
    let third = |nu: f64, phi: f64, m1| third_within_quarter(phi.sin(), phi.cos(), nu, m1);
    close(third(0.0, 1.0, 0.5), 1.083_216_772_845_168_8, "Π with ν = 0 is F");
    close(third(0.3, 0.7, 0.5), 0.697_806_691_158_348_9, "Π");
    close(third(5.0, 1.2, 0.1), 0.672_375_534_567_067_2, "Π");
    close(third(100.0, 1.5, 0.9), 0.156_298_181_122_183_1, "Π with a large ν");
    close(third(0.01, -1.4, 1e-6), -2.443_376_685_380_43, "Π near the separatrix");
    // Without modulus the complete integral is elementary: π/(2√(1+ν)).
    close(third_within_quarter(1.0, 0.0, 3.0, 1.0), PI / 4.0, "complete Π of a circle");
}

#[test]
fn carlson_forms_match_known_values() {
    close(carlson_rf(1.0, 2.0, 0.0), 1.311_028_777_146_06, "R_F");
    close(carlson_rf(2.0, 3.0, 4.0), 0.584_082_841_677_151_7, "R_F");
    close(carlson_rj(0.0, 1.0, 2.0, 3.0), 0.776_886_237_785_823_3, "R_J");
    close(carlson_rj(2.0, 3.0, 4.0, 5.0), 0.142_975_796_671_567_54, "R_J");
    assert_eq!(carlson_rf(0.0, 0.0, 1.0), f64::INFINITY);
}
