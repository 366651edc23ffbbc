// node page_test.mjs [--short] [LESSON]: opens build/web/hemitex.html from disk in headless Chromium, goes to each
// lesson (or to one) by its link and checks it at two sizes of the window, light and dark: canvases are not blank, the
// page is not wider than the window, no message on the console, no request, no serious finding of axe-core. Screenshots
// go to build/web/screenshots. Prints the size of the page, the time to the first picture and that of each lesson.
//
// Checks of one lesson are in lessons/ID.mjs: a module with
//     export default async function check(page, tools) { ... }   // throws where something is wrong
// page: a Playwright page, 1280 x 800, that shows the lesson with the settings that it has without an address.
// tools: equal(found, expected, what)    throws unless JSON.stringify of both is the same
//        close(found, expected, tolerance, what)
//        ok(condition, what)
//        value(name)                     the text of status(..., name)
//        until(condition, what)          waits until the async function `condition` returns true; at most 20 s
//        open(settings)                  loads the lesson anew with settings as in its address, for example "x=3&y=4"
//        address()                       the settings in the address, for example "x=3&y=4"
//        run(...arguments)               what the command line prints; its folder is the repository. The program is
//                                        that of the environment's HEMITEX, otherwise build/release/bin/hemitex
//        formFactors(...options)         the form factors that hemitex formfactors writes for the Cornell box
//        folder                          a folder for files, which is removed after the checks
//        isShort                         whether to leave out what repeats a check with another example (--short)
//        answers([[answer, verdict] ...]) gives answers to the question, numbers or labels of options, and checks how
//                                        the verdicts begin
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync} from "node:fs";
import {createRequire} from "node:module";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {fileURLToPath, pathToFileURL} from "node:url";
import {gzipSync} from "node:zlib";

const tests = fileURLToPath(new URL(".", import.meta.url));
const top = join(tests, "../..");
const requireFromWeb = createRequire(join(top, "web/package.json"));
const {chromium} = requireFromWeb("playwright-core");
const file = join(top, "build/web/hemitex.html");
const url = pathToFileURL(file).href;
const screenshots = join(top, "build/web/screenshots");
const windows = [
  {viewport: {width: 1280, height: 800}, colorScheme: "light"},
  {viewport: {width: 390, height: 844}, colorScheme: "dark"},
];
const isShort = process.argv[2] === "--short";
const only = process.argv[isShort ? 3 : 2];
const hemitex = process.env.HEMITEX ?? join(top, "build/release/bin/hemitex");

async function until(condition, what) {
  const end = Date.now() + 180000;  // only a page that hangs takes longer, on a busy machine too
  while (!(await condition())) {
    assert.ok(Date.now() < end, `waited in vain: ${what}`);
    await new Promise((done) => setTimeout(done, 50));
  }
}

const run = (...args) => execFileSync(hemitex, args, {cwd: top, encoding: "utf8"});

function formFactors(...options) {
  const table = run("formfactors", "data/cornell-box.obj", "-q", ...options);
  const [head, ...lines] = table.trim().split("\n").map((line) => line.split(","));
  return lines.map((line) => Number(line[head.indexOf("form_factor")]));
}

async function answers(page, expected) {
  const field = page.getByLabel("Answer:");
  for (const [answer, verdict] of expected) {
    if (await field.count()) await field.fill(String(answer));
    else await page.getByLabel(answer, {exact: true}).check();
    await page.getByRole("button", {name: "Check"}).click();
    const found = await page.getByTestId("verdict").innerText();
    assert.ok(found.startsWith(verdict), `answer ${answer}: ${found}`);
  }
}

function toolsOf(page, id, folder) {
  return {
    equal: (found, expected, what) => assert.equal(JSON.stringify(found), JSON.stringify(expected), what),
    close: (found, expected, tolerance, what) =>
      assert.ok(Math.abs(found - expected) <= tolerance, `${what}: ${found}, expected ${expected}`),
    ok: (condition, what) => assert.ok(condition, what),
    value: (name) => page.getByTestId(name).innerText(),
    until,
    open: async (settings) => {
      await page.goto("about:blank");
      await page.goto(`${url}#${id}&${settings}`);
      await shown(page, id);
    },
    address: () => new URL(page.url()).hash.split("&").slice(1).join("&"),
    run,
    formFactors,
    folder,
    isShort,
    answers: (expected) => answers(page, expected),
  };
}

const shown = (page, id) => page.locator(`main[data-shown="${id}"]`).waitFor({timeout: 180000});

