// The questions that a student has solved: kept in the browser, and saved as a file for the lecturer.
import {sha256} from "@noble/hashes/sha2";
import {bytesToHex} from "@noble/hashes/utils";
import type {Control} from "../controls";
import {download} from "../download";
import {kept, keep} from "../storage";

interface Answer {
  figure: string;
  question: string; // with the numbers of the student
  answer: string;
}

export class Solved {
  private readonly answers: Map<string, Answer>;
  private shown: Control<string> | undefined;

  constructor(private readonly student: string, private readonly count: number) {
    this.answers = new Map(JSON.parse(kept(this.key()) ?? "[]"));
  }

  add(figure: string, question: string, answer: string): void {
    this.answers.set(figure, {figure, question: question.replaceAll(/\s+/g, " "), answer});
    keep(this.key(), JSON.stringify([...this.answers]));
    this.update();
  }

  show(shown: Control<string>): void {
    this.shown = shown;
    this.update();
  }

  /** The hash is that of the text of `solved`, so that a file that was changed is found out. */
  save(): void {
    const solved = [...this.answers.values()];
    const hash = bytesToHex(sha256(JSON.stringify({student: this.student, solved})));
    const file = {kind: "hemitex lessons", student: this.student, solved, sha256: hash};
    download("hemitex-lessons.json", JSON.stringify(file, null, 2));
  }

  private key(): string {
    return `solved ${this.student}`;
  }

  private update(): void {
    this.shown?.set(`${this.answers.size} of ${this.count} questions${this.student ? ` by ${this.student}` : ""}.`);
  }
}
