"""Lariat: cables computed as finite elements.

You give Young's modulus, density and cross-section; Lariat computes motion, tension and bending moment.

>>> import lariat_cables as lariat
>>> rope = lariat.Cable([[0, 0, 0], [2.5, 0, 0]], lariat.Section(1.66e6, 0.016, 0.147), length=3.0, elements=20, fix=["start", "end"])
>>> report = rope.equilibrium()
>>> round(-rope.sample(1.5).position[1], 2)
0.73

All numbers are in SI units. Arrays are NumPy's, of float64; they are copies, which a later step does not change.
"""

from lariat_cables import bodies, effects, errors, results
from lariat_cables._lariat import VERSION as __version__
from lariat_cables._lariat import (
    Cable,
    CoSimulation,
    Integrator,
    Section,
    World,
    integrators,
    recommended_elements,
    rope_kinds,
    states,
    step_all,
    step_together,
)
from lariat_cables.bodies import Collider, ColliderBuilder, RigidBody, RigidBodyBuilder
from lariat_cables.contact import Obstacle
from lariat_cables.effects import AxialLaw, Buoyancy, Contact, Damping, Drag, Flow, GravityScale, LineLoad, Motor, MotorCourse, RestPiece, RestShape, Torsion
from lariat_cables.errors import Error
from lariat_cables.exchange import EndMotion, Exchange, Exchanged
from lariat_cables.joints import FixedJoint, PrismaticJoint, RevoluteJoint, RopeJoint, SphericalJoint, SpringJoint
from lariat_cables.node import Node
from lariat_cables.recording import Recording, Track, record
from lariat_cables.reel import Reel
from lariat_cables.scenes import Probe, Run, import_mjcf, keys, load, rules, run, statics
from lariat_cables.sweeps import Sweep, sweep
from lariat_cables.water import Water, Wave

__all__ = [
    "AxialLaw",
    "Buoyancy",
    "Cable",
    "CoSimulation",
    "Collider",
    "ColliderBuilder",
    "Contact",
    "Damping",
    "Drag",
    "EndMotion",
    "Error",
    "Exchange",
    "Exchanged",
    "FixedJoint",
    "Flow",
    "GravityScale",
    "Integrator",
    "LineLoad",
    "Motor",
    "MotorCourse",
    "Node",
    "Obstacle",
    "PrismaticJoint",
    "Probe",
    "Recording",
    "Reel",
    "RestPiece",
    "RestShape",
    "RevoluteJoint",
    "RigidBody",
    "RigidBodyBuilder",
    "RopeJoint",
    "Run",
    "Section",
    "SphericalJoint",
    "SpringJoint",
    "Sweep",
    "Torsion",
    "Track",
    "Water",
    "Wave",
    "World",
    "__version__",
    "bodies",
    "effects",
    "errors",
    "import_mjcf",
    "integrators",
    "keys",
    "load",
    "recommended_elements",
    "record",
    "results",
    "rope_kinds",
    "rules",
    "run",
    "states",
    "statics",
    "step_all",
    "step_together",
    "sweep",
]
