// Long work in slices, between which the page draws and answers.

const sliceMilliseconds = 30;

export class Slices {
  private start = performance.now();

  constructor(private readonly signal: AbortSignal) {}

  /** To be awaited after each step. At the end of a slice, calls `report` and waits for the next frame. Throws when the
   * signal is aborted. */
  async step(report: () => void): Promise<void> {
    if (performance.now() - this.start < sliceMilliseconds) return;
    report();
    await new Promise(requestAnimationFrame);
    this.signal.throwIfAborted();
    this.start = performance.now();
  }
}
