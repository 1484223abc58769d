// Plan pictures of all designs, drawn when they come into sight.

const THUMB = 138;
let thumbObserver = null;

/** A canvas that draws itself, with the current colours, once it is seen (or printed). */
function thumbnail(design, size = THUMB) {
  const canvas = document.createElement("canvas");
  canvas.className = "thumb";
  canvas.style.width = canvas.style.height = `${size}px`;
  canvas.setAttribute("aria-hidden", "true");
  canvas.draw = () => {
    const mesh = meshOf(design), stamp = state.field;
    if (!mesh || canvas.stamp === stamp) return;
    canvas.stamp = stamp;
    drawPlan(canvas, mesh, size, fieldByKey.get(state.field));
  };
  thumbObserver ??= new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      target.seen = isIntersecting;
      if (isIntersecting) target.draw();
    }
  }, { rootMargin: "200px" });
  thumbObserver.observe(canvas);
  return canvas;
}
function redrawThumbs(all) {
  for (const canvas of document.querySelectorAll("canvas.thumb")) if (all || canvas.seen) canvas.draw();
}

function startGallery() {
  const list = byId("gallery"), sort = byId("gallery-sort"), all = byId("gallery-all");
  const orders = [["balanced", "balance of all objectives"], ...objectives.map((o, i) => [String(i), o.label]), ["family", "family"]];
  for (const [key, text] of orders) sort.add(new Option(text, key));
  const cards = new Map(designs.map((d) => [d, card(d)]));

  function card(design) {
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.dataset.design = design.id;
    button.append(hasMesh(design) ? thumbnail(design) : blank());
    const caption = document.createElement("span");
    caption.className = "caption";
    button.append(caption);
    button.addEventListener("click", () => pick(design));
    button.addEventListener("pointerenter", () => hover(design));
    button.addEventListener("pointerleave", () => hover(null));
    button.addEventListener("focus", () => hover(design));
    button.addEventListener("blur", () => hover(null));
    item.append(button);
    return item;
  }
  function blank() {
    const box = document.createElement("span");
    box.className = "thumb blank";
    box.textContent = "no picture here";
    return box;
  }
  const gap = (d) => d3.sum(objectives, (o) => (relative(d, o) ?? 2) ** 2);
  function order() {
    const key = sort.value;
    const rank = key === "balanced" ? gap : key === "family" ? (d) => families.indexOf(d.family) : (d) => relative(d, objectives[Number(key)]) ?? Infinity;
    return d3.sort(designs, (a, b) => d3.descending(a.baseline, b.baseline) || d3.ascending(rank(a), rank(b)) || d3.ascending(a.id, b.id));
  }
  function refresh() {
    const key = sort.value;
    const metric = objectives[Number(key)];
    list.replaceChildren(...order().map((d) => {
      const item = cards.get(d), inside = kept(d);
      item.hidden = !(inside || d.baseline || all.checked);
      item.classList.toggle("outside", !inside && !d.baseline);
      const text = metric ? withUnit(value(d, metric), metric) : `family ${d.family.letter}`;
      const caption = item.querySelector(".caption");
      caption.innerHTML = `<b>${d.baseline ? "Baseline" : escapeHtml(d.id.slice(0, 7))}</b><span>${escapeHtml(text)}</span>`;
      item.firstChild.setAttribute("aria-label", `${nameOf(d)}, ${metric ? `${metric.label} ` : ""}${text}`);
      return item;
    }));
    mark();
  }
  function mark() {
    for (const [d, item] of cards) item.firstChild.setAttribute("aria-pressed", String(d === state.picked));
  }
  sort.addEventListener("change", refresh);
  all.addEventListener("change", refresh);
  events.on("limits.gallery", refresh);
  events.on("pick.gallery", mark);
  events.on("hover.gallery", () => { for (const [d, item] of cards) item.classList.toggle("hovered", d === state.hovered); });
  events.on("field.gallery", () => redrawThumbs(false));
  refresh();
}

/** Designs in reading order of the page's arrows: the baseline, then the front as in pareto.csv. */
function step(by) {
  const list = designs.filter((d) => d.baseline || kept(d) || d === state.picked);
  const at = list.indexOf(state.picked);
  pick(list[(at + by + list.length) % list.length]);
}
