// The form factors of the lesson are those of the command line, and the faces of the unfolded hemicube adjoin.

/** Form factors by surface, as the lesson writes them, by the command that the lesson shows. */
async function expected({value, run, ok}) {
  const command = (await value("hemicube-command")).split(" ");
  ok(command.shift() === "hemitex", "a command");
  const lines = run("-q", ...command).trim().split("\n").slice(1);
  return Object.fromEntries(lines.map((line) => [line.split(",")[0], Number(line.split(",")[2]).toFixed(4)]));
}

async function shown(page) {
  const lines = await page.locator(".hemicube tbody tr").allInnerTexts();
  return Object.fromEntries(lines.map((line) => line.trim().split(/\s+/)));
}

async function checkFormFactors(page, tools, what) {
  const {equal, close} = tools;
  const right = await expected(tools);
  const {background, backs, sum, ...surfaces} = await shown(page);
  equal(surfaces, right, what);
  const all = [...Object.values(surfaces), background, backs].map(Number);
  close(all.reduce((a, b) => a + b), 1, 0.001, `${what}: the parts of the row`);
  equal(sum, "1.0000", `${what}: sum of the row`);
}

/** The share of equal pixels on both sides of the edges between the top and the sides. */
function continuity(canvas) {
  return canvas.evaluate((element) => {
    const side = element.width, {data} = element.getContext("2d").getImageData(0, 0, side, side);
    const pixels = new Uint32Array(data.buffer);
    const quarter = side / 4, far = side - quarter;
    let equal = 0, all = 0;
    for (let i = quarter + 8; i < far - 8; ++i)
      for (const edge of [quarter, far]) {
        equal += Number(pixels[i * side + edge - 1] === pixels[i * side + edge]);
        equal += Number(pixels[(edge - 1) * side + i] === pixels[edge * side + i]);
        all += 2;
      }
    return equal / all;
  });
}

export default async function check(page, tools) {
  const {equal, close, ok, value, until, open, address} = tools;
  const scene = page.getByLabel("The Cornell box and its elements");
  const picture = page.getByLabel("The five faces of the hemicube, unfolded");
  await checkFormFactors(page, tools, "without settings");

  await page.getByLabel("Resolution R").fill("256");
  await checkFormFactors(page, tools, "R = 256");
  const share = await continuity(picture);
  ok(share > 0.9, `faces adjoin: ${share} of the pixels at the edges are equal`);

  await page.getByLabel("Patch on").selectOption({label: "short-block#1"});
  await page.getByLabel("Column").fill("2");
  await checkFormFactors(page, tools, "on a block");

  // The pointer moves the patch over the scene.
  const {x, y, width, height} = await scene.boundingBox();
  const commands = [];
  await page.mouse.move(x + 0.3 * width, y + 0.85 * height);
  await page.mouse.down();
  for (const place of [0.3, 0.4, 0.5]) {
    await page.mouse.move(x + place * width, y + 0.85 * height);
    commands.push(await value("hemicube-command"));
    await checkFormFactors(page, tools, "after a drag");
  }
  await page.mouse.up();
  ok(new Set(commands).size > 1, "the patch follows the pointer");

  // A pixel in the middle of the top: 4 / (pi R^2).
  const middle = await picture.boundingBox();
  await picture.click({position: {x: 0.5 * middle.width + 0.3, y: 0.5 * middle.height - 0.3}});
  const text = await value("hemicube-pixel");
  close(Number(text.split("ΔF = ")[1]), 4 / (Math.PI * 256 ** 2), 1e-8, text);
  ok(text.includes("of top:"), text);
  equal(await page.locator(".hemicube tr.current").count(), 1, "surface marked");
  await picture.press("ArrowUp");
  ok((await value("hemicube-pixel")) !== text, "arrow key");

  await page.getByRole("slider", {name: "Fold"}).fill("60");
  ok(!(await picture.isVisible()), "the folded hemicube is in the place of the cross");
  ok((await page.locator(".hemicube-cross canvas:visible").count()) === 5, "five faces");
  await page.getByRole("slider", {name: "Fold"}).fill("0");

  const before = await picture.screenshot();
  await page.getByLabel("Colours").selectOption("shares");
  ok(!before.equals(await picture.screenshot()), "colours by delta form factor");
  await until(async () => address().includes("resolution=256") && address().includes("colours=shares"), "address");
  const command = await value("hemicube-command");
  await open(address());
  equal(await value("hemicube-command"), command, "the same after opening the address");

  // A column past the end names no texel, so that the first patch is that without an address.
  await open("from=floor:8,0");
  ok((await value("hemicube-command")).includes("--from floor:3,1 "), "a column past the end");

  // Where a block stands on the patch, the hemicube of the last patch follows the settings.
  await open("from=floor:4,2");
  await page.getByLabel("Column").fill("5");
  equal(await value("hemicube-command"), "A block stands on floor:5,2.", "a covered patch");
  await page.getByLabel("Resolution R").fill("128");
  await page.getByLabel("Colours").selectOption("shares");
  const corner = await picture.boundingBox();
  await picture.click({position: {x: 0.5 * corner.width + 0.3, y: 0.5 * corner.height - 0.3}});
  close(Number((await value("hemicube-pixel")).split("ΔF = ")[1]), 4 / (Math.PI * 128 ** 2), 1e-7, "R = 128");
  const {sum: all} = await shown(page);
  equal(all, "1.0000", "sum of the row of the last patch");
  await tools.answers([[4, "Not yet"], [9, "Right"]]);
}
