//! Studies of programs whose error is known in closed form, and of those that cannot be studied.

use lariat_ancf::study::{Outcome, Proof, Record, Resolution, Study, StudyError};
use lariat_ancf::{At, Cable, Error, PointLoad, Section, Vector3};

/// Positions with the error `size n^-order + share tolerance` per step, over a second in a hundred steps.
fn model(size: f64, order: f64, share: f64) -> impl FnMut(&Resolution, &mut Record) -> Result<f64, String> {
    move |resolution, record| {
        let mut off = 0.0;
        for k in 0..=100 {
            let t = 0.01 * f64::from(k);
            off = t * size * (resolution.elements as f64).powf(-order);
            off += share * f64::from(k) * resolution.tolerance.unwrap();
            record.frame(t).point([t + off, 0.0, 0.0]);
        }
        Ok(off)
    }
}

#[test]
fn the_claim_holds_for_every_order_from_two_on_and_every_share_of_the_tolerance() {
    for order in [2.0, 2.5, 3.0, 4.0] {
        for size in [1e-3, 0.3, 20.0] {
            for share in [0.0, 0.5, 1.0] {
                for error in [1e-2, 1e-3, 1e-4] {
                    let proof =
                        Study::new(1.0, 0.01, model(size, order, share)).error(error).limit(5000).run().unwrap();
                    let (claim, off) = (proof.claim, proof.world);
                    let claimed = claim.claimed_m.unwrap();
                    assert!(
                        claim.outcome == Outcome::Proven && off <= claimed && claimed <= error,
                        "{claim:?}: {off:.2e}"
                    );
                }
            }
        }
    }
}

/// The first order is that of cables which a load bends within less than an element.
#[test]
fn the_claim_holds_for_the_first_order() {
    for order in [1.0, 1.5] {
        for (size, error) in [(1e-3, 1e-4), (0.3, 1e-2), (0.3, 1e-3), (2.0, 1e-2)] {
            let proof = Study::new(1.0, 0.01, model(size, order, 0.5)).error(error).limit(9000).run().unwrap();
            let (claim, off) = (proof.claim, proof.world);
            assert!(claim.outcome == Outcome::Proven && off <= claim.claimed_m.unwrap(), "{claim:?}: {off:.2e}");
        }
    }
}

#[test]
fn runs_that_do_not_converge_or_would_need_too_many_elements_are_told() {
    // each mesh goes elsewhere after half a second
    let chaotic = |resolution: &Resolution, record: &mut Record| {
        for k in 0..=100 {
            let t = 0.01 * f64::from(k);
            let far = if t > 0.5 { (37.0 * resolution.elements as f64).sin() } else { 0.0 };
            record.frame(t).point([t, far, 0.0]);
        }
        Ok::<_, String>(())
    };
    let claim = Study::new(1.0, 0.01, chaotic).error(1e-3).run().unwrap().claim;
    assert_eq!((claim.outcome, claim.claimed_m), (Outcome::NoConvergence, None));
    assert!((claim.horizon_s.unwrap() - 0.51).abs() < 1e-9);
    let claim = Study::new(1.0, 0.01, model(50.0, 2.0, 0.0)).error(1e-5).run().unwrap().claim;
    assert_eq!((claim.outcome, claim.claimed_m), (Outcome::ElementLimit, None));
    assert!(claim.elements <= 160 && claim.horizon_s.is_some());
    // an error of the first order: 0.3/n m is below 1e-5 m from 30000 elements on
    let first = Study::new(1.0, 0.01, model(0.3, 1.0, 0.0)).error(1e-5).run().unwrap().claim;
    assert!(first.outcome == Outcome::ElementLimit && first.elements < 160 && first.horizon_s.is_some());
    let needed = first.elements_needed.unwrap() as f64;
    assert!((15_000.0..60_000.0).contains(&needed), "{first:?}");
    // parts that only one mesh has
    let breaks = |resolution: &Resolution, record: &mut Record| {
        record.frame(0.0).point([0.0; 3]);
        record.frame(0.5).point([0.0; 3]);
        if resolution.elements % 3 == 2 {
            record.point([0.0; 3]);
        }
        Ok::<_, String>(())
    };
    let claim = Study::new(0.5, 0.5, breaks).error(1e-3).limit(12).run().unwrap().claim;
    assert_eq!((claim.outcome, claim.mesh_m, claim.horizon_s), (Outcome::ElementLimit, None, Some(0.5)));
    let nan = |_: &Resolution, record: &mut Record| {
        record.frame(0.0).point([f64::NAN; 3]);
        Ok::<_, String>(())
    };
    let claim = Study::of_equilibrium(nan).error(1e-3).run().unwrap().claim;
    assert_ne!(claim.outcome, Outcome::Proven);
}

