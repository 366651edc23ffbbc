// The start: what the method is, and the Cornell box lit by it.
import {litColours} from "./colours";
import {columns, element, sourceLink, status, text} from "./controls";
import type {Lesson} from "./lesson";
import {shortNumber} from "./numbers";
import {SceneView} from "./scene_view";

export const lesson: Lesson = {
  id: "start",
  title: "Start",
  show(root, {cornellBox}) {
    const [left, right] = columns(root);
    const scene = cornellBox();
    const elements = scene.discretize({texel_size: 35});
    const solution = elements.solve({resolution: 128, split: 1, rotated: false, residual: 0.1});
    const view = new SceneView(left, {label: "The Cornell box in 3-D", scene, elements});
    view.setColours(litColours(solution.radiosity()));
    text(
      right,
      "Radiosity is the light that leaves each <em>element</em>, a small part of a matt surface. " +
        "The scene is drawn on a <em>hemicube</em> over a patch (Cohen and Greenberg 1985): what its pixels show " +
        "gets the light of the patch. A texture gives each pixel the number of its element (Nielsen and Christensen " +
        "2002). So a graphics card draws whole surfaces, not a polygon per element.",
    );
    text(
      right,
      "This page runs the code of hemitex itself, compiled to WebAssembly. Each lesson has things to move and a " +
        "question that the page checks. Its settings are in the address: send a link to show the same.",
    );
    const {shots, milliseconds, residual} = solution.info();
    const {elements: count} = elements.info();
    status(left, "solve").set(
      `${count} elements, ${shots} shots in ${shortNumber(milliseconds)} ms; ` +
        `${(100 * residual).toPrecision(2)} % of the light is unshot.`,
    );
    element(right, "p", {className: "source"}).innerHTML =
      "Nielsen and Christensen 2002, <cite>Fast Texture Based Form Factor Calculations for Radiosity using Graphics " +
      "Hardware</cite>. Cohen and Greenberg 1985, <cite>The Hemi-Cube: A Radiosity Solution for Complex " +
      "Environments</cite>.";
    sourceLink(right, "README.md", "The project");
    return () => view.dispose();
  },
};
