// The controls that change the scene.
import {checkbox, choice, row, slider} from "../controls";
import type {State} from "../lesson";
import {emissions, objects, walls, type Changes} from "./changes";

type MovedObject = (typeof objects)[number];

/** Write into `wanted` and call `changed`. */
export class SceneControls {
  private readonly sliders: HTMLElement;

  constructor(
    parent: HTMLElement,
    private readonly state: State,
    private readonly wanted: Changes,
    private readonly changed: () => void,
  ) {
    const line = row(parent);
    this.sliders = row(parent);
    this.addObjects(line);
    choice(line, {label: "Red wall", options: walls, value: wanted.wall}, (wall) => {
      state.set("wall", (wanted.wall = wall));
      changed();
    });
    this.addLamp(line);
  }

  private addObjects(parent: HTMLElement): void {
    const options = objects.map(({name, label}) => [name, label] as const);
    const value = this.state.option("object", objects.map(({name}) => name), "short-block");
    const show = (shown: string) => this.showSliders(objects.find(({name}) => name === shown)!);
    choice(parent, {label: "Object", options, value}, (name) => {
      this.state.set("object", name);
      show(name);
    });
    show(value);
  }

  private showSliders({name, x, z}: MovedObject): void {
    this.sliders.replaceChildren();
    const place = this.wanted.places[name];
    const show = (value: number) => `${value} mm`;
    const move = (axis: "x" | "z", to: number) => {
      place[axis === "x" ? 0 : 1] = to;
      this.state.set(`${name}-${axis}`, to);
      this.changed();
    };
    // The camera looks along z, and x points to the left.
    const toRight = {label: "Move to the right", min: -x[1], max: -x[0], step: 5, value: -place[0], show};
    slider(this.sliders, toRight, (value) => move("x", -value));
    const toBack = {label: "Move to the back", min: z[0], max: z[1], step: 5, value: place[1], show};
    slider(this.sliders, toBack, (value) => move("z", value));
  }

  private addLamp(parent: HTMLElement): void {
    const {state, wanted} = this;
    const show = (value: number) => `${Math.round(100 * value)} %`;
    let whenOn = wanted.lamp || 1;
    const change = (to: number) => {
      state.set("lamp", (wanted.lamp = to));
      if (to) whenOn = to;
      lamp.set(to > 0);
      dimmer.set(to);
      this.changed();
    };
    const dimmer = slider(parent, {label: "Emission", ...emissions, value: wanted.lamp, show}, change);
    const lamp = checkbox(parent, {label: "Lamp on", value: wanted.lamp > 0}, (isOn) => change(isOn ? whenOn : 0));
  }
}
