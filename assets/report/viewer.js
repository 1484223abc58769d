// The picked design in 3D: a small WebGL renderer, and a camera that turns about the vertical axis.

const PANEL_SHADER = {
  vertex: `attribute vec3 position, normal; attribute vec4 colour; uniform mat4 camera; varying vec3 shade;
    void main() { gl_Position = camera * vec4(position, 1.0);
      shade = colour.rgb * (0.84 + 0.16 * abs(dot(normal, normalize(vec3(0.35, -0.5, 0.8))))); }`,
  fragment: "precision mediump float; varying vec3 shade; void main() { gl_FragColor = vec4(shade, 1.0); }",
};
// A member is a flat ribbon of constant width on the screen, drawn a little nearer than the panels it borders.
const MEMBER_SHADER = {
  vertex: `attribute vec3 from, to; attribute vec3 place; attribute vec4 colour; uniform mat4 camera; uniform vec2 screen; varying vec3 shade;
    void main() { vec4 a = camera * vec4(from, 1.0), b = camera * vec4(to, 1.0);
      vec2 along = (b.xy / b.w - a.xy / a.w) * screen; along /= max(length(along), 1e-4);
      vec4 p = mix(a, b, place.x); float w = place.z * 0.5;
      vec2 shift = vec2(-along.y, along.x) * place.y * w + along * (place.x * 2.0 - 1.0) * w * 0.8;
      gl_Position = vec4(p.xy + 2.0 * shift / screen * p.w, p.z - 0.0006 * p.w, p.w); shade = colour.rgb; }`,
  fragment: PANEL_SHADER.fragment,
};
const POINT_SHADER = {
  vertex: `attribute vec3 position; attribute float kind; uniform mat4 camera; uniform float size; varying float shape;
    void main() { shape = kind; gl_Position = camera * vec4(position, 1.0); gl_Position.z -= 0.006 * gl_Position.w; gl_PointSize = size; }`,
  fragment: `precision mediump float; uniform vec3 tints[3]; varying float shape;
    float outside(vec2 p) {
      if (shape < 0.5) return max(abs(p.x) * 0.86 - (p.y + 0.75) * 0.5, p.y - 0.5);
      if (shape < 1.5) return max(abs(p.x), abs(p.y)) - 0.62;
      return abs(p.x) + abs(p.y) - 0.86; }
    void main() { float d = outside((gl_PointCoord - 0.5) * 2.0); if (d > 0.14) discard;
      vec3 tint = shape < 0.5 ? tints[0] : shape < 1.5 ? tints[1] : tints[2];
      gl_FragColor = vec4(d > 0.0 ? vec3(1.0) : tint, 1.0); }`,
};
const VIEWS = { tilted: [-0.62, 0.62], plan: [0, Math.PI / 2], side: [0, 0.06] };
const HOME = "tilted";

const camera = { yaw: VIEWS[HOME][0], pitch: VIEWS[HOME][1], zoom: 1, shift: [0, 0, 0], centre: [0, 0, 0], radius: 1, fit: 1 };
const scene = byId("scene");
let gl = null, programs = null, buffers = {}, counts = {}, shown = null, cameraMatrix = null, drawPending = false;

const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

function startViewer() {
  gl = scene.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
  if (gl) {
    programs = { panels: link(PANEL_SHADER), members: link(MEMBER_SHADER), points: link(POINT_SHADER) };
    gl.enable(gl.DEPTH_TEST);
    listenToHands();
  } else {
    note("This browser offers no WebGL: the design is shown in plan.");
    document.querySelector(".views").hidden = true;
  }
  scene.addEventListener("webglcontextlost", (event) => event.preventDefault());
  scene.addEventListener("webglcontextrestored", () => {
    buffers = {};
    programs = { panels: link(PANEL_SHADER), members: link(MEMBER_SHADER), points: link(POINT_SHADER) };
    gl.enable(gl.DEPTH_TEST);
    showDesign();
  });
  new ResizeObserver(requestDraw).observe(byId("stage"));
  events.on("pick.viewer", showDesign);
  events.on("field.viewer", showDesign);
  showDesign();
}

