// The story: each step has few words, a figure whose handle changes it, and a question that answers wrong answers one by
// one. Figures stand alone, numbers follow from the student's name, and the visitor's own scene takes the place of the
// Cornell box. The address chooses the lesson, and errors are shown, also what the browser lacks.
import {createHash} from "node:crypto";
import {readFileSync} from "node:fs";
import {join} from "node:path";
import {fileURLToPath} from "node:url";
import {checkSameBits} from "../same_bits.mjs";

const mostWords = 120;

/** The numbers in the text of a question, and from them: the right answer, and wrong ones with a part of the reply. */
const questions = {
  lamp: ([times]) => ({
    right: times ** 2,
    wrong: [
      [times, "two directions"],
      [times ** 3, "not a volume"],
    ],
  }),
  cosine: ([, times]) => ({
    right: 0.5 / times ** 2,
    wrong: [
      [0.5, "the cosine"],
      [0.5 / times, "the square"],
    ],
  }),
  nusselt: ([degrees]) => {
    const sine = Math.sin((degrees * Math.PI) / 180);
    return {
      right: sine ** 2,
      wrong: [
        [sine, "radius"],
        [1 - Math.sqrt(1 - sine ** 2), "hemisphere"],
      ],
    };
  },
  hemicube: ([r]) => ({right: 3 * r * r, wrong: [[5 * r * r, "half a cube"]]}),
  "pixel-number": ([bits]) => ({right: 2 ** bits - 1, wrong: [[2 ** bits, "taken"]]}),
  "index-map": ([width, , offset, column, row]) => ({
    right: offset + row * width + column,
    wrong: [[row * width + column, "Add the offset"]],
  }),
  clamp: ([offset, index]) => ({
    right: 255,
    wrong: [
      [offset + index, "nine bits"],
      [offset + index - 256, "clamps"],
    ],
  }),
  row: (numbers) => {
    const r = numbers.at(-1),
      right = 4e6 / (Math.PI * r * r);
    return {
      right,
      wrong: [
        [right * Math.PI, "π"],
        [right / 4, "side 2 / R"],
      ],
    };
  },
  shot: ([flux, share, reflectance]) => ({
    right: (reflectance * share * flux) / 2,
    wrong: [
      [reflectance * share * flux, "per area"],
      [(share * flux) / 2, "leaves it"],
    ],
  }),
  texture: ([first, second]) => ({
    right: first + (second - first) / 4,
    wrong: [
      [first, "nearest"],
      [(first + second) / 2, "half"],
    ],
  }),
  mesh: ([surfaces, side]) => ({
    right: 2 * surfaces * side * side,
    wrong: [
      [surfaces * side * side, "triangles"],
      [2 * surfaces, "texture"],
    ],
  }),
  accuracy: ([times]) => ({right: times ** 2, wrong: [[times, "one row"]]}),
};
const choices = {
  fault: ["The light goes to element 6, which may lie elsewhere", "Nothing: element 6 lies between them"],
  write: ["Once", "Twice"],
  gpu: ["No, the standards allow it", "Yes, every difference is one"],
};
const names = [...Object.keys(questions), ...Object.keys(choices)];

const stepOf = (page, name) => page.locator(`#step-${name}`);

async function checkWords(page, {ok, equal}) {
  const steps = await page
    .locator("section.step[id]")
    .evaluateAll((all) =>
      all.map((step) => [step.id.slice(5), step.querySelector(".words > p").innerText.trim().split(/\s+/).length]),
    );
  equal(
    steps.map(([name]) => name),
    names,
    "the steps",
  );
  for (const [name, words] of steps) ok(words <= mostWords, `${name}: ${words} words`);
}

