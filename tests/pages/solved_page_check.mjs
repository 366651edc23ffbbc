// node solved_page_check.mjs FOLDER BROWSER PROGRAM: opens FOLDER/report.html in headless Chromium, without a network,
// and uses it with the mouse: the start view must be render.png, a drag must turn the room as `hemitex render` draws it
// from the new camera, and a click must name the surface that a ray through the pixel meets. Keys walk, the slider sets
// the exposure, and the page fits a telephone. Screenshots go to FOLDER.
// Exit code 1 with a message if something differs.
import {execFileSync, spawn} from "node:child_process";
import {mkdtempSync, readFileSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join, resolve} from "node:path";

import {removeProfile} from "../../web/webgl2/browser_profile.mjs";

const [folder, browser, program] = process.argv.slice(2);
const page = "file://" + resolve(folder, "report.html");
const solution = JSON.parse(readFileSync(join(folder, "solution.json")));
const view = JSON.parse(readFileSync(join(folder, "scene.view.json")));
const size = solution.settings.size;

function require(condition, message) {
  if (!condition) throw new Error(message);
}

// The browser, over a pipe: one JSON object per message, with a zero byte behind it.

const profile = mkdtempSync(join(tmpdir(), "hemitex-"));
const chromium = spawn(browser, ["--headless", "--no-sandbox", "--no-first-run", "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader", "--disable-background-networking", "--disable-component-update", "--disable-sync",
  "--host-resolver-rules=MAP * ~NOTFOUND", `--user-data-dir=${profile}`, "--remote-debugging-pipe", "about:blank"],
  {stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"]});
const waiting = new Map(), faults = [];
let received = Buffer.alloc(0), last = 0, session;

function take(message) {
  const {id, method, params, result, error} = message;
  if (id) {
    const {done, failed} = waiting.get(id);
    waiting.delete(id);
    return error ? failed(new Error(error.message)) : done(result);
  }
  if (method === "Runtime.exceptionThrown") faults.push(JSON.stringify(params.exceptionDetails));
  if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type))
    faults.push("console: " + JSON.stringify(params.args));
  if (method === "Log.entryAdded" && params.entry.level === "error") faults.push("log: " + params.entry.text);
  if (method === "Network.requestWillBeSent" && params.request.url !== page && !/^(data|blob):/.test(params.request.url))
    faults.push("request: " + params.request.url);
}

chromium.stdio[4].on("data", data => {
  received = Buffer.concat([received, data]);
  for (let end; (end = received.indexOf(0)) >= 0; received = received.subarray(end + 1))
    take(JSON.parse(received.subarray(0, end)));
});

function send(method, params = {}) {
  const id = ++last;
  chromium.stdio[3].write(JSON.stringify({id, method, params, sessionId: session}) + "\0");
  return new Promise((done, failed) => waiting.set(id, {done, failed}));
}

async function evaluate(expression) {
  const {result, exceptionDetails} = await send("Runtime.evaluate",
                                                {expression, awaitPromise: true, returnByValue: true});
  require(!exceptionDetails, `${expression}: ${JSON.stringify(exceptionDetails)}`);
  return result.value;
}

const pause = milliseconds => new Promise(done => setTimeout(done, milliseconds));

async function open() {
  const {targetInfos} = await send("Target.getTargets");
  const {targetId} = targetInfos.find(({type}) => type === "page");
  ({sessionId: session} = await send("Target.attachToTarget", {targetId, flatten: true}));
  for (const domain of ["Runtime", "Log", "Network", "Page"]) await send(domain + ".enable");
  await send("Emulation.setDeviceMetricsOverride", {width: 1100, height: 1000, deviceScaleFactor: 1, mobile: false});
  await send("Page.navigate", {url: page});
  for (let i = 0; !await evaluate("document.getElementById('drawn') !== null"); ++i) {
    require(i < 1200, "the script of the page did not come to its end");
    await pause(100);
  }
}

