//! What of a model becomes what of a scene.

use lariat_scene::mjcf;

const HEAD: &str = "<mujoco><extension><plugin plugin=\"mujoco.elasticity.cable\"/></extension>";

fn cable(attributes: &str, joint: &str, geom: &str) -> String {
    format!(
        "<composite type=\"cable\" prefix=\"c_\" {attributes}><plugin plugin=\"mujoco.elasticity.cable\">\
         <config key=\"bend\" value=\"1e8\"/></plugin>{joint}<geom {geom}/></composite>"
    )
}

fn straight() -> String {
    cable("curve=\"s\" count=\"11 1 1\" size=\"1\" offset=\"0 0 1\" initial=\"none\"", "", ROUND)
}

const ROUND: &str = "type=\"cylinder\" size=\".01\" contype=\"0\" conaffinity=\"0\"";

fn read(world: &str, rest: &str) -> Result<toml::Table, String> {
    let text = format!("{HEAD}<worldbody>{world}</worldbody>{rest}</mujoco>");
    let import = mjcf::read("model.xml", &text).map_err(|error| error.to_string())?;
    Ok(import.scene.parse().unwrap())
}

fn table<'t>(scene: &'t toml::Table, key: &str, index: usize) -> &'t toml::Table {
    scene[key][index].as_table().unwrap()
}

fn numbers(value: &toml::Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_float().unwrap()).collect()
}

