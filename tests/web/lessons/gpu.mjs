// "Your own GPU on trial": the software GPU of Chromium has no errors, and its record agrees with the command line. A
// broken device is named, and its case reduced.
import {mkdtempSync, readdirSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";

async function judge(page, {open, until, value}, device) {
  await open(`device=${encodeURIComponent(device)}`);
  const start = Date.now();
  await page.getByRole("button", {name: "Draw the suite"}).click();
  await until(async () => /^(Done|Not judged)/.test(await value("gpu-state")), `${device} is judged`);
  return {seconds: (Date.now() - start) / 1000, state: await value("gpu-state")};
}

/** Saves what a link downloads, and returns where. */
async function download(page, link, folder) {
  const arrival = page.waitForEvent("download");
  await page.getByRole("link", {name: link}).click();
  const file = join(folder, (await arrival).suggestedFilename());
  await (await arrival).saveAs(file);
  return file;
}

/** The suite of the command line, without the vectors of scenes, which the page has not. */
function writeSuite({run}, folder) {
  const suite = join(folder, "suite");
  run("vector", "suite", "-o", suite);
  for (const name of readdirSync(suite)) if (name.startsWith("scene-")) rmSync(join(suite, name), {recursive: true});
  return suite;
}

async function checkRightDevice(page, tools, device, suite, folder) {
  const {seconds, state} = await judge(page, tools, device);
  tools.equal(state, "Done.", device);
  tools.ok(seconds < 30, `${device}: ${seconds} s`);
  tools.ok(/^No errors: .* 0 errors\.$/.test(await tools.value("gpu-verdict")), await tools.value("gpu-verdict"));
  tools.equal(await tools.value("profile sub-pixel bits"), "4", "sub-pixel bits");
  const verified = tools.run("vector", "verify", await download(page, "Conformance record", folder), "--suite", suite);
  console.log(`   ${device}: ${seconds} s, ${await tools.value("gpu-verdict")} ${verified.trim()}`);
}

async function checkBrokenDevice(page, tools) {
  await judge(page, tools, "simulated: linear filtering");
  tools.ok(/linear filtering/.test(await tools.value("gpu-remarks")), await tools.value("gpu-remarks"));
  await page.getByRole("button", {name: "Reduce the case"}).click();
  await tools.until(async () => /^1 triangle after/.test(await tools.value("gpu-reduced")), "the case is reduced");
}

export default async function check(page, tools) {
  const folder = mkdtempSync(join(tmpdir(), "hemitex-"));
  try {
    const suite = writeSuite(tools, folder);
    for (const device of ["webgl2", "webgpu"]) await checkRightDevice(page, tools, device, suite, folder);
    await checkBrokenDevice(page, tools);
  } finally {
    rmSync(folder, {recursive: true});
  }
}
