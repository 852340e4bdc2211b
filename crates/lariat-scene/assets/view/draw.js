// The scene at a frame, on a plain 2D canvas: faces and pieces of cables, sorted by depth, farthest first.

const STOPS = [[91, 75, 219], [166, 63, 176], [217, 72, 110], [239, 125, 60], [232, 180, 34]];
const [lowest, highest] = tensionRange();

function colour(tension) {
  const x = Math.min(1, Math.max(0, (tension - lowest) / (highest - lowest))) * (STOPS.length - 1);
  const i = Math.min(STOPS.length - 2, Math.floor(x)), f = x - i;
  return `rgb(${STOPS[i].map((c, k) => Math.round(c + f * (STOPS[i + 1][k] - c))).join(",")})`;
}

const solids = data.bodies.map((body) => polygons(body, size));
let style = {};

function readStyle() {
  const all = getComputedStyle(document.documentElement);
  for (const name of ["paper", "ink", "soft", "grid", "accent", "load", "contact", "dynamic", "fixed", "kinematic"]) {
    style[name] = all.getPropertyValue("--" + name).trim();
  }
}

function shaded(hex, light) {
  const n = parseInt(hex.slice(1), 16), part = (k) => Math.round(((n >> k) & 255) * light);
  return `rgb(${part(16)},${part(8)},${part(0)})`;
}

function line(g, a, b) {
  const p = project(a), q = project(b);
  if (p && q) {
    g.moveTo(p[0], p[1]);
    g.lineTo(q[0], q[1]);
  }
}

function drawGround(g) {
  const [a, b] = level;
  const [a0, a1] = gridSpan(a), [b0, b1] = gridSpan(b);
  const at = (i, j) => {
    const p = [0, 0, 0];
    p[a] = i * cell;
    p[b] = j * cell;
    p[upAxis] = ground;
    return p;
  };
  g.beginPath();
  for (let i = a0; i <= a1; i++) line(g, at(i, b0), at(i, b1));
  for (let j = b0; j <= b1; j++) line(g, at(a0, j), at(a1, j));
  g.strokeStyle = style.grid;
  g.lineWidth = 1;
  g.stroke();
  // numbers along the two sides that are nearest
  g.fillStyle = style.soft;
  g.font = "11px system-ui, 'DejaVu Sans', sans-serif";
  g.textAlign = "center";
  g.textBaseline = "middle";
  const near = (i, j) => dot(camera.back, at(i, j));
  const j = near(a0, b1) > near(a0, b0) ? b1 : b0, out = j === b1 ? 0.45 : -0.45;
  const digits = Math.max(0, -Math.floor(Math.log10(cell) + 1e-9));
  const text = (x, p) => {
    const q = project(p);
    if (q) g.fillText(x, q[0], q[1]);
  };
  const every = Math.max(1, Math.ceil((a1 - a0) / 12));
  for (let i = a0; i <= a1; i += every) text((i * cell).toFixed(digits), at(i, j + out));
  text("xyz"[a] + ", m", at(0.5 * (a0 + a1), j + 2.4 * out));
  const i = near(a1, b0) > near(a0, b0) ? a1 : a0, side = i === a1 ? 0.5 : -0.5;
  for (let k = b0; k <= b1; k += Math.max(1, Math.ceil((b1 - b0) / 12))) {
    if (k !== j) text((k * cell).toFixed(digits), at(i + side, k));
  }
  text("xyz"[b] + ", m", at(i + 2.6 * side, 0.5 * (b0 + b1)));
}

