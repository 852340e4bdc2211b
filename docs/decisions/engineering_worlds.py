"""Random worlds of bodies on undamped and damped ropes: errors and iterations of integrators that fidelity `engineering` could be.

    python3 docs/decisions/engineering_worlds.py target/release/lariat 0 24

prints, for each integrator, the median and the largest of the distance of bodies from a run with a tolerance of 1e-9 m per
host step, of that over the tolerance summed over the host steps, and the Newton iterations of one second.
"""
import csv, math, os, random, re, statistics, subprocess, sys, tempfile

INTEGRATORS = {
    "esdirk4, 1e-6 of motion (the default)": '{ fidelity = "engineering" }',
    **{
        f"discrete gradient, a = {name}, {tolerance:g} of bodies": '{ method = "discrete-gradient", norm = "bodies", '
        f"tolerance = {tolerance:g}, dissipation = {a} }}"
        for name, a in (("1/256", 1 / 256), ("1/4096", 1 / 4096), ("0", 0.0))
        for tolerance in (1e-5, 3e-6)
    },
}
REFERENCE = '{ method = "esdirk4", tolerance = 1e-9 }'


def scene(seed, integrator):
    """Two free bodies on a rope, one that hangs, or two below each other, thrown or released with 0 to 40 % of slack."""
    r = random.Random(seed)
    log = lambda a, b: math.exp(r.uniform(math.log(a), math.log(b)))
    throw = lambda v: [round(r.uniform(-v, v), 3) for _ in range(3)]
    kind, length, slack, speed = r.choice(["free", "hung", "chain"]), log(1, 10), r.choice([1, 1, 1.1, 1.4]), r.choice([0.3, 2, 6])
    chord, step, count = length / slack, r.choice([1 / 60, 1 / 60, 1 / 120, 1 / 30]), r.choice([6, 10, 16])
    section = f"section = {{ round = {r.choice([.004, .008, .012, .02])} }}\nyoungs_modulus = {log(3e8, 1e11):.4e}\ndensity = {r.choice([900, 1400, 4000])}"
    damping = r.choice(["", "", "damping = { axial = 1e-4, bending = 1e-4 }", "damping = { axial = 1e-3, bending = 1e-3 }"])
    body = lambda name, x: (
        f'[[body]]\nname = "{name}"\nshape = {{ ball = 0.1 }}\nmass = {log(.2, 100)}\nposition = [{x}, 0.0, 0.0]\nvelocity = {throw(speed)}\n'
        f'[[probe]]\nname = "{name}"\nbody = "{name}"\n'
    )
    cable = lambda name, x: (
        f'[[cable]]\nname = "{name}"\npoints = [[{x}, 0.0, 0.0], [{x + chord}, 0.0, 0.0]]\nlength = {length}\nelements = {count}\n'
        f"{section}\n{damping}\nintegrator = {integrator}\n"
    )
    tie = lambda cable, at, body: f'[[attachment]]\nname = "{cable}-{at}"\ncable = "{cable}"\nat = "{at}"\nbody = "{body}"\n'
    gravity = [0, 0, 0] if kind == "free" else [0, -9.81, 0]
    text = f'name = "{seed}"\nduration = 1.0\ndt = {step}\ngravity = {gravity}\nengine = "rapier"\n' + body("a", chord + 0.1)
    text += {"free": body("b", -0.1), "chain": body("b", 2 * chord + 0.3), "hung": ""}[kind]
    text += cable("c", 0.0) + tie("c", "start", "b" if kind == "free" else "world") + tie("c", "end", "a")
    if kind == "chain":
        text += cable("d", chord + 0.2) + tie("d", "start", "a") + tie("d", "end", "b")
    return text, round(1 / step)


def run(command, seed, integrator):
    """Returns the positions of the bodies and the iterations, or None for a run that is refused or takes two minutes."""
    with tempfile.TemporaryDirectory() as folder:
        text, _ = scene(seed, integrator)
        path = os.path.join(folder, "scene.toml")
        with open(path, "w") as file:
            file.write(text)
        try:
            done = subprocess.run([command, "run", path, "--out", folder + "/out"], capture_output=True, text=True, timeout=120)
        except subprocess.TimeoutExpired:
            return None
        found = re.search(r"(\d+) Newton iterations", done.stdout)
        if not found:
            return None
        rows = []
        for name in sorted(os.listdir(folder + "/out/probes")):
            with open(f"{folder}/out/probes/{name}") as file:
                rows += [tuple(map(float, row[1:4])) for row in list(csv.reader(file))[1:]]
        return rows, int(found[1])


def main():
    command, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    results = {name: [] for name in INTEGRATORS}
    for seed in range(first, last):
        reference = run(command, seed, REFERENCE)
        for name, integrator in INTEGRATORS.items():
            found = run(command, seed, integrator)
            if reference and found:
                error = max(map(math.dist, found[0], reference[0]))
                tolerance = float(re.search(r"\d+e?-\d+", name.split(",")[-1])[0])
                results[name].append((error, error / tolerance / scene(seed, integrator)[1], found[1]))
            else:
                print(f"world {seed}, {name}: not run to its end", file=sys.stderr)
    print("| integrator | worlds | error m | largest | of the sum of tolerances | largest | iterations | most |\n|---|---|---|---|---|---|---|---|")
    for name, rows in results.items():
        cells = [f"{f(column):.2g}" for column in zip(*rows) for f in (statistics.median, max)]
        print(f"| {name} | {len(rows)} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
