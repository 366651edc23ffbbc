// The result of a trial: counts, remarks, profile, downloads and the judged vectors.
import {element, row} from "../controls";
import type {Core} from "../core";
import type {Page} from "../lesson";
import {sum} from "../numbers";
import {showProfile} from "./profile_table";
import {isMeasured, summaryOf, type Counts, type Trial} from "./trial";
import {showVectors} from "./vector_view";

const inThousands = (count: number): string => count.toLocaleString("en");

function showCounts(parent: HTMLElement, trial: Trial): void {
  const table = element(parent, "table");
  const head = element(table, "tr");
  for (const title of ["profile", "exact", "explained", "errors"])
    element(head, "th", {scope: "col", textContent: title});
  const add = (name: string, counts: Counts) => {
    const line = element(table, "tr");
    element(line, "th", {scope: "row", textContent: name});
    const {exact, explained, errors} = summaryOf(counts);
    for (const count of [exact, explained, errors]) element(line, "td", {textContent: inThousands(count)});
  };
  add("default", trial.byDefault.counts);
  add(isMeasured(trial) ? "measured" : "partial", trial.measured.counts);
}

/** What the counts mean: the class of the device, what contradicts it, and the fault. */
function remarks(core: Core, trial: Trial): string[] {
  const defaultReports = trial.byDefault.answers.map(({report}) => report);
  const reports = trial.measured.answers.map(({report}) => report);
  const deviceClass = isMeasured(trial) ? core.deviceClass(defaultReports) : "";
  const fault = core.commonFault(reports);
  return [
    ...(deviceClass ? [`Under the default profile, ${deviceClass}.`] : []),
    ...trial.contradictions.slice(0, 3).map((line) => `No device answers the probes this way: ${line}.`),
    ...(fault ? [`Diagnosis: ${fault}.`] : []),
  ];
}

/** One line. */
export function verdictText(trial: Trial): string {
  const {exact, explained, errors} = summaryOf(trial.measured.counts);
  const [a, b, c] = [exact, explained, errors].map(inThousands);
  return `${errors === 0 && isMeasured(trial) ? "Passed" : "Failed"}: ${a} exact, ${b} explained, ${c} errors`;
}

function addDownload(parent: HTMLElement, label: string, file: string, content: string, signal: AbortSignal): void {
  const url = URL.createObjectURL(new Blob([content], {type: "application/json"}));
  signal.addEventListener("abort", () => URL.revokeObjectURL(url));
  element(parent, "a", {href: url, download: file, textContent: label});
}

function addDownloads(parent: HTMLElement, core: Core, trial: Trial, signal: AbortSignal): void {
  const {profile, answers} = isMeasured(trial) ? trial.measured : trial.byDefault;
  const {name, driver} = trial.device;
  const reports = answers.map(({report}) => report);
  const line = row(parent);
  addDownload(line, "Conformance record", "record.json", core.record(name, driver, profile, reports), signal);
  if (isMeasured(trial)) addDownload(line, "Profile", "profile.json", JSON.stringify(profile, null, 2), signal);
}

function showSummary(parent: HTMLElement, core: Core, trial: Trial): void {
  const {answers, counts} = trial.measured;
  const pixels = inThousands(sum(counts));
  const seconds = (trial.milliseconds / 1000).toPrecision(3);
  const line = `${trial.device.name}: ${answers.length} vectors, ${pixels} pixels, ${seconds} s.`;
  element(parent, "p", {textContent: line});
  showCounts(parent, trial);
  const box = element(parent, "div");
  box.dataset.testid = "gpu-remarks";
  for (const remark of remarks(core, trial)) element(box, "p", {textContent: remark});
}

/** The device is used, and links stay valid, until `signal` is aborted. */
export function showTrial(
  left: HTMLElement,
  right: HTMLElement,
  page: Page,
  trial: Trial,
  signal: AbortSignal,
): void {
  showSummary(left, page.core, trial);
  if (isMeasured(trial)) {
    element(left, "h3", {textContent: "Profile of the device"});
    showProfile(left, trial.measured.profile);
  }
  addDownloads(left, page.core, trial, signal);
  showVectors(right, page, trial, signal);
}
