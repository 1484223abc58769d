// Meshes as `src/output/report/encode.rs` packs them.

const packedMeshes = JSON.parse(byId("mesh-data").textContent);
const NO_VALUE = 65535;
const NO_CORNER = 0xffffffff;
const decoded = new Map();

const hasMesh = (design) => design.id in packedMeshes;

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i += 1) bytes[i] = text.charCodeAt(i);
  return bytes;
}
/** Little-endian, whatever the machine. */
function sixteenBits(base64) {
  const bytes = bytesOf(base64);
  return Uint16Array.from({ length: bytes.length / 2 }, (_, i) => bytes[2 * i] | (bytes[2 * i + 1] << 8));
}

function decodePositions({ vertices, low, step, positions }) {
  const steps = sixteenBits(positions);
  const out = new Float32Array(3 * vertices);
  for (let v = 0; v < vertices; v += 1) {
    for (let axis = 0; axis < 3; axis += 1) out[3 * v + axis] = low[axis] + step[axis] * steps[axis * vertices + v];
  }
  return out;
}

/** Four corners per panel, the last NO_CORNER for a triangle. */
function decodeCorners({ panels, corners }) {
  const bytes = bytesOf(corners);
  const out = new Uint32Array(4 * panels).fill(NO_CORNER);
  const before = [0, 0, 0, 0];
  let at = 0;
  const next = () => {
    let result = 0, shift = 0, byte;
    do { byte = bytes[at++]; result |= (byte & 127) << shift; shift += 7; } while (byte & 128);
    return result >>> 0;
  };
  for (let p = 0; p < panels; p += 1) {
    const count = next();
    for (let c = 0; c < count; c += 1) {
      const zigzag = next();
      before[c] += (zigzag >>> 1) ^ -(zigzag & 1);
      out[4 * p + c] = before[c];
    }
  }
  return out;
}

/** Every edge once as smaller, larger vertex, sorted; and whether it has a panel on one side only. */
function membersOf(corners, vertices) {
  const keys = new Float64Array(corners.length);
  let count = 0;
  for (let p = 0; p < corners.length; p += 4) {
    const sides = corners[p + 3] === NO_CORNER ? 3 : 4;
    for (let c = 0; c < sides; c += 1) {
      const a = corners[p + c], b = corners[p + ((c + 1) % sides)];
      keys[count++] = Math.min(a, b) * vertices + Math.max(a, b);
    }
  }
  const sorted = keys.subarray(0, count).sort();
  const ends = [], boundary = [];
  for (let i = 0; i < count; i += 1) {
    if (i > 0 && sorted[i] === sorted[i - 1]) { boundary[boundary.length - 1] = 0; continue; }
    ends.push(Math.floor(sorted[i] / vertices), sorted[i] % vertices);
    boundary.push(1);
  }
  return { members: Uint32Array.from(ends), boundary: Uint8Array.from(boundary) };
}

function decodeField(packed) {
  if (!packed) return null;
  const steps = sixteenBits(packed.values);
  return Float32Array.from(steps, (s) => (s === NO_VALUE ? NaN : (packed.max * s) / (NO_VALUE - 1)));
}

/** The mesh of a design, or null: {vertices, positions, corners, members, boundary, singular, curvature, skewness, utilisation}. */
function meshOf(design) {
  if (!hasMesh(design)) return null;
  if (!decoded.has(design.id)) {
    const packed = packedMeshes[design.id];
    const corners = decodeCorners(packed);
    decoded.set(design.id, {
      vertices: packed.vertices,
      positions: decodePositions(packed),
      corners,
      ...membersOf(corners, packed.vertices),
      singular: packed.singular,
      curvature: decodeField(packed.curvature),
      skewness: decodeField(packed.skewness),
      utilisation: decodeField(packed.utilisation),
    });
  }
  return decoded.get(design.id);
}