/// The first runs fail with fewer than ten elements: 8 and 16 are tried after 4 and 8, and 16 and 32 after these.
#[test]
fn coarse_meshes_that_fail_are_left_out_and_other_failures_are_errors() {
    let least = |least: usize| {
        move |resolution: &Resolution, record: &mut Record| {
            if resolution.elements < least {
                return Err(format!("{} elements are too few", resolution.elements));
            }
            record.frame(0.0).point([0.0; 3]);
            Ok(resolution.elements)
        }
    };
    assert_eq!(Study::of_equilibrium(least(10)).run().unwrap().world, 32);
    // 32 elements work, and no run shows their error
    let Proof { world, claim, .. } = Study::of_equilibrium(least(20)).run().unwrap();
    assert_eq!((world, claim.outcome, claim.mesh_m), (32, Outcome::NoConvergence, None));
    assert_eq!(claim.failed.map(|run| run.elements), Some(16));
    let error = Study::of_equilibrium(least(40)).run().unwrap_err();
    assert_eq!(error.to_string(), "run with 16 elements: 16 elements are too few");
    let refused = |error: f64| Study::of_equilibrium(least(0)).error(error).run().unwrap_err();
    for error in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(error), StudyError::InvalidError { .. }));
    }
    for (duration, step) in [(1.0, 0.0), (f64::NAN, 0.1), (1.0, -0.1), (f64::INFINITY, 0.1)] {
        let error = Study::new(duration, step, least(0)).run().unwrap_err();
        assert!(matches!(error, StudyError::InvalidSpan { .. }), "{duration}, {step}: {error:?}");
    }
    let nothing = |_: &Resolution, _: &mut Record| Ok::<_, String>(());
    assert_eq!(Study::of_equilibrium(nothing).run().unwrap_err(), StudyError::NothingRecorded);
    let times = |resolution: &Resolution, record: &mut Record| {
        record.frame(resolution.elements as f64).point([0.0; 3]);
        Ok::<_, String>(())
    };
    let error = Study::of_equilibrium(times).run().unwrap_err();
    assert!(matches!(error, StudyError::DifferentTimes { time: 4.0, other: 8.0 }), "{error:?}");
}

/// A cantilever under an end moment M = m EI becomes an arc of a circle.
///
/// *Source.* Analytic, as in `end_moment.rs`: stretch `f^2 = 1 + 2 m^2 EI/EA`, angle `m f^2 L`, radius `f L/angle`.
#[test]
fn the_claim_for_an_arc_of_a_circle_holds() {
    let (axial, bending) = (1e6, 2.0);
    for m in [0.4_f64, 1.5, 3.0] {
        let (stretch, angle) =
            ((1.0 + 2.0 * m * m * bending / axial).sqrt(), m * (1.0 + 2.0 * m * m * bending / axial));
        let tip = Vector3::new(angle.sin(), 1.0 - angle.cos(), 0.0) * stretch / angle;
        for error in [1e-3, 1e-5] {
            let study = Study::of_equilibrium(|resolution, record| {
                let mut cable = Cable::builder()
                    .points([Vector3::zeros(), Vector3::x()])
                    .section(Section::from_stiffness(axial, bending, 0.4)?)
                    .gravity([0.0; 3])
                    .clamp(At::Start)
                    .load(PointLoad::moment(1.0, [0.0, 0.0, m * bending]))
                    .elements(resolution.elements)
                    .build()?;
                cable.equilibrium()?;
                record.frame(0.0).cable(&cable);
                Ok::<_, Error>(cable)
            });
            let proof = study.error(error).run().unwrap();
            let off = (proof.world.sample(1.0).unwrap().position - tip).norm();
            println!("m = {m}, asked {error:.0e}: off {off:.1e}, {:?}", proof.claim);
            assert!(off <= proof.claim.claimed_m.unwrap());
        }
    }
}

/// A model of the second order that fails where `fails` says so.
fn failing(
    size: f64,
    share: f64,
    fails: impl Fn(&Resolution) -> bool,
) -> impl FnMut(&Resolution, &mut Record) -> Result<f64, String> {
    let mut run = model(size, 2.0, share);
    move |resolution, record| {
        let off = run(resolution, record)?;
        if fails(resolution) { Err(format!("failed at {resolution:?}")) } else { Ok(off) }
    }
}

