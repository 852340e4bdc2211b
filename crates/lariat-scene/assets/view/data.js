// The results in the page, as typed arrays. Every number here was written by the run.

const data = JSON.parse(document.getElementById("data").textContent);

function bytesOf(text) {
  const raw = atob(text), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

const times = new Float64Array(bytesOf(data.times));
const numbers = new Float32Array(bytesOf(data.frames));

// A node of a cable: arc length, position, slope, tension there and half-way to the next node.
const NODE = 9;
// A stripe at a node: direction across the cable, twist per length.
const STRIPE = 4;
// A contact: place on the cable, force on the cable.
const CONTACT = 6;

// frames[k] = { cables: [first number, nodes, cable, first number of its stripe] of each part of a cable, bodies: first number,
// contacts: [first number, contacts] }
const frames = [];
for (let k = 0, at = 0; k < times.length; k++) {
  const frame = { cables: [], bodies: 0, contacts: [0, 0] };
  const parts = numbers[at++];
  for (let c = 0; c < parts; c++) {
    const nodes = numbers[at + 1];
    frame.cables.push([at + 2, nodes, numbers[at]]);
    at += 2 + NODE * nodes;
  }
  frame.bodies = at;
  at += 7 * data.bodies.length;
  if (data.contacts) {
    frame.contacts = [at + 1, numbers[at]];
    at += 1 + CONTACT * numbers[at];
  }
  if (data.stripes) {
    for (const part of frame.cables) {
      part.push(at);
      at += STRIPE * part[1];
    }
  }
  frames.push(frame);
}

for (const probe of data.probes) {
  const rows = new Float64Array(bytesOf(probe.rows)), n = probe.columns.length;
  probe.table = probe.columns.map((_, c) => {
    const column = new Array(rows.length / n);
    for (let r = 0; r < column.length; r++) column[r] = rows[r * n + c];
    return column;
  });
}
for (const body of data.bodies) {
  if (body.shape.mesh) {
    body.vertices = new Float32Array(bytesOf(body.shape.mesh[0]));
    body.triangles = new Uint32Array(bytesOf(body.shape.mesh[1]));
  }
}

// The cubic of an element between nodes a and b (places in `numbers`) at a share x of its length: position.
function onElement(a, b, x) {
  const h = numbers[b] - numbers[a], y = 1 - x;
  const p = y * y * (1 + 2 * x), q = x * x * (3 - 2 * x), s = h * x * y * y, t = -h * x * x * y;
  const at = (i) => p * numbers[a + i] + q * numbers[b + i] + s * numbers[a + 3 + i] + t * numbers[b + 3 + i];
  return [at(1), at(2), at(3)];
}

// The first part of a cable in a frame, if it is there.
const partOf = (frame, cable) => (frame.cables[cable]?.[2] === cable ? frame.cables[cable] : frame.cables.find((part) => part[2] === cable));

// The point of a cable at an arc length; a break belongs to the part before it.
function onCable(frame, cable, s) {
  let [first, nodes] = partOf(frame, cable);
  for (const [start, count, of] of frame.cables) {
    if (of === cable && numbers[start] < s - 1e-5 * Math.abs(s) && numbers[start] > numbers[first]) [first, nodes] = [start, count];
  }
  for (let i = 0; i + 1 < nodes; i++) {
    const a = first + NODE * i, b = a + NODE;
    if (s <= numbers[b] || i + 2 === nodes) {
      const h = numbers[b] - numbers[a];
      return onElement(a, b, h > 0 ? Math.min(1, Math.max(0, (s - numbers[a]) / h)) : 0);
    }
  }
  return [numbers[first + 1], numbers[first + 2], numbers[first + 3]];
}

function turn(q, v) {
  const [x, y, z, w] = q, [a, b, c] = v;
  const u = 2 * (y * c - z * b), s = 2 * (z * a - x * c), t = 2 * (x * b - y * a);
  return [a + w * u + y * t - z * s, b + w * s + z * u - x * t, c + w * t + x * s - y * u];
}

function poseOf(frame, i) {
  const at = frame.bodies + 7 * i;
  return { place: [...numbers.subarray(at, at + 3)], attitude: [...numbers.subarray(at + 3, at + 7)] };
}

// From the least to the largest tension of 98 in 100 readings: single peaks would leave all else in one colour.
function tensionRange() {
  const all = [];
  const stride = Math.max(1, Math.floor(numbers.length / (NODE * 200000)));
  for (let k = 0; k < frames.length; k += 1) {
    for (const [first, nodes] of frames[k].cables) {
      for (let i = k % stride; i < nodes; i += stride) all.push(numbers[first + NODE * i + 7]);
    }
  }
  const sorted = Float32Array.from(all.filter(Number.isFinite)).sort();
  if (sorted.length === 0) return [0, 1];
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  let [low, high] = [at(0.01), at(0.99)];
  const least = 1e-3 * Math.max(Math.abs(low), Math.abs(high), 1e-6);
  if (high - low < least) [low, high] = [low - least, high + least];
  return [low, high];
}
