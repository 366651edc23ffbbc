// Controls of the lessons: labelled native elements, for mouse, touch and keyboard.

let nextId = 0;

/** A control or a text whose value the page may change, without a call of its listener. */
export interface Control<Value> {
  set(value: Value): void;
}

/** What a choice offers: a value and its label, or a name that is both. */
export type Option = string | readonly [value: string, label: string];

/** A new element in `parent` with these properties. */
export function element<Name extends keyof HTMLElementTagNameMap>(
  parent: HTMLElement,
  name: Name,
  properties: Partial<HTMLElementTagNameMap[Name]> = {},
): HTMLElementTagNameMap[Name] {
  const made = Object.assign(document.createElement(name), properties);
  parent.append(made);
  return made;
}

/** A paragraph of trusted HTML; MathML is allowed. */
export function text(parent: HTMLElement, html: string): HTMLElement {
  const paragraph = element(parent, "p", {innerHTML: html});
  // On narrow screens a formula scrolls, also by keys.
  for (const formula of paragraph.querySelectorAll<MathMLElement>('math[display="block"]')) formula.tabIndex = 0;
  return paragraph;
}

/** Controls side by side. They wrap. */
export function row(parent: HTMLElement): HTMLElement {
  return element(parent, "div", {className: "row"});
}

/** The picture's column and the text's column; below each other on narrow screens. */
export function columns(parent: HTMLElement): [HTMLElement, HTMLElement] {
  const both = element(parent, "div", {className: "columns"});
  return [element(both, "div", {className: "column"}), element(both, "div", {className: "column"})];
}

function labelled(parent: HTMLElement, label: string): {box: HTMLElement; head: HTMLElement; id: string} {
  const id = `control-${nextId++}`;
  const box = element(parent, "div", {className: "control"});
  const head = element(box, "div", {className: "control-head"});
  element(head, "label", {htmlFor: id, textContent: label});
  return {box, head, id};
}

interface SliderOptions {
  label: string;
  min: number;
  max: number;
  step: number;
  value: number;
  show?: (value: number) => string;
}

export function slider(
  parent: HTMLElement,
  {label, min, max, step, value, show = String}: SliderOptions,
  change: (value: number) => void,
): Control<number> {
  const {box, head, id} = labelled(parent, label);
  const shown = element(head, "output");
  const input = element(box, "input", {id, type: "range"});
  // The value comes last: the element clamps it to the limits that it has.
  Object.assign(input, {min: String(min), max: String(max), step: String(step), value: String(value)});
  const update = () => {
    shown.value = show(input.valueAsNumber);
    input.setAttribute("aria-valuetext", shown.value);
  };
  input.addEventListener("input", () => {
    update();
    change(input.valueAsNumber);
  });
  update();
  return {
    set(to) {
      input.value = String(to);
      update();
    },
  };
}

export function choice(
  parent: HTMLElement,
  {label, options, value}: {label: string; options: readonly Option[]; value: string},
  change: (value: string) => void,
): Control<string> {
  const {box, id} = labelled(parent, label);
  const select = element(box, "select", {id});
  for (const option of options) {
    const [optionValue, textContent] = typeof option === "string" ? [option, option] : option;
    element(select, "option", {value: optionValue, textContent});
  }
  select.value = value;
  select.addEventListener("change", () => change(select.value));
  return {
    set(to) {
      select.value = to;
    },
  };
}

export function checkbox(
  parent: HTMLElement,
  {label, value}: {label: string; value: boolean},
  change: (value: boolean) => void,
): Control<boolean> {
  const line = element(parent, "label", {className: "line"});
  const input = element(line, "input", {type: "checkbox", checked: value});
  line.append(label);
  input.addEventListener("change", () => change(input.checked));
  return {
    set(to) {
      input.checked = to;
    },
  };
}

export function button(parent: HTMLElement, label: string, click: () => void): HTMLButtonElement {
  const made = element(parent, "button", {type: "button", textContent: label});
  made.addEventListener("click", click);
  return made;
}

