// Runs a rasterizer that a student writes, in a worker that can be ended. The worker is made from a blob, which also a
// page from disk may do.
import {countedCode} from "./counted_code";
import type {View} from "./views";

const stepLimit = 3e8; // runs of the bodies of loops and functions per vector or call

/** An error in the student's code. */
export class CodeError extends Error {
  constructor(message: string, readonly line: number | null) {
    super(message);
  }
}

/** Descriptions of the functions that the worker offers. */
export const helpers: [call: string, what: string][] = [
  ["roundEven(x)", "the nearest integer; of two, the even one"],
  ["sum(numbers)", "their sum"],
  ["mix(p, q, t)", "p + t (q - p), for all keys of p"],
  ["signOfSum(terms)", "the exact sign of a sum; a term [a, b, c, d] means abc/d"],
  ["floorOfQuotient(terms, divisors)", "the exact floor of one sum divided by another"],
  ["note(column, row, name, value)", "shows a value of yours beside the right ones, where this pixel is marked"],
];

// Doubles decide where their rounding cannot matter: a sum of six terms has at most nine roundings in a row, each of
// 2^-53 of the sum of absolute values. Elsewhere fractions of big integers decide.
const helperCode = `
const counted = {left: Infinity};
function countStep() {
  if (--counted.left < 0) throw new RangeError("stopped after ${stepLimit / 1e6} million steps: does a loop not end?");
}
let watched = null, notes = [];
function note(column, row, name, value) {
  if (watched && watched[0] === column && watched[1] === row) notes.push([name, JSON.stringify(value)]);
}
function roundEven(x) {
  const rounded = Math.round(x);
  return rounded - x === 0.5 && rounded % 2 !== 0 ? rounded - 1 : rounded;
}
function sum(numbers) {
  return numbers.reduce((x, y) => x + y, 0);
}
function mix(p, q, t) {
  return Object.fromEntries(Object.keys(p).map(key => [key, p[key] + t * (q[key] - p[key])]));
}
function fraction(x) {
  if (!Number.isFinite(x)) throw new RangeError(x + " in an exact sum");
  let divisor = 1n;
  for (; !Number.isInteger(x); x *= 2) divisor *= 2n;
  return [BigInt(x), divisor];
}
function exactSum(terms) {
  return terms.reduce(([top, bottom], term) => {
    const [a, b, c, d] = term.map(fraction);
    const over = a[0] * b[0] * c[0] * d[1], under = a[1] * b[1] * c[1] * d[0];
    return [top * under + over * bottom, bottom * under];
  }, [0n, 1n]);
}
function roundedSum(terms) {
  let total = 0, size = 0;
  for (const [a, b, c, d] of terms) {
    const term = a * b * c / d;
    total += term;
    size += Math.abs(term);
  }
  return {total, error: size * 2 ** -48};
}
function signOfSum(terms) {
  const {total, error} = roundedSum(terms);
  if (Math.abs(total) > error) return Math.sign(total);
  const [top, bottom] = exactSum(terms);
  return top === 0n ? 0 : top > 0n === bottom > 0n ? 1 : -1;
}
function floorOfQuotient(terms, divisors) {
  const over = roundedSum(terms), under = roundedSum(divisors), quotient = over.total / under.total;
  const error = (over.error + Math.abs(quotient) * under.error) / Math.abs(under.total) + Math.abs(quotient) * 2 ** -48;
  if (Math.floor(quotient - error) === Math.floor(quotient + error)) return Math.floor(quotient);
  const [a, b] = exactSum(terms), [c, d] = exactSum(divisors), top = a * d, bottom = b * c;
  const whole = top / bottom;
  return Number(whole * bottom !== top && top < 0n !== bottom < 0n ? whole - 1n : whole);
}
function oneCall({name, returns, rows}, given) {
  const student = studentFunction(name);
  if (!student) throw "there is no function " + name + " yet";
  counted.left = ${stepLimit};
  const answer = student(...given.map((value, k) => k === rows ? source => value[source] : value));
  return returns === undefined ? answer : given[returns];
}
onmessage = ({data: {calls, ...how}}) => {
  try {
    [watched, notes] = [how.watched, []];
    const answers = calls.map(given => oneCall(how, given));
    postMessage({answers: watched ? notes : answers});
  } catch (error) {
    // After too many steps the first place is that of countStep.
    const places = [...(error?.stack ?? "").matchAll(/blob:[^ )]*:(\\d+):\\d+/g)], place = places[counted.left < 0 ? 1 : 0];
    postMessage({error: String(error), line: place ? Number(place[1]) : null});
  }
};`;

