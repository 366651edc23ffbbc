// The editor of the student's code. It marks the lines that differ from the start of the step.
import {javascript} from "@codemirror/lang-javascript";
import {Compartment, type Extension} from "@codemirror/state";
import {Decoration, EditorView} from "@codemirror/view";
import {basicSetup} from "codemirror";
import {element} from "../controls";

const changedLine = Decoration.line({class: "changed-line"});

function marks(start: string): Extension {
  const known = new Set(start.split("\n"));
  return EditorView.decorations.compute(["doc"], ({doc}) => {
    const lines = Array.from({length: doc.lines}, (_, k) => doc.line(k + 1));
    return Decoration.set(lines.filter(({text}) => !known.has(text)).map(({from}) => changedLine.range(from)));
  });
}

export class CodeEditor {
  private readonly view: EditorView;
  private readonly marks = new Compartment();

  constructor(parent: HTMLElement, code: string, private start: string, changed: () => void) {
    this.view = new EditorView({
      parent: element(parent, "div", {className: "editor"}),
      doc: code,
      extensions: [
        basicSetup,
        javascript(),
        this.marks.of(marks(start)),
        EditorView.lineWrapping,
        EditorView.contentAttributes.of({"aria-label": "Your rasterizer", tabindex: "0"}),
        EditorView.updateListener.of((update) => {
          if (update.docChanged) changed();
        }),
      ],
    });
  }

  code(): string {
    return this.view.state.doc.toString();
  }

  /** Replaces the code, and shows its first line that is marked. */
  setCode(code: string): void {
    const known = new Set(this.start.split("\n"));
    const lines = code.split("\n");
    const first = Math.max(0, lines.findIndex((line) => !known.has(line)));
    const place = lines.slice(0, first).join("\n").length;
    this.view.dispatch({
      changes: {from: 0, to: this.view.state.doc.length, insert: code},
      effects: EditorView.scrollIntoView(place, {y: "center"}),
    });
  }

  setStart(start: string): void {
    this.start = start;
    this.view.dispatch({effects: this.marks.reconfigure(marks(start))});
  }

  dispose(): void {
    this.view.destroy();
  }
}
