// A device with a hidden fault draws test vectors, and the student names the fault.
import {checkedForm, choice, element, radios, row, type Control, type Option} from "../controls";
import type {ItemBuffers, Vector} from "../core";
import {differing} from "../face_view";
import {drawWithFault} from "../faulty_device";
import {plural, sum} from "../numbers";
import {idColours, PixelCanvas} from "../pixels";
import {hiddenDevices, type HiddenDevice} from "./hidden_devices";
import type {Task} from "./task";

/** In an order that does not give the right one away. */
function candidates({fault, others}: HiddenDevice): string[] {
  return [fault, ...others].sort();
}

export class FindTask {
  private readonly drawn: Control<string>; // the vector
  private readonly form: HTMLElement;
  private readonly guessed: HTMLElement; // what a device with the guessed fault draws
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
    this.guessed = element(place.text, "figure");
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
    this.guessed.replaceChildren();
    checkedForm(this.form, "Which fault does this device have?", (group) => {
      const fault = radios(element(group, "div", {className: "candidates"}), candidates(device));
      return () => {
        const isRight = fault() === device.fault;
        this.guessed.replaceChildren();
        return {isRight, html: isRight ? this.story(device) : this.compareGuess(device, fault()!)};
      };
    });
  }

  private story({fault, vector, story, source}: HiddenDevice): string {
    const {advice} = this.task.vectors.get(vector)!.faults().find(({name}) => name === fault)!;
    return `Right. To mend it: ${advice}. ${story} <a href="${source}">${source}</a>`;
  }

  private showGuess(guess: string, found: ItemBuffers, face: number): void {
    const {background, faces} = this.vector.json();
    const [, , columns, rows] = faces[face].scissor;
    element(this.guessed, "figcaption", {textContent: `${faces[face].name} by a device with “${guess}”:`});
    const picture = new PixelCanvas(this.guessed, {label: `Drawn with ${guess}`, columns, rows, size: 250});
    picture.show(idColours(found[face], background));
  }

  /** How far a device with the guessed fault is from this one on the vector that is shown. */
  private compareGuess({fault, variant}: HiddenDevice, guess: string): string {
    const {vector} = this;
    const device = drawWithFault(vector, fault, variant), found = drawWithFault(vector, guess);
    const counts = differing(found, device), count = sum(counts);
    this.showGuess(guess, found, counts.indexOf(Math.max(...counts)));
    return count
      ? `Not this one: with that fault, ${plural(count, "pixel")} of ${vector.name()} would look otherwise. Try again.`
      : `Not this one, though on ${vector.name()} it would look the same. Try another vector.`;
  }
}
