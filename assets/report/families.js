// Families: designs grouped by their singularities.

function startFamilies() {
  const box = byId("families");
  if (grouped) byId("families-text").textContent = "Designs that are near each other: the fewer strips have to be deleted from two designs until they are the same, the nearer they are. Groups are joined by the mean distance of their members until six are left. Singular vertices are given of one design of each, the most balanced.";
  function refresh() {
    const head = objectives.map((o) => `<th scope="col">best ${escapeHtml(o.label)}${o.unit ? ` <span class="unit">${escapeHtml(o.unit)}</span>` : ""}</th>`);
    const rows = families.map((family) => {
      const best = objectives.map((o) => {
        const d = d3.least(family.members.filter((m) => known(value(m, o))), (m) => relative(m, o));
        return d ? scoreCell(d, o, true) : "<td class='score none'>–</td>";
      });
      const active = state.family === family;
      return `<tr class="${active ? "picked" : ""}"><th scope="row"><button type="button" data-family="${family.letter}" aria-pressed="${active}" aria-label="Show only family ${family.letter}">${family.letter}</button></th>
        <td><span class="slot" data-slot="${escapeHtml(mostBalanced(family.members).id)}"></span></td><td class="wide">${escapeHtml(family.text)}</td><td class="num">${whole(family.members.length)}</td>${best.join("")}</tr>`;
    });
    box.innerHTML = `<table class="all families"><thead><tr><th scope="col">Family</th><th scope="col">One of it</th><th scope="col">Singular vertices</th><th scope="col">Designs</th>${head.join("")}</tr></thead><tbody>${rows.join("")}</tbody></table>`;
    for (const slot of box.querySelectorAll("[data-slot]")) {
      const design = designById.get(slot.dataset.slot);
      if (!hasMesh(design)) continue;
      const button = document.createElement("button");
      button.type = "button";
      button.className = "bare";
      button.dataset.pick = design.id;
      button.setAttribute("aria-label", `Show ${nameOf(design)}`);
      button.append(thumbnail(design, 72));
      slot.append(button);
    }
  }
  listenForPicks(box);
  box.addEventListener("click", (event) => {
    const button = event.target.closest("[data-family]");
    if (!button) return;
    const family = families.find((f) => f.letter === button.dataset.family);
    state.family = state.family === family ? null : family;
    changed("limits");
  });
  events.on("limits.families", () => {
    for (const button of box.querySelectorAll("[data-family]")) {
      const active = state.family?.letter === button.dataset.family;
      button.setAttribute("aria-pressed", String(active));
      button.closest("tr").classList.toggle("picked", active);
    }
  });
  refresh();
}