/** A live region. Tests find it by its data-testid. */
export function status(parent: HTMLElement, name: string): Control<string> {
  const region = element(parent, "p", {className: "status", role: "status"});
  region.dataset.testid = name;
  return {
    set(to) {
      if (region.textContent !== to) region.textContent = to;
    },
  };
}

/** `whyNot` answers wrong answers that tell what was misunderstood. */
export type Question =
  | {text: string; options: string[]; right: number; why: string; whyNot?: Record<string, string>}
  | {
      text: string;
      answer: () => number;
      tolerance: number;
      why: string;
      whyNot?: (value: number) => string | undefined;
    };

interface Verdict {
  isRight: boolean;
  html: string; // trusted
}

/** A form whose answer the page checks. `addInputs` adds the inputs and returns what judges the answer. */
export function checkedForm(parent: HTMLElement, html: string, addInputs: (group: HTMLElement) => () => Verdict): void {
  const form = element(parent, "form", {className: "question"});
  const group = element(form, "fieldset");
  element(group, "legend", {innerHTML: html});
  const judge = addInputs(group);
  const line = row(group);
  element(line, "button", {type: "submit", textContent: "Check"});
  const verdict = element(line, "p", {className: "verdict", role: "status"});
  verdict.dataset.testid = "verdict";
  form.addEventListener("input", () => {
    delete form.dataset.right;
    verdict.replaceChildren();
  });
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const {isRight, html} = judge();
    form.dataset.right = String(isRight);
    verdict.innerHTML = html;
  });
}

/** A question that the page checks. Texts are trusted HTML. `solved` gets the right answer. */
export function question(parent: HTMLElement, asked: Question, solved: (answer: string) => void = () => {}): void {
  checkedForm(parent, asked.text, (group) => {
    const {given, whyNot} = "options" in asked ? radioField(group, asked) : numberField(group, asked);
    return () => {
      if (!isRightAnswer(asked, given())) return {isRight: false, html: `Not yet. ${whyNot() ?? "Try again."}`};
      solved(given());
      return {isRight: true, html: `Right. ${asked.why}`};
    };
  });
}

/** Whether an answer, as `solved` gets it, is right. */
export function isRightAnswer(asked: Question, answer: string): boolean {
  if ("options" in asked) return answer === asked.options[asked.right];
  return Math.abs(Number(answer) - asked.answer()) <= asked.tolerance;
}

/** The inputs of a question: what was answered, and the reply if it is wrong. */
interface Field {
  given: () => string;
  whyNot: () => string | undefined;
}

function radioField(parent: HTMLElement, {options, whyNot}: Extract<Question, {options: string[]}>): Field {
  const chosen = radios(parent, options);
  return {given: () => chosen() ?? "", whyNot: () => whyNot?.[chosen() ?? ""]};
}

/** One of the options, which are trusted HTML. Returns what gives the chosen one. */
export function radios(parent: HTMLElement, options: string[]): () => string | undefined {
  const name = `question-${nextId++}`;
  const inputs = options.map((value) => {
    const line = element(parent, "label", {className: "line"});
    const input = element(line, "input", {type: "radio", name, value, required: true});
    element(line, "span", {innerHTML: value});
    return input;
  });
  return () => inputs.find(({checked}) => checked)?.value;
}

function numberField(
  parent: HTMLElement,
  {whyNot}: Extract<Question, {tolerance: number}>,
): Field {
  const line = element(parent, "label", {className: "line", textContent: "Answer:"});
  // Number inputs drop the decimal comma where the language of the browser has a point.
  const pattern = "\\s*[+\\-]?(\\d+[.,]?\\d*|[.,]\\d+)\\s*";
  const input = element(line, "input", {type: "text", inputMode: "decimal", autocomplete: "off", required: true});
  Object.assign(input, {pattern, title: "A number, such as 8 or 0.5"});
  const value = () => Number(input.value.replace(",", "."));
  return {given: () => String(value()), whyNot: () => whyNot?.(value())};
}

/** A link to a file of the repository, in which the page lies in build/web. */
export function sourceLink(parent: HTMLElement, path: string, what: string): void {
  const line = element(parent, "p", {className: "source", textContent: `${what}: `});
  element(line, "a", {href: `../../${path}`, textContent: path});
}
