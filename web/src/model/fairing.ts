/** What is asked of `fair`, and what the page keeps of its answer. */
import { type Curve, defaultsOfFair, type FairRequest, type FairResult } from "../../generated/operations.ts";
import { added, type Entity, type Faired, type FairTold, type Fresh, lineOf } from "./document.ts";
import type { Live } from "./live.ts";
import type { Store } from "./state.ts";

export type Criterion = NonNullable<FairRequest["criterion"]>;

/** As near as the noise of the points. */
const kUntilFair = 0.5;

export interface FairWishes {
  /** 0: by the default rule */
  tolerance: number;
  /** kUntilFair: that, and more where the answer would not be fair */
  smoothness: number;
  criterion: Criterion;
  /** what the curve may not pass, as `fair --keep-inside` has it: y>=0 */
  inside: string;
  /** as `fair --symmetric` has it: off, auto, x=0 */
  symmetric: string;
  /** fastest that curvature may change; 0: as it comes */
  rate: number;
}

export const noWishes = (): FairWishes => ({
  tolerance: 0, smoothness: kUntilFair, criterion: defaultsOfFair.criterion, inside: "", symmetric: "off", rate: 0,
});

const textOr = (value: unknown, otherwise: string): string => (typeof value === "string" ? value : otherwise);

/** What a curve of the document was asked for with. */
export function wishesOf(request: FairRequest): FairWishes {
  const none = noWishes();
  return {
    tolerance: request.tolerance ?? none.tolerance,
    smoothness: request.smoothness ?? none.smoothness,
    criterion: request.criterion ?? none.criterion,
    inside: textOr(request.keep_inside, none.inside),
    symmetric: textOr(request.symmetric, none.symmetric),
    rate: request.max_rate ?? none.rate,
  };
}

export function requestOf(e: Entity, live: Live, wishes: FairWishes): FairRequest {
  const curve = live.of(e.id)?.curve;
  const calmest = wishes.criterion === "least-variation";
  return {
    ...(e.kind === "scan" ? { line: lineOf(e) } : curve ? { curve } : {}),
    criterion: wishes.criterion,
    ...(calmest && wishes.smoothness !== kUntilFair ? { smoothness: wishes.smoothness } : {}),
    ...(calmest && wishes.rate > 0 ? { max_rate: wishes.rate } : {}),
    ...(wishes.tolerance > 0 ? { tolerance: wishes.tolerance } : {}),
    ...(wishes.inside ? { keep_inside: wishes.inside } : {}),
    ...(wishes.symmetric === "off" ? {} : { symmetric: wishes.symmetric }),
  };
}

export function toldOf(r: FairResult, request: FairRequest): FairTold {
  const { line: _line, curve: _curve, ...wishes } = request;
  return {
    request: wishes,
    spline: r.spline as Curve,
    bic: r.spline_bic ?? null,
    monotone: r.monotone_pieces?.length ?? 0,
    pieces: r.pieces ?? [],
    length: r.length ?? 0,
    noise: r.noise ?? 0,
    tolerance: r.tolerance ?? 0,
    max: r.deviation?.max ?? 0,
    rms: r.deviation?.rms ?? 0,
    within: r.within_tolerance ?? false,
    cancelled: r.cancelled ?? false,
    fairness: r.fairness ?? null,
    rate: r.rate ?? null,
    symmetry: r.symmetry ?? null,
    notes: r.report ?? [],
  };
}

/** The answer in place of the one before it, or beside what was faired; one step of undo. */
export function putFaired(store: Store, subject: Entity, curve: Curve, told: FairTold): void {
  const doc = store.state.history.now;
  const old = doc.entities.find((x) => x.kind === "faired" && x.of === subject.id);
  if (old) {
    const entities = doc.entities.map((x) => (x.id === old.id ? ({ ...x, curve, told } as Faired) : x));
    store.commit("Fair", { ...doc, entities }, { selection: [old.id] });
    return;
  }
  const fresh: Fresh<Faired> = { kind: "faired", name: `${subject.name}, faired`, layer: subject.layer, curve, of: subject.id, told };
  const made = added(doc, fresh);
  store.commit("Fair", made.doc, { selection: [made.id] });
}
