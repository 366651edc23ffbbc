// A case on which a device fails, made small enough to follow by hand.
import type {ErrorPixel, ItemBuffers, Profile, Vector} from "../core";
import type {Device} from "./devices";
import {Slices} from "./slices";
import type {Answer} from "./trial";

export interface SmallCase {
  vector: Vector;
  error: ErrorPixel;
  drawings: number; // by the device
}

const maxDrawings = 400;

/**
 * Vector.reduce for a device that answers later. The reduction is deterministic, so it starts again after each answer,
 * with all answers so far.
 */
async function reduceLater(vector: Vector, fails: (smaller: Vector) => Promise<boolean>): Promise<Vector> {
  const answers: boolean[] = [];
  while (true) {
    let calls = 0;
    let unknown: Vector | undefined;
    const smallest = vector.reduce((smaller) => {
      if (calls < answers.length) return answers[calls++];
      unknown = smaller;
      return false;
    }, Math.min(answers.length + 1, maxDrawings));
    if (!unknown) return smallest;
    answers.push(await fails(unknown));
  }
}

/** Draws smaller and smaller vectors on the device as long as it fails. `progress` gets the number of drawings. */
export async function reduceCase(
  device: Device,
  {vector, found}: Answer,
  profile: Profile,
  progress: (drawings: number) => void,
  signal: AbortSignal,
): Promise<SmallCase> {
  let drawings = 0;
  const slices = new Slices(signal);
  const firstError = async (smaller: Vector): Promise<ErrorPixel | undefined> => {
    const drawn: ItemBuffers = await device.draw(smaller);
    drawings++;
    await slices.step(() => progress(drawings));
    return smaller.judge(drawn, profile).json().errors[0];
  };
  // Few triangles explain the error, but the device need not fail on them alone.
  const minimal = vector.minimize(found, profile);
  const start = (await firstError(minimal)) ? minimal : vector;
  const small = await reduceLater(start, async (smaller) => (await firstError(smaller)) !== undefined);
  return {vector: small, error: (await firstError(small))!, drawings};
}
