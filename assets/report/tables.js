// Tables: the shortlist as the paper's Figure 24, all designs, and what the metrics mean.

/** A cell coloured from best to worst, the best marked. */
function scoreCell(design, objective, absolute) {
  const v = value(design, objective), r = relative(design, objective), n = normalised(design, objective);
  if (r === null) return "<td class='score none'>–</td>";
  const best = v === objective.best, most = objective.maximised ? "largest" : "smallest";
  const text = absolute ? number(v) : n === null ? number(v) : two(n);
  const style = best ? "" : ` style="background:${bestToWorst(r)}"`;
  const words = `${objective.label} ${withUnit(v, objective)}${best ? `, the ${most}` : ""}`;
  return `<td class="score${best ? " best" : ""}"${style} title="${escapeHtml(words)}">${best ? `<span class='mark'>${objective.maximised ? "▲" : "▼"}<span class='words'> ${most} </span></span>` : ""}${text}</td>`;
}
const idButton = (d) => `<button type="button" class="link" data-pick="${escapeHtml(d.id)}">${d.baseline ? "Baseline" : escapeHtml(d.id)}</button>`;
const stringOf = (text) => (text ? `<code>${escapeHtml(text)}</code>` : "<span class='muted'>empty</span>");

/** Picks on any button with data-pick inside. */
function listenForPicks(element) {
  element.addEventListener("click", (event) => {
    const button = event.target.closest("[data-pick]");
    if (button) pick(designById.get(button.dataset.pick));
    const pin = event.target.closest("[data-pin]");
    if (pin) togglePin(designById.get(pin.dataset.pin));
  });
}

// What a first reader should compare: the initial mesh, the balanced design, and the best of every objective.
const bestIn = (o) => d3.least(frontDesigns.filter((d) => known(value(d, o))), (d) => relative(d, o));
state.pinned = [...new Set([balanced, ...objectives.map(bestIn)].filter((d) => d && !d.baseline))].slice(0, 7);

function startShortlist() {
  const box = byId("shortlist");
  function refresh() {
    const columns = [...designs.filter((d) => d.baseline), ...state.pinned];
    const head = columns.map((d) => `<th scope="col" class="pic"${d === state.picked ? " aria-current='true'" : ""}><span class="slot" data-slot="${escapeHtml(d.id)}"></span>${idButton(d)}
      ${d.baseline ? `<span class="muted">${d.feasible ? "initial mesh" : `infeasible${d.reason ? `: ${escapeHtml(d.reason)}` : ""}`}</span>` : `<button type="button" class="mini" data-pin="${escapeHtml(d.id)}" aria-label="Remove ${escapeHtml(d.id)} from the shortlist">remove</button>`}</th>`);
    const body = objectives.map((o) => `<tr><th scope="row" title="${escapeHtml(o.meaning)}">${escapeHtml(o.label)} <span class="muted">1.00 = ${escapeHtml(withUnit(o.most, o))}</span></th>${columns.map((d) => scoreCell(d, o, false)).join("")}</tr>`);
    const words = [
      ["Family", (d) => `${d.family.letter}`],
      ["Singularities", (d) => escapeHtml(familyText(d.singularities))],
      ["String, expressed", (d) => stringOf(d.expressed)],
    ].map(([name, text]) => `<tr class="words-row"><th scope="row">${name}</th>${columns.map((d) => `<td>${text(d)}</td>`).join("")}</tr>`);
    box.innerHTML = `<table class="figure24"><thead><tr><td></td>${head.join("")}</tr></thead><tbody>${body.join("")}${words.join("")}</tbody></table>`;
    for (const slot of box.querySelectorAll("[data-slot]")) {
      const design = designById.get(slot.dataset.slot);
      if (hasMesh(design)) slot.append(thumbnail(design, 96));
    }
  }
  listenForPicks(box);
  events.on("pins.shortlist", refresh);
  events.on("pick.shortlist", () => {
    for (const th of box.querySelectorAll("th.pic")) th.toggleAttribute("aria-current", th.querySelector("[data-pick]").dataset.pick === state.picked.id);
  });
  refresh();
}

