// Bodies as polygons in their own axes: { points, faces }. Large faces are cut into cells so that sorting by depth works.

// A surface of revolution about y from rows [radius, height], bottom to top, closed by its ends.
function revolve(rows, sides) {
  const points = [], faces = [];
  for (const [r, y] of rows) {
    for (let i = 0; i < sides; i++) {
      const a = (2 * Math.PI * i) / sides;
      points.push([r * Math.cos(a), y, r * Math.sin(a)]);
    }
  }
  for (let k = 0; k + 1 < rows.length; k++) {
    for (let i = 0; i < sides; i++) {
      const j = (i + 1) % sides, a = k * sides, b = a + sides;
      faces.push([a + i, b + i, b + j, a + j]);
    }
  }
  const ring = [...Array(sides).keys()], top = (rows.length - 1) * sides;
  if (rows[0][0] > 0) faces.push(ring);
  if (rows[rows.length - 1][0] > 0) faces.push(ring.map((i) => top + i).reverse());
  return { points, faces };
}

function arc(radius, from, to, steps, lift) {
  return [...Array(steps + 1).keys()].map((i) => {
    const a = from + ((to - from) * i) / steps;
    return [Math.max(0, radius * Math.cos(a)), lift + radius * Math.sin(a)];
  });
}

function cuboid(half, cell) {
  const points = [], faces = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      const u = (axis + 1) % 3, v = (axis + 2) % 3;
      const cuts = (h) => Math.min(24, Math.max(1, Math.ceil((2 * h) / cell)));
      const [m, n] = [cuts(half[u]), cuts(half[v])], first = points.length;
      for (let i = 0; i <= m; i++) {
        for (let j = 0; j <= n; j++) {
          const p = [0, 0, 0];
          p[axis] = side * half[axis];
          p[u] = half[u] * ((2 * i) / m - 1);
          p[v] = half[v] * ((2 * j) / n - 1);
          points.push(p);
        }
      }
      const id = (i, j) => first + i * (n + 1) + j;
      for (let i = 0; i < m; i++) {
        for (let j = 0; j < n; j++) {
          const face = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
          // which sides of the cell are edges of the box
          face.edges = [j === 0, i === m - 1, j === n - 1, i === 0];
          faces.push(face);
        }
      }
    }
  }
  return { points, faces };
}

function polygons(body, size) {
  const shape = body.shape, half = Math.PI / 2;
  if (shape.cuboid) return cuboid(shape.cuboid, size / 10);
  if (shape.ball) return revolve(arc(shape.ball, -half, half, 10, 0), 16);
  if (shape.cylinder) {
    const [h, r] = shape.cylinder, cuts = Math.min(24, Math.max(1, Math.ceil((20 * h) / size)));
    return revolve([...Array(cuts + 1).keys()].map((i) => [r, h * ((2 * i) / cuts - 1)]), 20);
  }
  if (shape.capsule) {
    const [h, r] = shape.capsule;
    return revolve([...arc(r, -half, 0, 5, -h), ...arc(r, 0, half, 5, h)], 16);
  }
  if (shape.mesh) {
    const points = [], faces = [];
    for (let i = 0; i < body.vertices.length; i += 3) points.push([...body.vertices.subarray(i, i + 3)]);
    if (body.triangles.length > 3 * MOST_TRIANGLES) return box(points);
    for (let i = 0; i < body.triangles.length; i += 3) faces.push([...body.triangles.subarray(i, i + 3)]);
    // files do not agree on which side is out
    return { points, faces, open: true };
  }
  return { points: [], faces: [] };
}

// More triangles than this take too long to sort: their bounding box is drawn.
const MOST_TRIANGLES = 20000;

function box(points) {
  const low = [0, 1, 2].map((k) => points.reduce((x, p) => Math.min(x, p[k]), Infinity));
  const high = [0, 1, 2].map((k) => points.reduce((x, p) => Math.max(x, p[k]), -Infinity));
  const corner = (i) => [0, 1, 2].map((k) => ((i >> k) & 1 ? high[k] : low[k]));
  const faces = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
  return { points: [...Array(8).keys()].map(corner), faces, open: true };
}