// A half space that is not level: a square of lines in its surface.
function drawSlope(g, place, normal) {
  const u = unit(cross(normal, Math.abs(normal[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0])), v = cross(normal, u);
  const origin = add(middle, normal, dot(add(place, middle, -1), normal));
  g.beginPath();
  for (let i = -8; i <= 8; i++) {
    const p = (s, t) => add(add(origin, u, s * cell), v, t * cell);
    line(g, p(i, -8), p(i, 8));
    line(g, p(-8, i), p(8, i));
  }
  g.strokeStyle = style.fixed;
  g.lineWidth = 1;
  g.stroke();
}

const LIGHT = unit(add([0.35, 0.35, 0.6], UP, 0.9));

function bodyItems(items, frame) {
  data.bodies.forEach((body, i) => {
    const { place, attitude } = poseOf(frame, i), solid = solids[i];
    const points = solid.points.map((p) => add(place, turn(attitude, p)));
    const seen = points.map(project);
    for (const face of solid.faces) {
      const flat = face.map((k) => seen[k]);
      if (flat.some((p) => !p)) continue;
      const [a, b, c] = [0, 1, 2].map((k) => points[face[k]]);
      let normal = unit(cross(add(b, a, -1), add(c, a, -1)));
      const centre = face.reduce((sum, k) => add(sum, points[k], 1 / face.length), [0, 0, 0]);
      const outward = solid.open ? add(camera.eye, centre, -1) : add(centre, place, -1);
      if (dot(normal, outward) < 0) normal = normal.map((x) => -x);
      if (!solid.open && dot(normal, add(camera.eye, centre, -1)) <= 0) continue;
      const fill = shaded(style[body.kind], 0.72 + 0.33 * Math.max(0, dot(normal, LIGHT)));
      const depth = Math.hypot(...add(centre, camera.eye, -1));
      items.push({ depth, draw: (g) => drawFace(g, flat, fill, face.edges || (solid.open ? null : [])) });
    }
  });
}

function drawFace(g, flat, fill, edges) {
  g.beginPath();
  flat.forEach((p, k) => (k ? g.lineTo(p[0], p[1]) : g.moveTo(p[0], p[1])));
  g.closePath();
  g.fillStyle = g.strokeStyle = fill;
  g.lineWidth = 0.8;
  g.fill();
  g.stroke();
  if (!edges) return;
  g.beginPath();
  edges.forEach((on, k) => {
    if (on) {
      const p = flat[k], q = flat[(k + 1) % flat.length];
      g.moveTo(p[0], p[1]);
      g.lineTo(q[0], q[1]);
    }
  });
  g.strokeStyle = style.soft;
  g.lineWidth = 1;
  g.stroke();
}

// Pixels at a depth.
function cableWidth(cable, depth) {
  return Math.max(data.stripes ? 5 : 2.5, cable.diameter ? (camera.focal * cable.diameter) / depth : 0);
}

function cableItems(items, frame) {
  frame.cables.forEach(([first, nodes, c]) => {
    const cable = data.cables[c];
    // smooth at 100 pieces and more per cable
    const pieces = Math.max(2, Math.min(16, Math.ceil(160 / nodes)));
    for (let i = 0; i + 1 < nodes; i++) {
      const a = first + NODE * i, b = a + NODE;
      let p = project(onElement(a, b, 0));
      for (let k = 1; k <= pieces; k++) {
        const x = (k - 0.5) / pieces, q = project(onElement(a, b, k / pieces));
        const [from, to, share] = x < 0.5 ? [numbers[a + 7], numbers[a + 8], 2 * x] : [numbers[a + 8], numbers[b + 7], 2 * x - 1];
        if (p && q) {
          const [s, t] = [p, q], tension = from + share * (to - from);
          const width = cableWidth(cable, s[2]);
          // a hair nearer than the face that it may lie on
          items.push({ depth: 0.5 * (s[2] + t[2]) - 1e-3 * size, draw: (g) => drawPiece(g, s, t, width, colour(tension)) });
        }
        p = q;
      }
    }
  });
}

function drawPiece(g, s, t, width, stroke) {
  g.beginPath();
  g.moveTo(s[0], s[1]);
  g.lineTo(t[0], t[1]);
  g.strokeStyle = stroke;
  g.lineWidth = width;
  g.lineCap = "round";
  g.stroke();
}

function drawMarks(g, frame, time, names) {
  const label = (text, p) => {
    g.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    g.textAlign = "left";
    g.lineWidth = 3;
    g.strokeStyle = style.paper;
    g.strokeText(text, p[0] + 8, p[1] - 8);
    g.fillStyle = style.ink;
    g.fillText(text, p[0] + 8, p[1] - 8);
  };
  for (const arrow of [...loadArrows(frame, time), ...contactArrows(frame)]) drawArrow(g, arrow, names, label);
  for (const hold of data.attachments) {
    const p = project(onCable(frame, hold.cable, hold.at));
    if (!p) continue;
    g.beginPath();
    if (hold.world) g.rect(p[0] - 3.5, p[1] - 3.5, 7, 7);
    else g.arc(p[0], p[1], 3.5, 0, 7);
    g.fillStyle = hold.clamp ? style.ink : style.paper;
    g.strokeStyle = style.ink;
    g.lineWidth = 1.5;
    g.fill();
    g.stroke();
  }
  for (const part of data.sheaves) {
    const [first] = frame.cables[part];
    const p = project([...numbers.subarray(first + 1, first + 4)]);
    if (!p) continue;
    g.beginPath();
    g.arc(p[0], p[1], 5.5, 0, 7);
    g.strokeStyle = style.ink;
    g.lineWidth = 1.5;
    g.stroke();
  }
  for (const tie of data.junctions) {
    const p = project(onCable(frame, tie.cable, tie.at));
    if (!p) continue;
    g.beginPath();
    g.arc(p[0], p[1], 2.5, 0, 7);
    g.fillStyle = style.ink;
    g.fill();
  }
  data.bodies.forEach((body, i) => {
    const p = project(poseOf(frame, i).place);
    if (!p || body.shape.plane) return;
    if (solids[i].faces.length === 0) {
      g.beginPath();
      g.moveTo(p[0] - 6, p[1]);
      g.lineTo(p[0] + 6, p[1]);
      g.moveTo(p[0], p[1] - 6);
      g.lineTo(p[0], p[1] + 6);
      g.strokeStyle = style[body.kind];
      g.lineWidth = 2.5;
      g.stroke();
    }
    if (names) label(body.name, p);
  });
  if (names) {
    data.cables.forEach((cable, c) => {
      const part = partOf(frame, c);
      if (!part) return;
      const [first, nodes] = part;
      const p = project(onCable(frame, c, 0.5 * (numbers[first] + numbers[first + NODE * (nodes - 1)])));
      if (p) label(cable.name, p);
    });
  }
}

// Draws a frame at its time; returns a number that depends on all that was drawn of cables and bodies.
function drawScene(g, width, height, frame, time, names) {
  aim(width, height);
  g.fillStyle = style.paper;
  g.fillRect(0, 0, width, height);
  drawGround(g);
  data.bodies.forEach((body, i) => {
    if (body.shape.plane) {
      const { place, attitude } = poseOf(frame, i), normal = turn(attitude, body.shape.plane);
      if (Math.abs(normal[upAxis]) <= 0.9999) drawSlope(g, place, normal);
    }
  });
  const items = [];
  bodyItems(items, frame);
  cableItems(items, frame);
  stripeItems(items, frame);
  items.sort((a, b) => b.depth - a.depth);
  for (const item of items) item.draw(g);
  drawMarks(g, frame, time, names);
  return items.reduce((sum, item) => sum + item.depth, 0);
}
