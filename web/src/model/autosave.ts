/** Keeps the work: with the server, and in the browser for when the server is gone. */
import type { Client } from "../api/client.ts";
import type { Doc } from "./document.ts";
import type { Store, Underlay } from "./state.ts";

const kDelay = 350; // ms after the last change
const kHere = "keyline-work";

/** How a picture lies below; with what its file holds, in base64, in a document that is saved. */
export interface KeptPicture extends Pick<Underlay, "file" | "name" | "at" | "scale" | "opacity" | "mapped"> {
  content?: string;
}

export interface Kept {
  format: "keyline-studio";
  version: 1;
  saved: number;
  files: string[];
  doc: Doc;
  picture?: KeptPicture;
}

function pictureOf(under: Underlay | null): KeptPicture | null {
  if (!under) return null;
  const { file, name, at, scale, opacity, mapped } = under;
  return { file, name, at, scale, opacity, mapped };
}

async function inBase64(content: Blob): Promise<string> {
  const bytes = new Uint8Array(await content.arrayBuffer());
  const parts: string[] = [];
  const most = 0x8000; // arguments of one call
  for (let i = 0; i < bytes.length; i += most) parts.push(String.fromCharCode(...bytes.subarray(i, i + most)));
  return btoa(parts.join(""));
}

/** What a saved picture's file holds; null: it was not saved with it. */
export function contentOf(picture: KeptPicture): Blob | null {
  return picture.content === undefined ? null : new Blob([Uint8Array.from(atob(picture.content), (c) => c.charCodeAt(0))]);
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
  private savedPicture = "null";
  files: string[] = [];

  constructor(private readonly client: Client, private readonly store: Store, private readonly storage: Storage) {
    store.onChange((now, before) => {
      if (now.history.now !== before.history.now || now.underlay !== before.underlay) this.soon();
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

  private text(picture: KeptPicture | null): string {
    const kept: Kept = {
      format: "keyline-studio", version: 1, saved: Date.now(), files: this.files, doc: this.store.state.history.now,
      ...(picture && { picture }),
    };
    return JSON.stringify(kept);
  }

  /** All of the work in one text: what is kept, and the picture below. */
  async whole(): Promise<string> {
    const { underlay } = this.store.state;
    const picture = pictureOf(underlay);
    return this.text(picture && underlay && { ...picture, content: await inBase64(underlay.picture) });
  }

  async now(): Promise<void> {
    const doc = this.store.state.history.now;
    const picture = pictureOf(this.store.state.underlay);
    const placed = JSON.stringify(picture);
    if (doc === this.saved && placed === this.savedPicture) return;
    const text = this.text(picture);
    const here = this.keepHere(text);
    if (await this.client.keep(text)) [this.saved, this.savedPicture] = [doc, placed];
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
    const found = [there, here].filter(isKept).filter((k) => k.doc.entities.length > 0 || k.picture);
    return found.sort((a, b) => b.saved - a.saved)[0] ?? null;
  }
}
