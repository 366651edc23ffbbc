// The five faces of a hemicube in one picture.

/** A pixel of a face; `pixel` counts in the face's scissor rectangle, row by row. */
export interface FacePixel {
  face: number;
  pixel: number;
}

/**
 * The pixels of a cross of 2R x 2R, row 0 at the bottom: the top face in the middle, seen along its normal, and the
 * sides folded down around it, with their horizons outermost. There are none in the corners.
 */
export function unfoldedHemicube(resolution: number): (FacePixel | undefined)[] {
  const side = 2 * resolution, half = resolution / 2;
  const cross = new Array<FacePixel | undefined>(side * side).fill(undefined);
  const put = (face: number, rows: number, place: (column: number, row: number) => [x: number, y: number]) => {
    for (let pixel = 0; pixel < rows * resolution; ++pixel) {
      const [x, y] = place(pixel % resolution, Math.floor(pixel / resolution));
      cross[y * side + x] = {face, pixel};
    }
  };
  // Seen along w with y upwards, the x axis of a face points to the left.
  const mirrored = (column: number) => half + resolution - 1 - column;
  put(0, resolution, (column, row) => [mirrored(column), half + row]);
  put(1, half, (column, row) => [row, half + column]);
  put(2, half, (column, row) => [half + column, side - 1 - row]);
  put(3, half, (column, row) => [side - 1 - row, mirrored(column)]);
  put(4, half, (column, row) => [mirrored(column), row]);
  return cross;
}
