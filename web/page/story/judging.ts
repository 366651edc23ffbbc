// The last steps: a faulty device, the student's own rasterizer, and the visitor's GPU.
import {Comparison} from "../comparison";
import {button, choice, status, text} from "../controls";
import type {Core, Vector} from "../core";
import {drawWithFault} from "../faulty_device";
import {openDevice} from "../trial/devices";
import {Sandbox} from "../write_it/sandbox";
import {allSteps, startOf} from "../write_it/steps";
import {viewsOf} from "../write_it/views";
import type {Step} from "./step";
import {addHandle} from "./handle";

/** Faults, and vectors that show them. */
const faults: Record<string, string> = {
  "affine instead of perspective interpolation": "perspective-floor",
  "index map upside down": "rectangular-map",
  "linear filtering": "magnified",
  "depth test off": "crossing",
  "wrong fill rule": "sample-grid-later-nearer",
  "picture upside down": "five-faces",
};

function suiteVector(core: Core, name: string): Vector {
  return core.suite().find((vector) => vector.name() === name)!;
}

function show(comparison: Comparison, vector: Vector, found: Uint32Array, face = 0): number {
  const expected = vector.render()[face],
    {background, faces} = vector.json();
  const [, , columns, rows] = faces[face].scissor;
  comparison.show({columns, rows, background, expected, found});
  return expected.filter((id, pixel) => id !== found[pixel]).length;
}

export const fault: Step = {
  name: "fault",
  title: "Break it",
  text: `If a single pixel holds a wrong number, light goes to a wrong element. A device may smooth the texture, take
    pixels at their corner, or forget the division by depth, and the picture still looks like a room. So hemitex has
    <em>test vectors</em>: small scenes with the right number for each pixel. Choose a fault, and see which pixels it
    changes. From the wrong pixels the program can name the fault: a diagnosis. <a href="#break">Break it</a> lets you
    find hidden faults yourself.`,
  paper: "section 3.2",
  source: "reference/conformance/diagnosis/fault.h",
  figure(root, {core, state}) {
    const names = Object.keys(faults);
    const value = state.option("fault", names, names[0]);
    const select = choice(root, {label: "Fault of the device", options: names, value}, (to) => {
      state.set("fault", to);
      draw(to);
    });
    const comparison = new Comparison(root, 170),
      found = status(root, "fault-pixels");
    const draw = (name: string) => {
      const vector = suiteVector(core, faults[name]),
        answers = drawWithFault(vector, name);
      const wrong = show(comparison, vector, answers[0]);
      found.set(`${wrong} wrong pixels. The diagnosis: ${vector.judge(answers, {}).findings() || "no fault"}`);
    };
    select.set(value);
    draw(value);
  },
  question: () => ({
    text: "Textures are filtered linearly. Between a texel with number 4 and one with number 8 a pixel gets 6. What is wrong?",
    options: [
      "The light goes to element 6, which may lie elsewhere",
      "Nothing: element 6 lies between them",
      "The pixel gets no light",
    ],
    right: 0,
    why: "Numbers of elements are names. Their mean is the name of another one.",
    whyNot: {
      "Nothing: element 6 lies between them": "Rows of the map follow one another: 6 can lie at its other end.",
      "The pixel gets no light": "Its share is added to the element whose number it holds.",
    },
  }),
};

export const write: Step = {
  name: "write",
  title: "Write it",
  text: `You have seen all parts. Now write them: a rasterizer in twelve steps, from a box of pixels to one that passes
    all test vectors, and then the light: delta form factors, a row, a shot, refinement, and the texture. The figure
    shows what a rasterizer can do after each of the twelve steps. Every step of <a href="#write">Write it</a> begins
    with a wrong picture, and the page judges your code at every change: which pixel is wrong first, and what it should
    hold.`,
  paper: "the whole paper",
  source: "raster/plain/rules.h",
  figure(root, page) {
    const {core} = page;
    const comparison = new Comparison(root, 170),
      found = status(root, "write-step");
    const vector = suiteVector(core, "perspective-clipped");
    const rasterizers = allSteps.filter(({light}) => !light).length;
    let wanted = 0;
    const draw = async (count: number) => {
      wanted = count;
      const sandbox = new Sandbox(count === 0 ? startOf(0) : allSteps[count - 1].solution);
      try {
        const [ids] = await sandbox.draw(viewsOf(vector).slice(0, 1));
        if (wanted !== count) return;
        const wrong = show(comparison, vector, ids);
        const last = count === 0 ? "Before the first step" : `After step ${count}, “${allSteps[count - 1].title}”`;
        found.set(`${last}: ${wrong} wrong pixels.`);
      } finally {
        sandbox.end();
      }
    };
    addHandle(
      root,
      page,
      "write",
      {label: "Steps done", range: {min: 0, max: rasterizers, step: 1}, otherwise: 9},
      (to) => void draw(to),
    );
  },
  question: () => ({
    text: "Two triangles share an edge that passes through the centre of a pixel. How often must it be drawn?",
    options: ["Once", "Never", "Twice"],
    right: 0,
    why: "The fill rule gives such centres to one of both triangles.",
    whyNot: {Never: "Then a crack runs along every edge.", Twice: "Then the result depends on the order of drawing."},
  }),
};

const shownVectors = 20;

export const gpu: Step = {
  name: "gpu",
  title: "Your GPU",
  text: `The paper leaves the work to the hardware. Does yours do it right? The button draws twenty test vectors on the
    GPU of this computer, and compares every pixel. Standards leave devices some freedom: how finely corners are
    rounded, how exactly textures are addressed. A pixel that this freedom explains is no error.
    <a href="#gpu">Your own GPU on trial</a> draws the whole suite, measures the freedom that your device takes, and
    writes a record that <code>hemitex vector verify</code> reads.`,
  paper: "section 4",
  source: "docs/backend.md",
  figure(root, {core}) {
    const found = status(root, "gpu-pixels");
    button(root, "Draw twenty test vectors", async () => {
      try {
        const device = await openDevice("webgl2"),
          counts = {exact: 0, explained: 0, errors: 0};
        for (const vector of core.suite().slice(0, shownVectors)) {
          const {pixels} = vector.judge(await device.draw(vector), {}).json();
          const all = Object.values(pixels).reduce((total, count) => total + count, 0);
          counts.exact += pixels.exact;
          counts.errors += pixels.error;
          counts.explained += all - pixels.exact - pixels.error;
        }
        device.close();
        found.set(`${counts.exact} pixels are exact, ${counts.explained} explained, ${counts.errors} errors.`);
      } catch (error) {
        found.set(`Not drawn: ${error instanceof Error ? error.message : error}.`);
      }
    });
    text(root, "Nothing leaves this page.");
  },
  question: () => ({
    text: "A device rounds corners to 1/16 pixel instead of 1/256. Is a pixel on a border that differs an error?",
    options: ["No, the standards allow it", "Yes, every difference is one"],
    right: 0,
    why: "Vulkan and OpenGL ask for 4 bits below the pixel; such pixels are explained.",
    whyNot: {"Yes, every difference is one": "Vulkan and OpenGL ask for only 4 bits below the pixel."},
  }),
};
