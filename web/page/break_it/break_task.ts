// A fault is chosen, a device with it draws a test vector, and the diagnosis names the fault.
import {describeError} from "../comparison";
import {choice, element, row, status, text, type Control} from "../controls";
import type {ItemBuffers, Vector} from "../core";
import {differing} from "../face_view";
import {drawWithFault} from "../faulty_device";
import {plural, sum} from "../numbers";
import type {Task} from "./task";

export class BreakTask {
  private readonly diagnosis: Control<string>;
  private readonly firstError: Control<string>;
  private readonly purpose: HTMLElement;
  private readonly faultBox: HTMLElement;
  private readonly variantBox: HTMLElement;
  private vector: Vector;
  private fault: string;
  private variant: string;
  private timer = 0;

  constructor(private readonly task: Task) {
    const {place, state, vectors} = task;
    this.vector = vectors.get(state.text("vector", "")) ?? vectors.get("five-faces")!;
    this.fault = state.text("fault", "picture upside down");
    this.variant = state.text("variant", "");
    this.diagnosis = status(place.text, "diagnosis");
    this.firstError = status(place.text, "first-error");
    this.purpose = text(place.text, "");
    const bar = row(place.controls);
    choice(bar, {label: "Test vector", options: [...vectors.keys()], value: this.vector.name()}, (name) => {
      this.vector = vectors.get(name)!;
      this.offerFaults();
      this.draw();
    });
    this.faultBox = element(bar, "div", {className: "control"});
    this.variantBox = element(bar, "div", {className: "control"});
    this.offerFaults();
    this.draw();
  }

  /** Those that the vector can show: the format of its item IDs has variants of them. */
  private offerFaults(): void {
    const names = this.vector.faults().filter(({variants}) => variants.length).map(({name}) => name);
    if (!names.includes(this.fault)) this.fault = names[0];
    this.faultBox.replaceChildren();
    choice(this.faultBox, {label: "Fault", options: names, value: this.fault}, (name) => {
      this.fault = name;
      this.offerVariants();
      this.draw();
    });
    this.offerVariants();
  }

  private offerVariants(): void {
    const {variants} = this.vector.faults().find(({name}) => name === this.fault)!;
    if (!variants.includes(this.variant)) this.variant = variants[0];
    this.variantBox.replaceChildren();
    this.variantBox.hidden = variants.length === 1;
    if (variants.length === 1) return;
    choice(this.variantBox, {label: "Variant", options: variants, value: this.variant}, (name) => {
      this.variant = name;
      this.draw();
    });
  }

  private draw(): void {
    const {vector, fault, variant} = this;
    const {place, state} = this.task;
    state.set("vector", vector.name());
    state.set("fault", fault);
    state.set("variant", variant);
    const [expected, found] = [vector.render(), drawWithFault(vector, fault, variant)];
    place.view.show(vector, expected, found);
    this.purpose.textContent = `This vector detects: ${vector.catches()}.`;
    this.diagnosis.set("Judging ...");
    this.firstError.set("");
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.diagnose(expected, found));
  }

  private diagnose(expected: ItemBuffers, found: ItemBuffers): void {
    const differences = sum(differing(expected, found));
    if (!differences) {
      this.diagnosis.set(`Every pixel is right: this vector cannot show the fault. ${this.advice()}`);
      return;
    }
    const report = this.vector.judge(found, {});
    const {pixels, errors} = report.json();
    this.task.place.view.showVerdicts(report);
    this.diagnosis.set(
      `${plural(differences, "pixel")} differ, ${pixels.error} of them are errors. ` +
        (report.findings() ? `The diagnosis: ${report.findings()}` : "The diagnosis names no fault."),
    );
    if (!errors.length) return;
    const {kind, column, row: line, face} = errors[0];
    const place = `${kind} at column ${column}, row ${line} of ${face}`;
    this.firstError.set(`The first error: ${place}, ${describeError(errors[0])}.`);
  }

  /** Names a vector that shows the fault. */
  private advice(): string {
    const shows = (other: Vector) => sum(differing(other.render(), drawWithFault(other, this.fault)));
    const other = [...this.task.vectors.values()].find(shows);
    return other ? `Try ${other.name()}.` : "";
  }
}
