// The data of the page, and the one state that all its parts share.

const facts = JSON.parse(document.getElementById("facts-data").textContent);
const byId = (id) => document.getElementById(id);

/** Objectives, in the order of the config: {index, label, unit, column, meaning}. */
const objectives = facts.objectives.map((index) => ({ index, ...facts.metrics[index] }));

/** All designs, the baseline first. The baseline may be on the front itself. Without a front the nearest misses follow. */
const designs = (() => {
  const front = [...facts.front.map((d) => ({ ...d, onFront: true, baseline: false })), ...facts.misses.map((d) => ({ ...d, onFront: false, baseline: false }))];
  if (!facts.baseline) return front;
  const same = front.findIndex((d) => d.id === facts.baseline.id);
  const baseline = { ...facts.baseline, onFront: same >= 0 && front[same].onFront, baseline: true };
  if (same >= 0) front.splice(same, 1);
  return [baseline, ...front];
})();
const designById = new Map(designs.map((d) => [d.id, d]));
const frontDesigns = designs.filter((d) => d.onFront);

const value = (design, objective) => design.values[objective.index];
const known = (v) => v !== null && v !== undefined && Number.isFinite(v);

for (const objective of objectives) {
  const values = designs.map((d) => value(d, objective)).filter(known);
  objective.least = d3.min(values);
  objective.most = d3.max(values);
  objective.best = objective.maximised ? objective.most : objective.least;
}

/** 0 for the best, 1 for the worst of all designs; null where there is no value. */
function relative(design, objective) {
  const v = value(design, objective);
  if (!known(v)) return null;
  return objective.most > objective.least ? Math.abs(v - objective.best) / (objective.most - objective.least) : 0;
}

/** Divided by the largest, as in the paper's Figure 24. */
function normalised(design, objective) {
  const v = value(design, objective);
  return known(v) && objective.most > 0 ? v / objective.most : null;
}

/** The design nearest to the best of every objective at once, all counted alike. */
function mostBalanced(candidates) {
  const gap = (d) => d3.sum(objectives, (o) => { const r = relative(d, o); return r === null ? 4 : r * r; });
  return d3.least(candidates, (a, b) => gap(a) - gap(b) || d3.ascending(a.id, b.id));
}
const balanced = mostBalanced(frontDesigns.filter((d) => !d.baseline)) ?? designs.find((d) => !d.baseline) ?? designs[0];

// Families: the same singularities, as `decode` counts them, or, where that makes too many, groups of designs a few strips apart.
const byValence = (counts) => Object.entries(counts).map(([valence, n]) => [Number(valence), n]).sort((a, b) => a[0] - b[0]);
function familyKey(singularities) {
  if (!singularities) return "";
  return JSON.stringify([byValence(singularities.inner), byValence(singularities.boundary), singularities.poles]);
}
function familyText(singularities) {
  if (!singularities) return "not known";
  const { inner, boundary, poles } = singularities;
  const list = (counts) => counts.map(([valence, n]) => `${n} with ${valence} edges`).join(", ");
  const [inside, around] = [byValence(inner), byValence(boundary)];
  const parts = [inside.length && `inside ${list(inside)}`, around.length && `on the boundary ${list(around)}`, poles && `${poles} ${poles === 1 ? "pole" : "poles"}`];
  return parts.filter(Boolean).join("; ") || "no singularities";
}
/** "A" … "Z", "AA" … */
function letters(i) {
  return (i >= 26 ? letters(Math.floor(i / 26) - 1) : "") + String.fromCharCode(65 + (i % 26));
}
const grouped = designs.some((d) => d.group !== null);
/** What a family has in common, or, of a group, an example and how many kinds of singularities there are. */
function describeFamily(members) {
  const kinds = new Set(members.map((d) => familyKey(d.singularities))).size;
  const text = familyText(mostBalanced(members).singularities);
  return kinds > 1 ? `such as ${text}; ${kinds} kinds in all` : text;
}
const families = d3.groups(designs, (d) => (grouped ? String(d.group) : familyKey(d.singularities)))
  .map(([key, members]) => ({ key, members, text: describeFamily(members) }))
  .sort((a, b) => b.members.length - a.members.length || d3.ascending(a.key, b.key))
  .map((family, i) => ({ ...family, letter: letters(i) }));
for (const family of families) for (const design of family.members) design.family = family;

