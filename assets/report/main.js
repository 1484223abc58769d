// Puts the page together.

function writeHead() {
  const { run } = facts;
  byId("lede").innerHTML = `Topologies for a structured surface structure, found by evolving strings of a quad-mesh grammar. ${frontDesigns.length ? `This page shows the ${plural(frontDesigns.length, "design")} that no other design beats in every objective, against the initial mesh.`
      : `The search found no feasible design, so there is no front. Below: what stood in the way${facts.misses.length ? ", and the designs that came nearest" : ""}.`} Lengths in metres, masses in kilograms; numbers without a unit are ratios. Pictures are rounded to ${roundingText()}; exact geometry is in <code>designs/</code>, exact numbers in <code>pareto.csv</code>.`;
  const share = run.evaluations ? ` (${d3.format(".2~r")((100 * run.feasible) / run.evaluations)} %)` : "";
  const counts = [["designs on the front", whole(frontDesigns.length)], ["evaluated", whole(run.evaluations)], ["feasible", whole(run.feasible) + share],
    ["duplicates refused", whole(run.duplicates_refused)], ["generations", whole(d3.max(facts.generations, (g) => g.generation) ?? 0)], ["seed", run.seed.length > 9 ? `${run.seed.slice(0, 4)}…${run.seed.slice(-3)}` : run.seed]];
  byId("counts").innerHTML = counts.map(([name, text]) => `<div><dt>${name}</dt><dd>${escapeHtml(text)}</dd></div>`).join("");
  const larger = objectives.filter((o) => o.maximised).map((o) => o.label);
  if (larger.length) byId("better").textContent = `Better when larger: ${larger.join(", ")}; all other objectives are better when smaller.`;
  byId("foot").textContent = `Written by quadrille ${run.program_version}. Method: Oval, Mesnil, Van Mele, Baverel, Block, “A vector encoding for topology finding of structured quad-based patterns for surface structures”.`;
  byId("config").textContent = facts.config_toml;
}
/** The coarsest step of all embedded meshes, in millimetres. */
function roundingText() {
  const step = d3.max(Object.values(packedMeshes), (m) => d3.max(m.step)) ?? 0;
  return `${number(Math.max(0.1, Math.ceil(step * 1e4) / 10))} mm`;
}

function startToolbar() {
  const paint = byId("paint");
  for (const [key, text] of [["none", "one colour"], ...objectives.map((o, i) => [String(i), o.label]), ["family", "family"]]) paint.add(new Option(text, key));
  paint.addEventListener("change", () => { state.paint = paint.value; changed("paint"); });
  events.on("paint.key", () => { byId("paint-key").innerHTML = paintKey(); });
  const symmetry = byId("symmetry"), symmetries = d3.sort(new Set(frontDesigns.flatMap(symmetriesOf)));
  byId("symmetry-label").hidden = !symmetries.length;
  for (const [key, text] of [["", "any"], ...symmetries.map((s) => [s, s]), ["none", "none"]]) symmetry.add(new Option(text, key));
  symmetry.addEventListener("change", () => { state.symmetry = symmetry.value || null; changed("limits"); });
  byId("clear").addEventListener("click", () => { state.limits.clear(); state.family = null; state.symmetry = null; symmetry.value = ""; changed("limits"); });
  byId("previous").addEventListener("click", () => step(-1));
  byId("next").addEventListener("click", () => step(1));
  byId("pin").addEventListener("click", () => togglePin(state.picked));
  const count = () => {
    const n = frontDesigns.filter(kept).length, baseline = designs.find((d) => d.baseline);
    byId("kept").textContent = `${whole(n)} of ${plural(frontDesigns.length, "design")} of the front within the limits${state.family ? ` and in family ${state.family.letter}` : ""}${!baseline ? "" : baseline.onFront ? ", the baseline being one of the front" : "; the baseline is shown beside them"}`;
    byId("clear").disabled = !state.limits.size && !state.family && !state.symmetry;
  };
  events.on("limits.count", count);
  count();
}

/** What the colours of lines and points mean. */
function paintKey() {
  if (state.paint === "none") return "";
  if (state.paint !== "family") return `best <span class="paint-ramp" style="background:linear-gradient(to right,${d3.range(0, 1.01, 0.1).map(PAINT).join(",")})"></span> worst`;
  const named = families.slice(0, OKABE_ITO.length).map((f, i) => `<span class="swatch" style="background:${OKABE_ITO[i]}"></span>${f.letter}`);
  if (families.length > OKABE_ITO.length) named.push(`<span class="swatch" style="background:${OTHER}"></span>others`);
  return named.join(" ");
}

