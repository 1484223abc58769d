// Plan pictures, drawn on canvas: the thumbnails, and the picked design where there is no WebGL.

const INK = "#4a5059", PAPER = "#faf9f6", PANEL = "#e4e2dc";
// Singular vertices, as in designs/ID.svg: fewer members than regular, more, pole.
const MARKS = ["#d55e00", "#0072b2", "#000000"];

/** Draws a mesh from above into a canvas of `size` CSS pixels, x to the right, y up. */
function drawPlan(canvas, mesh, size, field) {
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const pixels = Math.round(size * ratio);
  canvas.width = pixels;
  canvas.height = pixels;
  const context = canvas.getContext("2d");
  const at = planScale(mesh, pixels, 4 * ratio);
  const line = Math.max(0.35, Math.min(1.2, size / 420)) * ratio;
  // In a small picture of many panels the lines would hide the colours.
  const spacing = pixels / Math.sqrt(mesh.corners.length / 4) / ratio;
  const faint = Math.round(255 * Math.max(0.28, Math.min(1, spacing / 9))).toString(16).padStart(2, "0");
  if (field && field.on === "panels" && mesh[field.key]) fillPanels(context, mesh, at, field);
  else fillAll(context, mesh, at);
  context.lineJoin = context.lineCap = "round";
  strokeMembers(context, mesh, at, () => true, INK + faint, line * 0.7);
  if (field && field.on === "members" && mesh[field.key]) colourMembers(context, mesh, at, field, line);
  strokeMembers(context, mesh, at, (m) => mesh.boundary[m], INK, line * 1.8);
  for (const [v, kind] of mesh.singular) drawMark(context, at.x(v), at.y(v), Math.max(2.6, size / 55) * ratio, kind);
}

/** A triangle, a square or a diamond. */
function drawMark(context, x, y, r, kind) {
  const corners = [[[0, -1.25], [1.1, 0.75], [-1.1, 0.75]], [[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]], [[0, -1.2], [1.2, 0], [0, 1.2], [-1.2, 0]]][kind];
  context.beginPath();
  for (const [dx, dy] of corners) context.lineTo(x + r * dx, y + r * dy);
  context.closePath();
  context.fillStyle = MARKS[kind];
  context.strokeStyle = "#ffffff";
  context.lineWidth = r * 0.35;
  context.stroke();
  context.fill();
}

function planScale({ positions, vertices }, pixels, margin) {
  let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
  for (let v = 0; v < vertices; v += 1) {
    x0 = Math.min(x0, positions[3 * v]); x1 = Math.max(x1, positions[3 * v]);
    y0 = Math.min(y0, positions[3 * v + 1]); y1 = Math.max(y1, positions[3 * v + 1]);
  }
  const scale = (pixels - 2 * margin) / Math.max(x1 - x0, y1 - y0, 1e-9);
  const mid = pixels / 2, cx = (x0 + x1) / 2, cy = (y0 + y1) / 2;
  return { x: (v) => mid + (positions[3 * v] - cx) * scale, y: (v) => mid - (positions[3 * v + 1] - cy) * scale };
}

function panelPath(context, corners, p, at) {
  context.moveTo(at.x(corners[4 * p]), at.y(corners[4 * p]));
  for (let c = 1; c < 4 && corners[4 * p + c] !== NO_CORNER; c += 1) context.lineTo(at.x(corners[4 * p + c]), at.y(corners[4 * p + c]));
  context.closePath();
}
/** One path a colour: far fewer calls than one a panel. */
function fillPanels(context, mesh, at, field) {
  const groups = d3.group(d3.range(mesh.corners.length / 4), (p) => bin(field, mesh[field.key][p]));
  for (const [b, panels] of groups) {
    context.beginPath();
    for (const p of panels) panelPath(context, mesh.corners, p, at);
    context.fillStyle = b < 0 ? PANEL : field.colours[b];
    context.fill();
  }
}
function fillAll(context, mesh, at) {
  context.beginPath();
  for (let p = 0; p < mesh.corners.length / 4; p += 1) panelPath(context, mesh.corners, p, at);
  context.fillStyle = PANEL;
  context.fill();
}
function strokeMembers(context, { members }, at, which, colour, width) {
  context.beginPath();
  for (let m = 0; m < members.length / 2; m += 1) {
    if (!which(m)) continue;
    context.moveTo(at.x(members[2 * m]), at.y(members[2 * m]));
    context.lineTo(at.x(members[2 * m + 1]), at.y(members[2 * m + 1]));
  }
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}
function colourMembers(context, mesh, at, field, line) {
  const bins = Array.from(mesh[field.key], (v) => bin(field, v));
  for (let b = 0; b < BINS; b += 1) {
    if (!bins.includes(b)) continue;
    strokeMembers(context, mesh, at, (m) => bins[m] === b, field.colours[b], line * (1.6 + (2.2 * b) / BINS));
  }
}
