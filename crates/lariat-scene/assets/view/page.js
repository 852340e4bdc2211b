// Controls: the slider, play and pause, the mouse, the colours of the page.

const element = (id) => document.getElementById(id);
const canvas = element("scene"), pen = canvas.getContext("2d"), slider = element("slider");
// Warnings above the picture.
const LINES = 3;
let current = 0, playing = false, clock = 0, before = 0;

const figure = (x, digits = 4) => (x === null || x === undefined ? "not finite" : +x === 0 ? "0" : String(+Number(x).toPrecision(digits)));

// The static equilibrium of a cable in words.
function equilibrium(c) {
  const sag = c.sag_m === null ? "" : `, sag ${figure(c.sag_m)} m`;
  const stable = c.stable ? "stable" : "unstable or indifferent";
  return `${stable}, peak tension ${figure(c.peak_tension_n)} N${sag}, residual ${figure(c.residual_n, 2)} N`;
}

function fillHeader() {
  element("name").textContent = data.name;
  const s = data.summary, effects = Object.entries(s.effect_evaluations || {}).map(([k, v]) => `${k} ${v}`);
  const rows = s.statics
    ? [["CPU", `${figure(s.cpu_s)} s`], ["energy", `${figure(s.energy_end_j, 6)} J`], ...s.statics.map((c) => [c.name, equilibrium(c)])]
    : [["simulated", `${figure(s.simulated_s, 6)} s`]];
  // what a program stepped itself has no summary of its steps
  if (!s.statics && s.steps !== undefined) {
    rows.push(
      ["CPU", `${figure(s.cpu_s)} s`], ["real time factor", figure(s.real_time_factor)],
      ["steps", `${s.steps} (${s.rejected_steps} rejected)`], ["Newton iterations", s.newton_iterations],
      ["energy", `${figure(s.energy_start_j, 6)} → ${figure(s.energy_end_j, 6)} J`], ["largest gap", `${figure(s.max_gap_m, 3)} m`],
    );
  }
  if (effects.length) rows.push(["effects", effects.join(", ")]);
  for (const [name, value] of rows) {
    const row = document.createElement("div"), dt = document.createElement("dt"), dd = document.createElement("dd");
    dt.textContent = name;
    dd.textContent = value;
    row.append(dt, dd);
    element("summary").append(row);
  }
  const say = (text, kind, to = element("words")) => {
    const p = document.createElement("p");
    p.textContent = p.title = text;
    if (kind) p.className = kind;
    to.append(p);
  };
  if (s.failed) say(`failed: ${s.failed}`, "failed");
  if (frames.length === 0) say("nothing was sampled", "failed");
  s.told.slice(0, LINES).forEach((text) => say(`warning: ${text}`, "line"));
  fillDetails(s, say);
}

// All warnings in full: what is told, then what each of them is about and follows from.
function fillDetails(s, say) {
  if (s.warnings.length === 0) return;
  const details = document.createElement("details"), head = document.createElement("summary");
  const more = s.told.length - LINES;
  head.textContent = more > 0 ? `${more} more, and all ${s.warnings.length} warnings in full` : `all ${s.warnings.length} warnings in full`;
  details.append(head);
  s.told.forEach((text) => say(text, "told", details));
  s.warnings.forEach((w) => say(`${w.level}${w.explained_by ? `, follows from ${w.explained_by}` : ""}: ${w.text}`, "", details));
  element("words").append(details);
}

function fillLegend() {
  const g = element("scale").getContext("2d");
  for (let i = 0; i < 160; i++) {
    g.fillStyle = colour(lowest + ((highest - lowest) * (i + 0.5)) / 160);
    g.fillRect(i, 0, 1, 10);
  }
  for (const x of [lowest, 0.5 * (lowest + highest), highest]) {
    const end = document.createElement("span");
    end.textContent = figure(x, 3);
    element("ends").append(end);
  }
}

// Least and largest tension now, and the width of a cell of the grid.
function fillKey() {
  let low = Infinity, high = -Infinity;
  for (const [first, nodes] of frames[current].cables) {
    for (let i = 0; i < nodes; i++) {
      low = Math.min(low, numbers[first + NODE * i + 7]);
      high = Math.max(high, numbers[first + NODE * i + 7]);
    }
  }
  // rounding errors of a slack cable are not shown as tension
  const tidy = (x) => figure(Math.abs(x) < 1e-9 * Math.max(-lowest, highest) ? 0 : x, 4);
  element("key").textContent = `now ${tidy(low)} to ${tidy(high)} N\ngrid ${figure(cell)} m`;
}

