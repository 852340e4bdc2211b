// The probes: a section for each, a plot for each quantity, all with a cursor at the present time.

// Quantity and unit by first column; the next columns belong to it up to the next first column.
const QUANTITIES = {
  x: ["position", "m"], vx: ["velocity", "m/s"], sx: ["slope", "1"], tension: ["tension", "N"], tension_uncertainty: ["uncertainty of the tension", "N"], curvature: ["curvature", "1/m"],
  moment: ["bending moment", "N m"], qx: ["rotation (quaternion)", "1"], wx: ["angular velocity", "rad/s"], fx: ["force on what holds the cable", "N"],
  mx: ["moment on what holds the cable", "N m"], gap: ["gap", "m"], kinetic: ["energy", "J"], dissipated: ["dissipated, interface work, total", "J"],
  length_out: ["length out", "m"], passed: ["length that ran over it", "m"], rate: ["rate", "m/s"], force: ["force of the drive", "N"], work: ["work of the drive", "J"],
  from_tension: ["tension before, tension after, friction", "N"], lost: ["energy lost to friction", "J"],
  torque: ["torque", "N m"], twist: ["twist", "rad"], twist_rate: ["twist per length", "rad/m"], energy: ["energy of torsion", "J"], torsion: ["energy of torsion", "J"],
  px: ["momentum", "kg m/s"], lx: ["angular momentum about the origin", "kg m²/s"],
};
const INKS = ["#3b82c4", "#e07b39", "#3d9a5f", "#a05fb4"];

function quantities(columns) {
  const groups = [];
  columns.forEach((name, c) => {
    if (c === 0) return;
    if (QUANTITIES[name] || groups.length === 0) groups.push({ title: QUANTITIES[name] || [name, ""], columns: [] });
    groups[groups.length - 1].columns.push(c);
  });
  return groups;
}

const shown = [];

// Sizes that the values of a probe are compared with, by unit: a curve that stays within rounding of them is constant. Bodies are
// in single precision.
function scalesOf(probe) {
  const largest = (names) => {
    const columns = probe.columns.map((name, c) => (names.includes(name) ? probe.table[c] : [])).flat();
    return columns.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
  };
  const duration = times[times.length - 1] || 1, tension = Math.max(Math.abs(lowest), Math.abs(highest));
  return {
    position: size, gap: 1e-3 * size, velocity: size / duration, slope: 1, "rotation (quaternion)": 1, "angular velocity": 1 / duration, tension,
    "uncertainty of the tension": tension,
    curvature: 1 / size, "bending moment": 1e-3 * tension * size, "force on what holds the cable": tension,
    "moment on what holds the cable": Math.max(tension, largest(["fx", "fy", "fz"])) * size,
    energy: largest(probe.columns.slice(1)), "dissipated, interface work, total": largest(probe.columns.slice(1)),
    momentum: largest(["lx", "ly", "lz"]) / size, "angular momentum about the origin": largest(["px", "py", "pz"]) * size,
  };
}

// The columns of a group that change, and those that are constant but for rounding, with their value.
function sorted(probe, group, scales) {
  const roundings = data.bodies.length ? 1e-6 : 1e-9, changing = [], constant = [];
  const extremes = group.columns.map((c) => probe.table[c].reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]));
  const scale = Math.max(scales[group.title[0]] || 0, ...extremes.flat().map((x) => (Number.isFinite(x) ? Math.abs(x) : 0)));
  group.columns.forEach((c, k) => {
    const [low, high] = extremes[k], rounding = roundings * scale;
    if (!(high - low <= rounding)) changing.push(c);
    else constant.push([probe.columns[c], Math.max(Math.abs(low), Math.abs(high)) <= rounding ? 0 : 0.5 * (low + high)]);
  });
  return { changing, constant };
}

