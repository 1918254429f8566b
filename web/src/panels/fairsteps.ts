/** The steps of fairing one can open: points, spline, pieces with their readings, what it came to. */
import type { FairedPiece, FairRequest, FoundSymmetry } from "../../generated/operations.ts";
import { type Entity, entityOf, type Faired, type FairTold, lineOf, type Scan } from "../model/document.ts";
import type { Store, Stretch } from "../model/state.ts";
import { button, fact } from "../ui/controls.ts";
import { h } from "../ui/dom.ts";
import { measure } from "../view/ticks.ts";
import { verdict } from "./verdict.ts";

const kMostReadings = 5;

type Step = "points" | "spline" | "pieces" | "notes";

/** "x = 12.3", or a point and a direction. */
export function lineInWords({ point = [0, 0], direction = 0 }: FoundSymmetry, unit: string): string {
  const degrees = ((((direction * 180) / Math.PI) % 180) + 180) % 180;
  const behind = unit ? ` ${unit}` : "";
  const [x, y] = point as [number, number];
  if (Math.abs(degrees - 90) < 1e-6) return `x = ${measure(x)}${behind}`;
  if (degrees < 1e-6 || degrees > 180 - 1e-6) return `y = ${measure(y)}${behind}`;
  return `${measure(x)}, ${measure(y)} at ${degrees.toFixed(2)}\u00b0`;
}

export class FairSteps {
  private readonly open = new Set<Step>(["pieces"]);

  constructor(private readonly store: Store, private readonly again: (e: Entity, more: FairRequest) => void) {}

  elements(e: Entity): (HTMLElement | null)[] {
    const told = e.kind === "faired" ? e.told : null;
    const measured = e.kind === "faired" ? entityOf(this.store.doc, e.of) : e;
    const scan = measured?.kind === "scan" ? measured : null;
    return [
      scan && this.points(scan, told),
      told && this.spline(told),
      told && this.step("pieces", `Pieces (${told.pieces.length})`,
        h("ol", { class: "pieces" }, ...told.pieces.map((p, i) => this.piece(e as Faired, p, i)))),
      told && told.notes.length > 0 ? this.step("notes", `Notes (${told.notes.length})`, listOf(told.notes)) : null,
    ];
  }

  private step(name: Step, title: string, ...content: (HTMLElement | null | false)[]): HTMLElement {
    const details = h("details", { open: this.open.has(name), class: "step", id: `step-${name}` },
      h("summary", {}, h("h3", {}, title)), ...content);
    details.addEventListener("toggle", () => {
      if (details.open) this.open.add(name);
      else this.open.delete(name);
    });
    return details;
  }

  /** Near enough, calm enough, and the numbers of it. */
  outcome(told: FairTold): (HTMLElement | null)[] {
    const unit = this.store.doc.unit ? ` ${this.store.doc.unit}` : "";
    const { symmetry } = told;
    return [
      ...verdict(told),
      h("dl", { class: "facts" },
        fact("Largest deviation", measure(told.max, 3) + unit),
        fact("Root mean square", measure(told.rms, 3) + unit),
        fact("Tolerance", measure(told.tolerance, 3) + unit),
        told.rate !== null && told.rate !== undefined ? fact("Fastest change of curvature", `${measure(told.rate, 3)}${unit ? ` 1/${unit.trim()}\u00b2` : ""}`) : "",
        symmetry ? fact(symmetry.exact ? "Symmetric about" : "Nearly symmetric about", lineInWords(symmetry, this.store.doc.unit), "symmetry") : "",
        symmetry ? fact("Mirrored points off by", `${measure(symmetry.rms ?? 0, 3)}${unit}`) : ""),
    ];
  }

  private points(scan: Scan, told: FairTold | null): HTMLElement {
    const unit = this.store.doc.unit ? ` ${this.store.doc.unit}` : "";
    if (!told) this.open.add("points");
    const { notes = [] } = scan.line;
    return this.step("points", `Points (${lineOf(scan).points.length})`,
      h("dl", { class: "facts" },
        fact("Noise", measure(told?.noise ?? scan.line.noise ?? 0, 3) + unit),
        fact("Length", measure(scan.line.length ?? 0) + unit)),
      this.leaving(scan),
      notes.length > 0 && listOf(notes));
  }

  /** Points that a click leaves out. */
  private leaving(scan: Scan): HTMLElement {
    const count = scan.strays?.length ?? 0;
    const clicking = this.store.state.tool === "strays";
    return h("div", { class: "row" },
      button(clicking ? "Done" : "Leave points out", () => this.store.set({ tool: clicking ? "select" : "strays" }),
        { id: "strays", "aria-pressed": String(clicking) }),
      h("span", { class: "quiet" }, count > 0 ? `${count} left out` : clicking ? "click them" : ""));
  }

  private spline(told: FairTold): HTMLElement {
    const members = (told.spline["curves"] ?? [told.spline]) as { knots?: number[]; degree?: number }[];
    const knots = members.reduce((sum, s) => sum + Math.max(0, (s.knots?.length ?? 0) - 2 * ((s.degree ?? 3) + 1)), 0);
    return this.step("spline", "Spline through the points",
      h("dl", { class: "facts" },
        fact("Knots that the search left", String(knots)),
        told.bic !== null && told.bic !== undefined ? fact("BIC, less is better", measure(told.bic, 5)) : "",
        told.monotone ? fact("Stretches of monotone curvature", String(told.monotone)) : ""));
  }

  private piece(e: Faired, p: FairedPiece, index: number): HTMLElement {
    const readings = (p.interpretations ?? []).slice(0, kMostReadings);
    const select = h("select", { id: `reading-${index}`, "aria-label": `Reading of piece ${index}` },
      h("option", { value: "", selected: true }, `${p.rhythm} ${slopes(p.slopes)}`),
      ...readings.filter((r) => r.rhythm !== p.rhythm).map((r) =>
        h("option", { value: r.rhythm }, `as ${r.rhythm} ${slopes(r.slopes)} \u2013 ${(100 * (r.plausibility ?? 0)).toFixed(0)} %`)));
    select.addEventListener("change", () => {
      const rhythm = readings.find((r) => r.rhythm === select.value)?.rhythm;
      if (rhythm) this.again(e, { interpretation: [{ piece: index, rhythm }] });
    });
    const from = p.start ?? 0;
    const point = (stretch: Stretch | null) => this.store.set({ stretch });
    const here = { entity: e.id, from, to: from + (p.length ?? 0) };
    return h("li", {
      pointerenter: () => point(here), pointerleave: () => point(null), focusin: () => point(here), focusout: () => point(null),
    },
      h("span", {}, measure(p.length ?? 0, 3)), select, h("span", { class: "quiet" }, p.impression ?? ""));
  }
}

const slopes = (list: number[] = []) => list.map((s) => s.toFixed(2).replace("-", "\u2212")).join(", ");

const listOf = (list: readonly string[]) => h("ul", { class: "told" }, ...list.map((n) => h("li", {}, n)));
