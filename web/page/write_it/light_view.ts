// The Cornell box lit by the student's functions, and beside it by the core.
import {exposureOf, litColours} from "../colours";
import {element} from "../controls";
import {SceneView} from "../scene_view";
import type {Finding, StudentRoom} from "./light_tasks";

export class LightView {
  private readonly views: SceneView[];

  constructor(parent: HTMLElement, {scene, elements}: StudentRoom, {own, right}: NonNullable<Finding["light"]>) {
    const exposure = exposureOf(right);
    this.views = [["Yours", own] as const, ["hemitex", right] as const].map(([label, light]) => {
      const figure = element(parent, "figure");
      element(figure, "figcaption", {textContent: label});
      const view = new SceneView(figure, {label: `${label}: the lit room`, scene, elements});
      view.setColours(litColours(light, exposure));
      return view;
    });
  }

  dispose(): void {
    for (const view of this.views) view.dispose();
  }
}
