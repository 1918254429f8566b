/** What fairing came to, in two parts: near enough, and calm enough. */
import type { CombFigures, FairFigures } from "../../generated/operations.ts";
import type { FairTold } from "../model/document.ts";
import { h } from "../ui/dom.ts";
import { endless, measure } from "../view/ticks.ts";

function figures(f: FairFigures): HTMLElement {
  const { answer, spline, smoothing_spline: smoothing } = f;
  const columns: [string, CombFigures | undefined][] = [["curve", answer], ["points\u2019 spline", spline], ["smooth spline", smoothing]];
  const shown = columns.filter((c): c is [string, CombFigures] => c[1] !== undefined);
  const row = (name: string, of: (c: CombFigures) => string) =>
    h("tr", {}, h("th", { scope: "row" }, name), ...shown.map(([, c]) => h("td", {}, of(c))));
  return h("table", { class: "figures" },
    h("thead", {}, h("tr", {}, h("td"), ...shown.map(([name]) => h("th", { scope: "col" }, name)))),
    h("tbody", {},
      row("Waves", (c) => String(c.waves ?? 0)),
      row("Energy", (c) => measure(endless(c.energy), 3)),
      row("Jolt", (c) => measure(endless(c.jolt), 3))));
}

export function verdict(told: FairTold): (HTMLElement | null)[] {
  const near = told.cancelled ? "Stopped early: the best found" : told.within ? "Near enough: within the tolerance" : "Not near enough: beyond the tolerance";
  const calm = told.fairness && (told.fairness.fair ? "Fair: as calm as a smooth spline" : "Not fair: a smooth spline is calmer");
  return [
    h("p", { class: told.within && !told.cancelled ? "verdict good" : "verdict bad", id: "verdict" }, near),
    calm ? h("p", { class: told.fairness?.fair ? "verdict good" : "verdict bad", id: "fairness" }, calm) : null,
    told.fairness ? figures(told.fairness) : null,
  ];
}
