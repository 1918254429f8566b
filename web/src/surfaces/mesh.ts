/** Sampled surfaces as the server gives them, and the colours of their values. */
import type { Surface, SurfaceInterrogateResult } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";

export type SurfaceLook = "zebra" | "isophotes" | "reflection" | "mean" | "gaussian" | "shaded";

/** Points, unit normals and a value at every place of a grid. */
export interface Sampled {
  rows: number;
  columns: number;
  points: Float32Array;
  normals: Float32Array;
  /** NaN where there is none */
  values: Float32Array;
}

const kGrid = 97;

const flat = (grid: readonly (readonly (readonly number[])[])[]): Float32Array => new Float32Array(grid.flat(2));

export class Samples {
  private readonly known = new WeakMap<Surface, Map<string, Sampled | null>>();
  onCame: () => void = () => {};
  onFailure: (message: string) => void = () => {};

  constructor(private readonly client: Client) {}

  of(surface: Surface, look: SurfaceLook): Sampled | null {
    const kind = look === "gaussian" ? "gaussian" : "mean";
    const all = this.known.get(surface) ?? new Map<string, Sampled | null>();
    this.known.set(surface, all);
    const known = all.get(kind);
    if (known !== undefined) return known;
    all.set(kind, null);
    void this.ask(surface, kind, all);
    return null;
  }

  private async ask(surface: Surface, kind: "gaussian" | "mean", all: Map<string, Sampled | null>): Promise<void> {
    const work = this.client.long<SurfaceInterrogateResult>("surface.interrogate", {
      surface, kind, grid: [kGrid, kGrid], points: true, normals: true,
    }, () => {});
    const answer = await work.answer;
    if (!answer.ok) return this.onFailure(answer.error.message);
    const { grid, points, normals, values } = answer.result;
    all.set(kind, {
      rows: grid?.[0] ?? kGrid,
      columns: grid?.[1] ?? kGrid,
      points: flat((points ?? []) as number[][][]),
      normals: flat((normals ?? []) as number[][][]),
      values: new Float32Array(((values ?? []) as (number | null)[][]).flat().map((v) => v ?? NaN)),
    });
    this.onCame();
  }
}

/** The range that holds `share` of all values, and zero in its middle where they have both signs. */
export function shownRange(all: readonly Float32Array[], share: number): [number, number] {
  const sorted = all.flatMap((values) => [...values]).filter(Number.isFinite).sort((a, b) => a - b);
  if (sorted.length === 0) return [-1, 1];
  const at = (part: number) => sorted[Math.round(part * (sorted.length - 1))] as number;
  const low = at((1 - share) / 2);
  const high = at((1 + share) / 2);
  if (low < 0 && high > 0) {
    const most = Math.max(-low, high);
    return [-most, most];
  }
  return high > low ? [low, high] : [low - 1e-12, high + 1e-12];
}

/** Blue through grey to red, as on the legend: readable without red and green. */
const kStops: readonly (readonly [number, number, number])[] = [
  [0.16, 0.32, 0.75], [0.35, 0.62, 0.9], [0.86, 0.87, 0.88], [0.95, 0.6, 0.3], [0.75, 0.15, 0.12],
];

export function colorAt(share: number): [number, number, number] {
  const place = Math.min(1, Math.max(0, share)) * (kStops.length - 1);
  const i = Math.min(kStops.length - 2, Math.floor(place));
  const t = place - i;
  const [a, b] = [kStops[i], kStops[i + 1]] as [readonly number[], readonly number[]];
  return [0, 1, 2].map((c) => (1 - t) * (a[c] as number) + t * (b[c] as number)) as [number, number, number];
}

export const legend = (): string =>
  `linear-gradient(to right, ${kStops.map((c) => `rgb(${c.map((v) => Math.round(255 * v)).join(" ")})`).join(", ")})`;