function startTable() {
  const box = byId("table");
  let by = null, down = false; // sorted by objective (null: as in pareto.csv)
  function refresh() {
    const absolute = document.querySelector("input[name=numbers]:checked").value === "absolute";
    const key = (d) => (by === "family" ? families.indexOf(d.family) : by === "generation" ? d.generation : by === null ? 0 : value(d, objectives[by]) ?? Infinity);
    const rows = d3.sort(designs.filter((d) => d.baseline || kept(d)), (a, b) =>
      d3.descending(a.baseline, b.baseline) || (down ? d3.descending : d3.ascending)(key(a), key(b)));
    const sortable = (what, name, unit) => {
      const active = by === what;
      const text = `${escapeHtml(name)}${unit ? ` <span class="unit">${escapeHtml(unit)}</span>` : ""}`;
      // Chromium leaves buttons out of heads repeated on the next printed page, hence the text once more.
      return `<th scope="col" aria-sort="${active ? (down ? "descending" : "ascending") : "none"}"><span class="printed" aria-hidden="true">${text}</span><button type="button" data-sort="${what}">${text}<span class="arrow">${active ? (down ? "▾" : "▴") : ""}</span></button></th>`;
    };
    const head = objectives.map((o, i) => sortable(i, o.label, absolute ? o.unit : ""));
    const body = rows.map((d) => `<tr data-row="${escapeHtml(d.id)}" class="${d === state.picked ? "picked" : ""}"><td><input type="checkbox" data-pin="${escapeHtml(d.id)}" aria-label="${escapeHtml(nameOf(d))} in the shortlist"${state.pinned.includes(d) ? " checked" : ""}${d.baseline ? " disabled" : ""}></td>
      <th scope="row">${idButton(d)}</th><td>${d.family.letter}</td>${objectives.map((o) => scoreCell(d, o, absolute)).join("")}<td>${d.generation}</td><td class="string">${stringOf(d.string)}</td></tr>`);
    box.innerHTML = `<table class="all"><thead><tr><th scope="col"><span class="words">Shortlist</span>☆</th><th scope="col">Design</th>${sortable("family", "Family")}${head.join("")}${sortable("generation", "Gen.")}<th scope="col">String</th></tr></thead><tbody>${body.join("")}</tbody></table>`;
  }
  listenForPicks(box);
  box.addEventListener("click", (event) => {
    const button = event.target.closest("[data-sort]");
    if (!button) return;
    const what = ["family", "generation"].includes(button.dataset.sort) ? button.dataset.sort : Number(button.dataset.sort);
    down = by === what ? !down : false;
    by = what;
    refresh();
    box.querySelector(`[data-sort="${what}"]`).focus();
  });
  for (const radio of document.querySelectorAll("input[name=numbers]")) radio.addEventListener("change", refresh);
  events.on("limits.table", refresh);
  events.on("pins.table", () => {
    for (const tick of box.querySelectorAll("[data-pin]")) tick.checked = state.pinned.includes(designById.get(tick.dataset.pin));
  });
  events.on("pick.table", () => {
    for (const row of box.querySelectorAll("tr[data-row]")) row.classList.toggle("picked", row.dataset.row === state.picked.id);
  });
  refresh();
}

