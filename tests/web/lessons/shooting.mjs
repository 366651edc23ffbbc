// Shots, energy and edits against hemitex solve; pictures while a block moves.
import {readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";

/** What hemitex solve finds with the settings of the lesson, with the edits of one frame. */
function solved({run, folder}, stop, edits) {
  writeFileSync(join(folder, "edits.json"), JSON.stringify({frames: [edits]}));
  // With --edits, also without any, no part of a surface counts as covered.
  const elements = ["--texels", "16", "--surface", "short-block=8", "--surface", "tall-block=8", "--patch", "4"];
  const files = ["--edits", join(folder, "edits.json"), "-o", join(folder, "lit"), "--size", "64x48", "-q"];
  const drawing = ["--resolution", "64", "--split", "0.2"];
  run("solve", "data/cornell-box.obj", ...elements, ...drawing, ...stop, ...files);
  const read = (path) => JSON.parse(readFileSync(join(folder, "lit", path), "utf8"));
  return {before: read("solution.json"), after: read("frame-1/solution.json")};
}

const sum = (bands) => bands[0] + bands[1] + bands[2];

/** The shares in percent that the lesson states. */
function shares(text) {
  const [, emitted, absorbed, unshot, lost] = text
    .match(/emitted ([\d.]+) W = absorbed (-?[\d.]+) % \+ unshot (-?[\d.]+) % \+ lost (-?[\d.]+) %/)
    .map(Number);
  return {emitted, absorbed, unshot, lost};
}

/** Drags a slider with the mouse for three seconds. */
async function picturesOfDrag(page, slider, value) {
  const box = await slider.boundingBox();
  const at = (share) => page.mouse.move(box.x + box.width * share, box.y + box.height / 2);
  await at(0.3);
  await page.mouse.down();
  const end = Date.now() + 3000;
  for (let share = 0.3; Date.now() < end; share = 0.2 + ((share + 0.01) % 0.6)) await at(share);
  const pictures = await value("pictures-per-second");
  await page.mouse.up();
  console.log(`     ${pictures}`);
  return Number.parseFloat(pictures);
}

export default async function check(page, tools) {
  const {close, equal, ok, value, until, open, address, answers} = tools;
  const press = (name) => page.getByRole("button", {name, exact: true}).click();
  const slider = (name) => page.getByRole("slider", {name, exact: true});
  const idle = async () => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await until(async () => (await page.getByRole("button", {name: "Run", exact: true}).count()) === 1, "idle");
  };
  const view = page.locator(".scene-view canvas");

  const checkEnergy = async (energy, tolerance, what) => {
    const found = shares(await value("energy"));
    const emitted = sum(energy.emitted);
    close(found.emitted, emitted, 0.0006, `${what}: emitted`);
    for (const part of ["absorbed", "unshot", "lost"])
      close(found[part], (100 * sum(energy[part])) / emitted, tolerance, `${what}: ${part}`);
    close(found.absorbed + found.unshot + found.lost, 100, 0.02, `${what}: the parts`);
  };

  await press("Start again");
  await press("One shot");
  await press("Ten shots");
  const byHand = solved(tools, ["--shots", "11"], []).before;
  equal((await value("shots")).split(":")[0], "11 shots", "shots");
  const unshot = Number.parseFloat((await value("shots")).split("residual")[1]);
  close(unshot, 100 * byHand.residual, 0.0006, "unshot after 11 shots");
  await checkEnergy(byHand.energy, 0.006, "after 11 shots");

  const lit = await view.screenshot();
  await page.getByLabel("Ambient estimate").check();
  await until(async () => !lit.equals(await view.screenshot()), "the ambient estimate is visible");
  await page.getByLabel("Colours").selectOption("unshot");
  await until(async () => (await value("legend")).startsWith("Yellow"), "the legend of the flux");
  await page.getByLabel("Colours").selectOption("light");
  await page.getByLabel("Ambient estimate").uncheck();

  await press("Run");
  await idle();
  ok(Number.parseFloat((await value("shots")).split("residual")[1]) <= 1, "converged");

  // A block moves: from key to key, and then with the mouse for three seconds.
  await slider("Move to the right").focus();
  for (let i = 0; i < 8; ++i) await page.keyboard.press("ArrowRight");
  await idle();
  const moved = solved(tools, ["--residual", "0.01"], [{move: "short-block", by: [-40, 0, 0]}]);
  await checkEnergy(moved.after.energy, 2, "after the block moved");
  const pictures = await picturesOfDrag(page, slider("Move to the right"), value);
  await idle();
  ok(pictures > 0, "pictures are drawn while the block moves"); // how many depends on the machine
  await until(async () => (await address()).includes("short-block-x="), "the place is in the address");

  // The lamp: off and on. All light returns.
  await open("shots=0");
  await press("Run");
  await idle();
  const before = shares(await value("energy"));
  await page.getByLabel("Lamp on").uncheck();
  await until(async () => shares(await value("energy")).emitted === 0, "the lamp is off");
  await idle();
  await page.getByLabel("Lamp on").check();
  await until(async () => shares(await value("energy")).emitted > 0, "the lamp is on");
  await idle();
  close(shares(await value("energy")).absorbed, before.absorbed, 2, "absorbed again");
  await page.getByLabel("Red wall").selectOption("black");
  await until(async () => shares(await value("energy")).absorbed !== before.absorbed, "the wall is painted");
  await idle();
  const painted = [{reflectance: "wall-red", to: [0.02, 0.02, 0.02]}];
  await checkEnergy(solved(tools, ["--residual", "0.01"], painted).after.energy, 2, "with a black wall");

  await answers([["One per patch", "Not yet"], ["None", "Right"]]);
}