function note(text) {
  byId("stage-note").textContent = text;
  byId("stage-note").hidden = !text;
}

function link({ vertex, fragment }) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

/** Loads the picked design, keeping the camera's direction so that designs can be compared. */
function showDesign() {
  shown = meshOf(state.picked);
  scene.setAttribute("aria-label", shown
    ? `${nameOf(state.picked)} in 3D, ${plural(shown.corners.length / 4, "panel")}, ${plural(shown.members.length / 2, "member")}. Arrow keys turn it.`
    : `${nameOf(state.picked)}: no picture on this page`);
  if (gl) note(shown ? "" : "No mesh of this design is embedded in the page; its files are in designs/.");
  if (shown && gl) {
    const first = camera.radius === 1;
    frame(shown);
    if (first) setView(HOME);
    uploadPanels(shown);
    uploadMembers(shown);
    upload("points", Float32Array.from(shown.singular.flatMap(([v, kind]) => [...shown.positions.subarray(3 * v, 3 * v + 3), kind])));
    counts.points = shown.singular.length;
  }
  requestDraw();
}

function frame({ positions, vertices }) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < 3 * vertices; i += 1) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  camera.centre = low.map((l, i) => (l + high[i]) / 2);
  camera.radius = Math.max(1e-6, Math.hypot(...high.map((h, i) => h - low[i])) / 2);
}

function upload(name, data) {
  buffers[name] ??= gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffers[name]);
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
}