/// A study of which a run on a finer mesh fails ends with what the meshes before it prove, and says
/// which run failed.
///
/// *Source.* The error `t size/n^2` of the model is below the one asked for before the horizon.
#[test]
fn a_study_ends_with_what_it_knows_where_a_finer_mesh_fails() {
    let (size, error) = (20.0, 1e-2);
    let run = failing(size, 0.5, |resolution| resolution.elements > 20);
    let Proof { world, claim, .. } = Study::new(1.0, 0.01, run).error(error).run().unwrap();
    println!("{claim:?}");
    assert_eq!((claim.outcome, claim.claimed_m), (Outcome::NoConvergence, None));
    assert!(claim.elements <= 20 && claim.failed.unwrap().elements > 20, "{claim:?}");
    let horizon = claim.horizon_s.unwrap();
    assert!(horizon > 0.0 && horizon * world.abs() <= error, "{world} m, {claim:?}");
    // a study that does not need that mesh is not kept from its proof
    let run = failing(1e-3, 0.5, |resolution| resolution.elements > 20);
    let claim = Study::new(1.0, 0.01, run).error(error).run().unwrap().claim;
    assert!(claim.outcome == Outcome::Proven && claim.failed.is_none(), "{claim:?}");
}

/// A study of which runs at tighter tolerances fail, on every mesh, ends with what looser ones
/// prove.
///
/// *Source.* The error `k share tau` of the model at the step k.
#[test]
fn a_study_ends_with_what_it_knows_where_a_tighter_tolerance_fails() {
    let error = 1e-2;
    let tightest = error / 400.0;
    let run =
        failing(1e-3, 20.0, |resolution| resolution.tolerance.is_some_and(|tolerance| tolerance < 0.9 * tightest));
    let Proof { world, claim, .. } = Study::new(1.0, 0.01, run).error(error).run().unwrap();
    println!("{claim:?}");
    assert_eq!((claim.outcome, claim.claimed_m), (Outcome::NoConvergence, None));
    assert!(claim.failed.unwrap().tolerance_m.unwrap() < claim.tolerance_m.unwrap(), "{claim:?}");
    assert!(claim.horizon_s.unwrap() * world.abs() <= error, "{world} m, {claim:?}");
}

/// Where all but one run fail nothing is proven, and that run is the result; where all fail, the
/// failure is the error.
#[test]
fn the_run_that_works_is_the_result_and_without_one_there_is_none() {
    let mut done = 0;
    let run = failing(1e-3, 0.5, |resolution| resolution.elements != 16 || resolution.tolerance > Some(3e-5));
    let mut counted = run;
    let study = Study::new(1.0, 0.01, |resolution: &Resolution, record: &mut Record| {
        done += 1;
        counted(resolution, record)
    });
    let claim = study.error(1e-2).run().unwrap().claim;
    println!("{claim:?}");
    assert_eq!((claim.outcome, claim.claimed_m, claim.mesh_m), (Outcome::NoConvergence, None, None));
    assert!(claim.elements == 16 && claim.runs == done && claim.failed.is_some() && claim.horizon_s == Some(0.0));
    let all = Study::new(1.0, 0.01, failing(1e-3, 0.5, |_| true)).error(1e-2).run();
    assert!(matches!(all, Err(StudyError::Run { .. })), "{:?}", all.map(|proof| proof.claim));
}

/// A coupled study of which runs with shorter host steps fail ends with what the others prove.
///
/// *Source.* The model does not depend on the parts of a host step, so that its error is that of
/// the mesh.
#[test]
fn a_coupled_study_ends_with_what_it_knows() {
    for parts in [2, 4, 8] {
        let run = failing(20.0, 0.5, move |resolution| resolution.parts >= parts);
        let outcome = Study::new(1.0, 0.01, run).error(1e-2).coupled(true).run();
        let Proof { world, claim, .. } = outcome.unwrap();
        println!("{parts}: {claim:?}");
        assert_eq!((claim.outcome, claim.claimed_m), (Outcome::NoConvergence, None));
        assert!(claim.parts < parts && claim.failed.is_some(), "{claim:?}");
        assert!(claim.horizon_s.unwrap() * world.abs() <= 1e-2, "{world} m, {claim:?}");
    }
}
