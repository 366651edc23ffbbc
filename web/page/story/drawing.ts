// Line drawings of the story, in SVG. Their colours follow the page.
import {element} from "../controls";

export type Point2 = [x: number, y: number];
export type Point3 = [x: number, y: number, z: number];

/** A drawing of `width` by `height` units; returns what replaces its content. */
export function drawing(parent: HTMLElement, label: string, width: number, height: number): (content: string) => void {
  const box = element(parent, "div", {className: "drawing"});
  return (content) => {
    box.innerHTML = `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${label}">${content}</svg>`;
  };
}

const list = (points: Point2[]) => points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");

export const polygon = (points: Point2[], style: string): string => `<polygon points="${list(points)}" ${style}/>`;
export const polyline = (points: Point2[], style: string): string =>
  `<polyline points="${list(points)}" fill="none" ${style}/>`;
export const line = (from: Point2, to: Point2, style: string): string => polyline([from, to], style);
export const label = ([x, y]: Point2, text: string, style = ""): string =>
  `<text x="${x}" y="${y}" fill="var(--text)" ${style}>${text}</text>`;

/** Seen from above and in front: x to the right, y into the picture, z up. */
export function seen([x, y, z]: Point3, [originX, originY]: Point2, unit: number): Point2 {
  return [originX + unit * (x + 0.45 * y), originY - unit * (z + 0.28 * y)];
}

/** Points along the border of a polygon, `count` per edge. */
export function border(corners: Point3[], count: number): Point3[] {
  return corners.flatMap((from, k) => {
    const to = corners[(k + 1) % corners.length];
    return Array.from({length: count}, (_, i): Point3 => {
      const t = i / count;
      return [0, 1, 2].map((axis) => from[axis] + t * (to[axis] - from[axis])) as Point3;
    });
  });
}

/**
 * The form factor from a small area at `eye` that looks up (or down) to a polygon above (or below) it: the sum over
 * edges of the angle of an edge times the height of the normal of its plane, over 2π (Lambert 1760).
 */
export function factorFromPoint(eye: Point3, corners: Point3[]): number {
  const rays = corners.map((corner) => corner.map((value, axis) => value - eye[axis]));
  const sum = rays.reduce((total, [ax, ay, az], k) => {
    const [bx, by, bz] = rays[(k + 1) % rays.length];
    const cross = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx],
      length = Math.hypot(...cross);
    return total + (Math.atan2(length, ax * bx + ay * by + az * bz) * cross[2]) / length;
  }, 0);
  return Math.abs(sum) / (2 * Math.PI);
}
