/** Lines of equal value over a grid, cell by cell: drawing, like the bands of a map. */
import type { Point } from "../model/document.ts";

export interface Field {
  x: readonly [number, number];
  y: readonly [number, number];
  /** rows along y, from the least */
  rows: readonly (readonly number[])[];
}

/** Pieces of the line, each from one edge of a cell to another. */
export function contour(field: Field, level: number): [Point, Point][] {
  const lines: [Point, Point][] = [];
  const { rows } = field;
  const columns = rows[0]?.length ?? 0;
  const place = (i: number, j: number): Point => [
    field.x[0] + ((field.x[1] - field.x[0]) * i) / (columns - 1),
    field.y[0] + ((field.y[1] - field.y[0]) * j) / (rows.length - 1),
  ];
  for (let j = 0; j + 1 < rows.length; ++j)
    for (let i = 0; i + 1 < columns; ++i) {
      const corners: [number, number][] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
      const values = corners.map(([a, b]) => (rows[b]?.[a] ?? NaN) - level);
      const cut: Point[] = [];
      for (let k = 0; k < 4; ++k) {
        const from = values[k] as number;
        const to = values[(k + 1) % 4] as number;
        if (!(from * to < 0)) continue;
        const a = place(...(corners[k] as [number, number]));
        const b = place(...(corners[(k + 1) % 4] as [number, number]));
        const t = from / (from - to);
        cut.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
      }
      for (let k = 0; k + 1 < cut.length; k += 2) lines.push([cut[k] as Point, cut[k + 1] as Point]);
    }
  return lines;
}

/** Values that part the field's into equal shares. */
export function evenLevels(field: Field, count: number): number[] {
  const sorted = field.rows.flat().filter(Number.isFinite).sort((a, b) => a - b);
  return Array.from({ length: count }, (_, i) => sorted[Math.floor(((i + 1) * sorted.length) / (count + 1))] ?? 0);
}