// What the page shows.

const boxOf = async selector => JSON.parse(await evaluate(
  `(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.scrollIntoView({block: "center"});
            const {x, y, width, height} = e.getBoundingClientRect(); return JSON.stringify({x, y, width, height}); })()`));

async function screenshot(name) {
  const {x, y, width, height} = await boxOf("#room canvas");
  const scroll = await evaluate("scrollY");
  const {data} = await send("Page.captureScreenshot", {clip: {x, y: y + scroll, width, height, scale: 1}});
  writeFileSync(join(folder, name), Buffer.from(data, "base64"));
  return data;
}

/// The mean difference of two PNG files in 8-bit codes, and the share of codes that differ by more than 24, after both
/// are scaled to the same size.
const differenceOf = async (a, b) => JSON.parse(await evaluate(`(async () => {
  const pixels = async png => {
    const image = new Image();
    image.src = "data:image/png;base64," + png;
    await image.decode();
    const canvas = new OffscreenCanvas(320, Math.round(320 * ${size[1]} / ${size[0]}));
    const context = canvas.getContext("2d");
    context.imageSmoothingQuality = "high";
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  const [first, second] = [await pixels("${a}"), await pixels("${b}")];
  let sum = 0, far = 0;
  for (let i = 0; i < first.length; ++i) {
    const difference = Math.abs(first[i] - second[i]);
    sum += difference;
    far += difference > 24;
  }
  return JSON.stringify({mean: sum / first.length * 4 / 3, far: far / first.length * 4 / 3});
})()`));

const base64Of = file => readFileSync(join(folder, file)).toString("base64");
const close = ({mean, far}) => mean < 1.5 && far < 0.01;

async function mouse(type, x, y, buttons) {
  await send("Input.dispatchMouseEvent", {type, x, y, button: "left", buttons, clickCount: 1});
}

async function click(x, y) {
  await mouse("mousePressed", x, y, 1);
  await mouse("mouseReleased", x, y, 0);
}

async function clickOn(selector) {
  const {x, y, width, height} = await boxOf(selector);
  await click(x + width / 2, y + height / 2);
}

async function drag(fromX, fromY, toX, toY) {
  await mouse("mousePressed", fromX, fromY, 1);
  for (let i = 1; i <= 10; ++i)
    await mouse("mouseMoved", fromX + (toX - fromX) * i / 10, fromY + (toY - fromY) * i / 10, 1);
  await mouse("mouseReleased", toX, toY, 0);
}

/// The camera that the page shows below the room.
async function camera() {
  const [, eye, lookAt] = /--eye (\S+) --look-at (\S+)/.exec(await evaluate("document.getElementById('camera').textContent"));
  return {...view, eye: eye.split(",").map(Number), look_at: lookAt.split(",").map(Number)};
}

// The truth: rays against all triangles of scene.obj.

const minus = (a, b) => a.map((value, i) => value - b[i]);
const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => a.map(value => value / Math.hypot(...a));

function readTriangles() {
  const points = [], triangles = [];
  const surfaces = solution.surfaces.flatMap(({triangles}, s) => Array(triangles).fill(s));
  for (const line of readFileSync(join(folder, "scene.obj"), "utf8").split("\n")) {
    const [keyword, ...words] = line.trim().split(/\s+/);
    if (keyword === "v") points.push(words.slice(0, 3).map(Number));
    if (keyword === "f") triangles.push({surface: surfaces[triangles.length], corners: words.map(word => points[parseInt(word) - 1])});
  }
  return triangles;
}
const triangles = readTriangles();

