// A case on which a device fails, made small enough to follow by hand.
import type {ErrorPixel, ItemBuffers, Profile, Vector} from "../core";
import type {Device} from "./devices";
import type {Answer} from "./trial";

export interface SmallCase {
  vector: Vector;
  error: ErrorPixel;
  drawings: number; // by the device
}

const maxDrawings = 300;

/**
 * A vector with fewer triangles and pixels on which the device still fails. Without the device, Vector.minimize gives
 * it. Where the device draws at once, Vector.reduce goes on from there.
 */
export async function reduceCase(device: Device, {vector, found}: Answer, profile: Profile): Promise<SmallCase> {
  let drawings = 0;
  const firstError = (small: Vector, drawn: ItemBuffers) => small.judge(drawn, profile).json().errors[0];
  const minimal = vector.minimize(found, profile).vector;
  // The device may draw other item IDs where fewer triangles are drawn.
  let small = firstError(minimal, await device.draw(minimal)) ? minimal : vector;
  if (device.isSynchronous)
    small = small.reduce((smaller) => {
      drawings++;
      return firstError(smaller, device.draw(smaller) as ItemBuffers) !== undefined;
    }, maxDrawings);
  const error = firstError(small, await device.draw(small));
  return {vector: small, error, drawings: drawings + 2};
}
