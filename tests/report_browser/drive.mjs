// Drives report.html in headless Chromium, offline: brush, pick, turn, toggle, keyboard, print. Fails loudly.
// node drive.mjs [folder of pages] [--shots folder]     (see README.md)

import assert from "node:assert/strict";
import { mkdirSync, statSync } from "node:fs";
import { resolve } from "node:path";
import { launch, open } from "./browser.mjs";

const folder = resolve(process.argv[2] ?? "../../target/report");
const shots = process.argv.includes("--shots") ? resolve(process.argv[process.argv.indexOf("--shots") + 1]) : null;
if (shots) mkdirSync(shots, { recursive: true });
const LOADED_WITHIN_MS = 3000;

const browser = await launch();
let failed = 0;
async function check(name, test) {
  try {
    const note = await test();
    console.log(`ok    ${name}${note ? ` (${note})` : ""}`);
  } catch (error) {
    failed += 1;
    console.log(`FAIL  ${name}\n${error.stack ?? error}`);
  }
}

const text = (page, selector) => page.textContent(selector);
const keptOf = async (page) => (await text(page, "#kept")).match(/^[\d\u202f]+/)[0].replace("\u202f", "");
/** What the 3D picture holds now. */
const picture = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(document.getElementById("scene").toDataURL())))));
async function drag(page, box, from, to) {
  await page.mouse.move(box.x + from[0] * box.width, box.y + from[1] * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + to[0] * box.width, box.y + to[1] * box.height, { steps: 6 });
  await page.mouse.up();
}

const large = `${folder}/large.html`;
await check("opens in time, best of three", async () => {
  const times = [];
  for (let i = 0; i < 3; i += 1) {
    const { page, milliseconds, problems } = await open(browser, large);
    const session = await page.context().newCDPSession(page);
    await session.send("Performance.enable");
    const { metrics } = await session.send("Performance.getMetrics");
    times.push({ wall: Math.round(milliseconds), cpu: Math.round(1000 * metrics.find((m) => m.name === "ProcessTime").value) });
    assert.deepEqual(problems, []);
    await page.context().close();
  }
  const words = times.map(({ wall, cpu }) => `${wall} ms (CPU ${cpu} ms)`).join(", ");
  // On a busy machine the clock says little: the page's own CPU time is the bound.
  assert.ok(Math.min(...times.map(({ cpu }) => cpu)) <= LOADED_WITHIN_MS, words);
  return `${words} until everything is drawn, ${(statSync(large).size / 1e6).toFixed(1)} MB`;
});

const { page, problems } = await open(browser, large);

await check("starts with the whole front and a picture", async () => {
  assert.equal(await keptOf(page), "200");
  assert.equal(await page.locator("#gallery li:not([hidden])").count(), 201);
  assert.equal(await page.locator("#table tbody tr").count(), 201);
  const colours = await page.evaluate(() => {
    const canvas = document.getElementById("scene"), copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer)).size;
  });
  assert.ok(colours > 50, `${colours} colours in the picture`);
});

await check("a brush on an axis limits lines, points, pictures and table alike", async () => {
  const axis = page.locator('#parallel g.brush[data-objective="deflection_m"] .overlay');
  await axis.scrollIntoViewIfNeeded();
  await drag(page, await axis.boundingBox(), [0.5, 0.98], [0.5, 0.55]);
  const n = Number(await keptOf(page));
  assert.ok(n > 0 && n < 200, `${n} kept`);
  assert.equal(await page.locator("#parallel .lines path.kept").count(), n);
  assert.equal(await page.locator("#gallery li:not([hidden])").count(), n + 1);
  assert.equal(await page.locator("#table tbody tr").count(), n + 1);
  const points = await page.locator("#matrix .points").first().locator("path.dropped").count();
  assert.ok(points >= 200 - n - 1, `${points} points dropped`);
  assert.ok(await page.locator("#gallery li:not([hidden]) button", { hasText: "Baseline" }).count(), "baseline always shown");
});

