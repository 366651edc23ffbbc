// The lesson "Write it": each step fails with its start and passes with its solution, the last one on all vectors of
// the suite. Errors are shown with their lines, and an endless loop is ended.
import {wrongSolutions} from "./wrong_solutions.mjs";

const slowDraw = `
function draw(view) {
  const ids = new Uint32Array(view.width * view.height).fill(view.background);
  const place = clip => (clip + 1) * 128 * view.resolution;
  for (const triangle of view.triangles) {
    const [a, b, c] = triangle.corners.map(p => ({...p, x: place(p.x / p.w), y: place(p.y / p.w)}));
    for (let again = 0; again < 20000; ++again)
      for (let row = 0; row < view.height; ++row)
        for (let column = 0; column < view.width; ++column) {
          const sample = {x: 256 * (column + view.column) + 128, y: 256 * (row + view.row) + 128};
          const isInside = [[b, c], [c, a], [a, b]].every(([from, to]) => edge(from, to, sample) > 0);
          if (isInside) ids[row * view.width + column] = triangle.offset;
        }
  }
  return ids;
}
`;

export default async function check(page, {ok, equal, value, until, open, address, isShort}) {
  const verdict = /^(Passed|Not yet|\d+ of|Line|there is no|draw|[a-z]\w* must)/;
  const judged = async (what) => {
    await until(async () => verdict.test(await value("result")), `verdict on ${what}`);
    return value("result");
  };
  // The verdict on the old code stands until the page starts to judge the new one.
  const changed = async (change, what) => {
    await page.getByTestId("result").evaluate((region) => region.replaceChildren());
    await change();
    return judged(what);
  };
  const press = (name) => () => page.getByRole("button", {name}).click();
  const step = page.getByLabel("Step", {exact: true});

  // What is written is kept in the browser, where the test reads it; a file replaces it.
  const kept = () => page.evaluate(() => localStorage.getItem("hemitex code"));
  const give = (code) => () =>
    page.getByLabel("Open a file:").setInputFiles({name: "own.js", mimeType: "text/javascript", buffer: Buffer.from(code)});

  await judged("the start");
  for (let k = 1; k <= 20; ++k) {
    const before = await changed(press(k === 1 ? "Start code of this step" : "Next step"), `step ${k}`);
    equal(await step.inputValue(), String(k - 1), "step");
    if (k <= 12) {
      ok(/Not yet: \d+ wrong pixels? in .*/.test(before), `start of step ${k}: ${before}`);
      ok(/expected .*, found .*/.test(await value("pixel")), `first wrong pixel of step ${k}`);
      ok((await page.locator(".derivation tr").count()) > 0, `derivation in step ${k}`);
    } else {
      ok(/^there is no function \w+ yet$/.test(before), `start of step ${k}: ${before}`);
    }
    const after = await changed(press("Show a solution"), `solution ${k}`);
    ok(after.startsWith("Passed: "), `solution ${k}: ${after}`);
    if (k === 12) ok(after.includes("of 90 test vectors"), after);
    if (k === 20) equal(await page.locator(".write .light canvas").count(), 2, "the light by the student and by the core");
    if (isShort && ![1, 5, 13].includes(k)) continue;
    const solution = await kept();
    for (const [part, instead] of wrongSolutions[k - 1]) {
      ok(solution.includes(part), `the solution of step ${k} has ${part}`);
      const verdict = await changed(give(solution.replace(part, instead)), `a wrong solution of step ${k}`);
      ok(!verdict.startsWith("Passed"), `step ${k} with ${instead} for ${part}: ${verdict}`);
    }
    await changed(give(solution), `the solution of step ${k} again`);
  }
  await until(async () => (await address()) === "step=20", "step in the address");

  const last = await kept();
  // The student's own values of the marked pixel stand under the right ones.
  await changed(() => step.selectOption("9"), "step 10");
  const texelLine = "        const texel =";
  const noted = (await kept()).replace(texelLine, `        note(column, row, "edges", edges);\n${texelLine}`);
  const affine = noted.replace("floorOfQuotient(coordinate(key, size), depth(1))", "0");
  const verdictOfNoted = await changed(give(affine), "noted code");
  ok(verdictOfNoted.startsWith("Not yet"), verdictOfNoted);
  await until(async () => (await page.locator(".derivation").count()) === 2, "the notes are shown");
  ok(/edges\s*\[-?\d+,-?\d+,-?\d+\]/.test(await page.locator(".derivation").last().innerText()), "edges");
  await changed(give(last), "the last solution again");
  await changed(() => step.selectOption("1"), "step 2");

  // The link and the browser's storage give the code back.
  await press("Put it into the address")();
  await until(async () => (await address()).includes("code="), "code in the address");
  const link = await address();
  await page.evaluate(() => localStorage.clear());
  await open(link);
  await judged("the code of the link");
  equal(await kept(), last, "code from the link");
  await page.reload();
  await judged("the code after a reload");
  equal(await kept(), last, "code after a reload");

  // Right code that looks at every pixel for every triangle takes long, and passes.
  const slow = last.replace(/function draw/, "function unused").concat(slowDraw);
  ok((await changed(give(slow), "slow code")).startsWith("Passed"), "slow right code");

  const write = async (code) => {
    await page.getByLabel("Your rasterizer").click();
    await page.keyboard.press("Control+A");
    await page.keyboard.insertText(code);
  };
  const loop = "function draw() {\n  for (;;);\n}";
  const ended = await changed(() => write(loop), "a loop");
  ok(/^Line 2: RangeError: stopped after \d+ million steps/.test(ended), `an endless loop is ended: ${ended}`);
  const unknown = "function draw(view) {\n\n  return unknown;\n}";
  equal(await changed(() => write(unknown), "a name"), "Line 3: ReferenceError: unknown is not defined", "error");
  const unclosed = "function draw(view) {\n  return [;\n}";
  ok((await changed(() => write(unclosed), "a bracket")).startsWith("Line 2: SyntaxError"), "syntax error");
  ok((await changed(() => write("function draw() {}"), "nothing")).startsWith("draw must return"), "no answer");

  await step.selectOption("1");
  await changed(press("Start code of this step"), "step 2");
  await page.getByLabel("Your rasterizer").click();
  await page.keyboard.press("Control+End");
  ok((await changed(() => page.keyboard.type("// typed"), "typing")).startsWith("Not yet"), "typed code is judged");
}