/** The numbers of the picked design, under its picture. */
function startPicked() {
  const box = byId("picked-values");
  function place(design, objective) {
    const values = frontDesigns.map((d) => value(d, objective)).filter(known);
    const v = value(design, objective);
    return known(v) ? 1 + values.filter((u) => u < v).length : null;
  }
  function refresh() {
    const d = state.picked;
    byId("viewer-title").textContent = d.baseline ? "Baseline: the initial mesh" : `Design ${d.id}`;
    const rows = objectives.map((o) => {
      const r = relative(d, o), rank = place(d, o);
      const bar = r === null ? "" : `<span class="bar" style="--at:${(100 * r).toFixed(1)}%"></span>`;
      return `<tr><th scope="row" title="${escapeHtml(o.meaning)}">${escapeHtml(o.label)}</th><td class="num">${escapeHtml(withUnit(value(d, o), o))}</td><td class="bar-cell">${bar}</td>
        <td class="rank">${rank === null ? "" : d.onFront ? `${ordinal(rank)} of ${whole(frontDesigns.length)}` : frontDesigns.length ? `${whole(rank - 1)} better` : ""}</td></tr>`;
    });
    const others = facts.metrics.map((m, i) => [m, d.values[i]]).filter(([, v], i) => known(v) && !facts.objectives.includes(i))
      .map(([m, v]) => `<tr><th scope="row" title="${escapeHtml(m.meaning)}">${escapeHtml(m.label)}</th><td class="num">${escapeHtml(withUnit(v, m))}</td></tr>`);
    const files = d.onFront || facts.misses.some((m) => m.id === d.id) ? facts.design_files.map((ending) => `<a href="designs/${encodeURIComponent(d.id)}${escapeHtml(ending)}">${escapeHtml(ending.replace(/^[._]/, ""))}</a>`).join(" ") : "";
    const standing = d.baseline || !d.onFront ? (d.onFront ? "On the front itself." : d.feasible ? "Feasible, but dominated." : `Not feasible${d.reason ? `: ${escapeHtml(d.reason)}` : ""}.`) : d === balanced ? "Nearest to the best of all objectives at once." : "";
    box.innerHTML = `<p class="standing">Family ${d.family.letter}: ${escapeHtml(familyText(d.singularities))} · generation ${d.generation}${d.symmetry ? ` · ${escapeHtml(d.symmetry)}` : ""}${d.equal > 1 ? ` · stands for ${plural(d.equal, "design")} with these objectives` : ""}${d.preferred ? ` · ${ordinal(d.preferred)} by the preferences of the config` : ""}. ${standing}</p>
      <table class="values"><tbody>${rows.join("")}</tbody></table>
      <p class="strings"><span>String</span> ${stringOf(d.string)}${d.expressed !== d.string ? `<br><span>of it expressed</span> ${stringOf(d.expressed)}` : ""}</p>
      ${files ? `<p class="files"><span>Files beside this page</span> ${files}</p>` : ""}
      ${others.length ? `<details${refresh.open ? " open" : ""}><summary>All its numbers</summary><table class="values"><tbody>${others.join("")}</tbody></table></details>` : ""}`;
    box.querySelector("details")?.addEventListener("toggle", (event) => { refresh.open = event.target.open; });
    markPin();
  }
  function markPin() {
    const pinned = state.pinned.includes(state.picked), button = byId("pin");
    button.setAttribute("aria-pressed", String(pinned));
    button.textContent = pinned ? "★ Shortlisted" : "☆ Shortlist";
    button.disabled = state.picked.baseline;
  }
  events.on("pick.values", refresh);
  events.on("pins.values", markPin);
  refresh();
}

function startMetrics() {
  const rows = facts.metrics.map((m, i) => `<tr><th scope="row">${escapeHtml(m.label)}${facts.objectives.includes(i) ? " <span class='tag'>objective</span>" : ""}</th><td>${escapeHtml(m.unit || "–")}</td><td><code>${escapeHtml(m.column)}</code></td><td>${escapeHtml(m.meaning)}</td></tr>`);
  byId("metrics").innerHTML = `<table class="plain"><thead><tr><th scope="col">Metric</th><th scope="col">Unit</th><th scope="col">Column in the CSV files</th><th scope="col">Meaning</th></tr></thead><tbody>${rows.join("")}</tbody></table>`;
}
