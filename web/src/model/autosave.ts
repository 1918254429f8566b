/** Keeps the work: with the server, and in the browser for when the server is gone. */
import type { Client } from "../api/client.ts";
import type { Doc } from "./document.ts";
import type { Store } from "./state.ts";

const kDelay = 350; // ms after the last change
const kHere = "keyline-work";

export interface Kept {
  format: "keyline-studio";
  version: 1;
  saved: number;
  files: string[];
  doc: Doc;
}

export function isKept(value: unknown): value is Kept {
  const kept = value as Kept | null;
  return kept?.format === "keyline-studio" && kept.version === 1 && Array.isArray(kept.doc?.entities);
}

/** The file as a document of ours; null: it is something else. */
export async function ownDocument(file: Blob & { name: string }): Promise<Kept | null> {
  if (!/\.json$/i.test(file.name)) return null;
  try {
    const value: unknown = JSON.parse(await file.text());
    return isKept(value) ? value : null;
  } catch {
    return null;
  }
}

export class Autosave {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private saved: Doc | null = null;
  files: string[] = [];

  constructor(private readonly client: Client, private readonly store: Store, private readonly storage: Storage) {
    store.onChange((now, before) => {
      if (now.history.now !== before.history.now) this.soon();
    });
  }

  /** Whether the server keeps the document as it is. */
  get settled(): boolean {
    return this.store.state.history.now === this.saved;
  }

  private soon(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.now(), kDelay);
  }

  /** The document as it is kept and saved. */
  text(): string {
    const kept: Kept = {
      format: "keyline-studio", version: 1, saved: Date.now(), files: this.files, doc: this.store.state.history.now,
    };
    return JSON.stringify(kept);
  }

  async now(): Promise<void> {
    const doc = this.store.state.history.now;
    if (doc === this.saved) return;
    const text = this.text();
    const here = this.keepHere(text);
    if (await this.client.keep(text)) this.saved = doc;
    else if (!here) this.store.say("This is more than the browser keeps", "save it as a Keyline document", true);
  }

  private keepHere(text: string): boolean {
    try {
      this.storage.setItem(kHere, text);
      return true;
    } catch {
      this.storage.removeItem(kHere); // larger than the browser keeps
      return false;
    }
  }

  /** The newest of what either keeps; null: nothing. */
  async kept(): Promise<Kept | null> {
    const there = await this.client.kept();
    let here: unknown = null;
    try {
      here = JSON.parse(this.storage.getItem(kHere) ?? "null");
    } catch {
      // not ours
    }
    const found = [there, here].filter(isKept).filter((k) => k.doc.entities.length > 0);
    return found.sort((a, b) => b.saved - a.saved)[0] ?? null;
  }
}
