/** Geometry within the page, without a server: the module of bindings/wasm in two workers, one for
 *  what follows a hand and one for what takes long. */
import type { Answer, Client, Exported, LongWork, Session } from "./client.ts";
import { Lane } from "./lane.ts";

/** Files the page may be opened with: beside it, by their plain names (#open=bonnet-scan.csv). */
const kPlainName = /^[\w-]+(\.[\w-]+)+$/;

interface Written {
  written: { deviation?: number; notes?: string[] }[];
}

export class LocalClient implements Client {
  onReach: (reached: boolean) => void = () => {};
  readonly formats = ["json", "svg", "dxf", "csv"];
  private readonly files = new Map<string, Uint8Array>();
  private readonly hand: Lane;
  private readonly work: Lane;
  private readonly known: Promise<Answer<ReadonlySet<string>>>;
  private operations: ReadonlySet<string> = new Set();

  constructor(start: () => Worker, private readonly opened: string) {
    this.hand = new Lane(start, this.files);
    this.work = new Lane(start, this.files);
    this.known = new Promise((resolve) => {
      this.hand.onReady = (operations) => resolve({ ok: true, result: new Set(operations) });
      this.hand.onLost = (why) => resolve({
        ok: false, error: { ...why, message: "This browser cannot run the page", hint: why.message },
      });
    });
    this.hand.warm();
  }

  can(op: string): boolean {
    return this.operations.has(op);
  }

  async session(): Promise<Answer<Session>> {
    const known = await this.known;
    if (!known.ok) return known;
    this.operations = known.result;
    const files = [];
    if (kPlainName.test(this.opened)) {
      const reply = await fetch(this.opened);
      if (reply.ok) {
        this.files.set(this.opened, new Uint8Array(await reply.arrayBuffer()));
        files.push(this.opened);
      }
    }
    return { ok: true, result: { version: "", folder: "", files, kept: false } };
  }

  async given(file: string): Promise<Blob | null> {
    const content = this.files.get(file);
    return content ? new Blob([content as BlobPart]) : null;
  }

  /** The browser's own store, which is asked beside this, is all there is. */
  async kept(): Promise<unknown> {
    return null;
  }
  async keep(): Promise<boolean> {
    return false;
  }

  async call<T>(op: string, request: object): Promise<Answer<T>> {
    return this.absent(op) ?? ((await this.hand.ask({ ...request, op }, () => {})).answer as Answer<T>);
  }

  quick<T>(op: string, request: object): Promise<Answer<T>> {
    return this.call<T>(op, request);
  }

  long<T>(op: string, request: object, onProgress: (fraction: number, doing: string) => void): LongWork<T> {
    const absent = this.absent(op);
    const answer = absent ? Promise.resolve(absent)
      : this.work.ask({ ...request, op }, onProgress).then((reply) => reply.answer as Answer<T>);
    return { answer, cancel: () => this.work.end() };
  }

  async upload(name: string, content: Blob): Promise<Answer<string>> {
    const file = name.replace(/^.*[/\\]/, "");
    this.files.set(file, new Uint8Array(await content.arrayBuffer()));
    return { ok: true, result: file };
  }

  async export(request: object): Promise<Answer<Exported>> {
    const { file } = request as { file: string };
    const { answer, content } = await this.hand.ask({ ...request, op: "document.write" }, () => {}, file);
    if (!answer.ok) return answer;
    const [told] = (answer.result as Written).written;
    return {
      ok: true,
      result: { content: new Blob([content ?? ""] as BlobPart[]), deviation: told?.deviation ?? 0, notes: told?.notes ?? [] },
    };
  }

  private absent(op: string): { ok: false; error: { code: string; message: string; hint: string } } | null {
    if (this.can(op)) return null;
    return {
      ok: false,
      error: { code: "unsupported", message: `this page has no ${op}`, hint: "an installed Keyline has: keyline studio" },
    };
  }
}
