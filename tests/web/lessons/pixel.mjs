// The item IDs of the lesson and their derivations are those of the command line.
import {readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {fileURLToPath} from "node:url";

const resolution = 16;
const lessonFile = fileURLToPath(new URL("../../../web/page/lessons/pixel.ts", import.meta.url));
const sceneText = /const sceneText = `([^`]*)`/.exec(readFileSync(lessonFile, "utf8"))[1];

/** The vector of the lesson's settings, exported and drawn by the command line. */
class Native {
  constructor(run, folder, texels, format, ...options) {
    this.run = run;
    this.vector = join(folder, ["vector", texels, format, ...options].join("-"));
    const scene = join(folder, "scene.obj");
    writeFileSync(scene, sceneText);
    const elements = ["--texels", texels, "--surface", "patch=1", "--format", format, ...options];
    const view = ["--eye", "0,0,0", "--normal", "0,1,0", "--resolution", resolution];
    run("vector", "export", "-q", scene, ...elements, ...view, "-o", this.vector);
    run("vector", "render", "-q", this.vector, "-o", `${this.vector}-drawn`);
    const bytes = readFileSync(join(`${this.vector}-drawn`, "top.u32"));
    this.ids = Array.from({length: bytes.length / 4}, (_, i) => bytes.readUInt32LE(4 * i));
  }

  explain(column, row) {
    return JSON.parse(this.run("vector", "explain", this.vector, "--pixel", `top,${column},${row}`, "--json"));
  }

  get visible() {
    return this.ids.filter((id) => id !== 0xffff && id !== 0xffffff && id !== 0xffffffff).map(String);
  }
}

async function checkPixel(page, {equal, ok, value}, native, column, row) {
  const canvas = page.getByLabel("Item IDs of 16 x 16 pixels");
  const {width, height} = await canvas.boundingBox();
  const position = {x: ((column + 0.5) * width) / resolution, y: ((resolution - row - 0.5) * height) / resolution};
  await canvas.click({position});
  const {word, derivation} = native.explain(column, row);
  equal(await value("pixel-id"), `Pixel (${column}, ${row}): item ID ${word}`, "item ID");
  const shown = await page.locator(".pixel ol").allInnerTexts();
  if (!derivation) return equal(shown, [], "derivation of the background");
  const edges = derivation.edges.map((edge) => edge.value).join(", ");
  ok(shown[0].includes(edges), `edge functions ${edges} in ${shown[0]}`);
  const line = await page.locator(".pixel .sum tr.result").innerText();
  const bits = derivation.sums.map((sum) => sum.result.toString(2).padStart(sum.bits, "0")).reverse();
  equal(line.split(/\s+/), ["=", "item", "ID", ...bits, String(word)], "sum in binary");
}

export default async function check(page, tools) {
  const {equal, ok, value, until, open, address, folder} = tools;
  const run = (...args) => tools.run(...args.map(String));
  const numbers = () => page.locator(".pixel-picture text").allTextContents();
  const aligned = new Native(run, folder, 5, "r5g6b5");
  equal(await numbers(), aligned.visible, "item IDs");
  for (const [column, row] of [[7, 3], [3, 8], [10, 9], [0, 0], [14, 12]])
    await checkPixel(page, tools, aligned, column, row);
  equal(await value("pixel-wrong"), "0 pixels hold a wrong item ID.", "aligned");

  await page.getByLabel("Aligned offsets").uncheck();
  const clamped = new Native(run, folder, 5, "r5g6b5", "--no-align");
  const exact = new Native(run, folder, 5, "r5g6b5", "--no-align", "--blend", "integer-add");
  equal(await numbers(), clamped.visible, "clamped item IDs");
  const wrong = clamped.ids.filter((id, pixel) => id !== exact.ids[pixel]).length;
  ok(wrong > 0, "the clamp destroys numbers");
  equal(await value("pixel-wrong"), `${wrong} pixels hold a wrong item ID.`, "clamped pixels");
  await checkPixel(page, tools, clamped, 10, 2);
  ok((await page.locator("td.clamped").count()) > 0, "the clamped channel is marked");

  await page.getByRole("slider", {name: "Texels"}).fill("16");
  await page.getByLabel("Format").selectOption("r8g8b8");
  equal(await value("pixel-room"), "Aligned offsets: 256 texels need k = 8 of 24 bits, 65535 surfaces fit.", "room");
  equal(await numbers(), new Native(run, folder, 16, "r8g8b8", "--no-align").visible, "item IDs of r8g8b8");

  await page.getByLabel("Item IDs of 16 x 16 pixels").press("ArrowRight");
  ok((await value("pixel-id")).startsWith("Pixel (11, 2)"), "arrow key");
  await until(async () => address() === "x=11&y=2&format=r8g8b8&texels=16&aligned=0", "settings in the address");
  const before = await numbers();
  await open(address());
  equal(await numbers(), before, "the same after opening the address");
  await tools.answers([["35", "Not yet"], ["31", "Right"], ["3,1", "Not yet"], ["31,0", "Right"]]);

  await open("texels=1000&format=none&x=99");
  const room = "Aligned offsets: 256 texels need k = 8 of 16 bits, 255 surfaces fit.";
  equal(await value("pixel-room"), room, "settings out of range");
  ok((await value("pixel-id")).startsWith("Pixel (15, 3)"), "pixel out of range");
}
