// node build.mjs: writes build/web/hemitex.html, the page in one file that needs no network. It holds the script of the
// page, the WebAssembly core and the Cornell box. The core is built by ./run web before.
import {build} from "esbuild";
import {mkdirSync, readdirSync, readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {fileURLToPath} from "node:url";
import {gzipSync} from "node:zlib";

const maxCompressed = 3e6; // bytes

const web = fileURLToPath(new URL(".", import.meta.url));
const top = join(web, "..");
const output = join(top, "build/web/hemitex.html");
const sceneNames = ["cornell-box.obj", "cornell-box.mtl", "cornell-box.view.json"];

const read = (path) => readFileSync(join(top, path), "utf8");

/** A script that can stand in an HTML file: the end of the element and comments would change how it is read. */
function embedded(script) {
  return script.replaceAll(/<(\/script|!--)/gi, "\\x3c$1");
}

/** style.css, then the styles beside the lessons and the story, which may overrule it. */
function styles() {
  const lessons = readdirSync(join(web, "page/lessons")).filter((name) => name.endsWith(".css"));
  const paths = ["style.css", ...lessons.sort().map((name) => `lessons/${name}`), "story/story.css"];
  return paths.map((path) => read(`web/page/${path}`)).join("");
}

/** The licences of the npm packages in a bundle, which ask to be in each copy. */
function licences(inputs) {
  const packages = new Set(inputs.flatMap((path) => path.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+/) ?? []));
  return [...packages].sort().map((folder) => {
    const name = readdirSync(folder).find((file) => /^licen[cs]e/i.test(file));
    const text = readFileSync(join(folder, name), "utf8").replaceAll("--", "- -"); // it stands in a comment
    return `${folder.split("node_modules/").pop()}:\n${text}`;
  }).join("\n");
}

const bundle = await build({
  entryPoints: [join(web, "page/main.ts")],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  write: false,
  metafile: true,
  define: {sceneFiles: JSON.stringify(Object.fromEntries(sceneNames.map((name) => [name, read(`data/${name}`)])))},
});
const parts = {
  "/*STYLE*/": styles(),
  "/*CORE*/": embedded(read("build/web/core/hemitex_core.js")),
  "/*PAGE*/": embedded(bundle.outputFiles[0].text),
  "LICENCES": licences(Object.keys(bundle.metafile.inputs)),
};
// By a function: replace() expands $& and the like in a string.
let page = read("web/page/index.html");
for (const [mark, part] of Object.entries(parts)) page = page.replace(mark, () => part);
mkdirSync(join(top, "build/web"), {recursive: true});
writeFileSync(output, page);

const size = Buffer.byteLength(page);
const compressed = gzipSync(page, {level: 9}).length;
console.log(`${output}: ${(size / 1e6).toFixed(2)} MB, ${(compressed / 1e6).toFixed(2)} MB compressed`);
if (compressed > maxCompressed) {
  console.error(`error: more than ${maxCompressed / 1e6} MB compressed`);
  process.exit(1);
}
