// The parts of geometry.js that the page uses.
import type {VectorArrays, VectorDraw, VectorFace, VectorJson} from "../page/core";

/** The triangles of a draw in the view of a face: x, y, w, u, v, z of each corner, in binary32, and two words. */
export function viewTriangles(
  vector: VectorJson,
  draw: VectorDraw,
  face: VectorFace,
  arrays: VectorArrays,
): {corners: number[][]; value: number[]}[];
/** Whether the view reverses windings. */
export function isMirrored(face: VectorFace): boolean;