// Numbers for people: four significant digits, the same everywhere.
const locale = d3.formatLocale({ decimal: ".", thousands: "\u202f", grouping: [3], currency: ["", ""], minus: "−" });
const whole = locale.format(",.0f");
const four = locale.format(".4~r");
const tiny = locale.format(".3e");
const two = locale.format(".2f");
function number(v) {
  if (!known(v)) return "–";
  const size = Math.abs(v);
  if (v === 0) return "0";
  if (size >= 1000) return whole(v);
  return size < 1e-4 ? tiny(v) : four(v);
}
/** Labels of an axis: as many digits as tell its ticks apart, the same for all. */
function ticksOf(scale, count = 5) {
  const [a, b] = d3.extent(scale.domain());
  const step = d3.tickStep(a, b, count), most = Math.max(Math.abs(a), Math.abs(b));
  if (most >= 1e6 || most < 1e-3) return locale.format(".2~e");
  return locale.format(`,.${d3.precisionFixed(step)}f`);
}
const withUnit = (v, metric) => (known(v) && metric.unit ? `${number(v)}\u00a0${metric.unit}` : number(v));
const unitLabel = (metric) => (metric.unit ? `${metric.label}, ${metric.unit}` : metric.label);
/** 1st, 2nd, 3rd, 4th, 11th … */
function ordinal(n) {
  const ending = n % 100 >= 11 && n % 100 <= 13 ? "th" : ["th", "st", "nd", "rd"][n % 10] ?? "th";
  return `${whole(n)}${ending}`;
}
const plural = (n, one, many = `${one}s`) => `${whole(n)} ${n === 1 ? one : many}`;
const nameOf = (design) => (design.baseline ? `Baseline ${design.id}` : `Design ${design.id}`);

// Shared state. Whoever changes it calls `changed(what)`.
const state = {
  picked: balanced,
  hovered: null,
  limits: new Map(), // objective → [low, high]
  family: null,
  symmetry: null, // "none", or what kept designs must have, such as mirror-x
  pinned: [],
  field: "curvature", // what panels or members are coloured by
  paint: "none", // what lines and points are coloured by
};
const events = d3.dispatch("pick", "hover", "limits", "pins", "field", "paint");
const changed = (what) => events.call(what);

const symmetriesOf = (design) => design.symmetry.split(" ").filter(Boolean);
const hasSymmetry = (design, wanted) => (wanted === "none" ? !design.symmetry : symmetriesOf(design).includes(wanted));

/** Whether a design is inside all limits; the baseline is shown whatever they are, and is not counted. */
function kept(design) {
  if (state.family && design.family !== state.family) return false;
  if (state.symmetry && !hasSymmetry(design, state.symmetry)) return false;
  for (const [objective, [low, high]] of state.limits) {
    const v = value(design, objective);
    if (!known(v) || v < low || v > high) return false;
  }
  return true;
}
/** The limits of an objective, null where it has none; an end that is not limited is infinite. */
const limitOf = (objective) => state.limits.get(objective) ?? null;
/** The same as far as it can be drawn. */
function drawnLimit(objective) {
  const within = (v) => Math.max(objective.least, Math.min(objective.most, v));
  return limitOf(objective)?.map(within) ?? null;
}
function setLimit(objective, range) {
  if (range?.some(Number.isFinite)) state.limits.set(objective, range);
  else state.limits.delete(objective);
}
function pick(design) {
  if (!design) return;
  state.picked = design;
  changed("pick");
}
function hover(design) {
  if (state.hovered === design) return;
  state.hovered = design;
  changed("hover");
}
function togglePin(design) {
  const at = state.pinned.indexOf(design);
  if (at >= 0) state.pinned.splice(at, 1);
  else state.pinned.push(design);
  changed("pins");
}

// A small label that follows the pointer.
const tip = byId("tip");
function showTip(event, html) {
  tip.innerHTML = html;
  tip.hidden = false;
  const { width, height } = tip.getBoundingClientRect();
  tip.style.left = `${Math.max(4, Math.min(event.clientX + 14, innerWidth - width - 8))}px`;
  tip.style.top = `${Math.max(4, event.clientY + 16 + height > innerHeight ? event.clientY - height - 10 : event.clientY + 16)}px`;
}
const hideTip = () => { tip.hidden = true; };
function escapeHtml(text) {
  return String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
}
function designTip(design) {
  const rows = objectives.map((o) => `<tr><td>${escapeHtml(o.label)}</td><td>${escapeHtml(withUnit(value(design, o), o))}</td></tr>`);
  return `<strong>${escapeHtml(nameOf(design))}</strong> · family ${design.family.letter}<table>${rows.join("")}</table>`;
}
