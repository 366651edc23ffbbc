// The start: its solution is that of the command line. The address chooses the lesson, and errors are shown, also what
// the browser lacks.
import {checkSameBits} from "../same_bits.mjs";

const settings = ["--texel-size", "35", "--resolution", "128", "--split", "1", "--orientation", "aligned",
  "--residual", "0.1"];

async function checkTurning(page, {until}) {
  const canvas = page.locator(".scene-view canvas");
  const before = await canvas.screenshot();
  await canvas.press("ArrowLeft");
  await until(async () => !before.equals(await canvas.screenshot()), "an arrow key turns the view");
  const {x, y, width, height} = await canvas.boundingBox();
  const turned = await canvas.screenshot();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 40, y + height / 2, {steps: 4});
  await page.mouse.up();
  await until(async () => !turned.equals(await canvas.screenshot()), "a drag turns the view");
}

async function checkAddress(page, {equal, until}) {
  const title = () => page.locator("h2").innerText();
  const first = await title();
  await page.evaluate(() => (location.hash = "#pixel"));
  await until(async () => (await title()) !== first, "the address changes the lesson");
  await page.locator('a[rel="prev"]').click();
  await until(async () => (await title()) === first, "the link goes back");
  equal(await page.evaluate(() => document.activeElement.localName), "h2", "focus goes to the title");
}

async function checkErrors(page, {equal, until}) {
  await page.evaluate(() => void setTimeout(() => { throw new Error("wrong"); }));
  await until(async () => /wrong/.test(await page.getByRole("alert").innerText()), "an error is shown");
  await page.getByRole("button", {name: "Close"}).click();
  equal(await page.getByRole("alert").innerText(), "", "the error is closed");
  page.noise.length = 0; // the error of this check
}

/** A browser that lacks what `remove` removes is told what the page needs. */
async function checkWithout(page, {until}, remove, need) {
  const other = await page.context().browser().newPage();
  await other.addInitScript(remove);
  await other.goto(page.url());
  await until(async () => (await other.locator("body").innerText()).includes(need), need);
  await other.close();
}

export default async function check(page, tools) {
  const options = [...settings, "-o", tools.folder, "--json"];
  const {elements, shots, residual} = JSON.parse(tools.run("solve", "data/cornell-box.obj", ...options));
  const text = await tools.value("solve");
  const [, found, foundShots, foundResidual] = text.match(/^(\d+) elements, (\d+) shots in .* ([\d.]+) %/);
  tools.equal([Number(found), Number(foundShots)], [elements, shots], "elements and shots");
  tools.close(Number(foundResidual), 100 * residual, 0.1, "residual in %");
  await checkSameBits(page, tools);
  await checkTurning(page, tools);
  await checkAddress(page, tools);
  await checkErrors(page, tools);
  await checkWithout(page, tools, () => delete globalThis.WebAssembly, "This page needs WebAssembly");
  await checkWithout(page, tools, () => (HTMLCanvasElement.prototype.getContext = () => null), "needs WebGL2");
}
