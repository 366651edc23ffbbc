// The start: what the method is, and the Cornell box lit by it.
import {columns, element, sourceLink, status, text} from "./controls";
import type {Lesson} from "./lesson";
import {litColours, SceneView} from "./scene_view";

export const lesson: Lesson = {
  id: "start",
  title: "Start",
  show(root, {scene}) {
    const [left, right] = columns(root);
    const elements = scene("cornell-box").discretize({texels: 16});
    const solution = elements.solve({resolution: 64, shots: 40, residual: 0.05});
    const view = new SceneView(left, {label: "The Cornell box in 3-D", scene: scene("cornell-box"), elements});
    view.setColours(litColours(solution.radiosity()));
    text(
      right,
      "Radiosity is the light that leaves each small part of a surface, an <em>element</em>, when all surfaces are " +
        "matt. To find how much light each element gets from a patch, a graphics card draws the scene on the five " +
        "faces of a <em>hemicube</em> over the patch: each pixel holds the ID of the element that it shows " +
        "(Cohen and Greenberg 1985). In the method of Nielsen and Christensen (2002) a texture holds the IDs of the " +
        "elements of a surface, so that the card draws the surface's few triangles and not a polygon per element.",
    );
    text(
      right,
      "This page runs the code of hemitex itself, compiled to WebAssembly. Each lesson has things to move and a " +
        "question that the page checks. Its settings are in the address: send a link to show the same.",
    );
    const {shots, milliseconds, residual} = solution.info();
    const {elements: count} = elements.info();
    status(left, "solve").set(
      `${count} elements, ${shots} shots in ${milliseconds.toPrecision(3)} ms; ` +
        `${(100 * residual).toPrecision(2)} % of the light is unshot.`,
    );
    const list = element(right, "p", {className: "source"});
    list.textContent =
      "Nielsen and Christensen 2002, Fast Texture-Based Form Factor Calculations for Radiosity using Graphics " +
      "Hardware, Journal of Graphics Tools 6(4). Cohen and Greenberg 1985, The Hemi-cube, SIGGRAPH '85.";
    sourceLink(right, "README.md", "More");
    return () => view.dispose();
  },
};
