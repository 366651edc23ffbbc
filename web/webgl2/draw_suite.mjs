// node draw_suite.mjs SUITE ANSWERS [BROWSER [API]]: draws a suite of test vectors in headless Chromium and writes the
// item IDs, one folder per vector. API is webgl2 or webgpu. It serves the page, its scripts and the vectors on a port
// of this machine. Exit code: 1 if a vector was not drawn, 124 if the browser asked for nothing for 60 seconds.
import {spawn} from "node:child_process";
import {mkdirSync, mkdtempSync, readdirSync, readFileSync, writeFileSync} from "node:fs";
import {createServer} from "node:http";
import {tmpdir} from "node:os";
import {basename, dirname, join, normalize} from "node:path";

import {removeProfile} from "./browser_profile.mjs";

const [suite, answers, browser = "chromium", api = "webgl2"] = process.argv.slice(2);
if (!answers) {
  console.error("usage: node draw_suite.mjs SUITE ANSWERS [BROWSER [webgl2|webgpu]]");
  process.exit(2);
}
const web = dirname(import.meta.dirname ?? dirname(new URL(import.meta.url).pathname));
const types = {html: "text/html", js: "text/javascript"};
const failures = [];

async function bodyOf(request) {
  const parts = [];
  for await (const part of request) parts.push(part);
  return Buffer.concat(parts);
}

function answer(path) {
  const [folder, vector, file] = path.split("/");
  if (path === "suite") return JSON.stringify(readdirSync(suite).sort());
  if (folder === "suite") return readFileSync(join(suite, basename(vector), basename(file)));
  return readFileSync(join(web, normalize("/" + path)));
}

function take(path, body) {
  const [folder, vector, file] = path.split("/");
  if (path === "failures") failures.push(body.toString());
  if (path === "done") end(failures.length ? 1 : 0);
  if (folder !== "answers") return;
  mkdirSync(join(answers, basename(vector)), {recursive: true});
  writeFileSync(join(answers, basename(vector), basename(file)), body);
}

const server = createServer(async (request, response) => {
  silence.refresh();
  const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname.slice(1));
  try {
    if (request.method === "PUT") {
      take(path, await bodyOf(request));
      response.end();
    } else {
      const body = answer(path);
      response.writeHead(200, {"Content-Type": types[path.split(".").pop()] ?? "application/octet-stream"});
      response.end(body);
    }
  } catch (error) {
    response.writeHead(404);
    response.end(String(error));
  }
});

let chromium;
// Chromium starts without a request now and then.
const silence = setTimeout(() => {
  failures.push("the browser asked for nothing for 60 seconds");
  end(124, "SIGKILL");
}, 60000);
const profile = mkdtempSync(join(tmpdir(), "hemitex-"));

function end(code, signal) {
  clearTimeout(silence);
  chromium.removeAllListeners("exit");
  chromium.on("exit", async () => {
    await removeProfile(profile);
    for (const failure of failures) console.error(failure);
    process.exit(code);
  });
  chromium.kill(signal);
}

server.listen(0, "127.0.0.1", () => {
  const address = `http://127.0.0.1:${server.address().port}/webgl2/page.html?api=${api}`;
  const swiftShader = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-unsafe-webgpu",
    "--use-webgpu-adapter=swiftshader"];
  const options = ["--headless", "--no-sandbox", "--no-first-run", `--user-data-dir=${profile}`,
    "--remote-debugging-port=0"];
  chromium = spawn(browser, [...options, ...swiftShader, address], {stdio: "ignore"});
  chromium.on("exit", () => {
    console.error("the browser ended before the suite was drawn");
    process.exit(1);
  });
  chromium.on("error", (error) => {
    console.error(`${browser} cannot be started: ${error.message}`);
    process.exit(2);
  });
});
