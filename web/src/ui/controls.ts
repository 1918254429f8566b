/** Controls that panels are made of. */
import { h, svg } from "./dom.ts";

export interface SliderOptions {
  id: string;
  label: string;
  value: number;
  min: number;
  max: number;
  step?: number;
  /** places with a name, marked below the track */
  stops?: readonly { at: number; name: string }[];
  /** the number beside it */
  show?: (value: number) => string;
  /** stands for the number until one is given */
  unset?: string | undefined;
  /** the slider's place of a typed number, where they differ */
  read?: (typed: number) => number;
  onInput: (value: number) => void;
  onDone: () => void;
}

/** A slider with a number that can be typed, and named stops. Catches at a stop when near it. */
export function slider(o: SliderOptions): HTMLElement {
  const begun = () => (o.unset === undefined ? (o.show ?? String)(o.value) : "");
  const track = h("input", {
    type: "range", id: o.id, min: o.min, max: o.max, step: o.step ?? "any", value: o.value,
    "aria-label": o.label,
  });
  const number = h("input", {
    type: "text", class: "number", inputmode: "decimal", value: begun(), placeholder: o.unset ?? "",
    id: `${o.id}-number`, "aria-label": `${o.label}, number`,
  });
  const put = (value: number) => {
    number.value = (o.show ?? String)(value);
    o.onInput(value);
  };
  track.addEventListener("input", () => {
    const near = o.stops?.find((s) => Math.abs(s.at - track.valueAsNumber) < (o.max - o.min) / 150);
    if (near) track.valueAsNumber = near.at;
    put(track.valueAsNumber);
  });
  track.addEventListener("change", o.onDone);
  number.addEventListener("change", () => {
    const typed = Number(number.value.replace("\u2212", "-").replace(",", ".").replace("\u00d7", ""));
    const value = o.read ? o.read(typed) : typed;
    if (Number.isFinite(value) && number.value.trim() !== "") {
      track.valueAsNumber = value;
      put(value);
      o.onDone();
    } else {
      number.value = begun();
    }
  });
  const stops = o.stops?.map((s) => {
    const stop = h("button", {
      type: "button", class: "stop", title: `${s.name}: ${s.at}`,
      click: () => {
        track.valueAsNumber = s.at;
        put(s.at);
        o.onDone();
      },
    }, s.name);
    const at = (s.at - o.min) / (o.max - o.min);
    stop.style.setProperty("--at", String(at));
    stop.style.setProperty("--shift", `${at < 0.1 ? 0 : at > 0.9 ? -100 : -50}%`); // names at the ends stay inside
    return stop;
  });
  return h("div", { class: "slider" },
    h("div", { class: "row" }, h("label", { for: o.id }, o.label), number),
    track,
    stops && h("div", { class: "stops" }, ...stops));
}

export function choice<T extends string>(o: {
  id: string;
  label: string;
  value: T;
  options: readonly { value: T; name: string }[];
  onChoose: (value: T) => void;
}): HTMLElement {
  const select = h("select", { id: o.id }, ...o.options.map((option) =>
    h("option", { value: option.value, selected: option.value === o.value }, option.name)));
  select.addEventListener("change", () => o.onChoose(select.value as T));
  return h("div", { class: "row" }, h("label", { for: o.id }, o.label), select);
}

export function toggle(o: {
  id: string;
  label: string;
  value: boolean;
  onChange: (value: boolean) => void;
}): HTMLElement {
  const box = h("input", { type: "checkbox", id: o.id, checked: o.value });
  box.addEventListener("change", () => o.onChange(box.checked));
  return h("label", { class: "toggle", for: o.id }, box, h("span", {}, o.label));
}

export function button(label: string, onClick: () => void, props: Record<string, string | boolean | undefined> = {}): HTMLButtonElement {
  return h("button", { type: "button", click: onClick, ...props }, label);
}

export function iconButton(o: {
  id?: string;
  icon: string;
  label: string;
  key?: string;
  pressed?: boolean;
  disabled?: boolean;
  onClick: () => void;
}): HTMLButtonElement {
  const title = o.key ? `${o.label} (${o.key})` : o.label;
  return h("button", {
    type: "button", class: "icon", title, "aria-label": o.label, disabled: o.disabled, id: o.id,
    "aria-pressed": o.pressed === undefined ? undefined : String(o.pressed),
    click: o.onClick,
  }, svg(o.icon));
}

/** A name and a number, in a table of them. */
export function fact(name: string, value: string, cls = ""): HTMLElement {
  return h("div", { class: `fact ${cls}` }, h("dt", {}, name), h("dd", {}, value));
}

export function section(title: string, ...children: (Node | null | false | undefined | string)[]): HTMLElement {
  return h("section", {}, h("h2", {}, title), ...children);
}
