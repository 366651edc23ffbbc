// The lesson "Write it": each step fails with its start and passes with its solution, the last one on all vectors of
// the suite. Errors are shown with their lines, and an endless loop is ended.
export default async function check(page, {ok, equal, value, until, address}) {
  const verdict = /^(Passed|Not yet|\d+ of|Line|Stopped|draw)/;
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

  await judged("the start");
  for (let k = 1; k <= 12; ++k) {
    const before = await changed(press(k === 1 ? "Start code of this step" : "Next step"), `step ${k}`);
    equal(await step.inputValue(), String(k - 1), "step");
    ok(/Not yet: \d+ wrong pixels? in .*/.test(before), `start of step ${k}: ${before}`);
    ok(/expected .*, found .*/.test(await value("pixel")), `first wrong pixel of step ${k}`);
    ok((await page.locator(".derivation tr").count()) > 0, `derivation in step ${k}`);
    const after = await changed(press("Show a solution"), `solution ${k}`);
    ok(after.startsWith("Passed: every pixel of"), `solution ${k}: ${after}`);
    if (k === 12) ok(after.includes("of 90 test vectors"), after);
  }
  await until(async () => (await address()) === "step=12", "step in the address");

  const write = async (code) => {
    await page.getByLabel("Your rasterizer").click();
    await page.keyboard.press("Control+A");
    await page.keyboard.insertText(code);
  };
  const loop = "function draw() {\n  for (;;);\n}";
  ok((await changed(() => write(loop), "a loop")).startsWith("Stopped after 2 seconds"), "an endless loop is ended");
  const unknown = "function draw(view) {\n\n  return unknown;\n}";
  equal(await changed(() => write(unknown), "a name"), "Line 3: ReferenceError: unknown is not defined", "error");
  const open = "function draw(view) {\n  return [;\n}";
  ok((await changed(() => write(open), "a bracket")).startsWith("Line 2: SyntaxError"), "syntax error");
  ok((await changed(() => write("function draw() {}"), "nothing")).startsWith("draw must return"), "no answer");

  await step.selectOption("1");
  await changed(press("Start code of this step"), "step 2");
  await page.getByLabel("Your rasterizer").click();
  await page.keyboard.press("Control+End");
  ok((await changed(() => page.keyboard.type("// typed"), "typing")).startsWith("Not yet"), "typed code is judged");
}