fn near(value: &toml::Value, expected: &[f64]) {
    let value = numbers(value);
    assert!(value.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{value:?} {expected:?}");
}

/// EI + k l: a joint that turns by an angle a between segments of length l is a curvature a/l.
#[test]
fn springs_of_joints_are_bending_stiffness() {
    let world = cable(
        "curve=\"s\" count=\"11 1 1\" size=\"1\" initial=\"none\"",
        "<joint kind=\"main\" stiffness=\"2\"/>",
        ROUND,
    );
    let scene = read(&world, "").unwrap();
    let own = 1e8 * std::f64::consts::PI * 0.01_f64.powi(4) / 4.0;
    let bending = table(&scene, "cable", 0)["bending_stiffness"].as_float().unwrap();
    assert!((bending - own - 2.0 * 0.1).abs() < 1e-9, "{bending}");
    let flat = world.replace("<config key", "<config key=\"flat\" value=\"true\"/><config key");
    let bent = flat.replace("curve=\"s\" count=\"11 1 1\" size=\"1\"", "vertex=\"0 0 0 1 0 0 2 1 0\"");
    assert!(
        read(&bent.replace("2 1 0", "1.7071067811865476 0.7071067811865475 0"), "")
            .unwrap_err()
            .contains("one shape at rest")
    );
}

/// A circle of radius 0.5 m is at rest with the curvature 2/m; flat it is straight at rest.
#[test]
fn a_bent_composite_rests_bent_unless_it_is_flat() {
    let vertices: String =
        (0..9).map(|k| 0.2 * f64::from(k)).map(|a| format!("{} {} 0 ", 0.5 * a.sin(), 0.5 - 0.5 * a.cos())).collect();
    let world = cable(&format!("vertex=\"{vertices}\" initial=\"none\""), "", ROUND);
    let scene = read(&world, "").unwrap();
    let curvature = scene["cable"][0]["rest_shape"]["curvature"].as_float().unwrap();
    assert!((curvature - 2.0).abs() < 2e-3, "{curvature}");
    let flat = read(&world.replace("<config key", "<config key=\"flat\" value=\"true\"/><config key"), "").unwrap();
    assert!(!table(&flat, "cable", 0).contains_key("rest_shape"));
}

/// Bodies stand where frames, Euler angles and the axes of capsules place them: z of MuJoCo is y of a capsule here.
#[test]
fn bodies_have_kind_shape_place_and_mass() {
    let world = format!(
        "{}<frame pos=\"0 0 1\"><body name=\"pole\" pos=\"1 0 0\" euler=\"0 90 0\"><geom type=\"capsule\" size=\".1 .5\"/></body></frame>\
         <body name=\"hand\" mocap=\"true\" pos=\"0 2 0\"><geom type=\"box\" size=\".1 .2 .3\"/></body>\
         <body name=\"crate\" pos=\"0 0 5\"><freejoint/><geom size=\".1\" density=\"500\"/></body>\
         <body name=\"door\" pos=\"0 3 0\"><joint axis=\"0 0 1\" pos=\"0 -.5 0\"/><geom type=\"box\" size=\".1 .5 1\" mass=\"12\"/>\
         <body name=\"knob\" pos=\".2 0 0\"><geom size=\".05\" mass=\"1\"/></body></body>",
        straight().replace("contype=\"0\" conaffinity=\"0\"", "")
    );
    let scene = read(&world, "").unwrap();
    let bodies = scene["body"].as_array().unwrap();
    let body = |name: &str| bodies.iter().find(|body| body["name"].as_str() == Some(name)).unwrap();
    assert_eq!(body("pole")["kind"].as_str(), Some("fixed"));
    near(&body("pole")["position"], &[1.0, 0.0, 1.0]);
    near(&body("pole")["shape"]["capsule"], &[0.5, 0.1]);
    // y of the scene's capsule must point along x: z of the geom, turned by 90 degrees about y
    let rotation =
        nalgebra::UnitQuaternion::from_scaled_axis(nalgebra::Vector3::from_vec(numbers(&body("pole")["rotation"])));
    assert!((rotation * nalgebra::Vector3::y() - nalgebra::Vector3::x()).norm() < 1e-9);
    assert_eq!(body("hand")["kind"].as_str(), Some("kinematic"));
    let mass = 500.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-3;
    assert!((body("crate")["mass"].as_float().unwrap() - mass).abs() < 1e-9);
    // a box of half sides a, b, c: m/3 (b^2 + c^2)
    near(&body("door")["inertia"], &[4.0 * 1.25, 4.0 * 1.01, 4.0 * 0.26]);
    let joints = scene["joint"].as_array().unwrap();
    assert_eq!(joints.len(), 2);
    assert_eq!(joints[0]["kind"].as_str(), Some("hinge"));
    near(&joints[0]["at"], &[0.0, 2.5, 0.0]);
    assert_eq!((joints[1]["kind"].as_str(), joints[1]["to"].as_str()), (Some("fixed"), Some("door")));
}

#[test]
fn equalities_hold_any_body_or_site() {
    let pole = "<body name=\"pole\" pos=\"1 0 1\"><geom size=\".01\" contype=\"0\" conaffinity=\"0\"/><site name=\"hook\"/></body>\
                <body name=\"load\" pos=\".5 0 1\"><freejoint/><geom size=\".01\" contype=\"0\" conaffinity=\"0\"/></body>";
    let world = straight() + pole;
    let held = |equality: &str| {
        read(&world, &format!("<equality>{equality}</equality>")).map(|scene| {
            let last = scene["attachment"].as_array().unwrap().last().unwrap().clone();
            let at = last["at"].as_str().map_or_else(|| last["at"].as_float().unwrap().to_string(), str::to_string);
            let kind = last.get("kind").and_then(|kind| kind.as_str()).unwrap_or("ball").to_string();
            format!("{at} {} {kind}", last["body"].as_str().unwrap())
        })
    };
    let is = |equality: &str, expected: &str| assert_eq!(held(equality).as_deref(), Ok(expected), "{equality}");
    is("<connect body1=\"c_B_last\" body2=\"pole\" anchor=\".1 0 0\"/>", "end world ball");
    is("<connect body1=\"pole\" body2=\"c_B_last\" anchor=\"0 0 0\"/>", "end world ball");
    is("<connect site1=\"hook\" site2=\"c_S_last\"/>", "end world ball");
    is("<connect body1=\"c_B_5\" body2=\"load\" anchor=\"0 0 0\"/>", "0.5 load ball");
    is("<weld body1=\"c_B_last\"/>", "end world clamp");
    is("<weld body1=\"load\" body2=\"c_B_5\"/>", "0.55 load clamp");
    is("<connect body1=\"c_B_last\" anchor=\".1 0 0\" active=\"false\"/>", "start world clamp");
    for (equality, word) in [
        ("<connect body1=\"c_B_last\" anchor=\".1 .05 0\"/>", "beside"),
        ("<connect body1=\"c_B_77\" anchor=\"0 0 0\"/>", "c_B_77"),
        ("<connect site1=\"hook\" site2=\"c_S_first\"/>", "apart"),
        ("<weld body1=\"c_B_last\" relpose=\"0 0 0 1 0 0 0\"/>", "relpose"),
        ("<joint joint1=\"j\"/>", "connect and weld"),
    ] {
        let error = held(equality).unwrap_err();
        assert!(error.contains(word), "{error}");
    }
}

/// A floor is touched by what `contype` and `conaffinity` let touch it, with the friction of `condim`.
#[test]
fn surfaces_touch_by_their_bits() {
    let floor = "<geom type=\"plane\" size=\"1 1 1\"/>";
    let off = read(&(straight() + floor), "").unwrap();
    assert!(!off.contains_key("body") && !table(&off, "cable", 0).contains_key("contact"));
    let on = read(&(straight().replace("contype=\"0\" conaffinity=\"0\"", "condim=\"1\"") + floor), "").unwrap();
    assert!(table(&on, "body", 0)["shape"].get("plane").is_some());
    let contact = &table(&on, "cable", 0)["contact"];
    assert_eq!(contact["itself"].as_bool(), Some(true));
    let disabled = read(
        &(straight().replace("contype=\"0\" conaffinity=\"0\"", "") + floor),
        "<option><flag contact=\"disable\"/></option>",
    );
    assert!(!table(&disabled.unwrap(), "cable", 0).contains_key("contact"));
}

/// The box of inertia of a cylinder of radius r has the sides 3^(1/2) r across: 1/2 rho 3^(1/2) r v^2 per length.
#[test]
fn options_are_gravity_and_drag() {
    let scene = read(&straight(), "<option density=\"2\" wind=\"1 2 3\"><flag gravity=\"disable\"/></option>").unwrap();
    near(&scene["gravity"], &[0.0; 3]);
    let drag = &table(&scene, "cable", 0)["drag"];
    let [normal, diameter] = ["normal", "diameter"].map(|key| drag[key].as_float().unwrap());
    assert!((normal * diameter - 3.0_f64.sqrt() * 0.01).abs() < 1e-12);
    near(&drag["flow"], &[1.0, 2.0, 3.0]);
    assert!(read(&straight(), "<option viscosity=\"1\"/>").unwrap_err().contains("viscosity"));
}

/// That of capsules has their half balls: 40.205 mm and 8.5147 mm of a segment of 1/30 m and a radius of 5 mm.
///
/// *Source.* `body_inertia` and `body_mass` of MuJoCo 3.17, `6 (I_y + I_z - I_x)/m`.
#[test]
fn capsules_drag_with_their_ends() {
    let model = "<composite type=\"cable\" curve=\"s\" count=\"31 1 1\" size=\"1.0\" initial=\"none\" prefix=\"D\">\
                 <plugin plugin=\"mujoco.elasticity.cable\"><config key=\"twist\" value=\"1e7\"/><config key=\"bend\" value=\"1e6\"/></plugin>\
                 <joint kind=\"main\" damping=\"0.002\"/><geom type=\"capsule\" size=\".005\" density=\"1500\"/></composite>";
    let scene = read(model, "<option density=\"1.2\" wind=\"0 6 0\"/>").unwrap();
    let drag = &table(&scene, "cable", 0)["drag"];
    let [normal, tangential, diameter] = ["normal", "tangential", "diameter"].map(|key| drag[key].as_float().unwrap());
    let (along, across, segment) = (0.04020548871, 0.00851469318, 1.0 / 30.0);
    assert!((normal * diameter / (along * across / segment) - 1.0).abs() < 1e-6, "{normal}");
    assert!((tangential * diameter / (across * across / segment) - 1.0).abs() < 1e-6, "{tangential}");
}

/// Actuators are left out while their control at zero does nothing, and refused if it does.
#[test]
fn actuators_with_a_bias_are_refused() {
    let world = straight() + "<body><joint name=\"j\"/><geom size=\".1\" contype=\"0\" conaffinity=\"0\"/></body>";
    assert!(read(&world, "<actuator><motor joint=\"j\"/></actuator>").is_ok());
    assert!(read(&world, "<actuator><position joint=\"j\" kp=\"3\"/></actuator>").unwrap_err().contains("<position>"));
    assert!(read(&world, "<actuator><general joint=\"j\" biastype=\"affine\"/></actuator>").is_err());
}