function plot(place, probe, group, jump) {
  const inks = getComputedStyle(document.documentElement), ink = (name) => inks.getPropertyValue("--" + name).trim();
  const axis = { stroke: ink("soft"), grid: { stroke: ink("line"), width: 1 }, ticks: { stroke: ink("line"), width: 1 }, font: "11px system-ui, sans-serif" };
  const brief = (u, values) => values.map((v) => (v === 0 ? "0" : Math.abs(v) < 1e-3 || Math.abs(v) >= 1e5 ? v.toExponential(1) : String(+v.toPrecision(6))));
  const chart = new uPlot(
    {
      width: Math.max(240, place.clientWidth),
      height: 150,
      scales: { x: { time: false }, y: { range: (u, low, high) => widen(low, high) } },
      axes: [{ ...axis, size: 28 }, { ...axis, size: 66, values: brief }],
      series: [
        { label: "t, s" },
        ...group.columns.map((c, k) => ({
          label: probe.columns[c], stroke: INKS[k % INKS.length], width: 1.5, points: { show: probe.table[0].length < 3 },
          value: (u, v) => (v === null || v === undefined ? "" : v.toPrecision(6)),
        })),
      ],
      pxAlign: 0,
      legend: { live: true },
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
    },
    [probe.table[0], ...group.columns.map((c) => probe.table[c])],
    place,
  );
  const now = document.createElement("div");
  now.className = "now";
  chart.over.appendChild(now);
  chart.over.addEventListener("click", (event) => jump(chart.posToVal(event.offsetX, "x")));
  shown.push({ chart, now, rows: probe.table[0], place });
}

// The range of the vertical axis, never empty.
function widen(low, high) {
  if (low === null || !Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
  const least = Math.max(1e-9 * Math.max(Math.abs(low), Math.abs(high)), 1e-12), pad = Math.max(0.06 * (high - low), least);
  return [low - pad, high + pad];
}

function say(place, text) {
  const p = document.createElement("p");
  p.className = "constant";
  p.textContent = text;
  place.append(p);
}

function fillProbe(fold, probe, jump) {
  const scales = scalesOf(probe);
  for (const group of quantities(probe.columns)) {
    const title = document.createElement("h2");
    title.textContent = `${group.title[0]}, ${group.title[1]}`;
    const place = document.createElement("div");
    fold.append(title, place);
    const { changing, constant } = sorted(probe, group, scales);
    if (probe.table[0].length < 2) table(place, probe, group, constant);
    else {
      if (changing.length) plot(place, probe, { ...group, columns: changing }, jump);
      if (constant.length) say(place, `constant: ${constant.map(([name, x]) => `${name} = ${figure(x, 6)}`).join(", ")}`);
    }
  }
}

// A single row is shown as numbers.
function table(place, probe, group, constant) {
  const body = document.createElement("table"), values = new Map(constant);
  for (const c of group.columns) {
    const row = body.insertRow(), x = values.get(probe.columns[c]);
    row.insertCell().textContent = probe.columns[c];
    row.insertCell().textContent = probe.table[c].length ? figure(x, 8) : "no sample";
  }
  place.append(body);
}

function makePlots(jump, after) {
  const all = document.getElementById("plots");
  if (data.probes.length === 0) all.textContent = "The scene has no probes.";
  data.probes.forEach((probe, i) => {
    const fold = document.createElement("details"), head = document.createElement("summary"), about = document.createElement("span");
    head.textContent = probe.name + " ";
    about.textContent = probe.about;
    head.append(about);
    fold.append(head);
    fold.addEventListener("toggle", () => {
      if (fold.open && fold.childElementCount === 1) {
        fillProbe(fold, probe, jump);
        after();
      }
    });
    all.append(fold);
    fold.open = i < 2;
  });
}

// Plots keep the colours and sizes with which they were made.
function remakePlots(jump, after) {
  shown.length = 0;
  for (const [i, fold] of [...document.querySelectorAll("#plots details")].entries()) {
    while (fold.childElementCount > 1) fold.lastElementChild.remove();
    if (fold.open) fillProbe(fold, data.probes[i], jump);
  }
  after();
}

function movePlots(time) {
  for (const { chart, now, rows } of shown) {
    now.style.left = `${chart.valToPos(time, "x")}px`;
    let low = 0, high = rows.length - 1;
    while (low < high) {
      const half = (low + high + 1) >> 1;
      if (rows[half] <= time * (1 + 1e-12)) low = half;
      else high = half - 1;
    }
    chart.setLegend({ idx: low }, false);
  }
}
