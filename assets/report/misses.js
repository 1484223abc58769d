// What kept designs from being feasible, and, where no design is, those that came nearest.

/** One bar a limit or failure. */
function startObstacles() {
  const rows = facts.obstacles, most = d3.max(rows, (r) => r.designs);
  const body = rows.map((r) => `<tr><th scope="row"><code>${escapeHtml(r.name)}</code></th><td class="num">${whole(r.designs)}</td>
    <td class="bar-cell wide"><span class="share" style="width:${((100 * r.designs) / most).toFixed(1)}%"></span></td></tr>`);
  byId("obstacles").innerHTML = `<table class="plain obstacles"><thead><tr><th scope="col">Limit, requirement or failure</th><th scope="col">Designs</th><td></td></tr></thead><tbody>${body.join("")}</tbody></table>`;
  const infeasible = facts.run.evaluations - facts.run.feasible;
  byId("obstacles-text").textContent = `${whole(infeasible)} of ${plural(facts.run.evaluations, "evaluated design")} ${infeasible === 1 ? "is" : "are"} not feasible. A design counts under every limit that it exceeds. Limits are set by [pattern.limits] and [[structure.requirement]] of the config; history.csv says how far each design is from them.`;
}

/** The initial mesh and the nearest misses, drawn, with what each exceeds and its figures. */
function startMisses() {
  const box = byId("misses");
  const columns = facts.metrics.map((metric, index) => ({ index, ...metric })).filter((m) => facts.objectives.includes(m.index) || MISS_FIGURES.includes(m.column));
  const shown = columns.filter((m) => designs.some((d) => known(value(d, m))));
  const reasons = (d) => (d.reason ? `<ul class="reasons">${d.reason.split("; ").map((r) => `<li>${escapeHtml(r)}</li>`).join("")}</ul>` : "");
  const head = shown.map((m) => `<th scope="col" title="${escapeHtml(m.meaning)}">${escapeHtml(m.label)}${m.unit ? ` <span class="unit">${escapeHtml(m.unit)}</span>` : ""}</th>`);
  const body = designs.map((d) => `<tr data-row="${escapeHtml(d.id)}"><td><span class="slot" data-slot="${escapeHtml(d.id)}"></span></td><th scope="row">${idButton(d)}</th>
    <td class="wide">${reasons(d)}</td>${shown.map((m) => `<td class="num">${number(value(d, m))}</td>`).join("")}<td class="string">${stringOf(d.string)}</td></tr>`);
  box.innerHTML = `<table class="all misses"><thead><tr><th scope="col">Plan</th><th scope="col">Design</th><th scope="col">What it exceeds</th>${head.join("")}<th scope="col">String</th></tr></thead><tbody>${body.join("")}</tbody></table>`;
  for (const slot of box.querySelectorAll("[data-slot]")) slot.append(missPicture(designById.get(slot.dataset.slot)));
  listenForPicks(box);
  const mark = () => {
    for (const row of box.querySelectorAll("tr[data-row]")) row.classList.toggle("picked", row.dataset.row === state.picked.id);
  };
  events.on("pick.misses", mark);
  events.on("field.misses", () => redrawThumbs(false));
  mark();
}
/** Columns beside the objectives that say why a pattern cannot be built. */
const MISS_FIGURES = ["edge_min_m", "edge_max_m", "angle_min_deg", "valence_max", "faces"];
function missPicture(design) {
  if (!hasMesh(design)) return Object.assign(document.createElement("span"), { className: "muted", textContent: "no pattern" });
  const button = document.createElement("button");
  Object.assign(button, { type: "button", className: "bare" });
  button.dataset.pick = design.id;
  button.setAttribute("aria-label", `Show ${nameOf(design)}`);
  button.append(thumbnail(design, 120));
  return button;
}
