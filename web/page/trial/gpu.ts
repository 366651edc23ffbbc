// The visitor's GPU draws the suite of test vectors, and the page judges it.
import {button, choice, columns, element, question, row, sourceLink, status, text} from "../controls";
import type {Core} from "../core";
import type {Lesson, Page} from "../lesson";
import {deviceChoices, openDevice, type Device} from "./devices";
import {showProfile} from "./profile_table";
import {isMeasured, pixelsOf, runTrial, summaryOf, type Counts, type Trial} from "./trial";
import {showVectors} from "./vector_view";

const intro =
  "The <em>test vectors</em> are small draw lists whose item IDs are known. The button draws all of them on your " +
  "GPU. A pixel is <em>exact</em> if it holds the item ID of the raster rules, <em>explained</em> if a right device " +
  "may round a corner, a texture coordinate or a depth that way, and an <em>error</em> otherwise. Nothing leaves " +
  "this page.";

const precision =
  "Vulkan and OpenGL allow 4 sub-pixel bits; most GPUs have 8. So <em>probes</em> first measure the profile of the " +
  "device: each of their pixels depends on one property. In single precision a texture coordinate may be wrong by " +
  "some roundings of " +
  `<math><mi>r</mi><mo>=</mo><msup><mn>2</mn><mn>−24</mn></msup><mi>N</mi><mspace width="0.2em"/><mi>max</mi>
   <mo>|</mo><msub><mi>u</mi><mi>k</mi></msub><mo>|</mo><mi>w</mi><mo>/</mo><mi>min</mi><mspace width="0.2em"/>
   <msub><mi>w</mi><mi>k</mi></msub></math> ` +
  "texels, for a map of N texels, corners with u<sub>k</sub> and w<sub>k</sub>, and a sample of depth w " +
  "(docs/item-buffers.md). The verdict allows as many roundings as the probes show.";

const inThousands = (count: number): string => count.toLocaleString("en");

function showCounts(parent: HTMLElement, trial: Trial): void {
  const table = element(parent, "table");
  const head = element(table, "tr");
  for (const title of ["profile", "exact", "explained", "errors"])
    element(head, "th", {scope: "col", textContent: title});
  const add = (name: string, counts: Counts) => {
    const line = element(table, "tr");
    element(line, "th", {scope: "row", textContent: name});
    const {exact, explained, errors} = summaryOf(counts);
    for (const count of [exact, explained, errors]) element(line, "td", {textContent: inThousands(count)});
  };
  add("default", trial.byDefault.counts);
  add(isMeasured(trial) ? "measured" : "measured in part", trial.measured.counts);
}

/** What the counts mean: the class of the device, what contradicts it, and the fault. */
function remarks(core: Core, trial: Trial): string[] {
  const defaultReports = trial.byDefault.answers.map(({report}) => report);
  const reports = trial.measured.answers.map(({report}) => report);
  const deviceClass = isMeasured(trial) ? core.deviceClass(defaultReports) : "";
  const fault = core.commonFault(reports);
  return [
    ...(deviceClass ? [`Under the default profile, ${deviceClass}.`] : []),
    ...trial.contradictions.slice(0, 3).map((line) => `No device answers the probes this way: ${line}.`),
    ...(fault ? [`Diagnosis: ${fault}.`] : []),
  ];
}

function verdictText(trial: Trial): string {
  const {exact, explained, errors} = summaryOf(trial.measured.counts);
  const [a, b, c] = [exact, explained, errors].map(inThousands);
  return `${errors === 0 && isMeasured(trial) ? "Passed" : "Failed"}: ${a} exact, ${b} explained, ${c} errors`;
}

function addDownload(parent: HTMLElement, label: string, file: string, content: string, urls: string[]): void {
  const url = URL.createObjectURL(new Blob([content], {type: "application/json"}));
  urls.push(url);
  element(parent, "a", {href: url, download: file, textContent: label});
}

