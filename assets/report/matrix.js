// Scatter matrix: points below the diagonal, histograms on it, rank correlations above it. A rectangle limits both its objectives.

function startMatrix() {
  const box = byId("matrix");
  const n = objectives.length;
  if (n < 2) { box.hidden = true; return; }
  const svg = d3.select(box).append("svg");
  const shown = designs.filter((d) => d.onFront || d.baseline);
  const correlation = (a, b) => spearman(frontDesigns.map((d) => [value(d, a), value(d, b)]).filter(([u, v]) => known(u) && known(v)));
  let cell, inset, scales, cells;

  function layout() {
    const left = 52, bottom = 40;
    const width = Math.max(box.clientWidth, Math.min(n * 88 + left, 900));
    cell = (width - left - 4) / n;
    inset = Math.max(6, cell * 0.07);
    const height = n * Math.min(cell, 170) + bottom;
    const rowHeight = Math.min(cell, 170);
    svg.attr("viewBox", [0, 0, width, height]).attr("width", width).attr("height", height);
    svg.selectAll("*").remove();
    scales = objectives.map((o) => {
      const domain = [o.least, o.most === o.least ? o.least + 1 : o.most];
      return { x: d3.scaleLinear(domain, [inset, cell - inset]), y: d3.scaleLinear(domain, [rowHeight - inset, inset]) };
    });
    const at = (row, column) => svg.append("g").attr("transform", `translate(${left + column * cell},${row * rowHeight})`);
    cells = [];
    for (let row = 0; row < n; row += 1) {
      for (let column = 0; column < n; column += 1) {
        const g = at(row, column);
        g.append("rect").attr("class", "cell").attr("width", cell).attr("height", rowHeight);
        if (row === column) histogram(g, row, rowHeight);
        else if (row > column) scatter(g, row, column, rowHeight);
        else upper(g, row, column, rowHeight);
      }
    }
    drawTicks(left, rowHeight);
    restyle();
  }

  function drawTicks(left, rowHeight) {
    for (let k = 0; k < n; k += 1) {
      if (k < n - 1) svg.append("g").attr("class", "axis").attr("transform", `translate(${left + k * cell},${n * rowHeight})`)
        .call(d3.axisBottom(scales[k].x).tickValues(sparse(scales[k].x, cell)).tickSize(4).tickFormat(ticksOf(scales[k].x)));
      svg.append("text").attr("class", "axis-title").attr("text-anchor", "middle").attr("x", left + (k + 0.5) * cell).attr("y", n * rowHeight + 33)
        .text(cell < 110 ? objectives[k].label : unitLabel(objectives[k]));
      if (k > 0) svg.append("g").attr("class", "axis").attr("transform", `translate(${left},${k * rowHeight})`)
        .call(d3.axisLeft(scales[k].y).ticks(3).tickSize(4).tickFormat(ticksOf(scales[k].y)));
    }
  }

  function histogram(g, k, rowHeight) {
    const o = objectives[k];
    const bins = d3.bin().domain(scales[k].x.domain()).thresholds(scales[k].x.ticks(14))(frontDesigns.map((d) => value(d, o)).filter(known));
    const tall = d3.scaleLinear([0, d3.max(bins, (b) => b.length) || 1], [rowHeight - inset, 24]);
    g.append("g").attr("class", "histogram").selectAll("rect").data(bins).join("rect")
      .attr("x", (b) => scales[k].x(b.x0) + 0.5).attr("width", (b) => Math.max(0, scales[k].x(b.x1) - scales[k].x(b.x0) - 1))
      .attr("y", (b) => tall(b.length)).attr("height", (b) => rowHeight - inset - tall(b.length))
      .append("title").text((b) => `${plural(b.length, "design")}: ${o.label} ${number(b.x0)} to ${withUnit(b.x1, o)}`);
    g.append("text").attr("class", "axis-title").attr("x", cell / 2).attr("y", 16).attr("text-anchor", "middle").text(o.label);
  }

  function upper(g, row, column, rowHeight) {
    const r = correlation(objectives[row], objectives[column]);
    g.select("rect").style("fill", known(r) ? d3.interpolateRgbBasis(["#ec9a5c", "#f7f5ef", "#7db9dc"])((r + 1) / 2) : null).style("fill-opacity", 0.6).classed("coloured", known(r));
    g.append("text").attr("class", "correlation").attr("x", cell / 2).attr("y", rowHeight / 2 + 5).attr("text-anchor", "middle")
      .text(known(r) ? `${r < -0.005 ? "−" : "+"}${Math.abs(r).toFixed(2)}` : "–")
      .append("title").text(`${objectives[row].label} and ${objectives[column].label}`);
  }

  function scatter(g, row, column, rowHeight) {
    const [ox, oy] = [objectives[column], objectives[row]], { x } = scales[column], { y } = scales[row];
    const points = shown.filter((d) => known(value(d, ox)) && known(value(d, oy)));
    g.append("rect").attr("class", "limit");
    g.append("g").attr("class", "points").selectAll("path").data(points, (d) => d.id).join("path")
      .attr("transform", (d) => `translate(${x(value(d, ox))},${y(value(d, oy))})`);
    const near = (event) => {
      const [px, py] = d3.pointer(event, g.node());
      const found = d3.least(points.filter((d) => d.baseline || kept(d)), (d) => Math.hypot(x(value(d, ox)) - px, y(value(d, oy)) - py));
      return found && Math.hypot(x(value(found, ox)) - px, y(value(found, oy)) - py) < 12 ? found : null;
    };
    // By touch a drag scrolls the page, a tap picks; limits are set on the axes above.
    const brush = d3.brush().touchable(false).extent([[1, 1], [cell - 1, rowHeight - 1]]).on("end", (event) => {
      if (!event.sourceEvent) return;
      if (!event.selection) { pick(near(event.sourceEvent)); return; }
      const [[x0, y0], [x1, y1]] = event.selection;
      setLimit(ox, [x.invert(x0), x.invert(x1)]);
      setLimit(oy, [y.invert(y1), y.invert(y0)]);
      area.call(brush.move, null);
      changed("limits");
    });
    const area = g.append("g").attr("class", "brush").attr("data-pair", `${ox.column} ${oy.column}`).call(brush);
    area.on("pointermove.tip", (event) => {
      if (event.buttons) return;
      const found = near(event);
      hover(found);
      if (found) showTip(event, designTip(found)); else hideTip();
    }).on("pointerleave.tip", () => { hover(null); hideTip(); });
    cells.push({ g, ox, oy, x, y, rowHeight });
  }

  // Shape as well as colour tells baseline and picked design from the others.
  const shape = (d) => {
    if (d === state.picked) return d3.symbol(d3.symbolCircle, 90)();
    if (d.baseline) return d3.symbol(d3.symbolDiamond2, 70)();
    return d3.symbol(d3.symbolCircle, d === state.hovered ? 70 : 16)();
  };
  const kind = (d) => (d === state.picked ? "picked" : d.baseline ? "baseline" : d === state.hovered ? "hovered" : kept(d) ? "kept" : "dropped");
  function restyle() {
    for (const { g, ox, oy, x, y } of cells) {
      g.select(".points").selectAll("path").attr("class", kind).attr("d", shape).style("fill", (d) => (kind(d) === "kept" ? paintOf(d) : null))
        .filter((d) => kind(d) === "kept").raise();
      g.select(".points").selectAll("path.baseline, path.hovered, path.picked").raise();
      drawLimit(g, ox, oy, x, y);
    }
  }
  function drawLimit(g, ox, oy, x, y) {
    const [lx, ly] = [drawnLimit(ox), drawnLimit(oy)];
    const clip = (v, [a, b]) => Math.max(Math.min(a, b) - 4, Math.min(Math.max(a, b) + 4, v));
    const [x0, x1] = (lx ?? x.domain()).map((v) => clip(x(v), x.range()));
    const [y1, y0] = (ly ?? y.domain()).map((v) => clip(y(v), y.range()));
    g.select(".limit").attr("visibility", lx || ly ? "visible" : "hidden").attr("x", x0).attr("width", Math.max(0, x1 - x0)).attr("y", y0).attr("height", Math.max(0, y1 - y0));
  }
  let before = [null, null];
  function highlight() {
    const touched = new Set([...before, state.hovered, state.picked].filter(Boolean));
    before = [state.hovered, state.picked];
    for (const { g } of cells) {
      g.select(".points").selectAll("path").filter((d) => touched.has(d)).attr("class", kind).attr("d", shape)
        .style("fill", (d) => (kind(d) === "kept" ? paintOf(d) : null)).filter((d) => kind(d) !== "kept" && kind(d) !== "dropped").raise();
    }
  }
  events.on("limits.matrix", restyle);
  events.on("paint.matrix", restyle);
  events.on("pick.matrix", highlight);
  events.on("hover.matrix", highlight);
  onWidth(box, layout);
}

