// The lesson "Break it": the diagnosis names faults that are chosen, and hidden ones can be found. The expected item ID
// of a pixel is that of the command line.
import {join} from "node:path";

/** The item ID of the pixel in a text such as "column 3, row 4 of front: expected 5, ..." */
function itemId({run, folder}, vector, pixel) {
  const [, column, row, face] = /^column (\d+), row (\d+) of (\S+):/.exec(pixel);
  run("vector", "suite", "-q", "-o", folder);
  const place = `${face},${column},${row}`;
  return JSON.parse(run("vector", "explain", join(folder, vector), "--pixel", place, "--json")).word;
}

export default async function check(page, tools) {
  const {ok, equal, value, until, open, address} = tools;
  const choose = (label, option) => page.getByLabel(label, {exact: true}).selectOption(option);
  const diagnosis = async () => {
    await until(async () => (await value("diagnosis")) !== "Judging ...", "a diagnosis");
    return value("diagnosis");
  };
  ok((await diagnosis()).includes("picture upside down"), "first fault");
  await choose("Test vector", "perspective-floor");
  for (const fault of ["affine instead of perspective interpolation", "sample at the pixel corner", "mipmapping"]) {
    await choose("Fault", fault);
    ok((await diagnosis()).includes(`The diagnosis: ${fault}`), `${fault}: ${await value("diagnosis")}`);
  }
  await choose("Fault", "depth test off");
  ok(/^Every pixel is right: .* Try \S+\.$/.test(await diagnosis()), "a vector that cannot show a fault");
  await until(async () => /fault=depth(\+|%20)test/.test(await address()), "fault in the address");

  await choose("Test vector", "layout-r8g8b8a8");
  await choose("Fault", "dithering");
  const first = await value("pixel");
  ok(first.includes(`expected ${itemId(tools, "layout-r8g8b8a8", first)}, found `), first);
  await page.getByLabel("Found").focus();
  await page.keyboard.press("ArrowUp");
  ok((await value("pixel")) !== first, "arrow keys select pixels");
  ok((await page.locator(".derivation tr").count()) > 0, "derivation");

  await page.getByRole("button", {name: "Find a hidden fault"}).click();
  const answer = async (fault) => {
    await page.getByRole("radio", {name: fault, exact: true}).check();
    await page.getByRole("button", {name: "Check"}).click();
    return value("verdict");
  };
  ok((await answer("picture mirrored")).startsWith("Not this one"), "a wrong answer");
  ok(await page.getByLabel("Drawn with picture mirrored").isVisible(), "the picture of the guessed fault");
  const right = await answer("picture upside down");
  ok(right.startsWith("Right.") && right.includes("https://github.com/libsdl-org/SDL/issues/2182"), right);
  const faults = [
    "picture upside down",
    "sample at the pixel corner",
    "sRGB encoding",
    "padded rows",
    "16-bit depth",
    "multisampling",
    "blending left on",
    "channels swapped in the target (BGRA)",
    "colour from the wrong provoking vertex",
  ];
  for (const [k, fault] of faults.entries()) {
    if (tools.isShort && k % 4 !== 0) continue;
    await open(`task=find&device=${k + 1}`);
    const wrong = await page.getByRole("radio").evaluateAll((all) => all.map((one) => one.value));
    ok(wrong.length === 6 && wrong.includes(fault), `device ${k + 1}`);
    for (const other of wrong.filter((name) => name !== fault))
      ok(/^Not this one: with that fault, \d+ pixel/.test(await answer(other)), `device ${k + 1} is not ${other}`);
    ok((await answer(fault)).startsWith("Right."), `device ${k + 1}`);
  }
  await page.getByRole("radio").last().check();
  equal(await value("verdict"), "", "no verdict on another choice");
  equal(await page.getByLabel("Broken device").inputValue(), "8", "device from the address");
}