await check("a rectangle in the matrix limits two objectives; Clear gives all back", async () => {
  await page.click("#clear");
  assert.equal(await keptOf(page), "200");
  const cell = page.locator('#matrix g.brush[data-pair="deflection_m curvature"] .overlay');
  await cell.scrollIntoViewIfNeeded();
  await drag(page, await cell.boundingBox(), [0.05, 0.4], [0.6, 0.95]);
  const n = Number(await keptOf(page));
  assert.ok(n > 0 && n < 200, `${n} kept`);
  assert.equal(await page.locator("#parallel .brush .selection").evaluateAll((all) => all.filter((s) => s.style.display !== "none").length), 2);
  await page.click("#clear");
  assert.equal(await keptOf(page), "200");
});

await check("limits by numbers do the same", async () => {
  await page.click("details.limits summary");
  const [least, most] = ["least", "most"].map((end) => page.locator(`input[aria-label="${end} Skewness"]`));
  await most.fill("0.2000001");
  await page.keyboard.press("Enter");
  const n = Number(await keptOf(page));
  assert.ok(n > 0 && n < 200, `${n} kept`);
  // What was typed stays, an end that was not given is no limit, and a negative number empties no field.
  assert.deepEqual([await least.inputValue(), await most.inputValue()], ["", "0.2000001"]);
  await least.fill("-0.5");
  await page.keyboard.press("Enter");
  assert.equal(Number(await keptOf(page)), n);
  assert.deepEqual([await least.inputValue(), await most.inputValue()], ["-0.5", "0.2000001"]);
  await page.click("#clear");
  await page.click("details.limits summary");
});

await check("a click on a picture, a point and an identifier picks the design everywhere", async () => {
  const button = page.locator("#gallery li:not([hidden]) button").nth(4);
  const id = await button.getAttribute("data-design");
  await button.click();
  assert.equal(await text(page, "#viewer-title"), `Design ${id}`);
  assert.equal(await page.locator("#table tr.picked").getAttribute("data-row"), id);
  assert.equal(await page.evaluate(() => location.hash), `#design-${id}`);
  await page.locator("#table [data-pick]").nth(7).click();
  assert.notEqual(await text(page, "#viewer-title"), `Design ${id}`);
  const cell = page.locator('#matrix g.brush[data-pair="deflection_m utilisation"] .overlay');
  await cell.scrollIntoViewIfNeeded();
  const point = await page.locator("#matrix .points").first().locator("path.kept").nth(60).boundingBox();
  await page.mouse.click(point.x + point.width / 2, point.y + point.height / 2);
  assert.match(await text(page, "#viewer-title"), /^Design q[0-9a-f]{12}$/);
});

await check("mouse, touch-like drags and keys turn the picture", async () => {
  const scene = page.locator("#scene");
  await scene.scrollIntoViewIfNeeded();
  const before = await picture(page);
  await drag(page, await scene.boundingBox(), [0.4, 0.5], [0.6, 0.6]);
  const turned = await picture(page);
  assert.notEqual(turned, before);
  await scene.focus();
  await page.keyboard.press("ArrowLeft");
  const keyed = await picture(page);
  assert.notEqual(keyed, turned);
  await page.keyboard.press("+");
  assert.notEqual(await picture(page), keyed);
  await page.mouse.wheel(0, 200);
  await page.keyboard.press("0");
  await page.click('[data-view="plan"]');
  assert.notEqual(await picture(page), before);
  await page.click('[data-view="tilted"]');
});

await check("colours change the picture and the legend", async () => {
  let last = await picture(page);
  for (const [key, words] of [["skewness", "Panel skewness"], ["utilisation", "Member utilisation"], ["none", "Singular"], ["curvature", "Panel curvature"]]) {
    await page.check(`input[name=field][value=${key}]`);
    const now = await picture(page);
    assert.notEqual(now, last, key);
    assert.match(await text(page, "#legend"), new RegExp(words));
    last = now;
  }
});

await check("stays fluid while it turns", async () => {
  const frames = await page.evaluate(async () => {
    const scene = document.getElementById("scene"), spent = [];
    for (let i = 0; i < 30; i += 1) {
      const start = performance.now();
      scene.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
      await new Promise((done) => requestAnimationFrame(() => done()));
      spent.push(performance.now() - start);
    }
    return spent.sort((a, b) => a - b);
  });
  assert.ok(frames[15] < 500, `median ${frames[15]} ms`);
  return `median ${frames[15].toFixed(1)} ms a frame, software rendering`;
});

