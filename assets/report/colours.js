// Colour scales. All run from pale to dark, so that they hold for the colour-blind and in grey print.

const FIELDS = [
  { key: "curvature", label: "Panel curvature", on: "panels", scheme: d3.interpolateYlGnBu,
    meaning: "distance of the corners from their best-fit plane ÷ their mean distance from the panel's centre" },
  { key: "skewness", label: "Panel skewness", on: "panels", scheme: d3.interpolateBuPu,
    meaning: "largest deviation of a corner from 90° ÷ 90°" },
  { key: "utilisation", label: "Member utilisation", on: "members", scheme: d3.interpolateYlOrRd,
    meaning: "largest elastic stress in the member ÷ what is allowed" },
];
const BINS = 32;
for (const field of FIELDS) {
  const holders = Object.values(packedMeshes).map((m) => m[field.key]).filter(Boolean);
  field.available = holders.length > 0;
  // One scale for all designs: a colour means the same everywhere on the page.
  field.top = niceTop(d3.quantile(holders, 0.9, (f) => f.high) || 1);
  field.colours = d3.range(BINS).map((i) => d3.color(field.scheme(0.08 + (0.9 * i) / (BINS - 1))).formatHex());
}
const fieldByKey = new Map(FIELDS.map((f) => [f.key, f]));

/** The next of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 × 10^k. */
function niceTop(v) {
  const power = 10 ** Math.floor(Math.log10(v));
  return power * ([1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((s) => s >= v / power - 1e-9));
}

/** Index into `field.colours`; −1 where there is no value. */
function bin(field, v) {
  return Number.isNaN(v) ? -1 : Math.max(0, Math.min(BINS - 1, Math.floor((v / field.top) * BINS)));
}

// Best to worst, in tables: blue to orange, all light enough for dark text.
const bestToWorst = d3.interpolateRgbBasis(["#7db9dc", "#c9dfe9", "#f7f5ef", "#f6d2ae", "#ec9a5c"]);

// Lines and points: by family (Okabe and Ito's colours), or by one objective.
const OKABE_ITO = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8a7f00"];
const OTHER = "#9a9a94";
const PAINT = (r) => d3.interpolateViridis(0.82 * (1 - r));
function paintOf(design) {
  if (state.paint === "none") return null;
  if (state.paint === "family") {
    const i = families.indexOf(design.family);
    return i < OKABE_ITO.length ? OKABE_ITO[i] : OTHER;
  }
  const r = relative(design, objectives[Number(state.paint)]);
  return r === null ? OTHER : PAINT(r);
}
