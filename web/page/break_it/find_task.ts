// A device with a hidden fault draws test vectors, and the student names the fault.
import {checkedForm, choice, element, radios, row, type Control, type Option} from "../controls";
import type {Vector} from "../core";
import {differing} from "../face_view";
import {drawWithFault} from "../faulty_device";
import {plural, sum} from "../numbers";
import {hiddenDevices, type HiddenDevice} from "./hidden_devices";
import type {Task} from "./task";

/** In an order that does not give the right one away. */
function candidates({fault, others}: HiddenDevice): string[] {
  return [fault, ...others].sort();
}

export class FindTask {
  private readonly drawn: Control<string>; // the vector
  private readonly form: HTMLElement;
  private number: number;
  private vector!: Vector;

  constructor(private readonly task: Task) {
    const {place, state, vectors} = task;
    this.number = state.number("device", 1, {min: 1, max: hiddenDevices.length, step: 1}) - 1;
    const bar = row(place.controls);
    const devices = hiddenDevices.map((_, k): Option => [String(k), `Device ${k + 1}`]);
    choice(bar, {label: "Broken device", options: devices, value: String(this.number)}, (value) => {
      this.number = Number(value);
      this.showDevice();
    });
    const names = [...vectors.keys()];
    const drawn = {label: "Test vector that it draws", options: names, value: names[0]};
    this.drawn = choice(bar, drawn, (name) => this.showVector(name));
    this.form = element(place.text, "div");
    this.showDevice();
  }

  private showVector(name: string): void {
    const {place, vectors} = this.task;
    this.vector = vectors.get(name)!;
    const {fault, variant} = hiddenDevices[this.number];
    place.view.show(this.vector, this.vector.render(), drawWithFault(this.vector, fault, variant));
  }

  private showDevice(): void {
    this.task.state.set("device", this.number + 1);
    const device = hiddenDevices[this.number];
    this.drawn.set(device.vector);
    this.showVector(device.vector);
    this.ask(device);
  }

  private ask(device: HiddenDevice): void {
    this.form.replaceChildren();
    checkedForm(this.form, "Which fault does this device have?", (group) => {
      const fault = radios(element(group, "div", {className: "candidates"}), candidates(device));
      return () => {
        const isRight = fault() === device.fault;
        return {isRight, html: isRight ? this.story(device) : this.compareGuess(device, fault()!)};
      };
    });
  }

  private story({fault, vector, story, source}: HiddenDevice): string {
    const {advice} = this.task.vectors.get(vector)!.faults().find(({name}) => name === fault)!;
    return `Right. To mend it: ${advice}. ${story} <a href="${source}">${source}</a>`;
  }

  /** How far a device with the guessed fault is from this one on the vector that is shown. */
  private compareGuess({fault, variant}: HiddenDevice, guess: string): string {
    const {vector} = this;
    const device = drawWithFault(vector, fault, variant);
    const count = sum(differing(drawWithFault(vector, guess), device));
    return count
      ? `Not this one: with that fault, ${plural(count, "pixel")} of ${vector.name()} would look otherwise. Try again.`
      : `Not this one, though on ${vector.name()} it would look the same. Try another vector.`;
  }
}