function show() {
  const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
  const [w, h] = [Math.max(1, Math.round(box.width * ratio)), Math.max(1, Math.round(box.height * ratio))];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  const drawn = drawScene(pen, box.width, box.height, frames[current], times[current], element("names").checked);
  const last = times[times.length - 1];
  slider.value = current;
  element("time").textContent = data.summary.statics ? "static equilibrium" : `t = ${times[current].toFixed(3)} s of ${figure(last)} s`;
  fillKey();
  movePlots(times[current]);
  // read by tests
  Object.assign(document.documentElement.dataset, { ready: "true", frames: frames.length, frame: current, drawn: drawn.toPrecision(12) });
}

function goTo(k) {
  current = Math.min(frames.length - 1, Math.max(0, k));
  show();
}

// The last frame that is not after a time.
function frameAt(time) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const half = (low + high + 1) >> 1;
    if (times[half] <= time * (1 + 1e-12)) low = half;
    else high = half - 1;
  }
  return low;
}

function jump(time) {
  setPlaying(false);
  goTo(frameAt(time));
}

function setPlaying(on) {
  playing = on && frames.length > 1;
  element("play").textContent = playing ? "Pause" : "Play";
  document.documentElement.dataset.playing = playing;
  if (!playing) return;
  if (current === frames.length - 1) goTo(0);
  clock = times[current];
  before = performance.now();
  requestAnimationFrame(tick);
}

function tick(now) {
  if (!playing) return;
  clock += Math.max(0, now - before) * 1e-3 * Number(element("speed").value);
  before = now;
  const k = frameAt(clock);
  if (k !== current) goTo(k);
  if (current === frames.length - 1) setPlaying(false);
  else requestAnimationFrame(tick);
}

function resetView() {
  const box = canvas.getBoundingClientRect();
  resetCamera(box.width, box.height);
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  readStyle();
}

function listen() {
  element("play").addEventListener("click", () => setPlaying(!playing));
  slider.addEventListener("input", () => {
    setPlaying(false);
    goTo(Number(slider.value));
  });
  element("names").addEventListener("change", show);
  element("reset").addEventListener("click", () => {
    resetView();
    show();
  });
  element("theme").addEventListener("click", () => {
    setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
    remakePlots(jump, show);
  });
  document.addEventListener("keydown", (event) => {
    if (["INPUT", "SELECT", "BUTTON", "SUMMARY"].includes(event.target.tagName) && event.key !== " ") return;
    if (event.key === " " && event.target.tagName !== "BUTTON" && event.target.tagName !== "SUMMARY") {
      event.preventDefault();
      setPlaying(!playing);
    }
    if (event.key === "ArrowRight" || event.key === "ArrowLeft") {
      setPlaying(false);
      goTo(current + (event.key === "ArrowRight" ? 1 : -1));
    }
  });
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    if (event.shiftKey || event.buttons === 4) {
      const s = camera.distance / camera.focal;
      camera.target = add(add(camera.target, camera.right, -event.movementX * s), camera.above, event.movementY * s);
    } else {
      camera.yaw -= 0.008 * event.movementX;
      camera.pitch = Math.min(1.55, Math.max(-1.55, camera.pitch + 0.008 * event.movementY));
    }
    show();
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.distance = Math.min(100 * size, Math.max(0.02 * size, camera.distance * Math.exp(1e-3 * event.deltaY)));
    show();
  }, { passive: false });
  let wide = canvas.getBoundingClientRect().width;
  new ResizeObserver(() => {
    const box = canvas.getBoundingClientRect();
    if (box.width !== wide) {
      wide = box.width;
      remakePlots(jump, show);
    } else show();
  }).observe(canvas);
}

fillHeader();
if (frames.length > 0) {
  slider.max = frames.length - 1;
  // nothing moves
  document.body.classList.toggle("static", frames.length < 2);
  setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  fillLegend();
  resetView();
  makePlots(jump, show);
  listen();
  show();
} else {
  Object.assign(document.documentElement.dataset, { ready: "true", frames: 0 });
}
