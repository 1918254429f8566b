/** What a drawn curve is made of: slopes, ratio, form. Every slider is followed at once. */
import { type Blend, type End, type Entity, entityOf, withEntity } from "../model/document.ts";
import type { Store } from "../model/state.ts";
import { button, choice, section, slider, toggle } from "../ui/controls.ts";

const kStops = [
  { at: -1, name: "clothoid" },
  { at: 0, name: "Nielsen" },
  { at: 1, name: "log" },
  { at: 2, name: "involute" },
];

const slope = (v: number) => v.toFixed(3).replace("-", "\u2212");

const kForms = ["best", "taylor-angle", "taylor-arc", "discrete-angle", "discrete-arc", "rational-cubic"]
  .map((value) => ({ value, name: value }));

export function shapePanel(store: Store, e: Entity): HTMLElement | null {
  const put = (label: string) => (change: Partial<Entity>, now = false) => {
    const entity = { ...e, ...store.doc.entities.find((x) => x.id === e.id), ...change } as Entity;
    const doc = withEntity(store.doc, entity);
    if (now) store.commit(label, doc);
    else store.draft(doc);
  };
  const done = (label: string) => () => {
    if (store.state.draft) store.commit(label, store.state.draft);
  };
  const alpha = (id: string, label: string, value: number, change: (v: number) => Partial<Entity>) =>
    slider({
      id, label, value, min: -2, max: 3, stops: kStops, show: slope,
      onInput: (v) => put("Slope")(change(v)), onDone: done("Slope"),
    });
  switch (e.kind) {
    case "segment":
    case "s-shape":
    case "blend":
      return section("Rhythm",
        alpha("alpha", "Slope \u03b1", e.alpha, (v) => ({ alpha: v })),
        e.kind === "blend" && choice({
          id: "order", label: "Continuity", value: e.order,
          options: [{ value: "G1", name: "G1 tangent" }, { value: "G2", name: "G2 curvature" },
            { value: "G3", name: "G3 its rate" }] as const,
          onChoose: (order) => put("Continuity")({ order }, true),
        }),
        ...(e.kind === "blend" ? blendEnds(store, e, (ends) => put("Ends")({ ends }, true)) : []));
    case "compound":
      return section("Compound rhythm",
        alpha("alpha0", "Slope at the tighter end", e.alpha[0], (v) => ({ alpha: [v, currentOf(store, e).alpha[1]] })),
        alpha("alpha1", "Slope at the wider end", e.alpha[1], (v) => ({ alpha: [currentOf(store, e).alpha[0], v] })),
        slider({
          id: "ratio", label: "Share of the turning", value: e.ratio, min: 0.02, max: 0.98,
          show: (v) => v.toFixed(3), onInput: (ratio) => put("Ratio")({ ratio }), onDone: done("Ratio"),
        }));
    case "spline":
      return section("Spline",
        alpha("alpha", "Slope \u03b1", e.alpha, (v) => ({ alpha: v })),
        toggle({ id: "closed", label: "Closed", value: e.closed, onChange: (closed) => put("Close")({ closed }, true) }));
    case "quasi":
      return section("Quasi log-aesthetic B\u00e9zier",
        alpha("alpha", "Slope \u03b1", e.alpha, (v) => ({ alpha: v })),
        choice({ id: "form", label: "Form", value: e.form, options: kForms, onChoose: (form) => put("Form")({ form }, true) }),
        slider({
          id: "degree", label: "Degree", value: e.degree, min: 3, max: 15, step: 1, show: String,
          onInput: (degree) => put("Degree")({ degree }), onDone: done("Degree"),
        }));
    case "mirror":
      return section("Mirror", button("Turn the axis upright", () => {
        const [a] = e.axis;
        put("Axis")({ axis: [a, [a[0], a[1] + 1]] }, true);
      }));
    default:
      return null;
  }
}

/** Where on its two curves the blend begins and ends. */
function blendEnds(store: Store, e: Blend, done: (ends: [End, End]) => void): HTMLElement[] {
  const options = [{ value: "start", name: "start" }, { value: "end", name: "end" }] as const;
  return e.of.map((id, i) => choice({
    id: `blend-end-${i}`, label: `${i === 0 ? "Leaves" : "Meets"} ${entityOf(store.doc, id)?.name ?? ""} at its`, value: e.ends[i] as End, options,
    onChoose: (end) => done(i === 0 ? [end, e.ends[1]] : [e.ends[0], end]),
  }));
}

function currentOf<E extends Entity>(store: Store, e: E): E {
  return (store.doc.entities.find((x) => x.id === e.id) ?? e) as E;
}