/// The name of the nearest surface that faces the eye, at a place in [0, 1]^2 of the picture; `none` for the background.
function surfaceAt({eye, look_at, up, fov}, x, y) {
  const forward = unit(minus(look_at, eye)), right = unit(cross(forward, up)), above = cross(right, forward);
  const tangent = Math.tan(fov * Math.PI / 360), a = (2 * x - 1) * tangent * size[0] / size[1], b = (1 - 2 * y) * tangent;
  const ray = forward.map((value, i) => value + a * right[i] + b * above[i]);
  let nearest = Infinity, name = "none";
  for (const {surface, corners: [p, q, r]} of triangles) {
    const normal = cross(minus(q, p), minus(r, p)), slope = dot(normal, ray);
    if (slope >= 0) continue;
    const distance = dot(normal, minus(p, eye)) / slope;
    if (distance <= 0 || distance >= nearest) continue;
    const point = eye.map((value, i) => value + distance * ray[i]);
    const inside = [[p, q], [q, r], [r, p]].every(([s, t]) => dot(cross(minus(t, s), minus(point, s)), normal) >= 0);
    if (inside) [nearest, name] = [distance, solution.surfaces[surface].name];
  }
  return name;
}

/// Clicks at places of the room and compares the names of surfaces. Places near a border between surfaces are left out.
async function checkClicks(what) {
  const seen = new Set(), now = await camera();
  for (const y of [0.12, 0.31, 0.52, 0.67, 0.83, 0.94]) for (const x of [0.14, 0.33, 0.46, 0.63, 0.88]) {
    const expected = surfaceAt(now, x, y);
    const around = [[-1, 0], [1, 0], [0, -1], [0, 1]].map(([i, j]) => surfaceAt(now, x + i / 200, y + j / 200));
    if (around.some(name => name !== expected)) continue;
    const close = await evaluate("document.querySelector('#surface .close') !== null && !document.getElementById('surface').hidden");
    if (close) await clickOn("#surface .close");
    const box = await boxOf("#room canvas");
    await click(box.x + x * box.width, box.y + y * box.height);
    const name = await evaluate("document.getElementById('surface').hidden ? 'none' : document.querySelector('#surface h3').textContent");
    require(name === expected, `${what}: a click at ${x}, ${y} names ${name} instead of ${expected}`);
    seen.add(expected);
  }
  require(seen.size >= 4, `${what}: the clicks meet only ${[...seen]}`);
  if (await evaluate("!document.getElementById('surface').hidden")) await clickOn("#surface .close");
  return seen.size;
}

/// The values that the page shows for a surface are those of solution.json, with four digits.
async function checkValues() {
  const box = await boxOf("#room canvas"), name = surfaceAt(view, 0.5, 0.3);
  await click(box.x + 0.5 * box.width, box.y + 0.3 * box.height);
  const text = await evaluate("document.getElementById('surface').innerText");
  const values = solution.surfaces.find(surface => surface.name === name);
  const short = value => String(Number(value.toPrecision(4)));
  for (const value of [...values.radiosity, ...values.reflectance, ...values.emission, values.area])
    require(text.includes(short(value)), `the values of ${name} lack ${short(value)}: ${text}`);
  await screenshot("page-surface.png");
  await clickOn("#surface .close");
}

async function checkTurn() {
  const box = await boxOf("#room canvas"), before = await screenshot("page-start.png");
  await drag(box.x + 0.5 * box.width, box.y + 0.5 * box.height, box.x + 0.62 * box.width, box.y + 0.42 * box.height);
  const turned = await camera(), distance = ({eye, look_at}) => Math.hypot(...minus(eye, look_at));
  require(Math.abs(distance(turned) / distance(view) - 1) < 1e-4, "a drag changes the distance");
  const after = await screenshot("page-turned.png"), moved = await differenceOf(before, after);
  require(moved.far > 0.1, `a drag changes only ${moved.far} of the pixels`);
  execFileSync(program, ["-q", "render", join(folder, "scene.obj"), "-o", join(folder, "turned.png"), "--eye",
                         turned.eye.join(","), "--look-at", turned.look_at.join(","), "--up", view.up.join(","), "--fov",
                         String(view.fov), "--size", size.join("x")]);
  const difference = await differenceOf(after, base64Of("turned.png"));
  require(close(difference), `after a drag the page and hemitex render differ: ${JSON.stringify(difference)}`);
  const names = await checkClicks("after a drag");
  await clickOn("#start");
  const back = await differenceOf(before, await screenshot("page-start.png"));
  require(back.mean < 0.01, "the start view does not come back");
  return {difference, names};
}

