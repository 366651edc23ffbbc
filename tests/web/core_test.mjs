// node core_test.mjs HEMITEX CORE: compares the WebAssembly core with the native program, bit for bit.
//
// - Item IDs of all vectors of the suite, which one rule defines (docs/item-buffers.md).
// - elements.csv of a solution of the Cornell box: the same bytes.
// - Rows of form factors by hemicubes, and by rays, whose hits another search finds.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {createHash} from "node:crypto";
import {mkdtempSync, readdirSync, readFileSync, rmSync} from "node:fs";
import {createRequire} from "node:module";
import {tmpdir} from "node:os";
import {join, resolve} from "node:path";
import test, {after} from "node:test";
import {fileURLToPath} from "node:url";

const [hemitex, coreFile] = process.argv.slice(2);
if (!coreFile) {
  console.error("usage: node core_test.mjs HEMITEX CORE");
  process.exit(2);
}
const data = fileURLToPath(new URL("../../data", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "hemitex-core-"));
after(() => rmSync(folder, {recursive: true}));

const run = (...words) => execFileSync(hemitex, words, {encoding: "utf8", maxBuffer: 1 << 28, stdio: "pipe"});
const hexOfSha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");
const core = await createRequire(import.meta.url)(resolve(coreFile))({sha256: hexOfSha256});

const files = Object.fromEntries(["obj", "mtl", "view.json"].map((end) =>
  [`cornell-box.${end}`, readFileSync(join(data, `cornell-box.${end}`), "utf8")]));
const box = core.loadScene(files, "cornell-box.obj");
const boxFile = join(data, "cornell-box.obj");

// A file of item IDs is the little-endian numbers of a face.
const idsIn = (file) => new Uint32Array(new Uint8Array(readFileSync(file)).buffer);

test("all vectors of the suite have the item IDs of the native program", () => {
  const suite = join(folder, "suite");
  run("vector", "suite", "-o", suite);
  const vectors = core.suite();
  assert.deepEqual(vectors.map((vector) => vector.name()).sort(), readdirSync(suite).sort());
  for (const vector of vectors) {
    const buffers = vector.render();
    vector.json().faces.forEach((face, k) =>
      assert.deepEqual(buffers[k], idsIn(join(suite, vector.name(), face.words)), vector.name()));
  }
});

test("vector.json and its arrays are those of the native program", () => {
  for (const vector of core.suite().slice(0, 20)) {
    const written = join(folder, "suite", vector.name());
    const native = JSON.parse(readFileSync(join(written, "vector.json"), "utf8"));
    for (const face of native.faces) face.hash = "";
    const own = vector.json();
    for (const face of own.faces) face.hash = "";
    assert.deepEqual(own, native);
    assert.deepEqual(Buffer.from(vector.arrays().positions.buffer), readFileSync(join(written, native.positions)));
  }
});

test("a solution of the Cornell box has the elements.csv of the native program", () => {
  const native = join(folder, "solved");
  run("solve", boxFile, "--texels", "8", "--resolution", "128", "--no-textures", "--size", "8x6", "-o", native);
  const solution = box.discretize({texels: 8}).solve({resolution: 128});
  assert.equal(solution.csv(), readFileSync(join(native, "elements.csv"), "utf8"));
});

const factorsIn = (csv) => csv.trim().split("\n").slice(1).map((line) => Number(line.split(",")[4]));

// Hemicubes and rays compute the same bits. Closed forms call atan2 and log of the C library, which may round the last
// of 53 bits differently, and sum about 10 terms.
for (const [name, options, settings, tolerance] of [
  ["hemicubes", ["--resolution", "64"], {resolution: 64}, 0],
  ["rays", ["--method", "rays", "--samples", "4096"], {method: "rays", samples: 4096}, 0],
  ["closed forms", ["--method", "analytic"], {method: "analytic"}, 1e-13],
])
  test(`a row of form factors by ${name} is that of the native program`, () => {
    const native = factorsIn(run("formfactors", boxFile, "--texels", "8", "--from", "floor", ...options));
    const row = [...box.discretize({texels: 8}).row({surface: "floor"}, settings).formFactors];
    const [some, others] = [native, row].map((factors) => factors.filter((factor) => factor > 0));
    assert.equal(others.length, some.length);
    some.forEach((factor, k) =>
      assert.ok(Math.abs(others[k] - factor) <= tolerance * factor, `${k}: ${others[k]}, ${factor}`));
  });

test("an editable solution shoots, and its flux balances", () => {
  const solution = box.discretize({texels: 8, editable: true}).solve({editable: true, shots: 0, resolution: 64});
  let residual = solution.info().residual;
  for (let k = 0; k < 5; ++k) {
    const info = solution.shoot(10);
    assert.ok(info.residual < residual);
    residual = info.residual;
    for (let band = 0; band < 3; ++band) {
      const {emitted, absorbed, unshot, lost} = info.energy;
      assert.ok(Math.abs(emitted[band] - absorbed[band] - unshot[band] - lost[band]) < 1e-9 * emitted[band]);
    }
  }
  const moved = solution.edit([{edit: "move", name: "short-block", by: [-20, 0, 0]}], 100);
  assert.ok(moved.residual > 0);
});

test("wrong input is an error of JavaScript with the message of the library", () => {
  assert.throws(() => core.loadScene({"a.obj": "v 0 0 x\n"}, "a.obj"), /a\.obj:1/);
  assert.throws(() => core.loadScene({"a.gltf": "{}"}, "a.gltf"), /glTF/);
  assert.throws(() => box.discretize({texels: 0}), /texels/);
  const elements = box.discretize({texels: 4, editable: true});
  assert.throws(() => elements.hemicube(1e6, {}), /no element 1000000/);
  for (const [settings, message] of [
    [{resolution: 15}, /even/],
    [{format: "x"}, /format/],
    [{elements: "x"}, /elements/],
    [{blend: "replace"}, /no blend/],
  ])
    assert.throws(() => elements.hemicube(0, settings), message);
  assert.throws(() => elements.row({surface: "x"}, {}), /no surface/);
  for (const [settings, message] of [[{method: "x"}, /no method/], [{method: "rays", samples: 0}, /rays/]])
    assert.throws(() => elements.row({element: 0}, settings), message);
  assert.throws(() => elements.solve({shots: -1}), /shots/);
  const solution = elements.solve({editable: true, shots: 1, resolution: 16});
  assert.throws(() => solution.edit([{edit: "x", name: "floor"}], 1), /no edit/);
  assert.throws(() => solution.shoot(0), /shots/);
  assert.equal(solution.shoot(1).shots, 1);
});

test("wrong item buffers, faces, pixels and faults are errors of JavaScript", () => {
  const vector = core.suite()[0];
  assert.throws(() => core.readVector({}), /vector\.json/);
  assert.throws(() => vector.explain("x", 0, 0), /no face/);
  assert.throws(() => vector.explain(vector.json().faces[0].name, -1, 0), /no pixel/);
  assert.throws(() => vector.judge([], {}), /one item buffer per face/);
  assert.throws(() => vector.judge([new Uint32Array(3)], {}), /size of its face/);
  assert.throws(() => vector.judge(vector.render(), {unknown: 1}), /not a key/);
  assert.throws(() => vector.minimize(vector.render(), {}), /no errors/);
  assert.throws(() => vector.drawFault(1e6, 0), /no fault/);
  assert.equal(vector.judge(vector.render(), {}).findings(), "");
});
