//! What is accepted for each key, in words: the end of every message about a bad value.

/// What is accepted for a key, by its dotted path without names and positions.
pub fn accepted(key: &str) -> Option<&'static str> {
    ACCEPTED.iter().find(|(name, _)| *name == key).map(|(_, text)| *text)
}

const VECTOR: &str = "three finite numbers [x, y, z]";
const NAME: &str = "a text that no other has, not empty";
const POSITIVE: &str = "a finite number > 0";
const AT: &str = "\"start\" | \"end\" | an arc length in m from 0 to the unstretched length";

const SHAPE: &str = "{ cuboid = half extents } | { ball = radius } | { cylinder = [half height, radius] } | { capsule = [half height, radius] } | \
     { plane = normal } | { mesh = \"file.obj\" } | \"none\"";

const ACCEPTED: &[(&str, &str)] = &[
    ("name", "a text"),
    ("duration", "a finite number > 0, in s"),
    ("dt", "a finite number > 0, in s, at most 1e8 steps in all"),
    ("gravity", VECTOR),
    ("engine", "\"none\" | \"rapier\""),
    ("solver_iterations", "a whole number >= 1, with engine = \"rapier\""),
    ("body", "tables [[body]], with engine = \"rapier\" or without engine"),
    ("body.name", "a text that no other body has, not empty, not \"world\", not \"all\""),
    ("body.kind", "\"dynamic\" (default) | \"fixed\" | \"kinematic\""),
    ("body.shape", SHAPE),
    ("body.shape.cuboid", "half extents [x, y, z], three finite numbers > 0, in m"),
    ("body.shape.ball", "a radius, a finite number > 0, in m"),
    ("body.shape.cylinder", "[half height, radius], finite numbers > 0, in m"),
    ("body.shape.capsule", "[half height, radius], finite numbers > 0, in m"),
    ("body.shape.plane", "a normal [x, y, z] that is not zero, for a fixed or kinematic body"),
    (
        "body.shape.mesh",
        "an OBJ file with triangles, named from the folder of the scene; for a dynamic body one that encloses a volume",
    ),
    ("body.mass", "a finite number > 0, in kg, or density, for a dynamic body; no other body has a mass"),
    ("body.density", "a finite number > 0, in kg/m^3, for a dynamic body with a shape, instead of mass"),
    ("body.inertia", "three finite numbers > 0, in kg m^2, none larger than the sum of the others, for a dynamic body"),
    ("body.position", VECTOR),
    ("body.rotation", "axis times angle [x, y, z], three finite numbers, in rad"),
    ("body.velocity", "three finite numbers [x, y, z], in m/s, for a dynamic body or a kinematic one without path"),
    ("body.angular_velocity", "three finite numbers [x, y, z], in rad/s, for a dynamic or kinematic body"),
    ("body.friction", "a finite number >= 0, for a body with a shape"),
    ("body.path", "rows [t, x, y, z] of finite numbers in s and m, at least one, t ascending, for a kinematic body"),
    ("cable", "at least one table [[cable]]"),
    ("cable.name", "a text that no other cable has, not empty, not \"all\""),
    ("cable.points", "two points [x, y, z] or more, in m, neighbours apart"),
    ("cable.length", "a finite number > 0, in m"),
    ("cable.initial", "\"straight\" | \"equilibrium\""),
    ("cable.elements", "a whole number from 1 to 1000000"),
    ("cable.section", "{ square = side } | { round = diameter } | { tube = [outer, inner] }, in m"),
    ("cable.section.square", POSITIVE),
    ("cable.section.round", POSITIVE),
    ("cable.section.tube", "[outer, inner] diameter in m, outer > inner >= 0"),
    ("cable.density", "a finite number > 0, in kg/m^3, beside section"),
    ("cable.youngs_modulus", "a finite number > 0, in Pa, beside section"),
    (
        "cable.axial_stiffness",
        "EA, a finite number > 0, in N, with bending_stiffness and mass_per_length, instead of section",
    ),
    (
        "cable.bending_stiffness",
        "EI, a finite number >= 0, in N m^2, with axial_stiffness and mass_per_length, instead of section",
    ),
    (
        "cable.mass_per_length",
        "a finite number > 0, in kg/m, with axial_stiffness and bending_stiffness, instead of section",
    ),
    (
        "cable.rule",
        "\"GL-T\" | \"ST1\" | \"ST2\" | \"L2T1\" | \"L2T2\" | \"AXIAL-BENDING\" | { axial = \"projected|exact|mean|gauss-N\", \
         bending = \"none|t1|t2|gauss-N\" }, L, T, N from 1 to 10 (`lariat rules`)",
    ),
    ("cable.rule.axial", "\"projected\" | \"exact\" | \"mean\" | \"gauss-N\", N from 1 to 10"),
    ("cable.rule.bending", "\"none\" | \"t1\" | \"t2\" | \"gauss-N\", N from 1 to 10"),
    ("cable.allow_rank_deficient", "true | false"),
    (
        "cable.integrator",
        "{ tolerance } | { method, tolerance } | { method, substeps } | { method, max_step } | { method, stable } | { fidelity }",
    ),
    ("cable.integrator.method", "a name from `lariat integrators`"),
    ("cable.integrator.fidelity", "\"game\" | \"engineering\" | \"reference\""),
    (
        "cable.integrator.tolerance",
        "a finite number > 0, in m per host step, for a method with an error estimate (`lariat integrators`)",
    ),
    (
        "cable.integrator.substeps",
        "a whole number >= 1, for each host step (a probe between two of them splits the host step)",
    ),
    ("cable.integrator.max_step", "a finite number > 0, in s"),
    ("cable.integrator.stable", "a share of the stability limit in (0, 1], for an explicit method"),
    ("cable.velocity", VECTOR),
    ("cable.angular_velocity", VECTOR),
    ("cable.damping", "a table with axial or bending or both"),
    ("cable.damping.axial", "a finite number >= 0, in s"),
    ("cable.damping.bending", "a finite number >= 0, in s; 0 without a bending rule"),
    ("cable.drag.fluid_density", "a finite number > 0, in kg/m^3"),
    ("cable.drag.normal", "a finite number >= 0"),
    ("cable.drag.tangential", "a finite number >= 0"),
    ("cable.drag.flow", VECTOR),
    ("cable.drag.diameter", "a finite number > 0, in m; needed where the cable has no section"),
    ("cable.buoyancy.fluid_density", "a finite number > 0, in kg/m^3"),
    ("cable.buoyancy.added_mass", "a finite number >= 0"),
    ("cable.buoyancy.area", "a finite number > 0, in m^2; needed where the cable has no section"),
    ("attachment.name", NAME),
    ("attachment.cable", "the name of a cable"),
    ("attachment.at", AT),
    ("attachment.body", "\"world\" | the name of a body"),
    (
        "attachment.anchor",
        "three finite numbers, in m, in the axes of the body: where the cable point starts, within 1e-6 m, or any place if the cable has initial = \"equilibrium\"",
    ),
    ("attachment.kind", "\"ball\" | \"clamp\""),
    ("load", "cable and at, or body, with force or moment or both"),
    ("load.cable", "the name of a cable"),
    ("load.at", AT),
    ("load.body", "the name of a dynamic body, instead of cable and at"),
    ("load.point", "three finite numbers [x, y, z], in m, in the axes of the body from its origin, beside body"),
    ("load.force", VECTOR),
    ("load.moment", VECTOR),
    ("load.ramp", "a finite number >= 0, in s"),
    ("probe", "exactly one of cable (with at), body, attachment, energy, momentum"),
    ("probe.name", "a text that no other probe has and that can name a file: no / \\ : * ? \" < > |, no leading dot"),
    ("probe.every", "a finite number > 0, in s, at most 1e8 samples in all"),
    ("probe.cable", "the name of a cable"),
    ("probe.at", AT),
    ("probe.body", "the name of a body"),
    ("probe.attachment", "the name of an attachment"),
    ("probe.energy", "the name of a cable | \"all\""),
    ("probe.momentum", "the name of a cable | \"all\""),
];
