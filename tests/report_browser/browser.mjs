// Starts Chromium without the connections it would make by itself, and offline.

import { chromium } from "playwright-core";

const QUIET = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

/** Longer than a page ever needs, for machines that are busy with something else. */
const PATIENCE_MS = 120_000;

export const launch = () => chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: QUIET, timeout: PATIENCE_MS });

/** Opens a page of the disk; collects console errors, page errors and requests that leave the disk. */
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({ offline: true, viewport: { width: 1600, height: 1000 }, ...options });
  const page = await context.newPage();
  const problems = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && problems.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`exception: ${error.stack ?? error}`));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`request: ${request.url()}`));
  const started = performance.now();
  await page.goto(`file://${file}`, { waitUntil: "load", timeout: PATIENCE_MS });
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true", null, { timeout: PATIENCE_MS })
    .catch(() => problems.push("the page never became ready"));
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return { page, problems, milliseconds: performance.now() - started };
}
