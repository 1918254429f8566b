/** Round numbers for rulers, grids and axes. */

/** The step of 1, 2 or 5 times a power of ten that is at least `least`. */
export function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  for (const factor of [1, 2, 5, 10]) if (factor * power >= least * (1 - 1e-12)) return factor * power;
  return 10 * power;
}

const kMostTicks = 4000; // more than pixels

/** Multiples of the step in [low, high]; none where they could not be told from one another. */
export function ticks(low: number, high: number, step: number): number[] {
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.floor(high / step + 1e-9) - first + 1;
  if (!(count > 0 && count <= kMostTicks && first + 1 > first)) return [];
  return Array.from({ length: count }, (_, i) => (first + i) * step);
}

/** A tick's number with no more digits than its step has. */
export function label(value: number, step: number): string {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  if (Math.abs(value) >= 1e6 || digits > 6) return value === 0 ? "0" : value.toExponential(1);
  return value.toFixed(digits).replace("-", "\u2212");
}

/** A figure of the interface, where null stands for one that has no bound. */
export const endless = (value: number | null | undefined): number => (value === null ? Infinity : value ?? 0);

/** A measured number as a person reads it: four digits that count. */
export function measure(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "\u221e";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-4
    ? value.toExponential(digits - 1)
    : value.toFixed(Math.max(0, digits - 1 - Math.floor(Math.log10(size))));
  return text.replace("-", "\u2212");
}

/** A sentence with no more than four digits that count in its numbers. */
export const readable = (text: string): string =>
  text.replace(/-?\d+\.\d{4,}(e[-+]?\d+)?/gi, (number) => measure(Number(number)));
