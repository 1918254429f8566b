/** Elements, as short as they can be written. */

type Props = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;
type Child = Node | string | null | undefined | false;

function apply(element: Element, props: Props): void {
  for (const [name, value] of Object.entries(props)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name, value as unknown as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K, props: Props = {}, ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  apply(element, props);
  element.append(...children.filter((c): c is Node | string => !!c || c === ""));
  return element;
}

export function svg(path: string, size = 20): SVGSVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  apply(element, { viewBox: "0 0 20 20", width: size, height: size, "aria-hidden": "true" });
  for (const part of path.split("|")) {
    const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
    apply(line, { d: part });
    element.append(line);
  }
  return element;
}

/** The element's content replaced; what has the focus keeps it, and what is scrolled its place, where something of the same id is there. */
export function fill(element: Element, ...children: Child[]): void {
  const focused = document.activeElement?.id;
  const within = element.contains(document.activeElement);
  const scrolled = [...element.querySelectorAll("[id]")].filter((e) => e.scrollTop > 0).map((e) => [e.id, e.scrollTop] as const);
  element.replaceChildren(...children.filter((c): c is Node | string => !!c || c === ""));
  for (const [id, top] of scrolled) document.getElementById(id)?.scrollTo(0, top);
  if (within && focused) document.getElementById(focused)?.focus({ preventScroll: true });
}

/** Texts and attributes of what is there, where the new children are built alike: nothing is laid out anew for a number. */
function taken(over: Node, from: Node): boolean {
  if (over.nodeName !== from.nodeName || over.childNodes.length !== from.childNodes.length) return false;
  if (over instanceof Text) {
    if (over.data !== (from as Text).data) over.data = (from as Text).data;
    return true;
  }
  if (over instanceof Element && from instanceof Element) {
    if (over.attributes.length !== from.attributes.length) return false;
    for (const { name, value } of from.attributes) if (over.getAttribute(name) !== value) over.setAttribute(name, value);
  }
  return [...over.childNodes].every((child, i) => taken(child, from.childNodes[i] as Node));
}

/** As fill(), for content that nobody listens to and that changes while a hand drags. */
export function refill(element: Element, ...children: Child[]): void {
  const fresh = document.createElement(element.nodeName);
  fresh.append(...children.filter((c): c is Node | string => !!c));
  const same = element.childNodes.length === fresh.childNodes.length
    && [...element.childNodes].every((child, i) => taken(child, fresh.childNodes[i] as Node));
  if (!same) element.replaceChildren(...fresh.childNodes);
}
