/** A worker of the page with a module of its own: questions answered one by one, in order. */
import type { Answer, Failure } from "./client.ts";

/** To a worker. */
export interface Question {
  id: number;
  /** a line of `keyline batch` */
  line: string;
  /** to be there before it begins */
  files: readonly (readonly [name: string, content: Uint8Array])[];
  /** a file the operation writes, to come back with the answer */
  wanted: string;
}

/** From a worker. */
export type Said =
  | { kind: "ready"; operations: string[] }
  | { kind: "progress"; id: number; fraction: number; doing: string }
  | { kind: "answer"; id: number; line: string; content: Uint8Array | null };

export interface Reply {
  answer: Answer<unknown>;
  content: Uint8Array | null;
}

interface Waiting {
  resolve(reply: Reply): void;
  onProgress(fraction: number, doing: string): void;
}

const failed = (error: Failure): Reply => ({ answer: { ok: false, error }, content: null });
const kStopped: Failure = { code: "cancelled", message: "stopped" };

export class Lane {
  private worker: Worker | null = null;
  private readonly sent = new Set<Uint8Array>();
  private readonly waiting = new Map<number, Waiting>();
  private next = 1;
  /** Told what can be asked for, each time a worker is there. */
  onReady: (operations: string[]) => void = () => {};
  /** Told why a worker has ended by itself. */
  onLost: (why: Failure) => void = () => {};

  constructor(private readonly start: () => Worker, private readonly files: ReadonlyMap<string, Uint8Array>) {}

  /** Begins to load the module before anything is asked for. */
  warm(): Worker {
    if (this.worker) return this.worker;
    const worker = this.start();
    this.worker = worker;
    worker.onmessage = (message) => this.take(message.data as Said);
    worker.onerror = (event) => {
      event.preventDefault();
      const why = { code: "internal", message: event.message || "the module could not be loaded" };
      this.end(why);
      this.onLost(why);
    };
    return worker;
  }

  ask(request: object, onProgress: Waiting["onProgress"], wanted = ""): Promise<Reply> {
    const worker = this.warm();
    const id = this.next++;
    const files = [...this.files].filter(([, content]) => !this.sent.has(content));
    for (const [, content] of files) this.sent.add(content);
    return new Promise((resolve) => {
      this.waiting.set(id, { resolve, onProgress });
      const question: Question = { id, line: JSON.stringify(request), files, wanted };
      worker.postMessage(question);
    });
  }

  /** Whatever is under way ends without an answer; the next question starts another worker. */
  end(why: Failure = kStopped): void {
    this.worker?.terminate();
    this.worker = null;
    this.sent.clear();
    for (const { resolve } of this.waiting.values()) resolve(failed(why));
    this.waiting.clear();
  }

  private take(said: Said): void {
    if (said.kind === "ready") return this.onReady(said.operations);
    const waiting = this.waiting.get(said.id);
    if (said.kind === "progress") return waiting?.onProgress(said.fraction, said.doing);
    this.waiting.delete(said.id);
    waiting?.resolve({ answer: JSON.parse(said.line) as Answer<unknown>, content: said.content });
  }
}
