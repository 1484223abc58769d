// Parallel coordinates: one axis per objective, small values at the foot. A brush on an axis is a limit.

function startParallel() {
  const box = byId("parallel");
  const svg = d3.select(box).append("svg");
  const back = svg.append("g").attr("class", "lines");
  const marks = svg.append("g").attr("class", "marks").attr("aria-hidden", "true");
  const axes = svg.append("g");
  const margin = { top: 56, right: 46, bottom: 22, left: 46 };
  let x, scales, silent = false;

  function layout() {
    const width = Math.max(300, box.clientWidth), height = Math.max(260, Math.min(380, width * 0.42));
    const narrow = width < 620;
    svg.attr("viewBox", [0, 0, width, height]).attr("width", width).attr("height", height);
    x = d3.scalePoint(objectives.map((_, i) => i), [narrow ? 42 : margin.left, width - (narrow ? 26 : margin.right)]);
    scales = objectives.map((o) => d3.scaleLinear([o.least, o.most === o.least ? o.least + 1 : o.most], [height - margin.bottom, margin.top]));
    drawAxes(height, narrow);
    drawLines();
  }

  // In a narrow window the outer titles keep inside the picture.
  const last = objectives.length - 1;
  const anchor = (i, narrow) => (narrow && last > 0 && i === 0 ? "start" : narrow && last > 0 && i === last ? "end" : "middle");
  const edge = (i, narrow) => ({ start: -30, end: 24, middle: 0 })[anchor(i, narrow)];
  function drawAxes(height, narrow) {
    axes.selectAll("*").remove();
    const axis = axes.selectAll("g.axis").data(objectives).join("g").attr("class", "axis").attr("transform", (_, i) => `translate(${x(i)},0)`);
    axis.each(function each(_, i) {
      d3.select(this).call(d3.axisLeft(scales[i]).ticks(narrow ? 4 : 6).tickSize(4).tickFormat(ticksOf(scales[i], narrow ? 4 : 6)));
    });
    // A ground under each label, so that no line crosses it.
    axis.selectAll(".tick").each(function each() {
      const { x: left, y: top, width, height } = this.querySelector("text").getBBox();
      d3.select(this).insert("rect", "text").attr("class", "ground").attr("x", left - 2).attr("y", top).attr("width", width + 4).attr("height", height);
    });
    const title = axis.append("text").attr("class", "axis-title").attr("y", 14).attr("text-anchor", (_, i) => anchor(i, narrow)).attr("x", (_, i) => edge(i, narrow));
    title.selectAll("tspan").data((o, i) => (narrow ? o.label.split(" ") : [o.label]).map((text) => ({ text, x: edge(i, narrow) }))).join("tspan")
      .attr("x", (line) => line.x).attr("dy", (_, i) => (i ? "1.15em" : 0)).text((line) => line.text);
    title.append("tspan").attr("class", "unit").attr("x", (_, i) => edge(i, narrow)).attr("dy", "1.2em").text((o) => o.unit || "–");
    title.append("title").text((o) => o.meaning);
    axis.each(function each(o, i) {
      const brush = d3.brushY().extent([[-15, margin.top - 6], [15, height - margin.bottom + 6]]).on("brush end", (event) => {
        if (silent || !event.sourceEvent) return;
        setLimit(o, event.selection && [scales[i].invert(event.selection[1]), scales[i].invert(event.selection[0])]);
        changed("limits");
      });
      d3.select(this).append("g").attr("class", "brush").attr("data-objective", o.column).call(brush).each(function keep() { this.brushOf = { brush, i }; });
    });
    syncBrushes();
  }

  /** Shows limits that were set elsewhere. */
  function syncBrushes() {
    silent = true;
    axes.selectAll("g.brush").each(function each(o) {
      const { brush, i } = this.brushOf, limit = drawnLimit(o), [low, high] = scales[i].range();
      const clip = (v) => Math.max(high - 5, Math.min(low + 5, scales[i](v)));
      d3.select(this).call(brush.move, limit ? [clip(limit[1]), clip(limit[0])] : null);
    });
    silent = false;
  }

  const path = (d) => d3.line().defined(([, y]) => y !== null)(objectives.map((o, i) => [x(i), known(value(d, o)) ? scales[i](value(d, o)) : null]));
  function drawLines() {
    svg.classed("few", frontDesigns.length <= 40);
    back.selectAll("path").data(frontDesigns.filter((d) => !d.baseline), (d) => d.id).join("path").attr("d", path);
    restyle();
  }
  function restyle() {
    back.selectAll("path").attr("class", (d) => (kept(d) ? "kept" : "dropped")).style("stroke", (d) => (kept(d) ? paintOf(d) : null))
      .filter(kept).raise();
    highlight();
  }
  function highlight() {
    const rows = [[designs.find((d) => d.baseline), "baseline"], [state.hovered, "hovered"], [state.picked, "picked"]].filter(([d]) => d);
    marks.selectAll("path").data(rows).join("path").attr("class", ([, kind]) => kind).attr("d", ([d]) => path(d));
    marks.selectAll("circle").data(objectives.filter((o) => known(value(state.picked, o)))).join("circle")
      .attr("class", "picked").attr("r", 3.5).attr("cx", (o) => x(objectives.indexOf(o))).attr("cy", (o) => scales[objectives.indexOf(o)](value(state.picked, o)));
  }

  /** The kept design whose line passes nearest to the pointer. */
  function nearest(event) {
    const [px, py] = d3.pointer(event, svg.node());
    let best = null, gap = 9;
    for (let i = 0; i + 1 < objectives.length; i += 1) {
      if (px < x(i) || px > x(i + 1)) continue;
      const t = (px - x(i)) / (x(i + 1) - x(i));
      for (const d of designs) {
        if (!d.baseline && !kept(d)) continue;
        const [a, b] = [value(d, objectives[i]), value(d, objectives[i + 1])];
        if (!known(a) || !known(b)) continue;
        const off = Math.abs(scales[i](a) * (1 - t) + scales[i + 1](b) * t - py);
        if (off < gap) { gap = off; best = d; }
      }
    }
    return best;
  }
  svg.on("pointermove", (event) => {
    if (event.buttons) return;
    const found = nearest(event);
    hover(found);
    if (found) showTip(event, designTip(found)); else hideTip();
  }).on("pointerleave", () => { hover(null); hideTip(); })
    .on("click", (event) => { if (!event.target.closest(".brush")) pick(nearest(event)); });

  events.on("limits.parallel", () => { syncBrushes(); restyle(); });
  events.on("paint.parallel", restyle);
  events.on("pick.parallel", highlight);
  events.on("hover.parallel", highlight);
  onWidth(box, layout);
}

/** Runs now and whenever the width of an element changes. */
function onWidth(element, layout) {
  let width = -1;
  new ResizeObserver(() => {
    if (element.clientWidth === width || !element.clientWidth) return;
    width = element.clientWidth;
    layout();
  }).observe(element);
  width = element.clientWidth;
  layout();
}
