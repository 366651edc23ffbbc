// Counts how often the bodies of loops and functions run, so that an endless loop ends after a number of steps and not
// after a time, which a busy computer would use up with right code.
import {javascriptLanguage} from "@codemirror/lang-javascript";

type SyntaxNode = ReturnType<typeof javascriptLanguage.parser.parse>["topNode"];

const loops = ["ForStatement", "WhileStatement", "DoStatement"];
const functions = ["FunctionDeclaration", "FunctionExpression", "ArrowFunction", "MethodDeclaration"];

/** The statement that is repeated; undefined if the code ends before it. */
function bodyOf(node: SyntaxNode): SyntaxNode | null | undefined {
  return node.name === "DoStatement" ? node.firstChild?.nextSibling : node.lastChild;
}

/** The same code with calls of countStep in these bodies. Lines stay. Code that does not parse stays as it is. */
export function countedCode(code: string): string {
  const added: [place: number, text: string][] = [];
  let isWrong = false;
  javascriptLanguage.parser.parse(code).iterate({
    enter({node}) {
      isWrong ||= node.type.isError;
      const isLoop = loops.includes(node.name);
      if (!isLoop && !functions.includes(node.name)) return;
      const body = bodyOf(node);
      if (!body) return;
      if (body.name === "Block") added.push([body.from + 1, "countStep();"]);
      else if (isLoop) added.push([body.from, "{countStep();"], [body.to, "}"]);
    },
  });
  if (isWrong) return code;
  // From the end, so that places stay; of two at the same place the one that was found last stands in front.
  return added
    .sort(([a], [b]) => b - a)
    .reduce((text, [place, part]) => text.slice(0, place) + part + text.slice(place), code);
}
