// Compares the item IDs of the student's rasterizer with those of the core.
import type {Core, ItemBuffers, Vector} from "../core";
import type {Sandbox} from "./sandbox";
import {smallVectors} from "./small_vectors";
import {viewsOf, type View} from "./views";

interface Task {
  vector: Vector;
  views: View[];
  expected: ItemBuffers;
}

/** A face of a vector as the student's rasterizer drew it, and its first wrong pixel in the scissor rectangle. */
export interface Drawn {
  vector: Vector;
  face: string;
  view: View;
  expected: Uint32Array;
  found: Uint32Array;
  answers: ItemBuffers; // of all faces
  wrong: number; // pixels
  first: number; // -1: none
}

export interface Judgement {
  vectors: number;
  passed: number;
  shown: Drawn; // the first face with a wrong pixel, or the first face of the last vector
}

/** The test vectors of the page by name; each is prepared once. */
export class Tasks {
  private readonly small: Record<string, Vector>;
  private suite: Record<string, Vector> | undefined;
  private readonly prepared = new Map<string, Task>();

  constructor(private readonly core: Core) {
    this.small = smallVectors(core);
  }

  suiteNames(): string[] {
    return Object.keys(this.wholeSuite());
  }

  of(name: string): Task {
    let task = this.prepared.get(name);
    if (!task) {
      const vector = this.small[name] ?? this.wholeSuite()[name];
      this.prepared.set(name, (task = {vector, views: viewsOf(vector), expected: vector.render()}));
    }
    return task;
  }

  private wholeSuite(): Record<string, Vector> {
    return (this.suite ??= Object.fromEntries(this.core.suite().map((vector) => [vector.name(), vector])));
  }
}

function compared({vector, views, expected}: Task, answers: Uint32Array[]): Drawn[] {
  const {faces} = vector.json();
  return answers.map((found, k) => {
    const isWrong = (id: number, pixel: number) => id !== expected[k][pixel];
    return {
      ...{vector, face: faces[k].name, view: views[k], expected: expected[k], found, answers},
      wrong: found.filter(isWrong).length,
      first: found.findIndex(isWrong),
    };
  });
}

/**
 * Draws the vectors in order; until the first one that fails, unless `all` are asked for. `progress` gets how many are
 * drawn. Throws CodeError.
 */
export async function judge(
  sandbox: Sandbox,
  tasks: Tasks,
  names: string[],
  all: boolean,
  progress: (done: number, count: number) => void,
): Promise<Judgement> {
  let done = 0;
  let passed = 0;
  let failed: Drawn | undefined;
  let last: Drawn | undefined;
  for (const name of names) {
    progress(done++, names.length);
    const task = tasks.of(name);
    const faces = compared(task, await sandbox.draw(task.views));
    const wrong = faces.find(({first}) => first >= 0);
    last = faces[0];
    failed ??= wrong;
    if (!wrong) ++passed;
    else if (!all) break;
  }
  return {vectors: names.length, passed, shown: failed ?? last!};
}
