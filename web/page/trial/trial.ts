// Judges a device: it draws the probes, which give its profile, and the suite, whose item IDs are judged.
import type {Core, ItemBuffers, Profile, Report, Vector} from "../core";
import type {Device} from "./devices";

export interface Answer {
  vector: Vector;
  found: ItemBuffers;
  report: Report;
}

/** Number of pixels by verdict, in the order of Core.verdicts. */
export type Counts = number[];

/** The suite judged with one profile. */
export interface Judgement {
  profile: Profile;
  answers: Answer[];
  counts: Counts;
}

export interface Trial {
  device: Device;
  /** Answers to the probes that no device can give. With any, the profile is measured in part and not valid. */
  contradictions: string[];
  byDefault: Judgement;
  measured: Judgement;
  milliseconds: number;
}

/** Whether the probes give a valid profile. */
export const isMeasured = ({contradictions}: Trial): boolean => contradictions.length === 0;

export function countsOf(core: Core, report: Report): Counts {
  const {pixels} = report.json();
  return core.verdicts().map((verdict) => pixels[verdict]);
}

export const pixelsOf = (counts: Counts): number => counts.reduce((sum, count) => sum + count, 0);

/** Exact, explained, errors. */
export function summaryOf(counts: Counts): {exact: number; explained: number; errors: number} {
  const [exact, errors] = [counts[0], counts[counts.length - 1]];
  return {exact, explained: pixelsOf(counts) - exact - errors, errors};
}

/** Runs steps, and lets the page draw and answer between them. */
class Slices {
  private readonly start = performance.now();
  private sliceStart = this.start;
  private done = 0;

  constructor(
    private readonly steps: number,
    private readonly progress: (done: number) => void,
    private readonly signal: AbortSignal,
  ) {}

  async map<In, Out>(inputs: In[], step: (input: In) => Out | Promise<Out>): Promise<Out[]> {
    const outputs: Out[] = [];
    for (const input of inputs) {
      outputs.push(await step(input));
      this.done++;
      if (performance.now() - this.sliceStart > 30) await this.pause();
    }
    return outputs;
  }

  milliseconds(): number {
    return performance.now() - this.start;
  }

  private async pause(): Promise<void> {
    this.progress(this.done / this.steps);
    await new Promise(requestAnimationFrame);
    this.signal.throwIfAborted();
    this.sliceStart = performance.now();
  }
}

/** `progress` gets a number from 0 to 1. Throws when `signal` is aborted. */
export async function runTrial(
  core: Core,
  device: Device,
  progress: (done: number) => void,
  signal: AbortSignal,
): Promise<Trial> {
  const probes = core.probes();
  const probeVectors = probes.vectors();
  const suite = core.suite();
  const slices = new Slices(probeVectors.length + 3 * suite.length, progress, signal);
  const draw = (vector: Vector) => device.draw(vector);
  const {profile, faults} = probes.calibrate(await slices.map(probeVectors, draw));
  const drawn = await slices.map(suite, async (vector) => ({vector, found: await draw(vector)}));
  const judge = async (allowed: Profile): Promise<Judgement> => {
    const answers = await slices.map(drawn, (answer) => ({
      ...answer,
      report: answer.vector.judge(answer.found, allowed),
    }));
    const each = answers.map(({report}) => countsOf(core, report));
    const counts = core.verdicts().map((_, k) => pixelsOf(each.map((one) => one[k])));
    return {profile: allowed, answers, counts};
  };
  const byDefault = await judge({});
  const measured = await judge(profile);
  return {device, contradictions: faults, byDefault, measured, milliseconds: slices.milliseconds()};
}
