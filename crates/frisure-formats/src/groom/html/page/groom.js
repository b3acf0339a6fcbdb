// The groom of the page: numbers out of the compressed text. `data.rs` writes what this reads.

// Whole numbers of any sign, each in as many bytes as it needs, 7 bits at a time, the lowest first; the lowest bit is the sign.
class Numbers {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  next() {
    let value = 0, shift = 0, byte;
    do {
      byte = this.bytes[this.at++];
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte > 127);
    return (value >>> 1) ^ -(value & 1);
  }
}

// Colours as displays have them (sRGB, 0 to 255) in linear light, from 0 to 1.
function linear(value) {
  const x = value / 255;
  return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
}

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// One coordinate of all points: the root as its distance from the root before, the others by their second differences.
function coordinate(numbers, offsets, into, axis, low, step) {
  let root = 0;
  for (let s = 0; s + 1 < offsets.length; s++) {
    let value = (root += numbers.next()), slope = 0;
    into[4 * offsets[s] + axis] = low + step * value;
    for (let i = offsets[s] + 1; i < offsets[s + 1]; i++) {
      slope += numbers.next();
      value += slope;
      into[4 * i + axis] = low + step * value;
    }
  }
}

function readStrands(header, numbers) {
  const { strands, points } = header;
  const offsets = new Uint32Array(strands + 1);
  for (let s = 0; s < strands; s++) offsets[s + 1] = offsets[s] + (header.count || numbers.next());
  // Position (m) and half the width (m).
  const places = new Float32Array(4 * points);
  for (let axis = 0; axis < 3; axis++) coordinate(numbers, offsets, places, axis, header.low[axis], header.step);
  for (let i = 0, width = 0; i < points; i++) {
    width += numbers.next();
    places[4 * i + 3] = 0.5 * header.widest * width / 255;
  }
  const colours = readColours(header, numbers, offsets);
  widen(places, strands);
  return { offsets, places, colours };
}

// Makes few thin hairs wider, so that they cover a head as the hairs do that they stand for: the law of frisure's preview, as a
// factor on hairs of 70 um. Hairs that are as wide already, because they were chosen from more, stay as they are.
function widen(places, strands) {
  let sum = 0;
  for (let i = 3; i < places.length; i += 4) sum += 2 * places[i];
  const mean = sum / (places.length / 4);
  const wanted = 70e-6 * Math.min(6, Math.max(1, (100000 / strands) ** 0.7));
  const factor = Math.max(1, wanted / mean);
  // Curves without a width are hairs all the same.
  for (let i = 3; i < places.length; i += 4) places[i] = mean > 0 ? factor * places[i] : 0.5 * wanted;
}

// Colour of each point (sRGB), and a number of its strand.
function readColours(header, numbers, offsets) {
  const colours = new Uint8Array(4 * header.points);
  for (let channel = 0; channel < 3; channel++) {
    let value = 0;
    for (let s = 0; s + 1 < offsets.length; s++) {
      if (header.colours === "strand") value += numbers.next();
      for (let i = offsets[s]; i < offsets[s + 1]; i++) {
        if (header.colours === "point") value += numbers.next();
        colours[4 * i + channel] = header.colours === "one" ? header.colour[channel] : value;
      }
    }
  }
  for (let s = 0, seed = 0; s + 1 < offsets.length; s++) {
    seed = (seed + 0.618033988749895) % 1;
    for (let i = offsets[s]; i < offsets[s + 1]; i++) colours[4 * i + 3] = 255 * seed;
  }
  return colours;
}

function readHead(header, numbers) {
  if (!header.head) return null;
  const { vertices, faces } = header.head;
  const places = new Float32Array(3 * vertices), corners = new Uint32Array(3 * faces);
  for (let axis = 0; axis < 3; axis++) {
    for (let i = 0, value = 0; i < vertices; i++) {
      value += numbers.next();
      places[3 * i + axis] = header.low[axis] + header.step * value;
    }
  }
  for (let i = 0, value = 0; i < corners.length; i++) corners[i] = (value += numbers.next());
  return { places, corners, normals: normals(places, corners) };
}

// Normals of vertices: the sum of those of their faces, by area.
function normals(places, corners) {
  const sums = new Float32Array(places.length);
  for (let f = 0; f < corners.length; f += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * corners[f + k]);
    const u = [0, 1, 2].map((k) => places[b + k] - places[a + k]);
    const v = [0, 1, 2].map((k) => places[c + k] - places[a + k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const at of [a, b, c]) for (let k = 0; k < 3; k++) sums[at + k] += n[k];
  }
  return sums;
}

// Directions along the hair at each point, from -127 to 127; the fourth number says whether it goes on to the next point.
function tangents({ offsets, places }) {
  const all = new Int8Array(places.length);
  for (let s = 0; s + 1 < offsets.length; s++) {
    const first = offsets[s], last = offsets[s + 1] - 1;
    for (let i = first; i <= last; i++) {
      const a = 4 * Math.max(i - 1, first), b = 4 * Math.min(i + 1, last);
      const d = [0, 1, 2].map((k) => places[b + k] - places[a + k]);
      const scale = 127 / (Math.hypot(...d) || 1);
      for (let k = 0; k < 3; k++) all[4 * i + k] = Math.round(scale * d[k]);
      all[4 * i + 3] = i < last ? 127 : 0;
    }
  }
  return all;
}

async function readGroom() {
  const header = JSON.parse(document.getElementById("header").textContent);
  const numbers = new Numbers(await inflated(document.getElementById("data").textContent));
  const hair = readStrands(header, numbers);
  const head = readHead(header, numbers);
  if (numbers.at !== numbers.bytes.length) throw new Error("the data of the page are incomplete");
  return { header, hair, head, tangents: tangents(hair) };
}
