// The line along a cable with torsion, by which its twist is seen: painted on the untwisted cable.

// A vector across a unit tangent, turned about it by an angle.
function turnedAbout(t, v, angle) {
  const flat = unit(add(v, t, -dot(v, t)));
  return add(flat.map((x) => x * Math.cos(angle)), cross(t, flat), Math.sin(angle));
}

function stripeItems(items, frame) {
  if (!data.stripes) return;
  for (const [first, nodes, c, painted] of frame.cables) {
    for (let i = 0; i + 1 < nodes; i++) {
      const a = first + NODE * i, b = a + NODE, at = painted + STRIPE * i;
      const from = [...numbers.subarray(at, at + 3)], rate = numbers[at + 3], h = numbers[b] - numbers[a];
      // beside two clamps the spin is not known
      if (dot(from, from) < 0.5) continue;
      const pieces = Math.max(2, Math.min(64, Math.ceil(Math.max(160 / nodes, Math.abs(rate * h) / 0.3))));
      let before = null;
      for (let k = 0; k <= pieces; k++) {
        const x = k / pieces, p = onElement(a, b, x), seen = project(p);
        const step = 0.5 / pieces, along = unit(add(onElement(a, b, x + step), onElement(a, b, x - step), -1));
        const out = turnedAbout(along, from, rate * h * x), width = seen ? cableWidth(data.cables[c], seen[2]) : 0;
        const on = seen ? project(add(p, out, (0.5 * width * seen[2]) / camera.focal)) : null;
        const visible = on && dot(out, add(camera.eye, p, -1)) > 0 ? on : null;
        if (before && visible) {
          const [s, t] = [before, visible];
          // nearer than the piece of the cable that it is on
          items.push({ depth: 0.5 * (s[2] + t[2]) - 2e-3 * size, draw: (g) => drawPiece(g, s, t, Math.max(1, 0.22 * width), style.ink) });
        }
        before = visible;
      }
    }
  }
}
