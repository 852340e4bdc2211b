// A perspective camera that orbits a target, and the box that holds the scene. `up` is the axis against gravity.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => {
  const n = Math.hypot(...a) || 1;
  return [a[0] / n, a[1] / n, a[2] / n];
};

// Axis numbers: up, and two that lie level, right-handed (level0 x level1 = -up sideways enough for a grid).
const upAxis = data.gravity.map(Math.abs).reduce((best, g, i, all) => (g > all[best] + 1e-12 ? i : best), 1);
const upSide = data.gravity[upAxis] > 0 ? -1 : 1;
const level = [0, 1, 2].filter((i) => i !== upAxis);
const UP = [0, 0, 0];
UP[upAxis] = upSide;

// The box of all cables and bodies over all frames; half spaces have no size.
function bounds() {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const take = (p, r) => {
    for (let k = 0; k < 3; k++) {
      if (Number.isFinite(p[k])) {
        low[k] = Math.min(low[k], p[k] - r);
        high[k] = Math.max(high[k], p[k] + r);
      }
    }
  };
  for (const frame of frames) {
    for (const [first, nodes] of frame.cables) {
      for (let i = 0; i < nodes; i++) {
        const at = first + NODE * i;
        take([numbers[at + 1], numbers[at + 2], numbers[at + 3]], 0);
      }
    }
    data.bodies.forEach((body, i) => {
      if (!body.shape.plane) {
        const { place, attitude } = poseOf(frame, i);
        for (const corner of corners(body)) take(add(place, turn(attitude, corner)), 0);
      }
    });
  }
  if (!Number.isFinite(low[0])) return { low: [-1, -1, -1], high: [1, 1, 1] };
  return { low, high };
}

function corners(body) {
  const s = body.shape;
  if (body.vertices) {
    const points = [];
    for (let i = 0; i < body.vertices.length; i += 3) points.push([...body.vertices.subarray(i, i + 3)]);
    return box(points).points;
  }
  let half = [0, 0, 0];
  if (s.cuboid) half = s.cuboid;
  if (s.ball) half = [s.ball, s.ball, s.ball];
  if (s.cylinder) half = [s.cylinder[1], s.cylinder[0], s.cylinder[1]];
  if (s.capsule) half = [s.capsule[1], s.capsule[0] + s.capsule[1], s.capsule[1]];
  return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => half.map((h, k) => ((i >> k) & 1 ? h : -h)));
}

const extent = bounds();
const middle = [0, 1, 2].map((k) => 0.5 * (extent.low[k] + extent.high[k]));
const size = Math.max(1e-6, ...[0, 1, 2].map((k) => extent.high[k] - extent.low[k]));

// A round number near x: 1, 2 or 5 times a power of ten.
function round(x) {
  const power = 10 ** Math.floor(Math.log10(x)), share = x / power;
  return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

const cell = round(size / 8);

// Height of the ground: that of a level half space, or just below everything.
const ground = (() => {
  for (let i = 0; i < data.bodies.length; i++) {
    const normal = data.bodies[i].shape.plane;
    if (normal) {
      const { place, attitude } = poseOf(frames[0], i);
      if (Math.abs(turn(attitude, normal)[upAxis]) > 0.9999) return place[upAxis];
    }
  }
  const below = upSide > 0 ? extent.low[upAxis] : extent.high[upAxis];
  return cell * (upSide > 0 ? Math.floor(below / cell + 1e-3) : Math.ceil(below / cell - 1e-3));
})();

// First and last line of the grid across a level axis.
const gridSpan = (k) => [Math.floor(extent.low[k] / cell - 0.5), Math.ceil(extent.high[k] / cell + 0.5)];

const camera = { yaw: 0, pitch: 0, distance: 1, target: [...middle], focal: 1, centre: [0, 0] };

// Looks along the thinnest level axis, a little from the side and above, at all there is.
function resetCamera(width, height) {
  const [a, b] = level, thin = (k) => extent.high[k] - extent.low[k];
  camera.yaw = (thin(a) < 0.6 * thin(b) ? Math.PI / 2 : 0) + 0.3;
  camera.pitch = 0.2;
  camera.distance = 1;
  // the distance at which every corner of the box and of the grid is in the picture
  const [low, high] = [[...extent.low], [...extent.high]];
  level.forEach((k) => ([low[k], high[k]] = gridSpan(k).map((i) => i * cell)));
  low[upAxis] = Math.min(low[upAxis], ground);
  high[upAxis] = Math.max(high[upAxis], ground);
  camera.target = [0, 1, 2].map((k) => 0.5 * (low[k] + high[k]));
  aim(width, height);
  let far = 0;
  for (let i = 0; i < 8; i++) {
    const p = add([0, 1, 2].map((k) => ((i >> k) & 1 ? high[k] : low[k])), camera.target, -1);
    const x = Math.abs(dot(p, camera.right)) * camera.focal, y = Math.abs(dot(p, camera.above)) * camera.focal;
    const back = dot(p, camera.back);
    far = Math.max(far, back + x / (0.45 * width), back + y / (0.43 * height));
  }
  camera.distance = Math.max(far, 1e-3 * size);
  aim(width, height);
}

function aim(width, height) {
  const [a, b] = level, c = Math.cos(camera.pitch), back = [0, 0, 0];
  back[a] = c * Math.sin(camera.yaw);
  back[b] = c * Math.cos(camera.yaw);
  back[upAxis] = upSide * Math.sin(camera.pitch);
  camera.back = back;
  camera.right = unit(cross(UP, back));
  camera.above = cross(back, camera.right);
  camera.eye = add(camera.target, back, camera.distance);
  camera.focal = 1.5 * Math.min(width, height);
  camera.centre = [0.5 * width, 0.5 * height];
}

// [x, y, depth] in pixels of the canvas and m; null behind the camera.
function project(p) {
  const d = add(p, camera.eye, -1), depth = -dot(d, camera.back);
  if (!(depth > 1e-3 * camera.distance)) return null;
  const s = camera.focal / depth;
  return [camera.centre[0] + s * dot(d, camera.right), camera.centre[1] - s * dot(d, camera.above), depth];
}