/** Ticks whose labels, at 7 pixels a digit, neither touch one another nor leave their cell. */
function sparse(scale, width) {
  const values = [4, 3, 2, 1].map((count) => scale.ticks(count)).find((ticks) => {
    const format = ticksOf(scale), half = d3.max(ticks, (v) => format(v).length) * 3.5;
    const room = [0, ...ticks.map(scale), width];
    return d3.pairs(room).every(([a, b], gap) => b - a > (gap === 0 || gap === ticks.length ? half : 2 * half + 4));
  });
  return values ?? [d3.median(scale.domain())];
}

/** Rank correlation of pairs; ties share their mean rank. Null for fewer than five pairs or a constant. */
function spearman(pairs) {
  if (pairs.length < 5) return null;
  const ranks = [0, 1].map((k) => {
    const order = d3.sort(d3.range(pairs.length), (i) => pairs[i][k]), rank = new Array(pairs.length);
    for (let i = 0; i < order.length;) {
      let j = i;
      while (j < order.length && pairs[order[j]][k] === pairs[order[i]][k]) j += 1;
      for (let m = i; m < j; m += 1) rank[order[m]] = (i + j - 1) / 2;
      i = j;
    }
    return rank;
  });
  const [ma, mb] = ranks.map((r) => d3.mean(r));
  const cov = d3.sum(pairs, (_, i) => (ranks[0][i] - ma) * (ranks[1][i] - mb));
  const spread = Math.sqrt(d3.sum(ranks[0], (r) => (r - ma) ** 2) * d3.sum(ranks[1], (r) => (r - mb) ** 2));
  return spread > 0 ? cov / spread : null;
}
