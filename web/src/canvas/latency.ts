/** How long the hand waits: from the pointer's event to the curve, comb and graphs that follow it. */
const kKept = 600;

export class Latency {
  private readonly times: number[] = [];
  private since: number | null = null;

  /** A move came; the oldest that is not answered yet counts. */
  began(time: number): void {
    this.since ??= time;
  }

  /** All that follows from it is painted. Only what moved a curve counts. */
  painted(followed: boolean): void {
    if (this.since === null) return;
    if (followed) this.times.push(performance.now() - this.since);
    if (this.times.length > kKept) this.times.shift();
    this.since = null;
  }

  forget(): void {
    this.times.length = 0;
  }

  get count(): number {
    return this.times.length;
  }

  /** The time that `share` of all moves kept within, in milliseconds. */
  within(share: number): number {
    const sorted = [...this.times].sort((a, b) => a - b);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? 0;
  }
}