/** The argument that the function changes, which comes back instead of its answer, and the list that it gets as a
 * function of the place. */
interface How {
  returns?: number;
  rows?: number;
  watched?: [column: number, row: number]; // the notes about this pixel come back instead of answers
}

type Answer = {answers: unknown[]} | {error: string; line: number | null};

export class Sandbox {
  private readonly worker: Worker;
  private readonly address: string;
  private readonly lines: number;

  /** @param code defines draw(view) and other functions */
  constructor(private readonly code: string) {
    // The code begins in the first line of the blob: lines of messages are those of the editor.
    const script = `"use strict"; const studentFunction = (() => { ${countedCode(code)}
; return name => eval("typeof " + name + " === 'function' ? " + name + " : undefined"); })();${helperCode}`;
    this.address = URL.createObjectURL(new Blob([script], {type: "text/javascript"}));
    this.lines = code.trimEnd().split("\n").length;
    this.worker = new Worker(this.address);
  }

  /** The item IDs of each view, by the student's draw. Throws CodeError. After an error the sandbox is ended. */
  async draw(views: View[]): Promise<Uint32Array[]> {
    const answers = await this.call("draw", views.map((view) => [view]));
    return answers.map((ids, k) => this.checked(ids, views[k]));
  }

  /** What the student's draw notes about a pixel of a view: names and values. Throws CodeError. */
  async notes(view: View, column: number, row: number): Promise<[name: string, value: string][]> {
    return (await this.call("draw", [[view]], {watched: [column, row]})) as [string, string][];
  }

  /** What a function returns for each list of arguments. Throws CodeError. After an error the sandbox is ended. */
  async call(name: string, calls: unknown[][], how: How = {}): Promise<unknown[]> {
    try {
      const answer = await this.ask({name, calls, ...how});
      if ("error" in answer) throw this.errorOf(answer.error, answer.line);
      return answer.answers;
    } catch (error) {
      this.end();
      throw error;
    }
  }

  /** Answers that are due never come. */
  end(): void {
    this.worker.terminate();
    URL.revokeObjectURL(this.address);
  }

  private ask(question: {name: string; calls: unknown[][]} & How): Promise<Answer> {
    return new Promise((resolve, reject) => {
      this.worker.onmessage = ({data}: MessageEvent<Answer>) => resolve(data);
      this.worker.onerror = (event) => {
        event.preventDefault(); // the page shows the message
        const {message, lineno} = event;
        reject(message ? this.errorOf(message.replace(/^Uncaught /, ""), lineno || null) : this.syntaxError());
      };
      this.worker.postMessage(question);
    });
  }

  /** Firefox gives no message for a worker that does not compile. So the page compiles the code, and runs nothing. */
  private syntaxError(): CodeError {
    const linesBefore = 2; // that Function puts before the code
    try {
      new Function(this.code);
    } catch (error) {
      return this.errorOf(String(error), (error as {lineNumber: number}).lineNumber - linesBefore);
    }
    return new CodeError("The code does not compile.", null);
  }

  /** Errors behind the end of the code, such as a missing bracket, are shown in its last line. */
  private errorOf(message: string, line: number | null): CodeError {
    return new CodeError(message, line && Math.min(line, this.lines));
  }

  private checked(ids: unknown, {width, height}: View): Uint32Array {
    if (!(ids instanceof Uint32Array) || ids.length !== width * height)
      throw new CodeError(`draw must return a Uint32Array of ${width * height} item IDs`, null);
    return ids;
  }
}
