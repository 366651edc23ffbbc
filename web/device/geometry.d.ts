// The parts of geometry.js that the page uses.
import type {VectorArrays, VectorFace} from "../page/core";

/** x, y, w, u, v of a vertex in the view of a face, in binary32. */
export function viewVertex(index: number, face: VectorFace, eye: number[], arrays: VectorArrays): number[];
/** Whether the view reverses windings. */
export function isMirrored(face: VectorFace): boolean;