/** The handle of a figure changes what it shows, by keys. */
async function checkFigures(page, {until}) {
  for (const name of names) {
    const step = stepOf(page, name);
    await step.scrollIntoViewIfNeeded();
    const figure = step.locator(".figure");
    await figure.waitFor();
    const slider = figure.locator('input[type="range"], select').first();
    const handle = (await slider.count()) ? slider : figure.locator("canvas.pixels, button").first();
    await handle.focus();
    await page.waitForTimeout(100); // the focus ring is drawn
    const before = await figure.screenshot(),
      text = await figure.innerText();
    if (name === "gpu") await handle.click();
    else await handle.press(name === "fault" ? "ArrowDown" : "ArrowLeft");
    await until(
      async () => (await figure.innerText()) !== text || !before.equals(await figure.screenshot()),
      `the handle of ${name} changes the figure`,
    );
  }
}

async function answer(step, value) {
  const field = step.getByLabel("Answer:");
  if (await field.count()) await field.fill(String(Number(value.toPrecision(6))));
  else await step.getByLabel(value, {exact: true}).check();
  await step.getByRole("button", {name: "Check"}).click();
  return step.getByTestId("verdict").innerText();
}

async function checkQuestions(page, {ok}) {
  for (const [name, solve] of Object.entries(questions)) {
    const step = stepOf(page, name);
    const text = await step.locator("legend").innerText();
    const skipped = name === "row" ? text.slice(text.indexOf("R =")) : text;
    const {right, wrong} = solve([...skipped.matchAll(/\d+(\.\d+)?/g)].map(([number]) => Number(number)));
    for (const [value, reply] of wrong) {
      const verdict = await answer(step, value);
      ok(verdict.startsWith("Not yet. ") && verdict.includes(reply), `${name}, ${value}: ${verdict}`);
    }
    const verdict = await answer(step, right);
    ok(verdict.startsWith("Right. "), `${name}, ${right} for “${text}”: ${verdict}`);
  }
  for (const [name, [right, wrong]] of Object.entries(choices)) {
    const verdict = await answer(stepOf(page, name), wrong);
    ok(/^Not yet\. (?!Try again)/.test(verdict), `${name}: ${verdict}`);
    ok((await answer(stepOf(page, name), right)).startsWith("Right. "), name);
  }
}

/** The file for the lecturer holds all answers, and a hash of them. */
async function checkFile(page, {equal, ok, until, value, folder}) {
  equal(await value("solved"), "15 of 15 questions.", "solved questions");
  const arrival = page.waitForEvent("download");
  await page.getByRole("button", {name: "Save a file for your lecturer"}).click();
  const path = join(folder, "solved.json");
  await (await arrival).saveAs(path);
  const {student, solved, sha256} = JSON.parse(readFileSync(path, "utf8"));
  equal(solved.map(({figure}) => figure).sort(), [...names].sort(), "the questions of the file");
  equal(createHash("sha256").update(JSON.stringify({student, solved})).digest("hex"), sha256, "its hash");

  const check = async (change) => {
    const file = JSON.parse(readFileSync(path, "utf8"));
    change(file);
    const buffer = Buffer.from(JSON.stringify(file));
    await page.getByTestId("checked-file").evaluate((region) => region.replaceChildren());
    await page
      .getByLabel("Check the file of a student:")
      .setInputFiles({name: "solved.json", mimeType: "text/json", buffer});
    await until(async () => (await value("checked-file")) !== "", "the file is checked");
    return value("checked-file");
  };
  equal(await check(() => {}), "Without a name: 15 of 15 answers are right; the file is as it was saved.", "the file");
  equal(
    await check((file) => (file.solved[0].answer = "1")),
    `Without a name: 14 of 15 answers are right, not ${solved[0].figure}; the file was changed.`,
    "a wrong answer",
  );
  ok(/: [0-6] of 15 .* was changed/.test(await check((file) => (file.student = "Ada"))), "the file of another student");
}

/** Another name gives other numbers, and the same name the same ones. */
async function checkStudent(page, {ok, equal}) {
  const legends = () => page.locator("legend").allInnerTexts();
  const before = await legends();
  const give = async (name) => {
    await page.getByLabel("Your name, for numbers of your own:").fill(name);
    await page.keyboard.press("Tab");
    return legends();
  };
  const other = await give("Ada");
  ok(other.filter((text, k) => text !== before[k]).length > 6, "another student has other numbers");
  equal(await give(""), before, "the same student has the same numbers");
}