function uploadPanels(mesh) {
  const { corners, positions } = mesh;
  const field = fieldByKey.get(state.field);
  const values = field?.on === "panels" ? mesh[field.key] : null;
  const plain = rgb(PANEL), palette = field?.colours.map(rgb);
  const out = new Float32Array((corners.length / 4) * 6 * 6);
  const tints = new Uint8Array((corners.length / 4) * 6 * 4);
  let n = 0;
  for (let p = 0; p < corners.length / 4; p += 1) {
    const [a, b, c, d] = corners.subarray(4 * p, 4 * p + 4);
    const quad = d !== NO_CORNER;
    const normal = panelNormal(positions, a, b, c, quad ? d : c);
    const binned = values ? bin(field, values[p]) : -1;
    const tint = binned < 0 ? plain : palette[binned];
    for (const v of quad ? [a, b, c, a, c, d] : [a, b, c]) {
      out.set(positions.subarray(3 * v, 3 * v + 3), 6 * n);
      out.set(normal, 6 * n + 3);
      tints.set([...tint, 255], 4 * n);
      n += 1;
    }
  }
  upload("panels", out.subarray(0, 6 * n));
  upload("panelTints", tints.subarray(0, 4 * n));
  counts.panels = n;
}
/** Unit cross product of the diagonals. */
function panelNormal(positions, a, b, c, d) {
  const u = [0, 1, 2].map((i) => positions[3 * c + i] - positions[3 * a + i]);
  const w = [0, 1, 2].map((i) => positions[3 * d + i] - positions[3 * b + i]);
  return unit(cross(u, w));
}
const cross = (u, w) => [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
const dot = (u, w) => u[0] * w[0] + u[1] * w[1] + u[2] * w[2];
const unit = (u) => { const l = Math.hypot(...u) || 1; return u.map((x) => x / l); };

const RIBBON = [[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]];
function uploadMembers(mesh) {
  const { members, positions, boundary } = mesh;
  const field = fieldByKey.get(state.field);
  const values = field?.on === "members" ? mesh[field.key] : null;
  const ink = rgb(INK), palette = field?.colours.map(rgb);
  const fine = members.length > 16000 ? 0.6 : 0.9;
  const out = new Float32Array((members.length / 2) * 6 * 9);
  const tints = new Uint8Array((members.length / 2) * 6 * 4);
  let n = 0;
  for (let m = 0; m < members.length / 2; m += 1) {
    const from = positions.subarray(3 * members[2 * m], 3 * members[2 * m] + 3);
    const to = positions.subarray(3 * members[2 * m + 1], 3 * members[2 * m + 1] + 3);
    const binned = values ? bin(field, values[m]) : -1;
    const tint = binned < 0 ? ink : palette[binned];
    const width = values && binned >= 0 ? 2.2 + (2.4 * binned) / BINS : boundary[m] ? 2.2 : fine;
    for (const [end, side] of RIBBON) {
      out.set(from, 9 * n); out.set(to, 9 * n + 3); out.set([end, side, width], 9 * n + 6);
      tints.set([...tint, 255], 4 * n);
      n += 1;
    }
  }
  upload("members", out);
  upload("memberTints", tints);
  counts.members = n;
}

function requestDraw() {
  if (drawPending) return;
  drawPending = true;
  requestAnimationFrame(() => { drawPending = false; draw(); });
}

function draw() {
  const { width, height } = byId("stage").getBoundingClientRect();
  if (width < 2) return;
  if (!gl) {
    if (shown) drawPlan(scene, shown, Math.min(width, height), fieldByKey.get(state.field));
    return;
  }
  const ratio = Math.min(2, window.devicePixelRatio || 1);
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (scene.width !== w || scene.height !== h) { scene.width = w; scene.height = h; }
  gl.viewport(0, 0, w, h);
  const paper = rgb(PAPER);
  gl.clearColor(paper[0] / 255, paper[1] / 255, paper[2] / 255, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  if (!shown) return;
  cameraMatrix = cameraOf(w / h);
  run(programs.panels, "panels", "panelTints", [["position", 3, 0], ["normal", 3, 12]], 24, counts.panels, gl.TRIANGLES);
  run(programs.members, "members", "memberTints", [["from", 3, 0], ["to", 3, 12], ["place", 3, 24]], 36, counts.members, gl.TRIANGLES,
    (program) => gl.uniform2f(gl.getUniformLocation(program, "screen"), w / ratio, h / ratio));
  run(programs.points, "points", null, [["position", 3, 0], ["kind", 1, 12]], 16, counts.points, gl.POINTS, (program) => {
    gl.uniform1f(gl.getUniformLocation(program, "size"), 13 * ratio);
    gl.uniform3fv(gl.getUniformLocation(program, "tints"), MARKS.flatMap(rgb).map((c) => c / 255));
  });
}

function run(program, data, tints, attributes, stride, count, mode, uniforms) {
  if (!count) return;
  gl.useProgram(program);
  gl.uniformMatrix4fv(gl.getUniformLocation(program, "camera"), false, cameraMatrix);
  uniforms?.(program);
  const used = [];
  const point = (name, size, type, normalise, step, offset) => {
    const slot = gl.getAttribLocation(program, name);
    gl.enableVertexAttribArray(slot);
    gl.vertexAttribPointer(slot, size, type, normalise, step, offset);
    used.push(slot);
  };
  gl.bindBuffer(gl.ARRAY_BUFFER, buffers[data]);
  for (const [name, size, offset] of attributes) point(name, size, gl.FLOAT, false, stride, offset);
  if (tints) {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers[tints]);
    point("colour", 4, gl.UNSIGNED_BYTE, true, 4, 0);
  }
  gl.drawArrays(mode, 0, count);
  for (const slot of used) gl.disableVertexAttribArray(slot);
}

/** Axes of the camera: right, up, and back towards the eye. */
function cameraAxes() {
  const { yaw, pitch } = camera;
  const back = [Math.sin(yaw) * Math.cos(pitch), -Math.cos(yaw) * Math.cos(pitch), Math.sin(pitch)];
  const right = [Math.cos(yaw), Math.sin(yaw), 0];
  return { right, up: cross(back, right), back };
}
const FIELD_OF_VIEW = 0.42;

/** Brings all of the design into the middle of the window in this direction, as large as it can be. */
function fit(mesh) {
  const { width, height } = byId("stage").getBoundingClientRect();
  camera.fit = 1;
  for (let round = 0; round < 4; round += 1) {
    cameraMatrix = cameraOf(width / Math.max(1, height));
    const screen = project(mesh, { width: 2, height: 2 });
    const [left, right] = d3.extent(d3.range(mesh.vertices), (v) => screen[3 * v] - 1);
    const [top, bottom] = d3.extent(d3.range(mesh.vertices), (v) => screen[3 * v + 1] - 1);
    move(-((left + right) / 4) * (width / height), -(top + bottom) / 4);
    camera.fit *= 1.84 / Math.max(right - left, bottom - top, 1e-6);
  }
}

/** World → clip, column-major: perspective, all of the design in sight at zoom 1 in the view last set. */
function cameraOf(aspect) {
  const { right, up, back } = cameraAxes();
  const focal = 1 / Math.tan(FIELD_OF_VIEW / 2);
  const distance = (camera.radius * focal) / (camera.zoom * camera.fit);
  const target = camera.centre.map((c, i) => c + camera.shift[i]);
  const eye = target.map((t, i) => t + back[i] * distance);
  const near = Math.max(distance - 2.5 * camera.radius - Math.hypot(...camera.shift), distance / 200);
  const far = distance + 2.5 * camera.radius + Math.hypot(...camera.shift);
  const depth = [(far + near) / (near - far), (2 * far * near) / (near - far)];
  const rows = [right.map((x) => (x * focal) / aspect), up.map((x) => x * focal), back.map((x) => x * depth[0]), back.map((x) => -x)];
  const shift = [-dot(rows[0], eye), -dot(rows[1], eye), -dot(rows[2], eye) + depth[1], -dot(rows[3], eye)];
  return Float32Array.from([...[0, 1, 2].flatMap((i) => rows.map((row) => row[i])), ...shift]);
}

function turn(dx, dy) {
  camera.yaw -= dx;
  camera.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, camera.pitch + dy));
  requestDraw();
}
/** Moves the design by a share of the window's height. */
function move(dx, dy) {
  const { right, up } = cameraAxes();
  const size = (2 * camera.radius) / (camera.zoom * camera.fit);
  camera.shift = camera.shift.map((s, i) => s - (right[i] * dx - up[i] * dy) * size);
  requestDraw();
}
function zoom(factor) {
  camera.zoom = Math.max(0.4, Math.min(40, camera.zoom * factor));
  requestDraw();
}
function setView(name) {
  [camera.yaw, camera.pitch] = VIEWS[name];
  camera.zoom = 1;
  camera.shift = [0, 0, 0];
  if (shown) fit(shown);
  requestDraw();
}

