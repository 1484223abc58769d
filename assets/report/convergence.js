// How the search went, by Observable Plot.

function startConvergence() {
  const rows = facts.generations.map((g, i, all) => ({ ...g,
    share: g.evaluations > 0 ? (100 * g.feasible) / g.evaluations : null,
    newShare: shareOf(g, all[i - 1]) }));
  const charts = [
    { title: "Hypervolume of the front", unit: "1 = the box from ideal to reference; more where designs are better than the ideal", key: "hypervolume", zero: false },
    { title: "Designs on the front", unit: "designs", key: "front", zero: true },
    { title: "Feasible among those evaluated in the generation", unit: "%", key: "newShare", zero: true },
    { title: "Duplicates refused in the generation", unit: "children", key: "duplicates_refused", zero: true, bars: true },
  ];
  const box = byId("convergence");
  onWidth(box, () => {
    const width = chartWidth(box, 400);
    box.replaceChildren(...charts.map((chart) => figure(chart.title, chart.unit, trend(rows.filter((r) => known(r[chart.key])), chart, width))));
  });
}
function shareOf(g, before) {
  const evaluated = g.evaluations - (before?.evaluations ?? 0), feasible = g.feasible - (before?.feasible ?? 0);
  return evaluated > 0 ? (100 * feasible) / evaluated : null;
}
function chartWidth(box, least) {
  const columns = Math.max(1, Math.floor((box.clientWidth + 20) / (Math.min(least, box.clientWidth) + 20)));
  return (box.clientWidth - 20 * (columns - 1)) / columns;
}
function figure(title, unit, plot) {
  const element = document.createElement("figure");
  const caption = document.createElement("figcaption");
  caption.innerHTML = `<b>${escapeHtml(title)}</b>${unit ? `, ${escapeHtml(unit)}` : ""}`;
  element.append(caption, plot ?? Object.assign(document.createElement("p"), { className: "muted", textContent: "No values." }));
  return element;
}
function trend(rows, { key, title, unit, zero, bars }, width) {
  if (!rows.length) return null;
  const label = (r) => `generation ${r.generation}\n${number(r[key])}${unit === "%" ? " %" : ""}`;
  const marks = bars
    ? [Plot.rectY(rows, { x1: (r) => r.generation - 0.4, x2: (r) => r.generation + 0.4, y: key, fill: "var(--accent)", fillOpacity: 0.55 })]
    : [Plot.lineY(rows, { x: "generation", y: key, stroke: "var(--accent)", strokeWidth: 2 }), Plot.dot(rows, { x: "generation", y: key, r: rows.length > 60 ? 0 : 2.2, fill: "var(--accent)" })];
  return Plot.plot({
    width, height: 200, marginLeft: 52, marginRight: 14, marginBottom: 34, ariaLabel: title,
    style: { background: "none", fontSize: "12px" },
    x: { label: "generation", tickFormat: whole, ticks: Math.min(8, rows.length) }, y: { label: null, grid: true, zero, tickFormat: number, ticks: 5 },
    marks: [Plot.ruleY(zero ? [0] : [], { strokeOpacity: 0.4 }), ...marks, Plot.tip(rows, Plot.pointerX({ x: "generation", y: key, title: label, fill: "var(--sheet)" }))],
  });
}

function startSpread() {
  const { first, last } = facts.spread;
  byId("spread-text").innerHTML = `Feasible designs of ${escapeHtml(first.label || "the first")} (${whole(first.rows.length)}) against those of ${escapeHtml(last.label || "the last")} (${whole(last.rows.length)}), and the front of the whole run (${whole(frontDesigns.length)}): each design a tick, the box from the lower to the upper quartile, the thick line the median. Left is better.`;
  const box = byId("spread");
  onWidth(box, () => {
    const width = chartWidth(box, 330);
    box.replaceChildren(...objectives.map((o, i) => figure(o.label, o.unit, boxes(first, last, i, o, width))));
  });
}
function boxes(first, last, i, objective, width) {
  const front = { rows: frontDesigns.map((d) => objectives.map((o) => value(d, o))) };
  const rows = [["first", first], ["last", last], ["front", front]].flatMap(([when, sample]) => sample.rows.map((r) => ({ when, v: r[i] })).filter((r) => known(r.v)));
  if (!rows.length) return null;
  return Plot.plot({
    width, height: 142, marginLeft: 40, marginRight: 26, marginBottom: 30, ariaLabel: `${objective.label}: first generation, last generation, front`,
    style: { background: "none", fontSize: "12px" },
    x: { label: null, tickFormat: number, ticks: 5, grid: true, nice: true }, y: { label: null, domain: ["first", "last", "front"], tickSize: 0 },
    color: { domain: ["first", "last", "front"], range: ["var(--muted)", "var(--accent)", "var(--pick)"] },
    marks: [
      Plot.barX(rows, Plot.groupY({ x1: "p25", x2: "p75" }, { x1: "v", x2: "v", y: "when", fill: "when", fillOpacity: 0.22, insetTop: 5, insetBottom: 5 })),
      Plot.tickX(rows, { x: "v", y: "when", stroke: "when", strokeOpacity: 0.5, insetTop: 9, insetBottom: 9 }),
      Plot.tickX(rows, Plot.groupY({ x: "median" }, { x: "v", y: "when", stroke: "when", strokeWidth: 3, insetTop: 4, insetBottom: 4 })),
    ],
  });
}
