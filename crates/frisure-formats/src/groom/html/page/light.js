// How much light reaches each place: hair and head as matter in a grid, looked through once in the direction of each lamp.

// Unit vectors to the lamps in the frame of the head (z up, the face towards -y): key, fill, rim; and their light.
const LAMPS = [[0.52, -0.62, 0.59], [-0.83, -0.5, 0.24], [-0.28, 0.8, 0.53]];
const LAMP_LIGHT = [[2.5, 2.35, 2.15], [0.75, 0.85, 1.0], [2.0, 2.0, 2.1]];
// The sky's light, and the directions in which it is sampled.
const SKY = [0.42, 0.44, 0.47];
const SKY_WAYS = [[0, 0, 1], [0.8, 0, 0.6], [-0.8, 0, 0.6], [0, 0.8, 0.6], [0, -0.8, 0.6],
  [0.7, 0.7, 0.1], [-0.7, 0.7, 0.1], [0.7, -0.7, 0.1], [-0.7, -0.7, 0.1], [0, -0.7, -0.7]];
// Cells along the longest side.
const CELLS = 72;
// Optical depth of a cell of the head.
const SOLID = 2;

function box(places, width, into) {
  for (let i = 0; i < places.length; i += width) {
    for (let k = 0; k < 3; k++) {
      into.low[k] = Math.min(into.low[k], places[i + k]);
      into.high[k] = Math.max(into.high[k], places[i + k]);
    }
  }
}

// The grid around hair and head: low corner (m), side of a cell (m), cells along each axis.
function room(groom) {
  const bounds = { low: [1e9, 1e9, 1e9], high: [-1e9, -1e9, -1e9] };
  box(groom.hair.places, 4, bounds);
  const own = { low: [...bounds.low], high: [...bounds.high] };
  if (groom.head) box(groom.head.places, 3, bounds);
  const side = Math.max(...[0, 1, 2].map((k) => bounds.high[k] - bounds.low[k]), 1e-3) / (CELLS - 4);
  const low = bounds.low.map((x) => x - 2 * side);
  const size = [0, 1, 2].map((k) => Math.ceil((bounds.high[k] - low[k]) / side) + 2);
  return { low, side, size, bounds, own };
}

function cell(grid, x, y, z) {
  const at = [x, y, z].map((value, k) => Math.floor((value - grid.low[k]) / grid.side));
  return (at[2] * grid.size[1] + at[1]) * grid.size[0] + at[0];
}

// Number of hairs that light meets within a cell, and whether the head is in it.
function matter(grid, { hair, head }) {
  const count = grid.size[0] * grid.size[1] * grid.size[2];
  const hairs = new Float32Array(count), solid = new Uint8Array(count);
  const { offsets, places } = hair;
  for (let s = 0; s + 1 < offsets.length; s++) {
    for (let i = offsets[s]; i + 1 < offsets[s + 1]; i++) {
      const a = 4 * i, b = a + 4;
      const length = Math.hypot(places[b] - places[a], places[b + 1] - places[a + 1], places[b + 2] - places[a + 2]);
      const parts = 1 + Math.floor(length / grid.side);
      // Light from everywhere sees a part of pi/4 of the side of a thin cylinder.
      const area = Math.PI / 4 * length * (places[a + 3] + places[b + 3]) / (parts * grid.side * grid.side);
      for (let k = 0; k < parts; k++) {
        const t = (k + 0.5) / parts;
        const at = [0, 1, 2].map((n) => places[a + n] + t * (places[b + n] - places[a + n]));
        hairs[cell(grid, ...at)] += area;
      }
    }
  }
  if (head) fillHead(grid, head, solid);
  return { hairs, solid };
}

function fillHead(grid, { places, corners }, solid) {
  for (let f = 0; f < corners.length; f += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * corners[f + k]);
    const edge = (p, q) => Math.hypot(places[q] - places[p], places[q + 1] - places[p + 1], places[q + 2] - places[p + 2]);
    const parts = Math.min(64, 1 + Math.floor(Math.max(edge(a, b), edge(b, c), edge(c, a)) / grid.side));
    for (let i = 0; i <= parts; i++) {
      for (let j = 0; i + j <= parts; j++) {
        const at = [0, 1, 2].map((k) => (i * places[a + k] + j * places[b + k] + (parts - i - j) * places[c + k]) / parts);
        solid[cell(grid, ...at)] = 1;
      }
    }
  }
}

// Hairs met on the way from the middle of a cell; the head counts from the fifth cell on, because roots lie in it and its own
// steps would be seen.
function met(grid, { hairs, solid }, x, y, z, way, stride) {
  const [nx, ny, nz] = grid.size;
  let depth = 0;
  for (let n = 1; ; n++) {
    const at = stride * (n - 0.25);
    const i = Math.round(x + at * way[0]), j = Math.round(y + at * way[1]), k = Math.round(z + at * way[2]);
    if (i < 0 || j < 0 || k < 0 || i >= nx || j >= ny || k >= nz || depth > 8) return depth;
    const index = (k * ny + j) * nx + i;
    depth += stride * (hairs[index] + (at > 4.5 ? SOLID * solid[index] : 0));
  }
}

// The part of each lamp's light, and of the sky's, that meets no hair on the way to each cell, from 0 to 255.
function visibility(grid, inside) {
  const [nx, ny, nz] = grid.size;
  const seen = new Uint8Array(4 * nx * ny * nz);
  const { hairs, solid } = inside;
  const near = new Uint8Array(nx * ny * nz);
  for (let i = 0; i < near.length; i++) {
    if (!hairs[i] && !solid[i]) continue;
    for (const d of [0, 1, -1, nx, -nx, nx * ny, -nx * ny, nx + 1, -nx - 1, nx * ny + nx, -nx * ny - nx, nx * ny + 1, -nx * ny - 1])
      near[i + d] = 1;
  }
  for (let z = 0, index = 0; z < nz; z++) for (let y = 0; y < ny; y++) for (let x = 0; x < nx; x++, index++) {
    if (!near[index]) {
      seen.fill(255, 4 * index, 4 * index + 4);
      continue;
    }
    for (let k = 0; k < 3; k++) seen[4 * index + k] = 255 * Math.exp(-met(grid, inside, x, y, z, LAMPS[k], 1));
    let sky = 0;
    for (const way of SKY_WAYS) sky += Math.exp(-0.6 * met(grid, inside, x, y, z, way, 2));
    seen[4 * index + 3] = 255 * sky / SKY_WAYS.length;
  }
  return seen;
}