function listenToHands() {
  const hands = new Map();
  const spread = () => { const [a, b] = [...hands.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  scene.addEventListener("pointerdown", (event) => {
    scene.setPointerCapture(event.pointerId);
    hands.set(event.pointerId, { x: event.clientX, y: event.clientY, moves: event.button !== 0 || event.shiftKey });
    byId("probe").textContent = "";
  });
  scene.addEventListener("pointermove", (event) => {
    const hand = hands.get(event.pointerId);
    if (!hand) { probe(event); return; }
    const height = scene.clientHeight;
    const [dx, dy] = [(event.clientX - hand.x) / height, (event.clientY - hand.y) / height];
    const before = hands.size === 2 ? spread() : 0;
    hand.x = event.clientX;
    hand.y = event.clientY;
    if (hands.size === 2) {
      zoom(spread() / Math.max(before, 1));
      move(dx / 2, dy / 2);
    } else if (hand.moves) move(dx, dy);
    else turn(dx * 3.2, dy * 3.2);
  });
  for (const end of ["pointerup", "pointercancel"]) scene.addEventListener(end, (event) => hands.delete(event.pointerId));
  scene.addEventListener("pointerleave", () => { byId("probe").textContent = ""; });
  scene.addEventListener("contextmenu", (event) => event.preventDefault());
  scene.addEventListener("wheel", (event) => { event.preventDefault(); zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015))); }, { passive: false });
  scene.addEventListener("keydown", (event) => {
    const step = 0.08, arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (arrows && event.shiftKey) move(arrows[0] * step, arrows[1] * step);
    else if (arrows) turn(arrows[0] * step * 1.5, arrows[1] * step * 1.5);
    else if (event.key === "+" || event.key === "=") zoom(1.15);
    else if (event.key === "-") zoom(1 / 1.15);
    else if (event.key === "0" || event.key === "Home") setView(HOME);
    else return;
    event.preventDefault();
  });
  for (const button of document.querySelectorAll("[data-view]")) button.addEventListener("click", () => setView(button.dataset.view));
}