/** The same limits as the brushes, by numbers and so by keyboard. */
function startLimits() {
  const box = byId("limits");
  // Field text is plain ASCII: a typographic minus would leave it empty.
  const typed = (v) => String(Number(v.toPrecision(6)));
  const inputs = objectives.map((o) => ["least", "most"].map((end, k) => {
    const input = document.createElement("input");
    Object.assign(input, { type: "number", step: "any", placeholder: known(o[end]) ? typed(o[end]) : "" });
    input.setAttribute("aria-label", `${end} ${o.label}${o.unit ? ` in ${o.unit}` : ""}`);
    input.addEventListener("change", () => {
      if (input.validity.badInput) return;
      // The other end stays as it is, and one that is left empty is no limit.
      const limit = [...(limitOf(o) ?? [-Infinity, Infinity])];
      limit[k] = input.value === "" ? [-Infinity, Infinity][k] : Number(input.value);
      setLimit(o, limit);
      changed("limits");
    });
    return input;
  }));
  for (const [i, o] of objectives.entries()) {
    const row = document.createElement("div");
    const name = document.createElement("span");
    name.textContent = unitLabel(o);
    row.append(name, inputs[i][0], "to", inputs[i][1]);
    box.append(row);
  }
  events.on("limits.inputs", () => {
    for (const [i, o] of objectives.entries()) {
      for (const [k, input] of inputs[i].entries()) {
        const limit = limitOf(o)?.[k];
        if (!Number.isFinite(limit)) input.value = "";
        else if (input.value === "" || Number(input.value) !== limit) input.value = typed(limit);
      }
    }
  });
}

function startFields() {
  const box = byId("fields");
  const available = FIELDS.filter((f) => f.available);
  if (!available.some((f) => f.key === state.field)) state.field = available[0]?.key ?? "none";
  for (const { key, label } of [...available, { key: "none", label: "None" }]) {
    const element = document.createElement("label");
    element.innerHTML = `<input type="radio" name="field" value="${key}"${key === state.field ? " checked" : ""}> ${label}`;
    element.firstChild.addEventListener("change", () => { state.field = key; changed("field"); });
    box.append(element);
  }
  events.on("field.legend", writeLegend);
  writeLegend();
}
const MARK_KEY = `Singular vertices: <span style="color:${MARKS[0]}">▲</span> fewer edges than regular, <span style="color:${MARKS[1]}">■</span> more, <span class="pole">◆</span> pole.`;
function writeLegend() {
  const field = fieldByKey.get(state.field), box = byId("legend");
  if (!field) { box.innerHTML = `<p class="small">${MARK_KEY}</p>`; return; }
  const ticks = d3.range(0, 5).map((i) => (field.top * i) / 4);
  box.innerHTML = `<div class="ramp" style="background:linear-gradient(to right,${field.colours.join(",")})"></div>
    <div class="ramp-ticks">${ticks.map((t, i) => `<span>${i === 4 ? "≥ " : ""}${number(t)}</span>`).join("")}</div>
    <p class="small"><b>${field.label}</b> (ratio, no unit): ${field.meaning}. One scale for all designs.<br>${MARK_KEY}</p>`;
}

/** The picked design in the address, so that a link leads to it. */
function startAddress() {
  const fromAddress = () => designById.get(decodeURIComponent(location.hash.replace(/^#design-/, "")));
  const wanted = fromAddress();
  if (wanted) state.picked = wanted;
  addEventListener("hashchange", () => pick(fromAddress()));
  const bar = byId("picked-bar");
  events.on("pick.address", () => {
    try { history.replaceState(null, "", `#design-${state.picked.id}`); } catch { /* some viewers have no address */ }
    bar.textContent = `${nameOf(state.picked)} ↑`;
    bar.classList.add("on");
  });
}

// What is seen first is made first; the rest follows piece by piece, so that the page answers at once.
writeHead();
const later = [startShortlist, startTable, startFamilies, startConvergence, startSpread, startObstacles, startMetrics];
const hide = (...ids) => { for (const id of ids) byId(id).hidden = true; };
const without = (...starts) => { for (const start of starts) later.splice(later.indexOf(start), 1); };
if (!facts.obstacles.length) { hide("obstacles-section"); without(startObstacles); }
if (frontDesigns.length) {
  hide("misses-section");
  startAddress();
  startToolbar();
  startFields();
  startPicked();
  startViewer();
  startParallel();
  startLimits();
  later.unshift(startMatrix, startGallery);
} else {
  // Nothing feasible: no front to choose from, but something to look at.
  hide("front", "gallery-section", "shortlist-section", "table-section", "families-section", "spread-part", "pin");
  without(startShortlist, startTable, startFamilies, startSpread);
  // What stood in the way comes first.
  byId("misses-section").before(byId("obstacles-section"));
  document.querySelector(".skip").href = "#obstacles-section";
  if (designs.length) {
    startAddress();
    byId("previous").addEventListener("click", () => step(-1));
    byId("next").addEventListener("click", () => step(1));
    startFields();
    startPicked();
    startViewer();
    later.unshift(startMisses);
  } else {
    hide("viewer", "misses-section");
  }
}
function startNext() {
  later.shift()?.();
  if (later.length) setTimeout(startNext);
  else document.documentElement.dataset.ready = "true";
}
addEventListener("beforeprint", () => {
  while (later.length) startNext();
  redrawThumbs(true);
});
setTimeout(startNext);