function addDownloads(parent: HTMLElement, core: Core, trial: Trial, urls: string[]): void {
  const {profile, answers} = isMeasured(trial) ? trial.measured : trial.byDefault;
  const {name, driver} = trial.device;
  const reports = answers.map(({report}) => report);
  const line = row(parent);
  addDownload(line, "Conformance record", "record.json", core.record(name, driver, profile, reports), urls);
  if (isMeasured(trial)) addDownload(line, "Profile", "profile.json", JSON.stringify(profile, null, 2), urls);
}

function showTrial(left: HTMLElement, right: HTMLElement, page: Page, trial: Trial, urls: string[]): void {
  const {core} = page;
  const {answers, counts} = trial.measured;
  const seconds = (trial.milliseconds / 1000).toPrecision(3);
  element(left, "p", {
    textContent:
      `${trial.device.name}: ${answers.length} vectors, ${inThousands(pixelsOf(counts))} pixels, ` +
      `${seconds} s.`,
  });
  showCounts(left, trial);
  const remarkBox = element(left, "div");
  remarkBox.dataset.testid = "gpu-remarks";
  for (const remark of remarks(core, trial)) element(remarkBox, "p", {textContent: remark});
  if (isMeasured(trial)) {
    element(left, "h3", {textContent: "Profile of the device"});
    showProfile(left, trial.measured.profile);
  }
  addDownloads(left, core, trial, urls);
  showVectors(right, page, trial);
}

function addQuestion(parent: HTMLElement): void {
  question(parent, {
    text: "A GPU has errors under the default profile and none under its measured profile. What follows?",
    options: [
      "It is broken: the default profile is the standard.",
      "It is a right device of another class than the default profile.",
      "Its driver is right, and its hardware is not.",
    ],
    right: 1,
    why:
      "An API leaves precision to the device: Vulkan requires at least 4 sub-pixel bits (Vulkan 1.3, table Required " +
      "Limits, subPixelPrecisionBits). The measured profile allows what this device does, and nothing more.",
  });
}

export const lesson: Lesson = {
  id: "gpu",
  title: "Your own GPU on trial",
  show(root, page) {
    const ended = new AbortController();
    const urls: string[] = [];
    let device: Device | null = null;
    let chosen = page.state.text("device", "webgl2");

    const clear = () => {
      for (const url of urls.splice(0)) URL.revokeObjectURL(url);
      device?.close();
      device = null;
      results.forEach((box) => box.replaceChildren());
    };
    const run = async () => {
      clear();
      start.disabled = true;
      state.set("Draws the suite ...");
      progress.hidden = false;
      try {
        device = await openDevice(chosen);
        const trial = await runTrial(page.core, device, (done) => (progress.value = done), ended.signal);
        showTrial(results[0], results[1], page, trial, urls);
        state.set(verdictText(trial));
      } catch (error) {
        if (!ended.signal.aborted) state.set(`Not judged: ${error instanceof Error ? error.message : error}.`);
      }
      if (ended.signal.aborted) clear();
      progress.hidden = true;
      start.disabled = false;
    };

    text(root, intro);
    const controls = row(root);
    choice(controls, {label: "Device", options: deviceChoices, value: chosen}, (value) => {
      chosen = value;
      page.state.set("device", value);
    });
    const start = button(controls, "Draw the suite", () => void run());
    const progress = element(controls, "progress", {max: 1, value: 0, ariaLabel: "Progress", hidden: true});
    const state = status(controls, "gpu-state");
    const sides = columns(root);
    const results = sides.map((side) => element(side, "div"));
    text(sides[0], precision);
    addQuestion(sides[0]);
    sourceLink(sides[1], "web/webgl2/backend.js", "What draws with WebGL2");
    sourceLink(sides[1], "web/webgpu/backend.js", "What draws with WebGPU");
    return () => {
      ended.abort();
      clear();
    };
  },
};
