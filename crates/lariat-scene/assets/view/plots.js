// The probes: a fold for each, a plot for each quantity, all with a cursor at the present time.

// By first column: what it is and its unit; a quantity goes on to the next first column.
const QUANTITIES = {
  x: ["position", "m"], vx: ["velocity", "m/s"], sx: ["slope", "1"], tension: ["tension", "N"], curvature: ["curvature", "1/m"],
  moment: ["bending moment", "N m"], qx: ["attitude (quaternion)", "1"], wx: ["angular velocity", "rad/s"], fx: ["force on what holds the cable", "N"],
  mx: ["moment on what holds the cable", "N m"], gap: ["gap", "m"], kinetic: ["energy", "J"], dissipated: ["dissipated, interface work, total", "J"],
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

// A range that a constant does not collapse, nor rounding of a constant fill.
function widen(low, high) {
  if (low === null || !Number.isFinite(low) || !Number.isFinite(high)) return [-1, 1];
  const least = Math.max(1e-9 * Math.max(Math.abs(low), Math.abs(high)), 1e-12), pad = Math.max(0.06 * (high - low), least);
  return [low - pad, high + pad];
}

function fillProbe(fold, probe, jump) {
  for (const group of quantities(probe.columns)) {
    const title = document.createElement("h2");
    title.textContent = `${group.title[0]}, ${group.title[1]}`;
    const place = document.createElement("div");
    fold.append(title, place);
    if (probe.table[0].length > 1) plot(place, probe, group, jump);
    else table(place, probe, group);
  }
}

// One row: numbers say more than a plot of points.
function table(place, probe, group) {
  const body = document.createElement("table");
  for (const c of group.columns) {
    const row = body.insertRow();
    row.insertCell().textContent = probe.columns[c];
    row.insertCell().textContent = probe.table[c].length ? probe.table[c][0].toPrecision(8) : "no sample";
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

// Plots have their colours and sizes from when they were made.
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