/** A page whose console messages, errors and requests are kept. */
async function openPage(browser, window) {
  const page = await browser.newPage(window);
  page.noise = [];
  page.on("console", (message) => page.noise.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => page.noise.push(`error: ${error.message}`));
  page.on("request", (request) => {
    if (![url, "about:blank"].includes(request.url().split("#")[0]) && !/^(data|blob):/.test(request.url()))
      page.noise.push(`request: ${request.url()}`);
  });
  await page.goto(url);
  await shown(page, "start");
  return page;
}

/** Whether all pixels of a screenshot have the same colour; the browser decodes it. */
function isBlank(page, png) {
  return page.evaluate(async (base64) => {
    const image = new Image();
    image.src = `data:image/png;base64,${base64}`;
    await image.decode();
    const {width, height} = image;
    const context = new OffscreenCanvas(width, height).getContext("2d");
    context.drawImage(image, 0, 0);
    const pixels = new Uint32Array(context.getImageData(0, 0, width, height).data.buffer);
    return pixels.every((pixel) => pixel === pixels[0]);
  }, png.toString("base64"));
}

async function checkCanvases(page) {
  for (const canvas of await page.locator("canvas:visible").all()) {
    const label = await canvas.getAttribute("aria-label");
    await until(async () => !(await isBlank(page, await canvas.screenshot())), `canvas "${label}" shows something`);
  }
}

async function checkWidth(page) {
  const [content, available] = await page.evaluate(() => {
    const {scrollWidth, clientWidth} = document.documentElement;
    return [scrollWidth, clientWidth];
  });
  assert.ok(content <= available, `${content} pixels wide in a window of ${available}`);
}

async function checkAccessibility(page) {
  await page.evaluate(readFileSync(requireFromWeb.resolve("axe-core/axe.min.js"), "utf8"));
  const {violations} = await page.evaluate(() => globalThis.axe.run());
  const serious = violations.filter(({impact}) => ["serious", "critical"].includes(impact));
  const texts = serious.flatMap(({id, nodes}) => nodes.map(({html}) => `${id}: ${html.slice(0, 200)}`));
  assert.equal(texts.join("\n"), "");
}

/** The checks of one lesson, if there are any. */
async function checkContent(page, id) {
  const file = join(tests, "lessons", `${id}.mjs`);
  if (!existsSync(file)) return;
  const folder = mkdtempSync(join(tmpdir(), "hemitex-"));
  try {
    await (await import(file)).default(page, toolsOf(page, id, folder));
  } finally {
    rmSync(folder, {recursive: true});
  }
}

async function checkLesson(page, id) {
  const {width, height} = page.viewportSize();
  const start = Date.now();
  await page.evaluate(() => delete document.querySelector("main").dataset.shown);
  await page.locator(`header a[href="#${id}"]`).click();
  await shown(page, id);
  await checkCanvases(page);
  await page.evaluate(() => scrollTo(0, 0));
  await page.screenshot({path: join(screenshots, `${id}-${width}.png`), fullPage: true});
  const alert = await page.locator("#alert").innerText();
  assert.equal(alert, "");
  await checkWidth(page);
  await checkAccessibility(page);
  if (width === windows[0].viewport.width) await checkContent(page, id);
  assert.equal(page.noise.join("\n"), "");
  const content = await page.evaluate(() => document.documentElement.scrollHeight);
  const seconds = Math.round((Date.now() - start) / 1000);
  console.log(`ok ${id} ${width} x ${height}: ${content} pixels high, checked in ${seconds} s`);
}

mkdirSync(screenshots, {recursive: true});
const page = readFileSync(file);
console.log(`page: ${page.length} bytes, ${gzipSync(page, {level: 9}).length} compressed`);
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--enable-unsafe-webgpu"],
});
let failures = 0;
for (const window of windows) {
  const page = await openPage(browser, window);
  await page.waitForFunction(() => performance.getEntriesByName("first picture").length);
  const time = await page.evaluate(() => performance.getEntriesByName("first picture")[0].startTime);
  console.log(`first picture after ${Math.round(time)} ms`);
  const links = await page.locator("header a").evaluateAll((all) => all.map((link) => link.hash.slice(1)));
  for (const id of links.filter((link) => !only || link === only)) {
    try {
      await checkLesson(page, id);
    } catch (error) {
      ++failures;
      console.error(`FAIL ${id} ${window.viewport.width}: ${error.message}`);
    }
    page.noise.length = 0;
  }
  await page.close();
}
await browser.close();
process.exit(failures ? 1 : 0);