/** Says what is under the pointer: the value of the nearest panel or member. */
function probe(event) {
  const field = fieldByKey.get(state.field);
  if (!shown || !cameraMatrix || !field || !shown[field.key]) return;
  const box = scene.getBoundingClientRect();
  const x = event.clientX - box.left, y = event.clientY - box.top;
  const screen = project(shown, box);
  const found = field.on === "panels" ? panelUnder(shown, screen, x, y) : memberUnder(shown, screen, x, y);
  const v = found === null ? NaN : shown[field.key][found];
  byId("probe").textContent = Number.isNaN(v) ? "" : `${field.label} ${d3.format(".3~r")(v)}`;
}
/** x, y in CSS pixels and depth of every vertex. */
function project({ positions, vertices }, { width, height }) {
  const m = cameraMatrix, out = new Float32Array(3 * vertices);
  for (let v = 0; v < vertices; v += 1) {
    const [x, y, z] = [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    out[3 * v] = ((m[0] * x + m[4] * y + m[8] * z + m[12]) / w + 1) * 0.5 * width;
    out[3 * v + 1] = (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * 0.5 * height;
    out[3 * v + 2] = w;
  }
  return out;
}
function panelUnder({ corners }, screen, x, y) {
  let best = null, nearest = Infinity;
  for (let p = 0; p < corners.length / 4; p += 1) {
    const count = corners[4 * p + 3] === NO_CORNER ? 3 : 4;
    let inside = false, depth = 0;
    for (let i = 0, j = count - 1; i < count; j = i, i += 1) {
      const a = 3 * corners[4 * p + i], b = 3 * corners[4 * p + j];
      depth += screen[a + 2] / count;
      if ((screen[a + 1] > y) !== (screen[b + 1] > y)
        && x < ((screen[b] - screen[a]) * (y - screen[a + 1])) / (screen[b + 1] - screen[a + 1]) + screen[a]) inside = !inside;
    }
    if (inside && depth < nearest) { nearest = depth; best = p; }
  }
  return best;
}
function memberUnder({ members }, screen, x, y) {
  let best = null, nearest = 7;
  for (let m = 0; m < members.length / 2; m += 1) {
    const a = 3 * members[2 * m], b = 3 * members[2 * m + 1];
    const dx = screen[b] - screen[a], dy = screen[b + 1] - screen[a + 1];
    const t = Math.max(0, Math.min(1, ((x - screen[a]) * dx + (y - screen[a + 1]) * dy) / (dx * dx + dy * dy || 1)));
    const gap = Math.hypot(screen[a] + t * dx - x, screen[a + 1] + t * dy - y);
    if (gap < nearest) { nearest = gap; best = m; }
  }
  return best;
}
