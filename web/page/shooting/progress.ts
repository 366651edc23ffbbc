// How far a solution is, in numbers: shots, the curve of convergence, energy, and pictures per second.
import {element, status, type Control} from "../controls";
import type {SolutionInfo} from "../core";
import {sum} from "../numbers";
import {Plot} from "../plot";
import type {Shooting} from "./solution";

/** Pictures per second since the page was idle, at most the last 20. A picture lasts until the next animation frame. */
export class Rate {
  private times: number[] = [];
  private start = 0;

  /** At each animation frame; `isBusy`: it makes a picture. */
  frame(now: number, isBusy: boolean): void {
    this.times = this.start ? [...this.times.slice(-19), now - this.start] : [];
    this.start = isBusy ? now : 0;
  }

  get perSecond(): number {
    return (1000 * this.times.length) / sum(this.times);
  }
}

const parts = [
  ["absorbed", "#0072b2", "#ffffff"],
  ["unshot", "#e69f00", "#000000"],
  ["lost", "#5a5f66", "#ffffff"],
] as const;

/** Where the emitted light went, as a bar and as text. */
function energyBar(parent: HTMLElement, squareMetres: number): (info: SolutionInfo) => void {
  const bar = element(parent, "div", {className: "energy-bar", ariaHidden: "true"});
  const boxes = parts.map(([name, background, color]) => {
    const box = element(bar, "div", {textContent: name});
    Object.assign(box.style, {background, color});
    return box;
  });
  const account = status(parent, "energy");
  return ({energy}) => {
    const emitted = sum(energy.emitted);
    const share = (name: keyof SolutionInfo["energy"]) => (emitted > 0 ? (100 * sum(energy[name])) / emitted : 0);
    parts.forEach(([name], i) => (boxes[i].style.width = `${Math.max(0, share(name))}%`));
    const terms = parts.map(([name]) => `${name} ${share(name).toFixed(2)} %`);
    account.set(`emitted ${(squareMetres * emitted).toFixed(3)} W = ${terms.join(" + ")}`);
  };
}

/** How far the solution is: shots, the curve of convergence, and the account of energy. */
export class Progress {
  readonly plot: Plot;
  private readonly shots: Control<string>;
  private readonly showEnergy: (info: SolutionInfo) => void;

  constructor(parent: HTMLElement, squareMetres: number) {
    this.shots = status(parent, "shots");
    this.plot = new Plot(parent, {
      label: "Residual over the number of shots",
      x: "shots",
      y: "residual",
      logarithmicY: true,
    });
    this.showEnergy = energyBar(parent, squareMetres);
  }

  show({shots, info, curve}: Shooting): void {
    const isSigned = sum(info.energy.unshot) < 0.99 * info.residual * sum(info.energy.emitted);
    const negative = isSigned ? ", negative flux counted as positive" : "";
    const before = sum(info.energy.emitted) > 0 ? "" : " of the light before the lamp was switched off";
    this.shots.set(`${shots} shots: residual ${(100 * info.residual).toFixed(3)} %${before}${negative}`);
    this.plot.set([{name: "residual", points: curve}]);
    this.showEnergy(info);
  }
}
