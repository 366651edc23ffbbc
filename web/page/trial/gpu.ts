// The visitor's GPU draws the suite of test vectors, and the page judges it.
import {button, choice, columns, element, question, row, sourceLink, status, text} from "../controls";
import type {Lesson, Page} from "../lesson";
import {deviceChoices, openDevice} from "./devices";
import {showTrial, verdictText} from "./result";
import {runTrial} from "./trial";

const intro =
  "The <em>test vectors</em> are small draw lists whose item IDs are known. The button draws all of them on your " +
  "GPU. A pixel is <em>exact</em> if it holds the item ID of the raster rules. It is <em>explained</em> if a right " +
  "device may round a corner, a texture coordinate or a depth that way. Otherwise it is an <em>error</em>. Nothing " +
  "leaves this page.";

const precision =
  "Vulkan and OpenGL allow 4 sub-pixel bits; most GPUs have 8. So <em>probes</em> first measure the profile of the " +
  "device: each of their pixels depends on one property. In single precision a texture coordinate may be wrong by " +
  "some roundings. One is " +
  `<math><mi>r</mi><mo>=</mo><msup><mn>2</mn><mn>−24</mn></msup><mi>N</mi><mspace width="0.2em"/><mi>max</mi>
   <mo>|</mo><msub><mi>u</mi><mi>k</mi></msub><mo>|</mo><mi>w</mi><mo>/</mo><mi>min</mi><mspace width="0.2em"/>
   <msub><mi>w</mi><mi>k</mi></msub></math> ` +
  "texels (docs/item-buffers.md): N is the size of the map, u<sub>k</sub> and w<sub>k</sub> belong to the corners of " +
  "the triangle, and w to the sample. The verdict allows as many roundings as the probes show.";

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

/** The choice of a device and the button that judges it. Returns what ends the trial. */
function addControls(root: HTMLElement, page: Page, showIn: () => HTMLElement[]): () => void {
  let chosen = page.state.option("device", deviceChoices.map(([value]) => value), "webgl2");
  let trial = new AbortController(); // aborted when the next one starts, and at the end of the lesson

  const judge = async (signal: AbortSignal) => {
    const device = await openDevice(chosen);
    if (signal.aborted) return device.close();
    signal.addEventListener("abort", device.close);
    const result = await runTrial(page.core, device, (done) => (progress.value = done), signal);
    const [left, right] = showIn();
    showTrial(left, right, page, result, signal);
    verdict.set(verdictText(result));
  };
  const run = async () => {
    trial.abort();
    trial = new AbortController();
    const {signal} = trial;
    for (const box of showIn()) box.replaceChildren();
    verdict.set("Draws the suite ...");
    start.disabled = true;
    progress.hidden = false;
    try {
      await judge(signal);
    } catch (error) {
      if (!signal.aborted) verdict.set(`Not judged: ${error instanceof Error ? error.message : error}.`);
    }
    start.disabled = false;
    progress.hidden = true;
  };

  const controls = row(root);
  choice(controls, {label: "Device", options: deviceChoices, value: chosen}, (value) => {
    chosen = value;
    page.state.set("device", value);
  });
  const start = button(controls, "Draw the suite", () => void run());
  const progress = element(controls, "progress", {max: 1, value: 0, ariaLabel: "Progress", hidden: true});
  const verdict = status(controls, "gpu-state");
  return () => trial.abort();
}

export const lesson: Lesson = {
  id: "gpu",
  title: "Your own GPU on trial",
  show(root, page) {
    text(root, intro);
    const end = addControls(root, page, () => results);
    const sides = columns(root);
    const results = sides.map((side) => element(side, "div"));
    text(sides[0], precision);
    addQuestion(sides[0]);
    sourceLink(sides[1], "web/webgl2/backend.js", "What draws with WebGL2");
    sourceLink(sides[1], "web/webgpu/backend.js", "What draws with WebGPU");
    return end;
  },
};
