// The changes of the Cornell box that the learner asks for, and the edits that they need.
import type {Edit, SceneInfo, Vec3} from "../core";
import type {State} from "../lesson";

/** Objects that move, and how far along x and z, in mm. */
export const objects = [
  {name: "short-block", label: "Short block", x: [-75, 250], z: [-60, 280]},
  {name: "tall-block", label: "Tall block", x: [-250, 75], z: [-240, 75]},
  {name: "light", label: "Lamp", x: [-200, 200], z: [-200, 200]},
] as const;

const paints: Record<string, Vec3> = {
  blue: [0.05, 0.12, 0.6],
  white: [0.74, 0.74, 0.75],
  black: [0.02, 0.02, 0.02],
};
export const walls = ["red", ...Object.keys(paints)];
export const emissions = {min: 0, max: 2, step: 0.05}; // over that of the file

/** The changes of the scene that the learner asks for. */
export interface Changes {
  places: Record<string, [x: number, z: number]>;
  lamp: number; // emission over that of the file
  wall: string; // paint of the red wall
}

export function changesOf(state: State): Changes {
  const number = (key: string, [min, max]: readonly [number, number]) => state.number(key, 0, {min, max, step: 5});
  const places = objects.map(({name, x, z}) => [name, [number(`${name}-x`, x), number(`${name}-z`, z)]]);
  return {
    places: Object.fromEntries(places),
    lamp: state.number("lamp", 1, emissions),
    wall: state.option("wall", walls, "red"),
  };
}

export const unchanged: Changes = {
  places: Object.fromEntries(objects.map(({name}) => [name, [0, 0]])),
  lamp: 1,
  wall: "red",
};

/** A moved lamp hangs 1 mm below the ceiling, which would cover it otherwise. */
const heightAt = (name: string, [x, z]: [number, number]) => (name === "light" && (x || z) ? -1 : 0);

/** The edits that lead from one state of the scene to another. */
export function editsBetween(from: Changes, to: Changes, {surfaces}: SceneInfo): Edit[] {
  const edits: Edit[] = [];
  for (const {name} of objects) {
    const [old, next] = [from.places[name], to.places[name]];
    const by: Vec3 = [next[0] - old[0], heightAt(name, next) - heightAt(name, old), next[1] - old[1]];
    if (by.some((distance) => distance !== 0)) edits.push({edit: "move", name, by});
  }
  if (from.lamp !== to.lamp) {
    const {emission} = surfaces.find(({name}) => name === "light")!;
    edits.push({edit: "emission", name: "light", to: emission.map((band) => band * to.lamp) as Vec3});
  }
  if (from.wall !== to.wall) {
    const {reflectance} = surfaces.find(({name}) => name === "wall-red")!;
    edits.push({edit: "reflectance", name: "wall-red", to: paints[to.wall] ?? reflectance});
  }
  return edits;
}
