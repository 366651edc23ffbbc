// A solution of the Cornell box that continues shot by shot and after edits.
import type {Edit, Scene, SceneInfo, Solution, SolutionInfo} from "../core";
import type {Point} from "../plot";
import {editsBetween, unchanged, type Changes} from "./changes";

// Few patches, so that an update takes less than a fifth of a second. The faces of the blocks are small.
const elementSettings = {texels: 16, surface_texels: {"short-block": 8, "tall-block": 8}, patch: 4, editable: true};
const shotSettings = {resolution: 64, split: 0.2, residual: 0.01, shots: 0, editable: true};
const shotsPerEdit = 200; // the rest follows in the next pictures
const pointsOfCurve = 400;

/** A solution, and what was shot since its start. */
export class Shooting {
  solution: Solution;
  info: SolutionInfo;
  shots = 0;
  curve: Point[] = []; // shots and residual
  private readonly scene: SceneInfo;
  private applied = unchanged;

  constructor(scene: Scene) {
    this.scene = scene.info();
    this.solution = scene.discretize(elementSettings).solve(shotSettings);
    this.info = this.solution.info();
    this.record();
  }

  /** Begins without light; edits stay. */
  restart(): void {
    this.solution = this.solution.elements().solve(shotSettings);
    this.info = this.solution.info();
    this.shots = 0;
    this.curve = [];
    this.record();
  }

  /** Few shots at first, so that single ones are seen, and more later. */
  shootSome(atMost = Infinity): void {
    this.info = this.solution.shoot(Math.min(atMost, Math.max(1, Math.floor(this.shots / 16))));
    this.record();
  }

  /** Shoots `count` times, or until little is unshot. */
  shootAll(count: number): void {
    const end = this.shots + count;
    while (this.shots < end && !this.isDone) this.shootSome(end - this.shots);
  }

  /** Updates the light for these changes. Returns the edits. */
  change(to: Changes): Edit[] {
    const edits = editsBetween(this.applied, to, this.scene);
    if (!edits.length) return edits;
    this.info = this.solution.edit(edits, shotsPerEdit);
    this.applied = structuredClone(to);
    this.record();
    return edits;
  }

  get isDone(): boolean {
    return this.info.residual <= shotSettings.residual;
  }

  private record(): void {
    this.shots += this.info.shots;
    if (this.info.residual > 0) this.curve.push([this.shots, this.info.residual]);
    if (this.curve.length > pointsOfCurve) this.curve.shift();
  }
}
