// Judges a device: it draws the probes, which give its profile, and the suite, whose item IDs are judged.
import type {Core, ItemBuffers, Profile, Report, Vector} from "../core";
import {sum} from "../numbers";
import type {Device} from "./devices";
import {Slices} from "./slices";

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
  /** Answers to the probes that no device can give. With any, the profile is measured only in part. */
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

/** Exact, explained, errors. */
export function summaryOf(counts: Counts): {exact: number; explained: number; errors: number} {
  const [exact, errors] = [counts[0], counts[counts.length - 1]];
  return {exact, explained: sum(counts) - exact - errors, errors};
}

/** Keys of a profile by their probes, whose names begin the lines of contradictions. */
const probedKeys: Record<string, string[]> = {
  coverage: ["subpixel_bits", "snap_rounding", "edge_rule"],
  texels: ["texel_precision", "interpolation_error"],
  depth: ["depth_format"],
};

/** The profile without what contradictory answers say. Keys that are left out have their defaults. */
function consistentPart(profile: Profile, contradictions: string[]): Profile {
  const dropped = contradictions.flatMap((line) => probedKeys[line.split(":")[0]] ?? []);
  return Object.fromEntries(Object.entries(profile).filter(([key]) => !dropped.includes(key)));
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
  const steps = probeVectors.length + 3 * suite.length;
  const slices = new Slices(signal);
  const start = performance.now();
  let done = 0;
  const each = async <In, Out>(inputs: In[], step: (input: In) => Out | Promise<Out>): Promise<Out[]> => {
    const outputs: Out[] = [];
    for (const input of inputs) {
      outputs.push(await step(input));
      done++;
      await slices.step(() => progress(done / steps));
    }
    return outputs;
  };
  const draw = (vector: Vector) => device.draw(vector);
  const {profile, faults} = probes.calibrate(await each(probeVectors, draw));
  const drawn = await each(suite, async (vector) => ({vector, found: await draw(vector)}));
  const judge = async (allowed: Profile): Promise<Judgement> => {
    const answers = await each(drawn, (answer) => ({...answer, report: answer.vector.judge(answer.found, allowed)}));
    const counts = answers.map(({report}) => countsOf(core, report));
    return {profile: allowed, answers, counts: core.verdicts().map((_, k) => sum(counts.map((one) => one[k])))};
  };
  const byDefault = await judge({});
  const measured = await judge(consistentPart(profile, faults));
  return {device, contradictions: faults, byDefault, measured, milliseconds: performance.now() - start};
}
