/** Files into the document and out of it. */
import type { Curve, DocumentReadResult, KeyLine, NamedCurve, Surface } from "../../generated/operations.ts";
import type { Client } from "../api/client.ts";
import { added, type Doc, entityOf, type Fresh, isShown, lineOf } from "./document.ts";
import type { Live } from "./live.ts";
import type { Store } from "./state.ts";

export const baseOf = (file: string): string => file.replace(/^.*\//, "");

function freshCurve(c: NamedCurve, otherwise: string): Fresh | null {
  const common = { name: c.name || otherwise, ...(c.layer ? { layer: c.layer } : {}), ...(c.color ? { color: c.color } : {}) };
  if (c.line) return { kind: "scan", ...common, line: c.line as KeyLine };
  return c.curve ? { kind: "fixed", ...common, curve: c.curve as Curve } : null;
}

/** All that a file holds, as one step. Numbers of the things that came. */
export function withFile(doc: Doc, file: string, read: DocumentReadResult): { doc: Doc; ids: number[] } {
  const ids: number[] = [];
  const name = baseOf(file);
  const things: (Fresh | null)[] = [
    ...(read.curves ?? []).map((c, i) => freshCurve(c as NamedCurve, (read.curves?.length ?? 0) > 1 ? `${name} ${i + 1}` : name)),
    ...(read.surfaces ?? []).map((s, i): Fresh => ({
      kind: "surface", name: s.name || `${name} ${i + 1}`, surface: s.surface as Surface,
    })),
  ];
  let now: Doc = doc.entities.length === 0 ? { ...doc, unit: read.unit ?? "" } : doc;
  for (const fresh of things) {
    if (!fresh) continue;
    const step = added(now, fresh);
    now = step.doc;
    ids.push(step.id);
  }
  return { doc: now, ids };
}

export const isImage = (name: string): boolean => /\.(png|jpe?g|tiff?|webp)$/i.test(name);

const kNamed = 5; // of what was skipped

const isMesh = (name: string): boolean => /\.(obj|stl|ply)$/i.test(name);

/** What is said of a file that was read: that it was cut, and what was skipped. Empty where nothing is. */
export function noticeOf(file: string, skipped: readonly string[]): { what: string; more: string } {
  const rest = skipped.length > kNamed ? `; and ${skipped.length - kNamed} more` : "";
  const left = skipped.slice(0, kNamed).join("; ") + rest;
  if (!isMesh(file)) return { what: left && "skipped", more: left };
  const elsewhere = "keyline convert --section cuts it elsewhere";
  return { what: "its section in the plane of symmetry", more: left ? `${elsewhere}. Skipped: ${left}` : elsewhere };
}

/** Reads the file the server knows by that name; of a mesh the section in its plane of symmetry. */
export async function openNamed(client: Client, store: Store, file: string): Promise<number[]> {
  const request = { file, planar: true, ...(isMesh(file) && { section: "auto" }) };
  const work = client.long<DocumentReadResult>("document.read", request, () => {});
  store.set({ work: { doing: `reading ${baseOf(file)}`, fraction: 0, trace: [], cancel: work.cancel } });
  const answer = await work.answer;
  store.set({ work: null });
  if (!answer.ok) {
    store.say(`${baseOf(file)}: ${answer.error.message}`, answer.error.hint ?? "", true);
    return [];
  }
  const { doc, ids } = withFile(store.opened, file, answer.result);
  store.commit(`Open ${baseOf(file)}`, doc, { selection: ids.slice(0, 1) });
  const { what, more } = noticeOf(file, answer.result.skipped ?? []);
  if (what) store.say(`${baseOf(file)}: ${what}`, more);
  return ids;
}

interface Told {
  op: "fair" | "curve.analyze";
  name: string;
  request: object;
}

/** A page tells how curves were faired; where none was, what they are. */
function reportOf(doc: Doc, live: Live): Told[] {
  const shown = doc.entities.filter((e) => isShown(doc, e));
  const faired = shown.flatMap((e): Told[] => {
    const of = e.kind === "faired" ? entityOf(doc, e.of) : undefined;
    if (e.kind !== "faired" || !of) return [];
    const subject = of.kind === "scan" ? { line: lineOf(of) } : { curve: live.of(of.id)?.curve };
    return [{ op: "fair", name: e.name, request: { ...e.told.request, ...subject } }];
  });
  if (faired.length > 0) return faired;
  return shown.flatMap((e): Told[] => {
    const curve = live.of(e.id)?.curve;
    return curve ? [{ op: "curve.analyze", name: e.name, request: { curve } }] : [];
  });
}

/** What is shown, as a file of that format; says what could not be held and how far it is off. */
export async function exportAs(client: Client, store: Store, live: Live, format: string,
                               save: (name: string, content: Blob) => void): Promise<void> {
  const doc = store.doc;
  const curves = doc.entities.filter((e) => isShown(doc, e)).flatMap((e): object[] => {
    const label = { name: e.name, layer: e.layer, ...(e.color ? { color: e.color } : {}) };
    if (e.kind === "scan") return [{ ...label, line: lineOf(e) }];
    const curve = live.of(e.id)?.curve;
    return curve ? [{ ...label, curve }] : [];
  });
  const surfaces = doc.entities.flatMap((e) =>
    e.kind === "surface" && isShown(doc, e) ? [{ name: e.name, layer: e.layer, surface: e.surface }] : []);
  const file = `keyline.${format}`;
  const report = format === "html" ? reportOf(doc, live) : [];
  const answer = await client.export({ file, unit: doc.unit, curves, surfaces, ...(report.length > 0 ? { report } : {}) });
  if (!answer.ok) return store.say(`${format}: ${answer.error.message}`, answer.error.hint ?? "", true);
  save(file, answer.result.content);
  const { deviation, notes } = answer.result;
  const met = deviation > 0 ? `within ${deviation.toPrecision(2)}${doc.unit ? ` ${doc.unit}` : ""}` : "exact";
  store.say(`${file}, ${met}${notes.length > 0 ? `; ${notes.join("; ")}` : ""}`);
}
