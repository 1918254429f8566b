/** Undo and redo of everything: documents are values, so a step is the one before. */

export interface Step<T> {
  label: string;
  value: T;
}

export interface History<T> {
  past: readonly Step<T>[];
  now: T;
  future: readonly Step<T>[];
}

const kMost = 500;

export const started = <T>(now: T): History<T> => ({ past: [], now, future: [] });

export function committed<T>(h: History<T>, label: string, now: T): History<T> {
  if (now === h.now) return h;
  return { past: [...h.past, { label, value: h.now }].slice(-kMost), now, future: [] };
}

export function undone<T>(h: History<T>): History<T> {
  const last = h.past.at(-1);
  if (!last) return h;
  return {
    past: h.past.slice(0, -1),
    now: last.value,
    future: [{ label: last.label, value: h.now }, ...h.future],
  };
}

export function redone<T>(h: History<T>): History<T> {
  const next = h.future[0];
  if (!next) return h;
  return {
    past: [...h.past, { label: next.label, value: h.now }],
    now: next.value,
    future: h.future.slice(1),
  };
}