async function checkOwnScene(page, {equal, ok, until}) {
  const files = ["obj", "mtl"].map((end) => fileURLToPath(new URL(`../../../data/pyramid-room.${end}`, import.meta.url)));
  await page.getByLabel("Your own scene (OBJ and MTL):").setInputFiles(files);
  await page.getByRole("button", {name: "The Cornell box again"}).waitFor();
  for (const name of names) {
    const figure = stepOf(page, name).locator(".figure");
    await stepOf(page, name).scrollIntoViewIfNeeded();
    await figure.waitFor();
    ok(
      !(await figure.innerText()).includes("cannot be drawn"),
      `${name} with another scene: ${await figure.innerText()}`,
    );
  }
  await page.getByRole("button", {name: "The Cornell box again"}).click();
  equal(await page.getByRole("button", {name: "The Cornell box again"}).count(), 0, "the Cornell box again");
  await page.getByLabel("Your own scene (OBJ and MTL):").setInputFiles(files.slice(1));
  await until(
    async () => /Choose an OBJ file/.test(await page.getByRole("alert").innerText()),
    "a file that is no scene",
  );
  await page.getByRole("button", {name: "Close"}).click();
}

/** Each figure without the rest of the page. */
async function checkAlone(page, {equal, ok, isShort}) {
  const other = await page.context().browser().newPage({viewport: page.viewportSize()});
  const noise = [];
  other.on("pageerror", ({message}) => noise.push(message));
  for (const name of isShort ? names.slice(0, 3) : names) {
    await other.goto(page.url().replace(/[?#].*|$/, `?figure=${name}`));
    await other.locator("main[data-shown] .figure").waitFor();
    equal(await other.locator(".question").count(), 0, `${name} stands alone`);
    ok(!(await other.locator("nav").isVisible()), `${name} has no navigation`);
  }
  equal(noise, [], "errors of figures alone");
  await other.close();
}

async function checkTurning(page, {until}) {
  const canvas = page.locator("#step-hemicube .scene-view canvas");
  await canvas.scrollIntoViewIfNeeded();
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
  await page.evaluate(
    () =>
      void setTimeout(() => {
        throw new Error("wrong");
      }),
  );
  await until(async () => /wrong/.test(await page.getByRole("alert").innerText()), "an error is shown");
  await page.getByRole("button", {name: "Close"}).click();
  equal(await page.getByRole("alert").innerText(), "", "the error is closed");
  page.noise.length = 0; // the error of this check
}

/** A browser that lacks what `remove` removes is told what the page needs. */
async function checkWithout(page, {until}, remove, query, need) {
  const other = await page.context().browser().newPage();
  await other.addInitScript(remove);
  await other.goto(page.url().replace(/[?#].*|$/, query));
  await until(async () => (await other.locator("body").innerText()).includes(need), need);
  await other.close();
}

export default async function check(page, tools) {
  await checkWords(page, tools);
  await checkSameBits(page, tools);
  await checkFigures(page, tools);
  await checkQuestions(page, tools);
  await checkFile(page, tools);
  await checkStudent(page, tools);
  await checkOwnScene(page, tools);
  await checkAlone(page, tools);
  await page.locator("#step-hemicube").scrollIntoViewIfNeeded();
  await checkTurning(page, tools);
  await checkAddress(page, tools);
  await checkErrors(page, tools);
  await checkWithout(page, tools, () => delete globalThis.WebAssembly, "", "This page needs WebAssembly");
  const noContext = () =>
    (HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, {
      apply: (get, canvas, [kind, ...more]) => (kind === "webgl2" ? null : get.call(canvas, kind, ...more)),
    }));
  await checkWithout(page, tools, noContext, "?figure=hemicube", "needs WebGL2");
}
