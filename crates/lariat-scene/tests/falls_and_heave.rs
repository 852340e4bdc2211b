//! A mass on a light rope by the law of the rope, in time: a fall into it, and heave about its strain at rest.

use lariat_scene::run::{Options, collect};
use lariat_scene::{Purpose, Scene};

/// Runs a mass below a rope that is held at the origin, and returns times and heights of the mass.
fn run(rope: &str, length: f64, mass: f64, [height, velocity]: [f64; 2], dt: f64, duration: f64) -> Vec<[f64; 2]> {
    let text = format!(
        "duration = {duration:?}\ndt = {dt:?}\n[[body]]\nname = \"mass\"\nshape = \"none\"\nmass = {mass:?}\nposition = [0.0, {height:?}, 0.0]\n\
         velocity = [0.0, {velocity:?}, 0.0]\n[[cable]]\nname = \"rope\"\npoints = [[0.0, 0.0, 0.0], [0.0, {height:?}, 0.0]]\nlength = {length:?}\nelements = 8\n\
         bending_stiffness = 0.0\nmass_per_length = 1e-4\nintegrator = {{ fidelity = \"game\" }}\n{rope}[[attachment]]\ncable = \"rope\"\nat = \"start\"\n\
         body = \"world\"\n[[attachment]]\ncable = \"rope\"\nat = \"end\"\nbody = \"mass\"\n[[probe]]\nname = \"mass\"\nbody = \"mass\"\n"
    );
    let scene = Scene::parse("scene.toml", &text, &[], Purpose::Run).unwrap();
    let run = collect(&scene, Purpose::Run, &mut Options::default()).unwrap();
    assert!(run.failed.is_none(), "{:?}", run.failed);
    let probe = run.probes.iter().find(|probe| probe.name == "mass").unwrap();
    let column = |name: &str| probe.columns.iter().position(|c| c.starts_with(name)).unwrap();
    let (t, y) = (column("t"), column("y"));
    probe.rows.chunks(probe.columns.len()).map(|row| [row[t], row[y]]).collect()
}

/// A climber of 80 kg falls into 5 m of dynamic rope, 10 m/s fast: path and lowest point are those of a mass on a spring of the same curve.
///
/// *Source.* m x'' = m g - F(x/L - 1), F(e) = 1.5e4 e + 1.2e5 e^3 N, by Runge and Kutta of order 4 with steps of 1e-5 s. The curve has 81 rows
/// of it.
#[test]
fn a_fall_into_a_rope_is_that_of_its_curve() {
    let force = |e: f64| if e > 0.0 { 1.5e4 * e + 1.2e5 * e.powi(3) } else { 0.0 };
    let (length, mass) = (5.0, 80.0);
    let rows: Vec<String> = (0..81).map(|k| 0.005 * f64::from(k)).map(|e| format!("[{e:?}, {:?}]", force(e))).collect();
    let rope = format!("axial_stiffness = 9e4\naxial_law = {{ curve = [{}] }}\n", rows.join(", "));
    let found = run(&rope, length, mass, [-4.99, -10.0], 0.004, 0.6);
    let (mut x, mut v, h) = (4.99, 10.0, 1e-5);
    let rate = |x: f64, v: f64| [v, 9.81 - force(x / length - 1.0) / mass];
    let (mut worst, mut lowest, mut lowest_found, mut steps) = (0.0f64, 0.0f64, 0.0f64, 0u64);
    for [t, y] in found {
        while (steps as f64 + 0.5) * h < t {
            let [a, b] = rate(x, v);
            let [c, d] = rate(x + 0.5 * h * a, v + 0.5 * h * b);
            let [e, f] = rate(x + 0.5 * h * c, v + 0.5 * h * d);
            let [p, q] = rate(x + h * e, v + h * f);
            (x, v) = (x + h / 6.0 * (a + 2.0 * c + 2.0 * e + p), v + h / 6.0 * (b + 2.0 * d + 2.0 * f + q));
            steps += 1;
        }
        worst = worst.max((x + y).abs());
        (lowest, lowest_found) = (lowest.max(x), lowest_found.max(-y));
    }
    let [peak, peak_found] = [lowest, lowest_found].map(|x| force(x / length - 1.0));
    println!("off by {worst:e} m of {lowest} m; {peak_found:.1} N for {peak:.1} N");
    assert!(peak > 5e3 && (peak_found / peak - 1.0).abs() < 2e-3 && worst < 2e-3, "{worst} {peak_found} {peak}");
}

/// 50 t heave on 200 m of rope at 1 % of strain by Hooke's law as on a linear spring, over three periods.
///
/// *Source.* x = v/omega sin(omega t), omega^2 = EA/(L m).
#[test]
fn heave_by_hookes_law_is_that_of_a_linear_spring() {
    let (mass, length, velocity) = (50e3, 200.0, 0.3);
    let axial = mass * 9.81 / 0.01;
    let omega = f64::sqrt(axial / (length * mass));
    let rest = -length * 1.01;
    let rope = format!("axial_stiffness = {axial:?}\naxial_law = \"hooke\"\n");
    let duration = (3.0 * std::f64::consts::TAU / omega * 60.0).round() / 60.0;
    let found = run(&rope, length, mass, [rest, velocity], 1.0 / 60.0, duration);
    let amplitude = velocity / omega;
    let off = found.iter().map(|[t, y]| (y - rest - amplitude * (omega * t).sin()).abs()).fold(0.0, f64::max);
    println!("off by {:.1e} of the amplitude {amplitude} m in {duration} s", off / amplitude);
    assert!(found.len() > 400 && off < 1e-3 * amplitude, "{off} of {amplitude}");
}
