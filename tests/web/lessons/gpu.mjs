// "Your own GPU on trial": the software GPU of Chromium has no errors, and its record agrees with the command line. A
// broken device is named, and its case reduced.
import {join} from "node:path";

/** Judges a device. `spoil` changes functions of the browser before, in the page. */
async function judge(page, {open, until, value}, device, spoil = () => {}) {
  await open(`device=${encodeURIComponent(device)}`);
  await page.evaluate(spoil);
  const start = Date.now();
  await page.getByRole("button", {name: "Draw the suite"}).click();
  await until(async () => /^(Passed|Failed|Not judged)/.test(await value("gpu-state")), `${device} is judged`);
  return {seconds: (Date.now() - start) / 1000, state: await value("gpu-state")};
}

/** Saves what a link downloads, and returns where. */
async function download(page, {folder}, link) {
  const arrival = page.waitForEvent("download");
  await page.getByRole("link", {name: link}).click();
  const file = join(folder, (await arrival).suggestedFilename());
  await (await arrival).saveAs(file);
  return file;
}

async function checkRightDevice(page, tools, device, suite) {
  const {seconds, state} = await judge(page, tools, device);
  tools.ok(/^Passed: .* 0 errors$/.test(state), `${device}: ${state}`);
  tools.ok(seconds < 30, `${device}: ${seconds} s`);
  tools.equal(await tools.value("profile sub-pixel bits"), "4", "sub-pixel bits");
  const record = await download(page, tools, "Conformance record");
  const verified = tools.run("vector", "verify", record, "--suite", suite);
  console.log(`   ${device}: ${seconds} s, ${state}; ${verified.trim()}`);
}

async function checkFault(page, tools, fault, device, spoil) {
  const {state} = await judge(page, tools, device, spoil);
  tools.ok(/^Failed/.test(state), state);
  const remarks = await tools.value("gpu-remarks");
  tools.ok(remarks.includes(`Diagnosis: ${fault}, in`), remarks);
  await page.getByRole("button", {name: "Reduce the case"}).click();
  await tools.until(async () => /^\d triangles? and 1 pixel/.test(await tools.value("gpu-reduced")), "it is reduced");
  console.log(`   ${device}: ${remarks} ${await tools.value("gpu-reduced")}`);
}

/** Drivers that ignore the depth test. */
function spoilDepthTest() {
  const {createRenderPipeline} = GPUDevice.prototype;
  GPUDevice.prototype.createRenderPipeline = function (description) {
    const depthStencil = {...description.depthStencil, depthCompare: "always"};
    return createRenderPipeline.call(this, {...description, depthStencil});
  };
  const {enable} = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.enable = function (state) {
    if (state !== this.DEPTH_TEST) enable.call(this, state);
  };
}

function removeWebGPU() {
  Object.defineProperty(navigator, "gpu", {value: undefined});
}

export default async function check(page, tools) {
  const suite = join(tools.folder, "suite");
  tools.run("vector", "suite", "-o", suite);
  for (const device of tools.isShort ? ["webgl2"] : ["webgl2", "webgpu"])
    await checkRightDevice(page, tools, device, suite);
  await checkFault(page, tools, "linear filtering", "simulated: linear filtering");
  for (const device of tools.isShort ? ["webgpu"] : ["webgl2", "webgpu"])
    await checkFault(page, tools, "depth test off", device, spoilDepthTest);
  const {state} = await judge(page, tools, "webgpu", removeWebGPU);
  tools.equal(state, "Not judged: this browser has no WebGPU.", "without WebGPU");
}