/// Holds a key while the view has the focus, for some time.
async function hold(code, milliseconds) {
  await send("Input.dispatchKeyEvent", {type: "keyDown", code, key: code});
  await pause(milliseconds);
  await send("Input.dispatchKeyEvent", {type: "keyUp", code, key: code});
  await pause(200);
}

/// A walk moves the camera and its target by the same step: along the horizontal direction of view, to its right, or
/// along `up`, also where the key goes up before the page draws a frame. A key that is up moves nothing.
async function checkWalk() {
  await clickOn("#start");
  await evaluate("document.querySelector('#room canvas').focus()");
  const up = unit(view.up), across = a => minus(a, up.map(value => value * dot(a, up)));
  for (const [codes, wayOf] of [[["KeyW", "ArrowUp"], forward => forward], [["KeyD", "ArrowRight"], forward => cross(forward, up)],
                                [["KeyE", "PageUp"], () => up], [["KeyS"], forward => forward.map(value => -value)],
                                [["KeyQ"], () => up.map(value => -value)]])
    for (const [i, code] of codes.entries()) {
      const before = await camera(), scroll = await evaluate("scrollY");
      await hold(code, 300 * i);
      const after = await camera(), step = minus(after.eye, before.eye), length = Math.hypot(...step);
      const way = wayOf(unit(across(minus(before.look_at, before.eye))));
      require(length > 0 && dot(step, way) > 0.999 * length, `${code} moves the camera by ${step}`);
      require(Math.hypot(...minus(minus(after.look_at, before.look_at), step)) < 1e-3 * length + 1e-3, `${code} turns`);
      require(await evaluate("scrollY") === scroll, `${code} scrolls the page`);
      require(JSON.stringify(await camera()) === JSON.stringify(after), `the camera goes on after ${code}`);
    }
  await clickOn("#start");
}

async function expose(stops) {
  await evaluate(`(() => { const slider = document.getElementById("exposure"); slider.value = ${stops};
                           slider.dispatchEvent(new Event("input")); })()`);
}

/// One stop more is the picture of twice the exposure; one stop less makes clipped places grey.
async function checkExposure() {
  const before = await screenshot("page-start.png");
  await expose(1);
  const {exposure} = solution.settings, shown = await evaluate("document.getElementById('camera').textContent");
  require(Math.abs(/--exposure (\S+)/.exec(shown)[1] / exposure - 2) < 1e-3, `the exposure is told as ${shown}`);
  execFileSync(program, ["-q", "render", join(folder, "scene.obj"), "-o", join(folder, "exposed.png"), "--exposure",
                         String(2 * exposure), "--size", size.join("x")]);
  const difference = await differenceOf(await screenshot("page-exposed.png"), base64Of("exposed.png"));
  require(close(difference), `one stop more differs from hemitex render: ${JSON.stringify(difference)}`);
  await expose(-1);
  const darker = await differenceOf(before, await screenshot("page-darker.png"));
  require(darker.mean > 10, "one stop less changes little");
  await expose(0);
  require((await differenceOf(before, await screenshot("page-start.png"))).mean < 0.01, "the exposure does not come back");
  return difference;
}

