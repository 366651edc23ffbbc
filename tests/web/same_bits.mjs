// The WebAssembly core in a browser has the bits of the command line: the item IDs of all vectors of the suite, and
// elements.csv of a solution of the Cornell box. Both are compared by their SHA-256.
import {createHash} from "node:crypto";
import {readdirSync, readFileSync} from "node:fs";
import {join} from "node:path";

function hashOf(files) {
  const hash = createHash("sha256");
  for (const file of files) hash.update(readFileSync(file));
  return hash.digest("hex");
}

/** The hash of the item IDs of each vector of a suite, by name. */
function hashesOfSuite(suite) {
  return Object.fromEntries(readdirSync(suite).sort().map((name) => {
    const {faces} = JSON.parse(readFileSync(join(suite, name, "vector.json"), "utf8"));
    return [name, hashOf(faces.map(({words}) => join(suite, name, words)))];
  }));
}

/** The same of the core that the page starts, and the hash of elements.csv; runs in the page. */
async function hashesInPage(files) {
  const core = await hemitexCore();
  const hashOf = async (parts) => {
    const bytes = new Uint8Array(await new Blob(parts).arrayBuffer());
    const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
    return [...digest].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  };
  const vectors = await Promise.all(core.suite().map(async (vector) => [vector.name(), await hashOf(vector.render())]));
  const solution = core.loadScene(files, "cornell-box.obj").discretize({texels: 8}).solve({resolution: 128});
  return {vectors: Object.fromEntries(vectors.sort()), elements: await hashOf([solution.csv()])};
}

export async function checkSameBits(page, {run, equal, folder}) {
  run("vector", "suite", "-o", join(folder, "suite"));
  const settings = ["--texels", "8", "--resolution", "128", "--no-textures"];
  run("solve", "data/cornell-box.obj", ...settings, "-o", join(folder, "box"));
  const data = new URL("../../data/", import.meta.url);
  const files = Object.fromEntries(["cornell-box.obj", "cornell-box.mtl"].map((name) =>
    [name, readFileSync(new URL(name, data), "utf8")]));
  const {vectors, elements} = await page.evaluate(hashesInPage, files);
  equal(vectors, hashesOfSuite(join(folder, "suite")), "item IDs of the suite");
  equal(elements, hashOf([join(folder, "box", "elements.csv")]), "elements.csv");
}