await check("shortlist, table order, numbers and family filter", async () => {
  const columns = await page.locator("#shortlist th.pic").count();
  await page.click("#next");
  if ((await page.getAttribute("#pin", "aria-pressed")) === "false") await page.click("#pin");
  assert.ok((await page.locator("#shortlist th.pic").count()) >= columns);
  assert.ok((await page.locator("#shortlist td.best").count()) > 0, "the smallest is marked");
  await page.click('#table [data-sort="0"]');
  assert.equal(await page.locator('#table th[aria-sort="ascending"]').count(), 1);
  await page.check('input[name=numbers][value="absolute"]');
  await page.locator("#families [data-family]").nth(1).click();
  const n = Number(await keptOf(page));
  assert.ok(n > 0 && n < 200);
  await page.click("#clear");
});

await check("keyboard alone reaches a design", async () => {
  await page.locator("#gallery button").nth(2).focus();
  await page.keyboard.press("Enter");
  assert.equal(await page.locator("#gallery button[aria-pressed=true]").count(), 1);
  const unnamed = await page.evaluate(() => [...document.querySelectorAll("button, input, select, [tabindex='0'], canvas[role]")]
    .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.closest("label") || e.getAttribute("aria-labelledby"))).map((e) => e.outerHTML.slice(0, 80)))
  assert.deepEqual(unnamed.filter((html) => !html.includes('id="config"')), []);
});

await check("prints", async () => {
  const pdf = await page.pdf({ preferCSSPageSize: true, ...(shots ? { path: `${shots}/print.pdf` } : {}) });
  assert.ok(pdf.length > 100_000);
  return `${(pdf.length / 1e6).toFixed(1)} MB`;
});

await check("no error on the console, no request, all along", async () => assert.deepEqual(problems, []));
await page.context().close();

await check("without a feasible design the page says what stood in the way and draws the nearest misses", async () => {
  const { page: missed, problems: wrong } = await open(browser, `${folder}/missed.html`);
  assert.equal(await missed.locator("#front").isHidden(), true);
  assert.equal(await missed.locator("#obstacles tbody tr").count(), 4);
  // The initial mesh, and six others.
  assert.equal(await missed.locator("#misses tbody tr").count(), 7);
  assert.equal(await missed.locator("#misses canvas.thumb").count(), 7);
  const before = await picture(missed);
  await missed.locator("#misses tbody tr").nth(3).locator("button.bare").click();
  assert.notEqual(await picture(missed), before);
  assert.match(await text(missed, "#picked-values"), /Not feasible: min_edge_m/);
  assert.equal(await missed.locator("#misses tr.picked").count(), 1);
  await missed.click("#next");
  if (shots) await missed.screenshot({ path: `${shots}/missed.png`, fullPage: true });
  assert.deepEqual(wrong, []);
  await missed.context().close();
});

for (const name of ["small", "bare", "empty"]) {
  await check(`${name}.html opens without error`, async () => {
    const { page: other, problems: wrong } = await open(browser, `${folder}/${name}.html`);
    assert.deepEqual(wrong, []);
    await other.context().close();
  });
}

for (const [width, options] of [[1600, {}], [480, { hasTouch: true, isMobile: true, deviceScaleFactor: 2 }]]) {
  await check(`nothing sticks out at ${width} px`, async () => {
    const { page: view, problems: wrong } = await open(browser, large, { viewport: { width, height: 1000 }, ...options });
    assert.equal(await view.evaluate(() => document.documentElement.scrollWidth), width);
    if (options.hasTouch) await view.locator("#gallery button").nth(3).tap();
    if (shots) await view.screenshot({ path: `${shots}/${width}.png`, fullPage: true });
    assert.deepEqual(wrong, []);
    await view.context().close();
  });
}

await check("without WebGL the design is shown in plan", async () => {
  const context = await browser.newContext({ offline: true });
  const plain = await context.newPage();
  await plain.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function getContext(kind, ...rest) { return kind === "webgl" ? null : original.call(this, kind, ...rest); };
  });
  await plain.goto(`file://${folder}/small.html`);
  await plain.waitForFunction(() => document.documentElement.dataset.ready === "true");
  assert.match(await text(plain, "#stage-note"), /plan/);
  await context.close();
});

await browser.close();
console.log(failed ? `${failed} failed` : "all passed");
process.exitCode = failed ? 1 : 0;