/// On a telephone nothing is wider than the window, also not inside the tables.
async function checkNarrow() {
  await clickOn("#start");
  await send("Emulation.setDeviceMetricsOverride", {width: 390, height: 844, deviceScaleFactor: 1, mobile: true});
  await pause(500);
  const box = await boxOf("#room canvas");
  await click(box.x + 0.5 * box.width, box.y + 0.3 * box.height);
  require(await evaluate("!document.getElementById('surface').hidden"), "a click shows no values on a narrow page");
  const wide = JSON.parse(await evaluate(`JSON.stringify([...document.querySelectorAll("body *")].filter(
    e => e.getBoundingClientRect().right > 390.5 || (e.className === "table" && e.scrollWidth > e.clientWidth)).map(
    e => e.tagName + " " + e.id + e.className + " " + e.textContent.slice(0, 40)))`));
  require(await evaluate("document.documentElement.scrollWidth") <= 390 && wide.length === 0,
          `wider than 390 pixels: ${wide.slice(0, 9).join("; ")}`);
  const {data} = await send("Page.captureScreenshot", {captureBeyondViewport: true, clip: {
    x: 0, y: 0, width: 390, height: await evaluate("document.documentElement.scrollHeight"), scale: 1}});
  writeFileSync(join(folder, "page-narrow.png"), Buffer.from(data, "base64"));
}

/// A button beside a warning or in a table turns the camera to its surface and shows it.
async function checkButtons(list) {
  const selector = `${list} button.place`;
  await clickOn("#start");
  require(await evaluate(`document.querySelector("${selector}") !== null`), `${list} has no button`);
  const name = await evaluate(`document.querySelector("${selector}").textContent`), before = await camera();
  await clickOn(selector);
  require(await evaluate("document.querySelector('#surface h3').textContent") === name, `${list}: ${name} is not shown`);
  require(JSON.stringify(await camera()) !== JSON.stringify(before), `${list}: the camera did not turn to ${name}`);
  await screenshot(`page${list.replace(/\W/g, "-")}.png`);
  await clickOn("#surface .close");
  return name;
}

async function checkPage() {
  await open();
  const start = await differenceOf(await screenshot("page-start.png"), base64Of("render.png"));
  require(close(start), `the start view and render.png differ: ${JSON.stringify(start)}`);
  const names = await checkClicks("start view");
  await checkValues();
  const turned = await checkTurn();
  await checkWalk();
  const exposed = await checkExposure();
  require(await evaluate("document.title") === "box.obj", "the title is not the name of the scene");
  const warned = await checkButtons("#warnings li:first-child"), absorbing = await checkButtons("#absorbedBy");
  require(warned === "wall-red" && absorbing.startsWith("short-block"), `the places are ${warned} and ${absorbing}`);
  require(await checkButtons("#warnings li:last-child") === absorbing, "the warning does not name the largest back");
  await checkButtons("#seenFrom");
  const {data} = await send("Page.captureScreenshot", {captureBeyondViewport: true, clip: {
    x: 0, y: 0, width: 1100, height: await evaluate("document.documentElement.scrollHeight"), scale: 1}});
  writeFileSync(join(folder, "page.png"), Buffer.from(data, "base64"));
  await checkNarrow();
  const told = JSON.parse(await evaluate("document.getElementById('drawn').textContent"));
  faults.push(...told.faults);
  for (const plot of ["byShots", "byTime"])
    require(told.drawn[plot]?.points > 3 && told.drawn[plot].painted > 1000, `plot ${plot} is empty`);
  require(faults.length === 0, faults.join("\n"));
  console.log(JSON.stringify({start, names, turned, exposed, warned, absorbing}));
}

let code = 0;
try {
  await Promise.race([checkPage(), new Promise((_, failed) => {
    chromium.on("exit", () => failed(new Error("the browser ended")));
    chromium.on("error", failed);
    setTimeout(() => failed(new Error("the page takes more than 300 s")), 300e3).unref();
  })]);
} catch (error) {
  console.error(error.message, faults.join("\n"));
  code = 1;
}
chromium.removeAllListeners("exit");
chromium.on("exit", async () => {
  await removeProfile(profile);
  process.exit(code);
});
// The browser ends its child processes itself, unless it hangs.
session = undefined;
send("Browser.close").catch(() => {});
setTimeout(() => chromium.kill("SIGKILL"), 10e3).unref();
