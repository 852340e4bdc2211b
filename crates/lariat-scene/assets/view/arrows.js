// Loads, and the forces of contacts on cables, as arrows. Loads: forces with one head, moments with two (along their axis, right-handed), forces per length as a row of arrows.
// Each starts at the point on which it acts.

const FORCE_LENGTH = 0.16, ROW_LENGTH = 0.08, CONTACT_LENGTH = 0.1, ROW = 7;
const lengthOf = (v) => Math.hypot(...v);
const largestOf = (key) => Math.max(0, ...data.loads.map((load) => (load[key] ? lengthOf(load[key]) : 0)));
const largestLoad = { force: largestOf("force"), moment: largestOf("moment"), perLength: largestOf("perLength") };

// The factor of a history at a time: linear between rows, constant outside, 1 without rows.
function factorAt(rows, time) {
  if (!rows || !rows.length) return 1;
  const next = rows.findIndex(([t]) => t > time);
  if (next === 0) return rows[0][1];
  if (next < 0) return rows[rows.length - 1][1];
  const [[t, a], [u, b]] = [rows[next - 1], rows[next]];
  return a + ((b - a) * (time - t)) / (u - t);
}

// The arrows at a frame: { from, vector, heads, label }, vector in m of the scene.
function loadArrows(frame, time) {
  const arrows = [];
  const put = (from, load, key, share, length, heads, unit) => {
    const full = lengthOf(load[key]), magnitude = full * Math.abs(share);
    if (magnitude === 0) return;
    // the smallest can still be seen
    const shown = size * length * Math.max(0.2, magnitude / largestLoad[key]);
    const vector = load[key].map((x) => (x / full) * Math.sign(share) * shown);
    arrows.push({ from, vector, heads, label: unit ? `${figure(magnitude, 3)} ${unit}` : "" });
  };
  for (const load of data.loads) {
    if (load.perLength) {
      for (let i = 0; i < ROW; i++) {
        const s = load.from + ((load.to - load.from) * i) / (ROW - 1);
        const unit = i === ROW >> 1 ? "N/m" : "";
        put(onCable(frame, load.cable, s), load, "perLength", 1, ROW_LENGTH, 1, unit);
      }
      continue;
    }
    const share = (load.ramp > 0 ? Math.min(1, Math.max(0, time / load.ramp)) : 1) * factorAt(load.history, time);
    let from;
    if (load.body === undefined) from = onCable(frame, load.cable, load.at);
    else {
      const { place, attitude } = poseOf(frame, load.body);
      from = add(place, turn(attitude, load.point));
    }
    put(from, load, "force", share, FORCE_LENGTH, 1, "N");
    put(from, load, "moment", share, FORCE_LENGTH, 2, "N m");
  }
  return arrows;
}

function contactsOf(frame) {
  const [first, count] = frame.contacts, contacts = [];
  for (let i = 0; i < count; i++) {
    const at = first + CONTACT * i;
    contacts.push({ from: [...numbers.subarray(at, at + 3)], force: [...numbers.subarray(at + 3, at + 6)] });
  }
  return contacts;
}

// The largest force but for single peaks: of 98 in 100 contacts.
const usualContact = (() => {
  const all = frames.flatMap((frame) => contactsOf(frame).map((contact) => lengthOf(contact.force))).sort((a, b) => a - b);
  return all.length ? all[Math.floor(0.98 * (all.length - 1))] : 0;
})();

// The forces of contacts at a frame; only the largest has a label.
function contactArrows(frame) {
  const contacts = contactsOf(frame).filter((contact) => lengthOf(contact.force) > 0);
  const largest = Math.max(0, ...contacts.map((contact) => lengthOf(contact.force)));
  return contacts.map(({ from, force }) => {
    const full = lengthOf(force), shown = size * CONTACT_LENGTH * Math.min(1.5, Math.max(0.1, full / usualContact));
    return { from, vector: force.map((x) => (x / full) * shown), heads: 1, label: full === largest ? `${figure(full, 3)} N` : "", contact: true };
  });
}

function drawArrow(g, { from, vector, heads, label, contact }, names, write) {
  const p = project(from), q = project(add(from, vector));
  if (!p || !q) return;
  const [x, y] = [q[0] - p[0], q[1] - p[1]], n = Math.hypot(x, y);
  g.strokeStyle = g.fillStyle = contact ? style.contact : style.load;
  g.lineWidth = 2;
  if (n < 2) {
    // along the line of sight
    g.beginPath();
    g.arc(p[0], p[1], 4, 0, 7);
    g.stroke();
    return;
  }
  const [u, v] = [x / n, y / n], head = Math.min(11, 0.5 * n);
  g.beginPath();
  g.moveTo(p[0], p[1]);
  g.lineTo(q[0] - 0.8 * head * u, q[1] - 0.8 * head * v);
  g.stroke();
  for (let k = 0; k < heads; k++) {
    const [a, b] = [q[0] - 0.8 * k * head * u, q[1] - 0.8 * k * head * v];
    g.beginPath();
    g.moveTo(a, b);
    g.lineTo(a - head * u - 0.4 * head * v, b - head * v + 0.4 * head * u);
    g.lineTo(a - head * u + 0.4 * head * v, b - head * v - 0.4 * head * u);
    g.closePath();
    g.fill();
  }
  if (names && label) write(label, q);
}
