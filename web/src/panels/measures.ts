/** What is measured of the chosen curve, and of the place under the pointer. */
import type { Entity } from "../model/document.ts";
import type { Shown } from "../model/live.ts";
import { fact, section } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";
import { endless, measure } from "../view/ticks.ts";

interface Piece {
  alpha: number;
  length: number;
}

/** Slopes of a curve's pieces as its value tells them, path members one after the other. */
export function slopesOf(shown: Shown): (number | null)[] {
  const members = (shown.curve.curves ?? [shown.curve]) as { pieces?: Piece[] }[];
  return members.flatMap((m) => m.pieces?.map((p) => p.alpha) ?? [null]);
}

export function pieceAt(shown: Shown, sample: number): number {
  return shown.comb.joints.filter((joint) => joint <= sample).length;
}

/** The numbers of a sample, one to a line. */
export function readings(e: Entity | undefined, shown: Shown, sample: number, unit: string): string[] {
  const { comb } = shown;
  const piece = e?.kind === "faired" ? e.told.pieces[pieceAt(shown, sample)] : undefined;
  const k = comb.curvature[sample] ?? 0;
  const slope = slopesOf(shown)[pieceAt(shown, sample)];
  const behind = unit ? ` ${unit}` : "";
  return [
    `s ${measure(comb.arc_length[sample] ?? 0)}${behind}`,
    `\u03c1 ${k === 0 ? "\u221e" : measure(1 / Math.abs(k)) + behind}`,
    `\u03ba ${measure(k, 3)}`,
    ...(typeof slope === "number" ? [`\u03b1 ${measure(slope, 3)}`] : []),
    ...(piece ? [`${piece.rhythm}: ${piece.impression}`] : []),
  ];
}

/** "s 45.20 mm · ρ 124.3 mm · κ 0.008 · α −1" of a sample. */
export const reading = (e: Entity | undefined, shown: Shown, sample: number, unit: string): string =>
  readings(e, shown, sample, unit).join("  \u00b7  ");

export function measuresPanel(e: Entity, shown: Shown, before: Shown | undefined, beside: string, unit: string): HTMLElement {
  const behind = unit ? ` ${unit}` : "";
  const pair = (name: string, of: (s: Shown) => string) =>
    before
      ? h("div", { class: "fact" }, h("dt", {}, name), h("dd", { class: "was" }, of(before)), h("dd", {}, of(shown)))
      : fact(name, of(shown));
  const range = (s: Shown) => {
    const radii = s.comb.curvature.map((k) => 1 / Math.abs(k));
    return `${measure(Math.min(...radii), 3)}\u2009\u2026\u2009${measure(Math.max(...radii), 3)}`;
  };
  return section(shown.failure ? "Measures of the last that could be drawn" : !before ? "Measures" : beside ? `${beside} \u2192 ${e.name}` : "Before \u2192 after",
    h("dl", { class: before ? "facts pairs" : "facts", id: "measures", "data-entity": e.id },
      pair("Length", (s) => measure(s.comb.length, 5) + (before ? "" : behind)),
      pair("Radius", range),
      pair("Pieces", (s) => String(s.comb.joints.length + 1)),
      pair("Extrema", (s) => String(s.comb.graphs?.events?.filter((x) => x.kind === "maximum" || x.kind === "minimum").length ?? 0)),
      pair("Inflections", (s) => String(s.comb.graphs?.events?.filter((x) => x.kind === "inflection").length ?? 0)),
      pair("Waves", (s) => String(s.comb.graphs?.waves ?? 0)),
      pair("Energy", (s) => measure(endless(s.comb.graphs?.energy), 3)),
      pair("Bending", (s) => measure(endless(s.comb.graphs?.bending), 3)),
      pair("Jolt", (s) => measure(endless(s.comb.graphs?.jolt), 3))));
}
