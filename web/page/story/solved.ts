// The questions that a student has solved: kept in the browser, and saved as a file for the lecturer.
import {sha256} from "@noble/hashes/sha2";
import {bytesToHex} from "@noble/hashes/utils";
import {isRightAnswer, type Control, type Question} from "../controls";
import {download} from "../download";
import {kept, keep} from "../storage";

interface Answer {
  figure: string;
  question: string; // with the numbers of the student
  answer: string;
}

interface SolvedFile {
  kind: "hemitex lessons";
  student: string;
  solved: Answer[];
  sha256: string;
}

const hashOf = (student: string, solved: Answer[]) => bytesToHex(sha256(JSON.stringify({student, solved})));
const oneLine = (text: string) => text.replaceAll(/\s+/g, " ");

/** What a file says, in words; `ask` gives the questions of a student, by figure. Throws for other files. */
export function checkedFile(text: string, ask: (student: string, figure: string) => Question | undefined): string {
  const file = JSON.parse(text) as SolvedFile;
  if (file.kind !== "hemitex lessons") throw new Error("This is no file of these lessons.");
  const {student, solved} = file;
  const wrong = solved.filter(({figure, question, answer}) => {
    const asked = ask(student, figure);
    return !asked || oneLine(asked.text) !== question || !isRightAnswer(asked, answer);
  });
  const names = wrong.map(({figure}) => figure).join(", ");
  const answers = `${solved.length - wrong.length} of ${solved.length} answers are right${names && `, not ${names}`}`;
  const isIntact = hashOf(student, solved) === file.sha256;
  return `${student || "Without a name"}: ${answers}; the file ${isIntact ? "is as it was saved" : "was changed"}.`;
}

export class Solved {
  private readonly answers: Map<string, Answer>;
  private shown: Control<string> | undefined;

  constructor(
    private readonly student: string,
    private readonly count: number,
  ) {
    this.answers = new Map(JSON.parse(kept(this.key()) ?? "[]"));
  }

  add(figure: string, question: string, answer: string): void {
    this.answers.set(figure, {figure, question: oneLine(question), answer});
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
    const {student} = this;
    const file: SolvedFile = {kind: "hemitex lessons", student, solved, sha256: hashOf(student, solved)};
    download("hemitex-lessons.json", JSON.stringify(file, null, 2));
  }

  private key(): string {
    return `solved ${this.student}`;
  }

  private update(): void {
    this.shown?.set(`${this.answers.size} of ${this.count} questions${this.student ? ` by ${this.student}` : ""}.`);
  }
}
