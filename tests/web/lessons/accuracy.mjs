// Errors of rows of form factors against those of hemitex formfactors with the same rays as the truth.

const common = ["--texels", "8", "--from"];

/** The mean of the rays of the lesson. */
function truthOf(formFactors, from) {
  const rays = [...common, from, "--method", "rays", "--samples", "262144", "--seed"];
  const rows = Array.from({length: 8}, (_, slice) => formFactors(...rays, String(slice + 1)));
  return rows[0].map((_, e) => rows.reduce((sum, factors) => sum + factors[e] / rows.length, 0));
}

const errorOf = (factors, truth) => factors.reduce((sum, factor, e) => sum + Math.abs(factor - truth[e]), 0);
const hemicube = (resolution, orientation, split) =>
  ["--resolution", resolution, "--orientation", orientation, "--split", split];

export default async function check(page, {close, ok, value, until, open, address, answers, formFactors, isShort}) {
  const known = () => until(async () => (await value("truth")).startsWith("Truth"), "the rays of the truth are cast");
  const error = async () => Number((await value("error")).match(/error ([\d.]+)/)[1]);
  const cases = [
    ["source=wall-red&resolution=64&rotated=1&split=0", "wall-red", hemicube("64", "turned", "1")],
    ["source=wall-red&resolution=64&rotated=0&split=1", "wall-red", hemicube("64", "aligned", "0.003")],
    ["source=light&resolution=32&rotated=1&split=1", "light", hemicube("32", "turned", "0.003")],
    ["source=short-block%231&method=rays&samples=4096", "short-block#1", ["--method", "rays", "--samples", "4096"]],
    ["source=element&resolution=256", "wall-back:4,4", hemicube("256", "turned", "1")],
  ];
  const truths = {};
  for (const [settings, from, options] of isShort ? cases.slice(2, 4) : cases) {
    truths[from] ??= truthOf(formFactors, from);
    const start = Date.now();
    await open(settings);
    await known();
    console.log(`     ${settings}: ${await value("error")}; ${Date.now() - start} ms with the truth`);
    close(await error(), errorOf(formFactors(...common, from, ...options), truths[from]), 2e-6, settings);
  }

  await open("source=wall-red&resolution=64&rotated=1&split=0");
  await known();
  const coarse = await error();
  const slider = page.getByRole("slider", {name: "Pixels along the side of the top face"});
  await slider.focus();
  for (let i = 0; i < 2; ++i) await page.keyboard.press("ArrowRight");
  await until(async () => (await error()) !== coarse, "the finer row is drawn");
  ok((await error()) > 0.9 * coarse, "more pixels hardly help");
  await page.getByLabel("Subdivide patches").check();
  await until(async () => (await error()) < 0.1 * coarse, "more centres help");
  await until(async () => /resolution=256.*split=1/.test(await address()), "the settings are in the address");
  await page.getByRole("button", {name: "Try all settings"}).click();
  await until(async () => (await value("truth")).startsWith("Trying"), "the settings are tried");
  await known();

  await answers([[/Rotation is needed/, "Not yet"], [/The centres/, "Right"]]);
}
